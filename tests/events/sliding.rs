//! Forces that jump where they hold the motion: the run ends and names them.

use super::scenes::parse;
use super::{ADAPTIVE, attempt, method, pushed};

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

/// A switch with much damping comes to rest in ever shorter turns.
#[test]
fn turns_without_end_are_an_end() {
    let scene = pushed("-5*sign(m.x - 1e-4) - 1500*m.x'");
    for names in [["index1", "dopri5", "manifold"], ["index1", "dop853", "manifold"]] {
        let (outcome, _) = attempt(&scene, &method(names, 1e-8), 10.0);
        let failure = outcome.failure.unwrap_or_else(|| panic!("{names:?}"));
        assert!(failure.reason.contains("the force `push`"), "{names:?}: {failure:?}");
        assert!(outcome.statistics.steps < 200_000, "{names:?}: {:?}", outcome.statistics);
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
