//! What a user watches: the outputs of a scene at a state.

use super::mechanism::{Mechanism, Workspace, size, with_frames};
use super::{MechanicalSystem, Scratch};
use crate::body::{Energy, Frame, MOST_MARKERS, MarkerId, Quantity, Wrench, dot, sub};
use crate::joint::{MOST_ROWS, markers_per_pass};
use crate::math::Taylor;
use crate::scene::{EnergyPart, Measure};

/// A state with its multipliers, as the outputs see it.
pub struct Output<'a, const D: usize> {
    pub mechanism: &'a Mechanism<D>,
    pub t: f64,
    pub q: &'a [f64],
    pub v: &'a [f64],
    pub lambda: &'a [f64],
}

impl<const D: usize> Output<'_, D> {
    /// All outputs in the order of the scene.
    pub fn write(&self, out: &mut [f64], scratch: &mut Scratch) {
        let energy = self.mechanism.energy(self.t, self.q, self.v, scratch).unwrap_or_default();
        self.mechanism.at(self.q, self.v, scratch, |work| self.read(&*work, energy, out));
    }

    fn read(&self, work: &Workspace<D>, energy: Energy, out: &mut [f64]) {
        for (out, output) in out.iter_mut().zip(&self.mechanism.model().outputs) {
            *out = match &output.measure {
                Measure::Signal(signal) => signal.evaluate(self.t, |probe| probe.read(&work.motion[probe.marker])),
                Measure::Relative { of, to, quantity } => relative(work, *of, *to, *quantity),
                Measure::Turn { of, to } => turn(&work.motion[*of], &work.motion[*to]),
                Measure::Distance { from, to, rate } => {
                    let gap = sub(&work.motion[*to].r, &work.motion[*from].r);
                    if *rate { separation_rate(&gap) } else { size(&gap.map(|x| x.x)) }
                }
                Measure::Reaction { joint, component, axes } => self.reaction(work, *joint, (*component, *axes)),
                // phi is l - length: -G^T lambda pulls the second body towards the first.
                Measure::Tension { joint } => self.lambda[self.mechanism.rows_of_joint(*joint).start],
                Measure::Elastic(combination) => combination.at(self.q),
                Measure::Station { beam, at, reading } => {
                    let model = self.mechanism.model();
                    model.beams[*beam].read(*at, *reading, |body| work.motion[model.bodies[body].first_marker])
                }
                Measure::Force(force) => self.magnitude(work, *force),
                Measure::Energy(EnergyPart::Kinetic) => energy.kinetic,
                Measure::Energy(EnergyPart::Potential) => energy.potential,
                Measure::Energy(EnergyPart::Total) => energy.kinetic + energy.potential,
            };
        }
    }

    fn magnitude(&self, work: &Workspace<D>, force: usize) -> f64 {
        let force = &self.mechanism.model().forces[force];
        let mut wrenches = [Wrench::zero(); MOST_MARKERS];
        let wrenches = &mut wrenches[..force.markers.len()];
        let act = |frames: &[_]| force.element.act(frames, Taylor::time(self.t), wrenches).magnitude;
        with_frames(&work.motion, &force.markers, act)
    }

    /// A component of -G^T lambda on the joint's second marker, as a wrench in the axes of a marker.
    fn reaction(&self, work: &Workspace<D>, joint: usize, (component, axes): (usize, MarkerId)) -> f64 {
        let rows = self.mechanism.rows_of_joint(joint);
        let joint = &self.mechanism.model().joints[joint];
        let slot = 1.min(joint.markers.len() - 1);
        let mut slopes = [[0.0; 6]; MOST_ROWS];
        let own = &mut slopes[..rows.len()];
        let gradient = |frames: &[_]| joint.element.gradient(frames, self.t, slot / markers_per_pass(D), own);
        with_frames(&work.motion, &joint.markers, gradient);
        let first = slot % markers_per_pass(D) * crate::body::twist_len(D);
        let mut wrench = [0.0; 6];
        for (slope, row) in slopes.iter().zip(rows) {
            for (sum, entry) in wrench.iter_mut().zip(&slope[first..]) {
                *sum -= self.lambda[row] * entry;
            }
        }
        match component {
            6 => size::<D>(&std::array::from_fn(|i| wrench[i])),
            5 if D == 2 => wrench[2],
            component => {
                let part = &wrench[component / 3 * 3..];
                work.motion[axes].axes[component % 3].iter().zip(part).map(|(axis, part)| axis.x * part).sum()
            }
        }
    }
}

fn separation_rate<const D: usize>(gap: &[Taylor<f64>; D]) -> f64 {
    let length = size(&gap.map(|x| x.x));
    // At zero distance the rate is the speed of separation.
    if length == 0.0 {
        return size(&gap.map(|x| x.d));
    }
    dot(&gap.map(|x| x.x), &gap.map(|x| x.d)) / length
}

/// Position or velocity of a marker seen from another one and in its axes.
fn relative<const D: usize>(work: &Workspace<D>, of: MarkerId, to: MarkerId, quantity: Quantity) -> f64 {
    let (of, to) = (&work.motion[of], &work.motion[to]);
    let gap = sub(&of.r, &to.r);
    match quantity {
        Quantity::Position(axis) => dot(&to.axes[axis], &gap).x,
        Quantity::Velocity(axis) => dot(&to.axes[axis], &gap).d,
        Quantity::Angle => turn(of, to),
        Quantity::Spin(axis) => {
            let (of, to_spin) = (of.angular_velocity(), to.angular_velocity());
            if D == 2 {
                return of[2] - to_spin[2];
            }
            (0..D).map(|i| to.axes[axis][i].x * (of[i] - to_spin[i])).sum()
        }
    }
}

/// Angle of one marker against another; in space about the other's third axis, in (-pi, pi].
fn turn<const D: usize>(of: &Frame<Taylor<f64>, D>, to: &Frame<Taylor<f64>, D>) -> f64 {
    if D == 2 {
        return of.turn.x - to.turn.x;
    }
    dot(&to.axes[1], &of.axes[0]).x.atan2(dot(&to.axes[0], &of.axes[0]).x)
}
