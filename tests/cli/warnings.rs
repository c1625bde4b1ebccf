use super::*;

/// The warnings of a run, which standard error says once, too.
fn warnings(scene: &str, more: &[&str]) -> Vec<String> {
    let place = Place::new(scene);
    let output = place.run(&[&["simulate", "scene.json", "-o", "here", "--figures", "none"], more].concat());
    let error = String::from_utf8(output.stderr).unwrap();
    let found = place.json("here/summary.json")["warnings"].clone();
    let found: Vec<String> = serde_json::from_value(found).unwrap();
    for warning in &found {
        let said = error.replace("\n  help: ", "; ");
        assert_eq!(said.matches(&format!("warning: {warning}")).count(), 1, "{error}");
    }
    found
}

/// A mass of 1e-8 kg on a spring of 1e10 N/m that is swung round: steps as long as the swing damp what the spring
/// holds.
const SWUNG: &str = r#"{
  "name": "swung", "dimension": 2, "ground": { "markers": { "O": [0, 0] } },
  "bodies": [
    { "name": "a", "type": "point_mass", "mass": 1, "initial": { "position": [1, 0] } },
    { "name": "b", "type": "point_mass", "mass": 1e-8, "initial": { "position": [2, 0], "velocity": [0, 1] } } ],
  "joints": [ { "name": "d", "type": "distance", "between": ["ground.O", "a"], "length": 1 } ],
  "forces": [ { "name": "f", "type": "spring_damper", "between": ["a", "b"], "stiffness": 1e10, "free_length": 1 } ],
  "simulation": { "t_end": 1, "formulation": "ggl", "integrator": "generalized_alpha", "projection": "none",
                  "rtol": 1e-6, "atol": 1e-8 }
}"#;

#[test]
fn an_energy_balance_that_does_not_close_is_a_warning() {
    let found = warnings(SWUNG, &["--rtol", "1e-3", "--atol", "1e-5"]);
    assert!(found[0].contains("the energy balance does not close") && found[0].contains('%'), "{found:?}");
    let found = warnings(PENDULUM, &["--integrator", "heun", "--step", "0.1"]);
    assert!(found[0].contains("the energy balance does not close"), "{found:?}");
    for more in [&[][..], &["--rtol", "1e-4", "--atol", "1e-4"], &["--integrator", "rk4", "--step", "0.01"]] {
        assert_eq!(warnings(PENDULUM, more), [""; 0], "{more:?}");
    }
}

/// Steps of order 3 would have to be controlled to 1e-13.
#[test]
fn a_tolerance_out_of_reach_is_a_warning() {
    let esdirk = ["--integrator", "esdirk34", "--projection", "none"];
    let asked = |rtol: &str| warnings(PENDULUM, &[&esdirk[..], &["--rtol", rtol, "--atol", "1e-10"]].concat());
    assert_eq!(asked("1e-7"), [""; 0]);
    let found = asked("1e-9");
    assert!(
        found.len() == 1 && found[0].contains("esdirk34 comes to errors of about 3e-8, not to rtol 1e-9"),
        "{found:?}"
    );
    assert!(found[0].contains("dop853"), "{found:?}");
    assert_eq!(warnings(PENDULUM, &["--rtol", "1e-11", "--atol", "1e-13"]), [""; 0]);
}

/// The spin of 200 rad/s is rounded to more than the tolerated error of the other velocities; at 1e-6 it is not.
#[test]
fn errors_at_round_off_are_told() {
    let scene = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/models/spinning_top.json")).unwrap();
    let bdf = ["--formulation", "ggl", "--integrator", "bdf", "--projection", "none", "--until", "0.2"];
    let asked = |rtol: &str, atol: &str| warnings(&scene, &[&bdf[..], &["--rtol", rtol, "--atol", atol]].concat());
    assert_eq!(asked("1e-6", "1e-8"), [""; 0]);
    let found = asked("1e-9", "1e-11");
    assert!(found.len() == 1 && found[0].contains("steps end at round-off, not at the tolerance"), "{found:?}");
}

