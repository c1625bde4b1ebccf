//! Formulations against each other at single states, and what tells them apart.

use crate::common::driven_pendulum::{DrivenPendulum, start};
use crate::common::{distance, fixed, run, until};
use crate::scenes::shipped;
use holonom::formulation::{Dynamics, make};
use holonom::initial::assemble;
use holonom::math::Scalar;
use holonom::method_spec::MethodSpec;
use holonom::simulate::{Method, Span};
use holonom::system::{Equations, MechanicalSystem};

/// v' and lambda of `formulation` at a state.
fn solve(system: &dyn MechanicalSystem, formulation: &str, t: f64, q: &[f64], v: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let mut dynamics = Dynamics::new(system);
    let mut formulation = make(&MethodSpec::parse(formulation).unwrap(), system).unwrap();
    let mut qdot = vec![0.0; q.len()];
    let mut vdot = vec![0.0; v.len()];
    formulation.derivative(t, q, v, &mut dynamics, &mut qdot, &mut vdot).unwrap();
    (dynamics.vdot, dynamics.lambda)
}

/// Largest errors of v' and lambda against index 1, over the largest v' and lambda.
fn error(system: &dyn MechanicalSystem, formulation: &str, t: f64, q: &[f64], v: &[f64]) -> [f64; 2] {
    let (vdot, lambda) = solve(system, formulation, t, q, v);
    let exact = solve(system, "index1", t, q, v);
    let size = |x: &[f64]| x.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
    [distance(&vdot, &exact.0) / size(&exact.0), distance(&lambda, &exact.1) / size(&exact.1)]
}

/// A state near the start of a scene, stirred by `seed` and made consistent.
fn consistent(system: &dyn MechanicalSystem, (q, v): (&[f64], &[f64]), seed: f64, t: f64) -> (Vec<f64>, Vec<f64>) {
    let stirred = |x: &[f64], size: f64| -> Vec<f64> {
        x.iter().enumerate().map(|(i, x)| x + size * (seed * (1.0 + i as f64)).sin()).collect()
    };
    let assembly = assemble(system, t, (&stirred(q, 0.05), &stirred(v, 1.0)), &[]).unwrap();
    (assembly.q, assembly.v)
}

/// A bar in the plane by coordinates of which the mass matrix is full, on two rods.
struct Coupled;

impl Equations for Coupled {
    fn size(&self) -> (usize, usize) {
        (3, 1)
    }
    fn mass<S: Scalar>(&self, _t: S, q: &[S], mass: &mut [S]) {
        let sin = q[2].sin();
        let cos = q[2].cos();
        let entries =
            [[S::constant(2.0), S::zero(), cos], [S::zero(), S::constant(2.0), sin], [cos, sin, S::constant(1.5)]];
        mass.iter_mut().zip(entries.into_iter().flatten()).for_each(|(m, entry)| *m = entry);
    }
    fn force<S: Scalar>(&self, _t: S, q: &[S], v: &[S], f: &mut [S]) {
        (f[0], f[1], f[2]) = (q[2].sin() * v[2].square(), q[0] * -4.0 - 9.81, q[1]);
    }
    fn phi<S: Scalar>(&self, _t: S, q: &[S], phi: &mut [S]) {
        phi[0] = (q[0] + q[2].sin()).square() + (q[1] - q[2].cos()).square() - 1.0;
    }
}

/// Forty random seeds in 0.1 to 30 with times in 0 to 2 s.
fn stirred() -> impl Iterator<Item = (f64, f64)> {
    let mut random = fastrand::Rng::with_seed(1);
    std::iter::repeat_with(move || (0.1 + 29.9 * random.f64(), 2.0 * random.f64())).take(40)
}

#[test]
fn formulations_without_terms_of_their_own_have_the_accelerations_of_index_1() {
    let coupled = ([1.0, 1.0, 0.0], [0.1, 0.2, 0.3]);
    let pendulum = start();
    for (seed, t) in stirred() {
        let states = [
            (
                &DrivenPendulum as &dyn MechanicalSystem,
                consistent(&DrivenPendulum, (&pendulum.0, &pendulum.1), seed, t),
            ),
            (&Coupled, consistent(&Coupled, (&coupled.0, &coupled.1), seed, t)),
        ];
        for (system, (q, v)) in states {
            for formulation in ["udwadia_kalaba", "null_space", "force_projection"] {
                let [vdot, lambda] = error(system, formulation, t, &q, &v);
                assert!(vdot < 1e-10 && lambda < 1e-10, "{formulation} {seed} {t}: {vdot:e} {lambda:e}");
            }
            // Consistent to round-off, so that omega does not count.
            let [vdot, lambda] = error(system, "augmented_lagrangian", t, &q, &v);
            assert!(vdot < 1e-10 && lambda < 1e-10, "{seed} {t}: {vdot:e} {lambda:e}");
        }
    }
}

