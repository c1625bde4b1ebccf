//! Minimal coordinates of the perturbation at a state.

use super::changes::beside;
use super::{Changes, Lift, LinearizationPoint, Matrix, Variation};
use crate::error::{Error, Result};
use crate::system::LeviCivita;

/// The chart at a state, with n directions of v, k degrees of freedom and s states xi:
///
/// ```text
/// dq = R z,   dv = R y + T z,   z' = y + turn z,   y' = B dv' - drift_z z - drift_y y,   B R = I
/// ```
///
/// where the last s entries of y are the changes of xi, which have no z: R in dq is its first k columns, and y in z'
/// its first k entries.
#[derive(Clone, Debug)]
pub struct Coordinates {
    /// Name of the chart, as on the command line.
    pub name: String,
    /// Names of z, then of y.
    pub states: Vec<String>,
    /// R: dv of a unit of each y, n x (k + s); dq of a unit of each z.
    pub r: Matrix,
    /// T: dv of a unit of each z at y = 0, n x k, 1/s.
    pub tilt: Matrix,
    /// B: y = B (dv - T z), (k + s) x n, with B R = I.
    pub b: Matrix,
    /// Coefficient of z in z', k x k, 1/s.
    pub turn: Matrix,
    /// Coefficients of z and y in -y', (k + s) x k and (k + s) x (k + s).
    pub drift: [Matrix; 2],
    /// The changes that go with the displacements of inputs.
    pub lift: Lift,
}

/// The terms of a chart with one z for each y, the states xi among them.
struct ChartTerms {
    r: Matrix,
    b: Matrix,
    tilt: Matrix,
    turn: Matrix,
    drift: [Matrix; 2],
    lift: Lift,
}

impl ChartTerms {
    /// The chart without a z for the last `states` directions, whose terms are zero; `name` of z and of y.
    fn named(self, variation: &Variation, name: &str, names: (Vec<String>, Vec<String>)) -> Coordinates {
        let ChartTerms { r, b, tilt, turn, drift: [of_z, of_y], lift } = self;
        let states = variation.system().dimensions().states;
        let k = r.ncols() - states;
        let own = variation.system().facts().names.v.clone().split_off(r.nrows() - states);
        Coordinates {
            name: name.to_string(),
            states: [names.0, names.1, own].concat(),
            tilt: tilt.columns(0, k).clone_owned(),
            turn: turn.view((0, 0), (k, k)).clone_owned(),
            drift: [of_z.columns(0, k).clone_owned(), of_y],
            r,
            b,
            lift,
        }
    }
}

impl Coordinates {
    /// Returns k, the number of z.
    pub fn freedom(&self) -> usize {
        self.tilt.ncols()
    }

    /// Returns (dq, dv) of a unit of each state.
    pub fn changes(&self) -> Changes {
        let z = self.r.columns(0, self.freedom()).clone_owned();
        let none = Matrix::zeros(self.r.nrows(), self.r.ncols());
        Changes { q: beside(&z, &none), v: beside(&self.tilt, &self.r) }
    }

    /// Returns (dq, dv) of states, a column each.
    pub fn changes_of(&self, x: &Matrix) -> Changes {
        let unit = self.changes();
        Changes { q: unit.q * x, v: unit.v * x }
    }

    /// Returns (z, y) of changes that the constraints allow.
    pub fn states_of(&self, changes: &Changes) -> Matrix {
        let z = self.b.rows(0, self.freedom()) * &changes.q;
        let y = &self.b * (&changes.v - &self.tilt * &z);
        let mut both = z.resize_vertically(self.freedom() + y.nrows(), 0.0);
        both.rows_mut(self.freedom(), y.nrows()).copy_from(&y);
        both
    }
}

/// The chart z = B dq with constant B and given R:
///
/// ```text
/// dv = R y - S Gd R z,   z' = y + B Q R z,   Q = -[v, .],   G S = I, B S = 0
/// ```
pub(super) fn constant(
    variation: &mut Variation,
    name: &str,
    names: (Vec<String>, Vec<String>),
    r: Matrix,
    b: Matrix,
) -> Result<Coordinates> {
    let correction = variation.correct(&variation.gd_times(&r))?;
    // The component of the least correction in the mass metric that B does not measure.
    let tilt = &r * (&b * &correction) - correction;
    let turn = -&b * variation.bracket_of(&variation.point.v, &r);
    let none = Matrix::zeros(r.ncols(), r.ncols());
    let lift = Lift::constant(variation, &r, &b)?;
    Ok(ChartTerms { r, b, tilt, turn, drift: [none.clone(), none], lift }.named(variation, name, names))
}

/// The chart of a basis that moves as little as it can in the mass metric, R' = -S G' R with S the least corrections. Since
/// B R' = 0 with B = (R^T M R)^-1 R^T M, it differs from the constant chart of B by terms of B' only:
///
/// ```text
/// z' = y + turn z + B' P u,   y' = B dv' + B' (T z + S u + P u')
/// B' X = (R^T M R)^-1 (R'^T M + R^T M') X   where B X = 0
/// ```
///
/// # Errors
/// A singular state.
pub(super) fn least_moved(variation: &mut Variation, r: Matrix) -> Result<Coordinates> {
    let off = variation.correct(&variation.g_times(&r))?;
    let r = r - off;
    let momenta = variation.mass_times(&r);
    let square = r.tr_mul(&momenta).cholesky();
    let square = square.ok_or_else(|| Error::input("directions without inertia have no chart mass_orthogonal"))?;
    let b = square.solve(&momenta.transpose());
    let v = variation.point.v.clone();
    let turned = variation.bracket_of(&v, &r);
    let r_dot = -variation.correct(&(variation.gd_times(&r) + variation.g_times(&turned)))?;
    let names = numbered(variation, r.ncols());
    let mut chart = constant(variation, "mass_orthogonal", names, r.clone(), b)?;
    let mut b_dot = |x: &Matrix| -> Result<Matrix> {
        let rate = variation.mass_rate_times(x)?;
        Ok(square.solve(&(r_dot.tr_mul(&variation.mass_times(x)) + r.tr_mul(&rate))))
    };
    chart.drift[0] = -b_dot(&chart.tilt)?;
    let Lift { p, s, .. } = &chart.lift;
    if p.iter().any(|x| *x != 0.0) {
        let of_p = b_dot(p)?;
        let of_s = b_dot(s)?;
        chart.lift.turn += &of_p;
        chart.lift.drift = [-of_s, -of_p];
    }
    Ok(chart)
}

