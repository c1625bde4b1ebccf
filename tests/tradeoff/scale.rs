//! What errors are relative to, and where they are looked for.

use super::{filter, measured, motion, plan, span};
use crate::scenes::shipped;
use holonom::analysis::Sizes;
use holonom::simulate::Method;
use holonom::study::{ErrorMetric, Motion};
use holonom::system::Column;
use std::time::Duration;

/// The energy of the pendulum and of the strip is zero at a level start and stays so; the beam of the parallelogram never
/// tilts. Round-off of these is no error of the motion.
#[test]
fn outputs_that_are_zero_by_physics_spoil_nothing() {
    for (name, end, digits) in
        [("pendulum", 3.0, 8), ("modal_link", 0.2, 6), ("parallelogram", 1.0, 6), ("bricard", 1.0, 6)]
    {
        let scene = shipped(name, &[]);
        let plan = plan(&filter(&["index1"], &["dopri5", "dop853"], &["manifold"]), 60_000);
        let result = measured(motion(&scene, end), &plan, &[]);
        let reference = result.reference.as_ref().unwrap();
        assert!(result.recommend(digits).is_some(), "{name}: {:e} in {}", reference.error, reference.worst);
    }
}

/// A pendulum of 2 kg and 3 m from rest at level: the force in the rod swings up to 3 m g, the kinetic energy to m g l.
#[test]
fn energies_are_compared_with_the_kinetic_and_forces_with_the_reactions() {
    let column = |name: &str, unit: &str| Column { name: name.to_string(), unit: unit.to_string() };
    let columns =
        [column("energy", "kJ"), column("force", "N"), column("x", "m"), column("y", "mm"), column("one", "")];
    let rows = vec![vec![5.0, 0.0, 2.0, 0.0, 1e-7], vec![5.0, 1.0, -4.0, 0.0, 0.0]];
    let still = ErrorMetric::new(&columns, rows.clone(), &Sizes::default());
    // Without a motion a quantity has its own size, but what is zero beside others of its kind: a thousandth of these.
    let off = vec![vec![5.5, 0.1, 2.4, 0.4, 2e-7], rows[1].clone()];
    let errors = still.errors(&off);
    for (error, expected) in errors.iter().zip([0.1, 0.1, 0.1, 0.1, 1.0]) {
        assert!((error - expected).abs() < 1e-12, "{errors:?}");
    }
    let scene = shipped("pendulum", &[]);
    let motion = motion(&scene, 3.0);
    let run = motion.run(&tight(), Duration::MAX);
    let kinetic = 9.81;
    let reaction = 3.0 * 9.81;
    let moving = ErrorMetric::new(&columns, rows.clone(), &run.unwrap().sizes);
    let errors = moving.errors(&off);
    // 1 kg and 1 m; 200 rows miss the lowest point by little.
    assert!((errors[0] - 500.0 / kinetic).abs() < 1e-3 * errors[0], "{errors:?}");
    assert!((errors[1] - 0.1 / reaction).abs() < 1e-3 * errors[1], "{errors:?}");
}

fn tight() -> Method {
    Method { rtol: 1e-13, atol: 1e-15, ..super::method("index1", "dop853", "manifold") }
}

/// The strut of the quarter car is damped: an error shows in the long steps after the bump, and nowhere else. With ten rows
/// a run of 6 digits was in fact off by 1e-4.
#[test]
fn recommended_runs_have_their_digits_between_the_rows() {
    let scene = shipped("quarter_car", &[]);
    let motion = motion(&scene, 2.5);
    let result = measured(motion.clone(), &plan(&filter(&["index1"], &["dopri5", "dop853"], &["none"]), 60_000), &[]);
    // Rows that are none of those compared.
    let between = Motion { span: span((0.0, 2.5), 1777), ..motion };
    let run = |method: &Method| between.run(method, Duration::MAX).unwrap();
    let exact = run(&tight());
    let exact = ErrorMetric::new(&between.watched.columns, exact.rows, &exact.sizes);
    for digits in [3, 6, 9] {
        let best = &result.cells[result.recommend(digits).unwrap().best];
        let (error, worst) = exact.error(&run(&best.method).rows);
        // Between 200 rows the largest error may be a little larger than at them.
        assert!(error < 1.5 * 0.1f64.powi(digits as i32), "{digits} digits: {error:e} in {worst}");
    }
}
