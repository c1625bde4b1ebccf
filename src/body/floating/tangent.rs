//! K and C of the inertia forces.
//!
//! With r = (r_r, r_t, r_i) the rows of M v' - f, a = A^T (r'' - g), alpha = w', and the bracket
//! B = alpha x s + w x (w x s) + 2 w x s' + s'':
//!
//! ```text
//! s'' = sum_i q_i'' mu_i + sum_ij q_i' q_j' m_ij
//! r_r = m (r'' - g) + A B
//! r_t = s x a + J alpha + w x J w + 2 (tr(Q) w - Q^T w) + ax(sum_i q_i'' W_i + sum_ij q_i' q_j' P_0ij)
//! r_i = mu_i.a + alpha.ax(W_i) + w.W_i w - w.w tr(W_i) + 2 w.ax(V_i) + sum_j tr(P_ij) q_j''
//! ```
//!
//! A turn dtheta of the frame, in its axes, changes a by a x dtheta and A B by A (dtheta x B); a change of q_j changes
//! s by mu_j, mu_i by m_ij, W_i by P_ji + P_0ij and P by W_j + W_j^T.

use super::algebra::*;
use super::inertia::{angular_velocity, local, world};
use super::moving::MovingPiece;
use super::{Floating, frame, frame_velocities, turn_velocity, turns};
use crate::body::{BodyState, Frame, cross, dot, unit};
use crate::math::array::from_fn;

/// Motion of the floating frame at a state.
struct FrameMotion<'a, const D: usize> {
    own: Frame<f64, D>,
    w: [f64; 3],
    alpha: [f64; 3],
    /// A^T (r'' - g)
    a: [f64; D],
    /// Elastic accelerations.
    vdot: &'a [f64],
}

impl<const D: usize> FrameMotion<'_, D> {
    /// alpha x u + w x (w x u)
    fn swept(&self, u: &[f64; D]) -> [f64; D] {
        let whirl = spin(&self.w, &spin(&self.w, u));
        let swing = spin(&self.alpha, u);
        from_fn(|k| whirl[k] + swing[k])
    }
}

impl<const D: usize> Floating<D> {
    pub(super) fn add_inertia_tangent(&self, at: BodyState<D>, k: &mut [f64], c: &mut [f64]) {
        let own = frame::<f64, D>(at.q);
        let motion = FrameMotion {
            a: local(&own, &from_fn(|k| at.vdot[k] - at.gravity[k])),
            own,
            w: angular_velocity::<_, D>(at.v),
            alpha: angular_velocity::<_, D>(at.vdot),
            vdot: &at.vdot[frame_velocities(D)..],
        };
        for (piece, moving) in self.moving(at.q, at.v).enumerate() {
            self.add_frame_stiffness(&motion, &moving, k);
            self.add_frame_damping(&motion, &moving, c);
            for j in 0..moving.piece.dofs.len() {
                self.add_mixed(&motion, &moving, j, k, c);
                self.add_elastic(&motion, &moving, piece, j, k, c);
            }
        }
    }

    /// k += d(r_r, r_t)/dtheta.
    fn add_frame_stiffness(&self, motion: &FrameMotion<D>, moving: &MovingPiece<f64, D>, k: &mut [f64]) {
        let s = moving.s();
        let swept = motion.swept(&s);
        let rate = moving.momentum(moving.v);
        let (push, (drift, _)) = (moving.momentum(motion.vdot), moving.swerve(moving.v));
        let coriolis = spin(&motion.w, &rate);
        let bracket: [f64; D] = from_fn(|i| swept[i] + 2.0 * coriolis[i] + push[i] + drift[i]);
        for l in turns(D) {
            let column = turn_velocity(D, l);
            let force = world(&motion.own, &spin(&unit(l), &bracket));
            (0..D).for_each(|i| k[self.layout.frame(i, column)] += force[i]);
            let turned = spin(&unit(l), &motion.a);
            let moment = cross(&s, &turned);
            turns(D).for_each(|i| k[self.layout.frame(turn_velocity(D, i), column)] -= moment[i]);
        }
    }

