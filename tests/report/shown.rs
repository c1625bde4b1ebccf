//! Rows of a run that are drawn.

use holonom::analysis::{Drift, DriftLevel};
use holonom::error::{Failure, INTERRUPTED};
use holonom::report::{Ending, Shown};
use holonom::system::{Column, Names};
use holonom::trajectory::Trajectory;

/// Rows of one force at times of 0.01 s.
fn force(value: impl Fn(f64) -> f64) -> Trajectory {
    let outputs = vec![Column { name: "force".into(), unit: "N".into() }];
    let rows = (0..100).map(|k| 0.01 * f64::from(k)).map(|t| vec![t, value(t)]).collect();
    Trajectory { names: Names::default(), outputs, rows }
}

/// It swings until 0.8 s, and then doubles with every hundredth of a second, up to 1e75.
fn divergence(t: f64) -> f64 {
    (9.0 * t).cos() + if t > 0.795 { 10f64.powf(375.0 * (t - 0.79)) } else { 0.0 }
}

#[test]
fn rows_that_a_divergence_spoils_are_not_shown() {
    let run = force(divergence);
    for (ending, word, from) in [
        (Ending::Diverged, "diverged", "where the run diverged"),
        (Ending::Failed, "failed", "where values grow until the run fails"),
    ] {
        let shown = Shown::of_trajectory(ending, &run);
        assert_eq!(shown.rows, 80, "{ending:?}");
        assert_eq!(shown.title("run"), format!("run (not drawn: t ≥ 0.8 s, {from})"));
        assert_eq!(shown.legend("exact"), format!("exact ({word} from 0.8 s on)"));
    }
    assert_eq!(Shown::of_trajectory(Ending::Completed, &run), Shown::all(&run));
    assert_eq!(Shown::all(&run).title("run"), "run");
    // What is not finite goes with the others, and does not hide them.
    let not_finite = force(|t| if t > 0.975 { f64::NAN } else { divergence(t) });
    assert_eq!(Shown::of_trajectory(Ending::Diverged, &not_finite).rows, 80);
    let infinite = force(|t| if t > 0.795 { f64::INFINITY } else { divergence(t) });
    assert_eq!(Shown::of_trajectory(Ending::Diverged, &infinite).rows, 80);
}

#[test]
fn an_interrupted_run_is_drawn_whole() {
    let failure = |reason: &str| Failure { t: 1.0, reason: reason.into(), hint: String::new() };
    let ending = |reason, open: f64| {
        let position = DriftLevel { relative_max: open, ..DriftLevel::default() };
        Ending::of(Some(&failure(reason)), &Drift { position, ..Drift::default() }, None)
    };
    assert_eq!(ending(INTERRUPTED, 1e-9), Ending::Completed);
    assert_eq!(ending("the step became too small", 1e-9), Ending::Failed);
    assert_eq!([ending(INTERRUPTED, 2.0), ending("no more steps", f64::NAN)], [Ending::Diverged; 2]);
}

#[test]
fn a_divergence_from_the_beginning_leaves_its_beginning() {
    let grown = force(|t| 10f64.powf(100.0 * t));
    let shown = Shown::of_trajectory(Ending::Diverged, &grown);
    assert!((4..10).contains(&shown.rows), "{shown:?}");
    let at_once = force(|t| if t > 0.0 { 1e30 } else { 1.0 });
    let shown = Shown::of_trajectory(Ending::Diverged, &at_once);
    assert_eq!((shown.rows, shown.title("run").as_str()), (100, "run"));
    let two = Trajectory { rows: at_once.rows[..2].to_vec(), ..at_once };
    let shown = Shown::of_trajectory(Ending::Diverged, &two);
    assert_eq!((shown.rows, shown.title("run").as_str()), (2, "run (the run diverged at once)"));
}

/// At rest for three quarters of the run, which then fails for some other reason.
#[test]
fn a_late_motion_is_shown() {
    let late = force(|t| if t < 0.75 { 1e-13 } else { (40.0 * t).sin() });
    assert_eq!(Shown::of_trajectory(Ending::Failed, &late), Shown::all(&late));
    let quiet = force(|t| if t > 0.985 { f64::NAN } else { t });
    assert_eq!(Shown::of_trajectory(Ending::Diverged, &quiet), Shown::all(&quiet));
}
