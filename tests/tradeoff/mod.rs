//! Speed for accuracy: what is measured is what runs give, and what is recommended is the best of it.

mod advice;
mod models;
mod reference;
mod scale;

use crate::common::{method, readings};
use crate::scenes::{Ready, shipped};
use holonom::simulate::{Method, Span};
use holonom::study::work_precision::{
    Cell, Filter, Outcome, Runner, TradeoffPlan, WorkPrecision, cheapest_by_method, grid,
};
use holonom::study::{Motion, RunSample, Watched};
use std::time::Duration;

pub const ROWS: usize = 200;

pub fn motion(scene: &Ready, end: f64) -> Motion<'_> {
    let ratio = scene.0.method.atol / scene.0.method.rtol;
    let start = scene.0.start_time();
    Motion {
        system: scene.system(),
        start: scene.0.start(),
        span: span((start, end), ROWS),
        watched: Watched::new(scene.system(), &[]).unwrap(),
        ratio,
        counts_start: false,
        is_stopped: &|| false,
    }
}

pub fn span((start, end): (f64, f64), rows: usize) -> Span {
    Span { start, end, output_step: (end - start) / rows as f64 }
}

/// The same motion, in these outputs.
pub fn watching<'a>(motion: Motion<'a>, outputs: &[&str]) -> Motion<'a> {
    let outputs: Vec<String> = outputs.iter().map(|name| name.to_string()).collect();
    Motion { watched: Watched::new(motion.system, &outputs).unwrap(), ..motion }
}

pub fn filter(formulations: &[&str], integrators: &[&str], projections: &[&str]) -> Filter {
    let choices =
        |names: &[&str]| names.iter().map(|name| holonom::method_spec::MethodSpec::parse(name).unwrap()).collect();
    let formulations = choices(formulations);
    let integrators = choices(integrators);
    Filter { formulations, integrators, projections: choices(projections) }
}

/// Within a budget of so many steps and rows.
pub fn plan(filter: &Filter, budget: u32) -> TradeoffPlan {
    TradeoffPlan {
        triples: grid(filter).unwrap(),
        budget: readings(budget),
        repeats: 3,
        rows: ROWS,
        digits: 6,
        is_exhaustive: false,
        given: None,
    }
}

pub fn fresh(motion: &Motion) -> WorkPrecision {
    WorkPrecision::fresh("test", motion.span.start, motion.span.end, ROWS)
}

pub fn measured(motion: Motion, plan: &TradeoffPlan, outputs: &[&str]) -> WorkPrecision {
    let mut result = fresh(&motion);
    Runner::new(watching(motion, outputs), plan, |_, _| ()).run(&mut result).unwrap();
    result
}

pub fn run(motion: &Motion, outputs: &[&str], method: &Method) -> RunSample {
    watching(motion.clone(), outputs).run(method, Duration::MAX).unwrap()
}

/// x1 = 0.1 cos 5t: the errors that are told are those against the closed form.
#[test]
fn errors_are_those_against_the_closed_form() {
    let scene = shipped("two_mass", &[]);
    let motion = motion(&scene, 5.0);
    let result = measured(
        motion.clone(),
        &plan(&filter(&["index1", "ggl"], &["rk4", "dopri5", "radau_iia"], &[]), 400_000),
        &["x1"],
    );
    let reference = result.reference.as_ref().unwrap();
    let exact = |row: usize| 0.1 * (5.0 * 5.0 * row as f64 / ROWS as f64).cos();
    let largest = (1..=ROWS).fold(0.0f64, |most, row| most.max(exact(row).abs()));
    let error = |rows: &[Vec<f64>]| {
        rows.iter().zip(1..).fold(0.0f64, |most, (row, k)| most.max((row[0] - exact(k)).abs() / largest))
    };
    // 25 radians at rtol 1e-13, and twice that since two runs of it differ.
    assert!(reference.is_independent && reference.error < 1e-11, "{} {}", reference.checked_by, reference.error);
    assert!(error(&reference.values.rows) < 1e-11);
    let completed: Vec<&Cell> = result.cells.iter().filter(|cell| cell.reason().is_none()).collect();
    assert!(completed.len() > 15, "{}", completed.len());
    for cell in completed {
        let told = cell.error().unwrap();
        let own = error(&run(&motion, &["x1"], &cell.method).rows);
        // What is told has the reference's own error on top.
        assert!((told - own).abs() <= 2e-11 + 1e-6 * own, "{:?}: told {told:e}, is {own:e}", cell.method);
    }
}

