//! Damping matrix of a flexible body: Rayleigh or modal.

use super::eigen::{Modes, dense, entries};
use super::integrals::{EntrySum, mass_matrix};
use super::shape::{Elastic, Symmetric};
use super::spec::{Damping, OneOrMany};
use crate::body::Build;
use crate::error::{Error, Result};
use crate::math::expression::Number;
use faer::Mat;

/// Meaning of the elastic coordinates of a beam.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Basis {
    /// Displacements and rotations of nodes.
    Nodal,
    /// Mass-normalised modes.
    Modal,
    /// Amplitudes of displacement functions (Ritz).
    Functions,
}

/// Damping matrix D for the mass and stiffness of `elastic`, in its coordinates.
pub fn damping<const D: usize>(
    asked: &Option<Damping>,
    elastic: &Elastic<D>,
    basis: Basis,
    build: &Build<D>,
) -> Result<Symmetric> {
    match asked {
        None => Ok(Vec::new()),
        Some(Damping::Rayleigh { mass, stiffness }) => {
            rayleigh(mass, stiffness, elastic, build).map_err(|error| error.under("damping.rayleigh"))
        }
        Some(Damping::Modal(ratios)) => modal(ratios, elastic, basis, build).map_err(|error| error.under("damping")),
    }
}

fn rayleigh<const D: usize>(
    mass: &Option<Number>,
    stiffness: &Option<Number>,
    elastic: &Elastic<D>,
    build: &Build<D>,
) -> Result<Symmetric> {
    let factor = |field, number: &Option<Number>| number.as_ref().map_or(Ok(0.0), |n| build.not_negative(field, n));
    let mut sum = EntrySum::default();
    sum.add_all(factor("mass", mass)?, &mass_matrix(&elastic.inertia));
    sum.add_all(factor("stiffness", stiffness)?, &elastic.stiffness);
    Ok(sum.finish())
}

/// M Phi diag(2 zeta omega) Phi^T M with the natural modes Phi (Craig and Kurdila, Fundamentals of Structural Dynamics,
/// section 10.3), which is diag(2 zeta omega) in modal coordinates.
fn modal<const D: usize>(
    ratios: &OneOrMany,
    elastic: &Elastic<D>,
    basis: Basis,
    build: &Build<D>,
) -> Result<Symmetric> {
    if basis == Basis::Nodal {
        return Err(Error::input("a beam of finite elements has no modal coordinates")
            .under("modal")
            .hint("give \"modes\", the number of modes to keep, or damp it by \"rayleigh\""));
    }
    let n = elastic.names.len();
    let ratios = damping_ratios(ratios, n, build)?;
    if basis == Basis::Modal {
        let strength = |&(i, j, square): &(usize, usize, f64)| (i, j, 2.0 * ratios[i] * square.sqrt());
        return Ok(elastic.stiffness.iter().map(strength).filter(|entry| entry.2 != 0.0).collect());
    }
    let mass = dense(n, &mass_matrix(&elastic.inertia));
    let Some(modes) = Modes::of(dense(n, &elastic.stiffness).as_ref(), mass.as_ref()) else {
        return Err(Error::input("the modes of the functions cannot be computed").under("modal"));
    };
    let momenta = &mass * &modes.vectors;
    let damped = Mat::from_fn(n, n, |i, mode| momenta[(i, mode)] * 2.0 * ratios[mode] * modes.squares[mode].sqrt());
    Ok(entries((&damped * momenta.transpose()).as_ref()))
}

/// Damping ratio of each of `n` modes.
fn damping_ratios<const D: usize>(ratios: &OneOrMany, n: usize, build: &Build<D>) -> Result<Vec<f64>> {
    match ratios {
        OneOrMany::One(ratio) => Ok(vec![build.not_negative("modal", ratio)?; n]),
        OneOrMany::Many(numbers) if numbers.len() == n => {
            numbers.iter().enumerate().map(|(i, ratio)| build.not_negative(&format!("modal[{i}]"), ratio)).collect()
        }
        OneOrMany::Many(numbers) => Err(Error::input(format!("expected {n} damping ratios, found {}", numbers.len()))
            .under("modal")
            .hint("give one for each elastic coordinate, or one number for all")),
    }
}
