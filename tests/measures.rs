//! Outputs, springs, gravity and bodies of one axis against closed forms.

use crate::scenes::{Ready, Run, parse};
use holonom::analysis::{Extremes, Recorder};
use holonom::simulate::{Span, simulate_automatic};
use holonom::system::Column;
use serde_json::{Value, json};

fn scene(dimension: usize, ground: Value, bodies: Value, joints: Value, forces: Value, outputs: Value) -> Ready {
    let keys = json!({ "name": "measured", "dimension": dimension, "ground": { "markers": ground }, "bodies": bodies,
        "joints": joints, "forces": forces, "outputs": outputs, "simulation": { "t_end": 1 } });
    parse(&keys.to_string())
}

fn measured(run: &Run, name: &str, expected: impl Fn(f64) -> f64) {
    let error = run.worst(name, expected);
    assert!(error < 1e-9, "{name} is off by {error:e}");
}

/// A rotor of inertia 2 about z that a motor takes to angle a = t^2, with a tip at 0.5 m: a'' = 2, and
/// r'' = -a'^2 r + a'' z x r.
fn rotor(dimension: usize) -> Ready {
    let (zero, tip, inertia) = match dimension {
        2 => (json!([0, 0]), json!([0.5, 0]), json!(2)),
        _ => (json!([0, 0, 0]), json!([0.5, 0, 0]), json!([2, 2, 2])),
    };
    let between = json!(["ground.O", "rotor"]);
    scene(
        dimension,
        json!({ "O": zero }),
        json!([{ "name": "rotor", "type": "rigid", "mass": 1, "inertia": inertia, "markers": { "tip": tip } }]),
        json!([{ "name": "hinge", "type": "revolute", "between": between },
               { "name": "motor", "type": "driver", "between": between, "coordinate": "angle", "value": "t^2" }]),
        json!([]),
        json!([{ "name": "ax", "measure": "acceleration", "of": "rotor.tip" },
               { "name": "own_ax", "measure": "expression", "value": "ax*cos(a) + rotor.tip.y''*sin(a)" },
               { "name": "a", "measure": "angle", "of": "hinge" },
               { "name": "speed", "measure": "angular_velocity", "of": "hinge" },
               { "name": "alpha", "measure": "angular_acceleration", "of": "hinge" },
               { "name": "alpha_z", "measure": "angular_acceleration", "of": "rotor", "component": "z" },
               { "name": "seen", "measure": "acceleration", "of": "ground.O", "relative_to": "rotor.tip" },
               { "name": "torque", "measure": "reaction", "of": "motor" },
               { "name": "back", "measure": "reaction", "of": "motor", "component": "mz", "on": "first" },
               { "name": "power", "measure": "power", "of": "motor" }]),
    )
}

#[test]
fn accelerations_and_power_of_a_motor() {
    for dimension in [2, 3] {
        let run = rotor(dimension).tight(1e-11, 4.0, 0.25);
        let angle = |t: f64| t * t;
        measured(&run, "a", angle);
        measured(&run, "speed", |t| 2.0 * t);
        ["alpha", "alpha_z"].iter().for_each(|name| measured(&run, name, |_| 2.0));
        let along = |t: f64| -(2.0 * t).powi(2) * 0.5;
        measured(&run, "ax", |t| along(t) * angle(t).cos() - angle(t).sin());
        measured(&run, "own_ax", along);
        // The axis is at rest in the axes of the rotor.
        measured(&run, "seen", |_| 0.0);
        measured(&run, "torque", |_| 4.0);
        measured(&run, "back", |_| -4.0);
        measured(&run, "power", |t| 8.0 * t);
    }
}

