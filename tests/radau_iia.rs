//! Radau IIA: its higher orders, counters of other codes, output rows, rotations, redundant rows, stiffness.

use crate::common::driven_pendulum::{DrivenPendulum, start};
use crate::common::equations::State;
use crate::common::equations::andrews::{self, Andrews};
use crate::common::equations::crank::{self, Crank};
use crate::common::stiff::{STIFF, slow_position};
use crate::common::unconstrained::Power;
use crate::common::{Run, adaptive, distance, fixed, run, stepwise, until};
use crate::scenes::{dop853, parse, shipped};
use holonom::scene::generate;
use holonom::simulate::{Method, Span};
use holonom::system::MechanicalSystem;

const FORMULATIONS: [&str; 4] = ["ggl", "index3", "index2", "index1"];

/// Norms of the errors of q, v and lambda at 1.5 s with fixed steps.
fn errors(formulation: &str, order: usize, projection: &str, steps: usize) -> [f64; 3] {
    let (q, v) = start();
    let last = |method: &Method| {
        let run = run(&DrivenPendulum, method, until(1.5), (&q, &v)).completed();
        run.record.trajectory.rows.last().unwrap().clone()
    };
    let exact = last(&fixed("index1", "dop853", "exact", 1.5 / 160.0));
    let found = last(&fixed(formulation, &format!("radau_iia:order={order}"), projection, 1.5 / steps as f64));
    [1..5, 5..9, 9..11].map(|columns| distance(&found[columns.clone()], &exact[columns]))
}

/// 2 s - 1 in all, with index3 too, since its steps end with v on G v + phi_t = 0. Steps between where Newton's method
/// converges and round-off; order 5 is in `orders.rs`.
#[test]
fn order_nine() {
    for (order, formulation, projection, [coarse, fine], expected) in [
        (9, "ggl", "none", [16, 24], [9.0; 3]),
        (9, "index2", "manifold", [16, 24], [9.0; 3]),
        (9, "index1", "manifold", [16, 24], [9.0; 3]),
        (9, "index3", "velocity", [16, 24], [9.0; 3]),
        (9, "index3", "none", [16, 24], [9.0; 3]),
    ] {
        let (coarse_error, fine_error) =
            (errors(formulation, order, projection, coarse), errors(formulation, order, projection, fine));
        for level in 0..3 {
            let found = (coarse_error[level] / fine_error[level]).ln() / (fine as f64 / coarse as f64).ln();
            // Higher derivatives still count at these steps.
            assert!((found - expected[level]).abs() < 0.1 * expected[level] + 0.5, "{order} {formulation}: {found}");
        }
    }
}

/// A collocation method has the order of its quadrature: v' = (k + 1) t^k is exact up to k = order - 1. (On the
/// pendulum no step is small enough for Newton's method and large enough for order 13 to be seen over round-off.)
#[test]
fn orders_of_the_quadrature() {
    for order in [5, 9, 13] {
        let error = |k: i32| {
            let method = fixed("index1", &format!("radau_iia:order={order}"), "none", 1.0);
            (run(&Power(k), &method, until(1.0), (&[0.0], &[0.0])).completed().last().1[0] - 1.0).abs()
        };
        (0..order).for_each(|k| assert!(error(k) < 1e-14, "{order} {k}: {:e}", error(k)));
        // (2 s - 1)/(2 s) (s! (s - 1)! / (2 s - 1)!)^2 or so of the first power that is not met: 1e-2, 1e-5, 1e-8.
        assert!(error(order) > 1e-9, "{order}: {:e}", error(order));
    }
}

fn digits(found: &[f64], exact: &[f64], small: f64) -> f64 {
    let errors = found.iter().zip(exact).map(|(found, exact)| (found - exact).abs() / (exact.abs() + small));
    -errors.fold(1e-17, f64::max).log10()
}

fn solve(system: &dyn MechanicalSystem, start: &State, end: &State, method: &Method) -> Run {
    run(system, method, until(end.t), start.motion()).completed()
}

