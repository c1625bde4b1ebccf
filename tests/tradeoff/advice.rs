//! What is recommended, within a budget and on a busy machine.

use super::{filter, measured, motion, plan};
use crate::scenes::shipped;
use holonom::compare::work_precision::{Filter, Outcome, Plan, WorkPrecision};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// A beam that is stiff and undamped: an explicit method takes minutes, and an implicit one a tenth of a second. Nothing was
/// recommended in 20 s.
#[test]
fn a_budget_is_kept_and_spent_on_what_is_cheap() {
    let scene = shipped("spin_up_beam", &[]);
    let end = scene.0.span().unwrap().end;
    let clock = Instant::now();
    let result = measured(motion(&scene, end), &plan(&Filter::default(), 10.0), &[]);
    let seconds = clock.elapsed().as_secs_f64();
    assert!(result.recommend(4).is_some(), "{:?}", result.recommendations());
    // A step of a busy machine may end late.
    assert!(seconds < 1.2 * 10.0, "{seconds} s");
}

/// Two seconds are too short for many digits, and enough for some.
#[test]
fn a_short_budget_gives_something() {
    let scene = shipped("five_link_suspension", &[]);
    let end = scene.0.span().unwrap().end;
    let result = measured(motion(&scene, end), &plan(&Filter::default(), 2.0), &[]);
    assert!(result.recommend(3).is_some(), "{:?}", result.reference);
}

/// Every method has every term of the sequence in the table, with its result or its reason.
#[test]
fn what_is_left_out_has_its_reason() {
    let scene = shipped("flexible_slider_crank", &[]);
    let plan = plan(&filter(&["index1", "ggl"], &["rk4", "dop853", "radau_iia", "bdf"], &["none"]), 2.0);
    let result = measured(motion(&scene, 0.1), &plan, &[]);
    for triple in &plan.triples {
        let key = triple.at((1.0, 1.0), None);
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

/// The same with other work on the machine.
#[test]
fn advice_does_not_depend_on_the_load() {
    for (name, end) in [("slider_crank", 0.5), ("five_link_suspension", 0.5), ("andrews", 0.03)] {
        let scene = shipped(name, &[]);
        let formulations = ["index1", "baumgarte:alpha=5,beta=5", "force_projection:position=1,velocity=1"];
        let plan: Plan = plan(&filter(&formulations, &["rk4", "dopri5", "dop853"], &[]), 20.0);
        let measure = || measured(motion(&scene, end), &plan, &[]);
        let idle = measure();
        let is_done = AtomicBool::new(false);
        let busy = std::thread::scope(|scope| {
            for _ in 0..2 {
                scope.spawn(|| {
                    while !is_done.load(Ordering::Relaxed) {
                        std::hint::spin_loop();
                    }
                });
            }
            let busy = measure();
            is_done.store(true, Ordering::Relaxed);
            busy
        });
        for digits in [3, 6, 9] {
            assert_eq!(advice(&idle, digits), advice(&busy, digits), "{name}, {digits} digits");
        }
    }
}
