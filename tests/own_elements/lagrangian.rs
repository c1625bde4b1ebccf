//! Equations from energies against the same mechanisms with M and f by hand, and what own equations are refused for.

use super::equations::methods;
use crate::common::equations::pendulum::{GRAVITY, Pendulum, START};
use crate::common::{adaptive, distance, fixed, run, until};
use crate::examples::own_lagrangian::DoublePendulum;
use holonom::Result;
use holonom::initial::assemble;
use holonom::linearize::Variation;
use holonom::math::Scalar;
use holonom::simulate::{Method, simulate, simulate_automatic};
use holonom::system::{
    Equations, Lagrangian, LeviCivita, MechanicalSystem, Need, OperatingPoint, Scratch, Tangent, Terms,
};

const DOUBLE: DoublePendulum = DoublePendulum { masses: [1.3, 0.7], lengths: [0.9, 1.4] };

/// [`DOUBLE`] by hand.
struct ByHand;

impl Equations for ByHand {
    fn size(&self) -> (usize, usize) {
        (2, 0)
    }
    fn mass<S: Scalar>(&self, _: S, q: &[S], mass: &mut [S]) {
        let DoublePendulum { masses: [m, n], lengths: [a, b] } = DOUBLE;
        let coupling = (q[0] - q[1]).cos() * (n * a * b);
        mass.copy_from_slice(&[S::constant((m + n) * a * a), coupling, coupling, S::constant(n * b * b)]);
    }
    fn force<S: Scalar>(&self, _: S, q: &[S], v: &[S], f: &mut [S]) {
        let DoublePendulum { masses: [m, n], lengths: [a, b] } = DOUBLE;
        let coupling = (q[0] - q[1]).sin() * (n * a * b);
        f[0] = -coupling * v[1].square() - q[0].sin() * ((m + n) * a * 9.81);
        f[1] = coupling * v[0].square() - q[1].sin() * (n * b * 9.81);
    }
    fn phi<S: Scalar>(&self, _: S, _: &[S], _: &mut [S]) {}
}

/// [`Pendulum`] by its energies.
struct Rod;

impl Lagrangian for Rod {
    fn size(&self) -> (usize, usize) {
        (2, 1)
    }
    fn kinetic<S: Scalar>(&self, _: S, _: &[S], v: &[S]) -> S {
        (v[0].square() + v[1].square()) * 0.5
    }
    fn potential<S: Scalar>(&self, _: S, q: &[S]) -> S {
        q[1] * GRAVITY
    }
    fn phi<S: Scalar>(&self, t: S, q: &[S], phi: &mut [S]) {
        Equations::phi(&Pendulum, t, q, phi);
    }
}

/// `N` particles in a row with masses that depend on all coordinates and on time, so that every term of f is there.
struct Row<const N: usize>;

impl<const N: usize> Row<N> {
    fn weight<S: Scalar>(t: S, q: &[S], i: usize, j: usize) -> S {
        let diagonal = if i == j { N as f64 + 1.0 } else { 0.0 };
        (q[i] * q[j] + t).sin() * 0.5 + diagonal
    }
}

impl<const N: usize> Lagrangian for Row<N> {
    fn size(&self) -> (usize, usize) {
        (N, 0)
    }
    fn kinetic<S: Scalar>(&self, t: S, q: &[S], v: &[S]) -> S {
        let mut energy = (q[0] * t).cos();
        for i in 0..N {
            energy += v[i] * (q[i] * t).sin();
            (0..N).for_each(|j| energy += Self::weight(t, q, i, j) * v[i] * v[j] * 0.5);
        }
        energy
    }
    fn potential<S: Scalar>(&self, t: S, q: &[S]) -> S {
        q.iter().fold(S::zero(), |sum, q| sum + (*q + t).square() * 2.0)
    }
    fn force<S: Scalar>(&self, _: S, _: &[S], v: &[S], f: &mut [S]) {
        f.iter_mut().zip(v).for_each(|(f, v)| *f = *v * -0.3);
    }
}

fn terms(system: &dyn MechanicalSystem, t: f64, q: &[f64], v: &[f64]) -> Terms {
    let mut terms = Terms::new(system);
    system.evaluate(t, q, v, Need::DYNAMICS, &mut terms, &mut Scratch::default());
    terms
}

/// Sums of a few products of size ten.
#[track_caller]
fn same(found: &[f64], expected: &[f64]) {
    assert!(found.len() == expected.len() && distance(found, expected) < 1e-12, "{found:?}\n{expected:?}");
}

