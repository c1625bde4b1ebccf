//! A flexible body in a floating frame.
//!
//! Coordinates: those of a rigid body for the frame (x, y, angle; or position and unit quaternion with the angular
//! velocity w in the frame's axes), then the elastic ones q_i. With u = psi_0 + sum_i psi_i q_i in the frame's axes A,
//!
//! ```text
//! x  = r + A u
//! x' = r' + A (w x u + u')
//! x''= r'' + A (w' x u + w x (w x u) + 2 w x u' + u'')
//! int rho dx . x'' dV = 0  for dx = dr + A (dtheta x u + sum_i psi_i dq_i),
//! ```
//!
//! less the work of gravity and of the elastic forces K q + D q' and those of geometric stiffening. The whole coupling
//! of rigid and elastic motion is kept; integrals are computed once, piece by piece, so that work and memory grow
//! linearly with the number of elements. The sections of a beam add the rotary inertia of rigid discs. Source: Shabana,
//! Dynamics of Multibody Systems, chapter 5.

mod algebra;
mod discs;
mod elastic;
mod inertia;
mod layout;
mod moving;
mod part;
mod point;
mod small_turn;
mod spec;
mod tangent;

use super::flexible::{Elastic, PointShape};
use super::kernel::coordinate_path;
use super::{Bent, Body, BodyFacts, BodyOver, BodyState, Energy, Frame, Marker, Pose, Wrench, norm};
use crate::math::rotation::{axes_from_quaternion, quaternion_rate};
use crate::math::{Scalar, Taylor};
use layout::FloatingLayout;
use moving::Curves;

pub use part::{load, resistance};
pub use point::place;

/// A flexible body: its displacement functions with their integrals, and the patterns of its matrices.
pub struct Floating<const D: usize> {
    elastic: Elastic<D>,
    /// The floating frame first; markers of a beam are at [s, y(, z)], with axes in those of the frame.
    markers: Vec<Marker<D>>,
    shapes: Vec<PointShape<D>>,
    layout: FloatingLayout,
    curves: Vec<Curves<D>>,
    /// Constant contributions (place, value) of the discs to M, in the plane.
    discs_in_plane: Vec<(usize, f64)>,
}

/// Number of coordinates of the floating frame.
pub const fn frame_coordinates(dimension: usize) -> usize {
    if dimension == 2 { 3 } else { 7 }
}

/// Number of velocities of the floating frame.
pub const fn frame_velocities(dimension: usize) -> usize {
    if dimension == 2 { 3 } else { 6 }
}

/// The axes that the frame may rotate about.
const fn turns(dimension: usize) -> std::ops::Range<usize> {
    if dimension == 2 { 2..3 } else { 0..3 }
}

/// Index of the frame's angular velocity about axis `k`.
const fn turn_velocity(dimension: usize, k: usize) -> usize {
    if dimension == 2 { k } else { 3 + k }
}

impl<const D: usize> Floating<D> {
    /// A body with these markers and the displacement functions of each; the first marker is the floating frame.
    pub fn new(elastic: Elastic<D>, markers: Vec<Marker<D>>, shapes: Vec<PointShape<D>>) -> Self {
        let layout = FloatingLayout::new(&elastic, frame_velocities(D));
        let curves = elastic.inertia.pieces.iter().map(Curves::of).collect();
        let mut body = Floating { elastic, markers, shapes, layout, curves, discs_in_plane: Vec::new() };
        body.discs_in_plane = body.constant_mass();
        body
    }
}

/// The floating frame at coordinates q.
#[inline]
fn frame<S: Scalar, const D: usize>(q: &[S]) -> Frame<S, D> {
    let mut frame = Frame::world();
    frame.r.copy_from_slice(&q[..D]);
    if D == 2 {
        let (s, c) = q[2].sin_cos();
        frame.turn = q[2];
        frame.axes[0].copy_from_slice(&[c, s]);
        frame.axes[1].copy_from_slice(&[-s, c]);
    } else {
        let axes = axes_from_quaternion(&q[3..7]);
        frame.axes.iter_mut().zip(&axes).for_each(|(axis, column)| axis.copy_from_slice(column));
    }
    frame
}

/// q' = N(q) v of the frame alone.
#[inline]
fn frame_rate<S: Scalar, const D: usize>(q: &[S], v: &[S], qdot: &mut [S]) {
    qdot[..D].copy_from_slice(&v[..D]);
    match D {
        2 => qdot[2] = v[2],
        _ => quaternion_rate(&q[3..7], &v[3..6], &mut qdot[3..7]),
    }
}

impl<S: Scalar, const D: usize> BodyOver<S, D> for Floating<D> {
    fn rate(&self, q: &[S], v: &[S], qdot: &mut [S]) {
        frame_rate::<S, D>(q, v, qdot);
        qdot[frame_coordinates(D)..].copy_from_slice(&v[frame_velocities(D)..]);
    }

