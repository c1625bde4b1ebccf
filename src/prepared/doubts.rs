//! Warnings about the start of a simulation.

use super::{AnyMechanism, in_either};
use crate::body::{dot, norm};
use crate::error::{Error, Warning, short, significant};
use crate::initial::{Assembly, Move};
use crate::joint::Axis;
use crate::math::array::{Each, from_fn};
use crate::scene::ModelJoint;
use crate::system::{MechanicalSystem, Mechanism, Road, Scratch};
use crate::tolerances;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_6};

/// Warnings about the scene alone.
pub fn of_scene(mechanism: &AnyMechanism) -> &[Warning] {
    in_either!(mechanism, mechanism => &mechanism.model().switches.doubts)
}

/// An error of assembly, with the first warning as its remedy, since that may be its cause.
pub fn explained(mut error: Error, doubts: &[Warning]) -> Error {
    if let (Error::Input(input), Some(Warning { text, hint })) = (&mut error, doubts.first()) {
        input.hint = Some(format!("{text}; {hint}"));
    }
    error
}

/// All warnings about an initial guess and its assembly. With `has_joint_start` joint coordinates choose the
/// configuration, and the guess may be rough.
pub fn doubts(mechanism: &AnyMechanism, guess: &[f64], assembly: &Assembly, has_joint_start: bool) -> Vec<Warning> {
    // A guess by hand is nearer, and branches are farther apart.
    let allowed = if has_joint_start { FRAC_PI_2 } else { FRAC_PI_6 };
    let (over, turned) = match mechanism {
        AnyMechanism::Planar(mechanism) => (Vec::new(), turned_far(mechanism, guess, &assembly.q, allowed)),
        AnyMechanism::Spatial(mechanism) => {
            (turned_over(mechanism, guess, &assembly.q), turned_far(mechanism, guess, &assembly.q, allowed))
        }
    };
    let far = turned.or_else(|| moved_far(&assembly.moves, mechanism.system().facts().length));
    of_scene(mechanism).iter().cloned().chain(over).chain(beside(assembly)).chain(far).collect()
}

/// Tyres that pull their wheels down at the start.
pub fn pulling(system: &dyn MechanicalSystem, t: f64, q: &[f64], v: &[f64]) -> Vec<Warning> {
    let roads = system.roads(t, q, v, &mut Scratch::default());
    let pulls = |road: &&Road| !road.lifts && road.load < 0.0 && road.compression() < -tolerances::TOLD;
    let warning = |road: &Road| {
        let above = significant(road.clearance - road.radius, 2);
        let force = significant(-road.load, 2);
        let text = format!("at the start the tyre `{}` is {above} m above the road and pulls by {force} N", road.tyre);
        let hint = "put the wheel on the road, start with --equilibrium, or give the tyre \"lift_off\": true";
        Warning::new(text, hint)
    };
    roads.iter().filter(pulls).map(warning).collect()
}

const OTHER_CONFIGURATION: &str = "see with `plot` whether this configuration is meant; else give positions and angles \
     nearer to it, or name what is right in \"hold\" of \"assembly\"";

/// The body that assembly turned most, if by more than `allowed`, rad. Nodes of a beam turn where it bends.
fn turned_far<const D: usize>(mechanism: &Mechanism<D>, guess: &[f64], q: &[f64], allowed: f64) -> Option<Warning> {
    let model = mechanism.model();
    let is_node = |index: usize| model.beams.iter().any(|beam| beam.bodies().contains(&index));
    let mut largest: Option<(f64, &str)> = None;
    for (index, part) in model.given_bodies().iter().enumerate() {
        let angle = turn(&part.facts.coordinate_names, part.coordinates(guess), part.coordinates(q));
        let allowed = if is_node(index) { FRAC_PI_2 } else { allowed };
        if angle > largest.map_or(allowed, |(angle, _)| angle.max(allowed)) {
            largest = Some((angle, &part.name));
        }
    }
    let (angle, name) = largest?;
    let text = format!("assembly turned `{name}` by {} degrees", significant(angle.to_degrees(), 3));
    Some(Warning::new(text, OTHER_CONFIGURATION))
}

