//! Consistent initial values: q, then v, then v' and lambda; static equilibrium.

mod closing;
mod diagnosis;
mod equilibrium;
mod follow;
mod holds;
mod nearest;
mod position;
mod reach;
mod report;
mod travel;
mod velocity;

pub use equilibrium::{Equilibrium, Stability, Way, equilibrium};
#[doc(hidden)]
pub use follow::{Followed, follow};
pub use report::{Assembly, Level, Move};
pub(crate) use travel::{Travel, TravelEnd};

use crate::error::{Error, Result, short};
use crate::formulation::{Dynamics, StepError};
use crate::math::expression::Switch;
use crate::math::kkt::{Pattern, SaddlePoint};
use crate::math::{Rate, largest, largest_in};
use crate::scene::INITIAL;
use crate::system::{MechanicalSystem, Need, OperatingPoint, Scratch, Structure, Terms};
use crate::tolerances::initial as tolerances;
use std::sync::Arc;

/// Makes a guess consistent at time `t` by the least change in the mass metric that keeps the coordinates named by
/// `hold`. Flexible bodies in floating frames add their stiffness to the metric.
///
/// # Errors
/// Bad input: a name in `hold` that does not exist, joints that cannot all be closed, velocities that contradict the
/// joints or each other; a start at which the accelerations are not determined, or beyond the range of a signal.
pub fn assemble(system: &dyn MechanicalSystem, t: f64, guess: (&[f64], &[f64]), hold: &[String]) -> Result<Assembly> {
    assemble_held(system, [None; 2], t, guess, hold)
}

/// As [`assemble`]; the coordinates satisfy the constraints of the first of `held`, the velocities those of the second:
/// each is the system with further constraints, if there are any.
///
/// # Errors
/// As [`assemble`].
pub fn assemble_held(
    system: &dyn MechanicalSystem,
    held: [Option<&dyn MechanicalSystem>; 2],
    t: f64,
    guess: (&[f64], &[f64]),
    hold: &[String],
) -> Result<Assembly> {
    consistent(system, held, t, guess, hold).map_err(|error| beyond_signal(system, t, guess).unwrap_or(error))
}

/// The error for a state at which the argument of a signal is where it has no value.
fn beyond_signal(system: &dyn MechanicalSystem, t: f64, (q, v): (&[f64], &[f64])) -> Option<Error> {
    let switches = system.switches();
    let mut arguments = vec![Rate::fixed(0.0); switches.len()];
    let (vdot, mut scratch) = (vec![0.0; v.len()], Scratch::default());
    system.switching(OperatingPoint { t, q, v, vdot: &vdot, lambda: &[] }, &mut arguments, &mut scratch);
    let left = |(number, switch): (usize, &Switch)| {
        let signal = switch.signal.as_ref()?;
        let piece = signal.piece(arguments[number].re)?;
        signal.is_undefined_on(piece).then(|| signal.left_by(system.owner_of_switch(number)))
    };
    let message = switches.iter().enumerate().find_map(left)?;
    let error = Error::input(format!("at the start, {message}")).under("signals");
    Some(error.hint("start within it, or give the signal \"beyond\": \"hold\" or \"repeat\""))
}

fn consistent(
    system: &dyn MechanicalSystem,
    [coordinates, velocities]: [Option<&dyn MechanicalSystem>; 2],
    t: f64,
    (q, v): (&[f64], &[f64]),
    hold: &[String],
) -> Result<Assembly> {
    let directions = holds::directions(system, hold)?;
    let mut metric = Metric::new(system, directions.clone());
    let (mut assembled, mut rates) = (q.to_vec(), v.to_vec());
    system.normalize(&mut assembled);
    let before = metric.level(t, &assembled, &rates);
    let is_beside = match coordinates {
        None => {
            position::close(&mut metric, t, &mut assembled)?;
            metric.is_beside
        }
        Some(coordinates) => {
            let all = &mut Metric::new(coordinates, directions.clone());
            reach::reach(&mut metric, all, t, &mut assembled)?;
            metric.is_beside || all.is_beside
        }
    };
    match velocities {
        None => velocity::fit(&mut metric, t, &assembled, &mut rates)?,
        Some(velocities) => velocity::fit(&mut Metric::new(velocities, directions), t, &assembled, &mut rates)?,
    }
    let after = metric.level(t, &assembled, &rates);
    let mut dynamics = Dynamics::new(system);
    dynamics.solve(t, &assembled, &rates, |_, _| 0.0).map_err(|halt| {
        let force = system.infinite_force(t, &assembled, &rates, &mut Scratch::default());
        force.map_or_else(|| stuck(&halt), |name| stuck(&halt).element(&name))
    })?;
    let moves = report::moves(system, (q, v), (&assembled, &rates));
    let Dynamics { vdot, lambda, .. } = dynamics;
    Ok(Assembly { q: assembled, v: rates, vdot, lambda, before, after, moves, is_beside })
}

