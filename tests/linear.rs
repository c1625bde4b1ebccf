//! Linear models: against closed forms, references and nonlinear simulations.

mod common;
mod linear_report;
mod linearize;
mod loci;
mod outputs_tangent;
mod scenes;
mod validate;
mod verdict;
