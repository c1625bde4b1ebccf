//! Figures of linear models: what they say, and that they take any data.

use super::sample::{complex, descriptor, empty, plain, prepared};
use holonom::linearize::{Branch, Complex, Kind};
use holonom::plot::{AxisSpec, Figure, Item, ItemForm, Panel, Style, Tint};
use holonom::report::linear::{
    Magnitude, Response, bode_figure, frequency_figure, loci_figure, motion_figure, validation_figure,
};
use holonom::report::mechanism::{Look, View, mode_figure};
use holonom::system::Names;
use holonom::validate::{ChangeCurve, PerturbationSequence, decay};
use std::f64::consts::TAU;

fn svg(figure: Option<Figure>) -> String {
    let svg = figure.unwrap().to_svg();
    assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
    svg
}

fn says(svg: &str, parts: &[&str]) {
    parts.iter().for_each(|part| assert!(svg.contains(part), "no `{part}` in {svg}"));
}

fn branch(kind: Kind, value: impl Fn(f64) -> Complex<f64>) -> Branch {
    let points = (0..50).map(|k| 0.02 * f64::from(k)).map(|t| (t, value(t))).collect();
    Branch { kind, points, slopes: vec![None; 50] }
}

fn pair(kind: Kind, value: impl Fn(f64) -> Complex<f64>) -> [Branch; 2] {
    let upper = branch(kind, value);
    let mut lower = upper.clone();
    lower.points.iter_mut().for_each(|(_, value)| *value = value.conj());
    [upper, lower]
}

#[test]
fn loci_show_the_upper_half_of_pairs() {
    let svg = svg(loci_figure("loci", "time (s)", &pair(Kind::Physical, |t| complex(-1.0 - t, 5.0 + t)), &[]));
    says(&svg, &["real part (1/s)", "imaginary part (rad/s)", "time (s)", "ζ = "]);
    assert!(!svg.contains("−5") && !svg.contains("outside") && !svg.contains("spurious"), "{svg}");
}

#[test]
fn loci_show_both_halves_of_what_is_not_mirrored() {
    let alone = branch(Kind::Physical, |t| complex(-1.0 - t, -5.0 - t));
    says(&svg(loci_figure("loci", "time (s)", &[alone], &[])), &["−6"]);
}

#[test]
fn loci_follow_the_physical_eigenvalues() {
    let mut branches = pair(Kind::Physical, |t| complex(-1.0 - t, 5.0 + t)).to_vec();
    branches.extend(pair(Kind::Spurious, |t| complex(-1e7, 1e8 * (1.0 + t))));
    says(&svg(loci_figure("loci", "time (s)", &branches, &[])), &["50 spurious points lie outside", "spurious</text>"]);
    branches[0].points[7].1 = complex(-1e9, 1.0);
    branches[1].points[7].1 = complex(-1e9, -1.0);
    says(&svg(loci_figure("loci", "time (s)", &branches, &[])), &["1 physical and 50 spurious points lie outside"]);
    branches[0].points[7].1 = complex(f64::INFINITY, f64::NAN);
    branches[1].points[7].1 = complex(f64::INFINITY, f64::NAN);
    says(&svg(loci_figure("loci", "time (s)", &branches, &[])), &[">50 spurious points lie outside"]);
}

/// What may be physical lies within the axes, and looks unlike what is spurious.
#[test]
fn uncertain_eigenvalues_are_told_from_spurious_ones() {
    let mut branches = pair(Kind::Physical, |t| complex(-1.0 - t, 5.0 + t)).to_vec();
    branches.extend(pair(Kind::Uncertain, |t| complex(-30.0, 60.0 + t)));
    branches.extend(pair(Kind::Spurious, |t| complex(-40.0, 50.0 + t)));
    let both = svg(loci_figure("loci", "time (s)", &branches, &[]));
    says(&both, &["uncertain</text>", "spurious</text>"]);
    assert!(!both.contains("uncertain points lie outside"), "{both}");
    branches.truncate(4);
    let without = svg(loci_figure("loci", "time (s)", &branches, &[]));
    let vermilion = |svg: &str| svg.to_lowercase().matches("#d55e00").count();
    branches.truncate(2);
    assert!(vermilion(&without) > vermilion(&svg(loci_figure("loci", "time (s)", &branches, &[]))));
}

