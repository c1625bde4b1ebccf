//! Interpolation between the rows of a trajectory.

use crate::error::{Warning, clock};
use crate::linearize::State;
use crate::prepared::Model;
use crate::system::MechanicalSystem;
use crate::tolerances;
use crate::trajectory::Trajectory;

pub struct DrawnMotion<'a> {
    pub prepared: &'a Model,
    pub title: String,
    trajectory: &'a Trajectory,
}

impl<'a> DrawnMotion<'a> {
    /// The motion of a trajectory with at least one row.
    pub fn new(prepared: &'a Model, trajectory: &'a Trajectory) -> Self {
        DrawnMotion { prepared, title: prepared.name.clone(), trajectory }
    }

    pub fn titled(self, title: String) -> Self {
        DrawnMotion { title, ..self }
    }

    pub fn trajectory(&self) -> &'a Trajectory {
        self.trajectory
    }

    /// Returns a warning if rows are too far apart to draw the mechanism between them.
    pub fn sparse(&self) -> Option<Warning> {
        let names = &self.trajectory.names.q;
        let length = self.prepared.system().facts().length;
        let scale = |name: &String| if name.ends_with(['x', 'y', 'z']) && !name.contains(".q") { length } else { 1.0 };
        // On half the distance the cubic is 2^4 times as accurate.
        let is_far = |row: &[Vec<f64>]| {
            let ((q, ..), found) = (self.trajectory.row_state(&row[1]), self.between(&row[0], &row[2], row[1][0]).q);
            let errors =
                names.iter().zip(q.iter().zip(found)).map(|(name, (q, found))| (q - found).abs() / scale(name));
            errors.fold(0.0, f64::max) / 16.0 > tolerances::TOLD
        };
        let row = self.trajectory.rows.windows(3).find(|row| !names.is_empty() && is_far(row))?;
        let text = format!("rows at t = {} s are too far apart to draw the mechanism between them", clock(row[1][0]));
        Some(Warning::new(text, "draw it at times of rows with --at, or simulate with a smaller --output-step"))
    }

    /// Returns its start and end time, s.
    pub fn reach(&self) -> (f64, f64) {
        let start = self.prepared.start_time();
        let rows = &self.trajectory.rows;
        (rows.first().map_or(start, |row| row[0]), rows.last().map_or(start, |row| row[0]))
    }

    /// Returns at most `most` times of rows, evenly chosen, with the first and the last.
    pub fn times(&self, most: usize) -> Vec<f64> {
        let count = self.trajectory.rows.len();
        let stride = count.div_ceil(most.max(1)).max(1);
        let mut times: Vec<f64> = self.trajectory.times().step_by(stride).collect();
        if count > 0 && !(count - 1).is_multiple_of(stride) {
            times.push(self.reach().1);
        }
        times
    }

    /// Returns the state at a time: that of a row, or one between two rows on the cubic through their coordinates and
    /// rates.
    pub fn state(&self, t: f64) -> State {
        let rows = &self.trajectory.rows;
        let after = rows.partition_point(|row| row[0] < t);
        let (Some(b), a) = (rows.get(after).or(rows.last()), rows.get(after.wrapping_sub(1))) else {
            return State { t, ..State::start(self.prepared) };
        };
        let (q, v, _) = self.trajectory.row_state(b);
        match a {
            Some(a) if b[0] > t && b[0] > a[0] => self.between(a, b, t),
            _ => State { t: b[0], q: q.to_vec(), v: v.to_vec() },
        }
    }

    fn between(&self, a: &[f64], b: &[f64], t: f64) -> State {
        let system = self.prepared.system();
        let h = b[0] - a[0];
        let s = (t - a[0]) / (b[0] - a[0]);
        let ((qa, va, _), (qb, vb, _)) = (self.trajectory.row_state(a), self.trajectory.row_state(b));
        let ra = rate(system, qa, va);
        let rb = rate(system, qb, vb);
        let cubic = |i: usize| {
            let near = s * s * (3.0 - 2.0 * s);
            let far = s * (1.0 - s);
            qa[i] + near * (qb[i] - qa[i]) + h * far * ((1.0 - s) * ra[i] - s * rb[i])
        };
        let mut q: Vec<f64> = (0..qa.len()).map(cubic).collect();
        system.normalize(&mut q);
        State { t, q, v: va.iter().zip(vb).map(|(a, b)| a + s * (b - a)).collect() }
    }
}

fn rate(system: &dyn MechanicalSystem, q: &[f64], v: &[f64]) -> Vec<f64> {
    let mut rate = vec![0.0; q.len()];
    system.rate(q, v, &mut rate);
    rate
}
