//! A force with the value of an input added to it.

use super::{Action, Beam, Force, ForceOver, InputKind, Instant, Motion, Wheel};
use crate::body::{Dual6, Formula, MarkerId, Wrench};
use crate::forward::forward;
use crate::math::expression::Expression;
use crate::math::{Rate, Scalar, Taylor};

/// The value of an input as a function of the motion.
#[derive(Clone, Debug)]
enum Value {
    OfTime(Expression),
    OfMotion(Formula),
}

/// A force on whose input, see [`ForceKernel::driven`](super::ForceKernel::driven), the value of an input acts.
pub struct Added<const D: usize> {
    inner: Box<dyn Force<D>>,
    /// Its markers, followed by those that the value reads.
    markers: Vec<MarkerId>,
    /// Number of its own markers.
    own: usize,
    component: usize,
    value: Value,
}

impl<const D: usize> Added<D> {
    /// Adds a value to component `component` of a force with these markers. Returns also the markers of both.
    pub fn new(inner: Box<dyn Force<D>>, own: &[MarkerId], component: usize, value: Formula) -> (Self, Vec<MarkerId>) {
        let markers = value.markers_after(own);
        let value = match value.clone().function_of_time() {
            Ok(expression) => Value::OfTime(expression),
            Err(_) => Value::OfMotion(value),
        };
        (Added { inner, markers: markers.clone(), own: own.len(), component, value }, markers)
    }

    /// `input` with the value, and its rate where it depends on t alone: no other is asked for.
    fn with<S: Scalar>(&self, input: &[Taylor<S>; 3], frames: &Motion<S, D>, time: Instant<S>) -> [Taylor<S>; 3] {
        let mut all = *input;
        all[self.component] += match &self.value {
            Value::OfTime(value) => value.eval_held(&[time.t], time.regime),
            Value::OfMotion(value) => Taylor::fixed(value.at(time.map(|t| t.x), &self.markers, frames)),
        };
        all
    }
}

impl<S: Scalar, const D: usize> ForceOver<S, D> for Added<D>
where
    dyn Force<D>: ForceOver<S, D>,
{
    fn driven(
        &self,
        input: &[Taylor<S>; 3],
        frames: &Motion<S, D>,
        time: Instant<S>,
        out: &mut [Wrench<S, D>],
    ) -> Action<S> {
        let input = self.with(input, frames, time);
        ForceOver::<S, D>::driven(self.inner.as_ref(), &input, &frames[..self.own], time, &mut out[..self.own])
    }
}

impl<const D: usize> Force<D> for Added<D>
where
    dyn Force<D>: ForceOver<f64, D> + ForceOver<Dual6, D>,
{
    fn wheel(&self, frames: &Motion<f64, D>, time: Instant<f64>) -> Option<Wheel> {
        let wheel = self.inner.wheel(&frames[..self.own], time)?;
        let Value::OfTime(value) = &self.value else { return Some(wheel) };
        Some(Wheel { road: wheel.road + value.eval_held(&[time.t.x], time.regime), ..wheel })
    }
    forward! { .inner =>
        fn beam(&self) -> Option<&Beam>;
        fn takes_small_rotations(&self) -> bool;
        fn gap(&self) -> Option<usize>;
        fn input(&self) -> InputKind;
        fn is_torque(&self) -> bool;
    }
    fn depends_on_velocities(&self) -> bool {
        matches!(self.value, Value::OfMotion(_)) || self.inner.depends_on_velocities()
    }
    fn acted(&self, _markers: usize) -> usize {
        self.inner.acted(self.own)
    }
    fn switching(&self, input: &[Taylor<Rate>; 3], frames: &Motion<Rate, D>, time: Instant<Rate>, out: &mut [Rate]) {
        match &self.value {
            Value::OfTime(value) => value.arguments(&[time.t.x], time.regime, out),
            Value::OfMotion(value) => value.switching_at(time.map(|t| t.x), &self.markers, frames, out),
        }
        self.inner.switching(&self.with(input, frames, time), &frames[..self.own], time, out);
    }
}
