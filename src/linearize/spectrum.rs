//! Eigenvalues of a model, classed as physical, spurious and infinite.

use super::entry::{Linear, LinearMatrices};
use super::{Complex, Kind, Matrix, Mode, Variation, displacement};
use crate::error::{Error, Result, clock};
use crate::math::eigen::{ComplexMatrix, Deflation, Eigen, Split, Unsolved, eigen, finite, generalized, times};

/// Kinds of modes are clear where the part of a spurious one off the constraints is so many times that of any physical
/// one. Unit: `[1]`. Why: the least that is a gap.
const SPURIOUS_GAP: f64 = 2.0;

/// Rounding of the terms of x^H K x with the shape x of a mode. Unit: `[1]` of their sum. Why: four ulps: two for an
/// entry of K, which is a sum of few elements, and two for the products. Test:
/// `a_rigid_body_mode_is_zero_and_a_slow_one_is_not`.
const ROUND_OFF_OF_K: f64 = 4.0 * f64::EPSILON;

/// Eigenvalues with eigenvectors.
struct Solved {
    values: Vec<Complex<f64>>,
    right: ComplexMatrix,
    /// Left vectors, y^H E x = 1, where they are known.
    left: Option<ComplexMatrix>,
    /// Participation of the states in each mode; none where left vectors are not known.
    participation: Option<Matrix>,
    conditioning: f64,
    /// Change of each eigenvalue by rounding, 1/s; zero where it is not known.
    errors: Vec<f64>,
    /// 1/|y^H x| of each; NaN where it is not known.
    conditions: Vec<f64>,
}

/// Eigenvectors in the states of a model, a column for each of its finite modes.
pub(super) struct Vectors {
    pub right: ComplexMatrix,
    /// With y^H E x = 1; zero for a defective eigenvalue.
    pub left: ComplexMatrix,
}

/// The modes of a model, with the measures on which their classes are based.
pub(super) struct Spectrum {
    pub modes: Vec<Mode>,
    /// Vectors of the finite modes; none by QZ, which gives no left ones.
    pub vectors: Option<Vectors>,
    /// Condition number of the eigenvectors.
    pub conditioning: f64,
    pub off_constraints: Option<[f64; 2]>,
}

/// Returns all modes of a model.
pub(super) fn spectrum(variation: &mut Variation, built: &LinearMatrices, request: &Linear) -> Result<Spectrum> {
    let t = variation.point.t;
    let solved = solve(built, request).map_err(|unsolved| refused(t, &unsolved))?;
    let shapes = times(&built.shapes(variation.system().dimensions()), &solved.right);
    let weighed = weighed(variation, &shapes);
    // Every motion in minimal coordinates is one that the constraints allow.
    let (kinds, off_constraints) = if built.coordinates.is_some() {
        (vec![Kind::Physical; solved.values.len()], None)
    } else {
        kinds(variation, &solved.values, &shapes, &weighed)?
    };
    let modes = modes(variation, built, &solved, &shapes, &weighed, &kinds);
    let mut numbered: Vec<(usize, Mode)> = modes.into_iter().enumerate().collect();
    numbered.sort_by_key(|(_, mode)| mode.kind);
    let (order, mut modes): (Vec<usize>, Vec<Mode>) = numbered.into_iter().unzip();
    let sorted = |matrix: &ComplexMatrix| matrix.select_columns(&order);
    let vectors = solved.left.as_ref().map(|left| Vectors { right: sorted(&solved.right), left: sorted(left) });
    let value = Complex::new(f64::INFINITY, 0.0);
    let infinite = mode(value, Kind::Infinite, Vec::new(), Vec::new(), Vec::new(), Vec::new());
    modes.extend(std::iter::repeat_n(infinite, built.infinite));
    Ok(Spectrum { modes, vectors, conditioning: solved.conditioning, off_constraints })
}

/// Returns the modes of a model without E all of which are physical, their vectors in its states, and the condition
/// number of these.
pub(super) fn modes_of(
    variation: &Variation,
    built: &LinearMatrices,
) -> Result<(Vec<Mode>, ComplexMatrix, f64), Unsolved> {
    let solved = solve_plain(built)?;
    let shapes = times(&built.shapes(variation.system().dimensions()), &solved.right);
    let weighed = weighed(variation, &shapes);
    let kinds = vec![Kind::Physical; solved.values.len()];
    let modes = modes(variation, built, &solved, &shapes, &weighed, &kinds);
    Ok((modes, solved.right, solved.conditioning))
}

