//! K and C of every shipped scene against central differences of the residual r = M v' + G^T lambda - f.

use crate::scenes::differences::stirred;
use holonom::formulation::Dynamics;
use holonom::prepared::Model;
use holonom::system::OperatingPoint;
use std::path::Path;

fn check(prepared: &Model) {
    let system = prepared.system();
    let (q, v) = prepared.start();
    let t = 0.1;
    let mut q = stirred(q, 0.01);
    system.normalize(&mut q);
    let v = stirred(v, 0.5);
    let mut dynamics = Dynamics::new(system);
    dynamics.solve(t, &q, &v, |_, _| 0.0).unwrap();
    let at = OperatingPoint { t, q: &q, v: &v, vdot: &dynamics.vdot, lambda: &dynamics.lambda };
    crate::scenes::differences::check(system, at, &prepared.name);
}

#[test]
fn exact_derivatives_agree_with_differences() {
    let models = Path::new(env!("CARGO_MANIFEST_DIR")).join("models");
    let mut names: Vec<_> = std::fs::read_dir(models).unwrap().map(|entry| entry.unwrap().path()).collect();
    names.retain(|path| path.extension().is_some_and(|e| e == "json") && !path.to_string_lossy().contains("schema"));
    names.sort();
    assert!(names.len() >= 10);
    for path in names {
        check(&Model::load_with(&path, &Default::default()).unwrap());
    }
}
