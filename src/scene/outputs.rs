//! Outputs of a scene.

use super::keys::{missing, taken};
use super::kinematics::Elements;
use super::measures::{MeasureKind, On, OutputSpec};
use super::model::{EnergyPart, Measure, ModelOutput, TORQUE_SIZE};
use super::names::check_name;
use super::place::Cut;
use super::units::{Dimension, Unit, dimension_of};
use super::{actions, beam_outputs, kinematics};
use crate::body::Build;
use crate::error::{Error, Result};
use std::collections::HashSet;

/// Refuses names of outputs that are `t`, taken or not valid: they are columns of the trajectory.
pub fn check_names(specs: &[OutputSpec]) -> Result<()> {
    let mut known = HashSet::new();
    for (i, OutputSpec { name, .. }) in specs.iter().enumerate() {
        let checked = match name.as_str() {
            "t" => Err(Error::input("the name `t` is taken by time").under("name").hint("give each output its own")),
            _ if !known.insert(name) => Err(taken(name, "output")),
            _ => check_name(name).map_err(|error| error.under("name")),
        };
        checked.map_err(|error| error.under(format!("outputs[{i}]")))?;
    }
    Ok(())
}

/// Refuses keys that a measure would silently ignore.
fn refuse_idle_keys(spec: &OutputSpec) -> Result<()> {
    let OutputSpec { of, between, relative_to, component, at, offset, value, on, .. } = spec;
    let given = [
        ("of", of.is_some()),
        ("between", between.is_some()),
        ("relative_to", relative_to.is_some()),
        ("component", component.is_some()),
        ("at", at.is_some()),
        ("offset", offset.is_some()),
        ("value", value.is_some()),
        ("on", on.is_some()),
    ];
    // A size and the force along a rod are the same in all axes.
    let is_size = matches!(spec.measure, MeasureKind::Reaction | MeasureKind::Force)
        && matches!(component.as_deref(), None | Some("axial"));
    let names_body = matches!(on, Some(On::Body(_)));
    let is_idle = |key: &str| is_size && (key == "relative_to" || key == "on" && !names_body);
    let used = spec.measure.keys().iter().filter(|key| !is_idle(key));
    let used: Vec<&str> = used.copied().collect();
    match given.iter().find(|(key, given)| *given && !used.contains(key)) {
        None => Ok(()),
        Some((key, _)) => Err(Error::input(format!("this measure has no `{key}`"))
            .under(key)
            .hint(format!("remove it; here \"measure\" goes with {}", used.join(", ")))),
    }
}

/// The outputs with everything they name resolved, those that are works apart, and the sections of beams that they
/// watch.
pub fn outputs<const D: usize>(
    specs: &[OutputSpec],
    elements: Elements<D>,
    build: &Build<D>,
) -> Result<(Vec<ModelOutput>, Vec<ModelOutput>, Vec<Cut<D>>)> {
    let mut all = Vec::new();
    let mut works = Vec::new();
    let mut cuts = Vec::new();
    for (i, spec) in specs.iter().enumerate() {
        let place = |error: Error| error.element(&spec.name).under(format!("outputs[{i}]"));
        refuse_idle_keys(spec).map_err(place)?;
        let measure = measure(spec, elements, &mut cuts, build).map_err(place)?;
        build.own("output", &spec.name);
        let unit = unit(spec, dimension(spec.measure, &measure, elements)).map_err(place)?;
        let kind = if spec.measure == MeasureKind::Work { &mut works } else { &mut all };
        kind.push(ModelOutput { name: spec.name.clone(), unit, measure });
    }
    Ok((all, works, cuts))
}

fn measure<const D: usize>(
    spec: &OutputSpec,
    elements: Elements<D>,
    cuts: &mut Vec<Cut<D>>,
    build: &Build<D>,
) -> Result<Measure> {
    if let Some(probe) = kinematics::probe(spec, elements.placed, build)? {
        return Ok(Measure::Probe(probe));
    }
    match spec.measure {
        MeasureKind::Reaction => actions::reaction(spec, elements, build),
        MeasureKind::Force => actions::force(spec, elements, build),
        MeasureKind::Power => actions::power(spec.subject()?, elements),
        MeasureKind::Work => actions::work(spec.subject()?, elements),
        MeasureKind::Energy => {
            let part = spec.component_of("total", &["kinetic", "potential", "total"])?;
            Ok(Measure::Energy([EnergyPart::Kinetic, EnergyPart::Potential, EnergyPart::Total][part]))
        }
        MeasureKind::Expression => {
            let value = spec.value.as_ref();
            let value = value.ok_or_else(|| missing("value", "give an expression over t and marker quantities"))?;
            Ok(Measure::Formula(build.observing("value", value)?))
        }
        _ => beam_outputs::measure(spec, elements, cuts, build),
    }
}

/// Physical dimension of an output; none for an expression and the multiplier of one, whose unit their author gives.
fn dimension<const D: usize>(kind: MeasureKind, measure: &Measure, elements: Elements<D>) -> Option<Dimension> {
    if matches!(*measure, Measure::Multiplier { joint } if elements.joints[joint].kind == "equation") {
        return None;
    }
    match kind.dimensions() {
        [force, torque] => Some(if is_torque(measure, elements) { *torque } else { *force }),
        others => others.first().copied(),
    }
}

fn is_torque<const D: usize>(measure: &Measure, Elements { joints, forces, .. }: Elements<D>) -> bool {
    match *measure {
        Measure::Reaction { component, .. } | Measure::Load { component, .. } => {
            matches!(component, 3..=5 | TORQUE_SIZE)
        }
        Measure::Push { joint } => joints[joint].element.row_names() == ["angle"],
        Measure::Force(force) => forces[force].element.is_torque(),
        _ => false,
    }
}

fn unit(spec: &OutputSpec, dimension: Option<Dimension>) -> Result<Unit> {
    match (dimension, &spec.unit) {
        (Some(dimension), Some(name)) => dimension.unit(name),
        (Some(dimension), None) => Ok(dimension.si()),
        (None, Some(name)) => match dimension_of(name) {
            Some(dimension) => dimension.unit(name),
            // A word of the author's own.
            None => Ok(Unit { name: name.clone(), per_si: 1.0 }),
        },
        (None, None) => Ok(Unit { name: String::new(), per_si: 1.0 }),
    }
}
