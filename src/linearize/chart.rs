//! Charts of minimal coordinates: where a moving state's spectrum gets its meaning.

use super::coordinates::{Coordinates, constant, frozen, levi_civita, numbered, parallel};
use super::variation::refuse_all_modes;
use super::{Variation, independent};
use crate::error::Result;
use crate::system::LeviCivita;

/// Which coordinates z, with dq = R z, describe the changes that the constraints allow. At an equilibrium all give the
/// same eigenvalues. Elsewhere z' = dq's rate contains how the coordinates themselves move, and each chart has a
/// spectrum of its own.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Chart {
    /// A mass-orthonormal basis carried parallel along the motion, in the metric of the kinetic energy. Its spectrum does
    /// not depend on coordinates or on how the constraints are written; for one degree of freedom it is that of the arc
    /// length. Needs M with known derivatives along the motion.
    Intrinsic,
    /// z = Z^T M dq with Z of the state held: an exact model in a constant chart.
    MassOrthogonal,
    /// Independent coordinates by name: an exact model in a constant chart. Rotations in space are named by their angular
    /// velocities, such as `rotor.wx`.
    Independent(Vec<String>),
    /// The plain projection Z^T (M, C, K) Z, which forgets that the basis moves: exact at an equilibrium only. The finite
    /// spectrum of the frozen index-3 pencil.
    Frozen,
}

impl Chart {
    /// `intrinsic`, `mass_orthogonal`, `frozen`, or names of coordinates with commas between.
    pub fn parse(text: &str) -> Self {
        match text.trim().replace('-', "_").as_str() {
            "intrinsic" => Chart::Intrinsic,
            "mass_orthogonal" => Chart::MassOrthogonal,
            "frozen" => Chart::Frozen,
            _ => Chart::Independent(text.split(',').map(|name| name.trim().to_string()).collect()),
        }
    }

    /// The chart at the state of `variation`.
    ///
    /// # Errors
    /// Names that do not exist, too many or too few, or not independent at this state; `intrinsic` for equations that do
    /// not say how M changes.
    pub fn at(&self, variation: &mut Variation) -> Result<Coordinates> {
        refuse_all_modes(variation.len(), COPIES)?;
        let z = variation.free_directions()?;
        match self {
            Chart::Intrinsic => parallel(variation, z),
            Chart::MassOrthogonal => {
                let b = z.transpose() * variation.mass();
                constant(variation, "mass_orthogonal", numbered(z.ncols()), (z, b))
            }
            Chart::Independent(names) => independent::coordinates(variation, &z, names),
            Chart::Frozen => Ok(frozen(variation, z)),
        }
    }

    /// The chart that says most, of those the equations allow.
    pub fn preferred(variation: &mut Variation) -> Self {
        let mut connection = LeviCivita::new(variation.len());
        if levi_civita(variation, &mut connection) { Chart::Intrinsic } else { Chart::MassOrthogonal }
    }
}

/// Matrices of the size of the velocities: directions, masses, and how both change.
const COPIES: f64 = 12.0;
