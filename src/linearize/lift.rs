//! Changes of the state with which a chart follows the displacements of drivers.

use super::changes::beside;
use super::{Changes, Matrix, Variation};
use crate::error::Result;
use crate::system::LeviCivita;

/// The least changes of q in the mass metric that a unit of each input prescribes, G P = drow/du, and how a chart
/// follows them:
///
/// ```text
/// dq = R z + P u,   dv = R y + T z + S u + P u',   z' = y + turn z + turn_u u
/// y' = B dv' - drift_z z - drift_y y - drift_u u - drift_u' u'
/// ```
#[derive(Clone, Debug)]
pub struct Lift {
    /// P, n x n_u; columns of inputs that are no displacements of a driver are zero.
    pub p: Matrix,
    /// S, n x n_u, 1/s.
    pub s: Matrix,
    /// turn_u, k x n_u.
    pub turn: Matrix,
    /// drift_u and drift_u', k x n_u each.
    pub drift: [Matrix; 2],
}

impl Lift {
    /// Change (dq, dv) of a unit of state i of input j; none where that changes nothing.
    pub fn along(&self, i: usize, j: usize) -> Option<[Matrix; 2]> {
        let column = |matrix: &Matrix| matrix.columns(j, 1).clone_owned();
        let p = column(&self.p);
        let none = Matrix::zeros(p.nrows(), 1);
        match i {
            _ if p.amax() == 0.0 => None,
            0 => Some([p, column(&self.s)]),
            _ => Some([none, p]),
        }
    }

    /// Columns of z' and -y' that are not part of B dv', of each state of the inputs.
    pub fn terms(&self, orders: &[usize]) -> [Matrix; 2] {
        let k = self.turn.nrows();
        let states = orders.iter().enumerate().flat_map(|(j, &order)| (0..order).map(move |i| (i, j)));
        let mut turns = Matrix::zeros(k, 0);
        let mut drifts = Matrix::zeros(k, 0);
        for (i, j) in states {
            let turn = if i == 0 { self.turn.columns(j, 1).clone_owned() } else { Matrix::zeros(k, 1) };
            turns = beside(&turns, &turn);
            drifts = beside(&drifts, &self.drift[i].columns(j, 1).clone_owned());
        }
        [turns, drifts]
    }

    /// No input moves a driver.
    fn none(n: usize, k: usize, inputs: usize) -> Self {
        let zeros = |rows| Matrix::zeros(rows, inputs);
        Lift { p: zeros(n), s: zeros(n), turn: zeros(k), drift: [zeros(k), zeros(k)] }
    }

    /// That of a chart with constant B: B P = 0 and B S = 0.
    ///
    /// # Errors
    /// A driver that redundant constraints do not let move.
    pub(super) fn constant(variation: &mut Variation, r: &Matrix, b: &Matrix) -> Result<Self> {
        let none = Lift::none(r.nrows(), r.ncols(), variation.input_count());
        if !variation.has_drivers() {
            return Ok(none);
        }
        let p = variation.prescribed()?;
        let p = &p - r * (b * &p);
        let s = -variation.correct(&variation.gd_times(&p))?;
        let s = &s - r * (b * &s);
        let turn = -b * variation.bracket_with(&p);
        Ok(Lift { p, s, turn, ..none })
    }

    /// That of the plain projection: the terms of `constant` at rest, and those of [v, .] where the body turns.
    ///
    /// # Errors
    /// See [`Lift::constant`].
    pub(super) fn frozen(variation: &mut Variation, r: &Matrix, b: &Matrix) -> Result<Self> {
        let none = Lift::none(r.nrows(), r.ncols(), variation.input_count());
        if !variation.has_drivers() {
            return Ok(none);
        }
        let p = variation.prescribed()?;
        let s = variation.bracket_with(&p);
        let drift = [none.drift[0].clone(), b * &s];
        Ok(Lift { p, s, drift, ..none })
    }

    /// That of the intrinsic chart, B = N^T M with N parallel. With B', B'' along the motion and Q = -[v, .],
    ///
    /// ```text
    /// B' = N'^T M + N^T M'       B'' P = N''^T M P + 2 N'^T M' P + N^T M'' P,   G N'' = -(G'' N + 2 G' N')
    /// z' = B' dq + B dq' = y,    y' = B'' dq + 2 B' dq' + B dq'',   dq' = dv + Q dq,   dq'' = dv' + Q' dq + Q dq'
    /// ```
    ///
    /// # Errors
    /// See [`Lift::constant`].
    pub(super) fn parallel(
        variation: &mut Variation,
        n: &Matrix,
        b: &Matrix,
        n_dot: &Matrix,
        connection: &LeviCivita,
    ) -> Result<Self> {
        let none = Lift::none(n.nrows(), n.ncols(), variation.input_count());
        if !variation.has_drivers() {
            return Ok(none);
        }
        let p = variation.prescribed()?;
        let least = -variation.correct(&variation.gd_times(&p))?;
        let v = variation.point.v.clone();
        let turned = |variation: &Variation, x: &Matrix| -variation.bracket_of(&v, x);
        let b_dot = |variation: &Variation, x: &Matrix| {
            n_dot.tr_mul(&variation.mass_times(x)) + n.tr_mul(&(&connection.mass_dot * x))
        };
        let qp = turned(variation, &p);
        let s = least - n * (b_dot(variation, &p) + b * &qp);
        let bent = variation.correct(&bending(variation, n, n_dot))?;
        let mass_ddot = &connection.w_dot + connection.w_dot.transpose();
        let b_ddot = n.tr_mul(&(mass_ddot * &p)) + n_dot.tr_mul(&(&connection.mass_dot * &p)) * 2.0
            - bent.tr_mul(&variation.mass_times(&p));
        let rate = &s + &qp;
        let turned_later = turned(variation, &rate) - variation.bracket_of(&variation.point.vdot, &p);
        let drift = [-b_ddot - b_dot(variation, &rate) * 2.0 - b * turned_later, -b_dot(variation, &p) * 2.0 - b * qp];
        Ok(Lift { p, s, drift, ..none })
    }
}

/// Returns G'' N + 2 G' N' with G' = Gd - G Q and G'' = Gdd - 2 Gd Q + G Q^2 - G Q'.
fn bending(variation: &Variation, n: &Matrix, n_dot: &Matrix) -> Matrix {
    let v = &variation.point.v;
    let none = Matrix::zeros(n.nrows(), n.ncols());
    let gdd = -variation.rows(&Changes { q: n.clone(), v: none }, [0.0; 2]);
    let qn = -variation.bracket_of(v, n);
    let shifted = -variation.bracket_of(v, &qn) + variation.bracket_of(&variation.point.vdot, n);
    let qn_dot = -variation.bracket_of(v, n_dot);
    gdd + variation.gd_times(&(n_dot - qn)) * 2.0 + variation.g_times(&(shifted - qn_dot * 2.0))
}
