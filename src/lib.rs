//! holonom
#![forbid(unsafe_code)]
#![allow(clippy::suspicious_arithmetic_impl)]
pub mod body;
pub mod cli;
pub mod error;
pub mod force;
pub mod formulation;
pub mod initial;
pub mod integrator;
pub mod joint;
pub mod math;
pub mod measure;
pub mod plot;
pub mod projection;
pub mod report;
pub mod scene;
pub mod simulate;
pub mod study;
pub mod system;
pub mod trajectory;

pub use error::{Error, Result};