/// What is left of an energy that is nothing has no relative size.
#[test]
fn a_body_at_rest_has_no_relative_error() {
    let place = Place::new(
        PENDULUM.replace(r#""position": [0.5, 0], "angle": 0"#, r#""position": [0, -0.5], "angle": "-pi/2""#),
    );
    let text = place.done(&["simulate", "scene.json", "-o", "here"]);
    assert!(place.json("here/summary.json")["energy"]["relative_max_error"].is_null());
    assert!(!text.contains("turned over"), "{text}");
}

/// A pendulum of a nanometre, with a tolerance of its own size.
#[test]
fn tolerances_follow_the_length_of_the_scene() {
    let scene = r#"{
      "name": "small", "dimension": 2, "gravity": [0, -1e-8], "ground": { "markers": { "O": [0, 0] } },
      "bodies": [ { "name": "m", "type": "point_mass", "mass": 1, "initial": { "position": [1e-8, 0] } } ],
      "joints": [ { "name": "r", "type": "distance", "between": ["ground.O", "m"], "length": 1e-8 } ],
      "simulation": { "t_end": 20 }
    }"#;
    let place = Place::new(scene);
    place.done(&["simulate", "scene.json", "-o", "here", "--quiet"]);
    let summary = place.json("here/summary.json");
    assert_eq!(summary["method"]["atol"], 1e-16);
    // rtol 1e-8 over three swings.
    assert!(summary["energy"]["relative_max_error"].as_f64().unwrap() < 1e-6, "{}", summary["energy"]);
    assert_eq!(warnings(scene, &[]), [""; 0]);
    let found = warnings(scene, &["--atol", "1e-8"]);
    assert!(found[0].contains("the energy balance does not close"), "{found:?}");
}

/// A hinged body in space that starts turned and shifted.
fn hinged(rotation: &str, position: &str) -> String {
    format!(
        r#"{{ "name": "hinged", "dimension": 3,
            "bodies": [ {{ "name": "m", "type": "rigid", "mass": 1, "inertia": [1, 1, 1], "markers": {{ "A": [0.5, 0, 0] }},
                           "initial": {{ "rotation": {rotation}, "position": {position} }} }} ],
            "joints": [ {{ "name": "h", "type": "revolute", "between": ["ground", "m"] }} ],
            "simulation": {{ "t_end": 0.1 }} }}"#
    )
}

