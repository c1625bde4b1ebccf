//! Derivatives of the outputs with respect to q, v, v', lambda, u and u'.

use super::coupling::Carrier;
use super::mechanism::Mechanism;
use super::tangent::OperatingPoint;
use super::variation::SeedDirection;
use super::view::{Seed, SeededView, View};
use super::workspace::Workspace;
use crate::body::{Dual6, Formula, Quantity};
use crate::math::Regime;
use crate::scene::{EnergyPart, Measure, Part};
use nalgebra::DMatrix;
use std::collections::{BTreeMap, BTreeSet};

/// Derivatives of the outputs y(t, q, v, v', lambda, u, u'), a row each.
#[derive(Clone, Debug, PartialEq)]
pub struct OutputTangent {
    /// n_y x n_v: along the directions of v, q + N(q) e_j, at fixed v, v', lambda and u.
    pub q: DMatrix<f64>,
    /// dy/dv, n_y x n_v
    pub v: DMatrix<f64>,
    /// dy/dv', n_y x n_v
    pub vdot: DMatrix<f64>,
    /// dy/dlambda, n_y x n_c
    pub lambda: DMatrix<f64>,
    /// dy/du, n_y x n_u: the direct part, such as that of the magnitude of a force with an input.
    pub u: DMatrix<f64>,
    /// dy/du', n_y x n_u
    pub udot: DMatrix<f64>,
}

impl OutputTangent {
    /// All zero, for these dimensions.
    pub fn new(n_y: usize, n_v: usize, n_c: usize, n_u: usize) -> Self {
        let zeros = |columns| DMatrix::zeros(n_y, columns);
        OutputTangent {
            q: zeros(n_v),
            v: zeros(n_v),
            vdot: zeros(n_v),
            lambda: zeros(n_c),
            u: zeros(n_u),
            udot: zeros(n_u),
        }
    }

    /// Sets all matrices to zero.
    pub fn clear(&mut self) {
        let all = [&mut self.q, &mut self.v, &mut self.vdot, &mut self.lambda, &mut self.u, &mut self.udot];
        all.into_iter().for_each(|matrix| matrix.as_mut_slice().fill(0.0));
    }
}

/// One evaluation of [`OutputTangent`].
pub(super) struct Slopes<'a, const D: usize> {
    pub mechanism: &'a Mechanism<D>,
    pub at: OperatingPoint<'a>,
    pub regime: Regime<'a>,
    pub work: &'a mut Workspace<D>,
    pub tangent: &'a mut OutputTangent,
}

impl<const D: usize> Slopes<'_, D> {
    /// Differentiates each output along all that it reads.
    pub fn run(&mut self) {
        self.tangent.clear();
        let mechanism = self.mechanism;
        let outputs = &self.mechanism.model().outputs;
        let mut read = std::mem::take(&mut self.work.read);
        if read.len() < outputs.len() {
            read = outputs.iter().map(|output| mechanism.carriers(&output.measure)).collect();
        }
        for (row, (output, carriers)) in outputs.iter().zip(&read).enumerate() {
            let scale = output.unit.per_si;
            match &output.measure {
                Measure::Energy(part) => self.energy(row, *part, carriers, scale),
                measure => {
                    let value = |view: &SeededView<D>| mechanism.read(measure, view) * scale;
                    self.along(SeedDirection::Coordinates, row, carriers, value);
                    if measure.feels_velocity() {
                        self.along(SeedDirection::Velocities, row, carriers, value);
                    }
                    if measure.feels_acceleration() {
                        self.along_accelerations(row, measure, scale);
                    }
                    self.along_multipliers(row, measure, scale);
                    self.along_inputs(row, &mechanism.forces_of(measure), |view| mechanism.read(measure, view) * scale);
                }
            }
        }
        self.work.read = read;
    }

    /// The energy is a sum over bodies and forces, each of which depends on few bodies.
    fn energy(&mut self, row: usize, part: EnergyPart, carriers: &[Carrier], scale: f64) {
        let mechanism = self.mechanism;
        let model = self.mechanism.model();
        for (body, own) in model.bodies.iter().zip(carriers.chunks(1)) {
            self.along_bodies(row, own, |view| part.of(view.energy(body, &model.gravity)) * scale);
        }
        if part != EnergyPart::Kinetic {
            for (force, coupling) in mechanism.couplings.forces.iter().enumerate() {
                let potential = |view: &SeededView<D>| mechanism.action(force, view).potential.x * scale;
                self.along_bodies(row, &coupling.carriers, potential);
                self.along_inputs(row, &[force], potential);
            }
        }
    }

    fn along_bodies(&mut self, row: usize, carriers: &[Carrier], read: impl Fn(&SeededView<D>) -> Dual6) {
        self.along(SeedDirection::Coordinates, row, carriers, &read);
        self.along(SeedDirection::Velocities, row, carriers, &read);
    }

    /// Derivatives along v' of the bodies whose accelerations are read.
    fn along_accelerations(&mut self, row: usize, measure: &Measure, scale: f64) {
        let mechanism = self.mechanism;
        let carriers = match measure {
            Measure::Section { cut, .. } => {
                let body = mechanism.model().cuts[*cut].body;
                vec![whole(body, &mechanism.model().bodies[body])]
            }
            measure => mechanism.carriers(measure),
        };
        self.along(SeedDirection::Accelerations, row, &carriers, |view| mechanism.read(measure, view) * scale);
    }

    fn along(
        &mut self,
        along: SeedDirection,
        row: usize,
        carriers: &[Carrier],
        read: impl Fn(&SeededView<D>) -> Dual6,
    ) {
        let bodies = &self.mechanism.model().bodies;
        for carrier in carriers {
            let part = &bodies[carrier.body];
            for directions in carrier.velocities.chunks(6) {
                let Workspace { varied, motion, .. } = &mut *self.work;
                let solid = self.mechanism.solid(carrier.body, motion);
                // Energies and elastic coordinates are read from the state itself, which is not varied with a rigid body.
                if solid.is_some() {
                    varied.vary_state(along, part, &self.at, directions);
                }
                varied.vary(along, part, (&self.at, solid), directions);
                let value = self.seen(Seed::Body(part), &read);
                let target = match along {
                    SeedDirection::Coordinates => &mut self.tangent.q,
                    SeedDirection::Velocities => &mut self.tangent.v,
                    SeedDirection::Accelerations => &mut self.tangent.vdot,
                };
                let slopes = directions.iter().zip(value.eps);
                slopes.for_each(|(&direction, slope)| target[(row, direction)] += known(slope));
            }
        }
    }

    fn along_multipliers(&mut self, row: usize, measure: &Measure, scale: f64) {
        for joint in self.mechanism.joints_of(measure) {
            let rows = self.mechanism.rows_of_joint(joint);
            let value = self.seen(Seed::Multipliers(rows.start), |view| self.mechanism.read(measure, view) * scale);
            rows.zip(value.eps).for_each(|(multiplier, slope)| self.tangent.lambda[(row, multiplier)] = known(slope));
        }
    }

    /// Derivatives along the inputs on some forces.
    fn along_inputs(&mut self, row: usize, forces: &[usize], read: impl Fn(&SeededView<D>) -> Dual6) {
        for (column, input) in self.mechanism.model().inputs.iter().enumerate() {
            let Some((force, component)) = input.target.force().filter(|(force, _)| forces.contains(force)) else {
                continue;
            };
            let value = self.seen(Seed::Inputs(force), &read);
            self.tangent.u[(row, column)] += known(value.eps[component]);
            self.tangent.udot[(row, column)] += known(value.eps[3 + component]);
        }
    }

    fn seen(&self, seed: Seed<D>, read: impl Fn(&SeededView<D>) -> Dual6) -> Dual6 {
        read(&SeededView {
            at: self.at,
            regime: self.regime,
            motion: &self.work.motion,
            varied: &self.work.varied,
            seed,
        })
    }
}

