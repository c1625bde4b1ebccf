//! The mass integrals of a body in modal coordinates.

use super::array::Array;
use super::spec::{Lumped, ModalData};
use crate::body::flexible::shape::Piece;
use crate::body::{cross, in_space};
use crate::error::{Error, Result};
use crate::math::array::{Each, from_fn};
use crate::modes::natural::first_dependent;
use faer::Mat;

/// Mass integrals of point masses with known motion in the modes: exact in every term.
pub fn of_lumped<const D: usize>(masses: &[Lumped<Array>], n: usize) -> Result<Piece<D>> {
    let mut piece = Piece::massless((0..n).collect());
    for (i, lumped) in masses.iter().enumerate() {
        let (mass, psi) = lumped_shapes::<D>(lumped, n).map_err(|error| error.under(format!("lumped[{i}]")))?;
        piece.add_point(&psi, mass);
    }
    Ok(piece)
}

fn lumped_shapes<const D: usize>(lumped: &Lumped<Array>, n: usize) -> Result<(f64, Vec<[f64; D]>)> {
    let mass = lumped.mass.scalar("mass")?;
    if mass < 0.0 {
        return Err(Error::input(format!("mass is {mass}, but cannot be negative")).under("mass"));
    }
    let position = lumped.position.fit("position", &[D])?;
    let translation = lumped.translation.fit("translation", &[D, n])?;
    let modes = (0..n).map(|mode| from_fn(|k| translation[k * n + mode]));
    Ok((mass, std::iter::once(from_fn(|k| position[k])).chain(modes).collect()))
}

/// Mass integrals from the rigid inertia, the modal mass M and the momenta m_i, h_i of the modes. These determine the
/// antisymmetric part of P_0i, by h_i = int rho psi_0 x psi_i, and the trace M_ij of P_ij. The rest is assumed
/// isotropic: P_0i without a symmetric part, P_ij = M_ij/D times the identity.
pub fn of_couplings<const D: usize>(data: &ModalData<Array>, mass: &Mat<f64>) -> Result<Piece<D>> {
    let n = mass.nrows();
    let mut piece = Piece::<D>::massless((0..n).collect());
    rigid(&mut piece, data)?;
    let turns = if D == 2 { 1 } else { 3 };
    let zeros = vec![0.0; 3 * n];
    let linear = data.linear_coupling.as_ref().map_or(Ok(&zeros[..]), |m| m.fit("linear_coupling", &[n, D]))?;
    let angular = data.angular_coupling.as_ref().map_or(Ok(&zeros[..]), |h| h.fit("angular_coupling", &[n, turns]))?;
    for i in 0..n {
        piece.moments[1 + i] = from_fn(|k| linear[i * D + k]);
        let h = if D == 2 { [0.0, 0.0, angular[i]] } else { from_fn(|k| angular[i * 3 + k]) };
        piece.products[1 + i] = antisymmetric(h);
        piece.products[(1 + i) * (1 + n)] = antisymmetric(h.each(|h| -h));
        for j in 0..n {
            let product = &mut piece.products[(1 + i) * (1 + n) + 1 + j];
            (0..D).for_each(|k| product[k][k] = mass[(i, j)] / D as f64);
        }
    }
    Ok(piece)
}

/// The matrix P without a symmetric part whose P_lm - P_ml is h_k for (k, l, m) in cyclic order.
fn antisymmetric<const D: usize>(h: [f64; 3]) -> [[f64; D]; D] {
    let [x, y, z] = h;
    let twice = [[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]];
    from_fn(|l| from_fn(|m| twice[l][m] / 2.0))
}