/// A rod that a pin and a drive hold level, with its centre 0.5 m beside the pin; its guess is turned about the pin.
fn pinned(dimension: usize, degrees: i32) -> String {
    let angle = f64::from(degrees).to_radians();
    let (pivot, at, inertia, initial) = match dimension {
        2 => ("[0, 0]", "[-0.5, 0]", "0.1", format!(r#""angle": {angle}"#)),
        _ => ("[0, 0, 0]", "[-0.5, 0, 0]", "[0.1, 0.1, 0.1]", format!(r#""rotation": [0, 0, {angle}]"#)),
    };
    format!(
        r#"{{ "name": "pinned", "dimension": {dimension}, "ground": {{ "markers": {{ "A": {pivot} }} }},
            "bodies": [ {{ "name": "rod", "type": "rigid", "mass": 1, "inertia": {inertia}, "markers": {{ "A": {at} }},
                           "initial": {{ {initial} }} }} ],
            "joints": [ {{ "name": "A", "type": "revolute", "between": ["ground.A", "rod.A"] }},
                        {{ "name": "held", "type": "driver", "between": ["ground.A", "rod.A"], "coordinate": "angle",
                           "value": 0 }} ],
            "simulation": {{ "t_end": 0.1 }} }}"#
    )
}

#[test]
fn a_doubtful_start_is_said() {
    assert_eq!(warnings(&hinged("[0.1, 0, 0]", "[0.1, 0, 0]"), &[]), [""; 0]);
    let found = warnings(&hinged("[0, 0, 90]", "[0, 0, 0]"), &[]);
    assert!(found[0].contains("`m`") && found[0].contains("90*pi/180"), "{found:?}");
    let found = warnings(&hinged("[0, 0, 0]", "[5, 0, 0]"), &[]);
    assert!(found[0].contains("`m.x`") && found[0].contains("from 5 to 0"), "{found:?}");
    // The way to the other side is shorter from here.
    let found = warnings(&hinged("[2, 0, 0]", "[0, 0, 0]"), &[]);
    assert!(found[0].contains("`h`") && found[0].contains("against each other"), "{found:?}");
    // Meant so.
    assert_eq!(warnings(&hinged("[\"pi\", 0, 0]", "[0, 0, 0]"), &[]), [""; 0]);
    let found = warnings(&PENDULUM.replace(r#""angle": 0"#, r#""angle": 6.5"#), &[]);
    assert!(found[0].contains("6.5*pi/180"), "{found:?}");
    // A rod whose end lies 40 or 20 degrees beside its pin.
    for (dimension, degrees) in [(2, 40), (3, 40), (2, 20), (3, 20)] {
        let found = warnings(&pinned(dimension, degrees), &[]);
        match degrees {
            40 => assert!(found.len() == 1 && found[0].contains("assembly turned `rod` by 4"), "{found:?}"),
            _ => assert_eq!(found, [""; 0]),
        }
    }
    // Where the joints do not close it is the remedy.
    let rod = r#""joints": [ { "name": "B", "type": "distance", "between": ["ground.O", "rod"], "length": 9 },"#;
    let far = PENDULUM.replace(r#""angle": 0"#, r#""angle": 60"#).replace(r#""joints": ["#, rod);
    let place = Place::new(far);
    let output = place.run(&["simulate", "scene.json"]);
    let error = String::from_utf8(output.stderr).unwrap();
    assert!(error.contains("cannot all be closed") && error.contains("60*pi/180"), "{error}");
}

/// Every command that reads a scene says once what is doubtful about its start, and before it fails.
#[test]
fn every_command_says_a_doubtful_start_once() {
    let scene = PENDULUM
        .replace(r#""angle": 0"#, r#""angle": 6.5"#)
        .replace(r#""gravity""#, r#""parameters": { "l": 1 }, "gravity""#)
        .replace(r#""outputs""#, r#""inputs": [{ "name": "u", "force": "push", "component": "x" }], "outputs""#);
    let place = Place::new(scene);
    let commands: [&[&str]; 13] = [
        &["check"],
        &["simulate"],
        &["kinematics", "l=1..2:3"],
        &["study", "--vary", "l=1..2:3"],
        &["drift"],
        &["tradeoff", "--budget", "1s", "--repeats", "1"],
        &["stress", "--map", "gain", "--budget", "1"],
        &["plot"],
        &["linearize"],
        &["loci", "--every", "0.5"],
        &["bode"],
        &["validate"],
        &["transition", "--lyapunov", "0.5"],
    ];
    for command in commands {
        let args = [&command[..1], &["scene.json"], &command[1..]].concat();
        let written = if command[0] == "check" { &[][..] } else { &["-o", "here", "--figures", "svg"] };
        let output = place.run(&[&args, written].concat());
        assert_ne!(output.status.code(), Some(2), "{command:?}: {}", err(&output));
        assert_eq!(err(&output).matches("6.5*pi/180").count(), 1, "{command:?}: {}", err(&output));
        let quiet = place.run(&[&args[..], &["--quiet"], written].concat());
        assert!(!err(&quiet).contains("6.5*pi/180"), "{command:?}: {}", err(&quiet));
    }
}

/// A penalty that holds nothing leaves no gap between motions on and off the constraints.
#[test]
fn kinds_that_are_not_known_are_said_once() {
    let place = Place::new(PENDULUM);
    let weak = ["--method", "penalty:penalty=1e-3", "-o", "here", "--figures", "none"];
    for command in [&["linearize", "scene.json", "--at", "0,0.5,1"][..], &["loci", "scene.json", "--every", "0.5"]] {
        let output = place.run(&[command, &weak].concat());
        assert_eq!(output.status.code(), Some(0), "{}", err(&output));
        assert_eq!(err(&output).matches("uncertain by penalty:penalty=1e-3:").count(), 1, "{}", err(&output));
    }
    let output = place.run(&["linearize", "scene.json", "-o", "here"]);
    assert!(!err(&output).contains("uncertain"), "{}", err(&output));
}

/// A block on a bushing that a torque turns by what is given.
fn bushed(torque: f64, stiffness: &str) -> String {
    format!(
        r#"{{ "name": "bushed", "dimension": 3,
            "bodies": [ {{ "name": "b", "type": "rigid", "mass": 1, "inertia": [1, 1, 1] }} ],
            "forces": [ {{ "name": "rubber", "type": "bushing", "between": ["ground", "b"],
                           "stiffness": [1, 1, 1, {stiffness}], "damping": [0, 0, 0, {stiffness}] }},
                        {{ "name": "turn", "type": "applied_torque", "at": "b", "torque": [0, 0, {torque}] }} ],
            "simulation": {{ "t_end": 5 }} }}"#
    )
}

/// Beyond a quarter of a turn the torque falls again: what follows is no motion of a bushing.
#[test]
fn a_bushing_that_turns_far_is_a_warning() {
    assert_eq!(warnings(&bushed(0.3, "1, 1, 1"), &[]), [""; 0]);
    let found = warnings(&bushed(2.0, "1, 1, 1"), &[]);
    assert!(found[0].contains("`rubber` turns by") && found[0].contains("torsion_spring"), "{found:?}");
    // One that holds no rotation takes none to be small.
    assert_eq!(warnings(&bushed(2.0, "0, 0, 0"), &[]), [""; 0]);
}

/// Half a revolution between two evaluations may be one the other way round.
#[test]
fn fixed_steps_that_do_not_see_a_turn_are_a_warning() {
    let spun = |dimension: &str, inertia: &str, spin: &str| {
        format!(
            r#"{{ "name": "spun", "dimension": {dimension},
                "bodies": [ {{ "name": "rotor", "type": "rigid", "mass": 1, "inertia": {inertia},
                               "initial": {{ "angular_velocity": {spin} }} }} ],
                "simulation": {{ "t_end": 1 }} }}"#
        )
    };
    // rk4 evaluates in the middle, too; Radau IIA of order 5 at 0, 0.155, 0.645 and 1 of a step.
    for (scene, bound) in [(spun("2", "1", "100"), 0.0628), (spun("3", "[1, 2, 3]", "[0, 0, 100]"), 0.0628)] {
        for (integrator, formulation, factor) in [("rk4", "index1", 1.0), ("radau_iia:order=5", "ggl", 0.5 / 0.49)] {
            for (part, count) in [(0.99, 0), (1.01, 1)] {
                let step = (part * factor * bound).to_string();
                let method = ["--integrator", integrator, "--formulation", formulation, "--projection", "none"];
                let found = warnings(&scene, &[&method[..], &["--step", &step]].concat());
                let said = found.iter().filter(|warning| warning.contains("`rotor` turns by")).count();
                assert_eq!(said, count, "{integrator} {step}: {found:?}");
            }
        }
    }
    // Quaternions limit controlled steps; the angle in the plane does not, and nothing but its own rate depends on it.
    assert_eq!(warnings(&spun("3", "[1, 2, 3]", "[0, 0, 100]"), &[]), [""; 0]);
    let found = warnings(&spun("2", "1", "100"), &[]);
    assert!(found.len() == 1 && found[0].contains("`rotor` turns by") && found[0].contains("--step"), "{found:?}");
}

/// A tolerance that nothing is controlled by.
#[test]
fn a_tolerance_beside_a_fixed_step_is_a_warning() {
    let scene = SWUNG.replace("\"t_end\": 1", "\"t_end\": 0.1, \"step\": 1e-3");
    let found = warnings(&scene, &["--rtol", "1e-6"]);
    assert!(found.iter().any(|warning| warning.contains("--rtol has no effect") && warning.contains("--adaptive")));
    for option in [&["--adaptive"][..], &["--step", "0"]] {
        let found = warnings(&scene, &[&["--rtol", "1e-6"], option].concat());
        assert!(found.iter().all(|warning| !warning.contains("no effect")), "{found:?}");
    }
}

/// A rubber beam that whips: too coarse with 12 elements, and told how many it takes.
#[test]
fn a_mesh_that_is_too_coarse_is_said() {
    let rubber = |elements: usize| {
        format!(
            r#"{{ "name": "rubber", "dimension": 2, "gravity": [0, -9.81],
            "ground": {{ "markers": {{ "pivot": [0, 0] }} }},
            "bodies": [{{ "name": "rod", "type": "flexible_beam", "frame": "absolute", "length": 1.2, "elements": {elements},
                "stiffness": {{ "EA": 1260, "EI": 0.0085 }}, "inertia": {{ "rhoA": 9.97, "rhoI": 6.7e-5 }},
                "markers": {{ "pivot": [0, 0], "tip": [1.2, 0] }} }}],
            "joints": [{{ "name": "hinge", "type": "revolute", "between": ["ground.pivot", "rod.pivot"] }}],
            "simulation": {{ "t_end": 0.55, "output_step": 0.1, "integrator": "dop853" }} }}"#
        )
    };
    let found = warnings(&rubber(12), &[]);
    assert!(found.len() == 1 && found[0].contains("`rod`") && found[0].contains("energy of bending"), "{found:?}");
    let needed: usize = found[0].split("take ").nth(1).unwrap().split(' ').next().unwrap().parse().unwrap();
    assert!((10..60).contains(&needed), "{found:?}");
    assert_eq!(warnings(&rubber(needed + 12), &[]), [""; 0]);
}

/// A strong and narrow cantilever in a floating frame with a force at its tip, in the direction in which it is strong;
/// it buckles sideways under 4.013 N.
fn narrow(load: f64, more: &str) -> String {
    format!(
        r#"{{ "name": "narrow", "dimension": 3, "ground": {{ "markers": {{ "wall": [0, 0, 0] }} }},
        "bodies": [{{ "name": "blade", "type": "flexible_beam", "frame": "floating", "length": 1, "elements": 4,
            "stiffness": {{ "EA": 1e4, "EI": [1, 100], "GJ": 1 }}, "inertia": {{ "rhoA": 1, "rhoI": 0.01 }} {more},
            "damping": {{ "rayleigh": {{ "stiffness": 0.05 }} }},
            "markers": {{ "root": [0, 0, 0], "tip": [1, 0, 0] }} }}],
        "joints": [{{ "name": "clamp", "type": "weld", "between": ["ground.wall", "blade.root"] }}],
        "forces": [{{ "name": "load", "type": "applied_force", "at": "blade.tip", "force": [{load}, {load}, 0] }}],
        "simulation": {{ "t_end": 0.5, "output_step": 0.1, "formulation": "ggl", "integrator": "radau_iia",
            "projection": "none" }} }}"#
    )
}

