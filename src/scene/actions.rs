//! Outputs of joints and forces: what they exert, and its power.

use super::keys::{find, wrong_component};
use super::kinematics::Elements;
use super::measures::{BodySide, On, OutputSpec};
use super::model::{Connection, FORCE_SIZE, Measure, ModelJoint, TORQUE_SIZE};
use crate::body::{Build, MarkerId};
use crate::error::{Error, Result};
use crate::force::InputKind;

/// Components of a force and a torque, with their places in [`Measure::Reaction`].
fn components(dimension: usize) -> &'static [(&'static str, usize)] {
    match dimension {
        2 => &[("x", 0), ("y", 1), ("mz", 5)],
        _ => &[("x", 0), ("y", 1), ("z", 2), ("mx", 3), ("my", 4), ("mz", 5)],
    }
}

fn component<const D: usize>(name: &str, further: Option<&'static str>) -> Result<usize> {
    let known = components(D);
    let found = known.iter().find(|(known, _)| *known == name).map(|(_, component)| *component);
    found.ok_or_else(|| wrong_component(name, &known.iter().map(|(name, _)| *name).chain(further).collect::<Vec<_>>()))
}

pub fn reaction<const D: usize>(spec: &OutputSpec, elements: Elements<D>, build: &Build<D>) -> Result<Measure> {
    let joint = named(spec.subject()?, "joint", elements.joints, "force", elements.forces, "force")?;
    let given = &elements.joints[joint];
    let holds = given.element.row_names();
    let axes = axes(spec, build)?;
    let Some(name) = spec.component.as_deref() else {
        return Ok(match given.kind {
            "driver" => Measure::Push { joint },
            "equation" if spec.on.is_none() => Measure::Multiplier { joint },
            "equation" => Measure::Reaction { joint, slot: slot(spec, given, build)?, component: FORCE_SIZE, axes },
            // A joint that fixes an angle alone has a torque and no force.
            _ if holds == ["angle"] => Measure::Reaction { joint, slot: second(given), component: TORQUE_SIZE, axes },
            _ => Measure::Reaction { joint, slot: second(given), component: FORCE_SIZE, axes },
        });
    };
    let holds_length = holds == ["length"];
    if name == "axial" && holds_length {
        return Ok(Measure::Multiplier { joint });
    }
    let component = component::<D>(name, holds_length.then_some("axial"))?;
    Ok(Measure::Reaction { joint, slot: slot(spec, given, build)?, component, axes })
}

/// Place, among the markers of a joint, of that on whose body a reaction acts.
fn slot<const D: usize>(spec: &OutputSpec, given: &ModelJoint<D>, build: &Build<D>) -> Result<usize> {
    let name = match &spec.on {
        Some(On::Side(BodySide::First)) => return Ok(0),
        Some(On::Side(BodySide::Second)) => return Ok(second(given)),
        // The order of the terms of an expression says nothing.
        None if given.kind == "equation" && given.markers.len() > 1 => {
            let error = Error::input(format!("`{}` acts on {} markers", given.name, given.markers.len()));
            return Err(error.under("on").hint("name the body on which the force is meant"));
        }
        None => return Ok(second(given)),
        Some(On::Body(name)) => name,
    };
    let marker = build.marker("on", name)?;
    let bodies = &build.markers.bodies;
    let same_body = || given.markers.iter().position(|&own| bodies[own] == bodies[marker]);
    given.markers.iter().position(|&own| own == marker).or_else(same_body).ok_or_else(|| {
        Error::input(format!("`{}` does not act on `{name}`", given.name))
            .under("on")
            .hint("name one of its bodies, or first or second")
    })
}

/// Place of the second marker, or of the only one.
fn second<E>(element: &Connection<E>) -> usize {
    1.min(element.markers.len() - 1)
}

/// Magnitude of a force, or a component of what it exerts on a body.
pub fn force<const D: usize>(spec: &OutputSpec, elements: Elements<D>, build: &Build<D>) -> Result<Measure> {
    let of = spec.subject()?;
    let force = named(of, "force", elements.forces, "joint", elements.joints, "reaction")?;
    let Some(name) = spec.component.as_deref() else { return Ok(Measure::Force(force)) };
    let component = component::<D>(name, None)?;
    let axes = axes(spec, build)?;
    let given = &elements.forces[force];
    let acted = given.element.acted(given.markers.len());
    let slot = match &spec.on {
        Some(On::Body(_)) => {
            return Err(Error::input("a force names its body by first or second")
                .under("on")
                .hint("write first or second"));
        }
        Some(On::Side(BodySide::Second)) if acted < 2 => {
            return Err(Error::input(format!("`{of}` acts on one marker alone")).under("on").hint("remove it"));
        }
        Some(On::Side(BodySide::Second)) => 1,
        Some(On::Side(BodySide::First)) => 0,
        // An applied force is given as it acts at its own marker.
        None if given.element.input() == InputKind::Component => 0,
        None => 1.min(acted - 1),
    };
    Ok(Measure::Load { force, slot, component, axes })
}

pub fn power<const D: usize>(of: &str, elements: Elements<D>) -> Result<Measure> {
    if let Some(force) = elements.forces.iter().position(|force| force.name == of) {
        return Ok(Measure::Power { force });
    }
    let drives = |joint: &&ModelJoint<D>| joint.element.depends_on_time();
    if let Some(joint) = elements.joints.iter().position(|joint| joint.name == of) {
        return if drives(&&elements.joints[joint]) {
            Ok(Measure::DrivePower { joint })
        } else {
            Err(Error::input(format!("the {} `{of}` has no power", elements.joints[joint].kind))
                .under("of")
                .hint("a joint that does not move by itself takes what it gives: name a driver or a force"))
        };
    }
    let drivers = elements.joints.iter().filter(drives).map(|joint| joint.name.as_str());
    let known = elements.forces.iter().map(|force| force.name.as_str()).chain(drivers).collect::<Vec<_>>();
    find("force or driver", of, known.into_iter()).map(|force| Measure::Power { force })
}

/// Power of the force whose work is watched.
pub fn work<const D: usize>(of: &str, elements: Elements<D>) -> Result<Measure> {
    match power(of, elements)? {
        Measure::DrivePower { .. } => Err(Error::input(format!("of the driver `{of}` the power is known alone"))
            .under("of")
            .hint("name a force; `energy.csv` has the work of all drivers and of forces without a potential")),
        measure => Ok(measure),
    }
}

/// Marker in whose axes components are.
fn axes<const D: usize>(spec: &OutputSpec, build: &Build<D>) -> Result<MarkerId> {
    let axes = spec.reference(build)?;
    build.oriented("relative_to", &[axes])?;
    Ok(axes)
}

/// Index of the element `of`; where there is one of the other kind, `measure` is what that has.
fn named<E, O>(
    of: &str,
    wanted: &str,
    all: &[Connection<E>],
    found: &str,
    others: &[Connection<O>],
    measure: &str,
) -> Result<usize> {
    find(wanted, of, all.iter().map(|element| element.name.as_str())).map_err(|error| {
        if others.iter().all(|other| other.name != of) {
            return error;
        }
        Error::input(format!("`{of}` is a {found}, not a {wanted}"))
            .under("of")
            .hint(format!("\"measure\": \"{measure}\" gives what a {found} exerts"))
    })
}
