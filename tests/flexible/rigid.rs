//! Beams that move as a whole: no strain, and the rigid body as the limit of stiff ones.

use crate::flexible::beams::{FLOATING, FRAMES, Rod, THEORIES, largest, place_outputs, scene};
use crate::flexible::brief;
use crate::scenes::{Ready, parse};
use holonom::method_spec::MethodSpec;
use holonom::simulate::{Method, Span};

/// A beam that is thrown without spin, from a place and with a turn of its own.
fn thrown(dimension: usize, frame: &str, theory: &str, stiffening: bool) -> Ready {
    let start = match dimension {
        2 => r#""initial": { "position": [0.7, -1.3], "angle": 2.1, "velocity": [3, 5] },"#,
        _ => r#""initial": { "position": [0.7, -1.3, 0.4], "rotation": [0.5, -1.1, 2.0], "velocity": [3, 5, -2] },"#,
    };
    let stiffens = if stiffening { r#""geometric_stiffening": true,"# } else { "" };
    let more = format!("{start}{stiffens}");
    let rod = Rod { dimension, frame, theory, elements: 4, stiffness: 1.0, more: &more }.json();
    let mut outputs = [
        r#"{ "name": "strain", "measure": "strain", "of": "rod", "at": 0.8, "offset": [OFFSET] }"#.to_string(),
        r#"{ "name": "axial", "measure": "axial_force", "of": "rod", "at": 0.8 }"#.to_string(),
        r#"{ "name": "moment", "measure": "bending_moment", "of": "rod", "at": 0.8 }"#.to_string(),
        r#"{ "name": "deflection", "measure": "deflection", "of": "rod", "at": 2 }"#.to_string(),
    ];
    outputs[0] = outputs[0].replace("OFFSET", if dimension == 2 { "0.1" } else { "0.1, -0.2" });
    let gravity = if dimension == 2 { "[1, -9.81]" } else { "[1, -9.81, 2]" };
    let places = place_outputs(dimension, "rod.tip");
    let rest = format!(r#""gravity": {gravity}, "outputs": [ {}, {places} ]"#, outputs.join(", "));
    parse(&scene(dimension, &rod, &rest))
}

/// An explicit method would step to the edge of its stability, where round-off of the fastest modes grows to the tolerance.
fn implicit(tolerance: f64) -> Method {
    Method {
        formulation: MethodSpec::named("ggl"),
        integrator: MethodSpec::named("radau_iia"),
        projection: MethodSpec::named("none"),
        rtol: tolerance,
        atol: tolerance,
        ..Method::default()
    }
}

/// It falls like a stone. Nodes reach 6 m, where rounding is 1e-15 m of elements of 0.5 m.
#[test]
fn a_thrown_beam_is_not_strained() {
    for (dimension, theory) in [2, 3].into_iter().flat_map(|d| THEORIES.map(|theory| (d, theory))) {
        for (frame, stiffening) in FRAMES.map(|frame| (frame, false)).into_iter().chain([("tangent", true)]) {
            let beam = thrown(dimension, frame, theory, stiffening);
            let run = beam.run(&implicit(1e-10), Span { start: 0.0, end: 1.0, output_step: 0.1 });
            let largest = |name: &str| largest(run.column(name).into_iter());
            let found = ["strain", "axial", "moment", "deflection"].map(largest);
            let what = format!("{dimension} {theory} {frame} {stiffening}: {}", brief(&found));
            println!("{what}");
            // EA = 1e4 N, and EI = 300 N m^2 over 2 m.
            assert!(found.iter().zip([1e-12, 1e-8, 1e-10, 1e-12]).all(|(found, bound)| *found < bound), "{what}");
            // It has gone where a stone goes, by g t^2/2 and v t from its start.
            let y = run.column("y");
            assert!((y[10] - y[0] - (5.0 - 9.81 / 2.0)).abs() < 1e-9, "{what}");
        }
    }
}

/// A pendulum of the beam, or of a rigid body with its inertia.
fn pendulum(dimension: usize, rod: &str, marker: &str) -> Ready {
    let (kind, gravity) = if dimension == 2 { ("revolute", "[0, -9.81]") } else { ("spherical", "[0, 0, -9.81]") };
    let rest = format!(
        r#""gravity": {gravity}, "joints": [ {{ "name": "o", "type": "{kind}", "between": ["ground.wall", "rod.{marker}"] }} ],
        "outputs": [ {} ]"#,
        place_outputs(dimension, "rod.tip")
    );
    parse(&scene(dimension, rod, &rest))
}

/// The static deflection falls with 1/EI, and the pendulum swings ever more like the rigid one: in the plane, and in space
/// where it also turns about the vertical.
#[test]
fn a_stiff_beam_moves_like_a_rigid_body() {
    // m L^2/12 and the rotary inertia of the sections.
    let across = 2.0 * 4.0 / 12.0 + 0.1 * 2.0;
    let rigid = [
        format!(
            r#"{{ "name": "rod", "type": "rigid", "mass": 2, "inertia": {across}, "initial": {{ "position": [1, 0] }},
            "markers": {{ "root": [-1, 0], "tip": [1, 0] }} }}"#
        ),
        format!(
            r#"{{ "name": "rod", "type": "rigid", "mass": 2, "inertia": [0.4, {across}, {across}],
            "initial": {{ "position": [1, 0, 0], "velocity": [0, 1, 0], "angular_velocity": [0, 0, 1] }},
            "markers": {{ "root": [-1, 0, 0], "tip": [1, 0, 0] }} }}"#
        ),
    ];
    for dimension in [2, 3] {
        let names = &["x", "y", "z"][..dimension];
        let reference = pendulum(dimension, &rigid[dimension - 2], "root").tight(1e-10, 1.0, 0.05);
        for frame in FLOATING {
            let start = if dimension == 2 { "" } else { r#""initial": { "angular_velocity": [0, 0, 1] }, "# };
            let apart = [10.0, 100.0, 1000.0].map(|stiffness| {
                let rod = Rod { dimension, frame, theory: "timoshenko", elements: 2, stiffness, more: start }.json();
                let run = pendulum(dimension, &rod, "root").tight(1e-9, 1.0, 0.05);
                let gap =
                    |name: &&str| largest(run.column(name).iter().zip(reference.column(name)).map(|(a, b)| a - b));
                names.iter().map(gap).fold(0.0, f64::max)
            });
            println!("from the rigid pendulum, {dimension} {frame}: {}", brief(&apart));
            assert!(apart[2] < 1e-4, "{apart:?}");
            assert!(apart.windows(2).all(|pair| (5.0..20.0).contains(&(pair[0] / pair[1]))), "{apart:?}");
        }
    }
}
