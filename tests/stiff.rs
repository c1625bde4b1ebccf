//! bdf, and tr_bdf2, esdirk34 and a second bdf by diffsol: orders by tolerances, stiff motions, rotations, what they refuse; and a table beside others.

use crate::common::driven_pendulum::{DrivenPendulum, start};
use crate::common::stiff::{STIFF, slow_position};
use crate::common::{adaptive, distance, fixed, run, stepwise, until};
use crate::scenes::{Ready, parse, shipped};
use holonom::integrator::{IntegratorEntry, registry};
use holonom::prepared::Model;
use holonom::projection::registry as projections;
use holonom::scene::Scene;
use holonom::simulate::{Method, Span};
use holonom::system::{Dimensions, MechanicalSystem, Need, Scratch, Terms};
use std::time::Instant;

const END: f64 = 1.5;

fn implicit() -> impl Iterator<Item = &'static IntegratorEntry> {
    registry().iter().filter(|entry| ["bdf", "tr_bdf2", "esdirk34", "diffsol"].contains(&entry.name))
}

/// Every accepted triple.
fn triples() -> Vec<(&'static IntegratorEntry, &'static str, &'static str)> {
    let pairs = implicit().flat_map(|entry| entry.accepts().map(move |formulation| (entry, formulation)));
    let with = |(entry, formulation): (&'static IntegratorEntry, &'static str)| {
        let accepted = projections().iter().filter(|projection| !entry.refuses("index1", projection.name));
        accepted.map(move |projection| (entry, formulation, projection.name))
    };
    pairs.flat_map(with).collect()
}

/// Steps of the driven pendulum, and its rows at eight times.
fn solve(method: &Method) -> (u64, Vec<Vec<f64>>) {
    let (q, v) = start();
    let span = Span { output_step: END / 8.0, ..until(END) };
    let run = run(&DrivenPendulum, method, span, (&q, &v)).completed();
    (run.outcome.statistics.steps, run.record.trajectory.rows)
}

/// Euclidean norms of the errors of q, v and lambda over all rows.
fn errors(rows: &[Vec<f64>], reference: &[Vec<f64>]) -> [f64; 3] {
    [1..5, 5..9, 9..11].map(|columns| {
        let pairs = rows.iter().zip(reference);
        let squares = pairs.flat_map(|(row, exact)| columns.clone().map(move |i| (row[i] - exact[i]).powi(2)));
        squares.sum::<f64>().sqrt()
    })
}

/// Steps cannot be given: the order is the power of the mean step that the error falls with, from one tolerance to a
/// much tighter one. BDF has no order of its own: order 5 rules at tight tolerances, and the start, with steps of
/// lower orders, is a larger part of the steps at the looser one.
#[test]
fn every_triple_has_its_order() {
    let (_, reference) = solve(&adaptive("index1", "dop853", "exact", 1e-13));
    let triples = triples();
    // Four formulations: two methods with all projections, and two with none.
    assert_eq!(triples.len(), 56);
    for (entry, formulation, projection) in triples {
        let (coarse, fine, off) =
            if ["bdf", "diffsol"].contains(&entry.name) { (1e-6, 1e-11, 1.3) } else { (1e-5, 1e-9, 0.3) };
        // Gains that are no faster than the motion.
        let formulation = if formulation == "baumgarte" { "baumgarte:alpha=1" } else { formulation };
        let found = [coarse, fine].map(|tolerance| {
            let (steps, rows) = solve(&adaptive(formulation, entry.name, projection, tolerance));
            (steps as f64, errors(&rows, &reference))
        });
        for level in 0..3 {
            let order = (found[0].1[level] / found[1].1[level]).ln() / (found[1].0 / found[0].0).ln();
            let what = format!("{formulation} + {} + {projection}: order {order:.2}, {found:?}", entry.name);
            assert!((order - entry.order as f64).abs() < off, "{what}");
        }
    }
}

