//! Contacts that come and go with the motion.

use super::{ADAPTIVE, attempt, fixed, method};
use crate::scenes::{Ready, dop853, parse};
use holonom::analysis::Recorder;
use holonom::simulate::{Span, simulate};

const G: f64 = 9.81;
const STIFFNESS: f64 = 1e4;

/// A mass of 1 kg falls from 1 m on a spring.
fn ball(force: &str) -> Ready {
    parse(&format!(
        r#"{{ "name": "ball", "dimension": 2, "gravity": [0, -{G}],
            "bodies": [{{ "name": "m", "type": "point_mass", "mass": 1, "initial": {{ "position": [0, 1] }} }}],
            "forces": [{{ "name": "floor", "type": "applied_force", "at": "m", "force": [0, "{force}"] }}],
            "simulation": {{ "t_end": 5 }} }}"#
    ))
}

fn bouncing() -> Ready {
    ball("if(m.y < 0, -1e4*m.y, 0)")
}

/// Its height: parabolas above the floor, and a part of a sine below.
fn height(t: f64) -> f64 {
    let fall = (2.0 / G).sqrt();
    let speed = (2.0 * G).sqrt();
    let frequency = STIFFNESS.sqrt();
    let sag = G / STIFFNESS;
    // y = -sag + sag cos(w t) - speed/w sin(w t) comes back to zero at w t = 2 pi - 2 atan(speed/(w sag)).
    let contact = 2.0 * (std::f64::consts::PI - (speed / (frequency * sag)).atan()) / frequency;
    let period = 2.0 * fall + contact;
    // From the top of a flight.
    let s = t.rem_euclid(period);
    match s - fall {
        below if below < 0.0 => 1.0 - 0.5 * G * s * s,
        within if within < contact => {
            -sag + sag * (frequency * within).cos() - speed / frequency * (frequency * within).sin()
        }
        _ => 1.0 - 0.5 * G * (period - s).powi(2),
    }
}

/// Eleven contacts in five seconds. An error of the time of a contact grows with each that follows; a method that steps over
/// the change of form makes a hundred times more of it.
#[test]
fn a_bouncing_mass_keeps_its_time() {
    let scene = bouncing();
    for (names, allowed) in ADAPTIVE.into_iter().zip([2e-6, 2e-6, 2e-6, 2e-6, 2e-6, 2e-6, 1e-4, 1e-4, 1e-4, 1e-4, 1e-4])
    {
        let (outcome, _) = attempt(&scene, &method(names, 1e-8), 5.0);
        assert_eq!(outcome.failure, None, "{names:?}");
        let error = (outcome.q[1] - height(5.0)).abs();
        assert!(error < allowed, "{names:?}: error {error:.1e}");
    }
}

/// A spring to the middle of each metre, which pulls anew from the other side where the next one begins: it does no work
/// over a metre, so that each takes the same time.
#[test]
fn a_cycle_of_the_state_is_followed() {
    let scene = parse(
        r#"{ "name": "stair", "dimension": 2,
            "bodies": [{ "name": "m", "type": "point_mass", "mass": 1, "initial": { "velocity": [3, 0] } }],
            "forces": [{ "name": "stair", "type": "applied_force", "at": "m", "force": ["4 - 8*mod(m.x, 1)", 0] }],
            "simulation": { "t_end": 5 } }"#,
    );
    // x - 1/2 = a sin(w t - p) with w^2 = 8, from -1/2 with the speed 3.
    let w = 8f64.sqrt();
    let metre = 2.0 * (0.5f64 * w / 3.0).atan() / w;
    for names in [["index1", "dop853", "none"], ["index1", "radau_iia", "none"], ["index1", "dopri5", "none"]] {
        let (outcome, _) = attempt(&scene, &method(names, 1e-10), 20.0 * metre);
        assert_eq!(outcome.failure, None, "{names:?}");
        // Twenty passages, each with the error of a step.
        assert!((outcome.q[0] - 20.0).abs() < 1e-7, "{names:?}: {}", outcome.q[0]);
    }
}

/// Fixed steps end at the contacts too, and keep their order through them.
#[test]
fn the_order_is_kept_through_contacts() {
    let scene = bouncing();
    for (names, order, steps) in [
        (["index1", "heun", "none"], 2.0, [2e-3, 1e-3, 5e-4]),
        (["index1", "rk4", "none"], 4.0, [8e-3, 4e-3, 2e-3]),
        (["index1", "dop853", "none"], 8.0, [2e-2, 1e-2, 5e-3]),
        (["ggl", "radau_iia", "none"], 5.0, [8e-3, 4e-3, 2e-3]),
    ] {
        let errors = steps.map(|step| {
            let (outcome, _) = attempt(&scene, &fixed(names, step), 1.2);
            (outcome.q[1] - height(1.2)).abs()
        });
        let observed = (errors[0] / errors[2]).log2() / 2.0;
        // Where round-off is reached the order says nothing.
        assert!(errors[2] < 1e-12 || observed > order - 0.5, "{names:?}: order {observed:.2} from {errors:?}");
    }
}