#[test]
fn loci_without_much_to_show() {
    assert!(loci_figure("loci", "time (s)", &[], &[]).is_none() && frequency_figure("f", "k1", &[], &[]).is_none());
    let infinite = branch(Kind::Infinite, |_| complex(f64::INFINITY, 0.0));
    assert!(loci_figure("loci", "time (s)", &[infinite], &[]).is_none());
    let zero = [branch(Kind::Physical, |_| complex(0.0, 0.0))];
    svg(loci_figure("loci", "time (s)", &zero, &[]));
    svg(frequency_figure("f", "k1", &zero, &[]));
    svg(motion_figure("f", &zero, None));
    assert!(motion_figure("f", &[], None).is_none());
    let spurious = [branch(Kind::Spurious, |t| complex(-1.0, t))];
    svg(loci_figure("loci", "time (s)", &spurious, &[]));
    assert!(frequency_figure("f", "k1", &spurious, &[]).is_none());
}

#[test]
fn forty_branches_and_real_ones() {
    let real = |k: i32| branch(Kind::Physical, move |t| complex(f64::from(k) + t, 0.0));
    let branches: Vec<Branch> = (-20..20).map(real).collect();
    says(&svg(loci_figure("loci", "k1 (N/m)", &branches, &[])), &["k1 (N/m)"]);
    let curves = svg(frequency_figure("modes", "k1 (N/m)", &branches, &[]));
    says(&curves, &["frequency |λ|/2π (Hz)", "damping ratio", "k1 (N/m)"]);
    says(&curves, &["12 slowest of 40 modes", ">mode 21<"]);
    assert!(!curves.contains(">mode 1<"));
    says(&svg(frequency_figure("modes", "k1 (N/m)", &branches[..3], &[])), &["mode 1", "mode 3"]);
}

/// Each part of the eigenvalues fills its axis, whatever the size of the other.
#[test]
fn the_plane_is_scaled_to_each_part() {
    let mut branches = pair(Kind::Physical, |t| complex(-0.5 + 0.6 * t, 900.0 + 100.0 * t)).to_vec();
    branches.extend(pair(Kind::Physical, |t| complex(-0.3, 300.0 + t)));
    let panel = only(loci_figure("loci", "k1 (N/m)", &branches, &[]));
    let re = panel.x.range.unwrap();
    let im = panel.y.range.unwrap();
    assert!((-0.6..-0.5).contains(&re.0) && (0.088..0.2).contains(&re.1), "{re:?}");
    assert!((-100.0..=0.0).contains(&im.0) && (998.0..1100.0).contains(&im.1), "{im:?}");
    // Round-off of real parts does not fill an axis.
    let undamped = pair(Kind::Physical, |t| complex(1e-13 * (t - 0.5), 10.0 + t));
    let re = only(loci_figure("loci", "k1 (N/m)", &undamped, &[])).x.range.unwrap();
    assert!(re.1 - re.0 > 0.1, "{re:?}");
}

#[test]
fn the_half_plane_of_growth_is_shaded_and_zero_is_a_thin_line() {
    let panel = only(loci_figure("loci", "k1 (N/m)", &pair(Kind::Physical, |t| complex(t - 0.5, 10.0 + t)), &[]));
    let re = panel.x.range.unwrap();
    let im = panel.y.range.unwrap();
    assert_eq!(shaded(&panel), [(0.0, im.0), (re.1, im.0), (re.1, im.1), (0.0, im.1)]);
    let up = panel.series.iter().find(|line| line.points == [(0.0, im.0), (0.0, im.1)]).unwrap();
    assert_eq!(up.style, Style::Thin);
    let stable = only(loci_figure("loci", "k1 (N/m)", &pair(Kind::Physical, |t| complex(-500.0 - t, 10.0 + t)), &[]));
    assert!(stable.items.iter().all(|item| !matches!(item.form, ItemForm::Area(_))));
}

