//! K and C of every shipped scene against central differences of the residual r = M v' + G^T lambda - f.

use holonom::formulation::Dynamics;
use holonom::study::Study;
use holonom::system::{Loaded, MechanicalSystem, Need, Scratch, Tangent, Terms};
use std::path::Path;

/// r at (q, v) with v' and lambda held.
fn residual(system: &dyn MechanicalSystem, t: f64, q: &[f64], v: &[f64], vdot: &[f64], lambda: &[f64]) -> Vec<f64> {
    let (mut terms, mut scratch, structure) = (Terms::new(system), Scratch::default(), system.structure());
    system.evaluate(t, q, v, Need::DYNAMICS, &mut terms, &mut scratch);
    let mut r: Vec<f64> = terms.f.iter().map(|f| -f).collect();
    structure.mass.multiply_symmetric(&terms.mass, vdot, &mut r);
    structure.g.multiply_transposed(&terms.g, lambda, &mut r);
    r
}

fn dense(pattern: &holonom::math::kkt::Pattern, values: &[f64], column: usize) -> Vec<f64> {
    let mut unit = vec![0.0; pattern.cols];
    unit[column] = 1.0;
    let mut product = vec![0.0; pattern.rows];
    pattern.multiply(values, &unit, &mut product);
    product
}

/// A deterministic stir of the state, so that no term is zero by accident.
fn stirred(values: &[f64], size: f64) -> Vec<f64> {
    values.iter().enumerate().map(|(i, x)| x + size * (1.0 + 2.3 * i as f64).sin()).collect()
}

fn check(study: &Study) {
    let system = study.system();
    let (q, v) = study.start();
    let t = 0.1;
    let mut q = stirred(q, 0.01);
    system.normalize(&mut q);
    let v = stirred(v, 0.5);
    let mut dynamics = Dynamics::new(system);
    dynamics.solve(t, &q, &v, |_, _| 0.0).unwrap();
    let (vdot, lambda) = (dynamics.vdot.clone(), dynamics.lambda.clone());
    let pattern = system.structure().tangent;
    let mut tangent = Tangent::new(&pattern);
    let at = Loaded { t, q: &q, v: &v, vdot: &vdot, lambda: &lambda };
    assert!(system.tangent(at, &mut tangent, &mut Scratch::default()));
    let h = 1e-6;
    for j in 0..v.len() {
        let mut direction = vec![0.0; v.len()];
        direction[j] = 1.0;
        let mut rate = vec![0.0; q.len()];
        system.rate(&q, &direction, &mut rate);
        let along = |s: f64| -> Vec<f64> { q.iter().zip(&rate).map(|(q, r)| q + s * r).collect() };
        let faster = |s: f64| -> Vec<f64> { v.iter().zip(&direction).map(|(v, d)| v + s * d).collect() };
        let r = |q: &[f64], v: &[f64]| residual(system, t, q, v, &vdot, &lambda);
        let k = (r(&along(h), &v), r(&along(-h), &v));
        let c = (r(&q, &faster(h)), r(&q, &faster(-h)));
        for (name, values, (plus, minus)) in [("K", &tangent.k, k), ("C", &tangent.c, c)] {
            let exact = dense(&pattern, values, j);
            // Differences with h = 1e-6 lose ten digits of the largest force, reactions included.
            let scale = plus.iter().chain(&exact).chain(&lambda).fold(1.0f64, |s, x| s.max(x.abs()));
            for (i, exact) in exact.iter().enumerate() {
                let difference = (plus[i] - minus[i]) / (2.0 * h);
                let error = (difference - exact).abs();
                assert!(error < 3e-8 * scale, "{} {name}[{i},{j}]: {exact} against {difference}", study.name);
            }
        }
    }
}

#[test]
fn exact_derivatives_agree_with_differences() {
    let models = Path::new(env!("CARGO_MANIFEST_DIR")).join("models");
    let mut names: Vec<_> = std::fs::read_dir(models).unwrap().map(|entry| entry.unwrap().path()).collect();
    names.retain(|path| path.extension().is_some_and(|e| e == "json") && !path.to_string_lossy().contains("schema"));
    names.sort();
    assert!(names.len() >= 10);
    for path in names {
        check(&Study::load(&path, &Default::default()).unwrap());
    }
}
