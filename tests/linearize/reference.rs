//! Known answers in 30 digits, at equilibria and moving states.

use crate::linearize::systems::system;
use holonom::linearize::{Chart, Complex, Variation, minimal};
use serde_json::Value;

/// A reference file.
pub struct Reference(pub Value);

/// All of them.
pub const LABELS: [&str; 6] =
    ["two_mass_eq", "four_bar_S1", "four_bar_N1", "double_pendulum_N1", "andrews_E1", "andrews_t010"];

impl Reference {
    pub fn read(label: &str) -> Self {
        let path = format!("{}/tests/data/linear_{label}.json", env!("CARGO_MANIFEST_DIR"));
        Reference(serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap())
    }

    pub fn vector(&self, key: &str) -> Vec<f64> {
        self.0[key].as_array().unwrap().iter().map(number).collect()
    }
}

fn number(value: &Value) -> f64 {
    value.as_str().unwrap().parse().unwrap()
}

pub fn spectrum(value: &Value) -> Vec<Complex<f64>> {
    value.as_array().unwrap().iter().map(|pair| Complex::new(number(&pair[0]), number(&pair[1]))).collect()
}

/// The largest distance of the eigenvalues of `found` from those of `expected`, matched one to one, over the largest.
pub fn distance(found: &[Complex<f64>], expected: &[Complex<f64>]) -> f64 {
    assert_eq!(found.len(), expected.len(), "{found:?} for {expected:?}");
    let scale = expected.iter().map(|x| x.norm()).fold(0.0, f64::max);
    let mut left = found.to_vec();
    let mut worst = 0.0f64;
    for value in expected {
        let nearest = (0..left.len()).min_by(|&i, &j| (left[i] - value).norm().total_cmp(&(left[j] - value).norm()));
        worst = worst.max((left.remove(nearest.unwrap()) - value).norm());
    }
    worst / scale
}

/// Every chart has the spectrum of the reference, which was computed in 30 to 50 digits. The states of the references
/// are rounded to double, which moves eigenvalues by some 1e-15 times their condition; 1e-11 leaves room for that.
#[test]
fn charts_have_the_spectra_of_the_references() {
    for label in LABELS {
        let reference = Reference::read(label);
        let system = system(label);
        let mut variation =
            Variation::new(system.as_ref(), 0.0, &reference.vector("q"), &reference.vector("v")).unwrap();
        let mut check = |name: &str, chart: Chart, expected: &Value| {
            let found = minimal(&mut variation, &chart).unwrap();
            let values: Vec<_> = found.built.a.complex_eigenvalues().iter().copied().collect();
            let off = distance(&values, &spectrum(expected));
            println!("{label} {name}: {off:e}");
            assert!(off < 1e-11, "{label} {name}: {off:e} {values:?}");
        };
        check("intrinsic", Chart::Intrinsic, &reference.0["covariant"]["eigenvalues"]);
        check("mass", Chart::MassOrthogonal, &reference.0["chart_mass_orthogonal"]["eigenvalues"]);
        check("frozen", Chart::Frozen, &reference.0["rcs_frozen_pencil"]["eigenvalues"]);
        let coordinates = reference.0["coords"].as_array().unwrap();
        for chart in reference.0["charts"].as_array().unwrap() {
            let names = chart["independent_coordinates"]
                .as_array()
                .unwrap()
                .iter()
                .map(|name| format!("q{}", 1 + coordinates.iter().position(|known| known == name).unwrap()));
            let names: Vec<String> = names.collect();
            check(&names.join(","), Chart::Independent(names), &chart["eigenvalues"]);
        }
    }
}
