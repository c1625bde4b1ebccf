//! Methods at moving states, where charts differ.

use crate::linearize::models::{at, counts, model, values};
use crate::linearize::reference::{distance, spectrum};
use holonom::linearize::{Chart, Kind, Matrix, Variation};

const MOVING: [(&str, &[&str]); 3] = [
    ("four_bar_N1", &["q1", "q2", "q3", "q4"]),
    ("andrews_t010", &["q1", "q2", "q3", "q7"]),
    ("double_pendulum_N1", &["q1,q3", "q2,q3"]),
];

fn charts(names: &[&str]) -> Vec<Chart> {
    let named = names.iter().map(|name| Chart::parse(name));
    [Chart::Intrinsic, Chart::MassOrthogonal, Chart::Frozen].into_iter().chain(named).collect()
}

/// The largest difference over the largest entry.
fn difference(a: &Matrix, b: &Matrix) -> f64 {
    (a - b).amax() / b.amax().max(f64::MIN_POSITIVE)
}

/// diag(B, B) A_u X0 does not contain the gains: the matrices themselves agree in each chart. Gains of 100/s and
/// 10^4/s^2 cancel against each other to 1e-12 of A.
#[test]
fn projected_methods_are_those_of_minimal_coordinates() {
    let methods =
        ["baumgarte", "baumgarte:alpha=0", "baumgarte:alpha=100", "force_projection", "force_projection:alpha=100"];
    for (label, names) in MOVING {
        at(label, |variation, _| {
            for chart in charts(names) {
                let exact = model(variation, "mcs", Some(chart.clone()));
                for method in methods {
                    let projected = format!("{method}{}projected=yes", if method.contains(':') { "," } else { ":" });
                    let found = model(variation, &projected, Some(chart.clone()));
                    let off = difference(&found.a, &exact.a);
                    let known = values(&exact, Kind::Physical);
                    let eigenvalues = distance(&values(&found, Kind::Physical), &known);
                    println!("{label} {} {projected}: {off:.1e} {eigenvalues:.1e}", exact.chart);
                    assert!(
                        off < 1e-9 && eigenvalues < 1e-9,
                        "{label} {} {projected}: {off:e} {eigenvalues:e}",
                        exact.chart
                    );
                    assert_eq!((found.chart, found.states), (exact.chart.clone(), exact.states.clone()));
                }
            }
        });
    }
}

/// All 2 n values at every state of the references, those off equilibrium included: simple ones to 1e-9, members of
/// multiple ones (the critical roots, and zeros without gains, in blocks of size 2 or larger) to the root of rounding.
#[test]
fn all_eigenvalues_of_baumgarte_are_those_of_the_references() {
    for label in crate::linearize::reference::LABELS {
        at(label, |variation, reference| {
            for case in reference.0["baumgarte"].as_array().unwrap() {
                let [c1, c0] = ["c1", "c0"].map(|key| case[key].as_f64().unwrap());
                let known = spectrum(&case["spectrum"]);
                let largest = known.iter().map(|x| x.norm()).fold(0.0, f64::max);
                let apart = 1e-4 * largest;
                let is_simple = known.iter().all(|x| known.iter().filter(|y| (x - *y).norm() < apart).count() == 1);
                for name in ["baumgarte", "force_projection"] {
                    let found = model(variation, &format!("{name}:alpha={},beta={}", c1 / 2.0, c0.sqrt()), None);
                    let all: Vec<_> = found.modes.iter().map(|mode| mode.value).collect();
                    let off = distance(&all, &known);
                    println!("{label} {name} {c1} {c0}: {off:.1e} {}", if is_simple { "simple" } else { "multiple" });
                    let most = if is_simple { 1e-9 } else { 1e-6 };
                    assert!(off < most, "{label} {name} {c1} {c0}: {off:e}\n{all:?}\n{known:?}");
                }
            }
        });
    }
}

/// The pencil of index 3 is the plain projection; at moving states neither is the model of another chart.
#[test]
fn the_frozen_pencil_is_the_plain_projection() {
    for (label, _) in MOVING {
        at(label, |variation, reference| {
            let known = spectrum(&reference.0["rcs_frozen_pencil"]["eigenvalues"]);
            let frozen = values(&model(variation, "mcs", Some(Chart::Frozen)), Kind::Physical);
            assert!(distance(&frozen, &known) < 1e-9, "{label}: {frozen:?}");
            for method in ["rcs:solver=null_space", "rcs:solver=gsvd", "rcs:solver=qz", "rcs:form=ggl"] {
                let found = model(variation, method, None);
                let off = distance(&values(&found, Kind::Physical), &known);
                println!("{label} {method}: {off:.1e} {:?}", counts(&found));
                if !method.contains("ggl") {
                    assert!(off < 1e-9, "{label} {method}: {off:e}");
                }
            }
        });
    }
}

/// Raw spectra depend on the gains there, which the projected ones do not: nothing in them is physical, and where no gap
/// tells a pair that may be, none is called so.
#[test]
fn raw_spectra_depend_on_the_gains() {
    let kinds = |variation: &mut Variation, alpha: f64| {
        let found = model(variation, &format!("baumgarte:alpha={alpha},beta={}", 3.0 * alpha), None);
        [Kind::Physical, Kind::Uncertain].map(|kind| values(&found, kind))
    };
    at("four_bar_N1", |variation, _| {
        let [one, other] = [10.0, 20.0].map(|alpha| kinds(variation, alpha)[0].clone());
        assert!(distance(&one, &other) > 0.01, "{one:?} {other:?}");
        let [physical, uncertain] = kinds(variation, 1.0);
        assert!(physical.is_empty() && uncertain.len() >= 2, "{physical:?} {uncertain:?}");
    });
}
