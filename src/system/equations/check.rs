//! What a mass matrix that a user writes can be wrong in.

use super::Equations;
use crate::error::{Error, Result, short};
use crate::tolerances;

/// Refuses an M whose triangles differ: solvers read the lower one.
pub(super) fn symmetry<E: Equations>(system: &E, t: f64, q: &[f64]) -> Result<()> {
    let n = q.len();
    let mut mass = vec![0.0; n * n];
    system.mass(t, q, &mut mass);
    for i in 0..n {
        for j in 0..i {
            let lower = mass[i * n + j];
            let upper = mass[j * n + i];
            let diagonal = (mass[i * n + i] * mass[j * n + j]).abs().sqrt();
            if (lower - upper).abs() > tolerances::SAME * diagonal.max(lower.abs()).max(upper.abs()) {
                let lower = short(lower);
                let upper = short(upper);
                let message = format!(
                    "the mass matrix is not symmetric: {lower} in row {}, column {}, but {upper} in row {}, column {}",
                    i + 1,
                    j + 1,
                    j + 1,
                    i + 1
                );
                return Err(Error::input(message)
                    .hint("write M row by row with both triangles: v^T M v/2 is the kinetic energy"));
            }
        }
    }
    Ok(())
}
