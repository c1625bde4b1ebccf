//! Rank and drift of the constraints at a position.

use super::path::{Path, PathPoint};
use crate::formulation::Dynamics;
use crate::math::array::Each;
use crate::math::kkt::dependent_rows;
use crate::math::largest;
use crate::system::{Dimensions, MechanicalSystem, Need};
use crate::tolerances::{DENSE_EIGENVALUES, DENSE_EQUATIONS, SIX_DIGITS, TRUNCATED_RANK};

const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// A system with the workspace to evaluate its constraints anywhere, made where it is needed: far from singular states a
/// run tells its rank indicators itself.
pub struct Survey<'a> {
    system: &'a dyn MechanicalSystem,
    dynamics: Option<Dynamics<'a>>,
    dropped: Vec<usize>,
    dimensions: Dimensions,
    rest: Vec<f64>,
    largest: f64,
    nearest: (f64, Vec<f64>),
}

impl<'a> Survey<'a> {
    pub fn new(system: &'a dyn MechanicalSystem) -> Self {
        let dimensions = system.dimensions();
        let rest = vec![0.0; dimensions.v];
        let nearest = (0.0, Vec::new());
        Survey { system, dynamics: None, dropped: Vec::new(), dimensions, rest, largest: 0.0, nearest }
    }

    /// Drops rows that depend on others everywhere.
    pub fn drop_rows(&mut self, rows: &[usize]) {
        if rows != self.dropped {
            self.dropped = rows.to_vec();
            self.dynamics.iter_mut().for_each(|dynamics| dynamics.drop_rows(rows));
        }
    }

    pub fn regular_rank(&self) -> usize {
        self.dimensions.lambda - self.dropped.len()
    }

    fn unknowns(&self) -> usize {
        self.dimensions.v + self.dimensions.lambda
    }

