//! Adams methods: orders, rows between steps, events, and the work beside dop853.

use crate::common::driven_pendulum::{DrivenPendulum, start};
use crate::common::orders::{END, Rows, error, gentle};
use crate::common::{adaptive, run, until};
use crate::scenes::{dop853, shipped};
use holonom::integrator::registry;
use holonom::projection;
use holonom::simulate::{Method, Span};
use rayon::prelude::*;

const LEVELS: [(&str, std::ops::Range<usize>); 3] = [("q", 1..5), ("v", 5..9), ("lambda", 9..11)];

fn formulations() -> impl Iterator<Item = String> {
    registry().iter().find(|entry| entry.name == "adams").unwrap().accepts().map(gentle)
}

/// Steps of the driven pendulum, and its rows at so many times.
fn solve(method: &Method, rows: f64) -> (f64, Rows) {
    let (q, v) = start();
    let span = Span { output_step: END / rows, ..until(END) };
    let run = run(&DrivenPendulum, method, span, (&q, &v)).completed();
    (run.outcome.statistics.steps as f64, run.record.trajectory.rows)
}

/// Steps cannot be given: the order is the power of the mean step that the error falls with between two tolerances at which the
/// highest order asked for rules. Steps change with the motion, by which the power is uncertain.
#[test]
fn every_triple_has_the_order_that_is_asked_for() {
    let (_, reference) = solve(&adaptive("index1", "dop853", "exact", 1e-13), 8.0);
    let projections = || projection::registry().iter().map(|entry| entry.name);
    let pairs: Vec<_> = formulations().flat_map(|f| projections().map(move |p| (f.clone(), p))).collect();
    assert_eq!(pairs.len(), 48);
    pairs.par_iter().for_each(|(formulation, projection)| {
        for (order, tolerances, off) in
            [(2.0, [1e-4, 1e-6], 0.2), (4.0, [1e-5, 3.333e-9], 0.4), (7.0, [1e-6, 3.333e-9], 1.0)]
        {
            let integrator = format!("adams:order={order}");
            let found =
                tolerances.map(|tolerance| solve(&adaptive(formulation, &integrator, projection, tolerance), 8.0));
            for (name, columns) in &LEVELS {
                let errors = [0, 1].map(|k| error(&found[k].1, &reference, columns));
                let measured = (errors[0] / errors[1]).ln() / (found[1].0 / found[0].0).ln();
                let what = format!("{formulation} + {integrator} + {projection}: order {measured:.2} in {name}");
                println!("{what} {errors:?}");
                assert!((measured - order).abs() < off, "{what}, {errors:?}");
            }
        }
    });
}

/// Errors of all rows of many in a step, of those at its ends and of those between, in tolerances.
#[test]
fn rows_between_steps_are_as_good_as_the_steps() {
    let reference = solve(&adaptive("index1", "dop853", "exact", 1e-13), 600.0).1;
    for formulation in formulations() {
        for tolerance in [1e-4, 1e-7, 1e-10] {
            let (steps, rows) = solve(&adaptive(&formulation, "adams", "manifold", tolerance), 600.0);
            assert!(steps < 200.0, "{steps}");
            let far = |columns: &std::ops::Range<usize>| {
                let off = |(row, exact): (&Vec<f64>, &Vec<f64>)| {
                    columns.clone().map(|i| (row[i] - exact[i]).abs() / (1.0 + exact[i].abs())).fold(0.0, f64::max)
                };
                rows.iter().zip(&reference).map(off).fold(0.0, f64::max) / tolerance
            };
            let [q, v, lambda] = LEVELS.map(|(_, columns)| far(&columns));
            println!("{formulation} {tolerance:e}: {q:.2} {v:.2} {lambda:.2}");
            assert!(q < 10.0 && v < 10.0 && lambda < 100.0, "{formulation} {tolerance:e}: {q} {v} {lambda}");
        }
    }
}

/// Motions that amplify errors some ten times: the errors of steps at the order of least error add up.
#[test]
fn motions_that_amplify_a_little_are_as_accurate_as_asked() {
    for (name, columns) in [("double_pendulum", 4), ("slider_crank", 3), ("parallelogram", 3)] {
        let ready = shipped(name, &[]);
        let exact = ready.run(&dop853(1e-13), ready.span());
        for tolerance in [1e-8, 1e-10] {
            let run = ready.run(&adaptive("index1", "adams", "manifold", tolerance), ready.span());
            let ends = [&run, &exact].map(|run| run.record.trajectory.rows.last().unwrap());
            let off = |i: usize| (ends[0][i] - ends[1][i]).abs() / (1.0 + ends[1][i].abs()) / tolerance;
            let error = (1..=columns).map(off).fold(0.0, f64::max);
            println!("{name} {tolerance:e}: {error:.1} tolerances");
            assert!(error < 20.0, "{name} {tolerance:e}: {error} tolerances");
        }
    }
}

/// Two thirds of the evaluations of dop853 on a smooth motion at equal errors; found: 806 and 6.2e-10, 1266 and 6.9e-10.
#[test]
fn smooth_motions_take_two_thirds_of_the_evaluations() {
    let ready = shipped("andrews", &[]);
    let exact = ready.run(&dop853(1e-13), ready.span());
    let run = |integrator: &str, tolerance: f64| {
        let run = ready.run(&adaptive("index1", integrator, "manifold", tolerance), ready.span());
        let error = ["beta", "Theta", "Omega"].map(|name| {
            let pairs = run.column(name).into_iter().zip(exact.column(name));
            pairs.map(|(found, exact)| (found - exact).abs() / (1.0 + exact.abs())).fold(0.0, f64::max)
        });
        (run.outcome.statistics.rhs_evaluations, error.into_iter().fold(0.0, f64::max))
    };
    let (work, error) = run("adams", 1e-8);
    let (other, reached) = run("dop853", 1e-8);
    println!("adams {work} {error:e}, dop853 {other} {reached:e}");
    assert!(error < 2.0 * reached && 3 * work < 2 * other, "{work} {error:e}, dop853 {other} {reached:e}");
}
