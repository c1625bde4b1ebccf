//! Backward differentiation formulas.

use super::implicit::{self, Newton, Traits};
use super::{Entry, Integrator, Setup, Steps, With};
use crate::error::Result;

pub const ENTRY: Entry = Entry {
    name: "bdf",
    about: "backward differentiation, order 1 to 5 by itself: implicit, for stiff motions; chooses its steps",
    order: 5,
    orders: &[],
    steps: Steps::Own,
    accepts: implicit::ACCEPTS,
    refuses: &[With { formulation: "index1", projections: ALL }, With { formulation: "ggl", projections: ALL }],
    options: &[],
    make,
};

fn make<'h, 's>(setup: &Setup<'h, 's>) -> Result<Box<dyn Integrator + 'h>> {
    // A run starts with order 1, whose error is O(h^2): the power of h that the first step is chosen by.
    let traits = Traits { order: 2, follows: false };
    implicit::make(setup, traits, |problem, state| problem.bdf_solver::<Newton>(state))
}

/// A projection would start the method anew, at order 1.
const ALL: &[&str] = &["position", "velocity", "manifold", "full", "exact"];
