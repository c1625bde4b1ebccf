//! Rotary inertia of the sections of a beam.
//!
//! A disc turned by R of a = sum_i r_i q_i ([`SmallTurn`]) has, in its own axes, with the frame's angular velocity w,
//!
//! ```text
//! w_s    = R^T w + T a',    kinetic energy w_s.J w_s/2
//! w_s'   = R^T w' + T a'' + h,    h = R^T w x T a' - (a.a'/2)/(1 + a.a/4) T a'
//! moment = J w_s' + w_s x J w_s
//! ```
//!
//! Its reaction to the frame's rotation is R moment, to q_i it is r_i . T^T moment. Its energy is a square at any a, so
//! that the mass matrix of the body stays positive at any deformation; integrals to a finite order in q would not keep
//! it so. In the plane w_s = w + a': a constant mass, and nothing else.

use super::inertia::angular_velocity;
use super::small_turn::SmallTurn;
use super::{Floating, frame_coordinates, frame_velocities, turn_velocity, turns};
use crate::body::flexible::Disc;
use crate::body::{BodyState, cross, dot, unit};
use crate::math::array::{Each, from_fn};
use crate::math::{Dual, Scalar};

type Matrix3 = [[f64; 3]; 3];

/// Rotation of a disc in space: that of the frame, and a in it.
struct TurningDisc<S> {
    /// w and w'
    frame: [[S; 3]; 2],
    /// a, a' and a''
    own: [[S; 3]; 3],
}

/// Inertia moments of a disc against the rotation of the frame and against a.
struct Resistance<S> {
    frame: [S; 3],
    own: [S; 3],
}

impl<S: Scalar> TurningDisc<S> {
    fn of<const D: usize>(disc: &Disc, q: &[S], v: &[S], vdot: &[S]) -> Self {
        let elastic = |x: &[S], first: usize| turn(disc, x.get(first..).unwrap_or(&[]));
        let frame = |x: &[S]| if x.is_empty() { [S::zero(); 3] } else { angular_velocity::<S, D>(x) };
        let [n, m] = [frame_coordinates(D), frame_velocities(D)];
        TurningDisc { frame: [frame(v), frame(vdot)], own: [elastic(q, n), elastic(v, m), elastic(vdot, m)] }
    }

    /// Angular velocity w_s of the disc in its own axes.
    fn spin(&self) -> [S; 3] {
        let ([w, _], [a, rate, _]) = (&self.frame, &self.own);
        let small = SmallTurn::of(*a);
        let [carried, own] = [small.back(w), small.rate(rate)];
        from_fn(|k| carried[k] + own[k])
    }

    fn resistance(&self, inertia: &Matrix3) -> Resistance<S> {
        let ([w, alpha], [a, rate, acceleration]) = (&self.frame, &self.own);
        let small = SmallTurn::of(*a);
        let [carried, own] = [small.back(w), small.rate(rate)];
        let spin: [S; 3] = from_fn(|k| carried[k] + own[k]);
        let [swing, push, mixed] = [small.back(alpha), small.rate(acceleration), cross(&carried, &own)];
        let slowing = dot(a, rate) * small.factor * 0.5;
        let inertial = times(inertia, &from_fn(|k| swing[k] + push[k] + mixed[k] - own[k] * slowing));
        let gyroscopic = cross(&spin, &times(inertia, &spin));
        let moment = from_fn(|k| inertial[k] + gyroscopic[k]);
        Resistance { frame: small.turned(&moment), own: small.felt(&moment) }
    }
}

/// The three blocks of a disc's mass matrix: frame rotation, coupling of a with it, and a.
struct Mass {
    frame: Matrix3,
    mixed: Matrix3,
    own: Matrix3,
}

impl Mass {
    fn of<const D: usize>(disc: &Disc, q: &[f64]) -> Mass {
        let inertia = &disc.inertia;
        if D == 2 {
            let about_z = from_fn(|i| from_fn(|j| if i + j == 4 { inertia[2][2] } else { 0.0 }));
            return Mass { frame: about_z, mixed: about_z, own: about_z };
        }
        let small = SmallTurn::of(turn(disc, q));
        let units: Matrix3 = from_fn(unit);
        let [back, rate] = [units.each(|e| small.back(&e)), units.each(|e| small.rate(&e))];
        let turned = back.each(|column| times(inertia, &column));
        let pushed = rate.each(|column| times(inertia, &column));
        let product = |a: &Matrix3, b: &Matrix3| from_fn(|i| from_fn(|j| dot(&a[i], &b[j])));
        Mass { frame: product(&back, &turned), mixed: product(&rate, &turned), own: product(&rate, &pushed) }
    }
}

impl<const D: usize> Floating<D> {
    /// Contributions (place, value) of the discs to M in the plane, where they are constant.
    pub(super) fn constant_mass(&self) -> Vec<(usize, f64)> {
        if D == 3 {
            return Vec::new();
        }
        let mut values = vec![0.0; self.layout.mass.len()];
        self.add_masses(&[], &mut values);
        values.into_iter().enumerate().filter(|(_, value)| *value != 0.0).collect()
    }

    pub(super) fn add_disc_mass(&self, q: &[f64], values: &mut [f64]) {
        match D {
            2 => self.discs_in_plane.iter().for_each(|&(place, value)| values[place] += value),
            _ => self.add_masses(&q[frame_coordinates(D)..], values),
        }
    }

