//! Mass matrix, inertia forces and energies, out of the shape integrals of the pieces.
//!
//! With p = (1, q), s = int rho u = sum_a p_a m_a, W_i = int rho u psi_i^T = sum_a p_a P_ai and P = int rho u u^T, and
//! their rates s' and V_i = int rho u' psi_i^T, Q = int rho u u'^T; J = tr(P) - P; ax(X) = int u x v of X = int u v^T:
//!
//! ```text
//!     [ m       .        . ]            [ A (w x (w x s) + 2 w x s')      ]
//! M = [ s~ A^T  J        . ]   f = - [ w x J w + 2 (tr(Q) w - Q^T w)   ] + weight
//!     [ m_i A^T ax(W_i)  tr P_ij ]      [ w.W_i w - w.w tr W_i + 2 w.ax V_i ]
//! ```

use super::algebra::*;
use super::{Floating, frame, frame_coordinates, frame_velocities, turn_velocity, turns};
use crate::body::flexible::Piece;
use crate::body::{Energy, Frame, dot};
use crate::math::Scalar;
use std::array::from_fn;

/// One piece at a state.
pub(super) struct Moving<'a, S, const D: usize> {
    pub piece: &'a Piece<D>,
    /// All elastic coordinates and velocities of the body.
    pub q: &'a [S],
    pub v: &'a [S],
}

impl<S: Scalar, const D: usize> Moving<'_, S, D> {
    /// int rho u psi_b^T, b = 0 for psi_0.
    #[inline]
    pub fn w(&self, b: usize) -> Matrix<S, D> {
        let mut sum = self.rated(self.q, b);
        add_matrix(&mut sum, S::one(), &self.piece.products[b]);
        sum
    }

    /// sum_j x_j int rho psi_j psi_b^T: with velocities int rho u' psi_b^T.
    #[inline]
    pub fn rated(&self, x: &[S], b: usize) -> Matrix<S, D> {
        let width = self.piece.dofs.len() + 1;
        let mut sum = [[S::zero(); D]; D];
        for (j, &dof) in self.piece.dofs.iter().enumerate() {
            add_matrix(&mut sum, x[dof], &self.piece.products[(j + 1) * width + b]);
        }
        sum
    }

    /// sum_j x_j m_j.
    #[inline]
    pub fn moment(&self, x: &[S]) -> [S; D] {
        let mut sum = [S::zero(); D];
        for (&dof, m) in self.piece.dofs.iter().zip(&self.piece.moments[1..]) {
            add_scaled(&mut sum, x[dof], m);
        }
        sum
    }

    /// s
    pub fn s(&self) -> [S; D] {
        let mut s = self.moment(self.q);
        add_scaled(&mut s, S::one(), &self.piece.moments[0]);
        s
    }

    /// int rho u x^T for x = u (`rest` 1, coordinates q) or one of its rates (`rest` 0).
    pub fn second(&self, rest: f64, x: &[S]) -> Matrix<S, D> {
        let mut sum = [[S::zero(); D]; D];
        if rest != 0.0 {
            add_matrix(&mut sum, S::constant(rest), &self.w(0));
        }
        for (i, &dof) in self.piece.dofs.iter().enumerate() {
            if x[dof] != S::zero() {
                add_matrix(&mut sum, x[dof], &self.w(i + 1));
            }
        }
        sum
    }
}

/// A world vector in the frame's axes.
#[inline]
pub(super) fn local<S: Scalar, const D: usize>(own: &Frame<S, D>, vector: &[S; D]) -> [S; D] {
    from_fn(|k| dot(&own.axes[k], vector))
}

/// A vector in the frame's axes in the world.
#[inline]
pub(super) fn world<const D: usize>(own: &Frame<f64, D>, vector: &[f64; D]) -> [f64; D] {
    from_fn(|k| (0..D).map(|i| own.axes[i][k] * vector[i]).sum())
}

/// Angular velocity of the frame in its axes.
#[inline]
pub(super) fn angular_velocity<S: Scalar, const D: usize>(v: &[S]) -> [S; 3] {
    let mut w = [S::zero(); 3];
    turns(D).for_each(|k| w[k] = v[turn_velocity(D, k)]);
    w
}

