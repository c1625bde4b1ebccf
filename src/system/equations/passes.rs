//! Derivatives of a user's equations by dual and Taylor numbers, some directions per pass.

use super::Equations;
use super::jet::Jet;
use crate::math::{Dual, Taylor};
use crate::system::{Need, OperatingPoint, Tangent, Terms};
use nalgebra::DMatrix;

type Dual6 = Dual<f64, 6>;
type TaylorDual6 = Dual<Taylor<f64>, 6>;
type Twice = Dual<Dual6, 6>;

/// Columns of G of one pass over phi with that of time: in systems of up to three coordinates, and in larger ones.
const FEW: usize = 4;
const MANY: usize = 8;

pub(super) struct EquationsMemory {
    pub mass: Vec<f64>,
    /// df/du; empty until needed.
    pub driven: Vec<f64>,
    few: Jets<FEW>,
    many: Jets<MANY>,
    moving: Vec<TaylorDual6>,
    curvatures: Vec<TaylorDual6>,
    /// Memory for K and C, made at their first use.
    pub varied: Option<SeededEquations>,
}

/// q and phi over numbers with W directions.
struct Jets<const W: usize> {
    q: Vec<Jet<W>>,
    phi: Vec<Jet<W>>,
}

impl<const W: usize> Jets<W> {
    fn new(n: usize, m: usize) -> Self {
        let zeros = |n: usize| vec![Jet::fixed(Taylor::fixed(0.0)); n];
        Jets { q: zeros(n), phi: zeros(m) }
    }
}

/// The equations over dual numbers of six directions.
pub(super) struct SeededEquations {
    q: Vec<Dual6>,
    v: Vec<Dual6>,
    f: Vec<Dual6>,
    mass: Vec<Dual6>,
    reaction: Vec<Dual6>,
    nested: Vec<Twice>,
    phi: Vec<Twice>,
}

impl SeededEquations {
    pub fn new(n: usize, m: usize) -> Self {
        let zeros = |n: usize| vec![Dual::fixed(0.0); n];
        let nested = |n: usize| vec![Dual::fixed(Dual::fixed(0.0)); n];
        SeededEquations {
            q: zeros(n),
            v: zeros(n),
            f: zeros(n),
            mass: zeros(n * n),
            reaction: zeros(n),
            nested: nested(n),
            phi: nested(m),
        }
    }
}

impl EquationsMemory {
    pub fn of(equations: &impl Equations) -> Self {
        let (n, m) = equations.size();
        let zero = Taylor::fixed(0.0);
        EquationsMemory {
            mass: vec![0.0; n * n],
            driven: Vec::new(),
            few: Jets::new(n, m),
            many: Jets::new(n, m),
            moving: vec![Dual::fixed(zero); n],
            curvatures: vec![Dual::fixed(zero); m],
            varied: None,
        }
    }
}

/// Writes the terms `need`. Slices have the lengths of [`Equations::size`], which the compiler knows where these are
/// constants.
#[inline]
pub(super) fn write_terms<E: Equations>(
    system: &E,
    at: OperatingPoint,
    need: Need,
    inputs: &[f64],
    memory: &mut EquationsMemory,
    terms: &mut Terms,
) {
    let (n, m) = system.size();
    let t = at.t;
    let q = &at.q[..n];
    let v = &at.v[..n];
    if need.includes(Need::MASS) {
        let mass = &mut memory.mass[..n * n];
        system.mass(t, q, mass);
        let lower = &mut terms.mass[..n * (n + 1) / 2];
        for i in 0..n {
            let first = i * (i + 1) / 2;
            lower[first..=first + i].copy_from_slice(&mass[i * n..=i * n + i]);
        }
    }
    if need.includes(Need::FORCE) {
        system.force(t, q, v, &mut terms.f[..n]);
        terms.power = system.power(t, q, v);
        if !inputs.is_empty() {
            add_inputs(system, t, q, v, inputs, &mut memory.driven, terms);
        }
    }
    if m > 0 && (need.includes(Need::CONSTRAINTS) || need.includes(Need::G)) {
        constraints(system, t, q, v, need, memory, terms);
    }
    if need.includes(Need::L) {
        curvature(system, at, memory, |place, slope| terms.l[place] = slope.d);
    }
}

/// f += (df/du) u, whose power is that of forces without a potential.
fn add_inputs(
    equations: &impl Equations,
    t: f64,
    q: &[f64],
    v: &[f64],
    inputs: &[f64],
    driven: &mut Vec<f64>,
    terms: &mut Terms,
) {
    driven.clear();
    driven.resize(v.len() * inputs.len(), 0.0);
    equations.input_forces(t, q, driven);
    for ((row, f), v) in driven.chunks_exact(inputs.len()).zip(&mut terms.f).zip(v) {
        let force: f64 = row.iter().zip(inputs).map(|(slope, u)| slope * u).sum();
        *f += force;
        terms.power += force * v;
    }
}

pub(super) fn fixed(values: &[f64]) -> Vec<Dual6> {
    values.iter().map(|&x| Dual::fixed(x)).collect()
}

/// d(outputs)/dx, six columns per pass.
pub(super) fn output_slopes(x: &[f64], outputs: impl Fn(&[Dual6], &mut [Dual6]), matrix: &mut DMatrix<f64>) {
    let mut values = vec![Dual::fixed(0.0); matrix.nrows()];
    for first in (0..x.len()).step_by(6) {
        let columns = first..x.len().min(first + 6);
        let mut seeded = fixed(x);
        columns.clone().for_each(|j| seeded[j] = Dual::seeded(x[j], j - first));
        outputs(&seeded, &mut values);
        for (row, value) in values.iter().enumerate() {
            columns.clone().for_each(|j| matrix[(row, j)] = value.eps[j - first]);
        }
    }
}