/// Laws that have no value beyond their threshold, and jumps.
#[test]
fn contacts_of_any_law() {
    let span = Span { start: 0.0, end: 2.0, output_step: 0.5 };
    for law in ["1e5*max(0, -m.y)^1.5", "if(m.y < 0, 2e4*sqrt(-m.y), 0)", "if(m.y < 0, 300 - 5e3*m.y, 0)"] {
        let scene = ball(law);
        let rows = |names: [&str; 3]| scene.run(&method(names, 1e-9), span).column("m.y");
        let expected = scene.run(&dop853(1e-12), span).column("m.y");
        for names in [["index1", "dopri5", "none"], ["ggl", "radau_iia", "none"], ["index1", "bdf", "none"]] {
            let error = rows(names).iter().zip(&expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(error < 1e-4, "{law} with {names:?}: {error:.1e}");
        }
    }
}

/// A wheel that leaves the road over a bump: two switching functions of a tyre, with damping.
#[test]
fn a_tyre_that_lifts_off() {
    let scene = parse(
        r#"{ "name": "lift", "dimension": 2, "gravity": [0, -9.81],
            "bodies": [{ "name": "m", "type": "point_mass", "mass": 40, "initial": { "position": [0, 0.2975475] } }],
            "forces": [{ "name": "tyre", "type": "tyre", "at": "m", "stiffness": 160000, "damping": 400, "radius": 0.3,
                         "road": "0.05*exp(-((t - 0.3)/0.03)^2)", "lift_off": true }],
            "outputs": [{ "name": "load", "measure": "force", "of": "tyre" }],
            "simulation": { "t_end": 1 } }"#,
    );
    let span = Span { start: 0.0, end: 1.0, output_step: 0.01 };
    let expected = scene.run(&dop853(1e-12), span);
    assert!(expected.column("load").contains(&0.0), "the wheel leaves the road");
    for names in ADAPTIVE {
        let found = scene.run(&method(names, 1e-9), span).column("m.y");
        let error = found.iter().zip(expected.column("m.y")).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        // Of a flight of 0.1 m; generalized_alpha, of second order, is the loosest.
        let allowed = if names[1] == "generalized_alpha" { 1e-4 } else { 1e-6 };
        assert!(error < allowed, "{names:?}: {error:.1e}");
    }
}

/// Far from their thresholds switching functions cost no step and change no digit.
#[test]
fn a_contact_that_never_comes_changes_nothing() {
    let [with, without] = ["if(m.y < -1e3, -1e4*m.y, 0)", "0"].map(|law| {
        let (outcome, _) = attempt(&ball(law), &method(["index1", "dop853", "none"], 1e-8), 5.0);
        (outcome.q, outcome.statistics.steps)
    });
    assert_eq!(with, without);
}

/// A bump on the way that takes 40 ms to pass: a row on it does not fit a step that has not seen it. (Implicit methods, whose
/// steps are longer than v' of a stiff mechanism is exact, cannot tell.)
#[test]
fn a_row_shows_what_a_step_has_not_seen() {
    let scene = parse(
        r#"{ "name": "bump", "dimension": 2,
            "bodies": [{ "name": "m", "type": "point_mass", "mass": 1, "initial": { "velocity": [1, 0] } }],
            "forces": [{ "name": "push", "type": "applied_force", "at": "m", "force": [0, "100*exp(-((m.x - 5)/0.02)^2)"] }],
            "simulation": { "t_end": 10 } }"#,
    );
    for names in ADAPTIVE.into_iter().filter(|names| ["dopri5", "dop853", "phem56"].contains(&names[1])) {
        let span = Span { start: 0.0, end: 10.0, output_step: 0.01 };
        let mut recorder = Recorder::new(scene.system());
        let outcome = simulate(scene.system(), &method(names, 1e-8), span, scene.0.start(), &mut recorder).unwrap();
        // The integral of the bump, to a hundred tolerances.
        let momentum = 2.0 * std::f64::consts::PI.sqrt();
        assert!((outcome.v[1] - momentum).abs() < 1e-6, "{names:?}: {}", outcome.v[1]);
    }
}

/// A force that kinks at 300 heights, all of which a long step would pass: each step ends at the next one. Its energy is
/// v^2/2 - c/2 sum (y - y_k)|y - y_k|.
#[test]
fn a_law_of_many_kinks_is_found_kink_by_kink() {
    const KINKS: usize = 300;
    let heights: Vec<f64> = (0..KINKS).map(|k| k as f64 / KINKS as f64).collect();
    let force: Vec<String> = heights.iter().map(|height| format!("1e-3*abs(m.y - {height})")).collect();
    let scene = parse(&format!(
        r#"{{ "name": "kinks", "dimension": 2,
            "bodies": [{{ "name": "m", "type": "point_mass", "mass": 1,
                          "initial": {{ "position": [0, 1], "velocity": [0, -2] }} }}],
            "forces": [{{ "name": "f", "type": "applied_force", "at": "m", "force": [0, "{}"] }}],
            "simulation": {{ "t_end": 1 }} }}"#,
        force.join(" + ")
    ));
    let energy = |y: f64, v: f64| {
        let work: f64 = heights.iter().map(|height| (y - height) * (y - height).abs()).sum();
        0.5 * v * v - 0.5e-3 * work
    };
    let (outcome, _) = attempt(&scene, &dop853(1e-9), 0.5);
    assert_eq!(outcome.failure, None);
    let passed = heights.iter().filter(|height| **height > outcome.q[1]).count();
    let steps = outcome.statistics.steps;
    assert!(passed > 200 && (passed as u64..2 * passed as u64).contains(&steps), "{passed} kinks, {steps} steps");
    let error = energy(outcome.q[1], outcome.v[1]) - energy(1.0, -2.0);
    assert!(error.abs() < 1e-8, "{error:e}");
}
