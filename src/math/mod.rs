//! Numbers and linear algebra below the mechanics.

mod dual;
pub mod expression;
pub mod kkt;
pub mod rotation;
mod scalar;
mod taylor;

pub use dual::Dual;
pub use scalar::{Scalar, Unary};
pub use taylor::Taylor;
