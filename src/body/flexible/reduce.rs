//! Fewer coordinates: natural modes of a beam instead of the displacements of its nodes.
//!
//! Craig and Bampton (Coupling of Substructures for Dynamic Analyses, AIAA Journal 6, 1968): the static deflections
//! that unit displacements of the boundary coordinates b cause, and some natural modes Phi of the interior i with the
//! boundary fixed,
//!
//! ```text
//! q = T p,   T = [ I                 0   ]  of b
//!                [ -K_ii^-1 K_ib     Phi ]  of i
//! ```
//!
//! Here the reduced system is diagonalised, so that mass is the identity and stiffness diag(omega^2). Under `mean`
//! frame conditions the mesh is free, and vectors orthogonal to its rigid motions R in the mass metric have no momentum
//! and no moment of momentum: these are the elastic modes.

use super::eigen::{Modes, dense};
use super::integrals::mass_matrix;
use super::line::{Cross, Shapes, Station};
use super::mesh::Mesh;
use super::profile::Profile;
use super::reference::ReferenceLine;
use super::shape::{Disc, Elastic, MassIntegrals, Piece, Stretch};
use super::spec::FrameConditions;
use crate::error::{Error, Result};
use crate::math::array::from_fn;
use faer::linalg::solvers::Solve;
use faer::{Mat, MatRef, Side};

/// Largest dense problem, in coordinates.
const MOST: usize = 4000;

/// The beam `nodal` in its natural modes: all of them, or those of a Craig-Bampton reduction with `count`
/// fixed-interface modes.
///
/// # Errors
/// Bad input: more modes than there are, none at all, or too large a mesh.
pub fn beam<const D: usize>(
    mesh: Mesh<D>,
    nodal: Elastic<D>,
    conditions: FrameConditions,
    markers: &[f64],
    count: Option<usize>,
    shortens: bool,
) -> Result<Elastic<D>> {
    let n = mesh.coordinates();
    if n > MOST {
        return Err(Error::input(format!("a mesh of {n} coordinates is too large to compute its modes"))
            .under("elements")
            .hint(format!("give fewer elements: at most {MOST} coordinates are possible")));
    }
    let full = BeamMatrices {
        stiffness: dense(n, &nodal.stiffness),
        mass: dense(n, &mass_matrix(&nodal.inertia)),
        rigid: match conditions {
            FrameConditions::Mean => columns(n, &mesh.rigid_motions()),
            FrameConditions::Tangent | FrameConditions::Chord => Mat::zeros(n, 0),
        },
    };
    let modes = modes(&full, &mesh, markers, count)?;
    if modes.squares.is_empty() {
        return Err(Error::input("no elastic coordinate is left").under("modes").hint("give one mode or more"));
    }
    Ok(project(mesh, nodal, modes, shortens))
}

/// Dense matrices of a beam, with the rigid motions that its frame does not remove.
struct BeamMatrices {
    stiffness: Mat<f64>,
    mass: Mat<f64>,
    /// Rigid motions in columns: K R = 0.
    rigid: Mat<f64>,
}

fn modes<const D: usize>(full: &BeamMatrices, mesh: &Mesh<D>, markers: &[f64], count: Option<usize>) -> Result<Modes> {
    let boundary = boundary(mesh, markers);
    let failed = || {
        Error::input("the modes cannot be told apart from round-off")
            .under("elements")
            .hint("give fewer elements, or keep the lowest modes by \"modes\"")
    };
    let Some(count) = count else { return full.elastic_modes().ok_or_else(failed) };
    let interior: Vec<usize> = (0..mesh.coordinates()).filter(|i| !boundary.contains(i)).collect();
    // A free mesh without markers has no boundary to fix.
    let direct = boundary.is_empty();
    let most = if direct { interior.len() - full.rigid.ncols() } else { interior.len() };
    if count > most {
        return Err(Error::input(format!("modes is {count}, but the mesh has {most} of them"))
            .under("modes")
            .hint("give fewer modes, or more elements"));
    }
    if direct {
        return full.elastic_modes().map(|modes| modes.truncated(count)).ok_or_else(failed);
    }
    let basis = full.craig_bampton(&boundary, &interior, count).ok_or_else(failed)?;
    let reduced = BeamMatrices {
        stiffness: basis.transpose() * &full.stiffness * &basis,
        mass: basis.transpose() * &full.mass * &basis,
        // Static shapes of the boundary's rigid motions are rigid motions.
        rigid: Mat::from_fn(basis.ncols(), full.rigid.ncols(), |i, j| {
            boundary.get(i).map_or(0.0, |&place| full.rigid[(place, j)])
        }),
    };
    let Modes { squares, vectors } = reduced.elastic_modes().ok_or_else(failed)?;
    Ok(Modes { squares, vectors: full.without_rigid_part(&basis * &vectors) })
}

