//! Beams that move: weight and inertia between the ends count.

use crate::scenes::{Ready, parse};
use crate::section_forces::{FRAMES, THEORIES, frame_keys, reactions, sections};
use holonom::method_spec::MethodSpec;
use holonom::simulate::{Method, Span};

/// A beam on a hub that turns, with loads that change, and its sections at the root, beside the middle and at the tip.
fn hub(dimension: usize, body: &str) -> Ready {
    let (zero, clamp, mid, tip, gravity, inertia, turn, load) = match dimension {
        2 => ("0, 0", "0.3, 0", "1, 0", "2, 0", "0.5, -9.81", "1", "\"5*t\"", r#"["2*sin(9*t)", "3 + 30*t"]"#),
        _ => (
            "0, 0, 0",
            "0.3, 0, 0",
            "1, 0, 0",
            "2, 0, 0",
            "0.3, -9.81, 2",
            "[1, 1, 1]",
            r#"["2*t", 1, "5*t"]"#,
            r#"["2*sin(9*t)", "3 + 30*t", "40*t^2"]"#,
        ),
    };
    let gj = if dimension == 2 { "" } else { r#""GJ": 80,"# };
    let outputs = [sections(dimension, "rod", &[0.0, 1.1, 2.0]), reactions(dimension, "clamp", "rod.root")].join(", ");
    parse(&format!(
        r#"{{ "name": "hub", "dimension": {dimension}, "gravity": [{gravity}],
        "ground": {{ "markers": {{ "o": [{zero}] }} }},
        "bodies": [ {{ "name": "hub", "type": "rigid", "mass": 2, "inertia": {inertia}, "markers": {{ "p": [{clamp}] }} }},
            {{ "name": "rod", "type": "flexible_beam", {body}, "length": 2,
               "stiffness": {{ "EA": 1e5, "GA": 4e4, {gj} "EI": 100 }}, "inertia": {{ "rhoA": 3, "rhoI": 0.01 }},
               "markers": {{ "root": [{zero}], "mid": [{mid}], "tip": [{tip}] }}, "initial": {{ "position": [{clamp}] }} }} ],
        "joints": [ {{ "name": "pin", "type": "revolute", "between": ["ground.o", "hub"] }},
            {{ "name": "clamp", "type": "weld", "between": ["hub.p", "rod.root"] }} ],
        "forces": [ {{ "name": "load", "type": "applied_force", "at": "rod.tip", "force": {load} }},
            {{ "name": "turn", "type": "applied_torque", "at": "rod.mid", "torque": {turn} }} ],
        "outputs": [ {outputs} ] }}"#
    ))
}

fn method(formulation: &str, integrator: &str) -> Method {
    let named = MethodSpec::named;
    Method {
        formulation: named(formulation),
        integrator: named(integrator),
        projection: named("none"),
        rtol: 1e-6,
        atol: 1e-8,
        ..Method::default()
    }
}

/// The largest |section at the root + reaction| over the motion, over the largest reaction.
fn off(ready: &Ready, dimension: usize, method: &Method) -> f64 {
    let run = ready.run(method, Span { start: 0.0, end: 0.1, output_step: 0.01 });
    let mut off = 0.0f64;
    let mut size = 0.0f64;
    for i in 0..if dimension == 2 { 3 } else { 6 } {
        for (section, reaction) in run.column(&format!("s{i}")).iter().zip(run.column(&format!("r{i}"))) {
            (off, size) = (off.max((section + reaction).abs()), size.max(reaction.abs()));
        }
    }
    assert!(size > 10.0, "{size}");
    off / size
}

