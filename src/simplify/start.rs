//! What the start alone tells: small motions in the place of a run.

use super::bench::mechanism;
use super::candidate::{Candidate, Proposal};
use super::edit::{carrier, elements, pair, text};
use super::facts::{Facts, PlacedMarker, marker, placed};
use super::modes;
use super::rods::{RodForce, rods};
use super::source::Source;
use crate::body::{cross, dot, norm, sub};
use crate::error::Result;
use crate::formulation::{Dynamics, ExponentialMap};
use crate::initial::{Assembly, assemble};
use crate::linearize::{Kind, Mode, State, amplitude, pairs, seen};
use crate::math::largest;
use crate::prepared::{Model, Overrides};
use crate::system::{Dimensions, Need};
use crate::tolerances;
use serde::Serialize;
use std::path::Path;

/// The largest rotation of the small motions, rad, and their largest displacement, of the length of the scene: far
/// enough that what moves by the second order, as at a dead centre, is told from what rests.
const REACH: f64 = 0.3;

/// What looks superfluous at the start.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Hints {
    /// Changes of the scene that look harmless.
    pub changes: Vec<Hint>,
    /// Links that carry a force.
    pub rods: Vec<RodForce>,
    /// Modes that no output sees.
    pub unseen: Vec<Unseen>,
    /// Circular frequency of the slowest mode that outputs see, 1/s; none where they see none.
    pub slowest_seen: Option<f64>,
    /// Reason why nothing was looked for; empty if it was.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub skipped: String,
}

/// A change that looks harmless.
#[derive(Clone, Debug, Serialize)]
pub struct Hint {
    /// Kind of simplification.
    pub candidate: String,
    /// What it would do.
    pub what: String,
    /// Why it may be harmless.
    pub why: String,
    /// Rough estimate of its effect on outputs, relative.
    pub estimated: f64,
}

/// A mode that no output sees.
#[derive(Clone, Debug, Serialize)]
pub struct Unseen {
    /// |lambda|, 1/s.
    pub circular_frequency: f64,
    /// The largest part that an output sees, of what it sees of the mode that it sees most of.
    pub seen: f64,
    /// The bodies that move most, by their part in the kinetic energy.
    pub moves: Vec<String>,
}

/// What the candidates propose for the start of a scene, `prepared` from `path`, alone, the forces in its rods and the
/// modes that no output sees. In the place of the motion, of which nothing is known, come small ones: the way on from the
/// start, and every mode that outputs see with the same kinetic energy, so that slow ones go far and fast ones do not.
/// What is harmless in all of them need not be so in the motion: work, which grows with time, is not known at all.
///
/// # Errors
/// A scene without an end time, or with more than 300 velocities; one whose modes cannot be computed.
pub fn hints(prepared: Model, path: &Path, overrides: &Overrides, candidates: &[&dyn Candidate]) -> Result<Hints> {
    let model = modes::at_start(&prepared)?;
    let source = Source::load(path, overrides)?;
    let span = prepared.span()?;
    let start = prepared.start();
    // Drivers may be at rest at the start and move all bodies later.
    let is_still = start.1.iter().all(|v| *v == 0.0);
    let modes: Vec<&Mode> = pairs(&model, Kind::Physical).into_iter().map(|pair| pair.mode).collect();
    if modes.is_empty() && is_still {
        let skipped = "nothing moves at the start: `holonom simplify` looks at the motion".to_string();
        return Ok(Hints { skipped, ..Hints::default() });
    }
    let watched: Vec<String> = prepared.system().facts().outputs.iter().map(|column| column.name.clone()).collect();
    let time = span.end - span.start;
    // Without outputs nothing is known of what counts.
    let shares = if watched.is_empty() { vec![1.0; modes.len()] } else { seen(&modes, time) };
    let is_seen: Vec<&Mode> =
        modes.iter().zip(&shares).filter(|(_, share)| **share >= tolerances::UNSEEN).map(|(mode, _)| *mode).collect();
    let slowest_seen = is_seen.iter().map(|mode| mode.value.norm()).reduce(f64::min);
    let states = small_motions(&prepared, &lines(&source, &prepared), &is_seen, time);
    let unseen = modes.iter().zip(&shares).filter(|(_, share)| **share < tolerances::UNSEEN);
    let names = prepared.system().facts().names.v.clone();
    let unseen = unseen.map(|(mode, share)| unseen_mode(mode, *share, &names)).collect();
    let mut dynamics = Dynamics::new(prepared.system());
    dynamics.evaluate(span.start, start.0, start.1, Need::DYNAMICS);
    let (redundant, _) = dynamics.dependent_rows(span.start, start.0, start.1);
    drop(dynamics);
    let facts = Facts::at_start(source, prepared, watched, states, redundant);
    let changes = candidates.iter().flat_map(|candidate| harmless(&facts, *candidate)).collect();
    Ok(Hints { changes, rods: rods(&facts), unseen, slowest_seen, skipped: String::new() })
}

