//! The facts of a scene's model.

use super::facts::{Column, Names, SystemFacts};
use super::input::Excitation;
use super::limits::Limited;
use super::rows::{JointRows, groups};
use super::scale::{length_scale, named_lengths, row_scales};
use super::spin::{Placement, Rotation};
use crate::joint::Joint;
use crate::scene::{Connection, Input, Model, Part, Target, Watched};
use std::ops::Range;

/// Facts of a model with the rows of its joints, the places of the bodies' values of M, and the parts with a limit.
pub(super) fn facts_of<const D: usize>(
    model: &Model<D>,
    joints: &[JointRows],
    masses: &[Range<usize>],
    limited: Vec<Limited>,
) -> SystemFacts {
    let column = |output: &Watched| Column { name: output.name.clone(), unit: output.unit.name.clone() };
    let input = |input: &Input| Column { name: input.name.clone(), unit: input.unit.to_string() };
    let length = length_scale(model);
    let stiffness = model.bodies.iter().zip(masses).flat_map(|(part, places)| {
        let values = part.facts.stiffness.iter();
        values.map(|&(place, stiffness)| (places.start + place, stiffness))
    });
    SystemFacts {
        names: names(model),
        outputs: model.outputs.iter().map(column).collect(),
        works: model.works.iter().map(column).collect(),
        inputs: model.inputs.iter().map(input).collect(),
        excitations: model.inputs.iter().map(|input| excitation(joints, input.target)).collect(),
        gaps: model.forces.iter().filter_map(|force| force.element.gap()).collect(),
        limited,
        turning_bodies: oriented_bodies(model).map(|part| part.name.clone()).collect(),
        rotations: model.bodies.iter().filter_map(rotation).collect(),
        axes: None,
        placements: model.bodies.iter().map(placements).collect::<Option<Vec<_>>>().map(|all| all.concat()),
        length,
        lengths: named_lengths(model),
        scales: row_scales(model, length),
        stiffness: stiffness.collect(),
        groups: groups(model, joints),
    }
}

/// Names of q, v and lambda.
fn names<const D: usize>(model: &Model<D>) -> Names {
    let of_bodies = |names: fn(&Part<D>) -> &[String]| -> Vec<String> {
        model.bodies.iter().flat_map(|part| names(part).iter().map(|name| part.full_name(name))).collect()
    };
    let rows = |joint: &Connection<Box<dyn Joint<D>>>| -> Vec<String> {
        let names = joint.element.row_names().into_iter();
        names.map(|row| format!("joint.{}.{row}", joint.name)).collect()
    };
    let turnings = model.turnings.iter().map(|turning| turning.name.clone());
    Names {
        q: of_bodies(|part| &part.facts.coordinate_names).into_iter().chain(turnings).collect(),
        v: of_bodies(|part| &part.facts.velocity_names),
        lambda: model.joints.iter().flat_map(rows).collect(),
    }
}

/// The equation that an input is part of.
fn excitation(joints: &[JointRows], target: Target) -> Excitation {
    match target {
        Target::Component { .. } | Target::Road { rate: false, .. } => Excitation::Force,
        Target::Road { rate: true, .. } => Excitation::Displacement,
        Target::Driver { joint } => Excitation::Constraint(joints[joint].first),
    }
}

/// All bodies but point masses.
pub(super) fn oriented_bodies<const D: usize>(model: &Model<D>) -> impl Iterator<Item = &Part<D>> {
    model.bodies.iter().filter(|part| part.facts.oriented)
}

/// The unit quaternion of a body, if it has one.
fn rotation<const D: usize>(part: &Part<D>) -> Option<Rotation> {
    part.facts.turning.map(|first| Rotation { q: part.first_q + first, v: part.first_v + first })
}

/// The coordinates of a body that change when the world is rotated: x, y(, z) first, then an angle or a quaternion where
/// it has an orientation.
fn placements<const D: usize>(part: &Part<D>) -> Option<Vec<Placement>> {
    let own: Vec<&str> = part.facts.coordinate_names.iter().map(String::as_str).collect();
    let place = Placement::Place { q: part.first_q, v: part.first_v, count: D };
    let q = part.first_q + D;
    let v = part.first_v + D;
    match (D, own.as_slice()) {
        (_, []) => Some(Vec::new()),
        (2, ["x", "y", "angle", ..]) => Some(vec![place, Placement::Angle { q, v }]),
        (3, ["x", "y", "z", "qw", ..]) => Some(vec![place, Placement::Axes { q, v }]),
        (2, ["x", "y"]) | (3, ["x", "y", "z"]) if !part.facts.oriented => Some(vec![place]),
        _ => None,
    }
}
