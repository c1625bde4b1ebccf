//! Checkpoints: a run saved between two of its steps, and continued from there.

use super::crowd::Crowd;
use super::passage::SingularPassage;
use super::{Method, Sink, Span, TimeLoop};
use crate::error::{Error, Failure, Result, clock, short};
use crate::formulation::Statistics;
use crate::math::expression::Switch;
use crate::math::{Piece, Thresholds};
use crate::system::{MechanicalSystem, Need, Scratch, Terms, check_start};
use crate::tolerances::TOLD;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// The values that a run carries from one accepted step to the next: the state, and the adaptive quantities. A run of
/// the same method and span that continues from here is bit by bit the uninterrupted one; a step that was left among its
/// rows it takes again, and counts twice. JSON preserves it exactly.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint {
    method: Method,
    span: Span,
    t: f64,
    /// q, v, and the works since the start.
    pub(super) y: Vec<f64>,
    /// Rows of G that are dropped.
    dropped: Vec<usize>,
    /// The pieces on which functions are fixed, their next change at a given time, the time up to which functions of
    /// time are resolved, and which of these have no useful enclosures.
    pieces: Vec<Piece>,
    next_change: Option<f64>,
    watched: (Option<f64>, Vec<bool>),
    turned: Vec<u8>,
    turned_at: Vec<f64>,
    crowd: Crowd,
    /// The rank indicator at the last states with its reference value, and the reference value of a dense solver.
    approach: SingularPassage,
    dense_reference: f64,
    formulation: Vec<f64>,
    /// The memory of the integrator; none in files of earlier versions, where it had another form and name.
    #[serde(default)]
    memory: Option<Value>,
    h: f64,
    growing: bool,
    cut: Option<f64>,
    divided: f64,
    progress: (f64, usize),
    next_row: u64,
    /// Time of the last row that was shown, s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    shown: Option<f64>,
    factored: u64,
    statistics: Statistics,
    /// Values of the inputs.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    inputs: Vec<f64>,
}

/// The start of a run.
#[derive(Clone, Copy, Debug)]
pub enum Start<'a> {
    /// At (q, v), which should be consistent.
    State(&'a [f64], &'a [f64]),
    /// At a checkpoint: with all that it carries if the method is the same, else anew from its state.
    Saved(&'a Checkpoint),
}

impl<'a> From<(&'a [f64], &'a [f64])> for Start<'a> {
    fn from(state: (&'a [f64], &'a [f64])) -> Self {
        Start::State(state.0, state.1)
    }
}

impl<'a, Q: AsRef<[f64]>, V: AsRef<[f64]>> From<&'a (Q, V)> for Start<'a> {
    fn from(state: &'a (Q, V)) -> Self {
        Start::State(state.0.as_ref(), state.1.as_ref())
    }
}

impl<'a> From<&'a Checkpoint> for Start<'a> {
    fn from(saved: &'a Checkpoint) -> Self {
        Start::Saved(saved)
    }
}

/// (q, v, w) at the `start` (q, v) of a run, which the system must not refuse.
pub fn flat(system: &dyn MechanicalSystem, t: f64, start: (&[f64], &[f64])) -> Result<Vec<f64>> {
    let (q, v) = start;
    check_start(system, t, q, v)?;
    Ok([q, v, &vec![0.0; 1 + system.facts().works.len()]].concat())
}

impl Checkpoint {
    /// The time of the state, s.
    pub fn t(&self) -> f64 {
        self.t
    }

    /// The method of the run that was saved.
    pub fn method(&self) -> &Method {
        &self.method
    }

    /// True if the method continues with the values it carried; else it begins anew, and the run is the same within the
    /// tolerance only.
    pub fn is_exact(&self) -> bool {
        self.memory.is_some()
    }

    /// Refuses a state that is not finite, and one at which the joints are open by more than a run tolerates.
    ///
    /// # Errors
    /// Such a state, with the joint.
    pub fn check(&self, system: &dyn MechanicalSystem) -> Result<()> {
        if !self.fits(system) {
            return Err(Error::input("the saved run is one of another system"));
        }
        if self.y.iter().chain([&self.h, &self.t]).any(|value| !value.is_finite()) {
            return Err(Error::input("the saved state is not finite").hint("begin anew without --start"));
        }
        let n = system.dimensions();
        let q = &self.y[..n.q];
        let v = &self.y[n.q..n.q + n.v];
        let mut terms = Terms::new(system);
        let mut scratch = Scratch::default();
        system.evaluate(self.t, q, v, Need::CONSTRAINTS, &mut terms, &mut scratch);
        let scales = system.facts().scales.clone();
        let gap = |row: usize| terms.phi[row].abs() / scales[row];
        let widest = (0..n.lambda).max_by(|a, b| gap(*a).total_cmp(&gap(*b)));
        let Some(row) = widest.filter(|row| gap(*row).is_nan() || gap(*row) > TOLD) else { return Ok(()) };
        let group = system.facts().groups().into_iter().find(|group| group.rows.contains(&row));
        let name = group.map_or(String::new(), |group| group.name);
        let gap = short(terms.phi[row]);
        Err(Error::input(format!("`{name}` is open by {gap} (m, rad) at the saved state, at t = {} s", clock(self.t)))
            .hint("name the summary.json of a run whose joints held, or begin anew without --start"))
    }