/// A block slides down an incline of slope 3/4: g sin = 5.886 m/s^2 along the axis of its joint.
#[test]
fn travels_of_joints_are_along_their_axes() {
    for (dimension, kind) in [(2, "prismatic"), (3, "prismatic"), (3, "cylindrical")] {
        let (axis, zero, inertia, gravity) = match dimension {
            2 => (json!([-4, -3]), json!([0, 0]), json!(1), json!([0, -9.81])),
            _ => (json!([0, -4, -3]), json!([0, 0, 0]), json!([1, 1, 1]), json!([0, 0, -9.81])),
        };
        let keys = json!({ "name": "slide", "dimension": dimension, "gravity": gravity,
            "ground": { "markers": { "O": zero } },
            "bodies": [{ "name": "block", "type": "rigid", "mass": 1, "inertia": inertia }],
            "joints": [{ "name": "slider", "type": kind, "between": ["ground.O", "block"], "axis": axis }],
            "outputs": [{ "name": "s", "measure": "position", "of": "slider" },
                        { "name": "v", "measure": "velocity", "of": "slider" },
                        { "name": "a", "measure": "acceleration", "of": "slider" },
                        { "name": "half", "measure": "expression", "value": "s''/2 + s'*0" }],
            "simulation": { "t_end": 1 } });
        let run = parse(&keys.to_string()).tight(1e-11, 1.0, 0.1);
        let g = 9.81 * 0.6;
        measured(&run, "s", |t| 0.5 * g * t * t);
        measured(&run, "v", |t| g * t);
        measured(&run, "a", |_| g);
        measured(&run, "half", |_| 0.5 * g);
    }
}

/// A body turned by R_x(a) R_y(b) against its universal joint, with rates p and r of the two angles.
#[test]
fn a_universal_joint_has_two_angles() {
    let a = 0.4f64;
    let b = -0.7f64;
    let p = 0.3;
    let r = 0.9;
    let half = |x: f64| (0.5 * x).sin_cos();
    let ((sa, ca), (sb, cb)) = (half(a), half(b));
    let rotation = [ca * cb, sa * cb, ca * sb, sa * sb];
    let output = |name: &str, measure: &str, axis: &str| json!({ "name": name, "measure": measure, "of": "cross", "component": axis });
    let ready = scene(
        3,
        json!({ "O": [0, 0, 0] }),
        json!([{ "name": "shaft", "type": "rigid", "mass": 1, "inertia": [1, 1, 1],
                 "initial": { "rotation": rotation, "angular_velocity": [b.cos() * p, r, b.sin() * p] } }]),
        json!([{ "name": "cross", "type": "universal", "between": ["ground.O", "shaft"] }]),
        json!([]),
        json!([
            output("a", "angle", "x"),
            output("b", "angle", "y"),
            output("p", "angular_velocity", "x"),
            output("r", "angular_velocity", "y")
        ]),
    );
    let run = ready.tight(1e-11, 0.1, 0.1);
    let first = |name: &str| run.column(name)[0];
    for (name, expected) in [("a", a), ("b", b), ("p", p), ("r", r)] {
        assert!((first(name) - expected).abs() < 1e-12, "{name}: {} for {expected}", first(name));
    }
}

/// The second pin of a cardan shaft turns on through full turns.
#[test]
fn angles_of_a_universal_joint_count_turns() {
    let ready = scene(
        3,
        json!({ "O": [0, 0, 0] }),
        json!([{ "name": "shaft", "type": "rigid", "mass": 1, "inertia": [1, 1, 1],
                 "initial": { "angular_velocity": [0, 10, 0] } }]),
        json!([{ "name": "cross", "type": "universal", "between": ["ground.O", "shaft"] }]),
        json!([]),
        json!([{ "name": "b", "measure": "angle", "of": "cross", "component": "y" }]),
    );
    measured(&ready.tight(1e-12, 2.0, 0.5), "b", |t| 10.0 * t);
}

/// A torque on a hinge that reads its angle and rate by the names of outputs winds up as a torsion spring does.
#[test]
fn forces_read_joints_and_distances_by_name() {
    let hinge = json!({ "name": "hinge", "type": "revolute", "between": ["ground.O", "r"] });
    let body = json!({ "name": "r", "type": "rigid", "mass": 1, "inertia": [1, 1, 1],
                       "initial": { "angular_velocity": [0, 0, 3.5] } });
    let torque = json!({ "name": "back", "type": "applied_torque", "at": "r", "torque": [0, 0, "-theta - 0*theta'"] });
    let outputs = json!([{ "name": "theta", "measure": "angle", "of": "hinge" }]);
    let ready = scene(3, json!({ "O": [0, 0, 0] }), json!([body]), json!([hinge]), json!([torque]), outputs);
    measured(&ready.tight(1e-12, 4.0, 0.5), "theta", |t| 3.5 * t.sin());

    // x'' = -x' by the rate of a distance that is an output: x' = e^-t.
    let mass =
        json!({ "name": "m", "type": "point_mass", "mass": 1, "initial": { "position": [1, 0], "velocity": [1, 0] } });
    let drag = json!({ "name": "drag", "type": "applied_force", "at": "m", "force": ["-approach", 0] });
    let outputs = json!([{ "name": "approach", "measure": "distance_rate", "between": ["ground.O", "m"] }]);
    let ready = scene(2, json!({ "O": [0, 0] }), json!([mass]), json!([]), json!([drag]), outputs);
    measured(&ready.tight(1e-12, 2.0, 0.5), "approach", |t| (-t).exp());
}

