//! The program as a user runs it, its advice and what the source keeps to.

mod automatic;
mod cli;
mod common;
mod dependencies;
mod errors;
mod guide;
mod layers;
mod report;
mod robustness;
mod scenes;
mod simplify;
mod stress;
mod stress_truth;
mod tradeoff;
