//! Warnings about the start of a simulation.

use super::AnyMechanism;
use crate::body::dot;
use crate::error::{Error, Warning, short};
use crate::initial::{Assembly, Move};
use crate::joint::{Axis, Joint};
use crate::scene::Connection;
use crate::system::{MechanicalSystem, Mechanism, Scratch};
use crate::tolerances::report as tolerances;
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2};

/// Warnings about the scene alone.
pub fn of_scene(mechanism: &AnyMechanism) -> &[Warning] {
    match mechanism {
        AnyMechanism::Planar(mechanism) => &mechanism.model().switches.doubts,
        AnyMechanism::Spatial(mechanism) => &mechanism.model().switches.doubts,
    }
}

/// An error of assembly, with the first warning as its remedy, since that may be its cause.
pub fn explained(mut error: Error, doubts: &[Warning]) -> Error {
    if let (Error::Input(input), Some(Warning { text, hint })) = (&mut error, doubts.first()) {
        input.hint = Some(format!("{text}; {hint}"));
    }
    error
}

/// All warnings about an initial guess and its assembly.
pub fn doubts(mechanism: &AnyMechanism, guess: &[f64], assembly: &Assembly) -> Vec<Warning> {
    let turned = match mechanism {
        AnyMechanism::Planar(_) => Vec::new(),
        AnyMechanism::Spatial(mechanism) => turned_over(mechanism, guess, &assembly.q),
    };
    let far = moved_far(&assembly.moves, mechanism.system().length());
    of_scene(mechanism).iter().cloned().chain(turned).chain(far).collect()
}

fn moved_far(moves: &[Move], length: f64) -> Option<Warning> {
    let is_far = |step: &&Move| {
        let (_, coordinate) = step.name.rsplit_once('.').unwrap_or(("", &step.name));
        match coordinate {
            "x" | "y" | "z" => (step.to - step.from).abs() > tolerances::ASSEMBLY_MOVED * length,
            "qw" | "qx" | "qy" | "qz" => (step.to - step.from).abs() > FRAC_1_SQRT_2,
            "angle" => (step.to - step.from).abs() > FRAC_PI_2,
            _ => false,
        }
    };
    let Move { name, from, to } = moves.iter().find(is_far)?;
    let text = format!("assembly moved `{name}` far, from {} to {}", short(*from), short(*to));
    let hint = "see with `plot` whether this configuration is meant; else give positions and angles nearer to it, or name what \
                is right in \"hold\" of \"assembly\"";
    Some(Warning::new(text, hint))
}

/// Joints whose axes point against each other at the assembled start, and not in the guess: phi = 0 in both directions.
fn turned_over(mechanism: &Mechanism<3>, guess: &[f64], q: &[f64]) -> Vec<Warning> {
    let still = vec![0.0; mechanism.dimensions().v];
    let cosines = |q: &[f64]| {
        let frames = mechanism.frames(q, &still, &mut Scratch::default());
        let cosine = |joint: &Connection<Box<dyn Joint<3>>>| {
            let axis = |k: usize| joint.element.joint_axis(&frames[joint.markers[k]].map(|x| x.x));
            let rows = joint.element.row_names();
            match ["rx", "ry"].iter().all(|row| rows.contains(row)).then(|| [axis(0), axis(1)]) {
                Some([Some(Axis::Along(a)), Some(Axis::Along(b))]) => dot(&a, &b),
                _ => 1.0,
            }
        };
        mechanism.model().joints.iter().map(cosine).collect::<Vec<f64>>()
    };
    let joints = mechanism.model().joints.iter().zip(cosines(guess).into_iter().zip(cosines(q)));
    let over = joints.filter(|(_, (guess, found))| *guess > tolerances::AXES_AGAINST && *found < 0.0);
    let warning = |(joint, _): (&Connection<Box<dyn Joint<3>>>, _)| {
        Warning::new(
            format!(
                "the axes of the joint `{}` point against each other after assembly, and not in the guess",
                joint.name
            ),
            "give its bodies a \"rotation\" nearer to the one that is meant",
        )
    };
    over.map(warning).collect()
}
