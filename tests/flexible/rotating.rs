//! Beams in steady rotation: closed forms and published frequencies, and all frames against one another.

use crate::scenes::{Ready, parse, shipped};
use holonom::linearize::{Chart, Linear, Operating, State, at_rest};
use holonom::method_spec::MethodSpec;
use holonom::simulate::Span;
use holonom::system::Rotating;

fn mcs() -> Linear {
    Linear { method: MethodSpec::named("mcs"), chart: None }
}

/// Angular frequencies of a model about rest in turning axes, from the slowest, each pair once.
pub fn frequencies(scene: &Ready) -> Vec<f64> {
    let operating = at_rest(&scene.0, &State::start(&scene.0)).unwrap();
    assert!(operating.doubt.is_none(), "{:?}", operating.doubt);
    assert!(operating.variation().unwrap().point.axes.is_some());
    spectrum(&operating).into_iter().map(|(_, im)| im).collect()
}

/// Real and imaginary parts, the upper half from the slowest.
fn spectrum(operating: &Operating) -> Vec<(f64, f64)> {
    let model = operating.variation().unwrap().linearize(&mcs()).unwrap();
    assert!(model.point.is_equilibrium);
    let mut upper: Vec<_> =
        model.modes.iter().map(|mode| (mode.value.re, mode.value.im)).filter(|(_, im)| *im > 0.0).collect();
    upper.sort_by(|a, b| a.1.total_cmp(&b.1));
    upper
}

/// Angular frequencies about the start, which is at rest.
pub fn frequencies_at_start(scene: &Ready) -> Vec<f64> {
    spectrum(&Operating::moving(&scene.0, State::start(&scene.0))).into_iter().map(|(_, im)| im).collect()
}

/// The frequency nearest to the exact one, in parts of it.
#[track_caller]
pub fn assert_has(found: &[f64], exact: f64, tolerance: f64, what: &str) {
    let error = found.iter().map(|x| (x / exact - 1.0).abs()).fold(f64::INFINITY, f64::min);
    assert!(error < tolerance, "{what}: {exact} missed by {error:.1e} of it in {:?}", &found[..found.len().min(8)]);
}

const FRAMES: [&str; 6] = [
    r#""frame": "floating", "elements": 8"#,
    r#""frame": "floating", "elements": 8, "frame_conditions": "chord""#,
    r#""frame": "floating", "elements": 8, "frame_conditions": "mean""#,
    r#""frame": "floating", "elements": 8, "modes": 8, "frame_conditions": "chord""#,
    r#""frame": "floating", "ritz": { "bending": ["x^2", "x^3", "x^4", "x^5"], "bending_z": ["x^2", "x^3", "x^4", "x^5"],
        "torsion": ["sin(pi*x/2)", "sin(3*pi*x/2)"] }"#,
    r#""frame": "absolute", "elements": 16"#,
];

/// A cantilever of length 1 on a driven hub, which turns about the axis into which `axis` brings z.
pub fn driven(beam: &str, axis: &str, speed: f64) -> Ready {
    parse(&format!(
        r#"{{ "name": "driven", "dimension": 3,
        "ground": {{ "markers": {{ "hub": {{ "position": [0, 0, 0], "rotation": {axis} }} }} }},
        "bodies": [{{ "name": "beam", "type": "flexible_beam", "length": 1, {beam},
            "markers": {{ "root": {{ "position": [0, 0, 0], "rotation": {axis} }}, "tip": [1, 0, 0] }} }}],
        "joints": [
            {{ "name": "hub", "type": "revolute", "between": ["ground.hub", "beam.root"] }},
            {{ "name": "drive", "type": "driver", "between": ["ground.hub", "beam.root"], "coordinate": "angle",
                "value": "{speed}*t" }}] }}"#
    ))
}

