//! Inputs of a scene, and the elements that their values act on.

use super::format::InputSpec;
use super::keys::{find, missing, named_component, taken};
use super::model::{Connection, ModelForce, ModelInput, ModelJoint, Target};
use crate::body::{Build, Formula, MOST_MARKERS};
use crate::error::{Error, Result};
use crate::force::{self, InputKind};
use crate::joint;
use crate::math::expression::Number;

/// The inputs with what they add to. Their values become part of the elements that they drive.
pub fn inputs<const D: usize>(
    specs: &[InputSpec],
    joints: &mut Vec<ModelJoint<D>>,
    forces: &mut Vec<ModelForce<D>>,
    build: &Build<D>,
) -> Result<Vec<ModelInput>> {
    let mut all: Vec<ModelInput> = Vec::new();
    for (i, spec) in specs.iter().enumerate() {
        let place = |error: Error| error.element(&spec.name).under(format!("inputs[{i}]"));
        let named = |error: Error| error.under("name").under(format!("inputs[{i}]"));
        if all.iter().any(|known| known.name == spec.name) {
            return Err(taken(&spec.name, "input").under(format!("inputs[{i}]")));
        }
        super::names::check_name(&spec.name).map_err(named)?;
        let mut input = input::<D>(spec, joints, forces).map_err(place)?;
        if let Some(value) = &spec.value {
            input.value = Some(add(&input.target, value, joints, forces, build).map_err(place)?);
        }
        build.own("input", &spec.name);
        all.push(input);
    }
    Ok(all)
}

const ONE_OF: &str = "give one of `force`, an applied force or torque, `driver`, a joint, and `tyre`, a force";

fn input<const D: usize>(spec: &InputSpec, joints: &[ModelJoint<D>], forces: &[ModelForce<D>]) -> Result<ModelInput> {
    let (target, unit) = match (&spec.force, &spec.driver, &spec.tyre) {
        (Some(force), None, None) => component(force, spec.component.as_deref(), forces)?,
        (None, Some(joint), None) => driver(joint, joints)?,
        (None, None, Some(tyre)) => road(tyre, forces)?,
        (None, None, None) => return Err(missing("force", ONE_OF)),
        (force, ..) => {
            let second = if force.is_some() && spec.driver.is_some() { "driver" } else { "tyre" };
            return Err(Error::input("an input drives one element").under(second).hint(ONE_OF));
        }
    };
    if let (Some(name), false) = (&spec.component, spec.force.is_some()) {
        let error = Error::input(format!("there is no component `{name}`: this input is a displacement"));
        return Err(error.under("component").hint("remove it"));
    }
    Ok(ModelInput { name: spec.name.clone(), target, unit, value: None })
}

/// Index of the element of this name.
fn named<E>(what: &str, key: &str, name: &str, all: &[Connection<E>]) -> Result<usize> {
    find(what, name, all.iter().map(|known| known.name.as_str())).map_err(|error| error.at(key))
}

/// Error: the element is of a type that the key does not go with.
fn undriven<E>(key: &str, Connection { name, kind, .. }: &Connection<E>, hint: &str) -> Error {
    Error::input(format!("`{name}` is a {kind}, which an input cannot drive")).under(key).hint(hint)
}

fn component<const D: usize>(
    name: &str,
    axis: Option<&str>,
    forces: &[ModelForce<D>],
) -> Result<(Target, &'static str)> {
    let force = named("force", "force", name, forces)?;
    let element = &forces[force].element;
    match element.input() {
        InputKind::Component => {}
        InputKind::Displacement { .. } => {
            let error = Error::input(format!("`{name}` is a {}: an input adds to its road", forces[force].kind));
            return Err(error.under("force").hint(format!("write \"tyre\": \"{name}\"")));
        }
        InputKind::None => return Err(undriven("force", &forces[force], "name an applied_force or an applied_torque")),
    }
    let axes = &["x", "y", "z"][..D];
    let component = match axis {
        None if D == 2 && element.is_torque() => 2,
        None => return Err(missing("component", &format!("choose one of {}", axes.join(", ")))),
        Some(axis) => named_component(axis, axes)?,
    };
    Ok((Target::Component { force, component }, if element.is_torque() { "N m" } else { "N" }))
}

fn road<const D: usize>(name: &str, forces: &[ModelForce<D>]) -> Result<(Target, &'static str)> {
    let force = named("tyre", "tyre", name, forces)?;
    match forces[force].element.input() {
        InputKind::Displacement { rate } => Ok((Target::Road { force, rate }, "m")),
        _ => Err(undriven("tyre", &forces[force], "name a tyre, or an applied force or torque under `force`")),
    }
}

fn driver<const D: usize>(name: &str, joints: &[ModelJoint<D>]) -> Result<(Target, &'static str)> {
    let joint = named("driver", "driver", name, joints)?;
    let element = &joints[joint].element;
    if element.prescribes() {
        Ok((Target::Driver { joint }, if element.row_names() == ["angle"] { "rad" } else { "m" }))
    } else {
        Err(undriven("driver", &joints[joint], "name a joint of type driver"))
    }
}

/// Adds a value to an element.
fn add<const D: usize>(
    target: &Target,
    value: &Number,
    joints: &mut Vec<ModelJoint<D>>,
    forces: &mut Vec<ModelForce<D>>,
    build: &Build<D>,
) -> Result<Formula> {
    let reads_markers = matches!(target, Target::Component { .. });
    let value = build.acting("value", value, reads_markers)?;
    if !reads_markers {
        value.clone().function_of_time().map_err(|error| error.under("value"))?;
    }
    match *target {
        Target::Driver { joint } => {
            let expression = value.expression.clone();
            replace(joints, joint, |known| Connection {
                element: Box::new(joint::Added { inner: known.element, value: expression }) as _,
                ..known
            });
        }
        Target::Component { force, .. } | Target::Road { force, .. } => {
            let component = target.force().map_or(0, |(_, component)| component);
            let added = value.clone();
            replace(forces, force, |known| {
                let (element, markers) = force::Added::new(known.element, &known.markers, component, added);
                Connection { element: Box::new(element) as _, markers, ..known }
            });
            if forces[force].markers.len() > MOST_MARKERS {
                let message = format!("`{}` and this use {} markers", forces[force].name, forces[force].markers.len());
                let hint = format!("use at most {MOST_MARKERS} in one force");
                return Err(Error::input(message).under("value").hint(hint));
            }
        }
    }
    Ok(value)
}

fn replace<E>(all: &mut Vec<E>, index: usize, by: impl FnOnce(E) -> E) {
    let known = all.remove(index);
    all.insert(index, by(known));
}
