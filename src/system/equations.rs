//! Own equations, written once over any scalar.

use super::{
    Column, Dimensions, Energy, LeviCivita, Loaded, MechanicalSystem, Need, OutputTangent, Scratch, Tangent, Terms,
};
use crate::math::{Dual, Scalar, Taylor};
use nalgebra::DMatrix;

/// A mechanism by its M, f and phi. G, phi', gamma and L follow by dual and Taylor numbers, so nothing is derived by
/// hand; the cost is about (6 + n)/6 evaluations of phi for G.
///
/// ```
/// use holonom::math::Scalar;
/// use holonom::system::Equations;
///
/// /// Pendulum of unit mass and length in Cartesian coordinates.
/// struct Pendulum;
///
/// impl Equations for Pendulum {
///     fn size(&self) -> (usize, usize) {
///         (2, 1)
///     }
///     fn mass<S: Scalar>(&self, _t: S, _q: &[S], mass: &mut [S]) {
///         mass.copy_from_slice(&[S::one(), S::zero(), S::zero(), S::one()]);
///     }
///     fn force<S: Scalar>(&self, _t: S, _q: &[S], _v: &[S], f: &mut [S]) {
///         f.copy_from_slice(&[S::zero(), S::constant(-9.81)]);
///     }
///     fn phi<S: Scalar>(&self, _t: S, q: &[S], phi: &mut [S]) {
///         phi[0] = (q[0].square() + q[1].square() - 1.0) * 0.5;
///     }
/// }
/// ```
pub trait Equations: Send + Sync + 'static {
    /// (n, n_c): coordinates, which are also the velocities, and constraints.
    fn size(&self) -> (usize, usize);
    /// M, n x n, row by row.
    fn mass<S: Scalar>(&self, t: S, q: &[S], mass: &mut [S]);
    /// f, n: all forces but the reactions, velocity-dependent inertia forces included.
    fn force<S: Scalar>(&self, t: S, q: &[S], v: &[S], f: &mut [S]);
    /// phi, n_c.
    fn phi<S: Scalar>(&self, t: S, q: &[S], phi: &mut [S]);
    /// Potential energy, J, of forces that have one; with it the energy is watched.
    fn potential(&self, _t: f64, _q: &[f64]) -> Option<f64> {
        None
    }
    /// Names of the outputs. Default: none.
    fn output_names(&self) -> Vec<String> {
        Vec::new()
    }
    /// The outputs, one a name.
    fn outputs<S: Scalar>(&self, _t: S, _q: &[S], _v: &[S], _out: &mut [S]) {}
    /// Names of the inputs, which change the forces. Default: none.
    fn input_names(&self) -> Vec<String> {
        Vec::new()
    }
    /// df/du, n x n_u, row by row; zero on entry.
    fn input_forces<S: Scalar>(&self, _t: S, _q: &[S], _forces: &mut [S]) {}
}

type Slope = Dual<f64, 6>;
type Along = Dual<Taylor<f64>, 6>;
type Twice = Dual<Slope, 6>;

struct Memory {
    mass: Vec<f64>,
    path: Vec<Taylor<f64>>,
    levels: Vec<Taylor<f64>>,
    seeded: Vec<Slope>,
    slopes: Vec<Slope>,
    moving: Vec<Along>,
    curvatures: Vec<Along>,
    /// For K and C, from their first use.
    varied: Option<Varied>,
}

/// The equations as functions of six directions.
struct Varied {
    q: Vec<Slope>,
    v: Vec<Slope>,
    f: Vec<Slope>,
    mass: Vec<Slope>,
    reaction: Vec<Slope>,
    nested: Vec<Twice>,
    phi: Vec<Twice>,
}

