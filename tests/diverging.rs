//! Motions that a force feeds without end are ended, and those that only gain much energy are not.

use crate::scenes::{dop853, parse};
use holonom::analysis::{Record, Recorder};
use holonom::simulate::{Outcome, Span, simulate};

/// A run of ten rows by the default method, whatever its end.
fn run(json: &str, end: f64) -> (Outcome, Record) {
    let ready = parse(json);
    let mut recorder = Recorder::new(ready.system());
    let span = Span { start: 0.0, end, output_step: 0.1 * end };
    let outcome = simulate(ready.system(), &dop853(1e-8), span, ready.0.start(), &mut recorder).unwrap();
    (outcome, recorder.finish())
}

/// A trolley with this law of its drive, on a rail, and a load on a rope of prescribed length.
fn crane(law: &str) -> String {
    format!(
        r#"{{ "name": "crane", "dimension": 2, "gravity": [0, -9.81], "ground": {{ "markers": {{ "rail": [0, 0] }} }},
        "bodies": [ {{ "name": "trolley", "type": "point_mass", "mass": 200, "markers": {{ "P": [0, 0] }} }},
                    {{ "name": "load", "type": "point_mass", "mass": 100, "markers": {{ "P": [0, 0] }},
                       "initial": {{ "position": [0, -5] }} }} ],
        "joints": [ {{ "name": "rail", "type": "point_on_line", "between": ["ground.rail", "trolley.P"] }},
                    {{ "name": "hoist", "type": "driver", "between": ["trolley.P", "load.P"], "coordinate": "distance",
                       "value": "5 - 2*smoothstep(t/6)" }} ],
        "forces": [ {{ "name": "drive", "type": "applied_force", "at": "trolley.P", "force": ["{law}", 0] }} ] }}"#
    )
}

/// A mass on a rail along x with these forces, at this speed.
fn slider(forces: &str, speed: f64) -> String {
    format!(
        r#"{{ "name": "slider", "dimension": 2, "ground": {{ "markers": {{ "O": [0, 0] }} }},
        "bodies": [ {{ "name": "m", "type": "rigid", "mass": 1, "free": ["x"], "markers": {{ "C": [0, 0] }},
                       "initial": {{ "position": [1, 0], "velocity": [{speed}, 0] }} }} ],
        "forces": [ {forces} ] }}"#
    )
}

fn force(law: &str) -> String {
    format!(r#"{{ "name": "push", "type": "applied_force", "at": "m.C", "force": ["{law}", 0] }}"#)
}

#[test]
fn a_motion_that_a_force_feeds_without_end_ends() {
    let scenes = [
        (crane("150*(4 - trolley.x) + 500*trolley.x'"), 20.0, "drive"),
        (slider(&force("3*m.x'"), 0.1), 30.0, "push"),
        (slider(&force("5*m.x"), 0.0), 30.0, "push"),
        (slider(&force("-40*m.x + 2*m.x'"), 0.0), 60.0, "push"),
    ];
    for (json, end, name) in scenes {
        let (outcome, record) = run(&json, end);
        let failure = outcome.failure.unwrap_or_else(|| panic!("{json} came to its end"));
        assert!(failure.reason.contains("diverges") && failure.reason.contains(&format!("`{name}`")), "{failure:?}");
        assert!(outcome.t < end && record.rows > 1, "{} {}", outcome.t, record.rows);
    }
}

/// From rest, under a force of time alone however large, a controller, a motor, a swing at resonance, a limit cycle.
#[test]
fn motions_that_gain_much_energy_come_to_their_end() {
    let scenes = [
        (slider(&force("10"), 0.0), 1e3),
        (slider(&force("exp(t)"), 0.0), 30.0),
        (slider(&force("if(t < 5, 0, 1e4*(3 - m.x) - 200*m.x')"), 0.0), 20.0),
        (slider(&force("100*min(1, 0.01 + m.x'/5)"), 0.0), 100.0),
        (slider(&force("-100*m.x + sin(10*t)"), 0.0), 100.0),
        (slider(&force("-m.x + 5*(1 - m.x^2)*m.x'"), 1e-3), 60.0),
        (crane("150*(4 - trolley.x) - 500*trolley.x'"), 20.0),
    ];
    for (json, end) in scenes {
        let (outcome, _) = run(&json, end);
        assert_eq!(outcome.failure, None, "{json}");
    }
}