#[test]
fn growth_outside_the_axes_is_told() {
    let mut branches = pair(Kind::Physical, |t| complex(-1.0 - t, 5.0 + t)).to_vec();
    branches.iter_mut().for_each(|branch| branch.points[7].1.re = 3e4);
    says(
        &svg(loci_figure("loci", "k1 (N/m)", &branches, &[])),
        &["1 physical point lies outside, real parts up to 3.00e4 1/s"],
    );
}

/// A pair that becomes two real eigenvalues, one of which grows.
fn buckling(t: f64) -> [Complex<f64>; 2] {
    let square = 1.0 - 2.0 * t;
    let root = square.abs().sqrt();
    if square > 0.0 { [complex(0.0, root), complex(0.0, -root)] } else { [complex(root, 0.0), complex(-root, 0.0)] }
}

#[test]
fn a_motion_has_frequency_and_growth_over_time() {
    let branches = [0, 1].map(|i| branch(Kind::Physical, move |t| buckling(t)[i]));
    let figure = motion_figure("loci", &branches, None).unwrap();
    let [swing, growth] = &figure.panels[..] else { panic!("{figure:?}") };
    assert_eq!([&swing.x.label, &growth.x.label], ["time (s)"; 2]);
    assert_eq!([swing.y.label.as_str(), growth.y.label.as_str()], ["frequency Im λ/2π (Hz)", "real part (1/s)"]);
    assert_eq!(growth.series.iter().map(|line| line.label.as_str()).collect::<Vec<_>>(), ["mode 1", "mode 2"]);
    let last = |panel: &Panel, i: usize| panel.series[i].points[49].1;
    assert_eq!((last(swing, 0), last(swing, 1)), (0.0, 0.0));
    assert!(last(growth, 0) > 0.9 && last(growth, 1) < -0.9);
    assert!(shaded(growth)[0].1 == 0.0 && shaded(growth)[2].1 == growth.y.range.unwrap().1);
    let is_colored = |item: &Item| matches!(item.tint, Tint::Value(_));
    assert!(!figure.panels.iter().flat_map(|panel| &panel.items).any(is_colored));
    let other = pair(Kind::Physical, |_| complex(-0.1, 2.0));
    let both = motion_figure("loci", &branches, Some(("simple", &other))).unwrap();
    assert!(
        both.panels.iter().all(|panel| panel.series[2].label == "simple" && panel.series[2].style == Style::Dashed)
    );
}

#[test]
fn a_campbell_diagram_has_lines_of_excitation() {
    let mut branches: Vec<Branch> = Vec::new();
    for k in 1..=9 {
        branches.extend(pair(Kind::Physical, move |t| complex(-0.1, 20.0 * f64::from(k) * (1.0 + 0.1 * t))));
    }
    let speeds: Vec<(f64, f64)> = branches[0].points.iter().map(|(at, _)| (*at, 50.0 * at)).collect();
    let figure = frequency_figure("modes", "speed (rad/s)", &branches, &speeds).unwrap();
    let panel = &figure.panels[0];
    assert_eq!((panel.x.label.as_str(), panel.y.is_log, panel.y.range.unwrap().0), ("speed (rad/s)", false, 0.0));
    let guides: Vec<(f64, f64)> =
        panel.series.iter().filter(|line| line.style == Style::Guide).map(|line| line.points[49]).collect();
    let fastest = 50.0 * 0.98 / TAU;
    assert!((guides[0].1 - fastest).abs() < 1e-9 && (guides[1].1 - 2.0 * fastest).abs() < 1e-9, "{guides:?}");
    assert_eq!(panel.items.iter().map(|item| &item.form).collect::<Vec<_>>(), [&note("1×"), &note("2×")]);
    // Modes that twice a turn may meet: below 1.5 * 2 * 49 rad/s.
    let mut names = panel.series.iter().map(|line| line.label.as_str()).filter(|label| !label.is_empty());
    assert_eq!(names.next_back(), Some("mode 7"));
    says(&panel.title, &["the 7 slowest of 9 modes"]);
    // Without a rotation there are none.
    let plain = frequency_figure("modes", "k1 (N/m)", &branches, &[]).unwrap();
    assert!(plain.panels[0].series.iter().all(|line| line.style != Style::Guide) && plain.panels[0].items.is_empty());
}

