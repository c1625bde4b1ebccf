//! Conjugate pairs of eigenvalues.

use crate::linearize::{Complex, Kind, LinearModel, Mode};
use crate::tolerances::linearize as tolerances;

/// An eigenvalue alone, or the one with the positive imaginary part of a pair.
#[derive(Clone, Copy, Debug)]
pub struct Pair<'a> {
    pub mode: &'a Mode,
    pub is_pair: bool,
}

/// The damping ratio as a person reads it.
pub fn damping(mode: &Mode) -> f64 {
    Some(mode.damping()).filter(|ratio| ratio.abs() > tolerances::SAME).unwrap_or(0.0)
}

/// The finite eigenvalues of a kind in their order, each pair once.
pub fn pairs(model: &LinearModel, kind: Kind) -> Vec<Pair<'_>> {
    let modes: Vec<&Mode> = model.modes.iter().filter(|mode| mode.kind == kind).collect();
    let mut is_taken = vec![false; modes.len()];
    let mut found = Vec::new();
    for i in 0..modes.len() {
        if std::mem::replace(&mut is_taken[i], true) {
            continue;
        }
        let partner = (i + 1..modes.len()).find(|&j| !is_taken[j] && are_conjugate(modes[i].value, modes[j].value));
        if let Some(j) = partner {
            is_taken[j] = true;
        }
        let upper = partner.filter(|&j| modes[j].value.im > modes[i].value.im).unwrap_or(i);
        found.push(Pair { mode: modes[upper], is_pair: partner.is_some() });
    }
    found
}

/// Whether two values that are not real are conjugate to each other.
pub fn are_conjugate(a: Complex<f64>, b: Complex<f64>) -> bool {
    let near = tolerances::EIGENVALUES_AGREE * a.norm();
    a.im != 0.0 && a.im * b.im < 0.0 && (a - b.conj()).norm() <= near
}
