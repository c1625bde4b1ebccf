//! Modes of the equations with their coefficients frozen at one state, from the matrices alone:
//!
//! ```text
//! M x'' + C x' + K x + G^T lambda = 0,   G x = 0
//! ```

mod dense;
mod fastest;
pub mod natural;
mod quadratic;
mod rate_bound;
pub mod reduce;
pub mod search;
pub mod shifted;

pub use dense::{SpectralMode, all, eigenvalues};
pub use fastest::fastest;
pub use quadratic::{Quadratic, Sparse};
pub use rate_bound::rate_bound;