/// Error for a start that is consistent, but has no acceleration.
fn stuck(halt: &StepError) -> Error {
    let error = Error::input(format!("at the start, {halt}"));
    match halt {
        StepError::Term(term) => error
            .under(if term.starts_with("the force") { "forces" } else { "joints" })
            .hint("look for roots and quotients in expressions, for `floor` and `mod` beyond 2^29, and for springs of length zero"),
        StepError::Undetermined(_) => {
            error.under("bodies").hint("give the body mass and inertia, or hold it by joints")
        }
        _ => error.under("bodies").hint("masses, inertias or forces are too large or too small to compute with"),
    }
}

/// The mass metric with the constraints and the held directions as rows.
struct Metric<'a> {
    system: &'a dyn MechanicalSystem,
    terms: Terms,
    scratch: Scratch,
    kkt: SaddlePoint,
    mass: Arc<Pattern>,
    rows: Arc<Pattern>,
    weights: Vec<f64>,
    values: Vec<f64>,
    scales: Vec<f64>,
    held: Vec<usize>,
    /// phi of a state on the way, which counts as closed; none: zero.
    ahead: Vec<f64>,
    /// Rows that are dropped.
    without: Vec<usize>,
    still: Vec<f64>,
    bodies_that_turn: usize,
    /// True if the joints closed from beside the guess.
    is_beside: bool,
}

impl<'a> Metric<'a> {
    fn new(system: &'a dyn MechanicalSystem, held: Vec<usize>) -> Self {
        let Structure { mass, g: mut rows, mut analysis, .. } = system.structure();
        if !held.is_empty() {
            let all = Arc::make_mut(&mut rows);
            all.entries.extend(held.iter().enumerate().map(|(i, &direction)| (all.rows + i, direction)));
            all.rows += held.len();
            analysis = Arc::default();
        }
        Metric {
            terms: Terms::new(system),
            scratch: Scratch::default(),
            kkt: SaddlePoint::sharing(&mass, &rows, &analysis),
            weights: vec![0.0; mass.entries.len()],
            still: vec![0.0; mass.rows],
            values: vec![1.0; rows.entries.len()],
            mass,
            rows,
            scales: system.scales(),
            held,
            ahead: Vec::new(),
            without: Vec::new(),
            is_beside: false,
            bodies_that_turn: system.turning_bodies().len(),
            system,
        }
    }

    fn evaluate(&mut self, t: f64, q: &[f64], v: &[f64], need: Need) {
        self.system.evaluate(t, q, v, need, &mut self.terms, &mut self.scratch);
        self.terms.phi.iter_mut().zip(&self.ahead).for_each(|(phi, ahead)| *phi -= ahead);
    }

    /// Drops these rows, and no others, from now on.
    fn drop_rows(&mut self, rows: &[usize]) {
        self.without = rows.to_vec();
        self.kkt.drop_rows(rows);
    }

    /// Evaluates the terms and factors the matrix at a state.
    fn at(&mut self, t: f64, q: &[f64], v: &[f64]) -> Result<()> {
        let need = Need::MASS | Need::CONSTRAINTS | Need::G;
        self.evaluate(t, q, v, need);
        if let Some(row) = self.infinite_row() {
            let group = self.system.groups().into_iter().find(|group| group.rows.contains(&row));
            let name = group.map_or(String::new(), |group| group.name);
            return Err(Error::input(format!("at the start, joint `{name}` or its rate is infinite or not a number"))
                .under("joints")
                .hint("begin where its expressions are defined and smooth (no division by zero, `floor` and `mod` up to 2^29), and no distance is zero"));
        }
        let most = largest(&self.terms.mass);
        let unit = if most > 0.0 { most } else { 1.0 };
        self.weights.copy_from_slice(&self.terms.mass);
        self.system.add_stiffness(&mut self.weights);
        for (weight, (i, j)) in self.weights.iter_mut().zip(&self.mass.entries) {
            *weight = if i == j { (*weight / unit).max(tolerances::LEAST_WEIGHT) } else { *weight / unit };
        }
        let n = self.terms.g.len();
        self.values[..n].copy_from_slice(&self.terms.g);
        let factored = self.kkt.factor(&self.weights, &self.values);
        factored.map_err(|singular| Error::input(format!("at the start, {singular}")))
    }

    /// The first constraint that is not finite, or whose rate or gradient is not.
    fn infinite_row(&self) -> Option<usize> {
        let Terms { phi, phi_dot, g, .. } = &self.terms;
        // At the branch point of a root a derivative is huge, not infinite.
        let position = |values: &[f64]| values.iter().position(|x| x.is_nan() || x.abs() >= 1e150);
        position(phi).or_else(|| position(phi_dot)).or_else(|| Some(self.rows.entries[position(g)?].0))
    }

    /// Solves [W G^T; G 0] [d; .] = [top; bottom], with d = 0 along the held directions, and writes d to `top`.
    fn solve(&mut self, top: &mut [f64], bottom: &[f64]) -> Result<()> {
        let mut rows = bottom.to_vec();
        rows.resize(self.rows.rows, 0.0);
        self.kkt.solve_motion(top, &mut rows).map_err(|singular| Error::input(format!("at the start, {singular}")))
    }