#[test]
fn ggl_holds_both_constraints_and_runs_repeat_bit_by_bit() {
    let (q, v) = start();
    for entry in implicit() {
        let drift = |formulation: &str| {
            let method = stepwise(formulation, entry.name, "none", 1e-6);
            let runs = [(); 2].map(|()| run(&DrivenPendulum, &method, until(END), (&q, &v)).completed());
            assert_eq!(runs[0].last(), runs[1].last());
            assert_eq!(runs[0].outcome.statistics, runs[1].outcome.statistics);
            runs[0].drift()
        };
        let ggl = drift("ggl");
        let index1 = drift("index1");
        // Newton's iteration ends a hundred times below the tolerance; index 1 drifts at it.
        assert!(ggl.0 < 3e-7 && ggl.1 < 1e-5, "{}: {ggl:?}", entry.name);
        assert!(index1.0 > 5e-7 && index1.1 > 2e-6, "{}: {index1:?}", entry.name);
    }
}

/// Rows within the steps are as good as the steps: those of a run with many rows are on the motion, too.
#[test]
fn rows_within_steps_are_on_the_motion() {
    let (q, v) = start();
    let span = Span { output_step: END / 300.0, ..until(END) };
    let rows = |method: &Method| run(&DrivenPendulum, method, span, (&q, &v)).completed().record.trajectory.rows;
    let reference = rows(&adaptive("index1", "dop853", "exact", 1e-13));
    for (entry, formulation, _) in triples().into_iter().filter(|triple| triple.2 == "none") {
        let found = rows(&adaptive(formulation, entry.name, "none", 1e-6));
        let worst = found.iter().zip(&reference).map(|(row, exact)| distance(&row[1..9], &exact[1..9]));
        let worst = worst.fold(0.0, f64::max);
        assert!(worst < 1e-3, "{} {formulation}: {worst:e}", entry.name);
    }
}

/// Where a driver leaves no free direction the error test of `ggl` sees nothing, and steps are as long as Newton's method
/// can take: rows between them, and the end of the run, follow from the constraints alone. A hundredth of the tolerance is what
/// Newton's method may leave of a row at the end of a step; the closed form is rounded at 1e-15.
#[test]
fn driven_mechanisms_are_as_accurate_as_asked_between_steps() {
    let ready = shipped("flexible_slider_crank_rigid", &[]);
    let l1 = 0.15f64;
    let l2 = 0.3f64;
    let omega = 150.0;
    for entry in implicit() {
        for tolerance in [1e-3, 1e-6, 1e-9] {
            let method = Method { rtol: tolerance, atol: 1e-3 * tolerance, ..adaptive("ggl", entry.name, "none", 1.0) };
            let run = ready.run(&method, ready.span());
            let worst = |name: &str, exact: &dyn Fn(f64) -> f64| {
                let rows = run.column("t").into_iter().zip(run.column(name));
                rows.map(|(t, found)| (found - exact(omega * t)).abs()).fold(0.0, f64::max)
            };
            let angle = |turn: f64| -(l1 * turn.sin() / l2).asin();
            let slider = |turn: f64| l1 * turn.cos() + l2 * angle(turn).cos();
            let off = worst("phi2", &angle).max(worst("x3", &slider));
            assert!(off < 1e-2 * tolerance + 1e-14, "{} {tolerance}: {off:e}", entry.name);
            let drift = run.record.drift.position.last;
            assert!(drift < 1e-2 * tolerance + 1e-14, "{} {tolerance}: {drift:e}", entry.name);
        }
    }
}

/// Two hundred steps where an explicit method needs ten million. BDF is here within its limits: at tighter tolerances it
/// takes orders above 2, which are not stable for a swing that nothing damps, and follows it.
#[test]
fn a_stiff_motion_is_stepped_over() {
    let ready = parse(STIFF);
    for (integrator, tolerance, most, off) in
        [("bdf", 1e-6, 200, 1e-4), ("tr_bdf2", 1e-6, 500, 3e-4), ("esdirk34", 1e-8, 600, 2e-5)]
    {
        for formulation in ["index1", "ggl"] {
            let run = ready.run(&stepwise(formulation, integrator, "none", tolerance), ready.span());
            let x = *run.column("x").last().unwrap();
            assert!((x - slow_position()).abs() < off, "{integrator} {formulation}: {x}");
            assert!(run.outcome.statistics.steps < most, "{integrator}: {:?}", run.outcome.statistics);
        }
    }
}

