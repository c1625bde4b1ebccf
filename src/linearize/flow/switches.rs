//! Motions through states at which the equations change their form, with the small changes beside them.

use super::{Bundle, Snapshot, flow};
use crate::error::Result;
use crate::formulation::ExponentialMap;
use crate::linearize::{Changes, State};
use crate::math::{Piece, Rate};
use crate::simulate::{Method, Observation, Sink, Span, simulate};
use crate::system::{MechanicalSystem, OperatingPoint, Scratch};
use crate::tolerances;

/// A change of form, with v' and the pieces before and after it.
struct Event {
    state: State,
    vdot: [Vec<f64>; 2],
    pieces: [Vec<Piece>; 2],
}

/// Collects the events of a run.
#[derive(Default)]
struct Events(Vec<Event>);

impl Sink for Events {
    fn watches(&self) -> bool {
        false
    }

    fn watches_events(&self) -> bool {
        true
    }

    fn before_event(&mut self, at: &Observation) {
        let state = State { t: at.t, q: at.q.to_vec(), v: at.v.to_vec() };
        let vdot = at.vdot.to_vec();
        let pieces = at.pieces.to_vec();
        self.0.push(Event { state, vdot: [vdot.clone(), vdot], pieces: [pieces.clone(), pieces] });
    }

    fn after_event(&mut self, state: &Observation) {
        if let Some(event) = self.0.last_mut() {
            event.vdot[1] = state.vdot.to_vec();
            event.pieces[1] = state.pieces.to_vec();
        }
    }
}

/// The same as [`flow`], where the motion and its columns change their form at the thresholds that the motion passes.
/// There the columns jump by the saltation matrix: with the threshold s = 0, its gradient n and x' = f,
///
/// ```text
/// dx+ = dx- + (f+ - f-) n^T dx- / (n^T f- + s_t)
/// ```
///
/// Leine, Nijmeijer, Dynamics and Bifurcations of Non-Smooth Mechanical Systems (2004), ch. 7.
///
/// # Errors
/// Those of [`flow`]; a motion that stays on a threshold.
pub fn flow_through(
    system: &dyn MechanicalSystem,
    bundle: &Bundle,
    times: &[f64],
    mut see: impl FnMut(&mut Snapshot) -> bool,
) -> Result<()> {
    let end = times.last().copied().unwrap_or(bundle.start.t);
    let events = events(system, &bundle.start, end)?;
    let mut bundle = bundle.clone();
    let mut times = times;
    for event in &events {
        let t = event.state.t;
        bundle.pieces.clone_from(&event.pieces[0]);
        let (before, rest) = times.split_at(times.partition_point(|time| *time < t));
        let mut here = None;
        let mut goes_on = true;
        flow(system, &bundle, &[before, &[t]].concat(), |snapshot| {
            if snapshot.motion.t == t {
                here = Some(snapshot.clone());
                return true;
            }
            goes_on = see(snapshot);
            goes_on
        })?;
        let Some(mut snapshot) = here.filter(|_| goes_on) else { return Ok(()) };
        jump(system, event, &mut snapshot.columns);
        times = rest;
        if times.first() == Some(&t) {
            times = &times[1..];
            if !see(&mut snapshot) {
                return Ok(());
            }
        }
        let Snapshot { motion: start, columns, basis, members } = snapshot;
        bundle = Bundle { start, columns, basis, members, pieces: event.pieces[1].clone(), ..bundle };
    }
    if times.is_empty() { Ok(()) } else { flow(system, &bundle, times, see) }
}

