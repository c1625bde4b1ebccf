//! Generalized forces per unit of each input.

use super::mechanism::{Mechanism, of};
use super::variation::fixed;
use super::view::gathered;
use super::workspace::Workspace;
use crate::body::{Dual6, MOST_MARKERS, Wrench};
use crate::math::{Taylor, Time};
use crate::scene::ForceInput;
use nalgebra::DMatrix;
use std::array::from_fn;

impl<const D: usize> Mechanism<D> {
    /// df/du, n_v x n_u; the frames of `work` are those at q.
    pub(super) fn write_input_forces(&self, time: Time<f64>, q: &[f64], work: &mut Workspace<D>, f: &mut DMatrix<f64>) {
        f.fill(0.0);
        for (mut column, input) in f.column_iter_mut().zip(&self.model().inputs) {
            let wrenches = self.input_wrenches(time, input, work);
            for (wrench, &marker) in wrenches.iter().zip(&self.model().forces[input.force].markers) {
                let Some(part) = self.model().carrier(marker) else { continue };
                let frame = work.motion[marker].map(|x| x.x);
                self.supports[marker].add_to(column.as_mut_slice(), &mut work.pulled, |f| {
                    part.body.pull_back(marker - part.first_marker, of(q, part, true), &frame, wrench, f);
                });
            }
        }
    }

    /// Wrenches that one unit of an input adds at the markers of its force.
    fn input_wrenches(
        &self,
        time: Time<f64>,
        input: &ForceInput,
        work: &Workspace<D>,
    ) -> [Wrench<f64, D>; MOST_MARKERS] {
        let force = &self.model().forces[input.force];
        let mut unit = [Dual6::fixed(0.0); 3];
        unit[input.component] = Dual6::seeded(0.0, 0);
        let mut wrenches = [Wrench::zero(); MOST_MARKERS];
        let out = &mut wrenches[..force.markers.len()];
        let drive = |frames: &[_]| force.element.driven(&unit, frames, time.map(Taylor::<Dual6>::time), out);
        gathered(&force.markers, |marker| fixed(&work.motion[marker]), drive);
        from_fn(|i| Wrench { force: wrenches[i].force.map(|x| x.eps[0]), torque: wrenches[i].torque.map(|x| x.eps[0]) })
    }
}
