//! The start by coordinates of joints: rows that hold them while the scene is assembled.

use super::model::{Connection, ModelJoint};
use crate::body::Build;
use crate::error::{Error, Result, excerpt, suggest};
use crate::joint::{ClosedForm, given};
use crate::math::expression::Number;
use std::collections::{BTreeMap, HashMap};

/// `kind` of these rows.
pub const KIND: &str = "initial";

/// Joints by name.
type Index<'j, const D: usize> = HashMap<&'j str, &'j ModelJoint<D>>;

/// Rows for the coordinates, and rows for the rates, that `initial` gives.
pub fn rows<const D: usize>(
    initial: &BTreeMap<String, Number>,
    joints: &[ModelJoint<D>],
    build: &Build<D>,
) -> Result<[Vec<ModelJoint<D>>; 2]> {
    let index: Index<D> = joints.iter().rev().map(|joint| (joint.name.as_str(), joint)).collect();
    let mut rows = [Vec::new(), Vec::new()];
    for (name, number) in initial {
        let is_rate = name.ends_with('\'');
        let row =
            row(name, number, joints, &index, build).map_err(|error| error.under(excerpt(name)).under("initial"))?;
        rows[usize::from(is_rate)].push(row);
    }
    build.own("start", "initial");
    Ok(rows)
}

fn row<const D: usize>(
    name: &str,
    number: &Number,
    joints: &[ModelJoint<D>],
    index: &Index<D>,
    build: &Build<D>,
) -> Result<ModelJoint<D>> {
    let base = name.trim_end_matches('\'');
    let Some((of, coordinate)) = base.split_once('.') else {
        return Err(Error::input(format!("`{}` is no coordinate of a joint", excerpt(name)))
            .hint("write JOINT.COORDINATE, as in `pin.angle`, or with `'` for its rate"));
    };
    let joint = *index.get(of).ok_or_else(|| {
        let known = joints.iter().map(|joint| joint.name.as_str());
        Error::input(format!("there is no joint `{}`", excerpt(of))).hint(suggest(of, known))
    })?;
    let lock = match joint.element.closed_form() {
        Some(ClosedForm::Lock(lock)) => lock,
        _ => return Err(none(joint)),
    };
    let known = lock.coordinates();
    if known.is_empty() {
        return Err(none(joint));
    }
    let (_, found) = known.iter().find(|(known, _)| *known == coordinate).ok_or_else(|| {
        Error::input(format!("the {} joint `{of}` has no coordinate `{}`", joint.kind, excerpt(coordinate)))
            .hint(suggest(coordinate, known.iter().map(|(name, _)| *name)))
    })?;
    let value = number.evaluate(build.parameters)?;
    let (value, rate) = if name == base { (value, 0.0) } else { (0.0, value) };
    if coordinate.starts_with("angle") {
        build.doubt_turns(base, value);
    }
    Ok(Connection {
        name: format!("initial {name}"),
        kind: KIND,
        element: given(lock, *found, value, rate),
        markers: joint.markers.clone(),
    })
}

fn none<E>(joint: &Connection<E>) -> Error {
    Error::input(format!("a joint of type `{}` has no coordinate of its own", joint.kind))
        .hint("revolute joints have an angle, prismatic ones a position; else give \"initial\" of the bodies")
}
