//! Forces that jump where they hold the motion: the run ends and names them.

use super::{ADAPTIVE, attempt, method, pushed};
use crate::scenes::parse;

/// Coulomb's law without a law for sticking: at rest after 0.6 s.
#[test]
fn a_law_that_holds_the_motion_at_its_jump_is_named() {
    let scene = parse(
        r#"{ "name": "coulomb", "dimension": 2,
            "bodies": [{ "name": "m", "type": "point_mass", "mass": 1, "initial": { "position": [0, 0], "velocity": [3, 0] } }],
            "forces": [{ "name": "f", "type": "applied_force", "at": "m", "force": ["-5*sign(m.x')", 0] }],
            "simulation": { "t_end": 2 } }"#,
    );
    for names in ADAPTIVE {
        let (outcome, _) = attempt(&scene, &method(names, 1e-8), 2.0);
        let failure = outcome.failure.unwrap_or_else(|| panic!("{names:?}"));
        assert!((outcome.t - 0.6).abs() < 1e-7, "{names:?}: {}", outcome.t);
        assert!(failure.reason.contains("the force `f` jumps where it holds the motion"), "{failure:?}");
        assert!(failure.hint.contains("tanh"), "{failure:?}");
        assert!(outcome.statistics.steps + outcome.statistics.rejected < 1000, "{names:?}: {:?}", outcome.statistics);
    }
}

/// From rest, with a force that the law can hold.
#[test]
fn a_law_that_holds_the_start_is_named() {
    let scene = pushed("2 - 5*sign(m.x')");
    for names in ADAPTIVE {
        let (outcome, _) = attempt(&scene, &method(names, 1e-8), 10.0);
        let failure = outcome.failure.unwrap_or_else(|| panic!("{names:?}"));
        assert!(outcome.t == 0.0 && failure.reason.contains("the force `push` jumps"), "{names:?}: {failure:?}");
    }
}

/// One that it cannot hold goes on.
#[test]
fn a_force_above_friction_moves() {
    let scene = pushed("7 - 5*sign(m.x')");
    for names in ADAPTIVE {
        let (outcome, _) = attempt(&scene, &method(names, 1e-8), 10.0);
        assert_eq!(outcome.failure, None, "{names:?}");
        assert!((outcome.v[0] - 20.0).abs() < 1e-5, "{names:?}: {}", outcome.v[0]);
    }
}

/// A switch with damping comes to rest in ever shorter turns.
#[test]
fn turns_without_end_are_an_end() {
    for tolerance in [1e-6, 1e-8] {
        let scene = pushed("-5*sign(m.x - 1e-4) - 1500*m.x'");
        for names in ADAPTIVE {
            let (outcome, _) = attempt(&scene, &method(names, tolerance), 10.0);
            let failure = outcome.failure.unwrap_or_else(|| panic!("{names:?} {tolerance:e}"));
            assert!(failure.reason.contains("the force `push`"), "{names:?}: {failure:?}");
            // Most by tr_bdf2, whose steps have a tolerance of 1e-11 where 1e-8 is asked.
            assert!(outcome.statistics.steps < 20_000, "{names:?}: {:?}", outcome.statistics);
        }
    }
}

/// With little damping the turns get shorter over seconds, from 80 a second to 1e8: a run does not take them all.
#[test]
fn turns_that_will_have_no_end_are_foreseen() {
    let scene = pushed("-5*sign(m.x - 1e-4) - 5*m.x'");
    for names in ADAPTIVE {
        let (outcome, _) = attempt(&scene, &method(names, 1e-6), 10.0);
        assert!(outcome.statistics.steps < 150_000, "{names:?}: {:?}", outcome.statistics);
        // Where the error of a method is more than what is left of the motion, its turns stay as long.
        if !["tr_bdf2", "generalized_alpha"].contains(&names[1]) {
            let failure = outcome.failure.unwrap_or_else(|| panic!("{names:?}"));
            assert!(failure.reason.contains("the force `push`"), "{names:?}: {failure:?}");
        }
    }
}

/// A relay that goes to and fro at one rate, or ever faster because the motion does, has no end but that of the run.
#[test]
fn turns_that_go_on_are_no_end() {
    for force in ["-5*sign(m.x - 1e-3) + 10*sin(500*t)", "10 + 0.01*sign(sin(20*m.x))"] {
        let scene = pushed(force);
        for names in ADAPTIVE {
            let (outcome, _) = attempt(&scene, &method(names, 1e-6), 3.0);
            assert_eq!(outcome.failure, None, "{names:?} {force}");
        }
    }
}

/// Kinks without a jump are passed, however often.
#[test]
fn kinks_are_passed() {
    let scene = pushed("-100*m.x*(1 + 0.1*sign(m.x)) + 10*abs(sin(20*t)) - 2*abs(m.x')*m.x'");
    for names in ADAPTIVE {
        let (outcome, _) = attempt(&scene, &method(names, 1e-8), 10.0);
        assert_eq!(outcome.failure, None, "{names:?}");
    }
}