/// RADAU5 and RADAU on the same equations: steps tried, evaluations, matrices and digits.
#[test]
fn no_more_work_than_other_codes() {
    let andrews = |formulation: &str, tolerance: f64| {
        let method = adaptive(formulation, "radau_iia", "none", tolerance);
        let run = solve(&Andrews, &andrews::START, &andrews::END, &method);
        let found = digits(run.last().0, andrews::END.q, 1.0);
        println!("{formulation} {tolerance:e}: {found:.2} digits, {:?}", run.outcome.statistics);
        (found, run.outcome.statistics)
    };
    let (found, work) = andrews("index3", 1e-8);
    assert!(work.steps + work.rejected <= 147 && work.jacobian_evaluations <= 122, "{work:?}");
    assert!(found > 5.8, "{found}");
    let (found, work) = andrews("index3", 1e-6);
    assert!(work.steps + work.rejected <= 147, "{work:?}");
    assert!(found > 5.8, "{found}");
    let (found, work) = andrews("index2", 1e-14);
    assert!(work.steps + work.rejected <= 228 && work.rhs_evaluations <= 5887, "{work:?}");
    assert!(found > 12.0, "{found}");
    let method = stepwise("index2", "radau_iia", "none", 2e-10);
    let run = solve(&Crank, &crank::START, &crank::END, &method);
    let work = run.outcome.statistics;
    println!("crank: {:.2} digits, {work:?}", digits(run.last().0, crank::END.q, 0.0));
    // Their digits are rounded.
    assert!(work.steps + work.rejected <= 607, "{work:?}");
    assert!(digits(run.last().0, crank::END.q, 0.0) > 5.95);
}

/// Stiff axial and shear directions of beams turn with the motion, by a hundredth in a step: Newton's method with the
/// matrices of the start contracts too slowly for longer steps. With those, and a quarter of a step tried after each
/// that did not converge, 211 and 334 steps were tried; with the middle of each step 99 and 136.
#[test]
fn turning_stiff_directions_do_not_limit_steps() {
    for (scene, most) in [("princeton_beam", 140), ("bathe_bend", 200)] {
        let ready = shipped(scene, &[]);
        let work = ready.run(&adaptive("ggl", "radau_iia", "none", 1e-3), ready.span()).outcome.statistics;
        println!("{scene}: {work:?}");
        assert!(work.steps + work.rejected <= most, "{scene}: {work:?}");
    }
}

/// The stages of a step are of order s + 1 only: rows inside it are as right as its end.
#[test]
fn rows_are_as_accurate_as_steps() {
    let span = Span { start: 0.0, end: 0.03, output_step: 1e-4 };
    let rows =
        |method: &Method| run(&Andrews, method, span, andrews::START.motion()).completed().record.trajectory.rows;
    let exact = rows(&adaptive("index1", "dop853", "exact", 1e-13));
    for formulation in FORMULATIONS {
        let found = rows(&adaptive(formulation, "radau_iia", "none", 1e-8));
        let error = |(row, exact): (&Vec<f64>, &Vec<f64>)| distance(&row[1..8], &exact[1..8]);
        let errors: Vec<f64> = found.iter().zip(&exact).map(error).collect();
        let worst = errors.iter().fold(0.0, |a: f64, b| a.max(*b));
        let last = errors.last().unwrap();
        println!("{formulation} {worst:e} {last:e}");
        // The error grows along the motion.
        assert!(worst < 3.0 * last.max(1e-8), "{formulation}: {worst:e} {last:e}");
    }
}

#[test]
fn rotations_in_space() {
    for (scene, column, amplified) in [("spinning_top", "precession", 1e2), ("universal_shaft", "output_angle", 1e2)] {
        let ready = shipped(scene, &[]);
        let exact = *ready.run(&dop853(1e-12), ready.span()).column(column).last().unwrap();
        for formulation in FORMULATIONS {
            for tolerance in [1e-4, 1e-7, 1e-10] {
                let run = ready.run(&adaptive(formulation, "radau_iia", "none", tolerance), ready.span());
                let error = (run.column(column).last().unwrap() - exact).abs();
                println!("{scene} {column} {formulation} {tolerance:e}: {error:e} {:?}", run.outcome.statistics);
                assert!(error < amplified * tolerance, "{scene} {formulation} {tolerance:e}: {error:e}");
            }
        }
    }
}

