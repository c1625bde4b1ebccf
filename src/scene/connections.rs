//! Joints and forces of a scene, read one after the other.

use super::keys::{object, take_kind, take_name, taken};
use super::kinematics::Named;
use super::model::{Connection, ModelForce, ModelJoint};
use crate::body::{Build, ElementKind};
use crate::error::Result;
use crate::force::{Force, ForceKind, InputKind};
use crate::joint::JointKind;
use serde_json::Value;
use std::collections::HashSet;

pub fn joints<const D: usize>(
    named: &Named<D>,
    kinds: &[JointKind<D>],
    build: &Build<D>,
) -> Result<Vec<ModelJoint<D>>> {
    let make = |make: &BuildJoint<D>, json| make(json, build).map(|built| (built.joint, built.markers));
    let see = |joint: &ModelJoint<D>| named.add(joint, joint.markers.len() == 2, joint.element.closed_form());
    elements(&named.file.joints, "joints", "joint", kinds, build, make, see)
}

type BuildJoint<const D: usize> = fn(Value, &Build<D>) -> Result<crate::joint::BuiltJoint<D>>;
type BuildForce<const D: usize> = fn(Value, &Build<D>) -> Result<crate::force::BuiltForce<D>>;

pub fn forces<const D: usize>(
    named: &Named<D>,
    kinds: &[ForceKind<D>],
    build: &Build<D>,
) -> Result<Vec<ModelForce<D>>> {
    let make = |make: &BuildForce<D>, json| make(json, build).map(|built| (built.force, built.markers));
    let is_between =
        |element: &dyn Force<D>, markers| element.acted(markers) == 2 && element.input() != InputKind::Component;
    let see = |force: &ModelForce<D>| {
        named.add(force, is_between(force.element.as_ref(), force.markers.len()), None);
    };
    elements(&named.file.forces, "forces", "force", kinds, build, make, see)
}

/// Reads joints or forces: `make` gets the JSON without `name` and `type`.
fn elements<E, Make, const D: usize>(
    given: &[Value],
    list: &str,
    what: &str,
    kinds: &[ElementKind<Make>],
    build: &Build<D>,
    make: impl Fn(&Make, Value) -> Result<(E, Vec<usize>)>,
    mut see: impl FnMut(&Connection<E>),
) -> Result<Vec<Connection<E>>> {
    let mut all: Vec<Connection<E>> = Vec::new();
    let mut names = HashSet::new();
    for (i, json) in given.iter().enumerate() {
        let mut read = || {
            let mut json = object(json.clone())?;
            let name = take_name(&mut json)?;
            if !names.insert(name.clone()) {
                return Err(taken(&name, what));
            }
            let kind = take_kind(&mut json, what, kinds).map_err(|error| error.element(&name))?;
            let made = make(&kind.build, Value::Object(json));
            let (element, markers) = made.map_err(|error| error.element(&name))?;
            build.own(what, &name);
            let connection = Connection { name, kind: kind.name, element, markers };
            see(&connection);
            all.push(connection);
            Ok(())
        };
        read().map_err(|error| error.under(format!("{list}[{i}]")))?;
    }
    Ok(all)
}
