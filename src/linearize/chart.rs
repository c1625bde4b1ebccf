//! Charts of minimal coordinates, which give the spectrum of a moving state its meaning.

use super::coordinates::{Coordinates, constant, frozen, levi_civita, numbered, parallel};
use super::variation::refuse_all_modes;
use super::{Variation, independent};
use crate::error::Result;
use crate::system::LeviCivita;

/// Coordinates z, with dq = R z, of the changes that the constraints allow. At an equilibrium all charts give the same
/// eigenvalues. Elsewhere z' includes the motion of the coordinates themselves, and each chart has a spectrum of its
/// own.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Chart {
    /// A mass-orthonormal basis transported parallel along the motion, in the metric of the kinetic energy. Its
    /// spectrum does not depend on coordinates or on how the constraints are written; for one degree of freedom it is
    /// that of the arc length. Needs M with known derivatives along the motion.
    Intrinsic,
    /// z = Z^T M dq with Z of this state and constant: an exact model in a constant chart.
    MassOrthogonal,
    /// Independent coordinates by name: an exact model in a constant chart. Rotations in space are named by their
    /// angular velocities, such as `rotor.wx`.
    Independent(Vec<String>),
    /// The plain projection Z^T (M, C, K) Z, which neglects the motion of the basis: exact at an equilibrium only. It
    /// has the finite spectrum of the frozen index-3 pencil.
    Frozen,
}

impl Chart {
    /// Reads `intrinsic`, `mass_orthogonal`, `frozen`, or names of coordinates separated by commas.
    pub fn parse(text: &str) -> Self {
        match text.trim().replace('-', "_").as_str() {
            "intrinsic" => Chart::Intrinsic,
            "mass_orthogonal" => Chart::MassOrthogonal,
            "frozen" => Chart::Frozen,
            _ => Chart::Independent(text.split(',').map(|name| name.trim().to_string()).collect()),
        }
    }

    /// Returns the chart at the state of `variation`.
    ///
    /// # Errors
    /// Names that do not exist, too many or too few, or not independent at this state; `intrinsic` for equations that
    /// do not say how M changes.
    #[doc(hidden)]
    pub fn at(&self, variation: &mut Variation) -> Result<Coordinates> {
        refuse_all_modes(variation.velocities(), COPIES)?;
        let z = variation.free_directions()?;
        match self {
            Chart::Intrinsic => parallel(variation, z),
            Chart::MassOrthogonal => {
                let b = variation.mass_times(&z).transpose();
                let names = numbered(variation, z.ncols());
                constant(variation, "mass_orthogonal", names, z, b)
            }
            Chart::Independent(names) => independent::coordinates(variation, &z, names),
            Chart::Frozen => frozen(variation, z),
        }
    }

    /// Returns `Intrinsic` where the equations allow it, else `MassOrthogonal`.
    pub fn preferred(variation: &mut Variation) -> Self {
        let mut connection = LeviCivita::new(variation.velocities());
        if levi_civita(variation, &mut connection) { Chart::Intrinsic } else { Chart::MassOrthogonal }
    }
}

/// Number of dense n_v x n_v matrices needed: directions, masses, and their rates.
const COPIES: f64 = 12.0;