/// phi, phi', gamma and phi_t, and G, of which those that are needed: along q + v s with t + s, and along each
/// coordinate and, last, time alone, as many per pass as a number has directions.
#[inline]
fn constraints<E: Equations>(
    system: &E,
    t: f64,
    q: &[f64],
    v: &[f64],
    need: Need,
    memory: &mut EquationsMemory,
    terms: &mut Terms,
) {
    if system.size().0 < FEW {
        pass(system, t, q, v, need, &mut memory.few, terms);
    } else {
        pass(system, t, q, v, need, &mut memory.many, terms);
    }
}

fn pass<E: Equations, const W: usize>(
    system: &E,
    t: f64,
    q: &[f64],
    v: &[f64],
    need: Need,
    jets: &mut Jets<W>,
    terms: &mut Terms,
) {
    let (n, m) = system.size();
    let rows = &mut jets.phi[..m];
    let jets = &mut jets.q[..n];
    for pass in 0..=n / W {
        let first = pass * W;
        let columns = first..n.min(first + W);
        for ((jet, &q), &v) in jets.iter_mut().zip(&q[..n]).zip(&v[..n]) {
            *jet = Jet::fixed(Taylor::new(q, v, 0.0));
        }
        jets[columns.clone()].iter_mut().enumerate().for_each(|(k, jet)| jet.slope[k] = 1.0);
        let mut time = Jet::fixed(Taylor::time(t));
        let place_of_time = (n < first + W).then_some(n - first);
        place_of_time.into_iter().for_each(|k| time.slope[k] = 1.0);
        system.phi(time, jets, rows);
        if need.includes(Need::CONSTRAINTS) {
            for (i, row) in rows.iter().enumerate() {
                (terms.phi[i], terms.phi_dot[i], terms.gamma[i]) = (row.path.x, row.path.d, -row.path.dd);
                place_of_time.into_iter().for_each(|k| terms.phi_t[i] = row.slope[k]);
            }
        }
        if need.includes(Need::G) {
            for (i, row) in rows.iter().enumerate() {
                let g = &mut terms.g[i * n..][columns.clone()];
                g.iter_mut().zip(&row.slope).for_each(|(g, slope)| *g = *slope);
            }
        }
    }
}

/// d(phi, phi', phi'')/dq, six columns per pass; at v' = 0 where `at.vdot` is empty.
pub(super) fn curvature<E: Equations>(
    system: &E,
    at: OperatingPoint,
    memory: &mut EquationsMemory,
    mut write: impl FnMut(usize, Taylor<f64>),
) {
    let n = at.q.len();
    for first in (0..n).step_by(6) {
        let columns = first..n.min(first + 6);
        for (i, place) in memory.moving.iter_mut().enumerate() {
            *place = Dual::fixed(Taylor::new(at.q[i], at.v[i], at.vdot.get(i).copied().unwrap_or(0.0)));
        }
        columns.clone().for_each(|i| memory.moving[i].eps[i - first] = Taylor::fixed(1.0));
        system.phi(Dual::fixed(Taylor::time(at.t)), &memory.moving, &mut memory.curvatures);
        for (row, slope) in memory.curvatures.iter().enumerate() {
            columns.clone().for_each(|i| write(row * n + i, slope.eps[i - first]));
        }
    }
}

/// K by nested dual numbers, C by dual numbers, six columns per pass.
pub(super) fn tangent_of<E: Equations>(
    system: &E,
    at: OperatingPoint,
    varied: &mut SeededEquations,
    tangent: &mut Tangent,
) {
    let n = at.q.len();
    let t = Dual::fixed(at.t);
    for first in (0..n).step_by(6) {
        let columns = first..n.min(first + 6);
        lift(at.q, &mut varied.q);
        lift(at.v, &mut varied.v);
        columns.clone().for_each(|j| varied.v[j] = Dual::seeded(at.v[j], j - first));
        system.force(t, &varied.q, &varied.v, &mut varied.f);
        for (i, f) in varied.f.iter().enumerate() {
            columns.clone().for_each(|j| tangent.c[i * n + j] = -f.eps[j - first]);
        }
        columns.clone().for_each(|j| varied.q[j] = Dual::seeded(at.q[j], j - first));
        lift(at.v, &mut varied.v);
        system.force(t, &varied.q, &varied.v, &mut varied.f);
        system.mass(t, &varied.q, &mut varied.mass);
        reaction(system, at, varied);
        for i in 0..n {
            let mut row = varied.reaction[i] - varied.f[i];
            (0..n).for_each(|j| row += varied.mass[i * n + j] * at.vdot[j]);
            columns.clone().for_each(|j| tangent.k[i * n + j] = row.eps[j - first]);
        }
    }
}

fn lift(from: &[f64], to: &mut [Dual6]) {
    to.iter_mut().zip(from).for_each(|(to, &x)| *to = Dual::fixed(x));
}

/// G^T lambda over dual numbers: the gradient of lambda . phi.
fn reaction<E: Equations>(system: &E, at: OperatingPoint, varied: &mut SeededEquations) {
    let n = at.q.len();
    let SeededEquations { q, reaction, nested, phi, .. } = varied;
    reaction.fill(Dual::fixed(0.0));
    for first in (0..n).step_by(6) {
        let columns = first..n.min(first + 6);
        nested.iter_mut().zip(&*q).for_each(|(nested, &q)| *nested = Dual::fixed(q));
        columns.clone().for_each(|i| nested[i] = Dual::seeded(q[i], i - first));
        system.phi(Dual::fixed(Dual::fixed(at.t)), nested, phi);
        for (phi, &lambda) in phi.iter().zip(at.lambda) {
            columns.clone().for_each(|i| reaction[i] += phi.eps[i - first] * lambda);
        }
    }
}
