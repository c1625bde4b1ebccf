//! One step: attempt, projection and error test.

use super::TimeLoop;
use super::rows::project;
use crate::formulation::StepError;
use crate::integrator::StepStart;
use crate::math::largest;
use crate::system::{Dimensions, Energy};
use crate::tolerances;
use crate::tolerances::ROUND_OFF_OF_SOLUTIONS;

/// Round-off of a projection where the rows of G are well apart: near a singular state it is that over the square of
/// the rank indicator. Unit: `[1]` of the largest state. Why: two operations; with ROUND_OFF, twice as much, motions
/// leave their branch. Test: `every_passage_is_counted_and_none_is_called_left`.
const PROJECTION_ROUND_OFF: f64 = 8.0 * f64::EPSILON;

/// Sweeps of a projection near a singular state. Unit: `[sweeps]`. Why: one leaves errors of the positions, over the
/// rank indicator, in the velocities. Test: `from_rest_at_a_change_point_it_goes_where_it_is_pushed_or_says_why_not`.
const SINGULAR_SWEEPS: usize = 2;

/// A correction of a projection above which it refuses the step. Unit: `[tolerated errors]`.
const FAR_CORRECTION: f64 = 10.0;

/// Change of the energy balance that refuses a step near a singular state. Unit: `[1]` of that by the tolerated errors
/// of the state. Why: steps of `dop853` at 1e-5 and 1e-10 change it by 1.2 at most in 35 shipped scenes; wrong ones
/// over flat states by up to a hundred. Test: `flat_states_are_passed_at_any_tolerance`.
const SINGULAR_ENERGY: f64 = 2.0;

/// Round-off of a projection above which a state is too near to a singular one. Unit: `[tolerated errors]`. Test:
/// `from_rest_at_a_change_point_it_goes_where_it_is_pushed_or_says_why_not`.
const SINGULAR_ROUND_OFF: f64 = 1e3;

/// True if an error in units of the tolerance refuses a step.
pub fn is_too_large(error: f64) -> bool {
    error > 1.0 || error.is_nan()
}