/// A mode has the name that it has in the files, also where slower ones begin later.
#[test]
fn modes_keep_their_names_where_some_are_left_out() {
    let branches: Vec<Branch> =
        (0..14).map(|k| branch(Kind::Physical, move |t| complex(-1.0, 20.0 - f64::from(k) + t))).collect();
    let figure = frequency_figure("modes", "k1 (N/m)", &branches, &[]).unwrap();
    assert_eq!(figure.panels[0].series[0].label, "mode 3");
}

fn only(figure: Option<Figure>) -> Panel {
    let mut panels = figure.unwrap().panels;
    assert_eq!(panels.len(), 1);
    panels.remove(0)
}

fn note(text: &str) -> ItemForm {
    ItemForm::Note(text.into())
}

/// Corners of the shaded part of a panel.
fn shaded(panel: &Panel) -> Vec<(f64, f64)> {
    let mut areas = panel.items.iter().filter(|item| matches!(item.form, ItemForm::Area(_)));
    let (Some(Item { spots, .. }), None) = (areas.next(), areas.next()) else { panic!("{:?}", panel.items) };
    spots.iter().map(|spot| spot.at).collect()
}

fn response(output: &str, unit: &str) -> Response {
    Response {
        input: "motor".to_string(),
        output: output.to_string(),
        input_unit: "N m".to_string(),
        output_unit: unit.to_string(),
        values: (0..100).map(|k| complex(1.0, 0.1 * f64::from(k)).powi(-2)).collect(),
    }
}

#[test]
fn bode_magnitudes_are_in_decibel_or_in_their_unit() {
    let frequencies: Vec<f64> = (0..100).map(|k| 10f64.powf(0.02 * f64::from(k))).collect();
    let responses = [response("a", "m/s^2")];
    let panel = |magnitude| bode_figure("arm", &frequencies, &responses, magnitude).unwrap().panels[0].clone();
    let [decibel, absolute] = [Magnitude::Decibel, Magnitude::Absolute].map(panel);
    assert_eq!((decibel.y.label.as_str(), decibel.y.is_log), ("magnitude (dB re m/s^2/(N m))", false));
    assert_eq!((absolute.y.label.as_str(), absolute.y.is_log), ("magnitude (m/s^2/(N m))", true));
    for (in_db, size) in decibel.series[0].points.iter().zip(&absolute.series[0].points) {
        assert!((in_db.1 - 20.0 * size.1.log10()).abs() < 1e-12);
    }
    let bare = Response { input_unit: String::new(), ..response("gain", "") };
    let bare = bode_figure("arm", &frequencies, &[bare], Magnitude::Decibel).unwrap();
    assert_eq!(bare.panels[0].y, AxisSpec::from("magnitude (dB)"));
}

#[test]
fn bode_names_units_and_pairs() {
    let bode_figure = |title: &str, frequencies: &[f64], responses: &[Response]| {
        bode_figure(title, frequencies, responses, Magnitude::Absolute)
    };
    let frequencies: Vec<f64> = (0..100).map(|k| 10f64.powf(0.02 * f64::from(k))).collect();
    let one = svg(bode_figure("arm", &frequencies, &[response("theta", "rad")]));
    says(&one, &["frequency (Hz)", "magnitude (rad/(N m))", "phase (deg)", "arm: theta over motor", "−120<", "−90<"]);
    let two = svg(bode_figure("arm", &frequencies, &[response("theta", "rad"), response("tip", "m")]));
    says(&two, &["response to motor", ">theta<", ">tip<", "magnitude (rad/(N m))", "magnitude (m/(N m))"]);
    let mut none = response("tip", "m");
    none.values.fill(complex(0.0, 0.0));
    let rest = svg(bode_figure("arm", &frequencies, &[response("theta", "rad"), none]));
    says(&rest, &["arm: theta over motor"]);
    assert!(!rest.contains("tip"));
    assert!(bode_figure("arm", &frequencies, &[]).is_none());
    let mut odd = response("theta", "");
    odd.values[3] = complex(0.0, 0.0);
    odd.values[4] = complex(f64::NAN, 0.0);
    svg(bode_figure("arm", &frequencies, &[odd]));
}

