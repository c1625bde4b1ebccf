//! The trapezoidal rule and BDF2 in one step.

use super::implicit::{self, Newton, Traits};
use super::{Entry, Integrator, Setup, Steps};
use crate::error::Result;

pub const ENTRY: Entry = Entry {
    name: "tr_bdf2",
    about: "implicit, L-stable, for stiff motions at low accuracy; chooses its steps",
    order: 2,
    orders: &[],
    steps: Steps::Own,
    accepts: implicit::ACCEPTS,
    refuses: &[],
    options: &[],
    make,
};

fn make<'h, 's>(setup: &Setup<'h, 's>) -> Result<Box<dyn Integrator + 'h>> {
    let traits = Traits { order: ENTRY.order, follows: true };
    implicit::make(setup, traits, |problem, state| problem.tr_bdf2_solver::<Newton>(state))
}
