//! Inputs: generalized forces per unit of each, and their values.

use super::gather::{MovingFrames, gathered};
use super::layout::Layout;
use super::seed::fixed;
use super::view::{Plain, StateView};
use crate::body::{Dual6, Formula, MOST_MARKERS, Wrench};
use crate::math::array::from_fn;
use crate::math::{Taylor, Time};
use crate::scene::ModelForce;
use nalgebra::DMatrix;

/// df/du of each input or, for `derivative` 1, df/du', n_v x n_u; `motion` has the frames of all markers at q.
pub(super) fn write_input_forces<const D: usize>(
    layout: &Layout<D>,
    derivative: usize,
    time: Time<f64>,
    q: &[f64],
    motion: &MovingFrames<D>,
    f: &mut DMatrix<f64>,
) {
    let model = &layout.model;
    let mut pulled = Vec::new();
    f.fill(0.0);
    for (mut column, input) in f.column_iter_mut().zip(&model.inputs) {
        let Some((force, component)) = input.target.force() else { continue };
        let wrenches = input_wrenches(derivative, time, &model.forces[force], component, motion);
        for (wrench, &marker) in wrenches.iter().zip(&model.forces[force].markers) {
            let Some(part) = model.carrier(marker) else { continue };
            let frame = motion[marker].map(|x| x.x);
            layout.supports[marker].add_to(column.as_mut_slice(), &mut pulled, |f| {
                part.body.pull_back(marker - part.first_marker, part.coordinates(q), &frame, wrench, f);
            });
        }
    }
}

/// Wrenches that one unit of an input, or of its rate, adds at the markers of its force.
fn input_wrenches<const D: usize>(
    derivative: usize,
    time: Time<f64>,
    force: &ModelForce<D>,
    component: usize,
    motion: &MovingFrames<D>,
) -> [Wrench<f64, D>; MOST_MARKERS] {
    let mut unit = [Taylor::fixed(Dual6::fixed(0.0)); 3];
    unit[component] = Taylor::new(Dual6::seeded(0.0, 0), Dual6::seeded(0.0, 1), Dual6::fixed(0.0));
    let mut wrenches = [Wrench::zero(); MOST_MARKERS];
    let out = &mut wrenches[..force.markers.len()];
    let drive = |frames: &[_]| force.element.driven(&unit, frames, time.map(Taylor::<Dual6>::time), out);
    gathered(&force.markers, |&marker| fixed(&motion[marker]), drive);
    let slope = |x: Dual6| x.eps[derivative];
    from_fn(|i| Wrench { force: wrenches[i].force.map(slope), torque: wrenches[i].torque.map(slope) })
}

/// Values of the inputs in a simulation.
pub(super) fn write_input_values<const D: usize>(view: &Plain<D>, out: &mut [f64]) {
    for (out, input) in out.iter_mut().zip(&view.model.inputs) {
        let value = input.value.as_ref();
        let read = |formula: &Formula| {
            formula.evaluate(view.time(), |probe| probe.read(view.regime, |marker| view.frame(marker)))
        };
        *out = value.map_or(0.0, read);
    }
}
