//! Figures of linear models: what they say, and that they take any data.

use super::sample::{complex, descriptor, empty, plain, prepared};
use holonom::linearize::{Branch, Complex, Kind};
use holonom::plot::Figure;
use holonom::report::linear::{Response, bode_figure, frequency_figure, loci_figure, validation_figure};
use holonom::report::mechanism::{Look, View, mode_figure};
use holonom::system::Names;
use holonom::validate::{Curve, PerturbationSequence, decay};

fn svg(figure: Option<Figure>) -> String {
    let svg = figure.unwrap().to_svg();
    assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
    svg
}

fn says(svg: &str, parts: &[&str]) {
    parts.iter().for_each(|part| assert!(svg.contains(part), "no `{part}` in {svg}"));
}

fn branch(kind: Kind, value: impl Fn(f64) -> Complex<f64>) -> Branch {
    Branch { kind, points: (0..50).map(|k| 0.02 * f64::from(k)).map(|t| (t, value(t))).collect() }
}

fn pair(kind: Kind, value: impl Fn(f64) -> Complex<f64>) -> [Branch; 2] {
    let upper = branch(kind, value);
    let mut lower = upper.clone();
    lower.points.iter_mut().for_each(|(_, value)| *value = value.conj());
    [upper, lower]
}

#[test]
fn loci_show_the_upper_half_of_pairs() {
    let svg = svg(loci_figure("loci", "time (s)", &pair(Kind::Physical, |t| complex(-1.0 - t, 5.0 + t))));
    says(&svg, &["real part (1/s)", "imaginary part (rad/s)", "time (s)", "ζ = "]);
    assert!(!svg.contains("−5") && !svg.contains("outside") && !svg.contains("spurious"), "{svg}");
}

#[test]
fn loci_show_both_halves_of_what_is_not_mirrored() {
    let alone = branch(Kind::Physical, |t| complex(-1.0 - t, -5.0 - t));
    says(&svg(loci_figure("loci", "time (s)", &[alone])), &["−6"]);
}

#[test]
fn loci_follow_the_physical_eigenvalues() {
    let mut branches = pair(Kind::Physical, |t| complex(-1.0 - t, 5.0 + t)).to_vec();
    branches.extend(pair(Kind::Spurious, |t| complex(-1e7, 1e8 * (1.0 + t))));
    says(&svg(loci_figure("loci", "time (s)", &branches)), &["50 spurious points lie outside", "spurious</text>"]);
    branches[0].points[7].1 = complex(-1e9, 1.0);
    branches[1].points[7].1 = complex(-1e9, -1.0);
    says(&svg(loci_figure("loci", "time (s)", &branches)), &["1 physical and 50 spurious points lie outside"]);
    branches[0].points[7].1 = complex(f64::INFINITY, f64::NAN);
    branches[1].points[7].1 = complex(f64::INFINITY, f64::NAN);
    says(&svg(loci_figure("loci", "time (s)", &branches)), &[">50 spurious points lie outside"]);
}

/// What may be physical lies within the axes, and looks unlike what is spurious.
#[test]
fn uncertain_eigenvalues_are_told_from_spurious_ones() {
    let mut branches = pair(Kind::Physical, |t| complex(-1.0 - t, 5.0 + t)).to_vec();
    branches.extend(pair(Kind::Uncertain, |t| complex(-30.0, 60.0 + t)));
    branches.extend(pair(Kind::Spurious, |t| complex(-40.0, 50.0 + t)));
    let both = svg(loci_figure("loci", "time (s)", &branches));
    says(&both, &["uncertain</text>", "spurious</text>"]);
    assert!(!both.contains("uncertain points lie outside"), "{both}");
    branches.truncate(4);
    let without = svg(loci_figure("loci", "time (s)", &branches));
    let vermilion = |svg: &str| svg.to_lowercase().matches("#d55e00").count();
    branches.truncate(2);
    assert!(vermilion(&without) > vermilion(&svg(loci_figure("loci", "time (s)", &branches))));
}

#[test]
fn loci_without_much_to_show() {
    assert!(loci_figure("loci", "time (s)", &[]).is_none() && frequency_figure("f", "time (s)", &[]).is_none());
    let infinite = branch(Kind::Infinite, |_| complex(f64::INFINITY, 0.0));
    assert!(loci_figure("loci", "time (s)", &[infinite]).is_none());
    let zero = [branch(Kind::Physical, |_| complex(0.0, 0.0))];
    svg(loci_figure("loci", "time (s)", &zero));
    svg(frequency_figure("f", "time (s)", &zero));
    let spurious = [branch(Kind::Spurious, |t| complex(-1.0, t))];
    svg(loci_figure("loci", "time (s)", &spurious));
    assert!(frequency_figure("f", "time (s)", &spurious).is_none());
}

#[test]
fn forty_branches_and_real_ones() {
    let real = |k: i32| branch(Kind::Physical, move |t| complex(f64::from(k) + t, 0.0));
    let branches: Vec<Branch> = (-20..20).map(real).collect();
    says(&svg(loci_figure("loci", "k1 (N/m)", &branches)), &["k1 (N/m)"]);
    let curves = svg(frequency_figure("modes", "k1 (N/m)", &branches));
    says(&curves, &["frequency |λ|/2π (Hz)", "damping ratio", "k1 (N/m)"]);
    assert!(!curves.contains("mode 1"));
    says(&svg(frequency_figure("modes", "k1 (N/m)", &branches[..3])), &["mode 1", "mode 3"]);
}

#[test]
fn bode_names_units_and_pairs() {
    let response = |output: &str, unit: &str| Response {
        input: "motor".to_string(),
        output: output.to_string(),
        input_unit: "N m".to_string(),
        output_unit: unit.to_string(),
        values: (0..100).map(|k| complex(1.0, 0.1 * f64::from(k)).powi(-2)).collect(),
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
    let curve = |direction: usize| Curve {
        direction,
        simulated: vec![0.0, 1.0, 2.0],
        ltv: vec![0.0, 1.0, 2.1],
        lti: vec![0.0, 1.0, f64::NAN],
    };
    let sequence = |curves: Vec<Curve>| PerturbationSequence {
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
    };
    let both = sequence(vec![curve(0), curve(1)]);
    let both = svg(validation_figure("v", &names(&["a.angle'", "b.angle'"]), &both));
    says(&both, &["slope 2", "perturbation ε", "error of the change", "LTV (along the motion)", "LTI (frozen)"]);
    says(&both, &["change of angle (rad)", "time (s)", ">a.angle<", ">b.angle<", "predicted, LTV", "predicted, LTI"]);
    let alone = svg(validation_figure("v", &names(&["tip.x'"]), &sequence(vec![curve(0)])));
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
    says(&svg(mode_figure(&prepared, &look(), &descriptor(&prepared))), &["mode 1: −0.7984 1/s, no swing"]);
    assert!(mode_figure(&prepared, &look(), &empty(&prepared)).is_none());
}
