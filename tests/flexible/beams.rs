//! The beam that most of these tests take: 2 m long, EA = 1e4 N, EI = 300 N m^2 (100 N m^2 about y), GA = 4e3 N (3e3 N
//! along z), GJ = 60 N m^2, 1 kg/m, 0.1 kg m.

use crate::scenes::Ready;
use holonom::initial::equilibrium;
use holonom::system::{OperatingPoint, Scratch};

pub const LENGTH: f64 = 2.0;
pub const EA: f64 = 1e4;
/// About y and z.
pub const EI: [f64; 2] = [100.0, 300.0];
/// LociVariable y and z.
pub const GA: [f64; 2] = [4e3, 3e3];

pub const THEORIES: [&str; 2] = ["euler_bernoulli", "timoshenko"];

/// Ways to move the frame, and the beam in absolute coordinates.
pub const FLOATING: [&str; 3] = ["tangent", "chord", "mean"];
pub const FRAMES: [&str; 4] = ["tangent", "chord", "mean", "absolute"];

/// Body `rod` of a scene, its stiffnesses times `stiffness`.
pub struct Rod<'a> {
    pub dimension: usize,
    /// One of [`FRAMES`].
    pub frame: &'a str,
    pub theory: &'a str,
    pub elements: usize,
    pub stiffness: f64,
    /// Further keys, each with a comma behind.
    pub more: &'a str,
}

impl Rod<'_> {
    pub fn json(&self) -> String {
        let Rod { dimension, theory, elements, stiffness, more, .. } = *self;
        let kind = match self.frame {
            "absolute" => r#""frame": "absolute""#.to_string(),
            frame => format!(r#""frame": "floating", "frame_conditions": "{frame}", "rotary_inertia": true"#),
        };
        let [a, b, c] = if dimension == 2 { ["0, 0", "1, 0", "2, 0"] } else { ["0, 0, 0", "1, 0, 0", "2, 0, 0"] };
        let section = match dimension {
            2 => format!(r#""EA": "1e4*{stiffness}", "EI": "300*{stiffness}", "GA": "4e3*{stiffness}""#),
            _ => format!(
                r#""EA": "1e4*{stiffness}", "EI": ["100*{stiffness}", "300*{stiffness}"],
                "GA": ["4e3*{stiffness}", "3e3*{stiffness}"], "GJ": "60*{stiffness}""#
            ),
        };
        format!(
            r#"{{ "name": "rod", "type": "flexible_beam", {kind}, {more} "length": 2, "elements": {elements},
            "theory": "{theory}", "stiffness": {{ {section} }}, "inertia": {{ "rhoA": 1, "rhoI": 0.1 }},
            "markers": {{ "root": [{a}], "mid": [{b}], "tip": [{c}] }} }}"#
        )
    }
}

/// A scene with these bodies and whatever else it has.
pub fn scene(dimension: usize, bodies: &str, rest: &str) -> String {
    let wall = if dimension == 2 { "0, 0" } else { "0, 0, 0" };
    format!(
        r#"{{ "name": "beam", "dimension": {dimension}, "ground": {{ "markers": {{ "wall": [{wall}] }} }},
        "bodies": [ {bodies} ], {rest} }}"#
    )
}

/// Outputs `x`, `y` and, in space, `z` of a marker's position.
pub fn place_outputs(dimension: usize, marker: &str) -> String {
    let one = |axis: &&str| {
        format!(r#"{{ "name": "{axis}", "measure": "position", "of": "{marker}", "component": "{axis}" }}"#)
    };
    ["x", "y", "z"][..dimension].iter().map(one).collect::<Vec<_>>().join(", ")
}

/// The outputs with these names in the equilibrium that belongs to the start.
pub fn at_rest(ready: &Ready, names: &[&str]) -> Vec<f64> {
    let system = ready.system();
    let found =
        equilibrium(system, 0.0, (&ready.start().q, &ready.start().v)).unwrap_or_else(|error| panic!("{error}"));
    let columns = system.facts().outputs.clone();
    let mut out = vec![0.0; columns.len()];
    let still = vec![0.0; system.dimensions().v];
    let at = OperatingPoint { t: found.t, q: &found.q, v: &still, vdot: &still, lambda: &found.lambda };
    system.outputs(at, &mut out, &mut Scratch::default());
    names.iter().map(|name| out[columns.iter().position(|column| column.name == *name).unwrap()]).collect()
}

/// The largest size.
pub fn largest(gaps: impl Iterator<Item = f64>) -> f64 {
    gaps.fold(0.0, |largest, gap| largest.max(gap.abs()))
}