/// What a floating frame leaves out is said where loads come near to critical ones, by all that look at a state.
#[test]
fn loads_that_nearly_buckle_a_floating_beam_are_said() {
    let said = |scene: &str, command: &[&str], text: &str| {
        let output = Place::new(scene).run(command);
        assert!(output.status.success(), "{}", err(&output));
        err(&output).contains(text)
    };
    let stiffens = r#", "geometric_stiffening": true"#;
    let commands: [&[&str]; 3] = [
        &["check", "scene.json", "--static"],
        &["linearize", "scene.json", "--equilibrium", "-o", "here"],
        &["simulate", "scene.json", "-o", "here", "--figures", "none"],
    ];
    for command in commands {
        // 3.9 of pi sqrt(1 * 1)/0.99, and of pi^2/2^2. From rest it moves a bit farther.
        let digits = if command[0] == "simulate" { ["", ""] } else { ["1.2 of those", "1.6 of its Euler load"] };
        let moments = &format!("the bending moments of `blade` come to {}", digits[0]);
        let force = &format!("the axial force of `blade` comes to {}", digits[1]);
        assert!(said(&narrow(3.9, ""), command, moments) && said(&narrow(3.9, ""), command, force), "{command:?}");
        assert!(said(&narrow(3.9, stiffens), command, moments), "{command:?}");
        assert!(!said(&narrow(3.9, stiffens), command, force), "{command:?}");
        assert!(!said(&narrow(0.39, ""), command, "warning"), "{command:?}");
    }
}

