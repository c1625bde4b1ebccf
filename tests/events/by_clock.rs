//! Forces and motions that are given over time.

use super::{ADAPTIVE, attempt, fixed, method, pushed};
use crate::scenes::{Ready, dop853, parse, shipped};
use holonom::simulate::Span;
use std::f64::consts::PI;

/// Forces, and the momentum that each gives to a mass of 1 kg in ten seconds. All but the last few act for far less
/// than a thousandth of that.
fn pushes() -> Vec<(String, f64)> {
    let gauss = |size: f64, width: f64| size * width * PI.sqrt();
    let push = |text: &str, momentum: f64| (text.to_string(), momentum);
    vec![
        push("table(t, 0, 0, 5, 0, 5.5, 2, 6, 0, 10, 0)", 1.0),
        push("if(t > 5.003 and t < 5.004, 1000, 0)", 1.0),
        push("if(abs(t - 5.3) < 1e-7, 1e7, 0)", 2.0),
        push("if(cos(2*pi*t) > 0.999999999, 1e5, 0)", 1e6 * (0.999999999f64).acos() / PI),
        push("max(0, 1 - abs(t - 3.21)/0.0005)*1000", 0.5),
        push("step(t - 3)*step(3.001 - t)*500 + min(t, 2)", 18.5),
        push("smoothstep((t - 3)/1e-4) - smoothstep((t - 3.5)/1e-4)", 0.5),
        push("if(mod(t, 0.3) < 0.001, 1000, 0)", 34.0),
        push("floor(t/2)*mod(t, 2)/2", 10.0),
        push("abs(sin(3*t))", 6.0 + (1.0 - (30.0 - 9.0 * PI).cos()) / 3.0),
        push("1000*exp(-((t - 7.77)/0.0012)^2)", gauss(1000.0, 0.0012)),
        push("0.3*t + 1000*exp(-((t - 7.77)/0.0012)^2)", 15.0 + gauss(1000.0, 0.0012)),
        push("0.3*sin(20*t) + 1000*exp(-((t - 3.3)/0.001)^2)", 0.015 * (1.0 - 200f64.cos()) + gauss(1000.0, 0.001)),
        push("1000*exp(-((t - 2)/0.001)^2) + 5*exp(-((t - 7)/0.001)^2)", gauss(1005.0, 0.001)),
        push("(1 + m.y)*1000/cosh((t - 4.123)/0.001)^2", 2.0),
        push("1e3*(1/(1 + exp(-(t - 6)/0.0001)) - 1/(1 + exp(-(t - 6.01)/0.0001)))", 10.0),
    ]
}

/// With steps that could be ten seconds long. 1e-5 is a thousand tolerances, which the loosest methods, of second
/// order, gather over a pulse; tr_bdf2 ends on a change of form by its dense output, which is of second order too, and
/// generalized_alpha does not test velocities. A pulse that is missed costs 0.005 at least.
#[test]
fn no_push_is_missed_by_any_method() {
    for (force, momentum) in pushes() {
        let scene = pushed(&force);
        for names in ADAPTIVE {
            let (outcome, _) = attempt(&scene, &method(names, 1e-8), 10.0);
            assert_eq!(outcome.failure, None, "{force} with {names:?}");
            let error = (outcome.v[0] - momentum).abs() / momentum.max(1.0);
            let allowed = match names[1] {
                "tr_bdf2" => 1e-4,
                "generalized_alpha" => 1e-3,
                _ => 1e-5,
            };
            assert!(error < allowed, "{force} with {names:?}: {} and not {momentum}", outcome.v[0]);
        }
    }
}

/// A fixed step is divided where it would miss a push, into parts on which the push is almost a cubic. Nobody estimates
/// the error of the parts: rk4 leaves 2.5e-8, the others 3e-10.
#[test]
fn no_push_is_missed_by_fixed_steps() {
    for (force, momentum) in pushes() {
        let scene = pushed(&force);
        for names in [["index1", "rk4", "none"], ["index1", "dop853", "none"], ["ggl", "radau_iia", "none"]] {
            let (outcome, _) = attempt(&scene, &fixed(names, 0.01), 10.0);
            assert_eq!(outcome.failure, None, "{force} with {names:?}");
            let error = (outcome.v[0] - momentum).abs() / momentum.max(1.0);
            assert!(error < 1e-7, "{force} with {names:?}: {} and not {momentum}", outcome.v[0]);
        }
    }
}

/// Between knots the force is linear: with steps that end on them a method of order three and more makes round-off
/// only.
#[test]
fn steps_end_on_knots() {
    let scene = pushed("table(t, 0, 0, 5, 0, 5.5, 2, 6, 0, 10, 0)");
    for names in ADAPTIVE.into_iter().filter(|names| ["dopri5", "dop853", "phem56", "radau_iia"].contains(&names[1])) {
        let (outcome, _) = attempt(&scene, &method(names, 1e-3), 10.0);
        assert!((outcome.v[0] - 1.0).abs() < 1e-13, "{names:?}: {}", outcome.v[0]);
        assert!(outcome.statistics.steps < 60, "{names:?}: {} steps", outcome.statistics.steps);
    }
}

