//! Systems in full: what solvers ask of equations of motion, with the types of these answers.
//!
//! [`Equations`](crate::system::Equations) and [`Lagrangian`](crate::system::Lagrangian) are written once over any scalar
//! and become a [`MechanicalSystem`] by themselves. A system that has its own derivatives implements it directly.

pub use crate::math::kkt::Pattern;
#[doc(inline)]
pub use crate::system::{
    Column, Dimensions, MechanicalSystem, Names, Need, OperatingPoint, OutputTangent, Scratch, Structure, SwitchFacts,
    SystemFacts, Tangent, Terms,
};