/// What the root carries is the reaction of its clamp, in any motion, frame, theory and mesh, to round-off.
#[test]
fn the_root_carries_the_reaction_of_its_clamp() {
    for (dimension, frame) in [2, 3].into_iter().flat_map(|d| FRAMES.map(|frame| (d, frame))) {
        for (theory, elements) in THEORIES.into_iter().flat_map(|theory| [1, 3].map(|n| (theory, n))) {
            let body = format!(r#"{}, "theory": "{theory}", "elements": {elements}"#, frame_keys(frame));
            let off = off(&hub(dimension, &body), dimension, &method("ggl", "radau_iia"));
            assert!(off < 1e-13, "{dimension} {frame} {theory} {elements}: {off:e}");
        }
    }
}

/// The same for other ways to describe displacements, and for damping of each kind.
#[test]
fn whatever_the_coordinates() {
    for body in [
        r#""frame": "floating", "elements": 6, "modes": 1"#,
        r#""frame": "floating", "elements": 6, "frame_conditions": "chord", "modes": 2, "damping": { "modal": 0.1 }"#,
        r#""frame": "floating", "elements": 3, "geometric_stiffening": true"#,
        r#""frame": "floating", "elements": 3, "axial": "quadratic", "damping": { "rayleigh": { "mass": 3, "stiffness": 0.01 } }"#,
        r#""frame": "absolute", "elements": 3, "damping": { "rayleigh": { "stiffness": 0.01 } }"#,
        r#""frame": "floating", "ritz": { "bending": ["(x/2)^2", "(x/2)^3"], "axial": ["x"], "axial_mass_factor": 1.3 }"#,
    ] {
        let off = off(&hub(2, body), 2, &method("ggl", "radau_iia"));
        // Functions are integrated numerically, to 1e-12.
        let near = if body.contains("ritz") { 1e-11 } else { 1e-13 };
        assert!(off < near, "{body}: {off:e}");
    }
}

/// And for formulations and integrators whose v' and multipliers come about in other ways.
#[test]
fn whatever_the_method() {
    for (formulation, integrator) in [
        ("index1", "dop853"),
        ("index2", "radau_iia"),
        ("index3", "radau_iia"),
        ("null_space", "dopri5"),
        ("ggl", "bdf"),
        ("udwadia_kalaba", "dopri5"),
    ] {
        for frame in ["tangent", "absolute"] {
            let body = format!(r#"{}, "elements": 2"#, frame_keys(frame));
            let off = off(&hub(2, &body), 2, &method(formulation, integrator));
            assert!(off < 1e-10, "{formulation} {integrator} {frame}: {off:e}");
        }
    }
}

/// A section beside a load at a marker carries the load of the other side besides, a place to the left of it none.
#[test]
fn the_load_at_a_marker_makes_a_step() {
    for frame in ["tangent", "absolute"] {
        let body = format!(r#"{}, "elements": 2"#, frame_keys(frame));
        let beside = [1.0, 1.0 + 1e-7];
        let text = stepped(&body, &beside);
        let run = parse(&text).run(&method("ggl", "radau_iia"), Span { start: 0.0, end: 0.1, output_step: 0.02 });
        for ((t, left), right) in run.times().into_iter().zip(run.column("s2")).zip(run.column("s5")) {
            // The torque on the node; 1e-7 m of shear of 30 N beside it.
            assert!((left - right - 5.0 * t).abs() < 1e-5, "{frame} at {t}: {left} {right}");
        }
    }
}

fn stepped(body: &str, places: &[f64]) -> String {
    let outputs = sections(2, "rod", places);
    format!(
        r#"{{ "name": "step", "dimension": 2, "gravity": [0, -9.81], "ground": {{ "markers": {{ "o": [0, 0] }} }},
        "bodies": [ {{ "name": "rod", "type": "flexible_beam", {body}, "length": 2,
            "stiffness": {{ "EA": 1e5, "EI": 100 }}, "inertia": {{ "rhoA": 3, "rhoI": 0.01 }},
            "markers": {{ "root": [0, 0], "mid": [1, 0] }} }} ],
        "joints": [ {{ "name": "clamp", "type": "weld", "between": ["ground.o", "rod.root"] }} ],
        "forces": [ {{ "name": "turn", "type": "applied_torque", "at": "rod.mid", "torque": "5*t" }} ],
        "outputs": [ {outputs} ] }}"#
    )
}

/// A beam that turns evenly: its tension is int rho A W^2 r ds over what is beyond, of the stretched beam
/// EA (cos(k s)/cos(k L) - 1) with k^2 = rho A W^2/EA. The stretch alone is 0.5 % of it.
#[test]
fn a_turning_beam_is_under_tension() {
    let length = 2.0;
    let ea = 1e4;
    let rho = 3.0;
    let w = 3.0;
    let places = [0.0, 0.3, 0.9, 1.7];
    let k = f64::sqrt(rho * w * w / ea);
    for (frame, elements) in [("tangent", 2), ("tangent", 8), ("absolute", 2), ("absolute", 8)] {
        let frame_keys = frame_keys(frame);
        let outputs = sections(2, "rod", &places);
        let ready = parse(&format!(
            r#"{{ "name": "turning", "dimension": 2, "ground": {{ "markers": {{ "o": [0, 0] }} }},
            "bodies": [ {{ "name": "rod", "type": "flexible_beam", {frame_keys}, "length": {length}, "elements": {elements},
                "stiffness": {{ "EA": {ea}, "EI": 300 }}, "inertia": {{ "rhoA": {rho}, "rhoI": 0.01 }},
                "damping": {{ "rayleigh": {{ "stiffness": 0.02 }} }}, "markers": {{ "root": [0, 0] }},
                "initial": {{ "angular_velocity": {w} }} }} ],
            "joints": [ {{ "name": "pin", "type": "revolute", "between": ["ground.o", "rod.root"] }},
                {{ "name": "drive", "type": "driver", "between": ["ground.o", "rod.root"], "coordinate": "angle",
                   "value": "{w}*t" }} ],
            "outputs": [ {outputs} ] }}"#
        ));
        let run = ready.run(&method("ggl", "radau_iia"), Span { start: 0.0, end: 10.0, output_step: 1.0 });
        for (i, s) in places.iter().enumerate() {
            let expected = ea * ((k * s).cos() / (k * length).cos() - 1.0);
            let found = *run.column(&format!("s{}", 3 * i)).last().unwrap();
            println!("turning, {frame} {elements} at {s}: {found:.6} of {expected:.6}");
            // Linear displacements lack (k h)^2/12 of it; swings since the start leave 7e-6.
            let near = f64::powi(k * length / f64::from(elements), 2) / 11.0 + 1e-5;
            assert!((found / expected - 1.0).abs() < near, "{frame} {elements} at {s}: {found} {expected}");
        }
    }
}