    fn add_masses(&self, q: &[f64], values: &mut [f64]) {
        for (disc, places) in self.elastic.inertia.discs.iter().zip(&self.layout.discs) {
            let mass = Mass::of::<D>(disc, q);
            for k in turns(D) {
                turns(D).filter(|&l| l <= k).for_each(|l| {
                    values[self.layout.frame_mass(turn_velocity(D, k), turn_velocity(D, l))] += mass.frame[k][l];
                });
            }
            for (i, (&dof, turn)) in disc.dofs.iter().zip(&disc.rotation).enumerate() {
                let row = &mut values[self.layout.coupling_mass(dof)..][..frame_velocities(D)];
                let coupling = transposed_times(&mass.mixed, turn);
                turns(D).for_each(|k| row[turn_velocity(D, k)] += coupling[k]);
                let felt = times(&mass.own, turn);
                let row = &places.mass[i * (i + 1) / 2..];
                row.iter().zip(&disc.rotation[..=i]).for_each(|(&place, other)| values[place] += dot(&felt, other));
            }
        }
    }

    /// f -= velocity-dependent part of the discs' inertia forces.
    pub(super) fn add_disc_forces(&self, q: &[f64], v: &[f64], f: &mut [f64]) {
        for disc in self.elastic.inertia.discs.iter().filter(|_| D == 3) {
            let resistance = TurningDisc::of::<D>(disc, q, v, &[]).resistance(&disc.inertia);
            turns(D).for_each(|k| f[turn_velocity(D, k)] -= resistance.frame[k]);
            for (&dof, turn) in disc.dofs.iter().zip(&disc.rotation) {
                f[frame_velocities(D) + dof] -= dot(turn, &resistance.own);
            }
        }
    }

    pub(super) fn disc_energy<S: Scalar>(&self, q: &[S], v: &[S]) -> S {
        if D == 2 {
            return self.discs_in_plane.iter().fold(S::zero(), |sum, &(place, value)| {
                let (i, j) = self.layout.mass[place];
                sum + v[i] * v[j] * if i == j { 0.5 * value } else { value }
            });
        }
        let energy = |disc: &Disc| {
            let spin = TurningDisc::of::<D>(disc, q, v, &[]).spin();
            dot(&spin, &times(&disc.inertia, &spin)) * 0.5
        };
        self.elastic.inertia.discs.iter().fold(S::zero(), |sum, disc| sum + energy(disc))
    }

    /// Adds the discs' inertia forces to K and C.
    pub(super) fn add_disc_tangent(&self, at: BodyState<D>, k: &mut [f64], c: &mut [f64]) {
        let discs = self.elastic.inertia.discs.iter().zip(&self.layout.discs);
        for (disc, places) in discs.filter(|_| D == 3) {
            let slopes = TurningDisc::of::<D>(disc, at.q, at.v, at.vdot).slopes(&disc.inertia);
            for l in 0..3 {
                let column = turn_velocity(D, l);
                let (frame, own) = slopes.along(2, &unit(l));
                turns(D).for_each(|i| c[self.layout.frame(turn_velocity(D, i), column)] += frame[i]);
                let rows = disc.dofs.iter().zip(&disc.rotation);
                rows.for_each(|(&dof, turn)| c[self.layout.row(dof, column)] += dot(turn, &own));
            }
            for (values, by) in [(&mut *k, 0), (&mut *c, 1)] {
                for (j, (&dof, turn)) in disc.dofs.iter().zip(&disc.rotation).enumerate() {
                    let (frame, own) = slopes.along(by, turn);
                    turns(D).for_each(|i| values[self.layout.column(turn_velocity(D, i), dof)] += frame[i]);
                    for (i, turn) in disc.rotation.iter().enumerate() {
                        values[places.tangent[i * disc.dofs.len() + j]] += dot(turn, &own);
                    }
                }
            }
        }
    }
}

/// Derivatives of the inertia moments by a, a' and w.
struct DiscSlopes(Resistance<Dual<f64, 9>>);

impl DiscSlopes {
    /// Derivative along a direction of a (`by` = 0), a' (1) or w (2).
    fn along(&self, by: usize, direction: &[f64; 3]) -> ([f64; 3], [f64; 3]) {
        let slope = |x: &Dual<f64, 9>| (0..3).map(|k| x.eps[3 * by + k] * direction[k]).sum();
        (from_fn(|i| slope(&self.0.frame[i])), from_fn(|i| slope(&self.0.own[i])))
    }
}

impl TurningDisc<f64> {
    fn slopes(&self, inertia: &Matrix3) -> DiscSlopes {
        let seeded = |x: &[f64; 3], by: usize| from_fn(|k| Dual::seeded(x[k], 3 * by + k));
        let fixed = |x: &[f64; 3]| x.map(Dual::fixed);
        let ([w, alpha], [a, rate, acceleration]) = (&self.frame, &self.own);
        let turning = TurningDisc {
            frame: [seeded(w, 2), fixed(alpha)],
            own: [seeded(a, 0), seeded(rate, 1), fixed(acceleration)],
        };
        DiscSlopes(turning.resistance(inertia))
    }
}

/// sum_i r_i x_i; zero where there are no x.
fn turn<S: Scalar>(disc: &Disc, x: &[S]) -> [S; 3] {
    let mut sum = [S::zero(); 3];
    for (&dof, turn) in disc.dofs.iter().zip(&disc.rotation).filter(|_| !x.is_empty()) {
        sum.iter_mut().zip(turn).for_each(|(sum, &r)| *sum += x[dof] * r);
    }
    sum
}

fn times<S: Scalar>(m: &Matrix3, x: &[S; 3]) -> [S; 3] {
    m.each(|row| x[0] * row[0] + x[1] * row[1] + x[2] * row[2])
}

fn transposed_times(m: &Matrix3, x: &[f64; 3]) -> [f64; 3] {
    from_fn(|k| m[0][k] * x[0] + m[1][k] * x[1] + m[2][k] * x[2])
}
