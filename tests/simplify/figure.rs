//! The axes of the figure.

use holonom::plot::AxisSpec;
use holonom::report::simplify_figure;
use holonom::simplify::{Difference, ModelRun, Norm, Simplification, Trial};
use holonom::simulate::Method;
use serde_json::Value;

/// A run of a model with an error, which took so many seconds.
fn run(seconds: f64, error: f64) -> ModelRun {
    ModelRun {
        velocities: 1,
        constraints: 0,
        method: Method::default(),
        seconds,
        work: 1.0,
        class: Default::default(),
        outputs: vec![Difference { name: "x".to_string(), error }],
        failure: None,
        is_too_slow: false,
        rows: Vec::new(),
    }
}

fn trial(run: ModelRun) -> Trial {
    Trial {
        candidate: "section".to_string(),
        subjects: Vec::new(),
        what: Vec::new(),
        why: String::new(),
        estimated: 0.0,
        run: Some(run),
        is_kept: false,
        reason: String::new(),
    }
}

/// The axes of the figure of a full model and of others that were tried, each with its seconds and its error, and where
/// the line of the promise, 0.05, ends.
fn axes(richest: [f64; 2], tried: &[[f64; 2]]) -> (AxisSpec, AxisSpec, f64) {
    let [seconds, error] = richest;
    let result = Simplification {
        scene: "scene".to_string(),
        within: 0.05,
        norm: Norm::Range,
        outputs: vec!["x".to_string()],
        richest: run(seconds, error),
        second_opinion: None,
        trials: tried.iter().map(|&[seconds, error]| trial(run(seconds, error))).collect(),
        chosen: run(seconds, error),
        runs: tried.len(),
        cost: 1.0,
        robustness: None,
        warnings: Vec::new(),
        simplified: Value::Null,
    };
    let panel = simplify_figure(&result).unwrap().panels.remove(0);
    let promise = panel.series.iter().find(|series| series.label == "promise").unwrap();
    let end = promise.points[1].0;
    (panel.x, panel.y, end)
}

/// The axis begins at half of the least error that is drawn.
#[test]
fn the_axis_is_that_of_the_models() {
    let least = |errors: &[f64]| {
        let tried: Vec<[f64; 2]> = errors.iter().map(|&error| [0.5, error]).collect();
        2.0 * axes([1.0, 1e-9], &tried).1.range.unwrap().0
    };
    assert_eq!(least(&[3e-3, 2e-2, 0.4]), 3e-3);
    assert_eq!(least(&[2e-12, 2e-2]), 5e-6);
    assert_eq!(least(&[0.4]), 0.05);
}

#[test]
fn times_that_are_alike_have_marks() {
    let of = |times: [f64; 3]| axes([times[2], 1e-9], &[[times[0], 0.01], [times[1], 0.01]]);
    let (alike, _, end) = of([4e-3, 6e-3, 25e-3]);
    assert_eq!((alike.is_log, alike.range, end), (false, Some((0.0, 1.1 * 25e-3)), 1.1 * 25e-3));
    let (far, _, end) = of([4e-3, 4e-3, 4.0]);
    assert_eq!((far.is_log, far.range, end), (true, Some((2e-3, 8.0)), 8.0));
}