/// A mass on a spring that is stiffer on one side, at rest where it changes, and on one that is smooth there.
#[test]
fn a_linear_model_where_a_law_has_a_kink_is_a_warning() {
    let scene = |force: &str| {
        format!(
            r#"{{ "name": "mass", "dimension": 2, "ground": {{ "markers": {{ "O": [0, 0] }} }},
              "bodies": [{{ "name": "a", "type": "rigid", "mass": 1, "free": ["x"] }}],
              "forces": [{{ "name": "spring", "type": "applied_force", "at": "a", "force": ["{force}", 0] }}],
              "simulation": {{ "t_end": 1 }} }}"#
        )
    };
    for (force, has_kink) in [("-2*a.x - abs(a.x)", true), ("-2*a.x - a.x*abs(a.x)", false), ("-2*a.x", false)] {
        let place = Place::new(scene(force));
        place.done(&["linearize", "scene.json", "-o", "here", "--figures", "none"]);
        let found = place.json("here/linear-0.json")["warnings"].to_string();
        assert_eq!(found.contains("the force `spring` is where its form changes"), has_kink, "{force}: {found}");
    }
}

/// A wheel of 30 kg on a tyre of radius 0.3 m; it starts at a height of `z`.
fn wheel(stiffness: &str, z: f64, road: &str, more: &str) -> String {
    format!(
        r#"{{ "name": "wheel", "dimension": 2, "gravity": [0, -9.81], {road}
            "bodies": [ {{ "name": "hub", "type": "rigid", "mass": 30, "free": ["y"],
                           "initial": {{ "position": [0, {z}] }} }} ],
            "forces": [ {{ "name": "tyre", "type": "tyre", "at": "hub", "stiffness": {stiffness}, "damping": 300,
                           "radius": 0.3 {more} }} ],
            "simulation": {{ "t_end": 1, "output_step": 0.01 }} }}"#
    )
}

