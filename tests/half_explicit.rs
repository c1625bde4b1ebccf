//! Half-explicit methods: what they hold, what they cost, how they fail.

use crate::common::driven_pendulum::{self, DrivenPendulum};
use crate::common::equations::andrews;
use crate::common::unconstrained::{Arenstorf, Power};
use crate::common::{Run, adaptive, distance, fixed, method, run, stepwise, until};
use crate::scenes::shipped;
use holonom::integrator::registry;
use holonom::simulate::{Method, Span};

/// Methods for index 2, with solutions a fixed step.
const HALF_EXPLICIT: [(&str, u64); 4] = [("hem3", 4), ("hem4", 6), ("hem5", 9), ("phem56", 6)];

fn pendulum(method: &Method, end: f64) -> Run {
    let (q, v) = driven_pendulum::start();
    run(&DrivenPendulum, method, until(end), (&q, &v)).completed()
}

#[test]
fn the_velocity_constraint_is_held_to_round_off() {
    for (integrator, work) in HALF_EXPLICIT {
        let run = pendulum(&fixed("index2", integrator, "none", 0.02), 10.0);
        let (position, velocity) = run.drift();
        // Speeds up to 5 m/s, G up to 1: some units in the last place of sums over the stages. phi drifts as h^p.
        assert!(velocity < 1e-14, "{integrator}: {velocity:e}");
        assert!(position > 1e-13 && position < 1e-3, "{integrator}: {position:e}");
        let counts = run.outcome.statistics;
        assert_eq!((counts.rhs_evaluations, counts.factorizations), (1 + 500 * work, 1 + 500 * work), "{integrator}");
    }
}

/// sum_i b_i c_i^k = 1/(k + 1) for k < p, without constraints.
#[test]
fn quadrature_conditions() {
    for entry in registry().iter().filter(|entry| entry.accepts().eq(["index2"])) {
        let error = |k: usize| {
            let method = fixed("index2", entry.name, "none", 1.0);
            let run = run(&Power(k as i32), &method, until(1.0), (&[0.0], &[0.0])).completed();
            (run.last().1[0] - 1.0).abs()
        };
        // Rounding of the coefficients, given to 16 digits.
        (0..entry.order).for_each(|k| assert!(error(k) < 1e-14, "{} {k}: {:e}", entry.name, error(k)));
    }
}

/// Without constraints PHEM56 is DOPRI5.
#[test]
fn phem56_without_constraints_is_dopri5() {
    let (q, v) = Arenstorf::START;
    let orbit = |formulation: &str, integrator: &str| {
        let method = stepwise(formulation, integrator, "none", 1e-7);
        run(&Arenstorf, &method, until(Arenstorf::PERIOD), (&q, &v)).completed()
    };
    let half = orbit("index2", "phem56");
    let full = orbit("index1", "dopri5");
    assert_eq!(half.outcome.statistics, full.outcome.statistics);
    assert!(distance(half.last().0, full.last().0) < 1e-8);
}

/// In the 21 coordinates of the bodies; in the seven angles it is as much work (`tests/references`).
#[test]
fn phem56_on_andrews() {
    // Steps measured, and a tenth more.
    for (tolerance, most) in [(1e-6, 67), (1e-8, 157), (1e-10, 395)] {
        let run = shipped("andrews", &[])
            .run(&stepwise("index2", "phem56", "none", tolerance), Span { start: 0.0, end: 0.03, output_step: 0.03 });
        let counts = run.outcome.statistics;
        let angles = ["beta", "Theta", "gamma"].into_iter().zip(andrews::END.q);
        let errors: Vec<f64> = angles.map(|(name, angle)| (run.column(name).last().unwrap() - angle).abs()).collect();
        // The motion amplifies local errors about 100 times.
        assert!(errors.iter().all(|error| *error < 200.0 * tolerance), "{tolerance:e}: {errors:?}");
        assert!(counts.steps <= most, "{counts:?}");
        // The start, the probe for the first step, and six a step tried.
        assert_eq!(counts.rhs_evaluations, 2 + 6 * (counts.steps + counts.rejected));
        // Speeds of some 10 m/s.
        assert!(run.record.drift.velocity.max < 1e-14, "{:?}", run.record.drift);
    }
}