/// The proposals of a candidate that are possible by themselves, keep all outputs and have hardly an effect; of
/// alternatives the one that saves most.
fn harmless(facts: &Facts, candidate: &dyn Candidate) -> Vec<Hint> {
    let mut found: Vec<(String, usize, Hint)> = Vec::new();
    for Proposal { subject, what, why, effect, edit } in candidate.propose(facts) {
        let mut scene = facts.scene().clone();
        let changed = if effect < tolerances::UNSEEN { edit(&mut scene) } else { continue };
        let changed = changed.and_then(|()| mechanism(&facts.source, &facts.watched, &scene));
        let Ok(Dimensions { v, lambda, .. }) = changed.map(|model| model.system().dimensions()) else { continue };
        let saved = v + lambda;
        let hint = Hint { candidate: candidate.name().to_string(), what, why, estimated: effect };
        match found.iter_mut().find(|(known, ..)| *known == subject) {
            Some(best) if best.1 > saved => *best = (subject, saved, hint),
            Some(_) => {}
            None => found.push((subject, saved, hint)),
        }
    }
    found.into_iter().map(|(.., hint)| hint).collect()
}

/// Bodies with a smaller part of the energy of a mode are not named.
const MINOR: f64 = 0.1;

fn unseen_mode(mode: &Mode, seen: f64, names: &[String]) -> Unseen {
    let mut parts: Vec<(&str, f64)> = Vec::new();
    for (name, energy) in names.iter().map(|name| carrier(name)).zip(&mode.energy) {
        match parts.iter_mut().find(|(known, _)| *known == name) {
            Some((_, part)) => *part += energy,
            None => parts.push((name, *energy)),
        }
    }
    parts.retain(|(_, part)| *part > MINOR);
    parts.sort_by(|a, b| b.1.total_cmp(&a.1));
    let moves = parts.into_iter().map(|(name, _)| name.to_string()).collect();
    Unseen { circular_frequency: mode.value.norm(), seen, moves }
}

/// The start, the state to which it goes on, and that at an end of each mode.
fn small_motions(prepared: &Model, lines: &[RodEnds], modes: &[&Mode], time: f64) -> Vec<State> {
    let start = State::start(prepared);
    let reach = |change: &[f64]| largest_speed(prepared, lines, change) / REACH;
    let on = way_on(prepared, reach, time);
    let energy = |state: &State| prepared.system().energy(state.t, &state.q, &state.v, &mut Default::default());
    let kinetic = on.iter().chain([&start]).filter_map(energy).map(|energy| energy.kinetic).fold(0.0, f64::max);
    let ends: Vec<[Vec<f64>; 2]> = modes.iter().flat_map(|mode| end(mode, time)).collect();
    let farthest = ends.iter().map(|[change, _]| reach(change)).fold(0.0, f64::max);
    // Where nothing moves the modes have the energy with which the slowest goes as far as it may.
    let speed = if kinetic > 0.0 { (2.0 * kinetic).sqrt() } else { 1.0 / farthest };
    let ends = ends
        .iter()
        .filter_map(|[change, rate]| beside(prepared, start.t, &scaled(change, 1.0 / farthest), &scaled(rate, speed)));
    let ends: Vec<State> = ends.collect();
    [start].into_iter().chain(on).chain(ends).collect()
}

