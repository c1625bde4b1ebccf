//! Minimal coordinates of the perturbation: where a moving state's spectrum gets its meaning.

use super::response::beside;
use super::variation::{at_state, refuse_all_modes};
use super::{Changes, Matrix, Variation, independent};
use crate::error::{Error, Result};
use crate::formulation::{Halt, free_directions};
use crate::system::{LeviCivita, Loaded};

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

/// The chart at a state.
///
/// ```text
/// dq = R z,   dv = R y + T z,   z' = y + turn z,   y' = B dv' - drift_z z - drift_y y,   B R = I
/// ```
#[derive(Clone, Debug)]
pub struct Coordinates {
    pub name: String,
    /// Names of z, then of y.
    pub states: Vec<String>,
    pub r: Matrix,
    pub tilt: Matrix,
    pub b: Matrix,
    pub turn: Matrix,
    pub drift: [Matrix; 2],
}

impl Coordinates {
    /// (dq, dv) of a unit of each state.
    pub fn changes(&self) -> Changes {
        let none = Matrix::zeros(self.r.nrows(), self.r.ncols());
        Changes { q: beside([&self.r, &none]), v: beside([&self.tilt, &self.r]) }
    }
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
        let z = directions(variation)?;
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

/// Z with G Z = 0 and Z^T M Z = I.
pub(super) fn directions(variation: &mut Variation) -> Result<Matrix> {
    let t = variation.point.t;
    let z = free_directions(&mut variation.dynamics).ok_or_else(|| at_state(t, &Halt::NotFinite))?;
    let correction = variation.correct(&(variation.g() * &z))?;
    Ok(z - correction)
}

/// z = B dq with a constant B, R given:
///
/// ```text
/// dv = R y - S Gd R z,   z' = y + B Q R z,   Q = -[v, .],   G S = I, B S = 0
/// ```
pub(super) fn constant(
    variation: &mut Variation,
    name: &str,
    states: Vec<String>,
    (r, b): (Matrix, Matrix),
) -> Result<Coordinates> {
    let correction = variation.correct(&(variation.gd() * &r))?;
    // Of the smallest correction in the mass metric what B does not see.
    let tilt = &r * (&b * &correction) - correction;
    let turn = -&b * variation.bracket(&variation.point.v) * &r;
    let none = Matrix::zeros(r.ncols(), r.ncols());
    Ok(Coordinates { name: name.to_string(), states, r, tilt, b, turn, drift: [none.clone(), none] })
}

/// dq = Z z with Z held and nothing else: z' = y.
fn frozen(variation: &Variation, z: Matrix) -> Coordinates {
    let turned = variation.bracket(&variation.point.v) * &z;
    let b = z.transpose() * variation.mass();
    let none = Matrix::zeros(z.ncols(), z.ncols());
    let drift = [none.clone(), &b * &turned];
    Coordinates { name: "frozen".to_string(), states: numbered(z.ncols()), tilt: turned, r: z, b, turn: none, drift }
}

/// dq = N u with N parallel in the mass metric, N^T (M N' + W N) = 0. With Q = -[v, .] and S the least corrections,
///
/// ```text
/// G'  = Gd - G Q                      G'' = Gdd - 2 Gd Q + G Q^2 - G Q'
/// N'  = -S G' N - N (N^T W N)
/// N^T M N'' = -N'^T (M N' + W N) - N^T (M' N' + W' N + W N')
/// dv  = N u' + (N' - Q N) u           dv' = N u'' + (2 N' - Q N) u' + (N'' - Q' N - Q N') u
/// ```
///
/// # Errors
/// Equations that do not say how M changes; a singular state.
pub fn parallel(variation: &mut Variation, n: Matrix) -> Result<Coordinates> {
    let mut connection = LeviCivita::new(variation.len());
    if !levi_civita(variation, &mut connection) {
        return Err(Error::input("the intrinsic chart needs a mass matrix whose change along the motion is known")
            .under("--chart")
            .hint(
                "bodies in floating frames have none: take --chart mass_orthogonal, or name independent coordinates",
            ));
    }
    let LeviCivita { w, w_dot, mass_dot } = connection;
    let (mass, g) = (variation.mass(), variation.g());
    let q = -variation.bracket(&variation.point.v);
    let q_dot = -variation.bracket(&variation.point.vdot);
    let wn = &w * &n;
    let n_dot = -variation.correct(&((variation.gd() - g * &q) * &n))? - &n * (n.transpose() * &wn);
    let bent =
        n_dot.transpose() * (&mass * &n_dot + &wn) + n.transpose() * (mass_dot * &n_dot + w_dot * &n + &w * &n_dot);
    let b = n.transpose() * mass;
    let turned = &q * &n;
    let drift = [-bent - &b * (q_dot * &n + &q * &n_dot), &b * (&n_dot * 2.0 - &turned)];
    let none = Matrix::zeros(n.ncols(), n.ncols());
    let states = numbered(n.ncols());
    Ok(Coordinates { name: "intrinsic".to_string(), states, tilt: n_dot - turned, r: n, b, turn: none, drift })
}

fn levi_civita(variation: &mut Variation, connection: &mut LeviCivita) -> bool {
    let Variation { dynamics, point, .. } = variation;
    let at = Loaded { t: point.t, q: &point.q, v: &point.v, vdot: &point.vdot, lambda: &point.lambda };
    dynamics.system.levi_civita(at, connection, &mut dynamics.scratch)
}

/// u1 .. uk, u1' .. uk'
fn numbered(k: usize) -> Vec<String> {
    let names = (1..=k).map(|i| format!("u{i}"));
    names.clone().chain(names.map(|name| format!("{name}'"))).collect()
}