/// A mass on springs of the same law, given by numbers and by an expression, side by side.
#[test]
fn a_law_that_is_linear_is_the_linear_spring() {
    let mass = |name: &str| {
        json!({ "name": name, "type": "rigid", "mass": 2, "inertia": 0.3,
        "initial": { "position": [0.9, 0.4], "velocity": [0.3, -1], "angular_velocity": 2 } })
    };
    let spring = |name: &str, keys: Value| {
        let mut spring = json!({ "name": name, "between": ["ground.O", name.split_once('_').unwrap().1] });
        spring.as_object_mut().unwrap().extend(keys.as_object().unwrap().clone());
        spring
    };
    let ready = scene(
        2,
        json!({ "O": [0, 0] }),
        json!([mass("a"), mass("b")]),
        json!([]),
        json!([
            spring("s_a", json!({ "type": "spring_damper", "stiffness": 30, "damping": 0.7, "free_length": 0.6 })),
            spring("s_b", json!({ "type": "spring_damper", "law": "30*(length - 0.6) + 0.7*rate" })),
            spring("r_a", json!({ "type": "torsion_spring", "stiffness": 5, "damping": 0.1, "free_angle": 0.2 })),
            spring("r_b", json!({ "type": "torsion_spring", "law": "5*(angle - 0.2) + 0.1*rate" }))
        ]),
        json!([{ "name": "x", "measure": "expression", "value": "a.x - b.x" },
               { "name": "turn", "measure": "expression", "value": "a.angle - b.angle" },
               { "name": "fa", "measure": "force", "of": "s_a" }, { "name": "fb", "measure": "force", "of": "s_b" },
               { "name": "xb", "measure": "force", "of": "s_b", "component": "x", "relative_to": "b" },
               { "name": "length", "measure": "distance", "of": "s_b" },
               { "name": "given", "measure": "power", "of": "s_b" },
               { "name": "taken", "measure": "expression", "value": "length'" }]),
    );
    let run = ready.tight(1e-11, 2.0, 0.2);
    measured(&run, "x", |_| 0.0);
    measured(&run, "turn", |_| 0.0);
    let columns = ["fa", "fb", "given", "taken"].map(|name| run.column(name));
    for (i, tension) in columns[0].iter().enumerate() {
        assert!((columns[1][i] - tension).abs() < 1e-9);
        assert!((columns[2][i] + tension * columns[3][i]).abs() < 1e-9, "the power of a tension is -T l'");
    }
    // What the law takes is counted: the balance closes.
    let energy = &run.record.energy;
    assert!(energy.as_ref().unwrap().max_error < 1e-8, "{energy:?}");
}

/// x'' = -x^3 from rest at 1: the period is 4 K(1/2)/1 = 7.4162987092054876 s, with K of parameter m = 1/2.
#[test]
fn a_cubic_spring_has_the_period_of_the_elliptic_integral() {
    let period = 7.416_298_709_205_488;
    let mass = json!({ "name": "m", "type": "point_mass", "mass": 1, "initial": { "position": [3, 0] } });
    let spring = json!({ "name": "s", "type": "spring_damper", "between": ["ground.O", "m"], "law": "(length - 2)^3" });
    let outputs =
        json!([{ "name": "x", "measure": "position", "of": "m" }, { "name": "v", "measure": "velocity", "of": "m" }]);
    let run = scene(2, json!({ "O": [0, 0] }), json!([mass]), json!([]), json!([spring]), outputs)
        .tight(1e-12, period, period);
    measured(&run, "x", |_| 3.0);
    measured(&run, "v", |_| 0.0);
}

