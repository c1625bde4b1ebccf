//! Shapes of flexible bodies against textbooks and against brute force.

mod crank;
mod errors;
mod frequencies;
mod integrals;
mod modal;
mod npy;
mod strains;

use super::eigen::{Modes, dense};
use super::integrals::mass_matrix;
use super::{Elastic, FlexibleBeam, Piece, elastic_beam};
use crate::body::{Build, MarkerTable, cross};
use crate::error::Result;
use crate::math::array::from_fn;
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
        outputs: &(),
        gravity: [0.0; D],
        folder: std::path::Path::new(""),
        switches: &Default::default(),
        turnings: &Default::default(),
    };
    elastic_beam(&beam, markers, &build).map(|(elastic, _)| elastic)
}

/// Keys of a beam of length 1.5 with all numbers different, changed by `more`.
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

/// A beam in space, with two bending stiffnesses.
fn beam_in_space(more: Value) -> Value {
    let mut space = json!({
        "stiffness": { "EA": 2e4, "EI": [5.0, 3.0], "GA": [900.0, 700.0], "GJ": 2.0 },
        "inertia": { "rhoA": 0.8, "rhoI": [2e-3, 1e-3] },
    });
    space.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
    beam(space)
}

/// All the mass in one piece, with points of the sections displaced to first order.
fn whole<const D: usize>(elastic: &Elastic<D>) -> Piece<D> {
    let n = 1 + elastic.names.len();
    let mut sum = Piece { dofs: (1..n).map(|i| i - 1).collect(), ..Piece::default() };
    (sum.moments, sum.products) = (vec![[0.0; D]; n], vec![[[0.0; D]; D]; n * n]);
    let in_whole = |dofs: &[usize]| std::iter::once(0).chain(dofs.iter().map(|dof| dof + 1)).collect::<Vec<_>>();
    for piece in &elastic.inertia.pieces {
        let places = in_whole(&piece.dofs);
        sum.mass += piece.mass;
        for (a, &i) in places.iter().enumerate() {
            (0..D).for_each(|k| sum.moments[i][k] += piece.moments[a][k]);
            for (b, &j) in places.iter().enumerate() {
                add(&mut sum.products[i * n + j], &piece.products[a * places.len() + b]);
            }
        }
    }
    for disc in &elastic.inertia.discs {
        let half = (0..3).map(|k| disc.inertia[k][k]).sum::<f64>() / 2.0;
        for (axis, square) in (0..3).map(|k| (k, half - disc.inertia[k][k])) {
            // Points at distance one along an axis, whose mass is `square` and whose moment is zero.
            let unit: [f64; 3] = from_fn(|k| if k == axis { 1.0 } else { 0.0 });
            let psi = std::iter::once(unit).chain(disc.rotation.iter().map(|turn| cross(turn, &unit)));
            let psi: Vec<[f64; 3]> = psi.collect();
            let places = in_whole(&disc.dofs);
            for ((i, left), (j, right)) in
                places.iter().zip(&psi).flat_map(|x| places.iter().zip(&psi).map(move |y| (x, y)))
            {
                add(&mut sum.products[i * n + j], &from_fn(|k| from_fn(|m| square * left[k] * right[m])));
            }
        }
    }
    sum
}

fn add<const D: usize>(sum: &mut [[f64; D]; D], more: &[[f64; D]; D]) {
    sum.iter_mut().flatten().zip(more.as_flattened()).for_each(|(sum, x)| *sum += x);
}

/// Mass and stiffness of the elastic coordinates whose names `keep` accepts.
fn matrices<const D: usize>(elastic: &Elastic<D>, keep: impl Fn(&str) -> bool) -> (Mat<f64>, Mat<f64>) {
    let n = elastic.names.len();
    let kept: Vec<usize> = (0..n).filter(|&i| keep(&elastic.names[i])).collect();
    let part = |full: Mat<f64>| Mat::from_fn(kept.len(), kept.len(), |i, j| full[(kept[i], kept[j])]);
    (part(dense(n, &mass_matrix(&elastic.inertia))), part(dense(n, &elastic.stiffness)))
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