/// Two rods too many: rows of G that depend on each other at every state.
#[test]
fn redundant_constraints() {
    let method = adaptive("index2", "phem56", "manifold", 1e-8);
    let span = Span { start: 0.0, end: 1.0, output_step: 0.1 };
    let ready = shipped("parallelogram_redundant", &[]);
    let half = ready.run(&method, span);
    let full = ready.run(&crate::scenes::dop853(1e-12), span);
    let last = |run: &crate::scenes::Run| run.record.trajectory.rows.last().unwrap().clone();
    let half_last = last(&half);
    let full_last = last(&full);
    let half = half.record.trajectory.row_state(&half_last);
    let full = full.record.trajectory.row_state(&full_last);
    assert!(distance(half.0, full.0) < 1e-6);
}

/// Where the guess of the accelerations is zero (the shaft at the start), and where round-off over the step makes
/// dependent rows ask for different things (the parallelogram, whose rows are dependent as long as phi is held).
#[test]
fn small_steps_at_rest_and_with_redundant_constraints() {
    for (scene, projection) in [("universal_shaft", "none"), ("parallelogram_redundant", "manifold")] {
        let ready = shipped(scene, &[]);
        for integrator in ["hem3", "hem5", "phem56"] {
            for step in [1e-3, 1e-5, 1e-6] {
                let method = fixed("index2", integrator, projection, step);
                let span = Span { start: 0.0, end: 500.0 * step, output_step: 500.0 * step };
                assert_eq!(ready.run(&method, span).outcome.failure, None, "{scene} {integrator} {step}");
            }
        }
    }
}

/// At rest under load the accelerations are what round-off leaves of forces of 4 kN in balance.
#[test]
fn a_loaded_mechanism_at_rest() {
    let ready = shipped("five_link_suspension", &[]);
    for integrator in ["hem3", "hem4", "hem5", "phem56"] {
        let run =
            ready.run(&fixed("index2", integrator, "manifold", 1e-3), Span { start: 0.0, end: 0.5, output_step: 0.5 });
        let energy = run.record.energy.expect("the scene states its potential");
        // The error of hem3 over the bump; more accurate ones lie far below.
        assert!(energy.relative_max_error.unwrap() < 1e-5, "{integrator}: {energy:?}");
    }
}

#[test]
fn impossible_pairs_name_what_goes_together() {
    for (formulation, integrator, names) in
        [("index2", "dopri5", ["index1", "phem56"]), ("index1", "phem56", ["index2", "dop853"])]
    {
        let text = method(formulation, integrator, "none").check().unwrap_err().to_string();
        assert!(names.iter().all(|name| text.contains(name)), "{text}");
    }
}

/// A step of seconds on a pendulum of one second: the constraints at the ends of a stage have nothing in common.
#[test]
fn steps_far_too_large_end_clearly() {
    let (q, v) = driven_pendulum::start();
    for (integrator, _) in HALF_EXPLICIT {
        let run = run(&DrivenPendulum, &fixed("index2", integrator, "none", 3.0), until(300.0), (&q, &v));
        // PHEM56 stays bounded here; the others end.
        if let Some(failure) = run.outcome.failure {
            let reasons = ["too far apart", "come apart", "no longer finite"];
            assert!(reasons.iter().any(|reason| failure.reason.contains(reason)), "{integrator}: {failure:?}");
            assert_eq!(failure.t, run.outcome.t);
        }
        assert!(run.record.trajectory.rows.iter().flatten().all(|x| x.is_finite()));
    }
}