/// With damping the fast motion is one that BDF of any order is stable for.
#[test]
fn a_damped_stiff_motion_is_stepped_over_at_any_tolerance() {
    let scene = Scene::parse(STIFF, &[("damping".to_string(), 1e3.into())]).unwrap();
    let ready = Ready(Model::new(scene, &Default::default()).unwrap());
    for (tolerance, most) in [(1e-4, 100), (1e-6, 200), (1e-8, 500), (1e-10, 1500)] {
        for formulation in ["index1", "ggl"] {
            let run = ready.run(&stepwise(formulation, "bdf", "none", tolerance), ready.span());
            let error = (run.column("x").last().unwrap() - slow_position()).abs();
            // The force of the hard spring is rounded to 4e-8 N.
            assert!(error < 1e-7 + 100.0 * tolerance, "{formulation} {tolerance}: {error:e}");
            assert!(run.outcome.statistics.steps < most, "{formulation} {tolerance}: {:?}", run.outcome.statistics);
        }
    }
}

/// Quaternions: N is not the identity, and what returns them to unit length must not start BDF anew.
#[test]
fn rotations_in_space() {
    for (scene, column) in [("spinning_top", "nutation"), ("universal_shaft", "cardan_speed")] {
        let ready = shipped(scene, &[]);
        let exact = ready.run(&adaptive("index1", "dop853", "manifold", 1e-11), ready.span()).column(column);
        for entry in implicit() {
            for formulation in ["index1", "ggl"] {
                let run = ready.run(&stepwise(formulation, entry.name, "none", 1e-7), ready.span());
                let error = distance(&run.column(column), &exact);
                assert!(error < 1e-3, "{scene} {} {formulation}: {error:e}", entry.name);
                let most = if entry.name == "tr_bdf2" { 25_000 } else { 6_000 };
                assert!(run.outcome.statistics.steps < most, "{:?}", run.outcome.statistics);
            }
        }
    }
}

#[test]
fn redundant_constraints_are_dropped() {
    let ready = shipped("parallelogram_redundant", &[]);
    let outputs = |formulation: &str, integrator: &str| {
        let run = ready.run(&adaptive(formulation, integrator, "none", 1e-6), ready.span());
        run.record.trajectory.rows.last().unwrap().clone()
    };
    let reference = outputs("ggl", "radau_iia");
    for entry in implicit() {
        for formulation in entry.accepts() {
            let found = outputs(formulation, entry.name);
            let error = distance(&found, &reference) / distance(&reference, &vec![0.0; reference.len()]);
            // Of the tolerance of 1e-6; index1 drifts by as much again.
            assert!(error < 3e-5, "{} {formulation}: {error:e}", entry.name);
        }
    }
}

/// The driven pendulum without its K and C.
struct Plain;

impl MechanicalSystem for Plain {
    fn dimensions(&self) -> Dimensions {
        DrivenPendulum.dimensions()
    }

    fn evaluate(&self, t: f64, q: &[f64], v: &[f64], need: Need, terms: &mut Terms, scratch: &mut Scratch) {
        DrivenPendulum.evaluate(t, q, v, need, terms, scratch);
    }
}

#[test]
fn equations_without_derivatives_are_refused() {
    let (q, v) = start();
    for (entry, formulation, _) in triples().into_iter().filter(|triple| triple.2 == "none") {
        let run = run(&Plain, &adaptive(formulation, entry.name, "none", 1e-6), until(END), (&q, &v));
        let failure = run.outcome.failure.unwrap();
        assert!(failure.t == 0.0 && failure.reason.contains("need K and C"), "{}", failure.reason);
    }
}