    /// The terms `need` at a position at rest.
    fn evaluate(&mut self, t: f64, q: &[f64], need: Need) -> &mut Dynamics<'a> {
        let dynamics = self.dynamics.get_or_insert_with(|| {
            let mut dynamics = Dynamics::new(self.system);
            dynamics.drop_rows(&self.dropped);
            dynamics
        });
        dynamics.evaluate(t, q, &self.rest, need);
        dynamics
    }

    /// What the rank of G, the metric of M^-1 and a projection need.
    fn constraints(&mut self, t: f64, q: &[f64]) -> &mut Dynamics<'a> {
        self.evaluate(t, q, Need::MASS | Need::CONSTRAINTS | Need::G)
    }

    /// Returns q' at a state.
    pub fn rate(&self, q: &[f64], v: &[f64]) -> Vec<f64> {
        let mut rate = vec![0.0; q.len()];
        self.system.rate(q, v, &mut rate);
        rate
    }

    /// Returns the rank indicator at a position; zero where the matrix is singular.
    pub fn rank_indicator(&mut self, t: f64, q: &[f64]) -> f64 {
        let dynamics = self.constraints(t, q);
        dynamics.factor().map_or(0.0, |()| dynamics.kkt.rank_indicator())
    }

    fn rank_indicator_on(&mut self, path: &Path, t: f64) -> f64 {
        let q = self.position(path, t);
        self.rank_indicator(t, &q)
    }

    /// Sets the largest rank indicator seen, below a part of which a projection leaves out rows that nearly depend on
    /// others.
    pub fn refer_to(&mut self, largest: f64) {
        self.largest = largest;
    }

    /// Returns the position near an interpolated one that has the drift of the middle state, which interpolation does
    /// not preserve, but for nearly dependent rows: to move a position along these takes a division by almost nothing.
    pub fn position(&mut self, path: &Path, t: f64) -> Vec<f64> {
        let mut q = path.at(t);
        let mut step = vec![0.0; self.rest.len()];
        let mut rate = vec![0.0; q.len()];
        let largest = self.largest;
        // Newton's steps back to the drift of the motion.
        for _ in 0..2 {
            let dynamics = self.constraints(t, &q);
            dynamics.kkt.rank_reference = largest;
            dynamics.terms.phi.iter_mut().zip(&path.phi).for_each(|(phi, drift)| *phi -= drift);
            let factored = dynamics.factor_truncated().is_ok();
            if !factored || dynamics.kkt.solve_projection(&dynamics.terms.phi, &mut step).is_err() {
                break;
            }
            dynamics.system.rate(&q, &step, &mut rate);
            q.iter_mut().zip(&rate).for_each(|(q, rate)| *q -= rate);
            dynamics.system.normalize(&mut q);
        }
        q
    }

    /// Returns the time of the least rank indicator on a path between states with `indicators`, and its value, if it
    /// comes near to `bound`: by golden sections, while the minimum can be below `bound` with twice the steepest slope
    /// seen; and then, since the rank indicator is linear on both sides of a singular state, by the intersection of two
    /// lines.
    pub fn least_rank_indicator(&mut self, path: &Path, indicators: [f64; 2], bound: f64) -> Option<(f64, f64)> {
        let [mut from, _, mut to] = path.times;
        let width = to - from;
        // Steps near round-off of the time do not come closer.
        let shortest = (SIX_DIGITS * width).max(8.0 * f64::EPSILON * from.abs().max(to.abs()));
        let mut inner = [to - GOLDEN * (to - from), from + GOLDEN * (to - from)];
        let mut values = inner.each(|t| self.rank_indicator_on(path, t));
        // The inner values of a symmetric minimum give no slope.
        let outer = [(indicators[0] - values[0]) / (inner[0] - from), (indicators[1] - values[1]) / (to - inner[1])];
        let mut steepest = 2.0 * outer[0].abs().max(outer[1].abs());
        while to - from > shortest && values[0].min(values[1]) > 5e-4 * bound {
            steepest = steepest.max(2.0 * (values[1] - values[0]).abs() / (inner[1] - inner[0]));
            if values[0].min(values[1]) - steepest * (to - from) > bound {
                return None;
            }
            if values[0] < values[1] {
                to = inner[1];
                inner = [to - GOLDEN * (to - from), inner[0]];
                values = [self.rank_indicator_on(path, inner[0]), values[0]];
            } else {
                from = inner[0];
                inner = [inner[1], from + GOLDEN * (to - from)];
                values = [values[1], self.rank_indicator_on(path, inner[1])];
            }
        }
        let least = values[0].min(values[1]);
        let t = if values[0] < values[1] { inner[0] } else { inner[1] };
        let mut aside = 1e-3 * width;
        let mut sides = |aside: f64| [t - aside, t + aside].each(|t| self.rank_indicator_on(path, t));
        let [before, after] = sides(aside);
        // The lines are straight there, and round-off is small.
        aside = (2e-2 * bound * aside / before.max(after)).min(0.1 * width);
        let [before, after] = sides(aside);
        // The lines of a round minimum do not meet near zero.
        if least < 0.5 * before.min(after) {
            Some((t + aside * (before - after) / (before + after), least))
        } else {
            Some((t, least))
        }
    }

    /// Returns the rank at a position, and the joints whose rows depend on each other there.
    pub fn dependence(&mut self, t: f64, q: &[f64], tolerance: f64) -> (Option<usize>, Vec<String>) {
        // Time goes with the cube.
        if self.unknowns() > DENSE_EQUATIONS {
            return (None, Vec::new());
        }
        let dynamics = self.constraints(t, q);
        let found = dependent_rows(&dynamics.structure.g, &dynamics.terms.g, tolerance.max(TRUNCATED_RANK));
        let new = found.rows.iter().filter(|row| !self.dropped.contains(&row.row));
        let rows: Vec<usize> =
            new.flat_map(|row| row.combination.iter().map(|(other, _)| *other).chain([row.row])).collect();
        let groups = self.system.facts().groups();
        let named = groups.iter().filter(|group| rows.iter().any(|row| group.rows.contains(row)));
        (Some(found.rank), named.map(|group| group.name.clone()).collect())
    }

    /// Returns the drift of positions and velocities relative to the scene's scale, the latter also to the size of the
    /// velocity.
    pub fn drift(&self, state: &PathPoint) -> [f64; 2] {
        let scale = self.system.facts().scales.iter().copied().fold(f64::INFINITY, f64::min);
        let speed = largest(&state.v).max(f64::MIN_POSITIVE);
        [largest(&state.phi) / scale, largest(&state.phi_dot) / (scale * speed)]
    }

    /// Returns sqrt(v^T M v) of each of these with the masses at a position.
    pub fn sizes<const N: usize>(&mut self, t: f64, q: &[f64], all: [&[f64]; N]) -> [f64; N] {
        let Dynamics { structure, terms, .. } = self.evaluate(t, q, Need::MASS);
        all.each(|v| {
            let mut momentum = vec![0.0; v.len()];
            structure.mass.multiply_symmetric(&terms.mass, v, &mut momentum);
            v.iter().zip(&momentum).map(|(v, p)| v * p).sum::<f64>().max(0.0).sqrt()
        })
    }

    pub fn keep_nearest(&mut self, t: f64, q: &[f64]) {
        self.nearest.0 = t;
        self.nearest.1.clear();
        self.nearest.1.extend_from_slice(q);
    }

    pub fn condition_at_nearest(&mut self) -> Option<f64> {
        if self.unknowns() > DENSE_EIGENVALUES {
            return None;
        }
        let (t, q) = std::mem::take(&mut self.nearest);
        let Dynamics { kkt, terms, .. } = self.constraints(t, &q);
        Some(kkt.condition_number(&terms.mass, &terms.g)).filter(|c| c.is_finite())
    }
}