/// The free coordinates of the nodes that carry markers, ascending.
fn boundary<const D: usize>(mesh: &Mesh<D>, markers: &[f64]) -> Vec<usize> {
    let mut boundary: Vec<usize> = markers.iter().flat_map(|s| mesh.free_at(*s)).collect();
    boundary.sort_unstable();
    boundary.dedup();
    boundary
}

fn columns(n: usize, vectors: &[Vec<f64>]) -> Mat<f64> {
    Mat::from_fn(n, vectors.len(), |i, j| vectors[j][i])
}

fn block(matrix: MatRef<f64>, rows: &[usize], cols: &[usize]) -> Mat<f64> {
    Mat::from_fn(rows.len(), cols.len(), |i, j| matrix[(rows[i], cols[j])])
}

impl BeamMatrices {
    /// T, its rows in the order of the mesh.
    fn craig_bampton(&self, boundary: &[usize], interior: &[usize], count: usize) -> Option<Mat<f64>> {
        let mut basis = Mat::zeros(boundary.len() + interior.len(), boundary.len() + count);
        boundary.iter().enumerate().for_each(|(j, &row)| basis[(row, j)] = 1.0);
        if interior.is_empty() {
            return Some(basis);
        }
        let inner = block(self.stiffness.as_ref(), interior, interior);
        let coupling = block(self.stiffness.as_ref(), interior, boundary);
        let statics = inner.llt(Side::Lower).ok()?.solve(&coupling);
        let fixed = Modes::of(inner.as_ref(), block(self.mass.as_ref(), interior, interior).as_ref())?;
        for (i, &row) in interior.iter().enumerate() {
            (0..boundary.len()).for_each(|j| basis[(row, j)] = -statics[(i, j)]);
            (0..count).for_each(|j| basis[(row, boundary.len() + j)] = fixed.vectors[(i, j)]);
        }
        Some(basis)
    }

    /// The natural modes without the rigid motions. The first coordinates, as many as there are rigid motions, are
    /// those of one node: with it fixed the stiffness is definite, and vectors without their rigid part,
    /// S = (I - R R^T M) [0; I], have that same stiffness and the mass S^T M S = M - M R R^T M.
    fn elastic_modes(&self) -> Option<Modes> {
        let n = self.mass.nrows();
        let held = self.rigid.ncols();
        if held == 0 {
            return Modes::of(self.stiffness.as_ref(), self.mass.as_ref());
        }
        let rigid = orthonormal(&self.rigid, &self.mass);
        let momenta = &self.mass * &rigid;
        let momenta = momenta.subrows(held, n - held);
        let mass = self.mass.submatrix(held, held, n - held, n - held) - momenta * momenta.transpose();
        let stiffness = self.stiffness.submatrix(held, held, n - held, n - held);
        let modes = Modes::of(stiffness, mass.as_ref())?;
        let mut vectors = Mat::zeros(n, n - held);
        vectors.subrows_mut(held, n - held).copy_from(&modes.vectors);
        Some(Modes { vectors: self.without_rigid_part(vectors), ..modes })
    }

    /// (I - R R^T M) applied to `vectors` twice: the second time removes the round-off of the first.
    fn without_rigid_part(&self, mut vectors: Mat<f64>) -> Mat<f64> {
        let rigid = orthonormal(&self.rigid, &self.mass);
        for _ in 0..2 {
            vectors = &vectors - &rigid * (rigid.transpose() * (&self.mass * &vectors));
        }
        vectors
    }
}

/// Columns with R^T M R = I that span those of `vectors` (Gram and Schmidt, twice for its round-off).
fn orthonormal(vectors: &Mat<f64>, mass: &Mat<f64>) -> Mat<f64> {
    let mut basis = vectors.clone();
    for j in (0..basis.ncols()).flat_map(|j| [j, j]) {
        let before = basis.subcols(0, j).to_owned();
        let column = basis.subcols(j, 1).to_owned();
        let column = &column - &before * (before.transpose() * mass * &column);
        let square = (column.transpose() * mass * &column)[(0, 0)];
        basis.subcols_mut(j, 1).copy_from(&column * faer::Scale(square.sqrt().recip()));
    }
    basis
}

fn project<const D: usize>(mesh: Mesh<D>, nodal: Elastic<D>, modes: Modes, shortens: bool) -> Elastic<D> {
    let basis = modes.vectors;
    let stretches = nodal.stretches.iter().map(|stretch| project_stretch(stretch, &basis)).collect();
    let names = (1..=basis.ncols()).map(|i| format!("mode{i}")).collect();
    let line = ReducedLine { mesh, basis, shortens };
    Elastic {
        names,
        inertia: super::shape::Line::beyond(&line, 0.0),
        stiffness: modes.squares.iter().enumerate().map(|(i, square)| (i, i, *square)).collect(),
        damping: Vec::new(),
        stretches,
        line: Some(Box::new(line)),
    }
}