#[test]
fn errors_of_penalties_are_powers_of_the_penalty() {
    let (q, v) = start();
    for (seed, t) in stirred() {
        let (q, v) = consistent(&DrivenPendulum, (&q, &v), seed, t);
        for iterations in 1..=3 {
            let found = [1e3, 1e4].map(|penalty| {
                let formulation = format!("augmented_lagrangian:penalty={penalty},iterations={iterations}");
                error(&DrivenPendulum, &formulation, t, &q, &v)
            });
            for level in 0..2 {
                let order = (found[0][level] / found[1][level]).log10();
                assert!((order - f64::from(iterations)).abs() < 0.1, "{seed} {t}, {iterations}: {order} {found:?}");
            }
            if iterations == 1 {
                assert_eq!(found[0], error(&DrivenPendulum, "penalty:penalty=1e3", t, &q, &v));
            }
        }
    }
}

/// Off the manifold penalties follow Baumgarte's equation.
#[test]
fn penalties_pull_back_as_baumgarte_does() {
    let (mut q, v) = start();
    q[0] += 0.01;
    let (vdot, lambda) = solve(&DrivenPendulum, "baumgarte:alpha=3,beta=4", 0.0, &q, &v);
    // xi omega = 3.
    for (method, bound) in [("penalty:penalty=1e10", 1e-7), ("augmented_lagrangian", 1e-11)] {
        let separator = if method.contains(':') { ',' } else { ':' };
        let found = solve(&DrivenPendulum, &format!("{method}{separator}omega=4,xi=0.75"), 0.0, &q, &v);
        // Accelerations and reactions are of the order of 10.
        assert!(distance(&found.0, &vdot) < bound && distance(&found.1, &lambda) < bound, "{method}");
    }
}

/// Redundant rows (rank 11 of 12), and the change point where all links lie in one line (rank 10).
#[test]
fn redundant_rows_and_singular_positions() {
    for angle in [1.0, std::f64::consts::FRAC_PI_2] {
        let scene = shipped("parallelogram_redundant", &[("angle0", angle), ("rate0", 1.0)]);
        let start = scene.start();
        // 1e7 times the contradiction of the rows, 1e-16, is in lambda, once for each iteration.
        for (formulation, bounds) in [
            ("udwadia_kalaba", [1e-10, 1e-10]),
            ("null_space", [1e-10, 1e-10]),
            ("force_projection", [1e-10, 1e-10]),
            ("augmented_lagrangian", [1e-10, 1e-7]),
            ("penalty", [1e-5, 1e-5]),
        ] {
            let found = error(scene.system(), formulation, 0.0, &start.q, &start.v);
            assert!(found[0] < bounds[0] && found[1] < bounds[1], "{formulation} at {angle}: {found:?}");
        }
    }
}

#[test]
fn a_redundant_mechanism_runs_and_its_rank_is_reported() {
    let scene = shipped("parallelogram_redundant", &[]);
    let span = Span { start: 0.0, end: 1.0, output_step: 0.1 };
    let rows = |formulation: &str| {
        let method = crate::common::adaptive(formulation, "dop853", "manifold", 1e-10);
        let run = scene.run(&method, span);
        (run.record.trajectory.rows, run.outcome.statistics)
    };
    let (exact, _) = rows("index1");
    for (formulation, bound, reports) in [
        ("udwadia_kalaba", 1e-8, true),
        ("null_space", 1e-8, true),
        ("force_projection", 1e-8, true),
        ("augmented_lagrangian", 1e-8, false),
        ("penalty", 1e-5, false),
    ] {
        let (rows, counts) = rows(formulation);
        let states = 1..=24;
        let error = rows.iter().zip(&exact).map(|(a, b)| distance(&a[states.clone()], &b[states.clone()]));
        let error = error.fold(0.0, f64::max);
        assert!(error < bound, "{formulation}: {error:e}");
        assert_eq!(counts.rank_deficient, if reports { counts.steps + 1 } else { 0 }, "{formulation}");
    }
}