/// An ellipse from its pericentre at 1 with eccentricity 0.6, mu = 4: a = 2.5, T = 2 pi sqrt(a^3/mu); one period later
/// the body, whose origin is not its centre of mass, is back, and its energy is -mu m/(2a) all along.
#[test]
fn a_body_that_is_drawn_to_a_point_moves_as_kepler_says() {
    let mu = 4.0f64;
    let a = 2.5f64;
    let mass = 3.0;
    let speed = (mu * 1.6f64).sqrt();
    let period = std::f64::consts::TAU * (a.powi(3) / mu).sqrt();
    for dimension in [2, 3] {
        let of = |x: f64, y: f64| if dimension == 2 { json!([x, y]) } else { json!([x, 0, y]) };
        let inertia = if dimension == 2 { json!(1) } else { json!([1, 1, 1]) };
        let keys = json!({ "name": "kepler", "dimension": dimension,
            "gravity": { "towards": "ground.Sun", "mu": "4" }, "ground": { "markers": { "Sun": of(0.5, 0.0) } },
            "bodies": [{ "name": "planet", "type": "rigid", "mass": mass, "inertia": inertia, "origin": of(0.1, 0.2),
                         "initial": { "position": of(1.6, 0.2), "velocity": of(0.0, speed) } }],
            "outputs": [{ "name": "x", "measure": "position", "of": "planet" },
                        { "name": "energy", "measure": "energy" },
                        { "name": "weight", "measure": "force", "of": "gravity.planet" }],
            "simulation": { "t_end": 1 } });
        let run = parse(&keys.to_string()).tight(1e-12, period, 0.25 * period);
        measured(&run, "energy", |_| -mu * mass / (2.0 * a));
        let x = run.column("x");
        let weight = run.column("weight");
        assert!((x[0] - x[4]).abs() < 1e-9 && (weight[0] - mu * mass).abs() < 1e-12, "{x:?} {weight:?}");
        assert!((weight[2] - mu * mass / 16.0).abs() < 1e-9, "the apocentre is at 4: {weight:?}");
    }
}

/// A flywheel that may turn about one axis needs no moments about the others; 3 N m give it 3/I rad/s^2.
#[test]
fn a_flywheel_has_one_moment() {
    // Tilted by 0.3 rad, the wheel of the tensor has 0.6 cos^2 of its moment left about the axis.
    for (inertia, moment) in [(json!(0.6), 0.6), (json!([0, 0, 0.6]), 0.6 * 0.3f64.cos().powi(2))] {
        let wheel = json!({ "name": "wheel", "type": "rigid", "mass": 1, "inertia": inertia, "free": ["rz"],
            "initial": { "rotation": [0.3, 0, 0], "angular_velocity": 7 } });
        let block = json!({ "name": "block", "type": "rigid", "mass": 2, "free": ["x"] });
        let forces = json!([
            { "name": "drive", "type": "applied_torque", "at": "wheel", "torque": [0, 0, 3] },
            { "name": "push", "type": "applied_force", "at": "block", "force": [4, 5, 6] }]);
        let outputs = json!([
            { "name": "speed", "measure": "angular_velocity", "of": "wheel", "component": "z" },
            { "name": "a", "measure": "acceleration", "of": "block" }]);
        let run = scene(3, json!({}), json!([wheel, block]), json!([]), forces, outputs).tight(1e-12, 2.0, 0.5);
        measured(&run, "speed", |t| 7.0 + 3.0 * t / moment);
        measured(&run, "a", |_| 2.0);
    }
}

/// A filter i' = turn - i of an angle that is an output: its rate is one for other outputs.
#[test]
fn outputs_read_rates_of_states() {
    let keys = json!({ "name": "filter", "dimension": 2, "states": [{ "name": "i", "rate": "turn - i" }],
        "bodies": [{ "name": "r", "type": "rigid", "mass": 1, "inertia": 1, "initial": { "angular_velocity": 1 } }],
        "outputs": [{ "name": "turn", "measure": "angle", "of": "r" },
                    { "name": "rate", "measure": "expression", "value": "i'" }],
        "simulation": { "t_end": 1 } });
    measured(&parse(&keys.to_string()).tight(1e-12, 2.0, 0.5), "rate", |t| 1.0 - (-t).exp());
}

