//! Tensors of inertia that miss by a little those that a body can have.

use crate::math::array::{Each, from_fn};
use crate::math::rotation::Matrix3;
use crate::tolerances::{ATOM, SIX_DIGITS};
use nalgebra::{Matrix3 as Tensor, SymmetricEigen, Vector3};

/// A tensor that a body can have in the place of one that none has.
pub struct Repaired {
    pub tensor: Matrix3,
    /// Largest change of a principal moment, by the largest moment.
    pub change: f64,
    /// Principal moments of the given tensor, kg m^2, the smallest first.
    pub before: [f64; 3],
    /// The same of the new one.
    pub after: [f64; 3],
}

/// Larger changes of a moment are no matter of few digits; such a tensor stays, and the scene refuses it.
const MOST: f64 = 0.1;

/// The valid tensor of the same axes with the smallest change of a moment by its size; `None` if the given one is valid,
/// or far from it.
///
/// Of the moments A <= B <= C a negative one becomes zero, and C > A + B becomes A + B: the change C - A - B is the
/// smallest one there is, and of the three moments it is the smallest part of C. A and B, which stay, are those that a
/// slender link turns about, or that a flat one has in its plane.
pub fn repaired(tensor: &Matrix3, mass: f64) -> Option<Repaired> {
    let eigen = SymmetricEigen::new(Tensor::from_fn(|i, j| tensor[i][j]));
    let mut order = [0, 1, 2];
    order.sort_by(|i, j| eigen.eigenvalues[*i].total_cmp(&eigen.eigenvalues[*j]));
    let before = order.each(|i| eigen.eigenvalues[i]);
    let [a, b, c] = before;
    let slack = SIX_DIGITS * c.abs();
    if a >= -slack && c <= a + b + slack {
        return None;
    }
    // The radius of gyration is smaller than an atom: zero with round-off.
    if a.abs().max(c.abs()) <= ATOM * ATOM * mass {
        return Some(Repaired { tensor: [[0.0; 3]; 3], change: 0.0, before, after: [0.0; 3] });
    }
    let [a, b] = [a.max(0.0), b.max(0.0)];
    let after = [a, b, c.min(a + b)];
    let change = (0..3).fold(0.0f64, |most, i| most.max((after[i] - before[i]).abs())) / c;
    let is_near = (0.0..=MOST).contains(&change);
    is_near.then(|| Repaired { tensor: with_moments(&eigen, order, after), change, before, after })
}

/// The tensor of these moments along the axes of another.
fn with_moments(eigen: &SymmetricEigen<f64, nalgebra::U3>, order: [usize; 3], moments: [f64; 3]) -> Matrix3 {
    let mut diagonal = Vector3::zeros();
    (0..3).for_each(|i| diagonal[order[i]] = moments[i]);
    let axes = &eigen.eigenvectors;
    let tensor = axes * Tensor::from_diagonal(&diagonal) * axes.transpose();
    from_fn(|i| from_fn(|j| 0.5 * (tensor[(i, j)] + tensor[(j, i)])))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn diagonal(moments: [f64; 3]) -> Matrix3 {
        from_fn(|i| from_fn(|j| if i == j { moments[i] } else { 0.0 }))
    }

    /// The largest moment becomes the sum of the others, wherever the axes are; round-off of data and wrong data stay.
    #[test]
    fn moments_that_no_body_has_are_made_valid() {
        let axes = crate::math::rotation::matrix_from_quaternion(&[0.5, 0.5, -0.1, 0.7]);
        let frame = crate::import::transform::Transform {
            r: [0.0; 3],
            turn: crate::math::rotation::quaternion_from_axes(&from_fn(|i| from_fn(|j| axes[j][i]))),
        };
        let found = repaired(&frame.tensor(&diagonal([1.0, 3.003, 2.0])), 1.0).unwrap();
        let expected = frame.tensor(&diagonal([1.0, 3.0, 2.0]));
        let error = found.tensor.iter().flatten().zip(expected.iter().flatten()).map(|(x, y)| (x - y).abs());
        assert!(error.fold(0.0, f64::max) < 1e-14 && (found.change - 0.003 / 3.003).abs() < 1e-12);
        assert!(repaired(&diagonal([-0.01, 1.0, 1.0]), 1.0).is_some_and(|found| found.after[0] == 0.0));
        assert!(repaired(&diagonal([1.0, 2.0, 3.0 * (1.0 + 1e-4)]), 1.0).is_some());
        for same in [[1.0, 1.0, 1.0], [1.0, 2.0, 3.0 * (1.0 + 1e-7)], [1.0, 1.0, 3.0], [-1.0, -1.0, -1.0], [0.0; 3]] {
            assert!(repaired(&diagonal(same), 1.0).is_none(), "{same:?}");
        }
    }

    /// Radii of gyration of 1e-11 m are zero, those of 1e-9 m are not.
    #[test]
    fn moments_of_round_off_are_zero() {
        let found = |radius: f64| repaired(&diagonal([0.0, 0.0, 2.0 * radius * radius]), 2.0);
        assert!(found(1e-11).is_some_and(|found| found.tensor == [[0.0; 3]; 3]));
        assert!(found(1e-9).is_none());
    }
}