/// A valve that opens and closes softly: near its end it is zero but for round-off, whose sign changes at every step.
/// 1e-6: the time for which it is round-off.
#[test]
fn a_function_that_comes_to_rest_on_a_threshold_passes_it_once() {
    let scene = pushed("sign(smoothstep(t/0.1) - smoothstep((t - 0.2)/0.1))");
    for names in ADAPTIVE {
        let (outcome, _) = attempt(&scene, &method(names, 1e-8), 1.0);
        assert!((outcome.v[0] - 0.3).abs() < 1e-6 && outcome.statistics.steps < 5000, "{names:?}: {outcome:?}");
    }
}

/// A blow of a millisecond to a pendulum, moved over twenty instants: found each time, and with the same result by
/// methods that know nothing of each other.
#[test]
fn a_blow_at_any_instant_is_felt() {
    for k in 0..20 {
        let from = 0.5 + 0.437 * f64::from(k);
        let scene = parse(&format!(
            r#"{{ "name": "hit", "dimension": 2, "gravity": [0, -9.81], "ground": {{ "markers": {{ "O": [0, 0] }} }},
                "bodies": [{{ "name": "bob", "type": "point_mass", "mass": 1, "initial": {{ "position": [1, 0] }} }}],
                "joints": [{{ "name": "r", "type": "distance", "between": ["ground.O", "bob"], "length": 1 }}],
                "forces": [{{ "name": "hit", "type": "applied_force", "at": "bob",
                              "force": ["if(t>{from} and t<{from}+0.001,1000,0)", 0] }}],
                "outputs": [{{ "name": "energy", "measure": "energy" }}], "simulation": {{ "t_end": 10 }} }}"#
        ));
        let runs = [["index1", "dop853", "manifold"], ["ggl", "radau_iia", "none"]].map(|names| {
            let run = scene.run(&method(names, 1e-9), Span { start: 0.0, end: 10.0, output_step: 10.0 });
            (run.column("energy")[1], run.record.energy.unwrap().max_error)
        });
        let [(a, balance), (b, _)] = runs;
        // The energy of the blow is v F dt + (F dt)^2/2, 0.5 J and more or less; its balance closes.
        assert!((a - b).abs() < 1e-6 * (1.0 + a.abs()), "at {from}: {a} and {b}");
        assert!(a.abs() > 1e-6 && balance < 1e-5, "at {from}: {a}, balance {balance}");
    }
}

/// The car starts at rest: the same bump later gives the same motion later, whatever the step that would go over it.
#[test]
fn a_bump_is_met_whenever_it_comes() {
    let height = |time: f64, names: [&str; 3]| {
        let scene = shipped("quarter_car", &[("bump_time", time)]);
        let span = Span { start: 0.0, end: time + 1.5, output_step: time + 1.5 };
        scene.run(&method(names, 1e-9), span).column("body_height")[1]
    };
    let expected = height(0.5, ["index1", "dop853", "manifold"]);
    for time in [3.0, 10.0, 77.7] {
        for names in ADAPTIVE {
            let found = height(time, names);
            // Of a motion of 0.05 m; second order gathers most.
            assert!((found - expected).abs() < 2e-6, "{names:?} at {time}: {found} and not {expected}");
        }
    }
}

/// A driver that moves its body for 50 ms, and a mass on a spring behind it.
#[test]
fn a_short_motion_of_a_driver_is_not_missed() {
    let scene = parse(
        r#"{ "name": "blip", "dimension": 2, "ground": { "markers": { "O": [0, 0] } },
            "bodies": [{ "name": "a", "type": "rigid", "mass": 1, "inertia": 1 },
                       { "name": "m", "type": "point_mass", "mass": 1, "initial": { "position": [1, 0] } }],
            "joints": [{ "name": "p", "type": "prismatic", "between": ["ground.O", "a"] },
                       { "name": "d", "type": "driver", "between": ["ground.O", "a"], "coordinate": "x",
                         "value": "0.1*exp(-((t-5)/0.02)^2)" }],
            "forces": [{ "name": "k", "type": "spring_damper", "between": ["a", "m"], "stiffness": 100,
                         "free_length": 1, "damping": 1 }],
            "outputs": [{ "name": "mx", "measure": "position", "of": "m", "component": "x" }],
            "simulation": { "t_end": 10 } }"#,
    );
    let run = |names| scene.run(&method(names, 1e-9), Span { start: 0.0, end: 10.0, output_step: 5.3 }).column("mx");
    let expected = scene.run(&dop853(1e-12), Span { start: 0.0, end: 10.0, output_step: 5.3 }).column("mx");
    assert!((expected[1] - 1.0).abs() > 1e-3);
    for names in ADAPTIVE {
        let found = run(names);
        let error = found.iter().zip(&expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(error < 1e-5, "{names:?}: {found:?} and not {expected:?}");
    }
}

