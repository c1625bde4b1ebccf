//! Change of the form of the equations at a state.

use super::events::{Passage, Turn};
use super::roots::Root;
use super::rows::project;
use super::{Sink, TimeLoop};
use crate::error::{Failure, two_digits};
use crate::formulation::{Dynamics, StepError};
use crate::integrator::{Step, StepStart};
use crate::math::{Piece, largest};
use crate::system::{Need, OperatingPoint, Road, Scratch};
use crate::tolerances;

const CONTINUOUS: &str = "write a law that passes through zero steadily, such as `tanh(x/width)` in the place of \
     `sign(x)`, or `smoothstep` in the place of `step` and `if`";

const BEYOND: &str = "give the signal more points, or \"beyond\": \"hold\" or \"repeat\"; or end the run before";

const STEEP: &str = "make the edge a ramp, with a signal that is \"linear\" or \"cubic\", or `smoothstep` in the place \
     of `step`; or give the tyre no damping";

impl TimeLoop<'_> {
    /// The first threshold passed in the step just tried. A method that begins anew there ends on its dense output.
    pub fn end_at_passage(
        &mut self,
        h: &mut f64,
        end: &mut Option<f64>,
        sink: &mut dyn Sink,
    ) -> Result<Option<Passage>, StepError> {
        let mut passage = self.passage(*h, self.end_of(*h, *end), sink)?;
        for _ in 0..tolerances::CUTS {
            let own = passage.filter(|_| self.entry.begins_anew);
            let Some(Passage::Within(theta)) = own else { break };
            let step_end = self.end_of(*h, *end);
            let from = StepStart {
                t: self.t,
                y: &self.y,
                slope: &self.slope,
                h: *h,
                end: step_end,
                tolerance: &self.tolerance,
            };
            let step = Step { from, to: &self.next, slope: &self.next_slope };
            self.integrator.interpolate(&mut self.rows.problem, step, theta, &mut self.change)?;
            self.next.copy_from_slice(&self.change);
            (*h, *end, self.is_moved) = (theta * *h, None, true);
            let t = self.t + *h;
            let sweeps = self.sweeps(*h);
            project(t, &mut self.next, &mut self.problem, &mut self.rows.projection, sweeps)?;
            self.problem.derivative(t, &self.next, &mut self.next_slope)?;
            passage = self.passage(*h, t, sink)?;
        }
        Ok(passage)
    }

    /// The first threshold or root in the step of size `h` to `end`.
    fn passage(&mut self, h: f64, end: f64, sink: &mut dyn Sink) -> Result<Option<Passage>, StepError> {
        let threshold = self.threshold(h, end)?;
        if let Some(Passage::AtStart(_)) = threshold {
            return Ok(threshold);
        }
        Ok(match (threshold, self.root_within(h, end, sink)?) {
            (_, Some(Root::AtStart)) => Some(Passage::OfRoot),
            (Some(Passage::Within(a)), Some(Root::Within(b))) => Some(Passage::Within(a.min(b))),
            (None, Some(Root::Within(theta))) => Some(Passage::Within(theta)),
            (threshold, _) => threshold,
        })
    }

    /// The first threshold in the step of size `h` to `end`.
    fn threshold(&mut self, h: f64, end: f64) -> Result<Option<Passage>, StepError> {
        if !self.events.watches_state() {
            return Ok(None);
        }
        let mut prepared = false;
        let TimeLoop { events, rows, integrator, problem, .. } = self;
        let from = StepStart { t: self.t, y: &self.y, slope: &self.slope, h, end, tolerance: &self.tolerance };
        let step = Step { from, to: &self.next, slope: &self.next_slope };
        let (q, v) = problem.split(step.to);
        let (_, vdot) = problem.split(step.slope);
        events.passage(h, OperatingPoint { t: end, q, v, vdot, lambda: &[] }, |theta, see| {
            if !std::mem::replace(&mut prepared, true) {
                rows.problem.begin_step(from.t, from.y)?;
                integrator.prepare(&mut rows.problem, step)?;
            }
            integrator.interpolate(&mut rows.problem, step, theta, &mut rows.y)?;
            let (q, v) = rows.problem.split(&rows.y);
            see(OperatingPoint { t: from.t + theta * h, q, v, vdot: &[], lambda: &[] });
            Ok::<(), StepError>(())
        })
    }

    /// Starts the run with the pieces of its start.
    pub fn begin_form(&mut self) -> Result<(), Failure> {
        if !self.events.has_thresholds() {
            return Ok(());
        }
        let (q, v) = self.problem.split(&self.y);
        self.events.begin(OperatingPoint { t: self.t, q, v, vdot: &vec![0.0; v.len()], lambda: &[] });
        self.enter_form()
    }

    /// Changes the form at the present state: at a given time, and where a step ended at a threshold or
    /// cannot begin. The next step is small where y' jumps.
    pub fn change_form(&mut self, at_start: Option<usize>) -> Result<(), Failure> {
        let before = self.slope.clone();
        let (roads, potential) = self.roads();
        let pieces = self.events.pieces.clone();
        let turns = self.events.turn(at_start);
        if let Some(&turn) = turns.first() {
            self.check_crowd(turn)?;
        }
        self.events.timetable.place(self.t, &mut self.events.pieces);
        self.enter_form()?;
        if let Some(turn) = self.events.driven_back(&turns) {
            let is_settled = self.events.try_other_side(turn) && {
                self.enter_form()?;
                self.events.driven_back(&turns).is_none()
            };
            if !is_settled {
                return Err(self.sliding(turn));
            }
        }
        self.meet_roads(roads, potential, &pieces)?;
        self.meet_jump(&before)
    }

    /// Goes on where y', which was `before`, may have jumped.
    pub fn meet_jump(&mut self, before: &[f64]) -> Result<(), Failure> {
        self.integrator.restart();
        self.cut = None;
        let jump: Vec<f64> = self.slope.iter().zip(before).map(|(after, before)| self.h * (after - before)).collect();
        let begins_anew = self.entry.begins_anew;
        if self.fixed.is_none() && (begins_anew || self.tolerance.norm(&self.y, &jump) > 1.0) {
            self.start_small()?;
        }
        Ok(())
    }

    /// As [`change_form`](Self::change_form), and shows the state before and after it.
    pub fn change_form_seen(&mut self, at_start: Option<usize>, sink: &mut dyn Sink) -> Result<(), Failure> {
        if !sink.watches_events() {
            return self.change_form(at_start);
        }
        self.show_event(false, sink)?;
        self.change_form(at_start)?;
        self.show_event(true, sink)
    }

    fn show_event(&mut self, is_after: bool, sink: &mut dyn Sink) -> Result<(), Failure> {
        self.rows.y.copy_from_slice(&self.y);
        self.rows.show_event(self.t, is_after, sink).map_err(|halt| self.halted(&halt))
    }

    /// Changes the form where a run is continued from a time at which functions of time change theirs.
    pub fn meet_change(&mut self) -> Result<(), Failure> {
        match self.events.timetable.next_change() {
            Some(t) if t <= self.t => self.change_form(None),
            _ => Ok(()),
        }
    }

    /// Makes the next step not longer than one whose error is estimated to be about the tolerance.
    fn start_small(&mut self) -> Result<(), Failure> {
        let first = self.estimated_step().map_err(|halt| self.halted(&halt))?;
        let step = 100f64.powf(1.0 / self.integrator.control().order as f64) * first;
        self.h = self.h.min(step.max(2.0 * self.smallest()));
        Ok(())
    }

    /// Evaluates the present state with the pieces of the events.
    fn enter_form(&mut self) -> Result<(), Failure> {
        if let Some((number, signal)) = self.events.undefined() {
            return Err(self.failure(signal.left_by(self.events.owner(number)), Some(BEYOND)));
        }
        let before = self.constraints();
        self.share_pieces();
        self.meet_constraints(before)?;
        self.evaluate_start()
    }

    /// Evaluates y' and the switching functions at the start of the next step.
    pub fn evaluate_start(&mut self) -> Result<(), Failure> {
        self.problem.derivative(self.t, &self.y, &mut self.slope).map_err(|halt| self.halted(&halt))?;
        let (q, v) = self.problem.split(&self.y);
        let (_, vdot) = self.problem.split(&self.slope);
        self.events.start_at(OperatingPoint { t: self.t, q, v, vdot, lambda: &[] });
        Ok(())
    }

    /// Evaluates all on the pieces of the events from now on.
    pub fn share_pieces(&mut self) {
        for dynamics in [&mut self.problem.dynamics, &mut self.rows.problem.dynamics] {
            dynamics.scratch.pieces.clone_from(&self.events.pieces);
        }
    }

    /// phi and phi' at the present state.
    fn constraints(&mut self) -> [Vec<f64>; 2] {
        let (q, v) = self.problem.split(&self.y);
        let dynamics = &mut self.problem.dynamics;
        dynamics.evaluate(self.t, q, v, Need::DYNAMICS);
        [dynamics.terms.phi.clone(), dynamics.terms.phi_dot.clone()]
    }

    /// Where a prescribed motion has a kink, the velocities jump with it: M (v_1 - v_0) + G^T p = 0 with G v_1 + phi_t
    /// as before, p the impulses of the joints, whose work is that of the drive. A prescribed motion itself must not
    /// jump.
    fn meet_constraints(&mut self, before: [Vec<f64>; 2]) -> Result<(), Failure> {
        let [phi, phi_dot] = before;
        let [now, rate] = self.constraints();
        let jumps = |new: &[f64], old: &[f64]| new.iter().zip(old).map(|(new, old)| new - old).collect::<Vec<f64>>();
        let jump = jumps(&now, &phi);
        let kink = jumps(&rate, &phi_dot);
        if let Some(row) = (0..jump.len()).find(|&row| jump[row].abs() > tolerances::SAME * self.scales[row]) {
            let names = self.problem.dynamics.system.facts().names.lambda.clone();
            let by = two_digits(jump[row].abs());
            let reason = format!("what `{}` prescribes jumps by {by} m or rad", names[row]);
            return Err(
                self.failure(reason, Some("prescribe a motion without jumps: no mechanism follows one in no time"))
            );
        }
        if largest(&kink) > tolerances::SAME * (largest(&rate) + largest(self.problem.split(&self.y).1)) {
            self.kick(&kink).map_err(|halt| self.halted(&halt))?;
        }
        Ok(())
    }

    /// Changes v by G dv = - `kink`, and counts the work.
    fn kick(&mut self, kink: &[f64]) -> Result<(), StepError> {
        let mut scratch = Scratch::default();
        let system = self.problem.dynamics.system;
        let t = self.t;
        let mut kinetic = |y: &[f64], run: &Self| {
            let (q, v) = run.problem.split(y);
            system.energy(t, q, v, &mut scratch).map_or(0.0, |energy| energy.kinetic)
        };
        let before = kinetic(&self.y, self);
        let dynamics = &mut self.problem.dynamics;
        dynamics.factor_truncated()?;
        let mut change = vec![0.0; dynamics.vdot.len()];
        dynamics.kkt.solve_projection(kink, &mut change)?;
        dynamics.kkt.forget();
        self.problem.split_mut(&mut self.y).1.iter_mut().zip(&change).for_each(|(v, change)| *v -= change);
        let work = kinetic(&self.y, self) - before;
        let moving = self.tolerance.motion();
        self.y[moving] += work;
        Ok(())
    }

    /// The roads under the wheels, and the potential energy, J.
    fn roads(&mut self) -> (Vec<Road>, f64) {
        let (q, v) = self.problem.split(&self.y);
        let Dynamics { system, scratch, .. } = &mut self.problem.dynamics;
        let potential = system.energy(self.t, q, v, scratch).map_or(0.0, |energy| energy.potential);
        (system.roads(self.t, q, v, scratch), potential)
    }

    /// A road that jumps does the work by which it loads the spring of a tyre. The damper of one would give the wheel
    /// the impulse c times the jump, for which it takes energy without bound.
    fn meet_roads(&mut self, roads: Vec<Road>, potential: f64, pieces: &[Piece]) -> Result<(), Failure> {
        let (now, loaded) = self.roads();
        let moving = self.tolerance.motion();
        self.y[moving] += loaded - potential;
        let same = tolerances::SAME * self.problem.dynamics.system.facts().length;
        let jump = |(old, new): &(Road, Road)| new.is_damped && (new.height - old.height).abs() > same;
        let Some((old, Road { tyre, height, .. })) = roads.into_iter().zip(now).find(jump) else { return Ok(()) };
        let signal = self.events.changed_signal(pieces, &format!("the force `{tyre}`"));
        let by = two_digits(height - old.height);
        let reason = format!("the road{signal} under `{tyre}` jumps by {by} m, which its damper cannot follow");
        Err(self.failure(reason, Some(STEEP)))
    }

    /// Failure of a law that drives the motion from both sides to the threshold at which it jumps.
    fn sliding(&self, turn: Turn) -> Failure {
        let owner = self.events.owner(turn.number);
        let reason = format!("{owner} jumps where it holds the motion: on each side it drives back to the other");
        self.failure(reason, Some(CONTINUOUS))
    }

    /// Ends a run whose form changes without end.
    fn check_crowd(&mut self, turn: Turn) -> Result<(), Failure> {
        let moved: Vec<f64> = self.y.iter().zip(&self.turned_at).map(|(y, before)| y - before).collect();
        self.crowd.add(self.t, turn.rate, self.tolerance.norm(&self.y, &moved) > 1.0);
        self.turned_at.clone_from(&self.y);
        let Some((count, within)) = self.crowd.endless(self.span.end - self.t) else { return Ok(()) };
        let owner = self.events.owner(turn.number);
        let reason = format!("{owner} changes its form without end, {count} times in {within:.1e} s");
        Err(self.failure(reason, Some(CONTINUOUS)))
    }
}