/// The best has the digits, no other run that has them is cheaper beyond a tie, and the next is of another kind.
#[test]
fn recommendations_are_the_best_of_what_was_measured() {
    let scene = shipped("four_bar_spring", &[]);
    let result = measured(motion(&scene, 1.0), &plan(&filter(&["index1", "index2", "index3"], &[], &[]), 80_000), &[]);
    let all = result.recommendations();
    assert!(all.len() >= 6 && all.iter().zip(1..).all(|(advice, digits)| advice.digits == digits), "{all:?}");
    let cost = |place: usize| result.cells[place].cost.unwrap();
    let drift = |place: usize| result.cells[place].drift().unwrap().largest();
    for advice in all {
        let digits = f64::from(advice.digits);
        // What round-off lets be reached, one method may reach alone.
        let Some(next) = advice.next else {
            assert!(digits >= 11.0, "nothing next to the best for {digits} digits");
            continue;
        };
        let best = &result.cells[advice.best];
        let next = &result.cells[next];
        assert!(best.digits().unwrap() >= digits && next.digits().unwrap() >= digits);
        assert_ne!(best.method.integrator, next.method.integrator);
        let good = result.cells.iter().filter(|cell| cell.digits() >= Some(digits));
        let least = good.filter_map(|cell| cell.cost).fold(f64::INFINITY, f64::min);
        for place in [&[advice.best], &advice.ties[..]].concat() {
            assert!(cost(place) <= 1.15 * least);
            // By decades of drift; below 1e-12 it is round-off.
            assert!(drift(advice.best) <= 10.0 * drift(place).max(1e-12), "{} {}", drift(advice.best), drift(place));
        }
        assert!(cost(advice.next.unwrap()) >= least);
    }
    assert!(result.recommend(15).is_none(), "more digits than a reference has");
    let front = result.front();
    let value = |place: &usize| (cost(*place), result.cells[*place].error().unwrap());
    assert!(front.len() > 3 && front.windows(2).all(|pair| value(&pair[0]).0 <= value(&pair[1]).0));
    assert!(front.windows(2).all(|pair| value(&pair[0]).1 > value(&pair[1]).1));
    // Every method has one place in the tables.
    let (reached, others) = cheapest_by_method(&result.cells, 6);
    let methods = result.cells.chunk_by(|a, b| a.is_of(&b.method)).count();
    assert_eq!(reached.len() + others.len(), methods);
    assert!(reached.iter().all(|place| result.cells[*place].digits() >= Some(6.0)));
}

/// Stiff: implicit methods win by far, and the explicit one is run to the end to tell by how much.
#[test]
fn implicit_methods_win_where_the_rod_is_flexible() {
    let scene = shipped("flexible_slider_crank_fe", &[]);
    let filter = filter(&["index1", "ggl"], &["rk4", "dopri5", "dop853", "radau_iia"], &["none"]);
    let result = measured(motion(&scene, 0.01), &plan(&filter, 400_000), &["x3", "deflection", "moment"]);
    let advice = result.recommend(4).unwrap();
    assert_eq!(result.cells[advice.best].method.integrator.name, "radau_iia");
    let [explicit, implicit] = [advice.explicit, advice.implicit].map(|place| &result.cells[place.unwrap()]);
    let statistics = |cell: &Cell| cell.statistics().unwrap();
    // A factorization is part of every evaluation of an explicit method.
    let explicit_work = statistics(explicit).rhs_evaluations;
    let implicit_work = statistics(implicit).rhs_evaluations + statistics(implicit).factorizations;
    let ratio = explicit_work as f64 / implicit_work as f64;
    // Measured: 29, 38972 evaluations of dopri5, which follows the fastest mode, against 992 with 365 factorizations.
    assert!(ratio > 20.0, "{explicit_work} {implicit_work}");
}

