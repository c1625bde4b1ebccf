//! The force `beam`: its sections, which it is asked for by its name.

use crate::scenes::{Ready, parse};
use crate::section_forces::{at_rest, gap, reactions, sections};
use holonom::scene::Scene;

/// A body on a massless beam from a wall, with a force and a torque on it.
fn scene(dimension: usize, beam: &str, [force, torque]: [&str; 2], outputs: &str) -> String {
    let (zero, section, inertia, tip) = match dimension {
        2 => ("0, 0", r#""EA": 1e4, "EI": 300, "GA": 4e3"#, "0.1", r#""position": [2, 0]"#),
        _ => (
            "0, 0, 0",
            r#""EA": 1e4, "EI": [100, 300], "GA": [4e3, 3e3], "GJ": 60"#,
            "[0.1, 0.1, 0.1]",
            r#""position": [2, 0, 0]"#,
        ),
    };
    format!(
        r#"{{ "name": "massless", "dimension": {dimension}, "ground": {{ "markers": {{ "wall": [{zero}] }} }},
        "bodies": [ {{ "name": "tip", "type": "rigid", "mass": 1, "inertia": {inertia}, "initial": {{ {tip} }} }} ],
        "forces": [ {{ "name": "rod", "type": "beam", "between": ["ground.wall", "tip"], "length": 2,
                "stiffness": {{ {section} }}, {beam} }},
            {{ "name": "load", "type": "applied_force", "at": "tip", "force": {force} }},
            {{ "name": "moment", "type": "applied_torque", "at": "tip", "torque": {torque} }} ],
        "outputs": [ {outputs} ] }}"#
    )
}

const PLACES: [f64; 4] = [0.0, 0.3, 1.0, 2.0];

#[test]
fn a_massless_beam_carries_what_is_at_its_end() {
    for theory in ["euler_bernoulli", "timoshenko"] {
        let keys = format!(r#""theory": "{theory}""#);
        let plane = scene(2, &keys, ["[4e-6, 3e-6]", "5e-6"], &sections(2, "rod", &PLACES));
        let (_, out) = at_rest(&parse(&plane), 0.0);
        for (at, section) in PLACES.into_iter().zip(out.chunks(3)) {
            // Second-order terms are 1e-7 of the first; forces are what is left of EA.
            assert!(gap(section, &[4e-6, 3e-6, 5e-6 + 3e-6 * (2.0 - at)]) < 1e-11, "{theory} at {at}: {section:?}");
        }
        let loads = ["[4e-6, 3e-6, -2e-6]", "[5e-6, 1e-6, -3e-6]"];
        let (_, out) = at_rest(&parse(&scene(3, &keys, loads, &sections(3, "rod", &PLACES))), 0.0);
        for (at, section) in PLACES.into_iter().zip(out.chunks(6)) {
            let rest = 2.0 - at;
            let expected = [4e-6, 3e-6, -2e-6, 5e-6, 1e-6 + 2e-6 * rest, -3e-6 + 3e-6 * rest];
            assert!(gap(section, &expected) < 1e-11, "{theory} at {at}: {section:?}");
        }
    }
}

/// Bent by its curvature, twisted and loaded far: the sections at its ends carry what the joint to its wall does.
#[test]
fn a_bent_one_passes_its_load_on() {
    let beam = r#""curvature": [0.1, -0.2, 0.4]"#;
    let outputs = [sections(3, "rod", &[0.0, 2.0]), reactions(3, "clamp", "post")].join(", ");
    let text = scene(3, beam, ["[1, 8, 20]", "[3, 2, -4]"], &outputs);
    let post = r#""bodies": [ { "name": "post", "type": "rigid", "mass": 1, "inertia": [1, 1, 1] },"#;
    let text = text.replacen("\"bodies\": [", post, 1).replace("\"ground.wall\", \"tip\"", "\"post\", \"tip\"");
    let clamp = r#""joints": [ { "name": "clamp", "type": "weld", "between": ["ground.wall", "post"] } ], "outputs""#;
    let (_, out) = at_rest(&parse(&text.replace("\"outputs\"", clamp)), 0.0);
    let size = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    // The equilibrium is found to 1e-12 of the largest stiffness.
    assert!((0..6).all(|i| (out[i] + out[12 + i]).abs() < 1e-7), "{out:?}");
    assert!((size(&out[6..9]) - size(&[1.0, 8.0, 20.0])).abs() < 1e-7, "{out:?}");
    assert!((size(&out[9..12]) - size(&[3.0, 2.0, -4.0])).abs() < 1e-7, "{out:?}");
}

/// Deflection and strain as a cantilever's.
#[test]
fn its_line_and_strain_are_those_of_a_cantilever() {
    let outputs = r#"{ "name": "y", "measure": "deflection", "of": "rod", "at": 1.2 },
        { "name": "e", "measure": "strain", "of": "rod", "at": 1.2, "offset": [0.05] }"#;
    let ready: Ready = parse(&scene(2, r#""theory": "timoshenko""#, ["[4e-6, 3e-6]", "5e-6"], outputs));
    let (_, out) = at_rest(&ready, 0.0);
    let s = 1.2f64;
    let moment = 5e-6 + 3e-6 * 0.8;
    let y = 3e-6 * s * s * (6.0 - s) / 1800.0 + 5e-6 * s * s / 600.0 + 3e-6 * s / 4e3;
    assert!(
        (out[0] - y).abs() < 1e-13 && (out[1] - (4e-6 / 1e4 - 0.05 * moment / 300.0)).abs() < 1e-14,
        "{out:?} {y:e}"
    );
}

#[test]
fn what_it_does_not_have_is_refused() {
    let of = |output: &str| {
        scene(2, r#""theory": "timoshenko""#, ["[0, 0]", "0"], &format!(r#"{{ "name": "it", {output} }}"#))
    };
    for (output, message) in [
        (r#""measure": "axial_force", "of": "rod", "at": 2.1"#, "2.1 m is off the beam"),
        (r#""measure": "torque", "of": "rod", "at": 1"#, "a planar beam carries no torque"),
        (r#""measure": "axial_force", "of": "load", "at": 1"#, "there is no flexible beam `load`"),
        (r#""measure": "axial_force", "of": "tip", "at": 1"#, "there is no flexible beam `tip`"),
    ] {
        let error = Scene::parse(&of(output), &[]).err().expect("refused").to_string();
        assert!(error.contains(message), "{error}");
    }
}
