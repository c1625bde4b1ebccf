//! A driver with the value of an input added to what it prescribes.

use super::{Axis, ClosedForm, Joint, JointOver};
use crate::body::{Dual6, Frame};
use crate::forward::forward;
use crate::math::expression::Expression;
use crate::math::{Rate, Scalar, Taylor, Time};

/// A joint whose [`prescribes`](super::JointKernel::prescribes) is true, with u(t) added to the prescribed value.
pub struct Added<const D: usize> {
    /// The joint without the input.
    pub inner: Box<dyn Joint<D>>,
    /// u as a function of t, m or rad.
    pub value: Expression,
}

impl<S: Scalar, const D: usize> JointOver<S, D> for Added<D>
where
    dyn Joint<D>: JointOver<S, D>,
{
    fn levels(&self, frames: &[Frame<Taylor<S>, D>], time: Time<Taylor<S>>, out: &mut [Taylor<S>]) {
        self.driven(Taylor::fixed(S::zero()), frames, time, out);
    }

    fn driven(&self, input: Taylor<S>, frames: &[Frame<Taylor<S>, D>], time: Time<Taylor<S>>, out: &mut [Taylor<S>]) {
        let input = input + self.value.eval_held(&[time.t], time.regime);
        JointOver::<S, D>::driven(self.inner.as_ref(), input, frames, time, out);
    }

    fn gradient(&self, frames: &[Frame<Taylor<S>, D>], time: Time<S>, pass: usize, out: &mut [[S; 6]]) {
        // How far a coordinate is from what is prescribed changes with the markers in the same way for all values.
        JointOver::<S, D>::gradient(self.inner.as_ref(), frames, time, pass, out);
    }
}

impl<const D: usize> Joint<D> for Added<D>
where
    dyn Joint<D>: JointOver<f64, D> + JointOver<Dual6, D>,
{
    forward! { .inner =>
        fn row_names(&self) -> Vec<&'static str>;
        fn prescribes(&self) -> bool;
        fn joint_axis(&self, first: &Frame<f64, D>) -> Option<Axis>;
    }
    fn depends_on_time(&self) -> bool {
        true
    }
    fn prescribed(&self, t: f64) -> Option<f64> {
        Some(self.inner.prescribed(t)? + self.value.eval(&[t]))
    }
    fn closed_form(&self) -> Option<ClosedForm<D>> {
        None
    }
    fn switching(&self, frames: &[Frame<Rate, D>], time: Time<Rate>, out: &mut [Rate]) {
        self.inner.switching(frames, time, out);
        self.value.arguments(&[time.t], time.regime, out);
    }
}