/// Returns the changes of form between a state and a time.
fn events(system: &dyn MechanicalSystem, start: &State, end: f64) -> Result<Vec<Event>> {
    if system.switches().all.is_empty() || end <= start.t {
        return Ok(Vec::new());
    }
    let method = Method { rtol: tolerances::FLOW_RTOL, atol: tolerances::TIGHTEST, ..Method::default() };
    let span = Span { start: start.t, end, output_step: end - start.t };
    let mut found = Events::default();
    let outcome = simulate(system, &method, span, (&start.q, &start.v), &mut found)?;
    if let Some(failure) = outcome.failure {
        return Err(failure.into());
    }
    found.0.retain(|event| event.state.t > start.t && event.state.t < end);
    // Several functions may change at one time: together they are one event.
    let mut events: Vec<Event> = Vec::new();
    for event in found.0 {
        match events.last_mut().filter(|last| last.state.t == event.state.t) {
            Some(last) => (last.vdot[1], last.pieces[1]) = (event.vdot[1].clone(), event.pieces[1].clone()),
            None => events.push(event),
        }
    }
    Ok(events)
}

/// Applies the saltation matrix to the columns.
fn jump(system: &dyn MechanicalSystem, event: &Event, columns: &mut Changes) {
    let [before, after] = &event.vdot;
    let jump: Vec<f64> = after.iter().zip(before).map(|(after, before)| after - before).collect();
    let changed = |i: &usize| event.pieces[0][*i] != event.pieces[1][*i];
    let mut arguments = Arguments::new(system, event);
    let State { q, v, .. } = &event.state;
    let rates = arguments.at(q, v);
    let switch = (0..rates.len().min(event.pieces[1].len())).filter(changed).find(|&i| rates[i].eps[0] != 0.0);
    let Some(switch) = switch.filter(|_| jump.iter().any(|jump| *jump != 0.0)) else { return };
    for (dq, mut dv) in columns.q.column_iter().zip(columns.v.column_iter_mut()) {
        let change = arguments.change(switch, dq.as_slice(), dv.as_slice());
        dv.iter_mut().zip(&jump).for_each(|(dv, jump)| *dv += jump * change / rates[switch].eps[0]);
    }
}

/// The arguments of the switching functions near an event, on the pieces before it.
struct Arguments<'a> {
    system: &'a dyn MechanicalSystem,
    event: &'a Event,
    map: ExponentialMap,
    scratch: Scratch,
}

impl<'a> Arguments<'a> {
    fn new(system: &'a dyn MechanicalSystem, event: &'a Event) -> Self {
        Arguments { system, event, map: ExponentialMap::new(system), scratch: Scratch::default() }
    }

    fn at(&mut self, q: &[f64], v: &[f64]) -> Vec<Rate> {
        let Event { state, vdot: [vdot, _], pieces: [pieces, _] } = self.event;
        let mut all = vec![Rate::fixed(0.0); self.system.switches().all.len()];
        self.scratch.pieces.clone_from(pieces);
        self.system.switching(OperatingPoint { t: state.t, q, v, vdot, lambda: &[] }, &mut all, &mut self.scratch);
        all
    }

    /// Returns n^T dx by central differences of fourth order: systems give derivatives of switching functions along
    /// their motion only.
    fn change(&mut self, switch: usize, dq: &[f64], dv: &[f64]) -> f64 {
        let State { q, v, .. } = &self.event.state;
        let largest = |x: &[f64]| x.iter().fold(0.0f64, |most, x| most.max(x.abs()));
        let size = largest(dq).max(largest(dv)).max(f64::MIN_POSITIVE);
        // Its fourth power, the error of the differences, is about their round-off.
        let step = 1e-3 / size;
        let mut value = |factor: f64| {
            let moved: Vec<f64> = dq.iter().map(|dq| factor * step * dq).collect();
            let mut there = q.clone();
            self.map.apply(self.system, q, &moved, &mut there);
            let v: Vec<f64> = v.iter().zip(dv).map(|(v, dv)| v + factor * step * dv).collect();
            self.at(&there, &v)[switch].re
        };
        let near = value(1.0) - value(-1.0);
        let far = value(2.0) - value(-2.0);
        (8.0 * near - far) / (12.0 * step)
    }
}
