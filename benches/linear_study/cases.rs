//! Mechanisms, states, and what their eigenvalues are.

use crate::systems::{FourBar, system};
use holonom::linearize::{Chart, Complex, Kind, Linear, LinearModel, Variation};
use holonom::method_spec::MethodSpec;
use holonom::system::MechanicalSystem;
use serde_json::Value;

/// A mechanism at a state.
pub struct Case {
    pub name: &'static str,
    pub title: &'static str,
    pub is_equilibrium: bool,
    system: Box<dyn MechanicalSystem>,
    q: Vec<f64>,
    v: Vec<f64>,
    known: Vec<Complex<f64>>,
}

/// The equilibria, then the moving states.
pub fn cases() -> Vec<Case> {
    let mut all = vec![
        read("two_mass", "two_mass_eq", "two masses at rest, +-5i"),
        read("four_bar S1", "four_bar_S1", "four-bar linkage at rest, +-4.2694i"),
        read("andrews E1", "andrews_E1", "Andrews' squeezer at rest, +-424.56i"),
        read("four_bar N1", "four_bar_N1", "four-bar linkage in motion, undamped"),
        read("andrews 10 ms", "andrews_t010", "Andrews' squeezer in motion, at 10 ms"),
    ];
    let damped = damped(&all[3]);
    all.insert(4, damped);
    all
}

fn read(name: &'static str, label: &str, title: &'static str) -> Case {
    let path = format!("{}/tests/data/linear_{label}.json", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    let file: Value = serde_json::from_str(&text).unwrap_or_else(|error| panic!("{path}: {error}"));
    let number = |value: &Value| value.as_str().and_then(|text| text.parse::<f64>().ok()).unwrap_or(f64::NAN);
    let list = |value: &Value| value.as_array().cloned().unwrap_or_default();
    let vector = |key: &str| list(&file[key]).iter().map(number).collect();
    let known = list(&file["covariant"]["eigenvalues"]);
    Case {
        name,
        title,
        is_equilibrium: file["is_equilibrium"] == true,
        system: system(label),
        q: vector("q"),
        v: vector("v"),
        known: known.iter().map(|pair| Complex::new(number(&pair[0]), number(&pair[1]))).collect(),
    }
}

/// N2: the state N1 with a damper of 0.5 N s/m. For one degree of freedom the intrinsic operator is the equation of the
/// crank angle p, (5/3) p'' + c1 sin(p/2)^2 p' + V'(p) = 0.
fn damped(undamped: &Case) -> Case {
    const C1: f64 = 0.5;
    let (p, rate) = (1.1f64, 2.5);
    let (sin, cos) = (0.5 * p).sin_cos();
    let bend = -2.0 * 9.81 * p.sin() + 100.0 * sin * sin - 100.0 * (2.0 * cos - 2f64.sqrt()) * 0.5 * cos;
    let [stiffness, damping] = [(bend + C1 * sin * cos * rate) / (5.0 / 3.0), C1 * sin * sin / (5.0 / 3.0)];
    let root = Complex::new(damping * damping / 4.0 - stiffness, 0.0).sqrt();
    Case {
        name: "four_bar N2",
        title: "four-bar linkage in motion, damped",
        is_equilibrium: false,
        system: Box::new(FourBar { l0: 2f64.sqrt(), c1: C1 }),
        q: undamped.q.clone(),
        v: undamped.v.clone(),
        known: vec![root - damping / 2.0, -root - damping / 2.0],
    }
}

impl Case {
    pub fn variation(&self) -> Variation<'_> {
        Variation::new(self.system.as_ref(), 0.0, &self.q, &self.v).unwrap_or_else(|error| panic!("{error}"))
    }

    /// In the intrinsic chart, where the method has one; none where it breaks down.
    pub fn model(&self, variation: &mut Variation, method: &str) -> Option<LinearModel> {
        let method = MethodSpec::parse(method).unwrap_or_else(|error| panic!("{error}"));
        variation.linearize(&Linear { method, chart: Some(Chart::Intrinsic) }).ok()
    }

    /// Relative error of the physical eigenvalues, each known one against the nearest that is left.
    pub fn error(&self, model: &LinearModel) -> Option<f64> {
        let mut left: Vec<Complex<f64>> =
            model.modes.iter().filter(|mode| mode.kind == Kind::Physical).map(|mode| mode.value).collect();
        let scale = self.known.iter().map(|value| value.norm()).fold(0.0, f64::max);
        let mut worst = 0.0f64;
        for known in &self.known {
            let distance = |value: &Complex<f64>| (value - known).norm();
            let nearest = (0..left.len()).min_by(|&i, &j| distance(&left[i]).total_cmp(&distance(&left[j])))?;
            worst = worst.max(distance(&left.remove(nearest)));
        }
        Some(worst / scale)
    }

    /// The error of a method; none where it breaks down.
    pub fn error_of(&self, method: &str) -> Option<f64> {
        let mut variation = self.variation();
        self.model(&mut variation, method).and_then(|model| self.error(&model))
    }
}
