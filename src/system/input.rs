//! Inputs: what they add to, generalized forces per unit of each, and their values.

use super::mechanism::{Mechanism, of};
use super::variation::fixed;
use super::view::{Plain, View, gathered};
use super::workspace::Workspace;
use crate::body::{Dual6, MOST_MARKERS, Wrench};
use crate::math::array::from_fn;
use crate::math::{Taylor, Time};
use nalgebra::DMatrix;

/// The equation that an input u is part of; it decides which derivatives of u are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Excitation {
    /// f(u).
    Force,
    /// f(u, u'): a displacement under a damped element.
    Displacement,
    /// phi - u in this row: a prescribed coordinate. u' is part of phi', u'' of phi''.
    Constraint(usize),
}

impl Excitation {
    /// Order of the highest derivative of u in the equations of index 1.
    pub fn order(self) -> usize {
        match self {
            Excitation::Force => 0,
            Excitation::Displacement => 1,
            Excitation::Constraint(_) => 2,
        }
    }
}

impl<const D: usize> Mechanism<D> {
    /// df/du of each input or, for `derivative` 1, df/du', n_v x n_u; the frames of `work` are those at q.
    pub(super) fn write_input_forces(
        &self,
        derivative: usize,
        (time, q): (Time<f64>, &[f64]),
        work: &mut Workspace<D>,
        f: &mut DMatrix<f64>,
    ) {
        f.fill(0.0);
        for (mut column, input) in f.column_iter_mut().zip(&self.model().inputs) {
            let Some((force, component)) = input.target.force() else { continue };
            let wrenches = self.input_wrenches(derivative, time, (force, component), work);
            for (wrench, &marker) in wrenches.iter().zip(&self.model().forces[force].markers) {
                let Some(part) = self.model().carrier(marker) else { continue };
                let frame = work.motion[marker].map(|x| x.x);
                self.supports[marker].add_to(column.as_mut_slice(), &mut work.pulled, |f| {
                    part.body.pull_back(marker - part.first_marker, of(q, part, true), &frame, wrench, f);
                });
            }
        }
    }

    /// Wrenches that one unit of an input, or of its rate, adds at the markers of its force.
    fn input_wrenches(
        &self,
        derivative: usize,
        time: Time<f64>,
        (force, component): (usize, usize),
        work: &Workspace<D>,
    ) -> [Wrench<f64, D>; MOST_MARKERS] {
        let force = &self.model().forces[force];
        let mut unit = [Taylor::fixed(Dual6::fixed(0.0)); 3];
        unit[component] = Taylor::new(Dual6::seeded(0.0, 0), Dual6::seeded(0.0, 1), Dual6::fixed(0.0));
        let mut wrenches = [Wrench::zero(); MOST_MARKERS];
        let out = &mut wrenches[..force.markers.len()];
        let drive = |frames: &[_]| force.element.driven(&unit, frames, time.map(Taylor::<Dual6>::time), out);
        gathered(&force.markers, |marker| fixed(&work.motion[marker]), drive);
        let slope = |x: Dual6| x.eps[derivative];
        from_fn(|i| Wrench { force: wrenches[i].force.map(slope), torque: wrenches[i].torque.map(slope) })
    }

    /// Values of the inputs in a simulation.
    pub(super) fn write_input_values(&self, view: &Plain<D>, out: &mut [f64]) {
        for (out, input) in out.iter_mut().zip(&self.model().inputs) {
            let value = input.value.as_ref();
            let read = |formula: &crate::body::Formula| {
                formula.evaluate(view.time(), |probe| probe.read(view.regime, |marker| view.frame(marker)))
            };
            *out = value.map_or(0.0, read);
        }
    }
}
