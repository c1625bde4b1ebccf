//! Beams at rest.

use crate::scenes::{Ready, model, parse};
use crate::section_forces::{FRAMES, THEORIES, at_rest, frame_keys, gap, reactions, sections};
use holonom::scene::Scene;
use std::f64::consts::FRAC_PI_2;

/// A quarter of a circle of radius 1, clamped, with a force out of its plane at its tip.
fn arc(frame: &str, theory: &str, elements: usize, force: f64) -> Ready {
    let length = FRAC_PI_2;
    let places = [0.0, 0.1, 0.37, 0.5, 0.77, 1.0].map(|part| part * length);
    let frame = frame_keys(frame);
    let outputs = sections(3, "rod", &places);
    parse(&format!(
        r#"{{ "name": "arc", "dimension": 3, "ground": {{ "markers": {{ "wall": [0, 0, 0] }} }},
        "bodies": [ {{ "name": "rod", "type": "flexible_beam", {frame}, "length": {length},
            "elements": {elements}, "theory": "{theory}", "curvature": [0, 0, 1],
            "stiffness": {{ "EA": 1e6, "GA": 4e5, "GJ": 100, "EI": 100 }}, "inertia": {{ "rhoA": 1, "rhoI": 0.01 }},
            "markers": {{ "root": [0, 0, 0], "tip": [{length}, 0, 0] }} }} ],
        "joints": [ {{ "name": "clamp", "type": "weld", "between": ["ground.wall", "rod.root"] }} ],
        "forces": [ {{ "name": "load", "type": "applied_force", "at": "rod.tip", "force": [0, 0, {force}] }} ],
        "outputs": [ {outputs},
            {{ "name": "x", "measure": "position", "of": "rod.tip" }},
            {{ "name": "z", "measure": "position", "of": "rod.tip", "component": "z" }} ] }}"#
    ))
}

/// By statics of the arc as it is: |Qz| = P everywhere, and the moment P (1 - cos a) of torsion, P sin a of bending, a from
/// the tip. Each number of elements is exact there, in both theories; the rest is of second order in the force.
#[test]
fn an_arc_carries_its_load_at_every_section() {
    let force = 1e-3;
    let cases = ["tangent", "mean", "absolute"].into_iter().flat_map(|frame| THEORIES.map(|theory| (frame, theory)));
    for ((frame, theory), elements) in cases.flat_map(|case| [1, 4, 16].map(|n| (case, n))) {
        let (_, out) = at_rest(&arc(frame, theory, elements, force), 0.0);
        for (part, section) in [0.0, 0.1, 0.37, 0.5, 0.77, 1.0].into_iter().zip(out.chunks(6)) {
            let (sin, cos) = ((1.0 - part) * FRAC_PI_2).sin_cos();
            let expected = [0.0, 0.0, 1.0, 1.0 - cos, -sin, 0.0].map(|x| x * force);
            // P/EI is 1e-5, and what is left of forces in the equilibrium 1e-7.
            let error = gap(section, &expected) / force;
            assert!(error < 2e-5, "{frame} {theory} {elements} at {part}: {section:?} {expected:?}");
            assert!((section[2] / force - 1.0).abs() < 1e-8, "{frame} {theory} {elements} at {part}: {section:?}");
        }
    }
}

/// A large load: the root carries exactly the load, and all sections converge as the displacements do, with the square of
/// the element.
#[test]
fn sections_of_a_deformed_arc_converge_as_its_displacements() {
    let force = 20.0;
    for theory in THEORIES {
        let all = [128, 2, 4, 8, 16].map(|elements| at_rest(&arc("absolute", theory, elements, force), 0.0).1);
        let errors =
            |part: std::ops::Range<usize>| [1, 2, 3, 4].map(|i| gap(&all[i][part.clone()], &all[0][part.clone()]));
        let forces = errors(0..36);
        let moves = errors(36..38);
        println!("{theory}: sections {forces:?} N, tip {moves:?} m");
        assert!(all.iter().all(|out| (out[2] / force - 1.0).abs() < 1e-9), "{theory}");
        // Of 20 N and 20 N m. 128 elements leave 1/64 of what 16 do.
        assert!(forces[0] < 0.2, "{theory}: {forces:?}");
        for errors in [forces, moves] {
            let orders = [0, 1, 2].map(|i| (errors[i] / errors[i + 1]).log2());
            assert!(orders.iter().all(|order| *order > 1.8), "{theory}: {errors:?} {orders:?}");
        }
    }
}

