//! The modes of a mechanism at one state of its motion.

use super::rate_bound::rate_bound;
use crate::error::two;
use crate::formulation::{Dynamics, free_directions, reduce};
use crate::math::array::Each;
use crate::math::{dot, norm};
use crate::system::{MechanicalSystem, Need, OperatingPoint, Scratch, Tangent, Terms};
use crate::tolerances::initial::DENSE_EIGENVALUES;
use crate::tolerances::simulate as tolerances;
use serde::Serialize;
use std::fmt;

/// The mode exp(-decay t) cos(swing t) of an eigenvalue -decay + i swing and its conjugate.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SpectralMode {
    /// Damping rate, 1/s; negative for a growing mode.
    pub decay: f64,
    /// Oscillation frequency, rad/s.
    pub swing: f64,
}

impl SpectralMode {
    /// |lambda|, 1/s.
    pub fn rate(&self) -> f64 {
        self.decay.hypot(self.swing)
    }
}

impl fmt::Display for SpectralMode {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.decay, self.swing) {
            _ if self.rate() < tolerances::SLOWEST_MODE => write!(out, "neither swings nor decays"),
            (decay, swing) if swing > decay.abs() => write!(out, "swings at {} rad/s", two(swing)),
            (decay, _) if decay < 0.0 => write!(out, "grows at {} 1/s", two(-decay)),
            (decay, _) => write!(out, "decays at {} 1/s", two(decay)),
        }
    }
}

/// Modes of small perturbations of the motion with its coefficients frozen at one state:
///
/// ```text
/// Z^T M Z z'' + Z^T C Z z' + Z^T K Z z = 0,   G Z = 0
/// ```
///
/// with K and C at the v' and lambda of the state. At an equilibrium these are the modes; elsewhere they depend on the
/// coordinates, and tell the time scales but not the stability.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrum {
    /// The modes, from the slowest to the fastest.
    pub modes: Vec<SpectralMode>,
    /// True if there are too many coordinates for all modes: then only the fastest are known, approximately.
    pub is_estimate: bool,
}

impl Spectrum {
    /// Modes at a state with the v' and lambda of the equations. `None` without K and C, or where they are not finite.
    pub fn at(system: &dyn MechanicalSystem, state: OperatingPoint) -> Option<Self> {
        let mut frozen = Frozen::new(system, state)?;
        if system.dimensions().v > DENSE_EIGENVALUES {
            return Some(Spectrum { modes: frozen.fastest()?, is_estimate: true });
        }
        let z = free_directions(&mut frozen.dynamics)?;
        let [k, c] = frozen.reduced(&z);
        Some(Spectrum { modes: modes(&k, &c)?, is_estimate: false })
    }
}

/// The fastest mode alone, by an approximation that is cheap at any size; `None` as for [`Spectrum::at`].
pub fn fastest(system: &dyn MechanicalSystem, state: OperatingPoint) -> Option<SpectralMode> {
    Frozen::new(system, state)?.fastest()?.last().copied()
}

/// A rate that no mode exceeds, 1/s, from sums over rows of K, C and M alone; `None` as for [`Spectrum::at`], and where
/// M has no dominant diagonal.
pub fn bound(system: &dyn MechanicalSystem, state: OperatingPoint) -> Option<f64> {
    let structure = system.structure();
    let mut scratch = Scratch::default();
    let mut terms = Terms::new(system);
    let mut tangent = Tangent::new(&structure.tangent);
    system.evaluate(state.t, state.q, state.v, Need::MASS, &mut terms, &mut scratch);
    if !system.tangent(state, &mut tangent, &mut scratch) {
        return None;
    }
    rate_bound((&structure.mass, &terms.mass), (&structure.tangent, [&tangent.k, &tangent.c]))
}

type Matrix = nalgebra::DMatrix<f64>;

/// The equations of motion at a state, factored, with K and C.
struct Frozen<'a> {
    dynamics: Dynamics<'a>,
    tangent: Tangent,
    /// Row, column and value of the entries of K, and of C, that are not zero.
    stiffness: Vec<(usize, usize, f64)>,
    damping: Vec<(usize, usize, f64)>,
}

impl<'a> Frozen<'a> {
    fn new(system: &'a dyn MechanicalSystem, state: OperatingPoint) -> Option<Self> {
        let mut dynamics = Dynamics::new(system);
        dynamics.solve(state.t, state.q, state.v, |_, _| 0.0).ok()?;
        let tangent = Tangent::new(&dynamics.structure.tangent);
        let mut frozen = Frozen { dynamics, tangent, stiffness: Vec::new(), damping: Vec::new() };
        frozen.fill(state)?;
        Some(frozen)
    }

    fn fill(&mut self, state: OperatingPoint) -> Option<()> {
        let Frozen { dynamics, tangent, .. } = self;
        let known = dynamics.system.tangent(state, tangent, &mut dynamics.scratch);
        let places = &dynamics.structure.tangent.entries;
        [self.stiffness, self.damping] = [&tangent.k, &tangent.c].map(|values| {
            let entries = places.iter().zip(values).filter(|(_, value)| **value != 0.0);
            entries.map(|(&(i, j), &value)| (i, j, value)).collect()
        });
        (known && tangent.k.iter().chain(&tangent.c).all(|x| x.is_finite())).then_some(())
    }