/// Prints digits of the worst of `columns` at the end against work; `--nocapture` shows it.
fn compare(scene: &str, ready: &Ready, span: Span, columns: &[&str], steps: &[f64]) {
    let last =
        |run: &crate::scenes::Run| columns.iter().map(|name| *run.column(name).last().unwrap()).collect::<Vec<_>>();
    let reference = last(&ready.run(&adaptive("index1", "dop853", "manifold", 1e-13), span));
    let implicit = implicit().flat_map(|entry| {
        let projection = if entry.refuses("index1", "manifold") { "none" } else { "manifold" };
        [("index1", entry.name, projection), ("ggl", entry.name, "none")]
    });
    let methods = [("index1", "dop853", "manifold"), ("index2", "phem56", "manifold")].into_iter().chain(implicit);
    let adaptive =
        methods.flat_map(|(f, i, p)| [1e-4, 1e-6, 1e-8, 1e-10].map(|tolerance| stepwise(f, i, p, tolerance)));
    let fixed = steps.iter().map(|&step| fixed("index3", "generalized_alpha", "none", step));
    println!("\n{scene}\n{:34} accuracy digits   steps  evaluations  matrices  newton        ms", "method");
    for method in adaptive.chain(fixed) {
        let clock = Instant::now();
        let run = ready.run(&method, span);
        let ms = 1e3 * clock.elapsed().as_secs_f64();
        let s = run.outcome.statistics;
        println!(
            "{:34} {:>8} {:>6.1} {:>7} {:>12} {:>9} {:>7} {ms:>9.1}",
            format!("{} + {} + {}", method.formulation, method.integrator, method.projection),
            method.step.map_or(format!("{:.0e}", method.rtol), |step| format!("h={step:.0e}")),
            -distance(&last(&run), &reference).log10(),
            s.steps,
            s.rhs_evaluations,
            s.factorizations,
            s.newton_iterations,
        );
    }
}

/// Andrews' reference by dop853 is within 1e-10 of the test set's (tests/andrews.rs).
#[test]
fn a_table_of_work_and_accuracy() {
    let angles = ["beta", "Theta", "gamma", "Phi", "delta", "Omega", "epsilon"];
    compare("andrews, worst angle at 0.03 s", &shipped("andrews", &[]), until(0.03), &angles, &[1e-4, 1e-5]);
    compare("pendulum, x and y at 10 s", &shipped("pendulum", &[]), until(10.0), &["x", "y"], &[1e-2, 1e-3]);
}

/// Newton's method evaluates the powers before it moves the state, and is not continued for their sake: the work of the
/// solver was 2e-4 J off after 2 % of that had been done.
#[test]
fn the_work_is_that_of_the_motion() {
    let scene = shipped("quarter_car", &[]);
    for (integrator, tolerance) in [("esdirk34", 1e-8), ("tr_bdf2", 1e-6)] {
        let method = adaptive("index1", integrator, "none", tolerance);
        let run = run(scene.system(), &method, scene.span(), scene.0.start()).completed();
        let energy = run.record.energy.as_ref().unwrap();
        println!("{integrator}: {energy:?}");
        // Of 250 J turned over.
        assert!(energy.max_error < 250.0 * tolerance, "{integrator}: {energy:?}");
        // Between steps it is that of the solver from the step before on.
        let rows = run.record.ledger_rows.iter().map(|ledger| ledger.error.abs()).fold(0.0, f64::max);
        assert!(rows < 1e3 * tolerance, "{integrator}: {rows:e}");
    }
}

/// Methods by diffsol.
const BY_DIFFSOL: [(&str, &str); 4] =
    [("ggl", "tr_bdf2"), ("ggl", "esdirk34"), ("ggl", "diffsol:method=bdf"), ("index1", "tsit45")];

