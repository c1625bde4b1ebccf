//! Derivatives of outputs against differences.

use crate::scenes::differences::moved;
use holonom::system::{MechanicalSystem, OperatingPoint, OutputTangent, Scratch};
use nalgebra::DMatrix;

pub fn outputs(system: &dyn MechanicalSystem, at: OperatingPoint) -> Vec<f64> {
    let mut out = vec![0.0; system.facts().outputs.len()];
    system.outputs(at, &mut out, &mut Scratch::default());
    out
}

pub fn tangent(system: &dyn MechanicalSystem, at: OperatingPoint) -> OutputTangent {
    let n = system.dimensions();
    // What was there before does not count.
    let mut tangent = OutputTangent::new(system.facts().outputs.len(), n.v, n.lambda, system.facts().inputs.len());
    let OutputTangent { q, v, vdot, lambda, u, udot } = &mut tangent;
    [q, v, vdot, lambda, u, udot].into_iter().for_each(|m| m.fill(7.0));
    assert!(system.output_tangent(at, &mut tangent, &mut Scratch::default()));
    tangent
}

/// Of the sizes that errors are measured against: where an output and all its derivatives are zero, differences show the
/// round-off of what it is made of.
const FLOOR: f64 = 1.0;

/// Steps of the differences: the scales of length, of velocity and of stiffness of the scenes lie apart by many decades.
const STEPS: [f64; 5] = [1e-2, 2e-3, 4e-4, 8e-5, 1.6e-5];

/// d f/ds at zero: central differences of order four, for each value by the step after which it changes least.
pub fn slope(f: impl Fn(f64) -> Vec<f64>) -> Vec<f64> {
    let of_step = |h: f64| -> Vec<f64> {
        let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|i| f(i * h));
        (0..a.len()).map(|i| (a[i] - 8.0 * b[i] + 8.0 * c[i] - d[i]) / (12.0 * h)).collect()
    };
    let all = STEPS.map(of_step);
    let best = |i: usize| {
        let pairs = all.windows(2).map(|pair| ((pair[1][i] - pair[0][i]).abs(), pair[1][i]));
        pairs.min_by(|a, b| a.0.total_cmp(&b.0)).map_or(f64::NAN, |(_, slope)| slope)
    };
    (0..all[0].len()).map(best).collect()
}

fn unit(n: usize, i: usize) -> Vec<f64> {
    (0..n).map(|j| if i == j { 1.0 } else { 0.0 }).collect()
}

fn ahead(x: &[f64], direction: &[f64], s: f64) -> Vec<f64> {
    x.iter().zip(direction).map(|(x, d)| x + s * d).collect()
}

/// The derivatives along q, v, v' and lambda at a state agree with differences to `near` of the largest derivative of the
/// output or of its value.
pub fn check(system: &dyn MechanicalSystem, at: OperatingPoint, near: f64, what: &str) {
    let n = system.dimensions();
    let exact = tangent(system, at);
    let values = outputs(system, at);
    let names: Vec<String> = system.facts().outputs.iter().map(|column| column.name.clone()).collect();
    let compare = |kind: &str, matrix: &DMatrix<f64>, column: usize, slopes: Vec<f64>| {
        for (row, difference) in slopes.into_iter().enumerate() {
            let found = matrix[(row, column)];
            let scale = matrix.row(row).amax().max(values[row].abs()).max(FLOOR);
            let error = (found - difference).abs() / scale;
            assert!(error < near, "{what}: d {}/d{kind}{column} is {found}, {difference} by differences", names[row]);
        }
    };
    for j in 0..n.v {
        let e = unit(n.v, j);
        compare("q", &exact.q, j, slope(|s| outputs(system, OperatingPoint { q: &moved(system, at.q, &e, s), ..at })));
        compare("v", &exact.v, j, slope(|s| outputs(system, OperatingPoint { v: &ahead(at.v, &e, s), ..at })));
        compare(
            "v'",
            &exact.vdot,
            j,
            slope(|s| outputs(system, OperatingPoint { vdot: &ahead(at.vdot, &e, s), ..at })),
        );
    }
    for j in 0..n.lambda {
        let e = unit(n.lambda, j);
        compare(
            "lambda",
            &exact.lambda,
            j,
            slope(|s| outputs(system, OperatingPoint { lambda: &ahead(at.lambda, &e, s), ..at })),
        );
    }
    // What is no number would agree with nothing, and nothing would fail.
    assert!(values.iter().all(|value| value.is_finite()), "{what}: {values:?}");
}