fn check_terms(system: &dyn MechanicalSystem, by_hand: &dyn MechanicalSystem, q: &[f64], v: &[f64]) {
    let [found, expected] = [system, by_hand].map(|system| terms(system, 0.3, q, v));
    same(&found.mass, &expected.mass);
    same(&found.f, &expected.f);
    same(&found.g, &expected.g);
    same(&found.gamma, &expected.gamma);
    let lambda = vec![0.7; found.gamma.len()];
    let at = OperatingPoint { t: 0.3, q, v, vdot: &[0.4, -0.9], lambda: &lambda };
    let [found, expected] = [system, by_hand].map(|system| {
        let mut tangent = Tangent::new(&system.structure().tangent);
        let mut connection = LeviCivita::new(2);
        assert!(system.tangent(at, &mut tangent, &mut Scratch::default()));
        assert!(system.levi_civita(at, &mut connection, &mut Scratch::default()));
        let LeviCivita { w, w_dot, mass_dot } = connection;
        [&tangent.k[..], &tangent.c, w.as_slice(), w_dot.as_slice(), mass_dot.as_slice()].concat()
    });
    same(&found, &expected);
}

#[test]
fn terms_and_their_derivatives_are_those_by_hand() {
    for (q, v) in [([0.4, -1.1], [2.0, -3.0]), ([3.0, 0.2], [-0.5, 1.5])] {
        check_terms(&DOUBLE, &ByHand, &q, &v);
        check_terms(&Rod, &Pendulum, &q, &v);
    }
}

/// f by its formula, with the derivatives of M, b and c by hand; ten coordinates take two passes and the heap.
fn check_row<const N: usize>() {
    let t = 0.4;
    let q: [f64; N] = std::array::from_fn(|i| 0.3 - 0.07 * i as f64);
    let v: [f64; N] = std::array::from_fn(|i| 0.2 * i as f64 - 0.5);
    let found = terms(&Row::<N>, t, &q, &v);
    let weights = |i: usize, j: usize| Row::<N>::weight(t, &q, i, j);
    same(&found.mass, &(0..N).flat_map(|i| (0..=i).map(move |j| weights(i, j))).collect::<Vec<_>>());
    let mut power = 0.0;
    for k in 0..N {
        let slope = |i: usize, j: usize| 0.5 * (q[i] * q[j] + t).cos();
        // (d M/dt v)_k with the rate of q_k q_j, and d(v^T M v/2)/dq_k.
        let rate = (0..N).map(|j| slope(k, j) * (v[k] * q[j] + q[k] * v[j] + 1.0) * v[j]).sum::<f64>();
        let push = (0..N).map(|j| slope(k, j) * q[j] * v[j] * v[k]).sum::<f64>();
        // db_k/dt = cos(q_k t) (v_k t + q_k), d(b v)/dq_k = cos(q_k t) t v_k
        let linear = (q[k] * t).cos() * q[k];
        let constant = if k == 0 { -t * (q[0] * t).sin() } else { 0.0 };
        let expected = -0.3 * v[k] - rate + push - linear + constant - 4.0 * (q[k] + t);
        assert!((found.f[k] - expected).abs() < 1e-12, "{k}: {} {expected}", found.f[k]);
        let inertia = (0..N).map(|j| slope(k, j) * v[k] * v[j] * 0.5).sum::<f64>();
        power += -0.3 * v[k] * v[k] - inertia - linear * v[k] + 4.0 * (q[k] + t);
    }
    // - dT0/dt at fixed q, and T0' along the motion: what is left of both is dT0/dq v.
    power += -t * (q[0] * t).sin() * v[0];
    assert!((found.power - power).abs() < 1e-12, "{} {power}", found.power);
}

#[test]
fn every_term_of_a_moving_frame_is_there() {
    check_row::<1>();
    check_row::<3>();
    check_row::<10>();
}

#[test]
fn every_formulation_moves_a_rod_as_the_equations_by_hand() {
    for method in methods() {
        let [found, expected] = [&Rod as &dyn MechanicalSystem, &Pendulum].map(|system| {
            let method = Method { step: Some(1e-2), ..method.clone() };
            run(system, &method, until(0.5), START.motion()).completed().record.trajectory.rows
        });
        let off = found.iter().zip(&expected).map(|(a, b)| distance(a, b)).fold(0.0, f64::max);
        assert!(off < 1e-12, "{}: {off:e}", method.triple());
    }
}

