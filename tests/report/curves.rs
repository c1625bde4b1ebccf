//! Curves stacked in panels.

use holonom::plot::{Figure, Panel};
use holonom::report::{Shown, outputs_figure};
use holonom::study::{ErrorBar, ErrorBars};
use holonom::system::{Column, Names};
use holonom::trajectory::Trajectory;

const ROWS: i32 = 200;

/// A curve in m.
type Curve = (&'static str, Box<dyn Fn(i32) -> f64>);

/// A curve that swings between `middle` - `half` and `middle` + `half`.
fn swing(name: &'static str, middle: f64, half: f64) -> Curve {
    (name, Box::new(move |k| middle + half * (0.1 * f64::from(k)).sin()))
}

/// The figure of a run with these outputs, with an error bar of the first one.
fn drawn(curves: &[Curve], bar: Option<f64>, separate: bool) -> Figure {
    let outputs = curves.iter().map(|(name, _)| Column { name: name.to_string(), unit: "m".to_string() });
    let row = |k: i32| [0.01 * f64::from(k)].into_iter().chain(curves.iter().map(|(_, value)| value(k))).collect();
    let run = Trajectory { names: Names::default(), outputs: outputs.collect(), rows: (0..ROWS).map(row).collect() };
    let of = |size: f64| {
        let bar = ErrorBar { max: size, last: size, unit: "m".to_string(), rows: vec![size; ROWS as usize] };
        ErrorBars {
            rtol: 1e-9,
            atol: 1e-11,
            step: None,
            work: 0.5,
            outputs: vec![(curves[0].0.to_string(), bar)],
            second_opinion: None,
            amplification: Ok(1.0),
            failure: None,
        }
    };
    outputs_figure("run", &run, bar.map(of).as_ref(), &Shown::all(&run), separate).unwrap()
}

fn panel(curves: &[Curve]) -> Panel {
    drawn(curves, None, false).panels.remove(0)
}

/// Names of the curves of each panel; one alone is named by its axis.
fn names(curves: &[Curve], separate: bool) -> Vec<Vec<String>> {
    let of = |panel: &Panel| match &panel.series[..] {
        [_] => vec![panel.y.label.trim_end_matches(" (m)").to_string()],
        several => several.iter().map(|series| series.label.clone()).collect(),
    };
    drawn(curves, None, separate).panels.iter().map(of).collect()
}

#[test]
fn ranges_that_differ_tenfold_are_drawn_apart() {
    let curves = [swing("a", 0.0, 1.0), swing("b", 0.0, 0.02), swing("c", 0.0, 0.5), swing("d", 0.0, 0.01)];
    assert_eq!(names(&curves, false), [["a", "c"], ["b", "d"]]);
    assert_eq!(names(&curves, true), [["a"], ["b"], ["c"], ["d"]]);
    assert_eq!(names(&[swing("a", 0.0, 1.0), swing("b", 0.0, 0.11)], false), [["a", "b"]]);
    assert!(drawn(&curves, None, false).panels.iter().all(|panel| panel.y.label == "position (m)"));
}

#[test]
fn round_off_gets_no_panel_of_its_own() {
    let curves = [swing("a", 0.0, 1.0), swing("none", 0.0, 1e-17), swing("b", 0.0, 1e-4)];
    assert_eq!(names(&curves, false), [vec!["a", "none"], vec!["b"]]);
}

#[test]
fn a_constant_joins_what_is_near() {
    let curves = || vec![swing("goal", 1.5, 0.0), swing("x", 0.0, 1.0), swing("far", 50.0, 0.0)];
    assert_eq!(names(&curves(), false), [vec!["goal", "x"], vec!["far"]]);
    let nothing: Curve = ("nothing", Box::new(|_| f64::NAN));
    let all: Vec<Curve> = curves().into_iter().chain([nothing]).collect();
    assert_eq!(names(&all, false), [vec!["goal", "x", "nothing"], vec!["far"]]);
}

#[test]
fn an_error_bar_that_is_seen_is_a_band() {
    let panel = |size: f64| drawn(&[swing("a", 5.0, 1.0)], Some(size), false).panels.remove(0);
    assert!(panel(1e-3).items.is_empty());
    let seen = panel(0.1);
    let spots = &seen.items[0].spots;
    let ends = [&spots[0], &spots[spots.len() - 1]].map(|spot| spot.at);
    assert_eq!(ends, [(0.0, 5.1), (0.0, 4.9)]);
}

#[test]
fn curves_far_from_each_other_are_drawn_as_changes() {
    let far = panel(&[swing("a", 1.0, 0.1), swing("b", 20.0, -0.1)]);
    assert_eq!(far.y.label, "position − x₀ (m)");
    assert_eq!([&far.series[0].label, &far.series[1].label], ["a, x₀ = 1 m", "b, x₀ = 20 m"]);
    assert!(far.series.iter().all(|series| series.points[0].1 == 0.0));
    let near = panel(&[swing("a", 1.0, 0.1), swing("b", 1.5, -0.1)]);
    assert_eq!((near.y.label.as_str(), near.series[0].points[0].1), ("position (m)", 1.0));
}

#[test]
fn what_is_nearly_constant_is_drawn_as_its_change() {
    let change = panel(&[swing("height", -19.62, 1e-9)]);
    assert_eq!((change.y.label.as_str(), change.title.as_str()), ("height − x₀ (m)", "x₀ = −19.62 m"));
    assert!(change.series[0].points.iter().all(|point| point.1.abs() <= 1.001e-9));
    for whole in [swing("height", 19.62, 0.0), swing("height", 19.62, 1e-13), swing("height", 19.62, 0.01)] {
        assert_eq!(panel(&[whole]).y.label, "height (m)");
    }
}