/// The chart dq = Z z with constant Z and no other terms: z' = y.
pub(super) fn frozen(variation: &mut Variation, z: Matrix) -> Result<Coordinates> {
    let turned = variation.bracket_of(&variation.point.v, &z);
    let b = variation.mass_times(&z).transpose();
    let none = Matrix::zeros(z.ncols(), z.ncols());
    let lift = Lift::frozen(variation, &z, &b)?;
    let drift = [none.clone(), &b * &turned];
    let names = numbered(variation, z.ncols());
    Ok(ChartTerms { r: z, b, tilt: turned, turn: none, drift, lift }.named(variation, "frozen", names))
}

/// The chart dq = N u with N parallel in the mass metric, N^T (M N' + W N) = 0. With Q = -[v, .] and S the least
/// corrections,
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
    let mut connection = LeviCivita::new(variation.velocities());
    if !levi_civita(variation, &mut connection) {
        return Err(Error::input("the intrinsic chart needs a mass matrix whose change along the motion is known")
            .under("--chart")
            .hint(
                "bodies in floating frames have none: take --chart mass_orthogonal, or name independent coordinates",
            ));
    }
    let LeviCivita { w, w_dot, mass_dot } = &connection;
    let bracket = |v: &[f64], x: &Matrix| variation.bracket_of(v, x);
    let LinearizationPoint { v, vdot, .. } = &variation.point;
    let turned = -bracket(v, &n);
    let turned_later = -bracket(vdot, &n);
    let wn = times(w, &n);
    let corrected = variation.gd_times(&n) - variation.g_times(&turned);
    let n_dot = -variation.correct(&corrected)? - dense(&n, &dense(&n.transpose(), &wn));
    let momenta = variation.mass_times(&n_dot) + &wn;
    let rates = times(mass_dot, &n_dot) + times(w_dot, &n) + times(w, &n_dot);
    let bent = dense(&n_dot.transpose(), &momenta) + dense(&n.transpose(), &rates);
    let b = variation.mass_times(&n).transpose();
    let turned_rate = -variation.bracket_of(&variation.point.v, &n_dot);
    let drift = [-bent - dense(&b, &(turned_later + turned_rate)), dense(&b, &(&n_dot * 2.0 - &turned))];
    let none = Matrix::zeros(n.ncols(), n.ncols());
    let lift = Lift::parallel(variation, &n, &b, &n_dot, &connection)?;
    let names = numbered(variation, n.ncols());
    let terms = ChartTerms { r: n, b, tilt: n_dot - turned, turn: none, drift, lift };
    Ok(terms.named(variation, "intrinsic", names))
}

/// A x, without the work where either is zero: at rest, and of bodies that do not turn in space.
fn dense(a: &Matrix, x: &Matrix) -> Matrix {
    let is_zero = |matrix: &Matrix| matrix.iter().all(|x| *x == 0.0);
    if is_zero(a) || is_zero(x) { Matrix::zeros(a.nrows(), x.ncols()) } else { a * x }
}

/// A x with an A of few entries: blocks of bodies.
fn times(a: &Matrix, x: &Matrix) -> Matrix {
    let n = a.nrows().max(1);
    let entries: Vec<(usize, usize, f64)> = a
        .iter()
        .enumerate()
        .filter(|(_, value)| **value != 0.0)
        .map(|(place, value)| (place % n, place / n, *value))
        .collect();
    let mut product = Matrix::zeros(a.nrows(), x.ncols());
    for (x, mut sum) in x.column_iter().zip(product.column_iter_mut()) {
        entries.iter().for_each(|&(i, j, value)| sum[i] += value * x[j]);
    }
    product
}

pub(super) fn levi_civita(variation: &mut Variation, connection: &mut LeviCivita) -> bool {
    let Variation { dynamics, point, .. } = variation;
    dynamics.system.levi_civita(point.at(), connection, &mut dynamics.scratch)
}

/// Returns the names u1 .. uk and u1' .. uk' of a chart with so many directions, states xi among them; u_1 .. where an
/// input or a state has such a name.
pub(super) fn numbered(variation: &Variation, directions: usize) -> (Vec<String>, Vec<String>) {
    let system = variation.system();
    let count = directions - system.dimensions().states;
    let mut taken = system.facts().names.v.clone().split_off(system.dimensions().moving());
    taken.extend(system.facts().inputs.iter().map(|input| input.name.clone()));
    let mut names: Vec<String> = (1..=count).map(|i| format!("u{i}")).collect();
    while names.iter().any(|name| taken.contains(name)) {
        names.iter_mut().for_each(|name| name.insert(1, '_'));
    }
    names.into_iter().map(|name| (name.clone(), format!("{name}'"))).unzip()
}
