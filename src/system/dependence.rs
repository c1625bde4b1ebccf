//! The bodies, joints and forces that an output reads.

use super::coupling::Carrier;
use super::layout::Layout;
use super::section::markers_beyond;
use crate::body::{Formula, Quantity};
use crate::scene::{Measure, Model, Part};
use std::collections::{BTreeMap, BTreeSet};

/// A carrier that moves along all velocities of its body.
pub(super) fn whole<const D: usize>(body: usize, part: &Part<D>) -> Carrier {
    Carrier { body, velocities: (part.first_v..part.first_v + part.nv).collect(), markers: Vec::new() }
}

/// One carrier for each body, with the velocities of all.
fn merged(all: impl Iterator<Item = Carrier>) -> Vec<Carrier> {
    let mut bodies: BTreeMap<usize, BTreeSet<usize>> = BTreeMap::new();
    all.for_each(|carrier| bodies.entry(carrier.body).or_default().extend(carrier.velocities));
    let carrier = |(body, velocities): (_, BTreeSet<usize>)| Carrier {
        body,
        velocities: velocities.into_iter().collect(),
        markers: Vec::new(),
    };
    bodies.into_iter().map(carrier).collect()
}

/// The outputs that an expression reads by their names, beyond scalars of markers.
fn outputs_of<'a, const D: usize>(model: &'a Model<D>, formula: &'a Formula) -> impl Iterator<Item = &'a Measure> {
    formula.probes.iter().filter_map(|probe| match probe.quantity {
        Quantity::Output(number) => Some(&model.outputs[number].measure),
        _ => None,
    })
}

/// The bodies that an output reads.
pub(super) fn carriers<const D: usize>(layout: &Layout<D>, measure: &Measure) -> Vec<Carrier> {
    let on = |markers: &[usize]| Carrier::all(markers, &layout.supports);
    let model = &layout.model;
    match measure {
        Measure::Formula(formula) => {
            let others = outputs_of(model, formula).flat_map(|measure| carriers(layout, measure));
            merged(on(&formula.markers()).into_iter().chain(others))
        }
        Measure::Probe(probe) => on(&probe.markers().collect::<Vec<_>>()),
        Measure::Reaction { joint, axes, .. } => {
            let markers = model.joints[*joint].markers.iter().chain([axes]);
            on(&markers.copied().collect::<Vec<_>>())
        }
        Measure::Elastic(combination) => bodies_with(model, &combination.coordinates()),
        Measure::Station(place) => on(&place.markers()),
        Measure::Section { cut, .. } => {
            let cut = &model.cuts[*cut];
            let mut carriers = on(&markers_beyond(model, cut));
            carriers.retain(|carrier| carrier.body != cut.body);
            carriers.push(whole(cut.body, &model.bodies[cut.body]));
            carriers
        }
        Measure::Force(force) | Measure::Power { force } => on(&model.forces[*force].markers),
        Measure::Load { force, axes, .. } => {
            let markers = model.forces[*force].markers.iter().chain([axes]);
            on(&markers.copied().collect::<Vec<_>>())
        }
        Measure::DrivePower { joint } => on(&model.joints[*joint].markers),
        Measure::Energy(_) => model.bodies.iter().enumerate().map(|(index, part)| whole(index, part)).collect(),
        Measure::Multiplier { .. } | Measure::Push { .. } => Vec::new(),
    }
}

/// The joints whose multipliers an output reads.
pub(super) fn joints_of<const D: usize>(model: &Model<D>, measure: &Measure) -> Vec<usize> {
    match measure {
        Measure::Reaction { joint, .. }
        | Measure::Multiplier { joint }
        | Measure::Push { joint }
        | Measure::DrivePower { joint } => vec![*joint],
        Measure::Formula(formula) => outputs_of(model, formula).flat_map(|measure| joints_of(model, measure)).collect(),
        Measure::Section { cut, .. } => model.cuts[*cut].joints.iter().map(|&(joint, _)| joint).collect(),
        _ => Vec::new(),
    }
}

/// The forces that an output reads, whose inputs it depends on.
pub(super) fn forces_of<const D: usize>(model: &Model<D>, measure: &Measure) -> Vec<usize> {
    match measure {
        Measure::Force(force) | Measure::Power { force } | Measure::Load { force, .. } => vec![*force],
        Measure::Formula(formula) => outputs_of(model, formula).flat_map(|measure| forces_of(model, measure)).collect(),
        Measure::Section { cut, .. } => model.cuts[*cut].forces.iter().map(|&(force, _)| force).collect(),
        _ => Vec::new(),
    }
}

/// The bodies that own elastic coordinates, which are the last ones of each and have a velocity each.
fn bodies_with<const D: usize>(model: &Model<D>, coordinates: &[usize]) -> Vec<Carrier> {
    let of = |(body, part): (usize, &Part<D>)| {
        let range = part.first_q..part.first_q + part.nq;
        let own = coordinates.iter().filter(|coordinate| range.contains(coordinate));
        let velocities = own.map(|coordinate| part.first_v + part.nv - (range.end - coordinate)).collect();
        Carrier { body, velocities, markers: Vec::new() }
    };
    model.bodies.iter().enumerate().map(of).filter(|carrier| !carrier.velocities.is_empty()).collect()
}