/// What a method cannot do, and what takes too long, stays with its reason.
#[test]
fn failures_stay_with_their_reason() {
    let scene = shipped("spinning_top", &[]);
    let mut hasty = plan(&filter(&["index3", "index1"], &["rattle", "heun", "dop853"], &["none"]), 160_000);
    hasty.is_exhaustive = true;
    let result = measured(motion(&scene, 1.0), &hasty, &[]);
    let of = |name: &'static str| result.cells.iter().filter(move |cell| cell.method.integrator.name == name);
    assert!(of("rattle").count() > 0);
    for cell in of("rattle") {
        assert!(cell.reason().unwrap().contains("rattle cannot integrate coordinates"), "{:?}", cell.outcome);
    }
    let slow: Vec<&Cell> = of("heun").filter(|cell| matches!(cell.outcome, Outcome::TooSlow { .. })).collect();
    assert!(!slow.is_empty(), "{:?}", result.left_out);
    assert!(slow.iter().all(|cell| cell.reason().unwrap().starts_with("would take about ")));
    assert!(of("dop853").any(|cell| cell.reason().is_none()));
}

/// What is there stays as it is, and what is missing is measured.
#[test]
fn a_measurement_is_continued() {
    let scene = shipped("two_mass", &[]);
    let motion = motion(&scene, 5.0);
    let plan = plan(&filter(&["index1"], &["dopri5", "dop853"], &[]), 40_000);
    let whole = measured(motion.clone(), &plan, &[]);
    let text = serde_json::to_string(&whole).unwrap();
    let mut half: WorkPrecision = serde_json::from_str(&text).unwrap();
    assert_eq!(serde_json::to_string(&half).unwrap(), text);
    half.cells.retain(|cell| cell.decades <= 6);
    let kept = half.cells.iter().filter(|cell| cell.reason().is_none()).count();
    Runner::new(motion, &plan, |_, _| ()).run(&mut half).unwrap();
    assert!(kept < half.cells.len() && half.seconds > whole.seconds);
    // Which finer runs are worth making depends on what others cost; those of both measurements are compared.
    let pairs = whole.cells.iter().filter_map(|cell| {
        let again = half.cells.iter().find(|again| again.decades == cell.decades && again.is_of(&cell.method))?;
        (cell.reason().is_none() && again.reason().is_none()).then_some((cell, again))
    });
    let pairs: Vec<(&Cell, &Cell)> = pairs.collect();
    assert!(pairs.len() >= kept);
    for (cell, again) in pairs {
        // Runs are repeatable, so that errors are the same to the last bit; times that were known are kept.
        assert_eq!((&cell.method, cell.error()), (&again.method, again.error()));
        if let (Outcome::Completed { cpu_seconds: a, .. }, Outcome::Completed { cpu_seconds: b, .. }) =
            (&cell.outcome, &again.outcome)
            && cell.decades <= 6
        {
            assert!(b.starts_with(a), "{a:?} {b:?}");
        }
    }
}

#[test]
fn grids_are_of_what_goes_together() {
    let all = grid(&Filter::default()).unwrap();
    assert!(all.len() > 50);
    for triple in &all {
        let step = (triple.at(1e-6, 1e-6, None).check().is_err()).then_some(1e-3);
        assert_eq!(triple.at(1e-6, 1e-6, step).check(), Ok(()), "{triple:?}");
    }
    let own = grid(&filter(&["baumgarte:alpha=3,beta=3"], &["rk4"], &["manifold", "full"])).unwrap();
    let names: Vec<String> = own.iter().map(|triple| triple.at(1.0, 1.0, None).triple()).collect();
    assert_eq!(names, ["baumgarte:alpha=3,beta=3 + rk4 + manifold", "baumgarte:alpha=3,beta=3 + rk4 + full"]);
    let error = grid(&filter(&["index3"], &["dop853"], &[])).unwrap_err().to_string();
    assert!(error.contains("dop853 cannot integrate index3"), "{error}");
    let error = grid(&filter(&[], &["dop854"], &[])).unwrap_err().to_string();
    assert!(error.contains("dop853"), "{error}");
    assert_eq!(method("index1", "dop853", "none").triple(), "index1 + dop853");
}
