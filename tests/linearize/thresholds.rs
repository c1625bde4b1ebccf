//! Eigenvalues over a parameter: thresholds against published values, derivatives, and the curves between points.

use super::sure::{shipped, ziegler};
use holonom::linearize::{At, Branch, Complex, Linear, Loci, Slope, ThresholdKind, Variants, loci_along, loci_over};
use holonom::method_spec::MethodSpec;
use holonom::prepared::{Model, Overrides};
use holonom::sweep::{Family, Range};
use std::path::Path;

fn over(path: &Path, range: &str, at: At, set: &[(&str, f64)]) -> Loci {
    let set = set.iter().map(|(name, value)| (name.to_string(), (*value).into())).collect();
    let overrides = Overrides { set, ..Overrides::default() };
    let family = Family::load_with(path, &overrides).unwrap();
    let range: Range = range.parse().unwrap();
    let request = Linear { method: MethodSpec::parse("mcs").unwrap(), chart: None };
    loci_over(&Variants { family: &family, overrides: &overrides, range: &range }, at, &request, || ()).unwrap()
}

/// Ziegler's column: flutter at P = 7/2 - sqrt 2 where two frequencies meet, and with damping at 41/28 + c^2/2, where a
/// pair crosses the axis.
#[test]
fn thresholds_are_located() {
    let undamped = of_text("ziegler", &ziegler(1.0, 0.0), "P=1..3:9", At::Start);
    let [flutter] = undamped.thresholds[..] else { panic!("{:?}", undamped.thresholds) };
    assert_eq!((flutter.kind, flutter.growing), (ThresholdKind::Coalescence, [0, 1]));
    assert!((flutter.at - (3.5 - 2f64.sqrt())).abs() < 1e-10, "{flutter:?}");
    let c = 0.1;
    let damped = of_text("ziegler", &ziegler(1.0, c), "P=1..2:5", At::Start);
    let [crossing] = damped.thresholds[..] else { panic!("{:?}", damped.thresholds) };
    assert_eq!((crossing.kind, crossing.growing), (ThresholdKind::Crossing, [0, 1]));
    assert!((crossing.at - (41.0 / 28.0 + c * c / 2.0)).abs() < 1e-11, "{crossing:?}");
}

/// Derivatives of the frequency of the four-bar with its spring at rest, which follows the parameter.
#[test]
fn eigenvalues_have_their_sensitivity() {
    for (range, known) in [("k1=90..110:3", 0.0351335269169975), ("m3=0.9..1.1:3", -3.51335269169975)] {
        let loci = over(&shipped("four_bar_spring"), range, At::Equilibrium, &[("p0", 1.5), ("w0", 0.0)]);
        let found = loci.sensitivity.unwrap();
        let Slope { value, derivative, error } = found.slopes[0];
        let off = (derivative.unwrap() - Complex::new(0.0, known)).norm();
        assert!(value.im > 0.0 && off < 1e-11 * known.abs() && off <= error, "{range}: {:?} {off:e}", found.slopes[0]);
        assert!(error < 1e-8 * known.abs(), "{range}: {error:e}");
    }
    // s^2 + c/4 s + 25 at its double root: c = 40 has none.
    let loci = over(&shipped("two_mass"), "c1=40..41:2", At::Equilibrium, &[]);
    let found = loci.sensitivity.unwrap();
    assert!(found.at == 40.0 && found.slopes.iter().all(|slope| slope.derivative.is_none()), "{found:?}");
}

/// The loci of a scene that is given as text.
fn of_text(name: &str, text: &str, range: &str, at: At) -> Loci {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(format!("{name}.json"));
    std::fs::write(&path, text).unwrap();
    over(&path, range, at, &[])
}

/// A cantilever of length 1, EI = 1 and rhoA = 1 under a force P along its end.
pub fn beck(elements: usize) -> String {
    format!(
        r#"{{ "name": "beck", "dimension": 2, "parameters": {{ "P": 18 }}, "ground": {{ "markers": {{ "wall": [0, 0] }} }},
            "bodies": [{{ "name": "rod", "type": "flexible_beam", "frame": "absolute", "length": 1, "elements": {elements},
                "stiffness": {{ "EA": 1e8, "EI": 1 }}, "inertia": {{ "rhoA": 1 }},
                "markers": {{ "root": [0, 0], "tip": [1, 0] }} }}],
            "joints": [{{ "name": "clamp", "type": "weld", "between": ["ground.wall", "rod.root"] }}],
            "forces": [{{ "name": "follow", "type": "applied_force", "at": "rod.tip", "axes": "marker", "force": ["-P", 0] }}] }}"#
    )
}