/// w^2 = wT^2 + W^2 (Iz - Iy)/(Iz + Iy), the propeller moment, in every frame: with G J = 1 and rho (Iy + Iz) = 1e-3 a blade
/// of length 1 has wT = pi/2 sqrt(1000). An element with a linear twist is stiffer by (k h)^2/24, k = pi/2: 1.6e-3 of 8.
#[test]
fn the_propeller_moment_is_that_of_a_rigid_section() {
    let torsion = std::f64::consts::FRAC_PI_2 * 1000f64.sqrt();
    for (i, frame) in FRAMES.iter().enumerate() {
        for stiffening in [false, true].into_iter().filter(|on| !*on || [0, 1, 2].contains(&i)) {
            for speed in [20.0, 50.0, 100.0] {
                let keys = if i == 5 { "" } else { r#", "rotary_inertia": true"# };
                let more = if stiffening { r#", "geometric_stiffening": true"# } else { "" };
                let beam = format!(
                    r#"{frame}{keys}{more}, "stiffness": {{ "EA": 1e6, "EI": [50, 100], "GJ": 1 }},
                    "inertia": {{ "rhoA": 1, "rhoI": [1e-4, 9e-4] }}"#
                );
                let found = frequencies(&driven(&beam, "[0, 0, 0]", speed));
                let exact = (torsion * torsion + 0.8 * speed * speed).sqrt();
                assert_has(&found, exact, 1.8e-3, &format!("{frame} {stiffening} {speed}"));
            }
        }
    }
}

/// A thick shaft clamped at its driven end, r^2 = 0.01: whirling forward and backward in axes that turn with it.
#[test]
fn the_whirl_of_a_clamped_shaft_depends_on_no_frame() {
    let shaft = |frame: &str| {
        let keys = if frame.contains("absolute") { "" } else { r#", "rotary_inertia": true"# };
        format!(
            r#"{frame}{keys}, "stiffness": {{ "EA": 1e7, "EI": 802.4, "GJ": 1e5 }},
            "inertia": {{ "rhoA": 1, "rhoI": 0.01 }}"#
        )
    };
    let of = |frame: &str| frequencies(&driven(&shaft(frame), r#"[0, "pi/2", 0]"#, 50.0));
    let tangent = of(FRAMES[0]);
    // The same shapes in another frame: rounding. Others: what 8 modes, 4 functions and 16 elements leave of the first whirl.
    for (frame, tolerance) in
        [(FRAMES[1], 1e-9), (FRAMES[2], 1e-8), (FRAMES[3], 3e-5), (FRAMES[4], 3e-5), (FRAMES[5], 3e-4)]
    {
        let found = of(frame);
        for k in 0..2 {
            assert!((found[k] / tangent[k] - 1.0).abs() < tolerance, "{frame}: {:?} {:?}", &found[..4], &tangent[..4]);
        }
    }
}

/// (1 + r2 k^2) F^2 - 2 r2 k^2 W F = EI k^4/rhoA of the whirl in space, and F - W in the axes of the shaft.
fn whirl(mode: f64, r2: f64, speed: f64) -> [f64; 2] {
    let k2 = (mode * std::f64::consts::PI).powi(2);
    let a = 1.0 + r2 * k2;
    let b = r2 * k2 * speed;
    let c = 100.0 * k2 * k2;
    let root = (b * b + a * c).sqrt();
    [(b + root) / a - speed, (b - root) / a - speed]
}

#[test]
fn the_shipped_shaft_whirls_as_jeffcott_and_rayleigh_say() {
    for speed in [10.0, 50.0, 150.0] {
        let found = frequencies(&shipped("rotating_shaft", &[("speed", speed), ("damping", 0.0)]));
        // Cubic bending in 8 elements: (k h)^4/720 of the stiffness, 1.7e-5 of the first frequency, 3e-4 of the second.
        for (mode, tolerance) in [(1.0, 1e-4), (2.0, 1.5e-3)] {
            for exact in whirl(mode, 0.01, speed) {
                assert_has(&found, exact.abs(), tolerance, &format!("mode {mode} at {speed}"));
            }
        }
    }
}

/// Damping that turns with the shaft drives the forward whirl where the shaft overtakes it, F < W.
#[test]
fn damping_in_the_shaft_makes_it_unstable_above_the_critical_speed() {
    for (r2, critical) in [(1e-6, 98.696), (0.01, 103.96)] {
        for (part, grows) in [(0.99, false), (1.01, true)] {
            let shaft = shipped("rotating_shaft", &[("speed", part * critical), ("r2", r2), ("damping", 1e-4)]);
            let operating = at_rest(&shaft.0, &State::start(&shaft.0)).unwrap();
            let model = operating.variation().unwrap().linearize(&mcs()).unwrap();
            let most = model.modes.iter().map(|mode| mode.value.re).fold(f64::NEG_INFINITY, f64::max);
            assert_eq!(most > 0.0, grows, "{most:e} at {part} of {critical}");
        }
    }
}

/// Wright and others 1982, table 2: flapping; lagging has the square less by the speed's.
#[test]
fn the_shipped_blade_flaps_and_lags_as_published() {
    let published = [(1.0, 3.6816, 22.1810), (4.0, 5.5850, 24.2733), (8.0, 9.2568, 29.9954), (12.0, 13.1702, 37.6031)];
    for (speed, first, second) in published {
        let found = frequencies(&shipped("rotating_blade", &[("speed", speed)]));
        // 16 elements of order 2 leave 2e-4 of the second mode; the blade stretches by up to 1e-4.
        for flap in [first, second] {
            let lag = (flap * flap - speed * speed).sqrt();
            assert_has(&found, flap, 3e-4, &format!("flap at {speed}"));
            assert_has(&found, lag, 4e-4, &format!("lag at {speed}"));
        }
    }
}

/// In axes that turn along all charts and methods say the same.
#[test]
fn a_steady_rotation_has_one_spectrum() {
    let blade = shipped("rotating_blade", &[("speed", 6.0)]);
    let operating = at_rest(&blade.0, &State::start(&blade.0)).unwrap();
    let slowest = |method: &str, chart: Option<Chart>| {
        let request = Linear { method: MethodSpec::named(method), chart };
        let model = operating.variation().unwrap().linearize(&request).unwrap();
        model.modes.iter().map(|mode| mode.value.im).filter(|im| *im > 1.0).fold(f64::INFINITY, f64::min)
    };
    let first = slowest("mcs", None);
    for (method, chart) in [("mcs", Some(Chart::MassOrthogonal)), ("mcs", Some(Chart::Frozen)), ("rcs", None)] {
        let other = slowest(method, chart.clone());
        // Frequencies of up to 6e4 rad/s are in the same matrix: their rounding in the square of the slowest.
        assert!((other / first - 1.0).abs() < 1e-6, "{method} {chart:?}: {other} {first}");
    }
}

/// All frames at rising speed, against one another.
#[test]
fn lag_and_flap_agree_in_all_frames_as_the_speed_rises() {
    for speed in [1.0, 4.0, 12.0] {
        let of = |frame: &str| {
            let beam = format!(
                r#"{frame}, "stiffness": {{ "EA": 1e6, "EI": 1, "GJ": 1e3 }}, "inertia": {{ "rhoA": 1, "rhoI": 1e-8 }}"#
            );
            frequencies(&driven(&beam, "[0, 0, 0]", speed))
        };
        let floating = |i: usize| {
            of(&format!("{}, \"geometric_stiffening\": true", FRAMES[i]).replace("\"elements\": 8", "\"elements\": 16"))
        };
        let exact = of(FRAMES[5]);
        // The mean slope of an element stiffens it: order 2 in its length, more in the tangent frame, whose slopes are
        // larger: 1e-3 with 16 elements at speed 12.
        for i in 0..3 {
            let found = floating(i);
            for k in 0..4 {
                assert!((found[k] / exact[k] - 1.0).abs() < 1.8e-3, "{i} {speed}: {:?} {:?}", &found[..4], &exact[..4]);
            }
        }
    }
}

/// Few modes, and functions without axial ones, keep the length of the line: centrifugal forces stiffen them as they do
/// finite elements that stretch, and a thrust softens them.
#[test]
fn few_coordinates_are_stiffened_by_the_shortening_of_the_line() {
    let powers = (2..9).map(|k| format!(r#""x^{k}""#)).collect::<Vec<_>>().join(", ");
    let polynomials = format!(r#""bending": [{powers}], "bending_z": [{powers}]"#);
    let makes = [
        r#""elements": 16, "modes": 12"#.to_string(),
        r#""elements": 16, "modes": 12, "frame_conditions": "chord""#.to_string(),
        r#""elements": 16, "modes": 12, "frame_conditions": "mean""#.to_string(),
        format!(r#""ritz": {{ {polynomials} }}"#),
    ];
    for make in makes {
        for (speed, first, second) in [(4.0f64, 5.5850f64, 24.2733f64), (12.0, 13.1702, 37.6031)] {
            let beam = format!(
                r#""frame": "floating", {make}, "geometric_stiffening": true,
                "stiffness": {{ "EA": 1e6, "EI": 1, "GJ": 1e3 }}, "inertia": {{ "rhoA": 1, "rhoI": 1e-8 }}"#
            );
            let found = frequencies(&driven(&beam, "[0, 0, 0]", speed));
            // Wright's numbers have five digits; the shapes are as good.
            for flap in [first, second] {
                let lag = (flap * flap - speed * speed).sqrt();
                assert_has(&found, flap, 3e-4, &format!("{make}: flap at {speed}"));
                assert_has(&found, lag, 1.5e-3, &format!("{make}: lag at {speed}"));
            }
        }
    }
}

/// The equations in turning axes are those of the world: a blade that is struck moves alike in both.
#[test]
fn a_motion_is_the_same_in_both_axes() {
    let beam = r#""frame": "floating", "elements": 2, "frame_conditions": "chord", "rotary_inertia": true,
        "stiffness": { "EA": 1e3, "EI": [5, 10], "GJ": 1 }, "inertia": { "rhoA": 1, "rhoI": [1e-3, 9e-3] },
        "initial": { "angular_velocity": [0, 0, 3], "elastic_velocity": { "n2_rx": 2, "n1_y": 0.3, "n1_z": -0.4 } }"#;
    let scene = driven(beam, "[0, 0, 0]", 3.0);
    let end = 0.7;
    let world = scene.tight(1e-10, end, end);
    let system = scene.system();
    let axes = Rotating::new(system, 0.0, system.prescribed_spin(0.0).unwrap()).unwrap();
    let mut v = scene.start().v.clone();
    v[5] -= 3.0;
    let mut last = Last;
    let span = Span { start: 0.0, end, output_step: end };
    let outcome =
        holonom::simulate::simulate(&axes, &crate::scenes::dop853(1e-10), span, (&scene.start().q, &v), &mut last)
            .unwrap();
    assert!(outcome.failure.is_none());
    // Elastic coordinates are the same from all sides.
    let names = system.facts().names.q.clone();
    for (k, name) in names.iter().enumerate().skip(7) {
        let there = *world.column(name).last().unwrap();
        assert!((outcome.q[k] - there).abs() < 1e-8, "{name}: {} {there}", outcome.q[k]);
    }
}

struct Last;

impl holonom::simulate::Sink for Last {
    fn accepted(&mut self, _: &holonom::simulate::Observation) {}
    fn row(&mut self, _: &holonom::simulate::Observation) {}
}

/// What is not the same all around the axis is not steady: weight across it, a spring to one side, a second wall.
#[test]
fn a_mechanism_with_a_side_is_not_taken_for_steady() {
    let beam = r#""frame": "absolute", "elements": 2, "stiffness": { "EA": 1e3, "EI": 10, "GJ": 10 },
        "inertia": { "rhoA": 1, "rhoI": 1e-3 }"#;
    let text = |more: &str, gravity: &str| {
        format!(
            r#"{{ "name": "sided", "dimension": 3, "gravity": {gravity},
            "ground": {{ "markers": {{ "hub": [0, 0, 0], "wall": [0, 0, 1], "side": [0, 2, 0] }} }},
            "bodies": [{{ "name": "beam", "type": "flexible_beam", "length": 1, {beam},
                "markers": {{ "root": [0, 0, 0], "tip": [1, 0, 0] }} }}],
            "joints": [
                {{ "name": "hub", "type": "revolute", "between": ["ground.hub", "beam.root"] }},
                {{ "name": "drive", "type": "driver", "between": ["ground.hub", "beam.root"], "coordinate": "angle",
                    "value": "3*t" }}],
            "forces": [{more}] }}"#
        )
    };
    let spring = |to: &str| {
        format!(
            r#"{{ "name": "s", "type": "spring_damper", "between": ["ground.{to}", "beam.tip"], "stiffness": 5,
            "free_length": 1 }}"#
        )
    };
    let cases = [
        (spring("wall"), "[0, 0, -1]", true),
        (spring("side"), "[0, 0, 0]", false),
        (String::new(), "[0, -1, 0]", false),
    ];
    for (force, gravity, is_steady) in cases {
        let scene = parse(&text(&force, gravity));
        let operating = at_rest(&scene.0, &State::start(&scene.0)).unwrap();
        assert_eq!(operating.doubt.is_none(), is_steady, "{force} {gravity}");
    }
}