    /// c += d(r_r, r_t)/dw.
    fn add_frame_damping(&self, motion: &FrameMotion<D>, moving: &MovingPiece<f64, D>, c: &mut [f64]) {
        let s = moving.s();
        let rate = moving.momentum(moving.v);
        let w = &motion.w;
        let p = moving.p();
        let q = transposed(&moving.flow(moving.v));
        for l in turns(D) {
            let e = unit(l);
            let column = turn_velocity(D, l);
            let first = spin(&e, &spin(w, &s));
            let second = spin(w, &spin(&e, &s));
            let third = spin(&e, &rate);
            let force = world(&motion.own, &from_fn(|i| first[i] + second[i] + 2.0 * third[i]));
            (0..D).for_each(|i| c[self.layout.frame(i, column)] += force[i]);
            let first = cross(&e, &swung(&p, w));
            let second = cross(w, &swung(&p, &e));
            let third = swung(&q, &e);
            turns(D).for_each(|i| {
                c[self.layout.frame(turn_velocity(D, i), column)] += first[i] + second[i] + 2.0 * third[i];
            });
        }
    }

    /// d(r_r, r_t)/dq_j and d(r_r, r_t)/dq_j', d(r_j)/dtheta and d(r_j)/dw.
    fn add_mixed(&self, motion: &FrameMotion<D>, moving: &MovingPiece<f64, D>, j: usize, k: &mut [f64], c: &mut [f64]) {
        let dof = moving.piece.dofs[j];
        let mu = moving.mu(j);
        let w = &motion.w;
        let drift = moving.drift(moving.v, j);
        let pushed_on = moving.drift(motion.vdot, j);
        let swept = motion.swept(&mu);
        let coriolis = spin(w, &drift);
        let force = world(&motion.own, &from_fn(|i| swept[i] + 2.0 * coriolis[i] + pushed_on[i]));
        let turned = spin(w, &mu);
        let braking = world(&motion.own, &from_fn(|i| turned[i] + drift[i]));
        for i in 0..D {
            k[self.layout.column(i, dof)] += force[i];
            c[self.layout.column(i, dof)] += 2.0 * braking[i];
        }
        let weighed = moving.w(j);
        let rated = moving.rated(moving.v, j);
        let curving = moving.curved(moving.v, j);
        let curved = moving.curved(motion.vdot, j);
        let grown: Tensor<f64, D> = from_fn(|a| from_fn(|b| weighed[a][b] + weighed[b][a]));
        let (lever, swing, gyroscopic) =
            (cross(&mu, &motion.a), swung(&grown, &motion.alpha), cross(w, &swung(&grown, w)));
        let flow: Tensor<f64, D> = from_fn(|a| from_fn(|b| rated[a][b] + curving[b][a]));
        let stretching = swung(&flow, w);
        let push = axial(&moving.rated(motion.vdot, j));
        let push_on = axial(&curved);
        let moving_out = swung(&transposed(&weighed), w);
        let swerving = axial(&curving);
        let outward = swung(&grown, w);
        let rotating = axial(&rated);
        for i in turns(D) {
            let turn = turn_velocity(D, i);
            let pushing = push_on[i] - push[i];
            k[self.layout.column(turn, dof)] += lever[i] + swing[i] + gyroscopic[i] + 2.0 * stretching[i] + pushing;
            c[self.layout.column(turn, dof)] += 2.0 * (moving_out[i] + swerving[i]);
            k[self.layout.row(dof, turn)] -= dot(&mu, &spin(&unit(i), &motion.a));
            c[self.layout.row(dof, turn)] += 2.0 * rotating[i] - outward[i];
        }
    }

    /// d(r_i)/dq_j and d(r_i)/dq_j', for all i of the piece.
    fn add_elastic(
        &self,
        motion: &FrameMotion<D>,
        moving: &MovingPiece<f64, D>,
        piece: usize,
        j: usize,
        k: &mut [f64],
        c: &mut [f64],
    ) {
        let n = moving.piece.dofs.len();
        let places = &self.layout.pieces[piece].tangent;
        for i in 0..n {
            // int rho psi_j psi_i^T
            let product = &moving.piece.products[(j + 1) * (n + 1) + i + 1];
            let turned = axial(product);
            k[places[i * n + j]] += dot(&motion.alpha, &turned) - whirled(product, &motion.w);
            c[places[i * n + j]] += 2.0 * dot(&motion.w, &turned);
        }
        for second in &moving.piece.second[j] {
            let place = places[second.other * n + j];
            let swing = dot(&motion.alpha, &axial(&second.product)) - whirled(&second.product, &motion.w);
            k[place] += dot(&second.moment, &motion.a) + swing;
        }
    }
}
