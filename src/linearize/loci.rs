//! Eigenvalues along a trajectory or over a parameter.

use super::{Complex, Kind};

/// One eigenvalue followed through time or a parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Branch {
    pub kind: Kind,
    /// Time or parameter, and the eigenvalue there, 1/s.
    pub points: Vec<(f64, Complex<f64>)>,
}
