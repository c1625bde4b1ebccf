//! Section forces of beams against statics, in equilibrium and in motion: absolute, floating and massless beams.

mod linear;
mod massless;
mod motion;
mod statics;

use crate::scenes::Ready;
use holonom::initial::equilibrium;
use holonom::system::{OperatingPoint, Scratch};

/// The six components of a section, or the three in the plane, with their names in a scene.
fn components(dimension: usize) -> &'static [(&'static str, &'static str)] {
    match dimension {
        2 => &[("axial_force", ""), ("shear_force", "y"), ("bending_moment", "z")],
        _ => &[
            ("axial_force", ""),
            ("shear_force", "y"),
            ("shear_force", "z"),
            ("torque", ""),
            ("bending_moment", "y"),
            ("bending_moment", "z"),
        ],
    }
}

/// Outputs `s0`, `s1` ... of all components of `beam` at these places, place by place.
fn sections(dimension: usize, beam: &str, places: &[f64]) -> String {
    let all = places.iter().flat_map(|at| components(dimension).iter().map(move |component| (at, component)));
    let output = |(i, (at, (measure, axis))): (usize, (&f64, &(&str, &str)))| {
        let axis = if axis.is_empty() { String::new() } else { format!(r#", "component": "{axis}""#) };
        format!(r#"{{ "name": "{}", "measure": "{measure}", "of": "{beam}", "at": {at}{axis} }}"#, name("s", i))
    };
    all.enumerate().map(output).collect::<Vec<_>>().join(", ")
}

/// Outputs `r0` ... of the reaction of a joint in the axes of a marker, in the order of [`components`].
fn reactions(dimension: usize, joint: &str, axes: &str) -> String {
    let all: &[&str] = if dimension == 2 { &["x", "y", "mz"] } else { &["x", "y", "z", "mx", "my", "mz"] };
    let output = |(i, component): (usize, &&str)| {
        let name = name("r", i);
        let keys = format!(r#""component": "{component}", "relative_to": "{axes}""#);
        format!(r#"{{ "name": "{name}", "measure": "reaction", "of": "{joint}", {keys} }}"#)
    };
    all.iter().enumerate().map(output).collect::<Vec<_>>().join(", ")
}

fn name(letter: &str, i: usize) -> String {
    format!("{letter}{i}")
}

/// q and the outputs in the equilibrium beside the start, at a time.
fn at_rest(ready: &Ready, t: f64) -> (Vec<f64>, Vec<f64>) {
    let system = ready.system();
    let found = equilibrium(system, t, (&ready.start().q, &ready.start().v)).unwrap_or_else(|error| panic!("{error}"));
    let mut out = vec![0.0; system.facts().outputs.len()];
    let still = vec![0.0; system.dimensions().v];
    let at = OperatingPoint { t, q: &found.q, v: &still, vdot: &still, lambda: &found.lambda };
    system.outputs(at, &mut out, &mut Scratch::default());
    (found.q, out)
}

/// The largest difference, component by component.
fn gap(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |most, (a, b)| most.max((a - b).abs()))
}

const THEORIES: [&str; 2] = ["euler_bernoulli", "timoshenko"];
const FRAMES: [&str; 4] = ["tangent", "chord", "mean", "absolute"];

/// The keys of a beam that say how its frame moves.
fn frame_keys(frame: &str) -> String {
    match frame {
        "absolute" => r#""frame": "absolute""#.to_string(),
        frame => format!(r#""frame": "floating", "frame_conditions": "{frame}""#),
    }
}