/// Rotation of a body with these coordinates from one state to another, rad.
fn turn(names: &[String], from: &[f64], to: &[f64]) -> f64 {
    let index_of = |coordinate: &str| names.iter().position(|name| name == coordinate);
    if let Some(angle) = index_of("angle") {
        return (to[angle] - from[angle]).abs();
    }
    let Some(first) = index_of("qw") else { return 0.0 };
    let [a, b]: [[f64; 4]; 2] = [from, to].each(|q| from_fn(|k| q[first + k]));
    // The real part of a* b is the cosine of half the angle, the rest its sine; -b is the same rotation as b.
    let cosine = dot(&a, &b).abs();
    let sine = norm(&from_fn::<f64, 4>(|k| b[k] * dot(&a, &a) - a[k] * dot(&a, &b))) / norm(&a);
    2.0 * sine.atan2(cosine)
}

/// A start that was found from beside the guess.
fn beside(assembly: &Assembly) -> Option<Warning> {
    let first = assembly.moves.first().filter(|_| assembly.is_beside)?;
    let body = first.name.split('.').next().unwrap_or(&first.name);
    let text = format!(
        "the guess leads to a singular state, such as bars on one line: `{body}` was turned off it, to one of several \
         branches"
    );
    Some(Warning::new(text, format!("give `{body}` an angle in its \"initial\" on the branch that is meant")))
}

fn moved_far(moves: &[Move], length: f64) -> Option<Warning> {
    let is_far = |step: &&Move| {
        let (_, coordinate) = step.name.rsplit_once('.').unwrap_or(("", &step.name));
        match coordinate {
            "x" | "y" | "z" => (step.to - step.from).abs() > length,
            _ => false,
        }
    };
    let Move { name, from, to } = moves.iter().find(is_far)?;
    let text = format!("assembly moved `{name}` far, from {} to {}", short(*from), short(*to));
    Some(Warning::new(text, OTHER_CONFIGURATION))
}

/// Joints whose axes point against each other at the assembled start, and not in the guess: phi = 0 in both directions.
fn turned_over(mechanism: &Mechanism<3>, guess: &[f64], q: &[f64]) -> Vec<Warning> {
    let guessed = cosines(mechanism, guess);
    let assembled = cosines(mechanism, q);
    let mut warnings = Vec::new();
    for (i, joint) in mechanism.model().joints.iter().enumerate() {
        // Guesses within 26 degrees of opposite had them so.
        if guessed[i] > -0.9 && assembled[i] < 0.0 {
            let name = &joint.name;
            let text =
                format!("the axes of the joint `{name}` point against each other after assembly, and not in the guess");
            warnings.push(Warning::new(text, "give its bodies a \"rotation\" nearer to the one that is meant"));
        }
    }
    warnings
}

/// Returns the cosine of the angle between the two axes of each joint; 1 for a joint that does not align two axes.
fn cosines(mechanism: &Mechanism<3>, q: &[f64]) -> Vec<f64> {
    let still = vec![0.0; mechanism.dimensions().v];
    let frames = mechanism.frames(q, &still, &mut Scratch::default());
    let cosine = |joint: &ModelJoint<3>| {
        let axis = |k: usize| joint.element.joint_axis(&frames[joint.markers[k]].map(|x| x.x));
        let rows = joint.element.row_names();
        match ["rx", "ry"].iter().all(|row| rows.contains(row)).then(|| [axis(0), axis(1)]) {
            Some([Some(Axis::Along(a)), Some(Axis::Along(b))]) => dot(&a, &b),
            _ => 1.0,
        }
    };
    mechanism.model().joints.iter().map(cosine).collect()
}
