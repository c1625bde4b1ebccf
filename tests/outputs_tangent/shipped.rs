//! The outputs of every shipped scene, at its start and away from it.

use crate::outputs_tangent::compare::check;
use crate::scenes::differences::stirred;
use crate::scenes::{load, models};
use holonom::formulation::Dynamics;
use holonom::system::{MechanicalSystem, OperatingPoint};

/// All agree to 2e-10 but the energy of the stiffest beam (EA = 1e7 N) at rest: it is a square of 1e7 about zero, and its
/// differences have errors of 3e-9.
const NEAR: f64 = 1e-8;

#[test]
fn outputs_of_shipped_scenes() {
    let mut found = Vec::new();
    for path in models() {
        let scene = load(&path, &[]);
        let system = scene.system();
        let start = scene.start();
        let what = scene.0.name.clone();
        if system.facts().outputs.is_empty() {
            continue;
        }
        let still = vec![0.0; start.v.len()];
        // A reaction that symmetry makes zero would put its size on the tip of a cone, where there is no slope.
        let lambda = stirred(&start.lambda, 0.5);
        let at = OperatingPoint { t: 0.0, q: &start.q, v: &start.v, vdot: &still, lambda: &lambda };
        check(system, at, NEAR, &format!("{what} at its start"));
        // Elastic coordinates that are zero, but move.
        let v = stirred(&start.v, 0.5);
        check(system, OperatingPoint { v: &v, ..at }, NEAR, &format!("{what} started off"));
        check_moved(system, &start.q, &start.v, &what);
        found.push(what);
    }
    assert!(found.len() > 20, "{found:?}");
}

/// Off the start: no term is zero by accident, and the joints gape.
fn check_moved(system: &dyn MechanicalSystem, q: &[f64], v: &[f64], what: &str) {
    let mut q = stirred(q, 0.01);
    system.normalize(&mut q);
    let v = stirred(v, 0.5);
    let mut dynamics = Dynamics::new(system);
    dynamics.solve(0.1, &q, &v, |_, _| 0.0).unwrap();
    let at = OperatingPoint { t: 0.1, q: &q, v: &v, vdot: &dynamics.vdot, lambda: &dynamics.lambda };
    check(system, at, NEAR, &format!("{what} stirred"));
}