impl Varied {
    fn new(n: usize, m: usize) -> Self {
        let zeros = |n: usize| vec![Dual::fixed(0.0); n];
        let nested = |n: usize| vec![Dual::fixed(Dual::fixed(0.0)); n];
        Varied {
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

impl Memory {
    fn new(n: usize, m: usize) -> Self {
        let zero = Taylor::fixed(0.0);
        Memory {
            mass: vec![0.0; n * n],
            path: vec![zero; n],
            levels: vec![zero; m],
            seeded: vec![Dual::fixed(0.0); n],
            slopes: vec![Dual::fixed(0.0); m],
            moving: vec![Dual::fixed(zero); n],
            curvatures: vec![Dual::fixed(zero); m],
            varied: None,
        }
    }
}

impl<E: Equations> MechanicalSystem for E {
    fn dimensions(&self) -> Dimensions {
        let (n, m) = self.size();
        Dimensions { q: n, v: n, lambda: m }
    }

    fn evaluate(&self, t: f64, q: &[f64], v: &[f64], need: Need, terms: &mut Terms, scratch: &mut Scratch) {
        let (n, m) = self.size();
        let fill = |memory: &mut Memory| {
            if need.includes(Need::MASS) {
                self.mass(t, q, &mut memory.mass);
                let lower = (0..n).flat_map(|i| (0..=i).map(move |j| i * n + j));
                terms.mass.iter_mut().zip(lower).for_each(|(entry, place)| *entry = memory.mass[place]);
            }
            if need.includes(Need::FORCE) {
                self.force(t, q, v, &mut terms.f);
                terms.power = 0.0;
            }
            if need.includes(Need::CONSTRAINTS) {
                levels(self, t, q, v, memory, terms);
            }
            if need.includes(Need::G) {
                gradient(self, t, q, memory, terms);
            }
            if need.includes(Need::L) {
                let at = Loaded { t, q, v, vdot: &[], lambda: &[] };
                curvature(self, at, memory, |place, slope| terms.l[place] = slope.d);
            }
        };
        scratch.with(|| Memory::new(n, m), fill);
    }

    fn tangent(&self, at: Loaded, tangent: &mut Tangent, scratch: &mut Scratch) -> bool {
        let (n, m) = self.size();
        scratch.with(
            || Memory::new(n, m),
            |memory| tangent_of(self, at, memory.varied.get_or_insert_with(|| Varied::new(n, m)), tangent),
        );
        true
    }

    fn acceleration_gradient(&self, at: Loaded, values: &mut [f64], scratch: &mut Scratch) -> bool {
        let (n, m) = self.size();
        scratch.with(
            || Memory::new(n, m),
            |memory| curvature(self, at, memory, |place, slope| values[place] = slope.dd),
        );
        true
    }

    fn levi_civita(&self, at: Loaded, connection: &mut LeviCivita, _scratch: &mut Scratch) -> bool {
        christoffel(self, at, connection);
        true
    }

    fn energy(&self, t: f64, q: &[f64], v: &[f64], scratch: &mut Scratch) -> Option<Energy> {
        let potential = self.potential(t, q)?;
        let (n, m) = self.size();
        let kinetic = |memory: &mut Memory| {
            self.mass(t, q, &mut memory.mass);
            let row = |i: usize| memory.mass[i * n..(i + 1) * n].iter().zip(v).map(|(m, v)| m * v).sum::<f64>();
            0.5 * (0..n).map(|i| v[i] * row(i)).sum::<f64>()
        };
        Some(Energy { kinetic: scratch.with(|| Memory::new(n, m), kinetic), potential })
    }

    fn columns(&self) -> Vec<Column> {
        named(self.output_names())
    }

    fn outputs(&self, t: f64, q: &[f64], v: &[f64], _lambda: &[f64], out: &mut [f64], _scratch: &mut Scratch) {
        Equations::outputs(self, t, q, v, out);
    }

    fn output_tangent(&self, at: Loaded, tangent: &mut OutputTangent, _scratch: &mut Scratch) -> bool {
        tangent.clear();
        let (t, q, v) = (Dual::fixed(at.t), fixed(at.q), fixed(at.v));
        output_slopes(at.q, |q, out| Equations::outputs(self, t, q, &v, out), &mut tangent.q);
        output_slopes(at.v, |v, out| Equations::outputs(self, t, &q, v, out), &mut tangent.v);
        true
    }

    fn inputs(&self) -> Vec<Column> {
        named(self.input_names())
    }

    fn input_forces(&self, t: f64, q: &[f64], _v: &[f64], f: &mut DMatrix<f64>, _scratch: &mut Scratch) {
        let mut forces = vec![0.0; f.len()];
        Equations::input_forces(self, t, q, &mut forces);
        f.copy_from(&DMatrix::from_row_slice(f.nrows(), f.ncols(), &forces));
    }
}

fn named(names: Vec<String>) -> Vec<Column> {
    names.into_iter().map(|name| Column { name, unit: String::new(), periodic: false }).collect()
}

fn fixed(values: &[f64]) -> Vec<Slope> {
    values.iter().map(|&x| Dual::fixed(x)).collect()
}

/// d(outputs)/dx, six columns a pass.
fn output_slopes(x: &[f64], outputs: impl Fn(&[Slope], &mut [Slope]), matrix: &mut DMatrix<f64>) {
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

/// phi, phi' and -gamma along q + v s; phi_t with q held.
fn levels<E: Equations>(system: &E, t: f64, q: &[f64], v: &[f64], memory: &mut Memory, terms: &mut Terms) {
    for (i, place) in memory.path.iter_mut().enumerate() {
        *place = Taylor::new(q[i], 0.0, 0.0);
    }
    system.phi(Taylor::time(t), &memory.path, &mut memory.levels);
    terms.phi_t.iter_mut().zip(&memory.levels).for_each(|(phi_t, level)| *phi_t = level.d);
    for (i, place) in memory.path.iter_mut().enumerate() {
        *place = Taylor::new(q[i], v[i], 0.0);
    }
    system.phi(Taylor::time(t), &memory.path, &mut memory.levels);
    for (i, level) in memory.levels.iter().enumerate() {
        (terms.phi[i], terms.phi_dot[i], terms.gamma[i]) = (level.x, level.d, -level.dd);
    }
}

/// G, six columns a pass.
fn gradient<E: Equations>(system: &E, t: f64, q: &[f64], memory: &mut Memory, terms: &mut Terms) {
    let n = q.len();
    for first in (0..n).step_by(6) {
        let columns = first..n.min(first + 6);
        memory.seeded.iter_mut().zip(q).for_each(|(place, &q)| *place = Dual::fixed(q));
        columns.clone().for_each(|i| memory.seeded[i] = Dual::seeded(q[i], i - first));
        system.phi(Dual::fixed(t), &memory.seeded, &mut memory.slopes);
        for (row, slope) in memory.slopes.iter().enumerate() {
            columns.clone().for_each(|i| terms.g[row * n + i] = slope.eps[i - first]);
        }
    }
}

/// d(phi, phi', phi'')/dq, six columns a pass; with v' = 0 where it is empty.
fn curvature<E: Equations>(system: &E, at: Loaded, memory: &mut Memory, mut write: impl FnMut(usize, Taylor<f64>)) {
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

/// K by nested dual numbers, C by dual numbers, six columns a pass.
fn tangent_of<E: Equations>(system: &E, at: Loaded, varied: &mut Varied, tangent: &mut Tangent) {
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

fn lift(from: &[f64], to: &mut [Slope]) {
    to.iter_mut().zip(from).for_each(|(to, &x)| *to = Dual::fixed(x));
}

/// G^T lambda over dual numbers: the gradient of lambda . phi.
fn reaction<E: Equations>(system: &E, at: Loaded, varied: &mut Varied) {
    let n = at.q.len();
    let Varied { q, reaction, nested, phi, .. } = varied;
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

/// A number with its rate along the motion, as a function of six coordinates.
type Rated = Dual<Dual<f64, 1>, 6>;

/// W by its definition out of dM/dq with rates along the motion, six columns a pass.
fn christoffel<E: Equations>(system: &E, at: Loaded, connection: &mut LeviCivita) {
    let n = at.q.len();
    let rated = |value: f64, rate: f64| Dual { re: value, eps: [rate] };
    let mut q: Vec<Rated> = at.q.iter().zip(at.v).map(|(&q, &v)| Dual::fixed(rated(q, v))).collect();
    let v: Vec<Dual<f64, 1>> = at.v.iter().zip(at.vdot).map(|(&v, &vdot)| rated(v, vdot)).collect();
    let mut mass = vec![Dual::fixed(rated(0.0, 0.0)); n * n];
    let mut w = vec![rated(0.0, 0.0); n * n];
    for first in (0..n).step_by(6) {
        let columns = first..n.min(first + 6);
        columns.clone().for_each(|j| q[j].eps[j - first] = rated(1.0, 0.0));
        system.mass(Dual::fixed(rated(at.t, 1.0)), &q, &mut mass);
        columns.clone().for_each(|j| q[j].eps[j - first] = rated(0.0, 0.0));
        for j in columns {
            for i in 0..n {
                // d_j M_ik v^k goes to W_ij and, as the last term, with the other sign to W_ji.
                for k in 0..n {
                    let slope = mass[i * n + k].eps[j - first];
                    let push = slope * v[k] * 0.5;
                    w[i * n + j] += push;
                    w[j * n + i] -= push;
                    w[i * n + k] += slope * v[j] * 0.5;
                }
            }
        }
    }
    connection.mass_dot.iter_mut().enumerate().for_each(|(at, rate)| *rate = mass[at % n * n + at / n].re.eps[0]);
    for i in 0..n {
        for j in 0..n {
            (connection.w[(i, j)], connection.w_dot[(i, j)]) = (w[i * n + j].re, w[i * n + j].eps[0]);
        }
    }
}
