//! Minimal coordinates in the tangent space: no drift, wherever the state is looked at, and what is integrated.

use crate::common::driven_pendulum::{DrivenPendulum, start};
use crate::common::equations::pendulum::Pendulum;
use crate::common::{adaptive, distance, fixed, run, until};
use crate::scenes::shipped;
use holonom::prepared::Model;
use holonom::scene::Scene;
use holonom::simulate::{Observation, Sink, Span, simulate};
use holonom::system::MechanicalSystem;

/// Largest |phi| and |G v + phi_t| over accepted steps and rows.
#[derive(Default)]
struct Drift([f64; 2]);

impl Sink for Drift {
    fn accepted(&mut self, at: &Observation) {
        for (most, rows) in self.0.iter_mut().zip([at.phi, at.phi_dot]) {
            *most = rows.iter().fold(*most, |most, x| most.max(x.abs()));
        }
    }
    fn row(&mut self, at: &Observation) {
        self.accepted(at);
    }
}

fn drift(
    system: &dyn MechanicalSystem,
    method: &holonom::simulate::Method,
    span: Span,
    start: (&[f64], &[f64]),
) -> [f64; 2] {
    let mut drift = Drift::default();
    let outcome = simulate(system, method, span, start, &mut drift).unwrap();
    assert_eq!(outcome.failure, None);
    drift.0
}

/// Rows fall into the steps: the interpolated states are on the manifold too.
#[test]
fn nothing_drifts_without_a_projection() {
    let (q, v) = start();
    let span = Span { start: 0.0, end: 5.0, output_step: 0.003 };
    for integrator in ["heun", "rk4", "dopri5", "dop853"] {
        let [position, velocity] =
            drift(&DrivenPendulum, &fixed("null_space", integrator, "none", 0.02), span, (&q, &v));
        // Lengths of 1 m and velocities of some m/s.
        assert!(position < 1e-15 && velocity < 5e-15, "{integrator}: {position:e} {velocity:e}");
    }
    let loose = adaptive("null_space", "dopri5", "none", 1e-3);
    let [position, velocity] = drift(&DrivenPendulum, &loose, span, (&q, &v));
    assert!(position < 1e-15 && velocity < 5e-15, "{position:e} {velocity:e}");
}

/// Redundant rows; drivers and quaternions; many loops.
#[test]
fn scenes_do_not_drift() {
    for (name, end, bounds) in [
        ("parallelogram_redundant", 2.0, [1e-14, 1e-13]),
        ("universal_shaft", 1.0, [1e-14, 1e-13]),
        ("spinning_top", 0.2, [1e-14, 1e-12]),
        ("andrews", 0.03, [1e-15, 1e-11]),
    ] {
        let scene = shipped(name, &[]);
        let span = Span { start: 0.0, end, output_step: end / 100.0 };
        let start = scene.start();
        let found = drift(scene.system(), &adaptive("null_space", "dopri5", "none", 1e-6), span, (&start.q, &start.v));
        assert!(found[0] < bounds[0] && found[1] < bounds[1], "{name}: {found:?}");
    }
}

/// The top turns by quaternions: order of rk4 in all of q and v.
#[test]
fn rotations_in_space_keep_their_order() {
    let scene = shipped("spinning_top", &[]);
    let begin = scene.start();
    let last = |formulation: &str, integrator: &str, steps: usize| {
        let method = fixed(formulation, integrator, "none", 0.2 / steps as f64);
        let (q, v, _) = {
            let run = run(scene.system(), &method, until(0.2), (&begin.q, &begin.v)).completed();
            let (q, v, lambda) = run.last();
            (q.to_vec(), v.to_vec(), lambda.to_vec())
        };
        [q, v].concat()
    };
    let exact = last("index1", "dop853", 800);
    let error = |steps: usize| distance(&last("null_space", "rk4", steps), &exact);
    let order = (error(200) / error(400)).log2();
    assert!((order - 4.0).abs() < 0.3, "order {order:.2}");
}

/// A step of Heun's method on u'' of the pendulum in the chart of its start, q = q_b + z u + q_b (sqrt(1 - u^2) - 1),
/// done by hand.
#[test]
fn what_is_integrated_are_the_coordinates_of_the_chart() {
    let q0 = [0.6, -0.8];
    let w0 = 1.5;
    let h = 0.2;
    let z = [0.8, 0.6];
    let point = |u: f64, w: f64| {
        let normal = (1.0 - u * u).sqrt();
        let q = [0, 1].map(|i| q0[i] * normal + z[i] * u);
        let v = [0, 1].map(|i| z[i] * w - q0[i] * u * w / normal);
        (q, v)
    };
    // v' = g - lambda q with lambda from q . v' = -v . v.
    let acceleration = |u: f64, w: f64| {
        let (q, v) = point(u, w);
        let lambda = v[0] * v[0] + v[1] * v[1] - 9.81 * q[1];
        z[0] * -lambda * q[0] + z[1] * (-9.81 - lambda * q[1])
    };
    let a0 = acceleration(0.0, w0);
    let u1 = h * w0;
    let w1 = w0 + h * a0;
    let u = 0.5 * h * (w0 + w1);
    let w = w0 + 0.5 * h * (a0 + acceleration(u1, w1));
    let by_hand = point(u, w);
    let v0 = [z[0] * w0, z[1] * w0];
    let run = run(&Pendulum, &fixed("null_space", "heun", "none", h), until(h), (&q0, &v0)).completed();
    let (q, v, _) = run.last();
    assert!(distance(q, &by_hand.0) < 1e-15 && distance(v, &by_hand.1) < 1e-14, "{q:?} {v:?} {by_hand:?}");
}

/// A quarter of a turn and more in a step leaves the chart.
#[test]
fn a_step_too_long_for_its_chart_is_refused() {
    let q = [0.0, -1.0];
    let v = [20.0, 0.0];
    let long = run(&Pendulum, &fixed("null_space", "rk4", "none", 0.5), until(1.0), (&q, &v));
    let failure = long.outcome.failure.unwrap();
    assert!(failure.reason.contains("converge") && failure.hint.contains("smaller"), "{failure:?}");
    // A tolerance that would let it pass makes it smaller.
    run(&Pendulum, &adaptive("null_space", "dopri5", "none", 1e-1), until(1.0), (&q, &v)).completed();
}

/// Before the run, with what it costs and what to take instead; small systems are for it.
#[test]
fn dense_formulations_of_large_systems_are_warned_of() {
    let method = |formulation: &str| fixed(formulation, "rk4", "none", 1e-3);
    for formulation in ["null_space", "udwadia_kalaba", "index1"] {
        let doubts = |links: usize| {
            let scene =
                holonom::scene::generate::registry().iter().find(|(name, _)| *name == "chain").unwrap().1(links);
            let prepared = Model::new(Scene::parse(&scene.to_string(), &[]).unwrap(), &Default::default()).unwrap();
            method(formulation).doubts(prepared.system())
        };
        assert_eq!(doubts(30), []);
        let Some(warning) = doubts(40).pop() else {
            assert_eq!(formulation, "index1");
            continue;
        };
        let text = format!(
            "{formulation} is dense: an evaluation takes 5e6 operations with 120 velocities and 80 constraints"
        );
        assert!(warning.text.starts_with(&text), "{warning}");
        assert_eq!(warning.hint, "choose a sparse formulation, such as index1 with the projection manifold");
    }
}
