//! What is recommended, within a budget and on a busy machine.

use super::{filter, measured, motion, plan};
use crate::scenes::shipped;
use holonom::study::work_precision::{Filter, Outcome, TradeoffPlan, WorkPrecision};

/// A beam that is stiff and undamped: an explicit method takes thousands of times the steps of an implicit one.
#[test]
fn a_budget_is_kept_and_spent_on_what_is_cheap() {
    let scene = shipped("spin_up_beam", &[]);
    let end = scene.0.span().unwrap().end;
    let plan = plan(&Filter::default(), 20_000);
    let result = measured(motion(&scene, end), &plan, &[]);
    assert!(result.recommend(4).is_some(), "{:?}", result.recommendations());
    // All methods would take far longer. A run that has begun is stopped.
    assert!(result.left_out.as_ref().is_some_and(|left_out| left_out.contains("budget")), "{:?}", result.left_out);
    let [spent, budget] = [result.seconds, plan.budget.as_secs_f64()];
    assert!(spent > 0.9 * budget && spent < 1.01 * budget, "{spent} of {budget} s");
}

/// Too short for many digits, and enough for some.
#[test]
fn a_short_budget_gives_something() {
    let scene = shipped("five_link_suspension", &[]);
    let end = scene.0.span().unwrap().end;
    let result = measured(motion(&scene, end), &plan(&Filter::default(), 10_000), &[]);
    assert!(result.recommend(3).is_some(), "{:?}", result.reference);
}

/// Every method has every term of the sequence in the table, with its result or its reason.
#[test]
fn what_is_left_out_has_its_reason() {
    let scene = shipped("flexible_slider_crank", &[]);
    let plan = plan(&filter(&["index1", "ggl"], &["rk4", "dop853", "radau_iia", "bdf"], &["none"]), 20_000);
    let result = measured(motion(&scene, 0.1), &plan, &[]);
    for triple in &plan.triples {
        let key = triple.at(1.0, 1.0, None);
        let mut decades: Vec<u32> =
            result.cells.iter().filter(|cell| cell.is_of(&key)).map(|cell| cell.decades).collect();
        decades.dedup();
        assert_eq!(decades, (3..=12).collect::<Vec<u32>>(), "{triple:?}");
    }
    let skipped = result.cells.iter().filter(|cell| !matches!(cell.outcome, Outcome::Completed { .. }));
    assert!(skipped.filter_map(|cell| cell.reason()).all(|reason| reason.len() > 10));
}

/// What is recommended for so many digits: the method and its accuracy.
fn advice(result: &WorkPrecision, digits: u32) -> String {
    let method = &result.cells[result.recommend(digits).unwrap().best].method;
    format!("{} {:e} {:?}", method.triple(), method.rtol, method.step)
}

/// The same where other work on the machine makes each run take up to twice as long.
#[test]
fn advice_does_not_depend_on_the_load() {
    for (name, end) in [("slider_crank", 0.5), ("five_link_suspension", 0.5), ("andrews", 0.03)] {
        let scene = shipped(name, &[]);
        let formulations = ["index1", "baumgarte:alpha=5,beta=5", "force_projection:position=1,velocity=1"];
        let plan: TradeoffPlan = plan(&filter(&formulations, &["rk4", "dopri5", "dop853"], &[]), 60_000);
        let idle = measured(motion(&scene, end), &plan, &[]);
        for seed in 0..10 {
            let mut busy = idle.clone();
            let mut random = fastrand::Rng::with_seed(seed);
            for cell in &mut busy.cells {
                if let Outcome::Completed { cpu_seconds, .. } = &mut cell.outcome {
                    cpu_seconds.iter_mut().for_each(|seconds| *seconds *= 1.0 + random.f64());
                }
            }
            busy.price();
            assert_ne!(idle.cells[0].cost, busy.cells[0].cost);
            for digits in [3, 6, 9] {
                assert_eq!(advice(&idle, digits), advice(&busy, digits), "{name}, {digits} digits");
            }
        }
    }
}