/// A shaft of finite elements that turns by 50 rad: what collocates rotation vectors is exact, bends nothing, and takes
/// the longest steps that it may, 0.9 pi after those that grow to it.
#[test]
fn rotations_about_a_fixed_axis_are_exact() {
    let ready = shipped("rotating_shaft", &[]);
    for formulation in FORMULATIONS {
        for tolerance in [1e-3, 1e-6, 1e-9] {
            let run = ready.run(&adaptive(formulation, "radau_iia", "none", tolerance), until(1.0));
            let work = run.outcome.statistics;
            println!("{formulation} {tolerance:e}: {work:?}");
            assert!(work.steps + work.rejected < 30, "{formulation} {tolerance:e}: {work:?}");
            // The angle is 50 rad, rounded in each of the steps.
            let (sin, cos) = 25f64.sin_cos();
            let exact = [0.0, 0.0, 0.0, cos, sin, 0.0, 0.0];
            let q = &run.outcome.q;
            let error = q.iter().zip(exact.iter().chain(&[0.0; 200])).fold(0.0f64, |e, (q, x)| e.max((q - x).abs()));
            assert!(error < 1e-12, "{formulation} {tolerance:e}: {error:e}");
        }
    }
}

/// Rows of G that depend on each other at every state are left out of the matrices, for as long as the motion lasts.
#[test]
fn redundant_constraints() {
    let ready = shipped("parallelogram_redundant", &[]);
    let last = |method: &Method| ready.run(method, ready.span()).record.trajectory.rows.last().unwrap().clone();
    let exact = last(&dop853(1e-12));
    for (formulation, projection) in FORMULATIONS.iter().flat_map(|f| [(f, "none"), (f, "manifold")]) {
        let found = last(&adaptive(formulation, "radau_iia", projection, 1e-9));
        let error = distance(&found[1..13], &exact[1..13]);
        // Index 1 without projection drifts as t^2.
        assert!(error < 1e-6, "{formulation} {projection}: {error:e}");
    }
}

/// The fast spring would keep an explicit method at steps of 1e-5 s. Where it is damped it is stepped over; where it is
/// not, the collocation damps it.
#[test]
fn stiff_motions_are_stepped_over() {
    for damping in [0.0, 1e3] {
        let ready = shipped_stiff(damping);
        for formulation in FORMULATIONS {
            let span = Span { start: 0.0, end: 10.0, output_step: 10.0 };
            let run = ready.run(&adaptive(formulation, "radau_iia", "none", 1e-8), span);
            let x = *run.column("x").last().unwrap();
            let work = run.outcome.statistics;
            println!("{damping} {formulation}: {:e} {work:?}", x - slow_position());
            assert!((x - slow_position()).abs() < 1e-6, "{damping} {formulation}: {x}");
            assert!(work.steps < 400, "{damping} {formulation}: {work:?}");
        }
    }
}

fn shipped_stiff(damping: f64) -> crate::scenes::Ready {
    parse(&STIFF.replace("\"damping\": 0 }", &format!("\"damping\": {damping} }}")))
}

/// Newton's second correction of a chain released from rest is thirty times the first: no reason to give up a fixed
/// step.
#[test]
fn long_chains_take_fixed_steps() {
    let ready = parse(&generate::chain(2000).to_string());
    for formulation in ["ggl", "index3"] {
        let run = ready.run(&fixed(formulation, "radau_iia", "none", 1e-4), until(2e-4));
        assert!(run.record.drift.position.max < 1e-12, "{formulation} {:?}", run.record.drift.position);
    }
}

/// Elements of 2.5 mm whose fast modes, 1e5 rad/s, the steps do not follow: forces that round-off of q makes leave v
/// rounded by q/h, and Newton's method ends there.
#[test]
fn long_chains_of_beams_take_fixed_steps() {
    let ready = parse(&generate::flexible_chain(100).to_string());
    let last = |method: &Method| {
        let trajectory = ready.run(method, until(1e-3)).record.trajectory;
        let q = trajectory.names.q.iter().zip(&trajectory.rows.last().unwrap()[1..]);
        q.filter(|(name, _)| name.ends_with(".y")).map(|(_, y)| *y).collect::<Vec<_>>()
    };
    let exact = last(&dop853(1e-11));
    for formulation in ["index1", "index3", "ggl"] {
        let found = last(&fixed(formulation, "radau_iia", "none", 1e-4));
        let error = distance(&found, &exact);
        println!("{formulation}: {error:e}");
        // Of a fall by 5 micrometres: what the first steps leave of the fast modes at the hinge.
        assert!(error < 1e-8, "{formulation}: {error:e}");
    }
}