    /// True if the dimensions agree with those of the system.
    fn fits(&self, system: &dyn MechanicalSystem) -> bool {
        let n = system.dimensions();
        let switches = system.switches().all;
        let exists = |piece: usize, s: &Switch| match s.thresholds {
            Thresholds::Held => piece <= 6,
            _ => piece < 2 || s.thresholds.get(piece.div_ceil(2) - 1).is_some(),
        };
        let are_pieces = self.pieces.iter().zip(switches).all(|(&piece, switch)| exists(piece as usize, switch));
        let lengths = [self.y.len(), self.turned_at.len(), self.pieces.len(), self.turned.len()];
        let facts = system.facts();
        let length = n.q + n.v + 1 + facts.works.len();
        lengths == [length, length, switches.len(), switches.len()]
            && (self.inputs.is_empty() || self.inputs.len() == facts.inputs.len())
            && self.statistics.is_possible()
            && are_pieces
            && self.dropped.iter().all(|row| *row < n.lambda)
            && self.h > 0.0
    }

    /// Refuses a checkpoint of another system, and one at or beyond the end of the span.
    pub(super) fn checked(&self, system: &dyn MechanicalSystem, span: Span) -> Result<&Self> {
        if !self.fits(system) {
            return Err(Error::input("the saved run is one of another system"));
        }
        if self.t < span.end && self.t >= span.start {
            Ok(self)
        } else {
            Err(Error::input(format!("nothing to simulate from {} s to {} s", self.t, span.end))
                .hint("the saved run has come to that end: go on to a later one with --until"))
        }
    }
}

impl TimeLoop<'_> {
    /// Saves the values on which the next steps depend.
    pub fn checkpoint(&self, method: &Method) -> Checkpoint {
        let dynamics = &self.problem.dynamics;
        let timetable = &self.events.timetable;
        Checkpoint {
            method: method.clone(),
            span: self.span,
            t: self.t,
            y: self.y.clone(),
            dropped: dynamics.dropped.clone(),
            pieces: self.events.pieces.clone(),
            next_change: timetable.next_change(),
            watched: timetable.watch.memory(),
            turned: self.events.turned.clone(),
            turned_at: self.turned_at.clone(),
            crowd: self.crowd,
            approach: self.approach,
            dense_reference: dynamics.dense_reference,
            formulation: self.problem.formulation.settled(),
            memory: self.integrator.memory(),
            h: self.h,
            growing: self.growing,
            cut: self.cut,
            divided: self.divided,
            progress: self.progress,
            next_row: self.rows.next,
            shown: self.rows.shown.is_finite().then_some(self.rows.shown),
            factored: self.factored,
            statistics: self.statistics(),
            inputs: dynamics.scratch.inputs.clone(),
        }
    }

    /// Continues from a checkpoint, and shows its state, as at any start.
    pub fn go_on_from(&mut self, saved: &Checkpoint, method: &Method, sink: &mut dyn Sink) -> Result<(), Failure> {
        self.t = saved.t;
        let law = self.problem.dynamics.law.clone();
        self.set_inputs(&saved.inputs, law.as_ref());
        if saved.method == *method {
            self.recall(saved)?;
        } else {
            self.go_on(&saved.dropped, 0.0)?;
            // The choice of the first step evaluated the terms ahead.
            self.problem.derivative(self.t, &self.y, &mut self.slope).map_err(|halt| self.halted(&halt))?;
        }
        let rank_indicator = (self.approach != SingularPassage::default()).then_some(self.approach.rank_indicator);
        self.show(rank_indicator, self.fixed, sink);
        self.rows.y.copy_from_slice(&self.y);
        self.rows.emit(self.t, sink).map_err(|halt| self.halted(&halt))?;
        if saved.method == *method {
            // The work of the saved run includes that of this row.
            self.rows.problem.dynamics.statistics = saved.statistics.rows.into();
            self.rows.shown = saved.shown.unwrap_or(f64::NEG_INFINITY);
        }
        let is_same = self.span.start == saved.span.start && self.span.output_step == saved.span.output_step;
        // A row at the very time of the state may have been written, or not.
        let is_next = saved.next_row.abs_diff(self.next_row()) <= 1;
        self.rows.next = if is_same && is_next { saved.next_row } else { self.next_row() };
        Ok(())
    }

    /// The first row after the state.
    pub fn next_row(&self) -> u64 {
        let Span { start, output_step, .. } = self.span;
        1 + ((self.t - start) / output_step * (1.0 + 4.0 * f64::EPSILON)) as u64
    }

    fn recall(&mut self, saved: &Checkpoint) -> Result<(), Failure> {
        self.problem.formulation.recall(&saved.formulation);
        self.rows.problem.formulation.recall(&saved.formulation);
        if let Some(memory) = &saved.memory {
            self.integrator.recall(memory);
        }
        self.approach = saved.approach;
        self.crowd = saved.crowd;
        self.divided = saved.divided;
        self.h = saved.h;
        self.growing = saved.growing;
        self.cut = saved.cut;
        self.progress = saved.progress;
        self.factored = saved.factored;
        self.turned_at.clone_from(&saved.turned_at);
        self.drop_rows(&saved.dropped);
        self.refer_to(saved.dense_reference);
        self.recall_events(saved);
        self.start_gaps();
        self.evaluate_start()?;
        // The work of the saved run includes that of this evaluation.
        self.problem.dynamics.statistics = saved.statistics;
        Ok(())
    }

    fn recall_events(&mut self, saved: &Checkpoint) {
        let TimeLoop { events, t, .. } = self;
        events.pieces.clone_from(&saved.pieces);
        events.turned.clone_from(&saved.turned);
        events.timetable.recall(*t, saved.next_change, saved.span.end, &saved.pieces);
        events.timetable.watch.recall(saved.watched.0, &saved.watched.1);
        self.share_pieces();
    }
}