impl<const D: usize> Floating<D> {
    pub(super) fn moving<'a, S: Scalar>(&'a self, q: &'a [S], v: &'a [S]) -> impl Iterator<Item = Moving<'a, S, D>> {
        let (q, v) = (&q[frame_coordinates(D)..], v.get(frame_velocities(D)..).unwrap_or(&[]));
        self.elastic.pieces.iter().map(move |piece| Moving { piece, q, v })
    }

    /// Values of M.
    pub(super) fn write_mass(&self, q: &[f64], values: &mut [f64]) {
        values.fill(0.0);
        let own = frame::<f64, D>(q);
        let (mut mass, mut s, mut p) = (0.0, [0.0; D], [[0.0; D]; D]);
        for (moving, places) in self.moving(q, &[]).zip(&self.layout.pieces) {
            mass += moving.piece.mass;
            add_scaled(&mut s, 1.0, &moving.s());
            add_matrix(&mut p, 1.0, &moving.w(0));
            let width = moving.piece.dofs.len() + 1;
            for (i, &dof) in moving.piece.dofs.iter().enumerate() {
                let w = moving.w(i + 1);
                add_matrix(&mut p, moving.q[dof], &w);
                let row = &mut values[self.layout.coupling_mass(dof)..][..frame_velocities(D)];
                row.iter_mut().zip(world(&own, &moving.piece.moments[i + 1])).for_each(|(value, m)| *value += m);
                turns(D).for_each(|k| row[turn_velocity(D, k)] += axial(&w)[k]);
                for j in 0..=i {
                    let product = &moving.piece.products[(i + 1) * width + j + 1];
                    values[places.mass[i * (i + 1) / 2 + j]] += trace(product);
                }
            }
        }
        self.write_frame_mass(&own, mass, &s, &p, values);
    }

    fn write_frame_mass(&self, own: &Frame<f64, D>, mass: f64, s: &[f64; D], p: &Matrix<f64, D>, values: &mut [f64]) {
        (0..D).for_each(|i| values[self.layout.frame_mass(i, i)] = mass);
        for k in turns(D) {
            let row = turn_velocity(D, k);
            let arm = world(own, &spin(&unit(k), s));
            (0..D).for_each(|c| values[self.layout.frame_mass(row, c)] = arm[c]);
            let inertia = swung(p, &unit(k));
            turns(D).filter(|&l| l <= k).for_each(|l| {
                values[self.layout.frame_mass(row, turn_velocity(D, l))] = inertia[l];
            });
        }
    }

    /// f += weight and velocity-dependent inertia forces.
    pub(super) fn add_inertia_forces(&self, q: &[f64], v: &[f64], gravity: &[f64; D], f: &mut [f64]) {
        let (own, w) = (frame::<f64, D>(q), angular_velocity::<_, D>(v));
        // The weight is the inertia force of the acceleration -g.
        let lift = local(&own, &gravity.map(|g| -g));
        for moving in self.moving(q, v) {
            let (s, rate) = (moving.s(), moving.moment(moving.v));
            let whirl = spin(&w, &spin(&w, &s));
            let coriolis = spin(&w, &rate);
            let force = world(&own, &from_fn(|k| whirl[k] + 2.0 * coriolis[k]));
            (0..D).for_each(|k| f[k] += moving.piece.mass * gravity[k] - force[k]);
            let (p, second) = (moving.second(1.0, moving.q), moving.second(0.0, moving.v));
            let gyroscopic = cross3(&w, &swung(&p, &w));
            let stretching = swung(&transposed(&second), &w);
            let hanging = crate::body::cross(&s, &lift);
            turns(D).for_each(|k| f[turn_velocity(D, k)] -= hanging[k] + gyroscopic[k] + 2.0 * stretching[k]);
            for (i, &dof) in moving.piece.dofs.iter().enumerate() {
                let centrifugal = whirled(&moving.w(i + 1), &w);
                let coriolis = 2.0 * dot3(&w, &axial(&moving.rated(moving.v, i + 1)));
                f[frame_velocities(D) + dof] += centrifugal - coriolis - dot(&moving.piece.moments[i + 1], &lift);
            }
        }
    }

    /// Kinetic energy, and the potential of the weight.
    pub(super) fn inertia_energy<S: Scalar>(&self, q: &[S], v: &[S], gravity: &[f64; D]) -> Energy<S> {
        let (own, w) = (frame::<S, D>(q), angular_velocity::<S, D>(v));
        let speed: [S; D] = local(&own, &from_fn(|k| v[k]));
        let down = local(&own, &gravity.map(S::constant));
        let height = (0..D).fold(S::zero(), |sum, k| sum + q[k] * gravity[k]);
        let mut energy = Energy { kinetic: S::zero(), potential: S::zero() };
        for moving in self.moving(q, v) {
            let (s, rate) = (moving.s(), moving.moment(moving.v));
            let turning = spin(&w, &s);
            let drift: [S; D] = from_fn(|k| turning[k] + rate[k]);
            let mut twice = dot(&speed, &speed) * moving.piece.mass
                + dot(&speed, &drift) * 2.0
                + whirled(&moving.second(1.0, moving.q), &w)
                + dot3(&w, &axial(&moving.second(0.0, moving.v))) * 2.0;
            for (i, &dof) in moving.piece.dofs.iter().enumerate() {
                twice += moving.v[dof] * trace(&moving.rated(moving.v, i + 1));
            }
            energy.kinetic += twice * 0.5;
            energy.potential -= height * moving.piece.mass + dot(&down, &s);
        }
        energy
    }
}
