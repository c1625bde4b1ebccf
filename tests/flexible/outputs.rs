//! What a beam's outputs say of a cantilever under loads at its tip, in both kinds alike.

use crate::flexible::beams::{EA, EI, FRAMES, GA, LENGTH, Rod, THEORIES, at_rest, scene};
use crate::scenes::parse;
use holonom::scene::Scene;

/// Force and torque at the tip, small for second-order terms to be 1e-5 of the first.
const FORCE: [f64; 3] = [4e-4, 3e-5, -2e-5];
const TORQUE: [f64; 3] = [5e-5, 1e-5, -3e-5];

/// Off the axis, for strain.
const OFFSET: [f64; 2] = [0.04, -0.07];

/// A cantilever with outputs at `at`: their names with what they should be.
fn cantilever(dimension: usize, theory: &str, at: f64) -> (String, Vec<(&'static str, f64)>) {
    let in_space = dimension == 3;
    let [fx, fy, fz] = if in_space { FORCE } else { [FORCE[0], FORCE[1], 0.0] };
    let [mx, my, mz] = if in_space { TORQUE } else { [0.0, 0.0, TORQUE[2]] };
    let [y, z] = if in_space { OFFSET } else { [OFFSET[0], 0.0] };
    let arm = LENGTH - at;
    let [about_y, about_z] = [my - fz * arm, mz + fy * arm];
    let bent = |force: f64, moment: f64, ei: f64| {
        force * at * at * (3.0 * LENGTH - at) / (6.0 * ei) + moment * at * at / (2.0 * ei)
    };
    let shear = |force: f64, ga: f64| if theory == "timoshenko" { force * at / ga } else { 0.0 };
    let mut expected = vec![
        ("axial_force", fx),
        ("bending_moment_z", about_z),
        ("strain", fx / EA + z * about_y / EI[0] - y * about_z / EI[1]),
        ("deflection_x", fx * at / EA),
        ("deflection_y", bent(fy, mz, EI[1]) + shear(fy, GA[0])),
        ("shear_force_y", fy),
    ];
    if in_space {
        expected.extend([
            ("torque", mx),
            ("bending_moment_y", about_y),
            // A turn about y is against the slope of z.
            ("deflection_z", bent(fz, -my, EI[0]) + shear(fz, GA[1])),
            ("shear_force_z", fz),
        ]);
    }
    let offset = if in_space { format!("[{y}, {z}]") } else { format!("[{y}]") };
    let output = |(name, _): &(&str, f64)| {
        let (measure, component) = match name.rsplit_once('_') {
            Some((measure, axis @ ("x" | "y" | "z"))) => (measure, format!(r#", "component": "{axis}""#)),
            _ => (*name, String::new()),
        };
        let offset = if measure == "strain" { format!(r#", "offset": {offset}"#) } else { String::new() };
        format!(r#"{{ "name": "{name}", "measure": "{measure}", "of": "rod", "at": {at}{component}{offset} }}"#)
    };
    let outputs = expected.iter().map(output).collect::<Vec<_>>().join(", ");
    let (force, torque) = match dimension {
        2 => (format!("[{fx}, {fy}]"), format!("{mz}")),
        _ => (format!("[{fx}, {fy}, {fz}]"), format!("[{mx}, {my}, {mz}]")),
    };
    let rest = format!(
        r#""joints": [ {{ "name": "clamp", "type": "weld", "between": ["ground.wall", "rod.root"] }} ],
        "forces": [ {{ "name": "load", "type": "applied_force", "at": "rod.tip", "force": {force} }},
            {{ "name": "moment", "type": "applied_torque", "at": "rod.tip", "torque": {torque} }} ],
        "outputs": [ {outputs} ]"#
    );
    (rest, expected)
}

/// Statics of linear beams under loads at the ends are exact in both kinds; terms of second order leave 1e-5 of the
/// sizes below.
#[test]
fn outputs_of_a_cantilever_are_those_of_beam_theory() {
    let mut worst = 0.0f64;
    for (dimension, theory) in [2, 3].into_iter().flat_map(|d| THEORIES.map(|theory| (d, theory))) {
        for (frame, at) in FRAMES.into_iter().flat_map(|frame| [0.0, 0.3, 1.0, 1.7, 2.0].map(|at| (frame, at))) {
            let (rest, mut expected) = cantilever(dimension, theory, at);
            // The deflections of chord and mean frames are against other lines.
            expected.retain(|(name, _)| !name.starts_with("deflection") || ["tangent", "absolute"].contains(&frame));
            let rod = Rod { dimension, frame, theory, elements: 3, stiffness: 1.0, more: "" }.json();
            let names: Vec<&str> = expected.iter().map(|(name, _)| *name).collect();
            let found = at_rest(&parse(&scene(dimension, &rod, &rest)), &names);
            for ((name, expected), found) in expected.iter().zip(found) {
                let size = match *name {
                    "strain" => 1e-7,
                    "torque" | "bending_moment_y" | "bending_moment_z" => 5e-5,
                    "axial_force" | "shear_force_y" | "shear_force_z" => 3e-5,
                    _ => 5e-7,
                };
                let error = (found - expected).abs() / size;
                worst = worst.max(error);
                assert!(error < 3e-5, "{dimension} {theory} {frame} {name} at {at}: {found:e} {expected:e}");
            }
        }
    }
    println!("outputs: worst {worst:.1e}");
}

/// Against the line through both ends.
#[test]
fn deflection_in_a_chord_frame_is_from_the_chord() {
    for theory in THEORIES {
        let tip = |at: f64| {
            let (rest, _) = cantilever(2, theory, at);
            let y = |frame: &str| {
                let rod = Rod { dimension: 2, frame, theory, elements: 3, stiffness: 1.0, more: "" }.json();
                at_rest(&parse(&scene(2, &rod, &rest)), &["deflection_y"])[0]
            };
            ["tangent", "chord"].map(y)
        };
        let end = tip(LENGTH);
        assert!(end[1].abs() < 1e-18, "{end:?}");
        for at in [0.5, 1.3] {
            let [tangent, chord] = tip(at);
            let expected = tangent - end[0] * at / LENGTH;
            assert!((chord - expected).abs() < 1e-4 * expected.abs(), "{at}: {chord:e} {expected:e}");
        }
    }
}

/// A force across the tip of a beam: the axial force there is its part along the section, which has turned by
/// F L^2/(2 EI) in a beam of small displacements, stiffened or not. Large ones turn less, by terms of third order.
#[test]
fn axial_force_is_along_the_displaced_section() {
    let load = 5.0;
    let rod = |frame: &str, more: &str| {
        let rod = Rod { dimension: 2, frame, theory: "euler_bernoulli", elements: 8, stiffness: 1.0, more }.json();
        let rest = format!(
            r#""joints": [ {{ "name": "clamp", "type": "weld", "between": ["ground.wall", "rod.root"] }} ],
            "forces": [ {{ "name": "load", "type": "applied_force", "at": "rod.tip", "force": [0, {load}] }} ],
            "outputs": [ {{ "name": "force", "measure": "axial_force", "of": "rod", "at": 2 }},
                {{ "name": "x", "measure": "deflection", "of": "rod", "at": 2, "component": "x" }} ]"#
        );
        at_rest(&parse(&scene(2, &rod, &rest)), &["force", "x"])
    };
    let [plain, stiffened] = ["false", "true"].map(|s| rod("tangent", &format!(r#""geometric_stiffening": {s},"#)));
    let slope = load * LENGTH * LENGTH / (2.0 * EI[1]);
    assert!([plain[0], stiffened[0]].iter().all(|n| (n - load * slope.sin()).abs() < 1e-12), "{plain:?} {stiffened:?}");
    let [chord, mean, large] = ["chord", "mean", "absolute"].map(|frame| rod(frame, "")[0]);
    println!("axial force {:?}, chord {chord}, mean {mean}, absolute {large}", plain[0]);
    for other in [chord, mean, large] {
        assert!((other / plain[0] - 1.0).abs() < 3.0 * slope * slope, "{other} {plain:?}");
    }
    // Without stiffening nothing shortens; with it nothing pulls along the axis of the frame, and the tip comes back by
    // int w'^2/2 = F^2 L^5/(15 EI^2), whose mean over an element is exact.
    let shortening = load * load * LENGTH.powi(5) / (15.0 * EI[1] * EI[1]);
    assert!(plain[1].abs() < 1e-14, "{plain:?}");
    assert!((stiffened[1] / -shortening - 1.0).abs() < 1e-9, "{stiffened:?} {shortening:e}");
}

fn refusal(dimension: usize, frame: &str, theory: &str, output: &str) -> String {
    let rod = Rod { dimension, frame, theory, elements: 2, stiffness: 1.0, more: "" }.json();
    let text = scene(dimension, &rod, &format!(r#""outputs": [ {{ "name": "it", {output} }} ]"#));
    Scene::parse(&text, &[]).err().unwrap_or_else(|| panic!("accepted: {text}")).to_string()
}

#[test]
fn outputs_that_make_no_sense_are_refused() {
    let both = ["tangent", "absolute"];
    let of = |measure: &str, rest: &str| format!(r#""measure": "{measure}", "of": "rod" {rest}"#);
    let expect = |dimension: usize, frame: &str, output: &str, message: &str| {
        let found = refusal(dimension, frame, "euler_bernoulli", output);
        assert_eq!(found, message, "{dimension} {frame}");
    };
    for (dimension, frame) in [2, 3].into_iter().flat_map(|d| both.map(|frame| (d, frame))) {
        let known = if dimension == 2 { "x, y" } else { "x, y, z" };
        for (output, message) in [
            (
                of("axial_force", r#", "at": 2.5"#),
                "at outputs[0].at (`it`): 2.5 m is off the beam\n  help: the beam reaches from 0 to 2 m".to_string(),
            ),
            (
                of("deflection", r#", "at": -0.1"#),
                "at outputs[0].at (`it`): -0.1 m is off the beam\n  help: the beam reaches from 0 to 2 m".to_string(),
            ),
            (
                of("bending_moment", ""),
                "at outputs[0] (`it`): the key `at` is missing\n  help: say where on the beam: m from its left end"
                    .to_string(),
            ),
            (
                of("deflection", r#", "at": 1, "component": "w""#),
                format!("at outputs[0].component (`it`): there is no component `w`\n  help: choose one of {known}"),
            ),
            (
                r#""measure": "strain", "of": "rode", "at": 1"#.to_string(),
                "at outputs[0].of (`it`): there is no flexible beam `rode`\n  help: did you mean `rod`?".to_string(),
            ),
        ] {
            expect(dimension, frame, &output, &message);
        }
    }
    for frame in both {
        expect(
            2,
            frame,
            &of("torque", r#", "at": 1"#),
            "at outputs[0].measure (`it`): a planar beam carries no torque\n  help: watch its bending_moment",
        );
        expect(
            2,
            frame,
            &of("bending_moment", r#", "at": 1, "component": "y""#),
            "at outputs[0].component (`it`): there is no component `y`\n  help: choose one of z",
        );
        expect(
            3,
            frame,
            &of("shear_force", r#", "at": 1, "component": "x""#),
            "at outputs[0].component (`it`): there is no component `x`\n  help: choose one of y, z",
        );
        expect(
            3,
            frame,
            &of("strain", r#", "at": 1, "offset": [0.1]"#),
            "at outputs[0].offset (`it`): expected 2 numbers, found 1\n  help: the scene has \"dimension\": 3",
        );
    }
}