    /// Z Z^T `force`: the accelerations due to a force alone.
    fn accelerate(&mut self, mut force: Vec<f64>) -> Option<Vec<f64>> {
        let mut rows = vec![0.0; self.dynamics.lambda.len()];
        self.dynamics.kkt.solve_motion(&mut force, &mut rows).ok()?;
        force.iter().all(|x| x.is_finite()).then_some(force)
    }

    /// Z^T K Z and Z^T C Z.
    fn reduced(&self, z: &Matrix) -> [Matrix; 2] {
        [&self.tangent.k, &self.tangent.c].map(|values| reduce(&self.dynamics.structure.tangent, values, z))
    }

    /// K x + C v, by the entries that are not zero.
    fn resistance(&self, x: &[f64], v: &[f64]) -> Vec<f64> {
        let mut sum = vec![0.0; v.len()];
        self.stiffness.iter().for_each(|&(i, j, k)| sum[i] += k * x[j]);
        self.damping.iter().for_each(|&(i, j, c)| sum[i] += c * v[j]);
        sum
    }

    /// The fastest modes, by power iteration of (x, v) -> (v, -Z Z^T (K x + C v)).
    fn fastest(&mut self) -> Option<Vec<SpectralMode>> {
        let n = self.dynamics.vdot.len();
        // An arbitrary vector with components in all directions and no symmetry.
        let mut x = self.accelerate((0..n).map(|i| (1.0 + i as f64).sqrt().fract() - 0.5).collect())?;
        let mut v = vec![0.0; n];
        for _ in 0..tolerances::POWER_ITERATIONS {
            let a = self.follow(&x, &v)?;
            let size = norm(&a) + norm(&v);
            if size == 0.0 {
                return Some(vec![SpectralMode { decay: 0.0, swing: 0.0 }]);
            }
            (x, v) = (v, a);
            x.iter_mut().chain(&mut v).for_each(|x| *x /= size);
        }
        let a = self.follow(&x, &v)?;
        let jerk = self.follow(&v, &a)?;
        // Positions are scaled to the size of velocities.
        let unit = ((norm(&v) + norm(&a)) / (norm(&x) + norm(&v))).max(f64::MIN_POSITIVE);
        let state = |x: &[f64], v: &[f64]| x.iter().map(|x| unit * x).chain(v.iter().copied()).collect::<Vec<f64>>();
        Some(fit(&state(&x, &v), &state(&v, &a), &state(&a, &jerk)))
    }

    /// x'' = -Z Z^T (K x + C x')
    fn follow(&mut self, x: &[f64], v: &[f64]) -> Option<Vec<f64>> {
        let force = self.resistance(x, v).iter().map(|x| -x).collect();
        self.accelerate(force)
    }
}

/// The roots of s^2 + p s + r with the least |y2 + p y1 + r y0|, the faster one last.
fn fit(y0: &[f64], y1: &[f64], y2: &[f64]) -> Vec<SpectralMode> {
    let [a, b, d] = [dot(y1, y1), dot(y1, y0), dot(y0, y0)];
    let [f, g] = [-dot(y1, y2), -dot(y0, y2)];
    let determinant = a * d - b * b;
    if determinant <= 1e-8 * a * d {
        return vec![SpectralMode { decay: if d > 0.0 { -b / d } else { 0.0 }, swing: 0.0 }];
    }
    let p = (f * d - b * g) / determinant;
    let r = (a * g - b * f) / determinant;
    let square = r - 0.25 * p * p;
    let root = square.abs().sqrt();
    if square > 0.0 {
        vec![SpectralMode { decay: 0.5 * p, swing: root }]
    } else {
        [-1.0, 1.0].each(|sign| SpectralMode { decay: 0.5 * p + sign * root.copysign(p), swing: 0.0 }).to_vec()
    }
}

/// Eigenvalues of [0 s; -K/s -C], with s the size of the frequencies, so that all entries have one unit.
fn modes(k: &Matrix, c: &Matrix) -> Option<Vec<SpectralMode>> {
    let n = k.nrows();
    let s = k.amax().sqrt();
    let s = if s > 0.0 { s } else { 1.0 };
    let companion = faer::Mat::from_fn(2 * n, 2 * n, |i, j| match (i < n, j < n) {
        (true, true) => 0.0,
        (true, false) => s * f64::from(u8::from(i == j - n)),
        (false, true) => -k[(i - n, j)] / s,
        (false, false) => -c[(i - n, j - n)],
    });
    faer::set_global_parallelism(faer::Par::Seq);
    let values = if n == 0 { Vec::new() } else { companion.eigenvalues().ok()? };
    let upper = values.iter().filter(|value| value.im >= 0.0);
    let mut modes: Vec<SpectralMode> = upper.map(|value| SpectralMode { decay: -value.re, swing: value.im }).collect();
    modes.sort_by(|a, b| a.rate().total_cmp(&b.rate()));
    Some(modes)
}
