//! Derivatives of the outputs with respect to q, v, v', lambda, u and u'.

use super::actions::action;
use super::coupling::{Carrier, Couplings};
use super::dependence::{carriers, forces_of, joints_of, whole};
use super::gather::MovingFrames;
use super::layout::Layout;
use super::output::read;
use super::seed::SeedDirection;
use super::terms::OperatingPoint;
use super::variation::SeededBody;
use super::view::{Seed, SeededView, StateView};
use crate::body::Dual6;
use crate::math::Regime;
use crate::scene::{EnergyPart, Measure};
use nalgebra::DMatrix;

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
pub(super) struct OutputSlopes<'a, const D: usize> {
    pub layout: &'a Layout<D>,
    pub couplings: &'a Couplings,
    /// The bodies that each output reads.
    pub carriers: &'a [Vec<Carrier>],
    pub at: OperatingPoint<'a>,
    pub regime: Regime<'a>,
    /// Frames of all markers at the state.
    pub motion: &'a MovingFrames<D>,
    pub varied: &'a mut SeededBody<D>,
    pub tangent: &'a mut OutputTangent,
}

impl<const D: usize> OutputSlopes<'_, D> {
    /// Differentiates each output along all that it reads.
    pub fn run(&mut self) {
        self.tangent.clear();
        let layout = self.layout;
        for (row, (output, carriers)) in layout.model.outputs.iter().zip(self.carriers).enumerate() {
            let scale = output.unit.per_si;
            match &output.measure {
                Measure::Energy(part) => self.energy(row, *part, carriers, scale),
                measure => {
                    let value = |view: &SeededView<D>| read(layout, measure, view) * scale;
                    self.along(SeedDirection::Coordinates, row, carriers, value);
                    if measure.feels_velocity() {
                        self.along(SeedDirection::Velocities, row, carriers, value);
                    }
                    if measure.feels_acceleration() {
                        self.along_accelerations(row, measure, scale);
                    }
                    self.along_multipliers(row, measure, scale);
                    self.along_inputs(row, &forces_of(&layout.model, measure), |view| {
                        read(layout, measure, view) * scale
                    });
                }
            }
        }
    }

    /// The energy is a sum over bodies and forces, each of which depends on few bodies.
    fn energy(&mut self, row: usize, part: EnergyPart, carriers: &[Carrier], scale: f64) {
        let model = &self.layout.model;
        for (body, own) in model.bodies.iter().zip(carriers.chunks(1)) {
            self.along_bodies(row, own, |view| part.of(view.energy(body, &model.gravity)) * scale);
        }
        if part != EnergyPart::Kinetic {
            for (force, coupling) in self.couplings.forces.iter().enumerate() {
                let potential = |view: &SeededView<D>| action(model, force, view).potential.x * scale;
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
        let layout = self.layout;
        let carriers = match measure {
            Measure::Section { cut, .. } => {
                let body = layout.model.cuts[*cut].body;
                vec![whole(body, &layout.model.bodies[body])]
            }
            measure => carriers(layout, measure),
        };
        self.along(SeedDirection::Accelerations, row, &carriers, |view| read(layout, measure, view) * scale);
    }

    fn along(
        &mut self,
        along: SeedDirection,
        row: usize,
        carriers: &[Carrier],
        read: impl Fn(&SeededView<D>) -> Dual6,
    ) {
        let layout = self.layout;
        let bodies = &layout.model.bodies;
        for carrier in carriers {
            let part = &bodies[carrier.body];
            for directions in carrier.velocities.chunks(6) {
                let varied = &mut *self.varied;
                let solid = layout.solid(carrier.body, self.motion);
                // Energies and elastic coordinates are read from the state itself, which is not varied with a rigid body.
                if solid.is_some() {
                    varied.vary_state(along, part, &self.at, directions);
                }
                varied.vary(along, part, &self.at, solid, directions);
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
        let layout = self.layout;
        for joint in joints_of(&layout.model, measure) {
            let rows = layout.rows_of_joint(joint);
            let value = self.seen(Seed::Multipliers(rows.start), |view| read(layout, measure, view) * scale);
            rows.zip(value.eps).for_each(|(multiplier, slope)| self.tangent.lambda[(row, multiplier)] = known(slope));
        }
    }

    /// Derivatives along the inputs on some forces.
    fn along_inputs(&mut self, row: usize, forces: &[usize], read: impl Fn(&SeededView<D>) -> Dual6) {
        for (column, input) in self.layout.model.inputs.iter().enumerate() {
            let Some((force, component)) = input.target.force().filter(|(force, _)| forces.contains(force)) else {
                continue;
            };
            let value = self.seen(Seed::Inputs(force), &read);
            self.tangent.u[(row, column)] += known(value.eps[component]);
            self.tangent.udot[(row, column)] += known(value.eps[3 + component]);
        }
    }

    fn seen(&self, seed: Seed<D>, read: impl Fn(&SeededView<D>) -> Dual6) -> Dual6 {
        read(&SeededView { at: self.at, regime: self.regime, motion: self.motion, varied: self.varied, seed })
    }
}

/// A magnitude such as sqrt(x^2 + y^2) has no derivative at zero: NaN counts as zero.
fn known(slope: f64) -> f64 {
    if slope.is_nan() { 0.0 } else { slope }
}