/// A magnitude such as sqrt(x^2 + y^2) has no derivative at zero: NaN counts as zero.
fn known(slope: f64) -> f64 {
    if slope.is_nan() { 0.0 } else { slope }
}

/// A carrier that moves along all velocities of its body.
fn whole<const D: usize>(body: usize, part: &Part<D>) -> Carrier {
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

impl<const D: usize> Mechanism<D> {
    /// The outputs that an expression reads by their names, beyond scalars of markers.
    fn outputs_of<'a>(&'a self, formula: &'a Formula) -> impl Iterator<Item = &'a Measure> {
        formula.probes.iter().filter_map(|probe| match probe.quantity {
            Quantity::Output(number) => Some(&self.model().outputs[number].measure),
            _ => None,
        })
    }

    /// The bodies that an output reads.
    fn carriers(&self, measure: &Measure) -> Vec<Carrier> {
        let on = |markers: &[usize]| Carrier::all(markers, &self.supports);
        let model = self.model();
        match measure {
            Measure::Formula(formula) => {
                let others = self.outputs_of(formula).flat_map(|measure| self.carriers(measure));
                merged(on(&formula.markers()).into_iter().chain(others))
            }
            Measure::Probe(probe) => on(&probe.markers().collect::<Vec<_>>()),
            Measure::Reaction { joint, axes, .. } => {
                let markers = model.joints[*joint].markers.iter().chain([axes]);
                on(&markers.copied().collect::<Vec<_>>())
            }
            Measure::Elastic(combination) => self.bodies_with(&combination.coordinates()),
            Measure::Station(place) => on(&place.markers()),
            Measure::Section { cut, .. } => {
                let cut = &model.cuts[*cut];
                let mut carriers = on(&self.markers_beyond(cut));
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
    fn joints_of(&self, measure: &Measure) -> Vec<usize> {
        match measure {
            Measure::Reaction { joint, .. }
            | Measure::Multiplier { joint }
            | Measure::Push { joint }
            | Measure::DrivePower { joint } => vec![*joint],
            Measure::Formula(formula) => self.outputs_of(formula).flat_map(|measure| self.joints_of(measure)).collect(),
            Measure::Section { cut, .. } => self.model().cuts[*cut].joints.iter().map(|&(joint, _)| joint).collect(),
            _ => Vec::new(),
        }
    }

    /// The forces that an output reads, whose inputs it depends on.
    fn forces_of(&self, measure: &Measure) -> Vec<usize> {
        match measure {
            Measure::Force(force) | Measure::Power { force } | Measure::Load { force, .. } => vec![*force],
            Measure::Formula(formula) => self.outputs_of(formula).flat_map(|measure| self.forces_of(measure)).collect(),
            Measure::Section { cut, .. } => self.model().cuts[*cut].forces.iter().map(|&(force, _)| force).collect(),
            _ => Vec::new(),
        }
    }

    /// The bodies that own elastic coordinates, which are the last ones of each and have a velocity each.
    fn bodies_with(&self, coordinates: &[usize]) -> Vec<Carrier> {
        let of = |(body, part): (usize, &Part<D>)| {
            let range = part.first_q..part.first_q + part.nq;
            let own = coordinates.iter().filter(|coordinate| range.contains(coordinate));
            let velocities = own.map(|coordinate| part.first_v + part.nv - (range.end - coordinate)).collect();
            Carrier { body, velocities, markers: Vec::new() }
        };
        self.model().bodies.iter().enumerate().map(of).filter(|carrier| !carrier.velocities.is_empty()).collect()
    }
}