    fn motion(&self, q: &[S], v: &[S], vdot: Option<&[S]>, first: usize, out: &mut [Frame<Taylor<S>, D>]) {
        let nq = frame_coordinates(D);
        let nv = frame_velocities(D);
        let mut path = [Taylor::fixed(S::zero()); 8];
        let of_frame = vdot.map(|vdot| &vdot[..nv]);
        coordinate_path(frame_rate::<S, D>, &q[..nq], &v[..nv], of_frame, &mut path[..nq]);
        let own = frame(&path[..nq]);
        let coordinate = |i: usize| Taylor::new(q[nq + i], v[nv + i], vdot.map_or(S::zero(), |vdot| vdot[nv + i]));
        for ((out, marker), shape) in out.iter_mut().zip(&self.markers[first..]).zip(&self.shapes[first..]) {
            *out = point::place(&own, shape, marker, coordinate);
        }
    }

    fn pull_back(&self, marker: usize, q: &[S], at: &Frame<S, D>, wrench: &Wrench<S, D>, f: &mut [S]) {
        let own = frame::<S, D>(&q[..frame_coordinates(D)]);
        let (rigid, elastic) = f.split_at_mut(frame_velocities(D));
        point::pull_back_rigid(&own, at, wrench, rigid);
        point::pull_back_elastic(&own, &self.shapes[marker], &q[frame_coordinates(D)..], wrench, elastic);
    }

    fn energy(&self, q: &[S], v: &[S], gravity: &[f64; D]) -> Energy<S> {
        let inertia = self.inertia_energy(q, v, gravity);
        Energy {
            kinetic: inertia.kinetic + self.disc_energy(q, v),
            potential: inertia.potential + self.elastic_energy(q),
        }
    }
}

impl<const D: usize> Body<D> for Floating<D> {
    fn facts(&self) -> BodyFacts {
        let coordinates: &[&str] = if D == 2 { &["x", "y", "angle"] } else { &["x", "y", "z", "qw", "qx", "qy", "qz"] };
        let velocities: &[&str] = if D == 2 { &["x'", "y'", "angle'"] } else { &["x'", "y'", "z'", "wx", "wy", "wz"] };
        let elastic = &self.elastic.names;
        let named =
            |rigid: &[&str], elastic: Vec<String>| rigid.iter().map(|name| name.to_string()).chain(elastic).collect();
        let moved = |dofs: &[usize]| {
            let elastic = dofs.iter().map(|dof| frame_velocities(D) + dof);
            (0..frame_velocities(D)).chain(elastic).collect()
        };
        let stiffness = self.elastic.stiffness.iter().zip(&self.layout.sparing);
        BodyFacts {
            coordinate_names: named(coordinates, elastic.clone()),
            velocity_names: named(velocities, elastic.iter().map(|name| format!("{name}'")).collect()),
            supports: self.shapes.iter().map(|shape| moved(&shape.dofs)).collect(),
            mass_pattern: self.layout.mass.clone(),
            tangent_pattern: self.layout.tangent.clone(),
            stiffness: stiffness.filter_map(|((.., stiffness), place)| Some(((*place)?, *stiffness))).collect(),
            oriented: true,
            turning: (D == 3).then_some(turn_velocity(D, 0)),
            freedom: None,
            has_constant_mass: false,
            has_constant_forces: false,
            reach: self.shapes.iter().map(|shape| norm(&shape.rest)).fold(0.0, f64::max),
            elastic_count: elastic.len(),
            most_coordinates: usize::MAX,
        }
    }
    fn markers(&self) -> &[Marker<D>] {
        &self.markers
    }
    fn mass(&self, q: &[f64], values: &mut [f64]) {
        self.write_mass(q, values);
        self.add_disc_mass(q, values);
    }
    fn own_forces(&self, q: &[f64], v: &[f64], gravity: &[f64; D], f: &mut [f64]) {
        self.add_inertia_forces(q, v, gravity, f);
        self.add_disc_forces(q, v, f);
        self.add_elastic_forces(q, v, f);
    }
    fn tangent(&self, at: BodyState<D>, k: &mut [f64], c: &mut [f64]) {
        self.add_inertia_tangent(at, k, c);
        self.add_disc_tangent(at, k, c);
        self.add_elastic_tangent(at.q, k, c);
    }
    fn dissipation(&self, v: &[f64]) -> f64 {
        2.0 * elastic::half_square(&self.elastic.damping, &v[frame_velocities(D)..])
    }
    fn normalize(&self, q: &mut [f64]) {
        if D == 3 {
            let norm = q[3..7].iter().map(|x| x * x).sum::<f64>().sqrt();
            q[3..7].iter_mut().for_each(|x| *x /= norm);
        }
    }
    fn pose(&self, q: &[f64], v: &[f64]) -> Pose<D> {
        match D {
            2 => Pose::in_plane([q[0], q[1], q[2]], [v[0], v[1], v[2]]),
            _ => Pose::in_space(q, v),
        }
    }
    fn shapes(&self) -> &[PointShape<D>] {
        &self.shapes
    }
    fn bent(&self) -> Option<Bent<'_, D>> {
        let line = self.elastic.line.as_deref()?;
        Some(Bent { line, stretches: &self.elastic.stretches, first: frame_coordinates(D) })
    }
}
