//! Gram and Schmidt's method against orthonormal vectors that stand one after the other.

use crate::math::{add_scaled, dot, norm};

/// Removes the part of a vector along these; returns the norm of the part.
pub(super) fn project_out(basis: &[f64], v: &mut [f64]) -> f64 {
    let mut square = 0.0;
    for known in basis.chunks_exact(v.len().max(1)) {
        let part = dot(known, v);
        add_scaled(-part, known, v);
        square += part * part;
    }
    square.sqrt()
}

/// Makes a vector orthogonal to these, done twice for round-off; returns the length of what is left.
pub(super) fn orthogonalize(basis: &[f64], v: &mut [f64]) -> f64 {
    for _ in 0..2 {
        project_out(basis, v);
    }
    norm(v)
}

/// Scales a vector to length one.
pub(super) fn normalize(v: &mut [f64]) {
    let length = norm(v);
    v.iter_mut().for_each(|x| *x /= length);
}

/// Makes a vector orthogonal to these and of length one, done twice for round-off.
pub(super) fn orthonormalize(basis: &[f64], v: &mut [f64]) {
    for _ in 0..2 {
        project_out(basis, v);
        normalize(v);
    }
}