/// A road of a thousand measured points: about a step a knot, and hardly one refused.
#[test]
fn a_measured_road_costs_a_step_a_knot() {
    let points: Vec<String> =
        (0..1000).map(|k| format!("{}, {:.9}", 0.0025 * f64::from(k), 0.004 * (0.37 * f64::from(k)).sin())).collect();
    let scene = parse(&format!(
        r#"{{ "name": "road", "dimension": 2, "gravity": [0, -9.81],
            "bodies": [{{ "name": "m", "type": "point_mass", "mass": 40, "initial": {{ "position": [0, 0.3] }} }}],
            "forces": [{{ "name": "tyre", "type": "tyre", "at": "m", "stiffness": 160000, "damping": 400, "radius": 0.3,
                          "road": "table(t, {})" }}],
            "simulation": {{ "t_end": 2.5 }} }}"#,
        points.join(", ")
    ));
    let (outcome, _) = attempt(&scene, &method(["index1", "dop853", "manifold"], 1e-8), 2.5);
    assert_eq!(outcome.failure, None);
    let statistics = outcome.statistics;
    assert!(statistics.steps < 1100 && statistics.rejected < 50, "{statistics:?}");
}

/// Where what is prescribed has a kink the velocities jump, by an impulse of the drive, whose work is counted.
#[test]
fn a_kink_of_a_driver_is_an_impulse() {
    let scene = parse(&driven("max(0, t - 0.3)"));
    for names in ADAPTIVE {
        let (outcome, record) = attempt(&scene, &method(names, 1e-8), 1.0);
        assert_eq!(outcome.failure, None, "{names:?}");
        assert!((outcome.v[0] - 1.0).abs() < 1e-7 && (outcome.q[0] - 0.7).abs() < 1e-7, "{names:?}: {outcome:?}");
        assert!(record.energy.unwrap().max_error < 1e-6, "{names:?}: {:?}", record.energy);
    }
}

/// Nothing follows a jump.
#[test]
fn a_jump_of_a_driver_ends_the_run() {
    let scene = parse(&driven("0.1*step(t - 0.3)"));
    for names in ADAPTIVE {
        let (outcome, _) = attempt(&scene, &method(names, 1e-8), 1.0);
        let failure = outcome.failure.unwrap_or_else(|| panic!("{names:?}"));
        assert_eq!(failure.t, 0.3);
        assert!(failure.reason.contains("`joint.d.x` prescribes jumps by 0.1"), "{failure:?}");
    }
}

/// A wheel of 2 kg on a tyre of 5000 N/m at rest at 0.3 - 2 g/5000 + road.
fn wheel(signals: &str, road: &str, damping: f64) -> Ready {
    parse(&format!(
        r#"{{ "name": "wheel", "dimension": 2, "gravity": [0, -10], "signals": [{signals}],
            "bodies": [{{ "name": "a", "type": "point_mass", "mass": 2, "initial": {{ "position": [0, 0.296] }} }}],
            "forces": [{{ "name": "tyre", "type": "tyre", "at": "a", "stiffness": 5000, "damping": {damping}, "radius": 0.3,
                         "road": "{road}" }}] }}"#
    ))
}

/// Of an edge c would make an impulse with energy without bound; k does the work by which it loads the tyre: the wheel
/// swings by 0.02 (1 - cos 50 (t - 0.3)).
#[test]
fn a_road_that_jumps_is_refused_under_a_damper() {
    let edge = r#"{ "name": "edge", "points": [[0, 0], [0.3, 0.02], [1, 0.02]], "interpolation": "previous" }"#;
    for (signals, road, named) in [("", "0.02*step(t - 0.3)", ""), (edge, "edge(t)", " `edge`")] {
        let damped = wheel(signals, road, 10.0);
        let sprung = wheel(signals, road, 0.0);
        for names in ADAPTIVE {
            let failure = attempt(&damped, &method(names, 1e-8), 1.0).0.failure;
            let failure = failure.unwrap_or_else(|| panic!("{names:?}"));
            let reason = format!("the road{named} under `tyre` jumps by 0.02 m, which its damper cannot follow");
            assert!(failure.t == 0.3 && failure.reason == reason, "{names:?}: {failure:?}");
            let (outcome, record) = attempt(&sprung, &method(names, 1e-8), 0.5);
            let energy = record.energy.unwrap_or_else(|| panic!("{names:?}"));
            // 1.4 J come in at the edge; errors of 1e-8 grow over 1.6 periods.
            assert!((outcome.q[1] - 0.296 - 0.02 * (1.0 - 10.0_f64.cos())).abs() < 1e-7, "{names:?}: {outcome:?}");
            assert!((energy.work - 1.4).abs() < 1e-6 && energy.max_error < 1e-6, "{names:?}: {energy:?}");
        }
    }
}

fn driven(value: &str) -> String {
    format!(
        r#"{{ "name": "driven", "dimension": 2, "ground": {{ "markers": {{ "O": [0, 0] }} }},
            "bodies": [{{ "name": "a", "type": "point_mass", "mass": 2 }}],
            "joints": [{{ "name": "d", "type": "driver", "between": ["ground.O", "a"], "coordinate": "x",
                         "value": "{value}" }}],
            "simulation": {{ "t_end": 1 }} }}"#
    )
}
