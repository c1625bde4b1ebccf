//! A state as outputs and energies read it, over one scalar type: floats give values, dual numbers derivatives.

use super::gather::MovingFrames;
use super::seed::fixed;
use super::terms::OperatingPoint;
use super::variation::SeededBody;
use crate::body::{Dual6, Energy, Frame, MarkerId};
use crate::math::array::from_fn;
use crate::math::{Regime, Scalar, Taylor, Time};
use crate::scene::{Model, Part};

/// Access to the quantities of a state.
pub(super) trait StateView<S: Scalar, const D: usize> {
    fn time(&self) -> Time<'_, f64>;
    /// A coordinate of the system.
    fn q(&self, coordinate: usize) -> S;
    /// A velocity.
    fn v(&self, direction: usize) -> S;
    /// The rate of a velocity.
    fn vdot(&self, direction: usize) -> S;
    fn frame(&self, marker: MarkerId) -> Frame<Taylor<S>, D>;
    /// Energy of a body by itself, without forces.
    fn energy(&self, part: &Part<D>, gravity: &[f64; D]) -> Energy<S>;
    fn lambda(&self, row: usize) -> S;
    /// Sum of the inputs on the three components of a force, with their rates; zero for a force without inputs.
    fn input(&self, force: usize) -> [Taylor<S>; 3];
}

/// The state over floats. Frames are evaluated one by one: few markers of a large mechanism are read.
pub(super) struct Plain<'a, const D: usize> {
    pub model: &'a Model<D>,
    /// Frames have the accelerations v' of the state; where that is empty, those at v' = 0.
    pub at: OperatingPoint<'a>,
    pub regime: Regime<'a>,
    /// Values of the inputs; empty where all are zero.
    pub inputs: &'a [f64],
}

impl<const D: usize> StateView<f64, D> for Plain<'_, D> {
    fn time(&self) -> Time<'_, f64> {
        Time { t: self.at.t, regime: self.regime }
    }
    fn q(&self, coordinate: usize) -> f64 {
        self.at.q[coordinate]
    }
    fn v(&self, direction: usize) -> f64 {
        self.at.v[direction]
    }
    fn vdot(&self, direction: usize) -> f64 {
        self.at.vdot[direction]
    }
    fn frame(&self, marker: MarkerId) -> Frame<Taylor<f64>, D> {
        let mut frame = Frame::world();
        match self.model.carrier(marker) {
            None => frame = Frame::world().at(&self.model.ground[marker]),
            Some(part) => {
                let OperatingPoint { q, v, vdot, .. } = self.at;
                let vdot = (!vdot.is_empty()).then(|| part.velocities(vdot));
                let q = part.coordinates(q);
                let v = part.velocities(v);
                let first = marker - part.first_marker;
                part.body.motion(q, v, vdot, first, std::slice::from_mut(&mut frame));
            }
        }
        frame
    }
    fn energy(&self, part: &Part<D>, gravity: &[f64; D]) -> Energy {
        part.body.energy(part.coordinates(self.at.q), part.velocities(self.at.v), gravity)
    }
    fn lambda(&self, row: usize) -> f64 {
        self.at.lambda[row]
    }
    fn input(&self, force: usize) -> [Taylor<f64>; 3] {
        input_on(self.model, force, self.inputs).map(Taylor::fixed)
    }
}

/// Sum of the inputs, held constant, on the three components of a force.
pub(super) fn input_on<const D: usize>(model: &Model<D>, force: usize, inputs: &[f64]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for (input, u) in model.inputs.iter().zip(inputs) {
        match input.target.force() {
            Some((target, component)) if target == force => sum[component] += u,
            _ => {}
        }
    }
    sum
}

/// The quantities that are seeded along six directions.
#[derive(Clone, Copy)]
pub(super) enum Seed<'a, const D: usize> {
    /// A body, with its values in [`SeededBody`].
    Body(&'a Part<D>),
    /// Six multipliers from this row on.
    Multipliers(usize),
    /// The inputs on the three components of a force, then their rates.
    Inputs(usize),
}

/// The state as a function of six directions.
pub(super) struct SeededView<'a, const D: usize> {
    pub at: OperatingPoint<'a>,
    pub regime: Regime<'a>,
    pub motion: &'a MovingFrames<D>,
    pub varied: &'a SeededBody<D>,
    pub seed: Seed<'a, D>,
}

impl<const D: usize> SeededView<'_, D> {
    /// Entry `index` from `varied` if it belongs to the seeded body, whose entries begin at `first`; else from `fixed`.
    fn value(&self, varied: &[Dual6], first: impl Fn(&Part<D>) -> usize, fixed: &[f64], index: usize) -> Dual6 {
        let own = match self.seed {
            Seed::Body(part) => index.checked_sub(first(part)).and_then(|i| varied.get(i)),
            _ => None,
        };
        own.copied().unwrap_or_else(|| Dual6::fixed(fixed[index]))
    }
}

impl<const D: usize> StateView<Dual6, D> for SeededView<'_, D> {
    fn time(&self) -> Time<'_, f64> {
        Time { t: self.at.t, regime: self.regime }
    }
    fn q(&self, coordinate: usize) -> Dual6 {
        self.value(&self.varied.moved, |part| part.first_q, self.at.q, coordinate)
    }
    fn v(&self, direction: usize) -> Dual6 {
        self.value(&self.varied.moved_v, |part| part.first_v, self.at.v, direction)
    }
    fn vdot(&self, direction: usize) -> Dual6 {
        self.value(&self.varied.moved_vdot, |part| part.first_v, self.at.vdot, direction)
    }
    fn frame(&self, marker: MarkerId) -> Frame<Taylor<Dual6>, D> {
        match self.seed {
            Seed::Body(part) if part.markers().contains(&marker) => {
                let mut frame = Frame::world();
                self.varied.write(part, marker, self.motion, &mut frame);
                frame
            }
            _ => fixed(&self.motion[marker]),
        }
    }
    fn energy(&self, part: &Part<D>, gravity: &[f64; D]) -> Energy<Dual6> {
        match self.seed {
            Seed::Body(moved) if moved.first_v == part.first_v => {
                part.body.energy(&self.varied.moved, &self.varied.moved_v, gravity)
            }
            _ => {
                let q = part.coordinates(self.at.q);
                let v = part.velocities(self.at.v);
                let Energy { kinetic, potential } = part.body.energy(q, v, gravity);
                Energy { kinetic: Dual6::fixed(kinetic), potential: Dual6::fixed(potential) }
            }
        }
    }
    fn lambda(&self, row: usize) -> Dual6 {
        match self.seed {
            Seed::Multipliers(first) if (first..first + 6).contains(&row) => {
                Dual6::seeded(self.at.lambda[row], row - first)
            }
            _ => Dual6::fixed(self.at.lambda[row]),
        }
    }
    fn input(&self, force: usize) -> [Taylor<Dual6>; 3] {
        match self.seed {
            Seed::Inputs(driven) if driven == force => from_fn(|component| {
                let x = Dual6::seeded(0.0, component);
                let d = Dual6::seeded(0.0, 3 + component);
                Taylor::new(x, d, Dual6::fixed(0.0))
            }),
            _ => [Taylor::fixed(Dual6::fixed(0.0)); 3],
        }
    }
}