/// Bathe's bend under its full load: at the root all of it as shear, and the torque of its arm at the deformed tip.
#[test]
fn the_root_of_bathes_bend_carries_all() {
    let text = std::fs::read_to_string(model("bathe_bend")).unwrap();
    let more = [sections(3, "bend", &[0.0]), reactions(3, "clamp", "bend.root")].join(", ");
    for (elements, torque) in [("8", 9414.43), ("32", 9411.05)] {
        let text = text
            .replace("\"elements\": 8", &format!("\"elements\": {elements}"))
            .replace("\"outputs\": [", &format!("\"outputs\": [ {more},"));
        let (_, out) = at_rest(&parse(&text), 100.0);
        println!("bathe_bend, {elements}: {:?}", &out[..6]);
        // What is left of forces in the equilibrium, of EA = 1e7.
        assert!((out[2] - 600.0).abs() < 1e-6 && out[0].abs() < 1e-5 && out[1].abs() < 1e-5, "{out:?}");
        // The moment hangs on the deflection: 9410.8 in the limit.
        assert!((out[3] - torque).abs() < 0.01, "{out:?}");
        (0..6).for_each(|i| assert!((out[i] + out[6 + i]).abs() < 1e-8 * 600.0 * 70.0, "{i}: {out:?}"));
    }
}

const LENGTH: f64 = 2.0;

fn cantilever(dimension: usize, frame: &str, theory: &str, elements: usize, [weight, ei]: [f64; 2]) -> Ready {
    let (zero, tip, gravity, gj) = match dimension {
        2 => ("0, 0", "2, 0", format!("0, -{weight}"), ""),
        _ => ("0, 0, 0", "2, 0, 0", format!("0, 0, -{weight}"), r#""GJ": 80,"#),
    };
    let outputs = sections(dimension, "rod", &PARTS.map(|part| part * LENGTH));
    let frame = frame_keys(frame);
    parse(&format!(
        r#"{{ "name": "cantilever", "dimension": {dimension}, "gravity": [{gravity}],
        "ground": {{ "markers": {{ "wall": [{zero}] }} }},
        "bodies": [ {{ "name": "rod", "type": "flexible_beam", {frame}, "length": 2, "elements": {elements},
            "theory": "{theory}", "stiffness": {{ "EA": 1e5, "GA": 4e4, {gj} "EI": {ei} }},
            "inertia": {{ "rhoA": 3, "rhoI": 0.01 }}, "markers": {{ "root": [{zero}], "tip": [{tip}] }} }} ],
        "joints": [ {{ "name": "clamp", "type": "weld", "between": ["ground.wall", "rod.root"] }} ],
        "outputs": [ {outputs} ] }}"#
    ))
}

const PARTS: [f64; 6] = [0.0, 0.1, 0.5, 0.75, 0.9, 1.0];