fn scaled(x: &[f64], factor: f64) -> Vec<f64> {
    x.iter().map(|x| factor * x).collect()
}

/// The state to which the velocities and accelerations of the start lead within `reach` and the time of the motion;
/// none where they do not lead on.
fn way_on(prepared: &Model, reach: impl Fn(&[f64]) -> f64, time: f64) -> Option<State> {
    let Assembly { v, vdot, .. } = &prepared.assembly;
    let fastest = reach(v).max((0.5 * reach(vdot)).sqrt());
    let ahead = time.min(1.0 / fastest);
    let on = |factor: f64| -> Vec<f64> { v.iter().zip(vdot).map(|(v, vdot)| v + factor * vdot).collect() };
    let change: Vec<f64> = on(0.5 * ahead).iter().map(|v| ahead * v).collect();
    (fastest > 0.0).then(|| beside(prepared, prepared.start_time() + ahead, &change, &on(ahead))).flatten()
}

/// The markers at the ends of a rod without mass.
type RodEnds = [usize; 2];

fn lines(source: &Source, prepared: &Model) -> Vec<RodEnds> {
    let rods = elements(&source.scene, "joints").iter().filter(|joint| text(joint, "type") == "distance");
    let ends = |[a, b]: [&str; 2]| Some([marker(prepared, a)?, marker(prepared, b)?]);
    rods.filter_map(|rod| pair(rod).and_then(ends)).collect()
}

/// The largest angular velocity of a body or rod, rad/s, and velocity of a marker, in lengths of the scene per second, at
/// the start with the velocities `v`.
fn largest_speed(prepared: &Model, lines: &[RodEnds], v: &[f64]) -> f64 {
    let length = prepared.system().facts().length;
    let placed = placed(prepared, &State { v: v.to_vec(), ..State::start(prepared) });
    let speed = |place: &PlacedMarker| (norm(&place.velocity) / length).max(norm(&place.spin));
    let turns = |[a, b]: &RodEnds| {
        let gap = sub(&placed[*b].r, &placed[*a].r);
        norm(&cross(&gap, &sub(&placed[*b].velocity, &placed[*a].velocity))) / dot(&gap, &gap)
    };
    placed.iter().map(speed).chain(lines.iter().map(turns)).fold(0.0, f64::max)
}

/// Displacement and velocity of each phase of a mode at a unit of twice the kinetic energy.
fn end(mode: &Mode, time: f64) -> Vec<[Vec<f64>; 2]> {
    let size = amplitude(mode, time);
    let speed = 1.0 / mode.mass.sqrt();
    let real: Vec<f64> = mode.shape.iter().map(|x| x.re).collect();
    let imaginary: Vec<f64> = mode.shape.iter().map(|x| x.im).collect();
    let mut ends = Vec::new();
    for phase in [real, imaginary] {
        // The square of what rounding leaves of double eigenvalues.
        if size.is_finite() && largest(&phase).powi(2) > 1e-6 {
            ends.push([scaled(&phase, size), scaled(&phase, speed)]);
        }
    }
    ends
}

/// The state at a displacement from the start, on the constraints; none where they do not close.
fn beside(prepared: &Model, t: f64, change: &[f64], v: &[f64]) -> Option<State> {
    let system = prepared.system();
    let (start, before) = prepared.start();
    let mut q = start.to_vec();
    ExponentialMap::new(system).apply(system, start, change, &mut q);
    // States xi stay as they are.
    let moving = system.dimensions().moving();
    let v = [&v[..moving], &before[moving..]].concat();
    let Assembly { q, v, .. } = assemble(system, t, (&q, &v), &[]).ok()?;
    Some(State { t, q, v })
}
