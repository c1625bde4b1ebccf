//! Section forces as outputs of linear models: C and D know how v' answers.

use crate::scenes::{Ready, parse};
use crate::section_forces::{at_rest, frame_keys, reactions, sections};
use holonom::linearize::{Chart, Linear, LinearModel, Matrix, Variation};
use holonom::method_spec::MethodSpec;

/// A clamped beam with its root as output, whose load at the tip is an input.
fn clamped(dimension: usize, frame: &str) -> Ready {
    let (zero, tip, gravity, load, gj) = match dimension {
        2 => ("0, 0", "1, 0", "1, -9.81", "[3, 1]", ""),
        _ => ("0, 0, 0", "1, 0, 0", "1, -9.81, 4", "[3, 1, 2]", r#""GJ": 80,"#),
    };
    let outputs = [sections(dimension, "rod", &[0.0, 0.3]), reactions(dimension, "clamp", "rod.root")].join(", ");
    let frame = frame_keys(frame);
    parse(&format!(
        r#"{{ "name": "clamped", "dimension": {dimension}, "gravity": [{gravity}],
        "ground": {{ "markers": {{ "o": [{zero}] }} }},
        "bodies": [ {{ "name": "rod", "type": "flexible_beam", {frame}, "length": 1, "elements": 2,
            "stiffness": {{ "EA": 1e4, "GA": 4e3, {gj} "EI": 100 }}, "inertia": {{ "rhoA": 3, "rhoI": 0.01 }},
            "damping": {{ "rayleigh": {{ "stiffness": 0.01 }} }},
            "markers": {{ "root": [{zero}], "tip": [{tip}] }} }} ],
        "joints": [ {{ "name": "clamp", "type": "weld", "between": ["ground.o", "rod.root"] }} ],
        "forces": [ {{ "name": "load", "type": "applied_force", "at": "rod.tip", "force": {load} }} ],
        "inputs": [ {{ "name": "u", "force": "load", "component": "y" }} ],
        "outputs": [ {outputs} ] }}"#
    ))
}

fn model(variation: &mut Variation, method: &str) -> LinearModel {
    let request = Linear { method: MethodSpec::parse(method).unwrap(), chart: Some(Chart::MassOrthogonal) };
    variation.linearize(&request).unwrap_or_else(|error| panic!("{method}: {error}"))
}

/// C (s E - A)^-1 B + D at a real s.
fn transfer(model: &LinearModel, s: f64) -> Matrix {
    let size = model.a.nrows();
    let e = model.e.clone().unwrap_or_else(|| Matrix::identity(size, size));
    &model.c * (e * s - &model.a).lu().solve(&model.b).expect("s is no eigenvalue") + &model.d
}

const METHODS: [&str; 5] = ["mcs", "rcs", "rcs:form=index2", "rcs:form=index1", "rcs:form=ggl"];

/// The root carries the reaction in every linear model too: where the beam begins to fall, and at rest, where all models
/// agree as well as the saddle-point matrix is solved.
#[test]
fn the_root_carries_the_reaction_in_linear_models() {
    for (dimension, frame) in [2, 3].into_iter().flat_map(|d| ["tangent", "chord", "absolute"].map(|frame| (d, frame)))
    {
        let ready = clamped(dimension, frame);
        let rest = at_rest(&ready, 0.0).0;
        let n = if dimension == 2 { 3 } else { 6 };
        for (q, is_rest) in [(&ready.start().q, false), (&rest, true)] {
            let mut variation = Variation::new(ready.system(), 0.0, q, &ready.start().v).unwrap();
            let all = METHODS.map(|method| transfer(&model(&mut variation, method), 7.0));
            for (method, found) in METHODS.iter().zip(&all) {
                let size = found.amax();
                let what = format!("{dimension} {frame} {method} {is_rest}");
                assert!(size > 0.1, "{what}: {found}");
                let off = (0..n).fold(0.0f64, |most, i| most.max((found[(i, 0)] + found[(2 * n + i, 0)]).abs()));
                assert!(off < 1e-9 * size, "{what}: {off:e} {found}");
                let apart = (found - &all[0]).amax() / size;
                assert!(!is_rest || apart < 1e-8, "{what}: {apart:e}");
            }
        }
    }
}