#[test]
fn validation_shows_orders_and_predictions() {
    let epsilons: Vec<f64> = (0..10).map(|k| 0.5f64.powi(k)).collect();
    let errors_ltv: Vec<f64> = epsilons.iter().map(|e| e * e).collect();
    let names = |names: &[&str]| {
        let v: Vec<String> = names.iter().map(|name| name.to_string()).collect();
        Names { q: Vec::new(), v, lambda: Vec::new() }
    };
    let curve = |direction: usize, size: f64| ChangeCurve {
        direction,
        simulated: vec![0.0, size, 2.0 * size],
        ltv: vec![0.0, size, 2.1 * size],
        lti: vec![0.0, size, f64::NAN],
    };
    let sequence = |curves: Vec<ChangeCurve>| PerturbationSequence {
        direction: "random".to_string(),
        errors_lti: epsilons.clone(),
        order_ltv: decay(&epsilons, &errors_ltv, |_| 1.0, 0.0),
        errors_ltv: errors_ltv.clone(),
        epsilons: epsilons.clone(),
        times: vec![0.0, 0.1, 0.2],
        drift_lti: Vec::new(),
        horizons: [None; 2],
        curves,
        curve_epsilon: 0.01,
        passage: None,
    };
    let angles = names(&["a.angle'", "b.angle'"]);
    let both = |size: f64| validation_figure("v", &angles, &sequence(vec![curve(0, 1.0), curve(1, size)])).unwrap();
    let labels = |figure: &Figure, panel: usize| -> Vec<String> {
        figure.panels[panel].series.iter().map(|series| series.label.clone()).collect()
    };
    // Lines that hide each other are drawn once, with their difference below.
    assert_eq!(labels(&both(1.0), 1), ["a.angle = b.angle", "predicted, LTV", "predicted, LTI"]);
    assert_eq!(labels(&both(1.0), 2), ["|LTV − simulated|", "|LTI − simulated|"]);
    assert_eq!(labels(&both(1.001), 1)[0], "a.angle, b.angle");
    let hidden = &both(1.001).panels[2].series[2];
    assert_eq!(hidden.label, "|b.angle − a.angle|");
    assert!((hidden.points[2].1 - 0.002).abs() < 1e-12);
    let off = &both(1.0).panels[2].series[0];
    assert!((off.points[2].1 - 0.1).abs() < 1e-12 && off.points[1].1 == 1e-15);
    let both = svg(Some(both(2.0)));
    says(&both, &["slope 2", "perturbation ε", "error of the change", "LTV (along the motion)", "LTI (frozen)"]);
    says(
        &both,
        &[
            "change of angle (rad)",
            "time since the state (s)",
            ">a.angle<",
            ">b.angle<",
            "predicted, LTV",
            "predicted, LTI",
        ],
    );
    let alone = svg(validation_figure("v", &names(&["tip.x'"]), &sequence(vec![curve(0, 1.0)])));
    says(&alone, &["change of tip.x (m)", "simulated"]);
    let zero = PerturbationSequence { errors_ltv: Vec::new(), errors_lti: Vec::new(), ..sequence(Vec::new()) };
    assert!(validation_figure("v", &names(&[]), &zero).is_none());
}

fn look() -> Look {
    Look { view: View::planar(), labels: false, traces: Vec::new() }
}

#[test]
fn modes_are_drawn_one_panel_each() {
    let prepared = prepared("flexible_slider_crank");
    let model = plain(&prepared);
    let svg = svg(mode_figure(&prepared, &look(), &model));
    says(&svg, &["flexible_slider_crank, modes at t = 0 s", "mode 1: 202.8 Hz, ζ = 0<", "mode 4: ", "x (m)"]);
    assert!(!svg.contains("mode 5"));
}

#[test]
fn modes_without_shapes_are_not_drawn() {
    let prepared = prepared("four_bar_spring");
    says(&svg(mode_figure(&prepared, &look(), &descriptor(&prepared))), &["mode 1: −0.7984 1/s, no oscillation"]);
    assert!(mode_figure(&prepared, &look(), &empty(&prepared)).is_none());
}
