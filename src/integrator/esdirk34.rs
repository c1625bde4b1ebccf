//! A singly diagonally implicit Runge-Kutta method of four stages, the first explicit.

use super::implicit::{self, Newton, Traits};
use super::{Entry, Integrator, Setup, Steps};
use crate::error::Result;

pub const ENTRY: Entry = Entry {
    name: "esdirk34",
    about: "implicit, L-stable, four stages, for stiff motions; chooses its steps",
    order: 3,
    orders: &[],
    steps: Steps::Own,
    accepts: implicit::ACCEPTS,
    refuses: &[],
    options: &[],
    make,
};

fn make<'h, 's>(setup: &Setup<'h, 's>) -> Result<Box<dyn Integrator + 'h>> {
    let traits = Traits { order: ENTRY.order, follows: true };
    implicit::make(setup, traits, |problem, state| problem.esdirk34_solver::<Newton>(state))
}