/// A chain of 1000 links has 10,000 unknowns in the rows of `ggl`; explicit methods say where it is.
#[test]
fn ten_thousand_unknowns() {
    let chain = parse(&holonom::scene::generate::chain(1000).to_string());
    let exact = chain.run(&adaptive("index1", "dop853", "manifold", 1e-10), until(2e-3));
    for (formulation, integrator) in BY_DIFFSOL {
        let run = chain.run(&adaptive(formulation, integrator, "none", 1e-5), until(2e-3));
        let [found, exact] = [&run, &exact].map(|run| run.record.trajectory.rows.last().unwrap()[1..2001].to_vec());
        let error = distance(&found, &exact);
        assert!(error < 1e-6, "{integrator}: {error:e}");
    }
}

/// A force that leaves its domain during the motion, and a start at which a row of G vanishes: errors with their cause.
#[test]
fn what_cannot_be_evaluated_is_named() {
    let scene = |force: &str, start: &str| {
        format!(
            r#"{{ "name": "bob", "dimension": 2, "ground": {{ "markers": {{ "O": [0, 0] }} }},
            "bodies": [{{ "name": "bob", "type": "point_mass", "mass": 1, "initial": {{ "position": {start}, "velocity": [0, 1] }} }}],
            "joints": [{{ "name": "rod", "type": "distance", "between": ["ground.O", "bob"], "length": 1 }}],
            "forces": [{{ "name": "push", "type": "applied_force", "at": "bob", "force": ["{force}", 0] }}],
            "simulation": {{ "t_end": 1 }} }}"#
        )
    };
    let ready = parse(&scene("sqrt(0.5 - t)", "[1, 0]"));
    for (formulation, integrator) in BY_DIFFSOL {
        let method = adaptive(formulation, integrator, "none", 1e-6);
        let outcome = run(ready.system(), &method, until(1.0), ready.0.start()).outcome;
        let failure = outcome.failure.unwrap_or_else(|| panic!("{integrator} ends at {}", outcome.t));
        let words = ["infinite or not a number", "no longer finite"];
        assert!(words.iter().any(|words| failure.reason.contains(words)), "{integrator}: {}", failure.reason);
        assert!((failure.t - 0.5).abs() < 1e-3, "{integrator}: {}", failure.t);
    }
}

/// Singular states: a run by diffsol passes them or says why it ends, and the rows before are kept.
#[test]
fn singular_states_end_no_run_without_a_word() {
    for name in ["slider_crank_singular", "slider_crank_singular_2", "bricard"] {
        let ready = shipped(name, &[]);
        for (formulation, integrator) in BY_DIFFSOL {
            let method = adaptive(formulation, integrator, "none", 1e-5);
            let run = run(ready.system(), &method, ready.span(), ready.0.start());
            let rows = &run.record.trajectory.rows;
            assert!(rows.iter().flatten().all(|x| x.is_finite()) && rows.len() > 1, "{name} {integrator}");
            if let Some(failure) = &run.outcome.failure {
                assert!(!failure.reason.is_empty() && !failure.hint.is_empty(), "{name} {integrator}: {failure:?}");
            }
        }
    }
}

/// tsit45 on every vector field, with every projection that does not close more than its steps leave: order 5 in q, v and
/// lambda, by the power of the mean step that the error falls with. Its leading error is small, so that of order 6 counts,
/// too: found 5.5 to 5.9.
#[test]
fn tsit45_has_order_5() {
    let entry = registry().iter().find(|entry| entry.name == "tsit45").unwrap();
    let (_, reference) = solve(&adaptive("index1", "dop853", "exact", 1e-13));
    for formulation in entry.accepts() {
        for projection in projections() {
            let found = [1e-7, 1e-11].map(|tolerance| {
                let gentle = crate::common::orders::gentle(formulation);
                let (steps, rows) = solve(&adaptive(&gentle, "tsit45", projection.name, tolerance));
                (steps as f64, errors(&rows, &reference))
            });
            for level in 0..3 {
                let order = (found[0].1[level] / found[1].1[level]).ln() / (found[1].0 / found[0].0).ln();
                assert!((4.7..6.2).contains(&order), "{formulation} + {}: {order:.2}, {found:?}", projection.name);
            }
        }
    }
}
