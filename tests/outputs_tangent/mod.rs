//! Derivatives of outputs and of the forces of inputs against differences.

mod compare;
mod inputs;
mod measures;
mod shipped;
mod special;
mod units;