/// With y = G v + phi_t: G q' + phi_t = y - p phi and G v' - gamma = -r y at a state off the manifold.
#[test]
fn force_projection_pulls_back_at_its_rates() {
    let (mut q, v) = start();
    q[0] += 0.01;
    let mut dynamics = Dynamics::new(&DrivenPendulum);
    let spec = MethodSpec::parse("force_projection:position=2,velocity=7").unwrap();
    let mut qdot = [0.0; 4];
    let mut vdot = [0.0; 4];
    let mut formulation = make(&spec, &DrivenPendulum).unwrap();
    formulation.derivative(0.0, &q, &v, &mut dynamics, &mut qdot, &mut vdot).unwrap();
    let terms = &dynamics.terms;
    let mut position = terms.phi_t.clone();
    dynamics.structure.g.multiply(&terms.g, &qdot, &mut position);
    let mut velocity: Vec<f64> = terms.gamma.iter().map(|gamma| -gamma).collect();
    dynamics.structure.g.multiply(&terms.g, &vdot, &mut velocity);
    for i in 0..2 {
        assert!(terms.phi[i].abs() > 1e-4 && terms.phi_dot[i].abs() > 1e-4);
        // The terms that cancel are of size 1 and 10.
        assert!((position[i] - terms.phi_dot[i] + 2.0 * terms.phi[i]).abs() < 1e-14, "{position:?}");
        assert!((velocity[i] + 7.0 * terms.phi_dot[i]).abs() < 1e-13, "{velocity:?}");
    }
}

#[test]
fn force_projection_lets_the_drift_decay() {
    let (mut q, v) = start();
    q[0] += 0.01;
    let drift = |formulation: &str, end: f64| {
        let found = run(&DrivenPendulum, &fixed(formulation, "dop853", "none", 0.01), until(end), (&q, &v)).completed();
        [found.record.drift.position.last, found.record.drift.velocity.last]
    };
    let [early, late] = [1.0, 2.0].map(|end| drift("force_projection", end));
    let plain = drift("index1", 2.0);
    for level in 0..2 {
        // exp(-10) = 4.5e-5 a second, and a factor that grows with t where the two levels feed each other.
        assert!(late[level] < 5e-4 * early[level] && late[level] < 1e-6 * plain[level], "{early:?} {late:?} {plain:?}");
    }
}

/// Two equal rows of the mass matrix.
struct Massless;

impl Equations for Massless {
    fn size(&self) -> (usize, usize) {
        (2, 1)
    }
    fn mass<S: Scalar>(&self, _t: S, _q: &[S], mass: &mut [S]) {
        mass.fill(S::one());
    }
    fn force<S: Scalar>(&self, _t: S, _q: &[S], _v: &[S], f: &mut [S]) {
        f.fill(S::one());
    }
    fn phi<S: Scalar>(&self, _t: S, q: &[S], phi: &mut [S]) {
        phi[0] = q[0] - q[1];
    }
}

#[test]
fn mass_is_needed_along_the_motions_that_constraints_allow_only() {
    for formulation in ["udwadia_kalaba", "null_space", "augmented_lagrangian"] {
        let (vdot, _) = solve(&Massless, formulation, 0.0, &[0.0; 2], &[0.0; 2]);
        assert!(distance(&vdot, &[0.5, 0.5]) < 1e-12, "{formulation}: {vdot:?}");
    }
}

#[test]
fn options_out_of_range_are_refused() {
    for wrong in ["penalty:penalty=0", "augmented_lagrangian:iterations=0", "udwadia_kalaba:tolerance=-1"] {
        assert!(make(&MethodSpec::parse(wrong).unwrap(), &DrivenPendulum).is_err(), "{wrong}");
    }
}

#[test]
fn a_method_is_read_as_it_is_written() {
    for text in ["ggl + radau_iia", "baumgarte:alpha=5,beta=5 + dop853", "index1 + dop853 + manifold"] {
        assert_eq!(text.parse::<Method>().unwrap().triple(), text);
    }
    for text in ["", "ggl", "a + b + c + d", "baumgarte:alpha + dop853"] {
        assert!(text.parse::<Method>().is_err(), "{text}");
    }
}
