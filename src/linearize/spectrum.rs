//! Eigenvalues of a model: physical, spurious and infinite ones told apart.

use super::chart::directions;
use super::method::{Built, Request};
use super::{Complex, Kind, Matrix, Mode, Variation};
use crate::error::{Error, Result};
use crate::math::eigen::{ComplexMatrix, Deflation, Unsolved, eigen, finite, generalized};

/// Eigenvalues with vectors.
struct Solved {
    values: Vec<Complex<f64>>,
    right: ComplexMatrix,
    /// Parts of the states in each mode; none where left vectors are not known.
    participation: Option<Matrix>,
    conditioning: f64,
}

/// All modes of a model, and the condition number of its eigenvectors.
pub(super) fn modes(variation: &mut Variation, built: &Built, request: &Request) -> Result<(Vec<Mode>, f64)> {
    let t = variation.point.t;
    let solved = solve(built, request).map_err(|unsolved| refused(t, &unsolved))?;
    let shapes = complex(&built.changes.q) * &solved.right;
    let kinds = kinds(variation, &shapes)?;
    let mut modes: Vec<Mode> = (0..solved.values.len())
        .map(|i| Mode {
            value: solved.values[i],
            kind: kinds[i],
            shape: normalized(shapes.column(i).iter().copied().collect()),
            participation: solved
                .participation
                .as_ref()
                .map_or(Vec::new(), |all| all.column(i).iter().copied().collect()),
        })
        .collect();
    modes.sort_by_key(|mode| mode.kind);
    let value = Complex::new(f64::INFINITY, 0.0);
    let infinite = Mode { value, kind: Kind::Infinite, shape: Vec::new(), participation: Vec::new() };
    modes.extend(std::iter::repeat_n(infinite, built.infinite));
    Ok((modes, solved.conditioning))
}

fn solve(built: &Built, request: &Request) -> Result<Solved, Unsolved> {
    let Some(e) = &built.e else {
        let found = eigen(&built.a)?;
        let participation = Some(parts(&found.left, &found.right));
        return Ok(Solved {
            values: found.values,
            right: found.right,
            participation,
            conditioning: found.conditioning,
        });
    };
    let by = match request.method.text("solver") {
        Some("qz") => {
            let found = generalized(&built.a, e)?.split(built.infinite)?;
            let conditioning = f64::NAN;
            return Ok(Solved { values: found.values, right: found.right, participation: None, conditioning });
        }
        Some("gsvd") => Deflation::Gsvd,
        _ => Deflation::NullSpace,
    };
    let found = finite(&built.a, e, by)?;
    let participation = Some(parts(&(complex(&e.transpose()) * &found.left), &found.right));
    Ok(Solved { values: found.values, right: found.right, participation, conditioning: found.conditioning })
}

/// |y_i x_i|, each column with sum 1.
fn parts(left: &ComplexMatrix, right: &ComplexMatrix) -> Matrix {
    let mut parts = Matrix::from_fn(right.nrows(), right.ncols(), |i, j| (left[(i, j)].conj() * right[(i, j)]).norm());
    for mut column in parts.column_iter_mut() {
        let sum = column.sum();
        if sum > 0.0 {
            column /= sum;
        }
    }
    parts
}

/// As many physical modes as there are states of minimal coordinates: those of which the least part is off the directions
/// that the constraints allow, in the metric of the kinetic energy.
fn kinds(variation: &mut Variation, shapes: &ComplexMatrix) -> Result<Vec<Kind>> {
    let z = directions(variation)?;
    let physical = 2 * z.ncols();
    if shapes.ncols() <= physical {
        return Ok(vec![Kind::Physical; shapes.ncols()]);
    }
    let mass = complex(&variation.mass());
    let z = complex(&z);
    let off = shapes - &z * (z.transpose() * (&mass * shapes));
    let size = |x: &ComplexMatrix, j: usize| x.column(j).dotc(&(&mass * x.column(j))).re.max(0.0).sqrt();
    let part = |j: usize| size(&off, j) / size(shapes, j).max(f64::MIN_POSITIVE);
    let parts: Vec<f64> = (0..shapes.ncols()).map(part).collect();
    let mut order: Vec<usize> = (0..shapes.ncols()).collect();
    order.sort_by(|&i, &j| parts[i].total_cmp(&parts[j]));
    let mut kinds = vec![Kind::Spurious; shapes.ncols()];
    order.iter().take(physical).for_each(|&j| kinds[j] = Kind::Physical);
    Ok(kinds)
}

/// Largest component 1.
fn normalized(mut shape: Vec<Complex<f64>>) -> Vec<Complex<f64>> {
    let largest = shape.iter().copied().fold(Complex::ZERO, |a, b| if b.norm() > a.norm() { b } else { a });
    if largest.norm() > 0.0 {
        shape.iter_mut().for_each(|x| *x /= largest);
    }
    shape
}

fn complex(matrix: &Matrix) -> ComplexMatrix {
    matrix.map(Complex::from)
}

fn refused(t: f64, unsolved: &Unsolved) -> Error {
    Error::input(format!("the linear model at t = {t} s has no reliable eigenvalues: {unsolved}"))
        .hint("take --method mcs, or another time")
}