/// M X, by the entries of M.
fn weighed(variation: &Variation, shapes: &ComplexMatrix) -> ComplexMatrix {
    let re = variation.mass_times(&shapes.map(|x| x.re));
    let im = variation.mass_times(&shapes.map(|x| x.im));
    re.zip_map(&im, Complex::new)
}

/// The modes with their shapes, and these times M.
fn modes(
    variation: &Variation,
    built: &LinearMatrices,
    solved: &Solved,
    shapes: &ComplexMatrix,
    weighed: &ComplexMatrix,
    kinds: &[Kind],
) -> Vec<Mode> {
    let moving = variation.system().dimensions().moving();
    let outputs = times(&built.c, &solved.right);
    let column = |matrix: &ComplexMatrix, i: usize| matrix.column(i).iter().copied().collect();
    let mut modes = Vec::with_capacity(solved.values.len());
    for (i, &value) in solved.values.iter().enumerate() {
        let participation = solved.participation.as_ref();
        let participation = participation.map_or(Vec::new(), |matrix| matrix.column(i).iter().copied().collect());
        // States xi have no energy.
        let energy = shapes.column(i).into_iter().zip(weighed.column(i)).take(moving);
        let energy = energy.map(|(x, mx)| (x.conj() * mx).re).collect();
        let mode = mode(value, kinds[i], column(shapes, i), column(&outputs, i), participation, energy);
        modes.push(rounded(variation, Mode { condition: solved.conditions[i], ..mode }, solved.errors[i]));
    }
    modes
}

/// The mode with its shape scaled to a largest component of 1.
fn mode(
    value: Complex<f64>,
    kind: Kind,
    mut shape: Vec<Complex<f64>>,
    mut outputs: Vec<Complex<f64>>,
    participation: Vec<f64>,
    mut energy: Vec<f64>,
) -> Mode {
    let largest = shape.iter().copied().fold(Complex::ZERO, |a, b| if b.norm() > a.norm() { b } else { a });
    let mut mass: f64 = energy.iter().sum();
    if mass > 0.0 {
        energy.iter_mut().for_each(|part| *part /= mass);
    }
    if largest.norm() > 0.0 {
        shape.iter_mut().chain(&mut outputs).for_each(|x| *x /= largest);
        mass /= largest.norm_sqr();
    }
    Mode { value, kind, shape, participation, energy, mass, outputs, rounding: 0.0, condition: f64::NAN, error: 0.0 }
}

/// The mode with the size of what rounding leaves of a zero eigenvalue, and its error; `error` is that of the solver. With
/// r the rounding of x^H K x, lambda changes by r / |2 lambda x^H M x + x^H C x|, at most by the root of r / x^H M x.
fn rounded(variation: &Variation, mode: Mode, error: f64) -> Mode {
    let entries = &variation.dynamics.structure.tangent.entries;
    let shape = |i: usize| mode.shape.get(i).copied().unwrap_or_default();
    let size = |i: usize| shape(i).norm();
    let stiffness = entries.iter().zip(&variation.tangent.k);
    let terms: f64 = stiffness.map(|(&(i, j), k)| size(i) * k.abs() * size(j)).sum();
    let damping = entries.iter().zip(&variation.tangent.c).map(|(&(i, j), c)| shape(i).conj() * shape(j) * *c);
    let slope = (damping.sum::<Complex<f64>>() + mode.value * 2.0 * mode.mass).norm();
    let rounding = ROUND_OFF_OF_K * terms;
    let largest = if mode.mass > 0.0 { (rounding / mode.mass).sqrt() } else { 0.0 };
    let first_order = if slope > 0.0 { (rounding / slope).min(largest) } else { largest };
    Mode { rounding: largest.max(error), error: first_order.max(error), ..mode }
}

/// Solves a model without E.
fn solve_plain(built: &LinearMatrices) -> Result<Solved, Unsolved> {
    let Eigen { values, right, left, conditioning, errors, conditions } = eigen(&built.a)?;
    let participation = Some(parts(&left, &right));
    Ok(Solved { values, participation, right, left: Some(left), conditioning, errors, conditions })
}