/// 30 kg press the tyre by 1.47 mm. Above the road it pulls, unless it lifts off; with 200 N/m it would sink by 1.47 m.
#[test]
fn a_tyre_that_pulls_or_sinks_is_said() {
    for z in [0.29, 0.3, 0.302] {
        assert_eq!(warnings(&wheel("200e3", z, "", ""), &[]), [""; 0], "{z}");
    }
    let found = warnings(&wheel("200e3", 0.37, "", ""), &[]);
    let text = "at the start the tyre `tyre` is 0.07 m above the road and pulls by 1.4e4 N";
    assert!(found.len() == 1 && found[0].contains(text) && found[0].contains("--equilibrium"), "{found:?}");
    assert_eq!(warnings(&wheel("200e3", 0.37, "", r#", "lift_off": true"#), &[]), [""; 0]);
    assert_eq!(warnings(&wheel("200e3", 0.37, "", ""), &["--equilibrium"]), [""; 0]);
    for more in [&["--equilibrium"][..], &[]] {
        let found = warnings(&wheel("200", 0.3, "", ""), more);
        assert!(found.len() == 1 && found[0].contains("the tyre `tyre` is compressed by"), "{found:?}");
        assert!(found[0].contains("write 200e3"), "{found:?}");
    }
    // Of a static equilibrium and of a linear model, too.
    for command in [&["check", "scene.json", "--static"][..], &["linearize", "scene.json", "--equilibrium"]] {
        let output = Place::new(wheel("200", 0.3, "", "")).run(command);
        assert_eq!(err(&output).matches("the tyre `tyre` is compressed by 1.5 m").count(), 1, "{}", err(&output));
    }
}

/// A road of so many points 0.1 m apart, at 10 m/s: it ends at `points`/100 s of 1 s.
fn road(points: usize, height: impl Fn(usize) -> f64, keys: &str) -> String {
    let points: Vec<String> = (0..=points).map(|i| format!("[{}, {:e}]", 0.1 * i as f64, height(i))).collect();
    let signals = format!(r#""signals": [ {{ "name": "road", "points": [{}] {keys} }} ],"#, points.join(", "));
    wheel("200e3", 0.3, &signals, r#", "road": "road(10*t)""#)
}

#[test]
fn a_signal_that_ends_early_is_said() {
    let rough = |i: usize| 1e-4 * (i as f64).sin();
    let found = warnings(&road(20, rough, ""), &[]);
    let text = "the signal `road` has no points above 2: from t = 0.2 s on it is held at 9.129e-5, for 80 % of the run";
    assert!(found.len() == 1 && found[0].contains(text) && found[0].contains("\"repeat\""), "{found:?}");
    // Of most of the run, or with an end that is level, or written by hand.
    let bump = |i: usize| 1e-4 * (1.0 - (i as f64 * std::f64::consts::TAU / 20.0).cos());
    let flat = |i: usize| if i < 19 { bump(i) } else { 0.0 };
    for scene in [road(60, rough, ""), road(20, flat, ""), road(3, rough, "")] {
        assert_eq!(warnings(&scene, &[]), [""; 0]);
    }
    assert_eq!(warnings(&road(20, rough, r#", "beyond": "repeat", "interpolation": "linear""#), &[]), [""; 0]);
}

/// 70 GPa and 210000 N/mm^2 written as Pa. The beam is in a floating frame, and at rest.
#[test]
fn a_modulus_in_another_unit_is_said() {
    let beam = |modulus: &str| {
        format!(
            r#"{{ "name": "beam", "dimension": 2, "ground": {{ "markers": {{ "wall": [0, 0] }} }},
            "bodies": [{{ "name": "arm", "type": "flexible_beam", "frame": "floating", "length": 1, "elements": 2,
                "material": {{ "E": {modulus}, "rho": 2700 }}, "section": {{ "circle": {{ "radius": 0.01 }} }},
                "markers": {{ "root": [0, 0] }} }}],
            "joints": [{{ "name": "clamp", "type": "weld", "between": ["ground.wall", "arm.root"] }}],
            "simulation": {{ "t_end": 0.01 }} }}"#
        )
    };
    for (modulus, text) in [("70", "write 70e9"), ("70e3", "7e4")] {
        let found = warnings(&beam(modulus), &[]);
        assert!(found.len() == 1 && found[0].starts_with("the body `arm`: `E` is 7"), "{found:?}");
        assert!(found[0].contains("softest rubber") && (modulus != "70" || found[0].contains(text)), "{found:?}");
    }
    for modulus in ["70e9", "1e5"] {
        assert_eq!(warnings(&beam(modulus), &[]), [""; 0]);
    }
}

/// A force of a fiftieth of a second that implicit steps go over, and the row in its middle does not.
#[test]
fn a_row_that_no_step_confirms_is_told() {
    let scene = |bump: &str| {
        format!(
            r#"{{ "name": "bump", "dimension": 2,
            "bodies": [{{ "name": "m", "type": "point_mass", "mass": 1, "initial": {{ "velocity": [1, 0] }} }}],
            "forces": [{{ "name": "f", "type": "applied_force", "at": "m", "force": [0, "{bump}"] }}],
            "outputs": [{{ "name": "y", "measure": "position", "of": "m", "component": "y" }}],
            "simulation": {{ "t_end": 10, "output_step": 0.02 }} }}"#
        )
    };
    let implicit =
        ["simulate", "scene.json", "--formulation", "ggl", "--integrator", "radau_iia", "--projection", "none"];
    let said = |bump: &str| err(&Place::new(scene(bump)).run(&implicit));
    let short = said("100*exp(-((m.x - 5)/0.02)^2)");
    assert!(short.contains("the row at t = 5 s has an energy that no step has"), "{short}");
    let long = said("exp(-((m.x - 5)/2)^2)");
    assert!(!long.contains("warning"), "{long}");
}
