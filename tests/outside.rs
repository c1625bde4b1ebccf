//! A formulation, an integrator and a projection from outside the crate: each an `Entry` of its own, chosen by `spec()`.
//! Two of them are those of `examples`: here they keep their orders.

use crate::common::driven_pendulum::{DrivenPendulum, start};
use crate::common::orders::{self, END, Rows};
use crate::common::{fixed, run, until};
use crate::examples::own_formulation::BRAKED;
use crate::examples::own_integrator::MIDPOINT;
use holonom::analysis::Recorder;
use holonom::formulation::{self, Dae, DaeRow};
use holonom::method_spec::{Listed, MethodSpec};
use holonom::projection;
use holonom::simulate::{Method, Span, simulate};

/// phi = 0 and phi'' = 0 together, q' = N (v + u): Gear, Gupta and Leimkuhler on the level of the accelerations.
static ROWS: formulation::FormulationEntry = formulation::FormulationEntry {
    name: "ggl_of_accelerations",
    about: "phi = 0 and phi'' = 0 together",
    options: &[],
    dae: Some(|_| Ok(Dae { mu: Some(DaeRow::POSITION), ..Dae::with(DaeRow::ACCELERATION) })),
    field: None,
};

/// The one of the crate under another name.
static PROJECTION: projection::ProjectionEntry = projection::ProjectionEntry {
    name: "closed",
    about: "positions and velocities to round-off",
    options: &[],
    make: |_, system| projection::make(&MethodSpec::named("exact"), system),
};

fn solution(method: &Method) -> (Rows, (f64, f64)) {
    let (q, v) = start();
    let span = Span { output_step: END / 8.0, ..until(END) };
    let run = run(&DrivenPendulum, method, span, (&q, &v)).completed();
    let drift = run.drift();
    (run.record.trajectory.rows, drift)
}

/// Order in q, v and lambda, as in tests/orders.rs, and the larger drift.
fn check(order: f64, [coarse, fine]: [usize; 2], method: impl Fn(f64) -> Method) -> (f64, f64) {
    let reference = solution(&fixed("index1", "dop853", "exact", END / 160.0)).0;
    let (found, drift) = solution(&method(END / coarse as f64));
    let (finer, _) = solution(&method(END / fine as f64));
    for (name, columns) in [("q", 1..5), ("v", 5..9), ("lambda", 9..11)] {
        let errors = [&found, &finer].map(|rows| orders::error(rows, &reference, &columns));
        let observed = (errors[0] / errors[1]).ln() / (fine as f64 / coarse as f64).ln();
        let triple = method(1.0).triple();
        assert!((observed - order).abs() < 0.3, "{triple}: order {observed:.2} in {name}, {errors:?}");
    }
    drift
}

#[test]
fn implicit_integrators_solve_the_rows_of_a_formulation_from_outside() {
    for (integrator, order, steps) in [("radau_iia", 5.0, [64, 128]), ("generalized_alpha", 2.0, [128, 256])] {
        let of = |step: f64| Method { formulation: ROWS.spec(), ..fixed("", integrator, "none", step) };
        let (position, velocity) = check(order, steps, of);
        // phi is solved, to a few units in the last place of squared lengths; phi' is not, and drifts.
        assert!(position < 8.0 * f64::EPSILON && velocity > 1e-12, "{integrator}: {position:e} {velocity:e}");
    }
}

#[test]
fn explicit_integrators_follow_a_field_from_outside() {
    let formulation = BRAKED.spec().with("rate", "2");
    check(4.0, [128, 256], |step| Method { formulation: formulation.clone(), ..fixed("", "rk4", "none", step) });
}

#[test]
fn all_three_parts_may_come_from_outside() {
    let of = |step: f64| Method {
        formulation: BRAKED.spec(),
        integrator: MIDPOINT.spec(),
        projection: PROJECTION.spec(),
        ..fixed("", "", "", step)
    };
    let (position, velocity) = check(2.0, [128, 256], of);
    // As of `exact` in tests/orders.rs.
    assert!(position < 4.0 * f64::EPSILON && velocity < 4.0 * f64::EPSILON, "{position:e} {velocity:e}");
}

/// Pairs and options are checked as those of the crate are.
#[test]
fn what_does_not_go_together_is_refused() {
    let (q, v) = start();
    let refused = |method: &Method| {
        let mut recorder = Recorder::new(&DrivenPendulum);
        let run = simulate(&DrivenPendulum, method, until(END), (&q, &v), &mut recorder);
        run.map(|_| ()).unwrap_err().to_string()
    };
    let pair = refused(&Method { formulation: ROWS.spec(), ..fixed("", "rk4", "none", 0.1) });
    assert!(pair.contains("rk4 cannot integrate ggl_of_accelerations"), "{pair}");
    let option = refused(&Method { formulation: BRAKED.spec().with("rat", "2"), ..fixed("", "rk4", "none", 0.1) });
    assert!(option.contains("formulation braked has no option `rat`"), "{option}");
    let unknown = refused(&Method { formulation: MethodSpec::named("braked"), ..fixed("", "rk4", "none", 0.1) });
    assert!(unknown.contains("there is no formulation `braked`"), "{unknown}");
}

/// A saved run names its method, and goes on with the entry that the method brings along.
#[test]
fn a_saved_run_goes_on_with_it() {
    let (q, v) = start();
    let method = Method { formulation: ROWS.spec(), ..fixed("", "radau_iia", "none", END / 40.0) };
    let span = Span { output_step: END / 7.0, ..until(END) };
    assert!(!crate::common::saved::differs(&DrivenPendulum, &method, span, (&q, &v)));
}