fn solve(built: &LinearMatrices, request: &Linear) -> Result<Solved, Unsolved> {
    let Some(e) = &built.e else { return solve_plain(built) };
    let by = match request.method.text("solver") {
        Some("qz") => {
            let found = generalized(&built.a, e)?.split(built.infinite)?;
            let conditioning = f64::NAN;
            let errors = vec![0.0; found.values.len()];
            let conditions = vec![f64::NAN; found.values.len()];
            let Split { values, right, .. } = found;
            return Ok(Solved { values, right, left: None, participation: None, conditioning, errors, conditions });
        }
        Some("gsvd") => Deflation::Gsvd,
        _ => Deflation::NullSpace,
    };
    let found = finite(&built.a, e, by)?;
    if found.deflated.infinite() != built.infinite {
        return Err(Unsolved::Doubtful { gap: found.deflated.gap });
    }
    let participation = Some(parts(&times(&e.transpose(), &found.left), &found.right));
    let values = found.values;
    let right = found.right;
    let conditioning = found.conditioning;
    let errors = found.errors;
    let conditions = found.conditions;
    let left = Some(found.left);
    Ok(Solved { values, right, left, participation, conditioning, errors, conditions })
}

/// Returns the participation |y_i x_i|, each column with sum 1.
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

/// Classes eigenvalues: as many are physical as there are states of minimal coordinates, those with the least part off
/// the directions that the constraints allow, in the metric of the kinetic energy, in which directions without inertia have
/// that of [`displacement::added_mass`]. Where no gap lies between them and
/// the others, those that are not well apart are uncertain.
fn kinds(
    variation: &mut Variation,
    values: &[Complex<f64>],
    shapes: &ComplexMatrix,
    weighed: &ComplexMatrix,
) -> Result<(Vec<Kind>, Option<[f64; 2]>)> {
    let z = variation.free_directions()?;
    let physical = 2 * z.ncols() - variation.system().dimensions().states;
    if shapes.ncols() <= physical {
        return Ok((vec![Kind::Physical; shapes.ncols()], None));
    }
    let added = displacement::added_mass(variation);
    let add = |x: &ComplexMatrix| ComplexMatrix::from_fn(x.nrows(), x.ncols(), |i, j| x[(i, j)] * added[i]);
    let off = shapes - times(&z, &times(&z.transpose(), weighed));
    let weighed_off = self::weighed(variation, &off) + add(&off);
    let weighed = &(weighed + add(shapes));
    let size = |x: &ComplexMatrix, mx: &ComplexMatrix, j: usize| x.column(j).dotc(&mx.column(j)).re.max(0.0).sqrt();
    let part = |j: usize| Some(size(shapes, weighed, j)).filter(|x| *x > 0.0).map(|x| size(&off, &weighed_off, j) / x);
    let parts = completed(values, (0..shapes.ncols()).map(part).collect());
    let mut order: Vec<usize> = (0..shapes.ncols()).collect();
    order.sort_by(|&i, &j| parts[i].total_cmp(&parts[j]));
    let mut kinds = vec![Kind::Spurious; shapes.ncols()];
    order.iter().take(physical).for_each(|&j| kinds[j] = Kind::Physical);
    let worst = physical.checked_sub(1).map_or(0.0, |last| parts[order[last]]);
    let least = parts[order[physical]];
    if least < SPURIOUS_GAP * worst {
        (0..kinds.len())
            .filter(|&j| SPURIOUS_GAP * parts[j] > least && parts[j] < SPURIOUS_GAP * worst)
            .for_each(|j| kinds[j] = Kind::Uncertain);
    }
    Ok((kinds, Some([worst, least])))
}

/// Fills in defective eigenvalues, which have fewer vectors than their multiplicity, with the value of the nearest that
/// has one.
fn completed(values: &[Complex<f64>], parts: Vec<Option<f64>>) -> Vec<f64> {
    let known: Vec<(Complex<f64>, f64)> =
        values.iter().zip(&parts).filter_map(|(s, part)| Some((*s, (*part)?))).collect();
    let nearest = |value: &Complex<f64>| {
        known.iter().min_by(|a, b| (a.0 - value).norm().total_cmp(&(b.0 - value).norm())).map_or(1.0, |(_, part)| *part)
    };
    values.iter().zip(parts).map(|(value, part)| part.unwrap_or_else(|| nearest(value))).collect()
}

impl From<Unsolved> for Error {
    fn from(unsolved: Unsolved) -> Error {
        Error::input(unsolved.to_string())
    }
}

pub(super) fn refused(t: f64, unsolved: &Unsolved) -> Error {
    Error::input(format!("the linear model at t = {} s has no reliable eigenvalues: {unsolved}", clock(t)))
        .hint("take --method mcs, or another time")
}
