//! `linear-T.json`.

use super::Linear;
use crate::linearize::{Cost, Kind, LinearModel, Matrix, Mode};
use crate::report::cell;
use crate::tolerances::report as tolerances;
use serde::Serialize;
use serde_json::{Map, Value};

/// A linear model as it stands in the file; matrices by rows.
#[derive(Clone, Debug, Serialize)]
pub struct LinearFile {
    pub scene: String,
    pub t: f64,
    pub method: String,
    pub chart: String,
    pub states: Vec<String>,
    pub inputs: Vec<String>,
    pub outputs: Vec<String>,
    #[serde(rename = "A")]
    pub a: Vec<Vec<f64>>,
    #[serde(rename = "B")]
    pub b: Vec<Vec<f64>>,
    #[serde(rename = "C")]
    pub c: Vec<Vec<f64>>,
    #[serde(rename = "D")]
    pub d: Vec<Vec<f64>>,
    /// Of descriptor forms.
    #[serde(rename = "E", skip_serializing_if = "Option::is_none")]
    pub e: Option<Vec<Vec<f64>>>,
    pub eigenvalues: Vec<Eigenvalue>,
    pub equilibrium: bool,
    pub operating_point: OperatingPointFile,
    pub cost: Cost,
}

/// An eigenvalue; without numbers where it is infinite.
#[derive(Clone, Debug, Serialize)]
pub struct Eigenvalue {
    pub re: Option<f64>,
    pub im: Option<f64>,
    pub frequency_hz: Option<f64>,
    pub damping_ratio: Option<f64>,
    pub kind: Kind,
    /// Part of each state, from the largest.
    pub participation: Map<String, Value>,
}

/// The state that is perturbed, by names.
#[derive(Clone, Debug, Serialize)]
pub struct OperatingPointFile {
    pub q: Map<String, Value>,
    pub v: Map<String, Value>,
    pub vdot: Map<String, Value>,
    pub lambda: Map<String, Value>,
    pub norms: Norms,
    /// Where q and v are counted in axes that turn along.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steady_rotation: Option<Turn>,
}

/// Axes that turn at a constant speed.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Turn {
    /// rad/s
    pub speed: f64,
    /// Its direction.
    pub axis: [f64; 3],
    /// A point on it, m.
    pub point: [f64; 3],
}

/// Largest components; those of phi and phi' over their scales.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Norms {
    pub phi: f64,
    pub phi_dot: f64,
    pub v: f64,
    pub vdot: f64,
}

/// The name of a model's files without their ends: `linear-0.01`, and `linear-0.01-rcs-form-index2` where several methods
/// are asked for at a time.
pub fn linear_stem(t: f64, method: Option<&str>) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() || ['_', '.', '-'].contains(&c) { c } else { '-' };
    let end = method.map(|method| format!("-{}", method.chars().map(plain).collect::<String>()));
    format!("linear-{}{}", cell(t), end.unwrap_or_default())
}

impl Linear<'_> {
    /// The model as it stands in `linear-T.json`.
    pub fn file(&self) -> LinearFile {
        let model = self.model;
        LinearFile {
            scene: self.scene.to_string(),
            t: model.point.t,
            method: model.method.clone(),
            chart: model.chart.clone(),
            states: model.states.clone(),
            inputs: model.inputs.clone(),
            outputs: model.outputs.clone(),
            a: rows(&model.a),
            b: rows(&model.b),
            c: rows(&model.c),
            d: rows(&model.d),
            e: model.e.as_ref().map(rows),
            eigenvalues: model.modes.iter().map(|mode| eigenvalue(model, mode)).collect(),
            equilibrium: model.point.is_equilibrium,
            operating_point: self.point(),
            cost: model.cost,
        }
    }

    fn point(&self) -> OperatingPointFile {
        let point = &self.model.point;
        OperatingPointFile {
            q: named(&self.names.q, &point.q),
            v: named(&self.names.v, &point.v),
            vdot: named(&self.names.v, &point.vdot),
            lambda: named(&self.names.lambda, &point.lambda),
            norms: self.norms(),
            steady_rotation: point.axes.map(|spin| Turn {
                speed: spin.speed(),
                axis: spin.velocity.map(|w| w / spin.speed()),
                point: spin.point,
            }),
        }
    }

    pub(super) fn norms(&self) -> Norms {
        let point = &self.model.point;
        let largest = |values: &[f64]| values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        Norms { phi: point.phi, phi_dot: point.phi_dot, v: largest(&point.v), vdot: largest(&point.vdot) }
    }
}

fn rows(matrix: &Matrix) -> Vec<Vec<f64>> {
    matrix.row_iter().map(|row| row.iter().copied().collect()).collect()
}

fn named(names: &[String], values: &[f64]) -> Map<String, Value> {
    names.iter().zip(values).map(|(name, value)| (name.clone(), Value::from(*value))).collect()
}

fn eigenvalue(model: &LinearModel, mode: &Mode) -> Eigenvalue {
    let is_finite = mode.kind != Kind::Infinite && mode.value.re.is_finite() && mode.value.im.is_finite();
    let finite = |value: f64| is_finite.then_some(value);
    let parts = largest_parts(&model.states, &mode.participation).into_iter();
    let parts = parts.filter(|(_, part)| *part >= tolerances::PART_OF_MODE);
    Eigenvalue {
        re: finite(mode.value.re),
        im: finite(mode.value.im),
        frequency_hz: finite(mode.frequency()),
        damping_ratio: finite(mode.damping()),
        kind: mode.kind,
        participation: parts.map(|(name, part)| (name.to_string(), Value::from(part))).collect(),
    }
}

/// States with their parts, from the largest; equal ones in their order.
fn largest_parts<'a>(states: &'a [String], parts: &[f64]) -> Vec<(&'a str, f64)> {
    let mut named: Vec<(&str, f64)> = states.iter().map(String::as_str).zip(parts.iter().copied()).collect();
    named.sort_by(|a, b| b.1.total_cmp(&a.1));
    named
}