/// A block of 1 kg on a damped spring, k = 4 and c = 0.4, pulled by a force of 3 N: from rest at x = 0, with x_s = 3/4,
/// x = x_s (1 - e^(-d t) (cos w t + d/w sin w t)), x' = x_s (d^2 + w^2)/w e^(-d t) sin w t, d = 0.2 and w^2 = 4 - d^2.
/// The force does the work 3 x, the spring the rest of the kinetic energy.
#[test]
fn works_of_forces() {
    let block = scene(
        2,
        json!({ "O": [0, 0] }),
        json!([{ "name": "block", "type": "rigid", "mass": 1, "inertia": 1, "initial": { "position": [5, 0] } }]),
        json!([{ "name": "rail", "type": "prismatic", "between": ["ground.O", "block"] }]),
        json!([{ "name": "spring", "type": "spring_damper", "between": ["ground.O", "block"], "stiffness": 4,
                 "damping": 0.4, "free_length": 5 },
               { "name": "pull", "type": "applied_force", "at": "block", "force": [3, 0] }]),
        json!([{ "name": "pulled", "measure": "work", "of": "pull" },
               { "name": "x", "measure": "position", "of": "block" },
               { "name": "twice", "measure": "expression", "value": "2*power" },
               { "name": "sprung", "measure": "work", "of": "spring", "unit": "kJ" },
               { "name": "power", "measure": "power", "of": "pull" }]),
    );
    let d = 0.2_f64;
    let rest = 0.75;
    let w = (4.0 - d * d).sqrt();
    let x = |t: f64| rest * (1.0 - (-d * t).exp() * ((w * t).cos() + d / w * (w * t).sin()));
    let v = |t: f64| rest * 4.0 / w * (-d * t).exp() * (w * t).sin();
    let run = block.tight(1e-12, 6.0, 0.05);
    measured(&run, "x", |t| 5.0 + x(t));
    measured(&run, "pulled", |t| 3.0 * x(t));
    measured(&run, "sprung", |t| 1e-3 * (0.5 * v(t).powi(2) - 3.0 * x(t)));
    // Expressions find other outputs beside works.
    measured(&run, "twice", |t| 6.0 * v(t));
    let system = block.system();
    let mut recorder = Recorder::new(block.system());
    let (start, span) = (block.start(), Span { start: 0.0, end: 6.0, output_step: 6.0 });
    simulate_automatic(system, (1e-10, 1e-12), span, (&start.q, &start.v), &mut recorder).unwrap();
    let pulled = recorder.finish().trajectory.column("pulled").unwrap()[1];
    // README: errors within ten tolerances.
    assert!((pulled - 3.0 * x(6.0)).abs() < 1e-9, "{pulled}");
}

fn extremes(values: &[(f64, f64)]) -> Extremes {
    let mut extremes = Extremes::of(&Column { name: "x".to_string(), unit: "m".to_string() });
    values.iter().for_each(|&(t, value)| extremes.add(t, value));
    extremes
}

/// The mean square of t from -1 to 2 is 1.
#[test]
fn a_line_has_its_closed_form() {
    let found = extremes(&[(-1.0, -1.0), (0.5, 0.5), (2.0, 2.0)]);
    assert_eq!((found.min, found.t_min, found.max, found.t_max), (Some(-1.0), Some(-1.0), Some(2.0), Some(2.0)));
    assert!(found.rms.is_some_and(|rms| (rms - 1.0).abs() < 1e-15), "{found:?}");
}

#[test]
fn rows_without_a_value_are_left_out() {
    let found = extremes(&[(0.0, f64::NAN), (1.0, 3.0), (2.0, f64::INFINITY), (3.0, -4.0), (4.0, -4.0)]);
    assert_eq!((found.min, found.t_min, found.max, found.rms), (Some(-4.0), Some(3.0), Some(3.0), Some(4.0)));
    assert_eq!(extremes(&[(0.0, f64::NAN)]).rms, None);
    assert_eq!(extremes(&[(0.0, -2.0)]).rms, Some(2.0));
}
