//! Mass matrix, inertia forces and energies from the shape integrals of the pieces.
//!
//! The kinetic energy is exact to second order in the deformation. With the integrals s, mu_i, W_i and P of [`MovingPiece`],
//! V_i = int rho u' psi_i^T = sum_j q_j' P_ji, Q = int rho u u'^T = sum_i q_i' W_i, J = tr(P) - P, and
//! ax(X) = int u x v of X = int u v^T:
//!
//! ```text
//!     [ m         .        .      ]        [ A (w x (w x s) + 2 w x s' + sum_ij q_i' q_j' m_ij)        ]
//! M = [ s~ A^T    J        .      ]  f = - [ w x J w + 2 (tr(Q) w - Q^T w) + ax(sum_ij q_i' q_j' P_0ij) ] + weight
//!     [ mu_i A^T  ax(W_i)  tr P_ij ]        [ w.W_i w - w.w tr W_i + 2 w.ax V_i                         ]
//! ```

use super::algebra::*;
use super::moving::{MovingPiece, symmetric};
use super::{Floating, frame, frame_coordinates, frame_velocities, turn_velocity, turns};
use crate::body::{Energy, Frame, cross, dot, unit};
use crate::math::Scalar;
use crate::math::array::{Each, from_fn};

/// Components of a world vector in the frame's axes.
#[inline]
pub(super) fn local<S: Scalar, const D: usize>(own: &Frame<S, D>, vector: &[S; D]) -> [S; D] {
    from_fn(|k| dot(&own.axes[k], vector))
}

/// World components of a vector given in the frame's axes.
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
    pub(super) fn moving<'a, S: Scalar>(
        &'a self,
        q: &'a [S],
        v: &'a [S],
    ) -> impl Iterator<Item = MovingPiece<'a, S, D>> {
        let q = &q[frame_coordinates(D)..];
        let v = v.get(frame_velocities(D)..).unwrap_or(&[]);
        self.elastic.inertia.pieces.iter().zip(&self.curves).map(move |(piece, curves)| MovingPiece {
            piece,
            q,
            v,
            curves,
        })
    }

    /// Writes the values of M.
    pub(super) fn write_mass(&self, q: &[f64], values: &mut [f64]) {
        values.fill(0.0);
        let own = frame::<f64, D>(q);
        let mut mass = 0.0;
        let mut s = [0.0; D];
        let mut p = [[0.0; D]; D];
        for (moving, places) in self.moving(q, &[]).zip(&self.layout.pieces) {
            mass += moving.piece.mass;
            add_scaled(&mut s, 1.0, &moving.s());
            add_matrix(&mut p, 1.0, &moving.against(0));
            let width = moving.piece.dofs.len() + 1;
            for (i, &dof) in moving.piece.dofs.iter().enumerate() {
                let w = moving.w(i);
                add_matrix(&mut p, moving.q[dof], &w);
                let row = &mut values[self.layout.coupling_mass(dof)..][..frame_velocities(D)];
                row.iter_mut().zip(world(&own, &moving.mu(i))).for_each(|(value, m)| *value += m);
                turns(D).for_each(|k| row[turn_velocity(D, k)] += axial(&w)[k]);
                for j in 0..=i {
                    let product = &moving.piece.products[(i + 1) * width + j + 1];
                    values[places.mass[i * (i + 1) / 2 + j]] += trace(product);
                }
            }
        }
        self.write_frame_mass(&own, mass, &s, &symmetric(&p), values);
    }

    fn write_frame_mass(&self, own: &Frame<f64, D>, mass: f64, s: &[f64; D], p: &Tensor<f64, D>, values: &mut [f64]) {
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
        let own = frame::<f64, D>(q);
        let w = angular_velocity::<_, D>(v);
        // The weight is the inertia force of the acceleration -g.
        let lift = local(&own, &gravity.each(|g| -g));
        for moving in self.moving(q, v) {
            let (s, rate, (drift, swerve)) = (moving.s(), moving.momentum(moving.v), moving.swerve(moving.v));
            let whirl = spin(&w, &spin(&w, &s));
            let coriolis = spin(&w, &rate);
            let force = world(&own, &from_fn(|k| whirl[k] + 2.0 * coriolis[k] + drift[k]));
            (0..D).for_each(|k| f[k] += moving.piece.mass * gravity[k] - force[k]);
            let mut p = moving.against(0);
            let mut flow = [[0.0; D]; D];
            for (i, &dof) in moving.piece.dofs.iter().enumerate() {
                let weighed = moving.w(i);
                add_matrix(&mut p, moving.q[dof], &weighed);
                add_matrix(&mut flow, moving.v[dof], &weighed);
                let centrifugal = whirled(&weighed, &w);
                let coriolis = 2.0 * dot(&w, &axial(&moving.rated(moving.v, i)));
                f[frame_velocities(D) + dof] += centrifugal - coriolis - dot(&moving.mu(i), &lift);
            }
            let gyroscopic = cross(&w, &swung(&symmetric(&p), &w));
            let stretching = swung(&transposed(&flow), &w);
            let hanging = cross(&s, &lift);
            turns(D)
                .for_each(|k| f[turn_velocity(D, k)] -= hanging[k] + gyroscopic[k] + 2.0 * stretching[k] + swerve[k]);
        }
    }

    /// Kinetic energy, and the potential of the weight.
    pub(super) fn inertia_energy<S: Scalar>(&self, q: &[S], v: &[S], gravity: &[f64; D]) -> Energy<S> {
        let own = frame::<S, D>(q);
        let w = angular_velocity::<S, D>(v);
        let speed: [S; D] = local(&own, &from_fn(|k| v[k]));
        let down = local(&own, &gravity.map(S::constant));
        let height = (0..D).fold(S::zero(), |sum, k| sum + q[k] * gravity[k]);
        let mut energy = Energy { kinetic: S::zero(), potential: S::zero() };
        for moving in self.moving(q, v) {
            let s = moving.s();
            let rate = moving.momentum(moving.v);
            let turning = spin(&w, &s);
            let drift: [S; D] = from_fn(|k| turning[k] + rate[k]);
            let mut twice = dot(&speed, &speed) * moving.piece.mass
                + dot(&speed, &drift) * 2.0
                + whirled(&moving.p(), &w)
                + dot(&w, &axial(&moving.flow(moving.v))) * 2.0;
            for (i, &dof) in moving.piece.dofs.iter().enumerate() {
                twice += moving.v[dof] * trace(&moving.rated(moving.v, i));
            }
            energy.kinetic += twice * 0.5;
            energy.potential -= height * moving.piece.mass + dot(&down, &s);
        }
        energy
    }
}