/// Dampers, motors and moving frames take part in the balance: 1e-10 is the tolerance, over a motion that loses all.
#[test]
fn the_energy_balance_counts_forces_without_a_potential() {
    let run = run(&Row::<2>, &adaptive("index1", "dop853", "none", 1e-11), until(3.0), (&[0.5, -0.2], &[1.0, 0.3]));
    let energy = run.completed().record.energy.expect("there is a potential");
    assert!(energy.work.abs() > 0.1 && energy.max_error < 1e-9, "{energy:?}");
}

/// Own equations with a mistake.
enum Mistaken {
    Triangle,
    Ground,
}

impl Equations for Mistaken {
    fn size(&self) -> (usize, usize) {
        (2, 0)
    }
    fn mass<S: Scalar>(&self, _: S, _: &[S], mass: &mut [S]) {
        let upper = if matches!(self, Mistaken::Triangle) { 0.0 } else { 0.5 };
        mass.copy_from_slice(&[1.0, upper, 0.5, 2.0].map(S::constant));
    }
    fn force<S: Scalar>(&self, _: S, q: &[S], _: &[S], f: &mut [S]) {
        f.iter_mut().zip(q).for_each(|(f, q)| *f = -*q);
    }
    fn phi<S: Scalar>(&self, _: S, _: &[S], _: &mut [S]) {}
    fn check(&self, _: f64, q: &[f64], _: &[f64]) -> Result<()> {
        if q[0] < 0.0 { Err(holonom::Error::input("q1 is below the ground")) } else { Ok(()) }
    }
}

/// Relativity is not for mechanisms of this kind.
struct Cubic;

impl Lagrangian for Cubic {
    fn size(&self) -> (usize, usize) {
        (2, 0)
    }
    fn kinetic<S: Scalar>(&self, _: S, _: &[S], v: &[S]) -> S {
        v[0].square() + v[1].square() + v[1].powi(3) * 1e-3
    }
}

/// By all ways into the library.
fn refusals(system: &dyn MechanicalSystem, q: &[f64], v: &[f64]) -> [String; 5] {
    let start = (q, v);
    let method = fixed("index1", "rk4", "none", 0.1);
    [
        simulate(system, &method, until(1.0), start, &mut ()).map(|_| ()),
        simulate_automatic(system, (1e-6, 1e-6), until(1.0), start, &mut ()).map(|_| ()),
        assemble(system, 0.0, start, &[]).map(|_| ()),
        holonom::initial::equilibrium(system, 0.0, start).map(|_| ()),
        Variation::new(system, 0.0, q, v).map(|_| ()),
    ]
    .map(|result| result.unwrap_err().to_string())
}

#[track_caller]
fn refused(system: &dyn MechanicalSystem, q: &[f64], v: &[f64], expected: &str) {
    for found in refusals(system, q, v) {
        assert!(found.contains(expected), "{found}");
    }
}

#[test]
fn a_start_with_too_many_numbers_is_refused() {
    let many = "the start has 3 coordinates, the system has 2\n  help: give 2 numbers, in the order of the system's coordinates";
    refused(&DOUBLE, &[0.0; 3], &[0.0; 2], many);
    refused(&Pendulum, &[1.0, 0.0], &[0.0], "the start has 1 velocities, the system has 2");
}

#[test]
fn a_mass_matrix_that_is_not_symmetric_is_refused() {
    let expected = "the mass matrix is not symmetric: 0.5 in row 2, column 1, but 0 in row 1, column 2\n  help: ";
    refused(&Mistaken::Triangle, &[0.0; 2], &[0.0; 2], expected);
    refused(&Mistaken::Ground, &[-1.0, 0.0], &[0.0; 2], "q1 is below the ground");
}

#[test]
fn a_kinetic_energy_that_is_not_quadratic_is_refused() {
    let expected = "the kinetic energy is not quadratic in the velocities: its degree in v2 is higher";
    refused(&Cubic, &[0.0; 2], &[0.0; 2], expected);
}

#[test]
fn assembly_holds_coordinates_by_their_names() {
    let hold = |name: &str| assemble(&Pendulum, 0.0, (&[0.9, 0.1], &[0.0; 2]), &[name.to_string()]);
    let held = |found: f64, given: f64| assert!((found - given).abs() < 1e-14, "{found}");
    held(hold("q1").unwrap().q[0], 0.9);
    held(hold("v2").unwrap().q[1], 0.1);
    let error = hold("q3").unwrap_err().to_string();
    assert!(error.contains("there is no coordinate `q3`\n  help: did you mean `q1`?"), "{error}");
}