/// sum over the pieces of E^T P E with E = diag(1, basis of the piece's coordinates).
fn project_pieces<const D: usize>(pieces: &[Piece<D>], basis: &Mat<f64>) -> Piece<D> {
    let n = 1 + basis.ncols();
    let mut sum = Piece::massless((0..basis.ncols()).collect());
    for piece in pieces {
        let local = 1 + piece.dofs.len();
        let factor = |i: usize, a: usize| match (i, a) {
            (0, 0) => 1.0,
            (0, _) | (_, 0) => 0.0,
            _ => basis[(piece.dofs[i - 1], a - 1)],
        };
        sum.mass += piece.mass;
        for (a, moment) in sum.moments.iter_mut().enumerate() {
            (0..local).for_each(|i| (0..D).for_each(|k| moment[k] += factor(i, a) * piece.moments[i][k]));
        }
        for b in 0..n {
            let mut half = vec![[[0.0; D]; D]; local];
            for (i, row) in half.iter_mut().enumerate() {
                (0..local).for_each(|j| add_product(row, factor(j, b), &piece.products[i * local + j]));
            }
            for a in 0..n {
                let target = &mut sum.products[a * n + b];
                half.iter().enumerate().for_each(|(i, row)| add_product(target, factor(i, a), row));
            }
        }
    }
    sum
}

fn project_disc(disc: &Disc, basis: &Mat<f64>) -> Disc {
    let turn = |mode: usize| {
        let both = disc.dofs.iter().zip(&disc.rotation);
        both.fold([0.0; 3], |sum, (&dof, turn)| from_fn(|k| sum[k] + basis[(dof, mode)] * turn[k]))
    };
    let dofs: Vec<usize> = (0..basis.ncols()).filter(|_| !disc.dofs.is_empty()).collect();
    Disc { rotation: dofs.iter().copied().map(turn).collect(), dofs, inertia: disc.inertia }
}

fn add_product<const D: usize>(sum: &mut [[f64; D]; D], factor: f64, product: &[[f64; D]; D]) {
    sum.iter_mut().flatten().zip(product.iter().flatten()).for_each(|(s, p)| *s += factor * p);
}

fn project_stretch(stretch: &Stretch, basis: &Mat<f64>) -> Stretch {
    let n = stretch.dofs.len();
    let part = |mode: usize, values: &[f64]| -> f64 {
        stretch.dofs.iter().zip(values).map(|(&dof, value)| basis[(dof, mode)] * value).sum()
    };
    let modes = 0..basis.ncols();
    let half = |mode: usize| stretch.slopes.chunks_exact(n).map(|row| part(mode, row)).collect::<Vec<_>>();
    let slopes = modes.clone().map(half).flat_map(|half| modes.clone().map(move |mode| part(mode, &half)));
    Stretch {
        ends: stretch.ends,
        dofs: modes.clone().collect(),
        weight: stretch.weight,
        quartic: stretch.quartic,
        axial: modes.clone().map(|mode| part(mode, &stretch.axial)).collect(),
        slopes: slopes.collect(),
    }
}

/// Displacement functions of the modes: those of the mesh times the modal matrix.
struct ReducedLine<const D: usize> {
    mesh: Mesh<D>,
    basis: Mat<f64>,
    shortens: bool,
}

impl<const D: usize> Shapes for ReducedLine<D> {
    fn reference(&self) -> &ReferenceLine {
        self.mesh.reference()
    }

    fn at(&self, s: f64) -> Station {
        let nodal = self.mesh.at(s);
        let mut shapes = vec![Cross::default(); self.basis.ncols()];
        for (mode, shape) in shapes.iter_mut().enumerate() {
            nodal.dofs.iter().zip(&nodal.shapes).for_each(|(&dof, one)| shape.add(self.basis[(dof, mode)], one));
        }
        Station { dofs: (0..shapes.len()).collect(), shapes }
    }

    fn breaks(&self) -> Vec<f64> {
        self.mesh.breaks()
    }

    fn profile(&self) -> &Profile {
        self.mesh.profile()
    }

    fn shortens(&self) -> bool {
        self.shortens
    }

    fn inertia<const E: usize>(&self, s: f64) -> MassIntegrals<E> {
        let MassIntegrals { pieces, discs } = self.mesh.inertia(s);
        let discs = discs.iter().map(|disc| project_disc(disc, &self.basis)).collect();
        MassIntegrals { pieces: vec![project_pieces(&pieces, &self.basis)], discs }
    }
}