/// Own weight, in the plane and in space, in every frame and theory, however coarse the mesh: q (L - s) and
/// q (L - s)^2/2.
#[test]
fn a_cantilever_carries_its_own_weight() {
    for (dimension, frame) in [2, 3].into_iter().flat_map(|d| FRAMES.map(|frame| (d, frame))) {
        for (theory, elements) in THEORIES.into_iter().flat_map(|theory| [1, 2, 5].map(|n| (theory, n))) {
            let (_, out) = at_rest(&cantilever(dimension, frame, theory, elements, [1e-7, 100.0]), 0.0);
            let q = 3e-7;
            for (part, section) in PARTS.into_iter().zip(out.chunks(out.len() / PARTS.len())) {
                let rest = LENGTH * (1.0 - part);
                let shear = -q * rest;
                let moment = q * rest * rest / 2.0;
                let expected =
                    if dimension == 2 { vec![0.0, shear, -moment] } else { vec![0.0, 0.0, shear, 0.0, moment, 0.0] };
                let what = format!("{dimension} {frame} {theory} {elements} at {part}: {section:?} {expected:?}");
                // The axial force has the part q (L - s) times the slope, 4e-9 of it; shear and moment have its square.
                assert!(section[0].abs() < 1e-8 * q * LENGTH, "{what}");
                // An absolute beam finds them beside EA, 1e12 times as large.
                let near = if frame == "absolute" { 1e-8 } else { 1e-10 };
                assert!(gap(&section[1..], &expected[1..]) < near * q * LENGTH, "{what}");
            }
        }
    }
}

/// The weight of a floating beam that bends far enough to see: the root still carries all of it, exactly, and its moment.
#[test]
fn the_root_carries_any_weight() {
    for (dimension, theory) in [2, 3].into_iter().flat_map(|d| THEORIES.map(|theory| (d, theory))) {
        let (_, out) = at_rest(&cantilever(dimension, "tangent", theory, 3, [0.5, 100.0]), 0.0);
        let (shear, moment) = if dimension == 2 { (out[1], -out[2]) } else { (out[2], out[4]) };
        assert!((shear / -3.0 - 1.0).abs() < 1e-10 && (moment / 3.0 - 1.0).abs() < 1e-10, "{out:?}");
    }
}

/// Large deflections under own weight: the axial force at the root is none, shear all of the weight with any mesh; the
/// rest converges with the third to fourth power of the element.
#[test]
fn a_heavy_cantilever_converges() {
    for dimension in [2, 3] {
        let all = [64, 2, 4, 8, 16, 32]
            .map(|n| at_rest(&cantilever(dimension, "absolute", "euler_bernoulli", n, [20.0, 100.0]), 0.0).1);
        let shear = if dimension == 2 { 1 } else { 2 };
        assert!(all.iter().all(|out| (out[shear] / -120.0 - 1.0).abs() < 1e-9 && out[0].abs() < 1e-7), "{dimension}");
        let errors = [1, 2, 3, 4, 5].map(|i| gap(&all[i], &all[0]));
        println!("weight in {dimension}: {errors:?} of 120 N");
        // Orders of 3.2 to 4.2 were measured.
        assert!(errors[0] < 0.2 && errors.windows(2).all(|pair| pair[0] > 8.0 * pair[1]), "{errors:?}");
    }
}

/// What acts on a floating frame that is no section of its beam acts at no place of it; on one that is, at the left end.
#[test]
fn what_acts_on_the_frame_itself() {
    let scene = |frame: &str| {
        let frame = frame_keys(frame);
        let outputs = sections(2, "rod", &[0.0]);
        format!(
            r#"{{ "name": "frame", "dimension": 2, "gravity": [0, -9.81], "ground": {{ "markers": {{ "o": [0, 0] }} }},
            "bodies": [ {{ "name": "rod", "type": "flexible_beam", {frame}, "length": 2, "elements": 2,
                "stiffness": {{ "EA": 1e5, "EI": 300 }}, "inertia": {{ "rhoA": 1 }} }} ],
            "joints": [ {{ "name": "clamp", "type": "weld", "between": ["ground.o", "rod"] }} ], "outputs": [ {outputs} ] }}"#
        )
    };
    let (_, out) = at_rest(&parse(&scene("tangent")), 0.0);
    assert!((out[1] / (-2.0 * 9.81) - 1.0).abs() < 1e-10 && (out[2] / (-2.0 * 9.81) - 1.0).abs() < 1e-10, "{out:?}");
    for frame in ["chord", "mean"] {
        let error = Scene::parse(&scene(frame), &[]).err().expect("refused").to_string();
        assert!(error.contains("`clamp` acts on the floating frame of `rod`, which is no section of it"), "{error}");
    }
}