/// Beck's column flutters at P = 20.0509536 EI/L^2. Elements miss it by 2e-2, 2e-3 and 2.3e-4, about to the third order in
/// their length; extrapolation leaves 1.3e-5. The shortening by P/EA is 2e-7.
#[test]
fn beck_s_column() {
    let exact = 20.0509536;
    let found = [3, 6, 12].map(|elements| {
        let loci = of_text("beck", &beck(elements), "P=19..20.5:2", At::Equilibrium);
        let [flutter] = loci.thresholds[..] else { panic!("{:?} {:?}", loci.thresholds, loci.gaps) };
        assert_eq!((flutter.kind, flutter.growing), (ThresholdKind::Coalescence, [0, 1]));
        assert!(flutter.re == 0.0 && (flutter.im - 10.92).abs() < 0.11, "{flutter:?}");
        flutter.at
    });
    let errors = found.map(|load| 1.0 - load / exact);
    assert!(errors[0] < 0.021 && errors[1] < errors[0] / 8.0 && errors[2] < errors[1] / 8.0, "{errors:?}");
    let limit = found[2] + (found[2] - found[1]) / 7.0;
    assert!((limit / exact - 1.0).abs() < 2e-5, "{limit} {errors:?}");
}

/// A disc of 1 kg at the middle of a massless shaft of 2500 N/m, with damping of 3 N s/m that turns with it and 2 N s/m that
/// does not.
const JEFFCOTT: &str = include_str!("../data/jeffcott.json");

/// A Jeffcott rotor whirls by its internal damping above W = w (1 + ce/ci), with w = sqrt(k/m) and ci, ce the damping that
/// turns and that does not: 83.3333 rad/s, to rounding. In axes that turn it crosses the axis at W - w.
#[test]
fn a_jeffcott_rotor() {
    let loci = of_text("jeffcott", JEFFCOTT, "speed=40..120:5", At::Equilibrium);
    let [whirl] = loci.thresholds[..] else { panic!("{:?} {:?}", loci.thresholds, loci.gaps) };
    let exact = 50.0 * (1.0 + 2.0 / 3.0);
    assert_eq!((whirl.kind, whirl.growing), (ThresholdKind::Crossing, [0, 1]));
    assert!((whirl.at / exact - 1.0).abs() < 1e-13 && (whirl.im - (exact - 50.0)).abs() < 1e-9, "{whirl:?}");
}

/// Two equal eigenvalues of K = 100 [1 e; e 1] part with e: w = 10 sqrt(1 +- e).
#[test]
fn equal_eigenvalues_part() {
    let text = r#"{ "name": "parting", "dimension": 2, "parameters": { "e": 0 },
        "bodies": [{ "name": "m", "type": "point_mass", "mass": 1, "initial": { "position": [0, 0] } }],
        "forces": [{ "name": "k", "type": "applied_force", "at": "m", "force": ["-100*m.x - 100*e*m.y", "-100*m.y - 100*e*m.x"] }] }"#;
    let found = of_text("parting", text, "e=-0.1..0.1:3", At::Start).sensitivity.unwrap();
    let mut slopes: Vec<f64> = found.slopes.iter().map(|slope| slope.derivative.unwrap().im).collect();
    slopes.sort_by(f64::total_cmp);
    assert!((slopes[0] + 5.0).abs() < 1e-11 && (slopes[1] - 5.0).abs() < 1e-11, "{found:?}");
}

/// The largest distance of the points of a curve from the nearest of `exact` values, relative to 5 1/s.
fn off(branch: &Branch, exact: impl Fn(f64) -> Vec<Complex<f64>>) -> f64 {
    let nearest = |(at, value): &(f64, Complex<f64>)| {
        exact(*at).iter().map(|exact| (exact - value).norm() / 5.0).fold(f64::INFINITY, f64::min)
    };
    branch.points.iter().map(nearest).fold(0.0, f64::max)
}

/// s^2 + c/4 s + 25 = 0 over c, where a pair becomes real at c = 40, and w^2 = -g/l cos(angle) along a pendulum's motion.
#[test]
fn curves_follow_derivatives() {
    let loci = over(&shipped("two_mass"), "c1=1..71:8", At::Equilibrium, &[]);
    let exact = |c: f64| {
        let root = Complex::new(c * c / 64.0 - 25.0, 0.0).sqrt();
        [root, -root].map(|root| root - c / 8.0).to_vec()
    };
    for branch in &loci.branches {
        let curve = branch.curve();
        let chords = Branch { slopes: Vec::new(), ..branch.clone() }.curve();
        assert!(off(&curve, exact) < 0.05 && curve.points.len() > 60, "{curve:?}");
        assert!(curve.points.is_sorted_by(|a, b| a.0 < b.0) && off(&chords, exact) > 0.4);
    }
    let pendulum = Model::load_with(&shipped("pendulum"), &Overrides::default()).unwrap();
    let times: Vec<f64> = (0..=20).map(|k| 0.05 * f64::from(k)).collect();
    let request = Linear { method: MethodSpec::parse("mcs").unwrap(), chart: None };
    let loci = loci_along(&pendulum, &request, &times, || ());
    assert!(loci.branches.iter().all(|branch| branch.curve().points.len() > 200));
    let states = pendulum.states_at(&times).unwrap();
    for branch in &loci.branches {
        for (((_, value), slope), state) in branch.points.iter().zip(&branch.slopes).zip(&states) {
            let l = state.q[0].hypot(state.q[1]);
            // (lambda^2)' = -(g/l) (cos)' with cos = -y/l.
            let rate = 9.81 / (l * l) * state.v[1];
            assert!((2.0 * value * slope.unwrap() - rate).norm() < 1e-5 * 9.81 / l, "{value} {slope:?} {rate}");
        }
    }
}