/// Sets mass, m_0 and P_00, of which tr(P_00) - P_00 is the inertia tensor.
fn rigid<const D: usize>(piece: &mut Piece<D>, data: &ModalData<Array>) -> Result<()> {
    let missing = |key: &str| Error::input(format!("the key `{key}` is missing")).hint("or give \"lumped\" masses");
    piece.mass = data.mass.as_ref().ok_or_else(|| missing("mass"))?.scalar("mass")?;
    if piece.mass <= 0.0 {
        return Err(Error::input(format!("mass is {}, but must be above zero", piece.mass)).under("mass"));
    }
    let center: [f64; D] = match &data.center {
        None => [0.0; D],
        Some(center) => center.fit("center", &[D]).map(|center| from_fn(|k| center[k]))?,
    };
    let inertia = data.inertia.as_ref().ok_or_else(|| missing("inertia"))?;
    let inertia = match (D, inertia.values.len()) {
        (2, _) => {
            [[inertia.scalar("inertia")? / 2.0, 0.0, 0.0], [0.0, inertia.scalar("inertia")? / 2.0, 0.0], [0.0; 3]]
        }
        (_, 6) => spread(inertia.fit("inertia", &[6])?),
        _ => spread(&[inertia.fit("inertia", &[3])?, &[0.0; 3]].concat()),
    };
    piece.moments[0] = center.each(|c| piece.mass * c);
    piece.products[0] = from_fn(|k| from_fn(|m| inertia[k][m] + piece.mass * center[k] * center[m]));
    Ok(())
}

/// tr(J)/2 - J of an inertia tensor given as Ixx, Iyy, Izz, Ixy, Ixz, Iyz: int rho x x^T.
fn spread(inertia: &[f64]) -> [[f64; 3]; 3] {
    let half = (inertia[0] + inertia[1] + inertia[2]) / 2.0;
    let [xy, xz, yz] = [-inertia[3], -inertia[4], -inertia[5]];
    [[half - inertia[0], xy, xz], [xy, half - inertia[1], yz], [xz, yz, half - inertia[2]]]
}

/// Refuses a body whose mass matrix at rest is not positive definite.
///
/// # Errors
/// Bad input: rotations without inertia, or modes whose momenta are larger than their mass allows.
pub fn check<const D: usize>(piece: &Piece<D>) -> Result<()> {
    let mass = at_rest(piece);
    let turns = if D == 2 { 1 } else { 3 };
    match first_dependent(mass.as_ref(), 1e-12) {
        None => Ok(()),
        Some(i) if i < D => Err(Error::input("the body has no mass")),
        Some(i) if i < D + turns => {
            Err(Error::input("the body has no moment of inertia, or a negative one, about some axis")
                .hint("check the signs; masses on one line have none about it"))
        }
        Some(i) => Err(Error::input(format!(
            "mode {} has no mass of its own beside the rigid motion and the modes before it",
            i - D - turns + 1
        ))
        .hint("leave out rigid-body modes and sums of others, and check units and signs of the couplings")),
    }
}

/// Mass matrix of translations, rotations and modes in the undeformed state.
fn at_rest<const D: usize>(piece: &Piece<D>) -> Mat<f64> {
    let n = piece.dofs.len();
    let turns: &[usize] = if D == 2 { &[2] } else { &[0, 1, 2] };
    let first = D + turns.len();
    // Velocities of a point: e_k for translations, e_r x psi_0 for rotations, psi_i for modes; their products,
    // integrated.
    let unit = |r: usize| -> [f64; 3] { from_fn(|k| if k == r { 1.0 } else { 0.0 }) };
    let trace = |p: &[[f64; D]; D]| -> f64 { (0..D).map(|k| p[k][k]).sum() };
    let inertia = |r: usize, s: usize| {
        let along = if r < D && s < D { piece.products[0][r][s] } else { 0.0 };
        if r == s { trace(&piece.products[0]) - along } else { -along }
    };
    let moment = |i: usize, r: usize| -> f64 {
        let p = in_space_square(&piece.products[1 + i]);
        p[(r + 1) % 3][(r + 2) % 3] - p[(r + 2) % 3][(r + 1) % 3]
    };
    let entry = |row: usize, col: usize| match (row, col) {
        (i, j) if i < D && i == j => piece.mass,
        (i, _) if i < D => 0.0,
        (i, j) if i < first && j < D => cross(&unit(turns[i - D]), &in_space(&piece.moments[0]))[j],
        (i, j) if i < first => inertia(turns[i - D], turns[j - D]),
        (i, j) if j < D => piece.moments[1 + i - first][j],
        (i, j) if j < first => moment(i - first, turns[j - D]),
        (i, j) => trace(&piece.products[(1 + i - first) * (1 + n) + 1 + j - first]),
    };
    Mat::from_fn(first + n, first + n, |i, j| entry(i.max(j), i.min(j)))
}

fn in_space_square<const D: usize>(p: &[[f64; D]; D]) -> [[f64; 3]; 3] {
    from_fn(|k| if k < D { in_space(&p[k]) } else { [0.0; 3] })
}