impl TimeLoop<'_> {
    /// Tries one step of size `h` with its projection, and writes y' at the new state to `next_slope`. Returns the error
    /// in units of the tolerance, if there is an estimate.
    pub fn step(&mut self, h: f64, end: Option<f64>) -> Result<Option<f64>, StepError> {
        let error = self.attempt(h, end)?;
        let is_singular = self.is_singular(h);
        if error.is_some_and(is_too_large) && !is_singular {
            self.refusal = "the error of a step stays above the tolerance";
            return Ok(error);
        }
        let t = self.end_of(h, end);
        let mut error = self.project_step(h, end, error, is_singular)?;
        self.lost = None;
        if is_singular && error.is_some_and(|error| !is_too_large(error)) {
            error = error.map(|error| error.max(self.error_by_energy(t)));
        }
        if error.is_some_and(is_too_large) {
            return Ok(error);
        }
        match self.integrator.last_slope() {
            Some(slope) if !self.is_moved => self.next_slope.copy_from_slice(slope),
            _ => self.problem.derivative(t, &self.next, &mut self.next_slope)?,
        }
        if self.dropped_rows_open() {
            self.release_rows()?;
            return self.step(h, end);
        }
        Ok(error)
    }

    /// Restores all dropped constraints from the last state on, which is projected on them first.
    fn release_rows(&mut self) -> Result<(), StepError> {
        self.drop_rows(&[]);
        project(self.t, &mut self.y, &mut self.problem, &mut self.projection, SINGULAR_SWEEPS)?;
        self.problem.derivative(self.t, &self.y, &mut self.slope)
    }

    /// True if a step of size `h` comes near a singular state, where it is projected with more sweeps.
    fn is_singular(&self, h: f64) -> bool {
        self.projection.is_some() && self.approach.reaches(h)
    }

    /// Number of sweeps of the projection in a step of size `h`.
    pub fn sweeps(&self, h: f64) -> usize {
        if self.is_singular(h) { SINGULAR_SWEEPS } else { 1 }
    }

    /// True if states at the ends of steps satisfy the constraints, by a projection or by the formulation.
    pub fn keeps_constraints(&self) -> bool {
        self.projection.is_some() || self.problem.formulation.keeps_constraints()
    }

    fn attempt(&mut self, h: f64, end: Option<f64>) -> Result<Option<f64>, StepError> {
        let end = self.end_of(h, end);
        let from = StepStart { t: self.t, y: &self.y, slope: &self.slope, h, end, tolerance: &self.tolerance };
        self.problem.begin_step(self.t, &self.y)?;
        let error = self.integrator.attempt(&mut self.problem, from, &mut self.next)?;
        Ok(if self.fixed.is_some() { None } else { error })
    }

    /// Projects the new state, and refuses it if that moves it too far.
    fn project_step(
        &mut self,
        h: f64,
        end: Option<f64>,
        error: Option<f64>,
        is_singular: bool,
    ) -> Result<Option<f64>, StepError> {
        self.change.copy_from_slice(&self.next);
        let t = self.end_of(h, end);
        let sweeps = self.sweeps(h);
        self.problem.dynamics.ends_near = self.entry.ends_near && !is_singular;
        project(t, &mut self.next, &mut self.problem, &mut self.projection, sweeps)?;
        self.problem.dynamics.ends_near = false;
        self.is_moved = self.projection.is_some() || self.change != self.next;
        if error.is_none() || !self.is_moved {
            return Ok(error);
        }
        let correction = self.correction();
        // `allowed` is at least one.
        let is_far = self.limits_projection
            && correction > FAR_CORRECTION
            && correction > FAR_CORRECTION * (self.allowed() + self.left_open()?);
        if is_singular && (is_far || error.is_some_and(is_too_large)) {
            self.refusal = "the error of a step over a singular state stays above the tolerance";
            return self.error_within_constraints(t, h);
        }
        self.refusal = "the projection moves the state by far more than the tolerance (is the start consistent?)";
        Ok(if is_far { Some(correction) } else { error })
    }

    pub fn drop_rows(&mut self, rows: &[usize]) {
        self.problem.dynamics.drop_rows(rows);
        self.rows.problem.dynamics.drop_rows(rows);
    }

    /// True if constraints that depended on the others at the start, and were dropped, are violated now: then the
    /// start was a singular state, and they are independent elsewhere.
    fn dropped_rows_open(&self) -> bool {
        let dynamics = &self.problem.dynamics;
        if dynamics.dropped.is_empty() {
            return false;
        }
        let relative = |row: usize| dynamics.terms.phi[row].abs() / self.scales[row];
        let kept = (0..self.scales.len()).filter(|row| !dynamics.dropped.contains(row)).map(relative);
        // Drift may open them all.
        let most = tolerances::ROUND_OFF_OF_PHI + 1e3 * kept.fold(0.0, f64::max);
        dynamics.dropped.iter().any(|row| relative(*row) > most)
    }

    /// Distance by which the projection moved the state, in units of the tolerance; `change` contains the state before.
    fn correction(&mut self) -> f64 {
        self.change.iter_mut().zip(&self.next).for_each(|(change, next)| *change -= next);
        if !self.tests_velocities {
            self.problem.split_mut(&mut self.change).1.fill(0.0);
        }
        self.tolerance.norm(&self.next, &self.change)
    }

    /// How far the last projection left the state, before the step, off the constraints, in units of the tolerance: no
    /// step from there can end nearer. Zero at the start, which is to satisfy them.
    fn left_open(&mut self) -> Result<f64, StepError> {
        if self.problem.dynamics.statistics.steps == 0 {
            return Ok(0.0);
        }
        self.change.copy_from_slice(&self.y);
        project(self.t, &mut self.change, &mut self.problem, &mut self.projection, SINGULAR_SWEEPS)?;
        self.change.iter_mut().zip(&self.y).for_each(|(change, y)| *change -= y);
        if !self.tests_velocities {
            self.problem.split_mut(&mut self.change).1.fill(0.0);
        }
        Ok(self.tolerance.norm(&self.y, &self.change))
    }

    /// Error of the projected step, in units of the tolerance: its difference to the projected solution of lower order.
    /// Near a singular state the stages are far off along the nearly dependent rows, and the projection removes that
    /// from both, so that the error before it is no measure.
    fn error_within_constraints(&mut self, t: f64, h: f64) -> Result<Option<f64>, StepError> {
        let from = StepStart { t: self.t, y: &self.y, slope: &self.slope, h, end: t, tolerance: &self.tolerance };
        if !self.integrator.lower_order(from, &mut self.change) {
            return Ok(Some(f64::NAN));
        }
        project(t, &mut self.change, &mut self.problem, &mut self.projection, SINGULAR_SWEEPS)?;
        self.change.iter_mut().zip(&self.next).for_each(|(change, next)| *change -= next);
        Ok(Some(self.tolerance.norm_between(&self.y, &self.next, &self.change) / self.allowed()))
    }

    /// Change of the energy balance in the step to `t`, over the largest that is accepted. Where stages are off along
    /// nearly dependent rows, the solutions of both orders may be wrong alike; their energy is not. Over a singular
    /// state that change is also compared with those of the steps before.
    fn error_by_energy(&mut self, t: f64) -> f64 {
        let tolerated = self.tolerated_energy();
        let TimeLoop { problem, y, next, .. } = self;
        let Dimensions { q: nq, v: nv, .. } = problem.dynamics.system.dimensions();
        // The balance, and the size of the energies, whose rounding changes it.
        let mut balance = |t: f64, y: &[f64]| {
            let (q, v) = problem.split(y);
            let Energy { kinetic, potential } =
                problem.dynamics.system.energy(t, q, v, &mut problem.dynamics.scratch)?;
            Some((kinetic + potential - y[nq + nv], kinetic + potential.abs() + y[nq + nv].abs()))
        };
        let Some(((start, _), (end, size))) = balance(self.t, y).zip(balance(t, next)) else { return 0.0 };
        let lost = (end - start).abs();
        let round_off = ROUND_OFF_OF_SOLUTIONS * size;
        // Less moves the motion by less than the tolerance.
        let is_seen = lost > 0.1 * tolerated + round_off;
        if is_seen && self.approach.refuses(lost) {
            self.refusal = "the energy balance changes by far more than in the steps before";
            // The next step is shorter by a half or so.
            return 100.0;
        }
        self.lost = Some(lost.max(round_off));
        lost / (SINGULAR_ENERGY * tolerated + round_off)
    }

    /// The error to be accepted, in units of the tolerance. Round-off of the largest coordinate moves all parts that
    /// nearly dependent rows connect by eps over the rank indicator, and velocities by eps over its square: no step can
    /// be more accurate.
    fn allowed(&mut self) -> f64 {
        let dynamics = &self.problem.dynamics;
        let rank_indicator =
            self.approach.rank_indicator.min(dynamics.rank_indicator.unwrap_or_else(|| dynamics.kkt.rank_indicator()));
        let (q, v) = self.problem.split(&self.next);
        let sizes = [largest(dynamics.system.dimensions().without_turns(q)), largest(v)];
        let n = q.len();
        self.change[..n].fill(sizes[0]);
        self.change[n..].fill(sizes[1]);
        let round_off =
            PROJECTION_ROUND_OFF / (rank_indicator * rank_indicator) * self.tolerance.norm(&self.next, &self.change);
        1.0 + round_off.min(SINGULAR_ROUND_OFF)
    }
}
