//! The facts of a scene's model.

use super::facts::{Column, Excitation, Names, SystemFacts};
use super::layout::Layout;
use super::rows::{JointRows, groups};
use super::spin::{Placement, Rotation};
use super::theory::Limited;
use crate::body::norm;
use crate::joint::{ClosedForm, Joint};
use crate::scene::{Connection, Model, ModelInput, ModelOutput, Part, Target};

/// Facts of a model with the parts that have a limit.
pub(super) fn facts_of<const D: usize>(layout: &Layout<D>, limited: Vec<Limited>) -> SystemFacts {
    let Layout { model, joints, masses, .. } = layout;
    let column = |output: &ModelOutput| Column { name: output.name.clone(), unit: output.unit.name.clone() };
    let input = |input: &ModelInput| Column { name: input.name.clone(), unit: input.unit.to_string() };
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
        Target::Driver { joint } => Excitation::Constraint(joints[joint].rows.start),
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

/// A length typical of the scene, m: the largest distance of a marker from its body's origin or length of a rod; where
/// there are none, of the ground's markers; else the extent of the start, if that is below 1.
fn length_scale<const D: usize>(model: &Model<D>) -> f64 {
    let bodies = model.bodies.iter().map(|part| part.facts.reach).fold(0.0, f64::max);
    let rods = model.joints.iter().filter_map(|joint| rod_length(&*joint.element)).fold(0.0, f64::max);
    let ground = model.ground.iter().map(|marker| norm(&marker.offset)).fold(0.0, f64::max);
    [f64::max(bodies, rods), ground, model.extent.min(1.0)].into_iter().find(|length| *length > 0.0).unwrap_or(1.0)
}

/// The length of a rod, m; `None` for other joints.
fn rod_length<const D: usize>(joint: &dyn Joint<D>) -> Option<f64> {
    match joint.closed_form()? {
        ClosedForm::Rod(length) => Some(length),
        ClosedForm::Lock(_) => None,
    }
}

/// Lengths above zero of bodies and rods, m, by name.
fn named_lengths<const D: usize>(model: &Model<D>) -> Vec<(String, f64)> {
    let bodies = model.bodies.iter().map(|part| (part.name.clone(), part.facts.reach));
    let rods = model.joints.iter().filter_map(|joint| Some((joint.name.clone(), rod_length(&*joint.element)?)));
    bodies.chain(rods).filter(|(_, length)| *length > 0.0).collect()
}

/// The unit of each row of phi that drift is measured against: the length for rows in metres, 1 rad for angles.
fn row_scales<const D: usize>(model: &Model<D>, length: f64) -> Vec<f64> {
    let rows = model.joints.iter().flat_map(|joint| joint.element.row_names());
    rows.map(|row| if matches!(row, "x" | "y" | "z" | "length") { length } else { 1.0 }).collect()
}
