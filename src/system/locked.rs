//! Joints that lock translations and rotations of two rigid bodies: derivatives in closed form.
//!
//! With frames (r, e_i) of marker A and (r, f_j) of marker B, centres c of their bodies and r = c + a, the rows are
//! products of two vectors, each fixed in one of the bodies or in the world:
//!
//! ```text
//! translations, all:   x_i . (r_B - r_A)     x_i axes of the world
//! translations, some:  e_i . (r_B - r_A)
//! rotations in space:  e_i . f_j             in the plane: turn_B - turn_A, with constant derivatives
//! ```
//!
//! Their generic definition is the kernel of [`Lock`], which tests compare with.

use super::solid::Solid;
use crate::body::{Frame, Wrench, cross, dot, sub};
use crate::joint::Lock;
use crate::math::array::{Each, from_fn};
use crate::math::{Scalar, Taylor};

/// Gradient of row `row` with respect to the body that carries marker `slot`, as a wrench (t, m) about its centre c: a
/// change of the row is t . dc + m . dtheta. With w held, d(phi', phi'')/dq are its rates along the motion, since
/// what differs is the motion as a whole, translated or turned.
pub(super) fn row_gradient<S: Scalar, const D: usize>(
    lock: &Lock<D>,
    frames: [&Frame<S, D>; 2],
    slot: usize,
    centre: &[S; D],
    row: usize,
) -> Wrench<S, D> {
    let [a, b] = frames;
    let sign = if slot == 0 { -1.0 } else { 1.0 };
    let mut gradient = Wrench::zero();
    let all = lock.translation.len();
    if row < all {
        let point = if all == D { frames[slot].r } else { b.r };
        if all == D {
            gradient.force[row] = S::constant(sign)
        } else {
            gradient.force = lock.axis(a, lock.translation[row]).each(|e| e * sign)
        }
        gradient.torque = cross(&sub(&point, centre), &gradient.force);
    } else if D == 2 {
        gradient.torque[2] = S::constant(sign);
    } else {
        let (i, j) = lock.rotation[row - all];
        gradient.torque = cross(&lock.axis(a, i), &lock.axis(b, j)).each(|m| m * -sign);
    }
    gradient
}

/// d(phi, phi', phi'')/dq along the velocities of the body that carries marker `slot`: `write(row, velocity, ..)`.
pub(super) fn write_rates<const D: usize>(
    lock: &Lock<D>,
    frames: [&Frame<Taylor<f64>, D>; 2],
    slot: usize,
    solid: &Solid<D>,
    mut write: impl FnMut(usize, usize, Taylor<f64>),
) {
    for row in 0..lock.translation.len() + lock.rotation.len() {
        let gradient = row_gradient(lock, frames, slot, &solid.centre, row);
        solid.translations().for_each(|(i, velocity)| write(row, velocity, gradient.force[i]));
        solid.rotations().for_each(|(k, velocity)| write(row, velocity, solid.about(k, &gradient.torque)));
    }
}

impl<const D: usize> Lock<D> {
    /// True if rotations alone change the forces of its multipliers, as those along axes of the world: the blocks of
    /// K are then those of the rotations.
    pub(super) fn changes_with_rotations(&self) -> bool {
        [0, D].contains(&self.translation.len())
    }

    /// True if motions of one body change the forces on the other.
    pub(super) fn couples_bodies(&self) -> bool {
        !self.changes_with_rotations() || D == 3 && !self.rotation.is_empty()
    }
}

/// The two bodies of a joint, with what K = d(G^T lambda)/dq is added to.
pub(super) struct LockedStiffness<'a, const D: usize> {
    /// The bodies of markers A and B; none: the ground.
    pub solids: [Option<Solid<D>>; 2],
    /// The first entry of each block of K, `first[row][column]`.
    pub first: &'a [[Option<usize>; 2]; 2],
    /// True if these are blocks of the rotations alone.
    pub are_rotations: bool,
    pub k: &'a mut [f64],
}

const A: Option<usize> = Some(0);
const B: Option<usize> = Some(1);