    /// W x
    fn weigh(&self, x: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; x.len()];
        self.mass.multiply_symmetric(&self.weights, x, &mut product);
        product
    }

    /// Residuals at a state, in units of the scene's scale.
    fn level(&mut self, t: f64, q: &[f64], v: &[f64]) -> Level {
        self.evaluate(t, q, v, Need::CONSTRAINTS);
        Level { phi: self.worst(&self.terms.phi), phi_dot: self.worst(&self.terms.phi_dot) }
    }

    /// Evaluates the constraints at q; returns |phi| in units of the scene's scale.
    fn residual(&mut self, t: f64, q: &[f64]) -> f64 {
        let still = std::mem::take(&mut self.still);
        self.evaluate(t, q, &still, Need::CONSTRAINTS);
        self.still = still;
        self.size_of_phi()
    }

    /// |phi| of the terms at hand, in units of the scene's scale; NaN where a row is not a number.
    fn size_of_phi(&self) -> f64 {
        let kept = (0..self.scales.len()).filter(|row| !self.without.contains(row));
        kept.map(|row| (self.terms.phi[row] / self.scales[row]).powi(2)).sum::<f64>().sqrt()
    }

    /// |phi| of some rows, as [`size_of_phi`](Self::size_of_phi).
    fn size_of(&self, rows: &[usize]) -> f64 {
        rows.iter().map(|row| (self.terms.phi[*row] / self.scales[*row]).powi(2)).sum::<f64>().sqrt()
    }

    /// The sum of rows of G times these weights.
    fn rows_times(&self, rows: &[usize], weights: &[f64]) -> Vec<f64> {
        let mut sum = vec![0.0; self.still.len()];
        for ((row, column), value) in self.rows.entries.iter().zip(&self.values) {
            if let Some(place) = rows.iter().position(|wanted| wanted == row) {
                sum[*column] += weights[place] * value;
            }
        }
        sum
    }

    /// |G_r d|^2 of rows r, in units of the scene's scale.
    fn squared_rates(&self, rows: &[usize], d: &[f64]) -> f64 {
        let mut rates = vec![0.0; rows.len()];
        for ((row, column), value) in self.rows.entries.iter().zip(&self.values) {
            if let Some(place) = rows.iter().position(|wanted| wanted == row) {
                rates[place] += value * d[*column] / self.scales[*row];
            }
        }
        rates.iter().map(|rate| rate * rate).sum()
    }

    /// True if the terms at hand, those at q, are closed: up to a part of the scene's lengths and the round-off of its
    /// largest coordinate.
    fn is_closed(&self, q: &[f64]) -> bool {
        let rounding = tolerances::ROUND_OFF * largest(self.system.own(q));
        let mut kept = (0..self.scales.len()).filter(|row| !self.without.contains(row));
        kept.all(|row| self.terms.phi[row].abs() <= tolerances::CLOSED * self.scales[row] + rounding)
    }

    /// q = start + factor N d
    fn go(&self, start: &[f64], d: &[f64], factor: f64, q: &mut [f64]) {
        let mut rate = vec![0.0; q.len()];
        self.system.rate(start, d, &mut rate);
        q.iter_mut().zip(start).zip(&rate).for_each(|((q, start), rate)| *q = start + factor * rate);
        self.system.normalize(q);
    }

    /// The largest rotation of a body along a step, rad.
    fn largest_turn(&self, q: &[f64], d: &[f64]) -> f64 {
        let mut turns = vec![0.0; self.bodies_that_turn];
        self.system.spins(q, d, &mut turns);
        largest(&turns)
    }

    /// d^T W d
    fn distance(&self, d: &[f64]) -> f64 {
        d.iter().zip(self.weigh(d)).map(|(d, weighed)| d * weighed).sum()
    }

    /// W_ii
    fn inertia(&self, direction: usize) -> f64 {
        let entries = self.mass.entries.iter().zip(&self.weights);
        entries.filter(|(place, _)| **place == (direction, direction)).map(|(_, weight)| *weight).sum()
    }

    fn worst(&self, rows: &[f64]) -> f64 {
        largest_in(&self.scales, rows)
    }

    /// True if some rows give joint coordinates their values at the start.
    fn has_initial(&self) -> bool {
        self.system.groups().iter().any(|group| group.kind == INITIAL)
    }

    /// The joints with the largest residuals, for a message.
    fn culprits(&self, rows: &[f64]) -> String {
        let worst = self.worst(rows);
        let mut gaps: Vec<(String, f64)> = Vec::new();
        for group in self.system.groups() {
            let gap = group.rows.clone().fold(0.0f64, |gap, row| gap.max((rows[row] / self.scales[row]).abs()));
            if gap > 0.01 * worst {
                gaps.push((group.name, group.rows.map(|row| rows[row].abs()).fold(0.0, f64::max)));
            }
        }
        gaps.sort_by(|a, b| b.1.total_cmp(&a.1));
        let more = gaps.len().saturating_sub(5);
        let shown: Vec<String> = gaps.iter().take(5).map(|(name, gap)| format!("`{name}` {}", short(*gap))).collect();
        let tail = if more > 0 { format!(" and {more} more") } else { String::new() };
        format!("{}{tail}", shown.join(", "))
    }
}
