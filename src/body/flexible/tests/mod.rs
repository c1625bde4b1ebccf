//! Shapes of flexible bodies against textbooks and against brute force.

mod crank;
mod errors;
mod frequencies;
mod integrals;
mod modal;
mod npy;
mod strains;

use super::eigen::{Modes, dense};
use super::{Elastic, FlexibleBeam, elastic_beam, mass_matrix};
use crate::body::{Build, MarkerTable};
use crate::error::Result;
use crate::math::expression::{Number, Parameters};
use faer::Mat;
use serde_json::{Value, json};

/// A beam with parameters `l` = 1.5, `n` = 2.
fn build<const D: usize>(scene: &Value, markers: &[f64]) -> Result<Elastic<D>> {
    let beam: FlexibleBeam = serde_json::from_value(scene.clone()).unwrap();
    let given = [("l", 1.5), ("n", 2.0)].map(|(name, value)| (name.to_string(), Number::Value(value)));
    let parameters = Parameters::resolve(&given, &[]).unwrap();
    let table = MarkerTable::default();
    let build = Build {
        parameters: &parameters,
        markers: &table,
        outputs: &[],
        gravity: [0.0; D],
        folder: std::path::Path::new(""),
        switches: &Default::default(),
        turnings: &Default::default(),
    };
    elastic_beam(&beam, markers, &build).map(|(elastic, _)| elastic)
}

/// The scene's words for a beam of length 1.5 with all different numbers, changed by `more`.
fn beam(more: Value) -> Value {
    let mut beam = json!({
        "frame": "floating", "length": "l", "elements": 4,
        "stiffness": { "EA": 2e4, "EI": 3.0 }, "inertia": { "rhoA": 0.8, "rhoI": 1e-3 },
    });
    for (key, value) in more.as_object().unwrap() {
        match value {
            Value::Null => beam.as_object_mut().unwrap().remove(key),
            _ => beam.as_object_mut().unwrap().insert(key.clone(), value.clone()),
        };
    }
    beam
}

/// In space, with two bending stiffnesses.
fn beam_in_space(more: Value) -> Value {
    let mut space = json!({
        "stiffness": { "EA": 2e4, "EI": [5.0, 3.0], "GA": [900.0, 700.0], "GJ": 2.0 },
        "inertia": { "rhoA": 0.8, "rhoI": [2e-3, 1e-3] },
    });
    space.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
    beam(space)
}

/// Mass and stiffness of the elastic coordinates whose names `keep` accepts.
fn matrices<const D: usize>(elastic: &Elastic<D>, keep: impl Fn(&str) -> bool) -> (Mat<f64>, Mat<f64>) {
    let n = elastic.names.len();
    let kept: Vec<usize> = (0..n).filter(|&i| keep(&elastic.names[i])).collect();
    let part = |full: Mat<f64>| Mat::from_fn(kept.len(), kept.len(), |i, j| full[(kept[i], kept[j])]);
    (part(dense(n, &mass_matrix(&elastic.pieces))), part(dense(n, &elastic.stiffness)))
}

/// Angular frequencies, ascending, rad/s.
fn frequencies<const D: usize>(elastic: &Elastic<D>, keep: impl Fn(&str) -> bool) -> Vec<f64> {
    let (mass, stiffness) = matrices(elastic, keep);
    let modes = Modes::of(stiffness.as_ref(), mass.as_ref()).unwrap();
    modes.squares.iter().map(|square| square.sqrt()).collect()
}

#[track_caller]
fn assert_close(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found} instead of {expected}, off by {:e}", found - expected);
}
