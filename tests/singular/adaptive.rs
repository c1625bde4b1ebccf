//! Steps that adapt, through every singular scene: the error follows the tolerance.

use super::parallelogram::angle;
use super::reference::{AT_REST, RUNNING, TWO_LOOPS};
use super::{adaptive, last};
use crate::scenes::{Ready, parse, shipped};
use holonom::scene::generate::n_four_bar;
use holonom::simulate::Span;
use rayon::prelude::*;

/// A scene with a column, its value at the end, and how many times the tolerance its error is at most.
struct Case {
    scene: Ready,
    end: f64,
    column: &'static str,
    value: f64,
    /// With dop853, with dopri5, whose more steps add up to more, and with phem56, whose stages hold constraints beside the
    /// singular states.
    most: [f64; 3],
}

/// Twice the largest factor found over 17 tolerances from 1e-4 to 1e-12.
fn cases() -> [Case; 4] {
    let crank = |name, reference: &[[f64; 4]; 10], most| Case {
        scene: shipped(name, &[]),
        end: 10.0,
        column: "crank_angle",
        value: reference[9][0],
        most,
    };
    [
        crank("slider_crank_singular", &AT_REST, [20.0, 20.0, 20.0]),
        crank("slider_crank_singular_2", &RUNNING, [800.0, 2000.0, 8000.0]),
        Case {
            scene: shipped("parallelogram", &[]),
            end: 5.0,
            column: "angle",
            value: angle(5.0),
            most: [100.0, 800.0, 800.0],
        },
        Case {
            scene: parse(&n_four_bar(2).to_string()),
            end: 10.0,
            column: "B0_x",
            value: TWO_LOOPS[9][2],
            most: [160.0, 2000.0, 2000.0],
        },
    ]
}

fn follows_the_tolerance(formulation: &str, integrator: &str, projection: &str) {
    let place = ["dop853", "dopri5", "phem56"].iter().position(|name| *name == integrator).unwrap();
    cases().par_iter().for_each(|case| {
        for tolerance in (10..=22).map(|k| 10f64.powf(-0.5 * f64::from(k))) {
            let method = adaptive(formulation, integrator, projection, tolerance);
            let run = case.scene.run(&method, Span { start: 0.0, end: case.end, output_step: case.end });
            let error = (last(&run, case.column) - case.value).abs() / tolerance;
            let what = format!("{} {formulation} {integrator} {projection} at {tolerance:e}", case.column);
            assert!(error < case.most[place], "{what}: {error} tolerances");
        }
    });
}

#[test]
fn explicit_steps_with_projection() {
    for integrator in ["dop853", "dopri5"] {
        follows_the_tolerance("index1", integrator, "manifold");
        follows_the_tolerance("index1", integrator, "exact");
    }
}

#[test]
fn half_explicit_steps() {
    follows_the_tolerance("index2", "phem56", "manifold");
}
