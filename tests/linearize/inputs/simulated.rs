//! Transfer functions against simulated oscillations, fitted after the transient.

use super::{C, changed, response, shaken, variation};
use crate::linearize::models::model;
use crate::scenes::{Ready, Run};
use nalgebra::{DMatrix, DVector};
use serde_json::{Value, json};
use std::f64::consts::TAU;

/// The factor H of y = y0 + Im(H a e^(s t)), by least squares over the last `span` s.
fn fitted(run: &Run, output: &str, (frequency, amplitude): (f64, f64), span: f64) -> C {
    let times = run.times();
    let values = run.column(output);
    let from = times[times.len() - 1] - span;
    let rows: Vec<usize> = (0..times.len()).filter(|&i| times[i] >= from).collect();
    let angle = |i: usize| TAU * frequency * times[rows[i]];
    let basis = DMatrix::from_fn(rows.len(), 3, |i, j| [1.0, angle(i).sin(), angle(i).cos()][j]);
    let values = DVector::from_fn(rows.len(), |i, _| values[rows[i]]);
    let found = basis.svd(true, true).solve(&values, 0.0).unwrap();
    C::new(found[1], found[2]) / amplitude
}

/// Runs a scene whose input oscillates, three periods beyond `settled` s, and compares outputs with the model.
fn compare(
    scene: impl Fn(&str) -> Ready,
    outputs: &[&str],
    (frequency, amplitude): (f64, f64),
    settled: f64,
    limit: f64,
) {
    let still = scene("0");
    let names: Vec<String> = still.system().facts().outputs.iter().map(|column| column.name.clone()).collect();
    let model = model(&mut variation(&still), "mcs", None);
    let end = settled + 3.0 / frequency;
    let run = scene(&format!("{amplitude}*sin(2*pi*{frequency}*t)")).tight(1e-11, end, 0.02 / frequency);
    for output in outputs {
        let row = names.iter().position(|name| name == output).unwrap();
        let exact = response(&model, (row, 0), frequency);
        let off = (fitted(&run, output, (frequency, amplitude), 3.0 / frequency) - exact).norm() / exact.norm();
        println!("{output} at {frequency} Hz: {off:.1e}");
        assert!(off < limit, "{output} at {frequency} Hz: {off:e}");
    }
}

fn road(json: &mut Value, value: &str) {
    json["inputs"] = json!([{ "name": "road", "tyre": "tyre", "value": value }]);
    json["parameters"]["bump"] = 0.into();
}

#[test]
fn a_driven_base_oscillates_as_its_model_says() {
    for frequency in [0.5, 1.9, 7.0] {
        let scene = |value: &str| shaken("0", &format!(r#", "value": "{value}""#));
        compare(scene, &["x", "force"], (frequency, 0.1), 22.0, 1e-7);
    }
}

#[test]
fn a_quarter_car_oscillates_as_its_model_says() {
    for frequency in [0.6, 1.4, 12.0] {
        let scene = |value: &str| changed("quarter_car", |json| road(json, value));
        compare(scene, &["body_height", "tyre_load"], (frequency, 0.01), 9.0, 1e-7);
    }
}

/// Small oscillations: what is left falls with the amplitude.
#[test]
fn a_five_link_suspension_oscillates_as_its_model_says() {
    for frequency in [1.4, 9.0] {
        let scene = |value: &str| {
            changed("five_link_suspension", |json| {
                road(json, value);
                json["parameters"]["dip"] = 0.into();
            })
        };
        let outputs = ["chassis_height", "camber", "tyre_force", "rod4_force"];
        compare(scene, &outputs, (frequency, 1e-5), 6.5, 1e-5);
    }
}