impl<const D: usize> LockedStiffness<'_, D> {
    /// Adds that of a joint with the multipliers `lambda`.
    pub fn add(&mut self, lock: &Lock<D>, frames: [&Frame<Taylor<f64>, D>; 2], lambda: &[f64]) {
        let [a, b] = frames.each(|frame| frame.map(|x| x.x));
        let (pulls, turns) = lambda.split_at(lock.translation.len());
        let centre = |slot: usize, r: [f64; D]| self.solids[slot].as_ref().map_or(r, Solid::place);
        let centres = [centre(0, a.r), centre(1, b.r)];
        if pulls.len() == D {
            let force: [f64; D] = from_fn(|i| pulls[i]);
            self.product(None, force, B, sub(&b.r, &centres[1]));
            self.product(None, force.each(|f| -f), A, sub(&a.r, &centres[0]));
        } else if !pulls.is_empty() {
            // e . (r_B - r_A) = e . a_B + e . (c_B - c_A) - e . a_A, of which the last does not change.
            let mut force = [0.0; D];
            for (&lambda, &i) in pulls.iter().zip(lock.translation) {
                force.iter_mut().zip(lock.axis(&a, i)).for_each(|(force, e)| *force += lambda * e);
            }
            self.product(A, force, B, sub(&b.r, &centres[1]));
            self.shift(&force, &sub(&centres[1], &centres[0]));
        }
        if D == 3 {
            for (&lambda, &(i, j)) in turns.iter().zip(lock.rotation) {
                self.product(A, lock.axis(&a, i).each(|e| lambda * e), B, lock.axis(&b, j));
            }
        }
    }

    /// x . y, each of the vectors fixed in a body or in the world. With s = x . y, the blocks of (x's body, y's body) are
    /// y x^T - s, x y^T - s on the diagonal, and s - y x^T, s - x y^T beside it.
    fn product(&mut self, own: Option<usize>, x: [f64; D], other: Option<usize>, y: [f64; D]) {
        let s = dot(&x, &y);
        let minus = |v: &[f64; D]| v.each(|x| -x);
        self.turn(own, own, -s, &y, &x);
        self.turn(other, other, -s, &x, &y);
        self.turn(own, other, s, &minus(&y), &x);
        self.turn(other, own, s, &minus(&x), &y);
    }

    /// e . (c_B - c_A) with e fixed in A.
    fn shift(&mut self, e: &[f64; D], gap: &[f64; D]) {
        self.turn(A, A, -dot(e, gap), gap, e);
        for (slot, sign) in [(0, -1.0), (1, 1.0)] {
            let [Some(turning), Some(moving)] = [&self.solids[0], &self.solids[slot]] else { continue };
            let [Some(upper), Some(lower)] = [self.first[0][slot], self.first[slot][0]] else { continue };
            let width = moving.count();
            let own = turning.count();
            for (k, angle) in turning.rotations() {
                let turned = turning.turned(k, e);
                for (i, place) in moving.translations() {
                    self.k[upper + angle * width + place] += sign * turned[i];
                    self.k[lower + place * own + angle] += sign * turned[i];
                }
            }
        }
    }

    /// Adds alpha + p q^T, in axes of the world, to a block of rotations.
    fn turn(&mut self, row: Option<usize>, column: Option<usize>, alpha: f64, p: &[f64; D], q: &[f64; D]) {
        let (Some(row), Some(column)) = (row, column) else { return };
        let [Some(left), Some(right)] = [&self.solids[row], &self.solids[column]] else { return };
        let Some(first) = self.first[row][column] else { return };
        let width = if self.are_rotations { right.rotations().count() } else { right.count() };
        for (k, i) in left.rotations() {
            let along = if D == 2 { 0.0 } else { left.along(k, p) };
            for (l, j) in right.rotations() {
                let [i, j] = if self.are_rotations { [k, l] } else { [i, j] };
                let place = &mut self.k[first + i * width + j];
                *place += match D {
                    2 => alpha,
                    _ => alpha * dot(left.axis(k), right.axis(l)) + along * right.along(l, q),
                };
            }
        }
    }
}