/// phi = 0 alone finds v by a division by h: steps and rows end on G v + phi_t = 0 all the same.
#[test]
fn velocities_of_index3_are_consistent() {
    let ready = shipped("gear_pair", &[]);
    let exact = ready.run(&dop853(1e-13), ready.span());
    for tolerance in [1e-6, 1e-9] {
        let run = ready.run(&adaptive("index3", "radau_iia", "none", tolerance), ready.span());
        let drift = run.record.drift.velocity.max;
        let error = distance(&run.column("small.wz"), &exact.column("small.wz"));
        println!("{tolerance:e}: {error:e} {drift:e} {:?}", run.outcome.statistics);
        // Of rates of 1 rad/s; round-off of a projection.
        assert!(error < 10.0 * tolerance && drift < 1e-14, "{tolerance:e}: {error:e} {drift:e}");
    }
}

/// At rest the accelerations are round-off and set no time: the first step is no part of the load's two seconds, and
/// does not look for it after them, where it is over.
#[test]
fn a_load_that_starts_from_zero_is_seen() {
    let ready = shipped("right_angle_cantilever", &[]);
    let tip = |method: &Method| {
        let run = ready.run(method, until(15.0));
        (*run.column("tip_z").last().unwrap(), run.outcome.statistics.steps)
    };
    let exact = tip(&adaptive("index2", "radau_iia", "none", 1e-8)).0;
    for formulation in FORMULATIONS {
        for tolerance in [1e-3, 1e-4] {
            let (found, steps) = tip(&adaptive(formulation, "radau_iia", "none", tolerance));
            println!("{formulation} {tolerance:e}: {:e} of {exact} in {steps}", found - exact);
            assert!((found - exact).abs() < 100.0 * tolerance, "{formulation} {tolerance:e}: {found} {exact}");
        }
    }
}

/// Long steps over a motion that a driver prescribes: where a row is so far off the constraints that no projection
/// finds back, its step ends there.
#[test]
fn a_row_that_cannot_be_projected_ends_its_step() {
    let ready = shipped("slider_crank_offset", &[]);
    let rows = |method: &Method| ready.run(method, ready.span()).column("piston_x");
    let exact = rows(&ready.0.method);
    let rtol = 3e-3;
    let found = rows(&Method { rtol, atol: 1e-6, ..adaptive("ggl", "radau_iia", "none", rtol) });
    assert!(distance(&found, &exact) < rtol, "{:e}", distance(&found, &exact));
}

/// Shifts of positions leave stiff coordinates alone: moved by their mass, a shaft of EA = 1e4 EI rings after every
/// step, which takes 135 steps. 50 are taken.
#[test]
fn shifts_excite_nothing_stiff() {
    let shaft = shipped("rotating_shaft", &[]);
    let span = Span { start: 0.0, end: 1.0, output_step: 1.0 };
    let statistics = shaft.run(&adaptive("ggl", "radau_iia", "none", 1e-3), span).outcome.statistics;
    assert!(statistics.steps < 70, "{statistics:?}");
}

/// phi returns to zero from its rounding at the rate of the gain: a velocity that shorter steps see as an error.
#[test]
fn gains_of_any_size_are_stepped_over() {
    for name in ["double_pendulum", "spatial_slider_crank"] {
        for gain in ["1e6", "1e8", "1e9"] {
            let formulation = format!("baumgarte:alpha={gain},beta={gain}");
            let run = shipped(name, &[]).run(&adaptive(&formulation, "radau_iia", "none", 1e-8), until(1e-3));
            let steps = run.outcome.statistics.steps;
            assert!(steps < 200, "{name} {gain}: {steps} steps");
        }
    }
}
