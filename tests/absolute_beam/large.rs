//! Large displacements against exact and published results.

use crate::scenes::{Ready, parse};
use crate::statics::{equilibrium, place};

/// A cantilever of length 1 with EI = 1 and tip loads (expressions of t), in the plane.
fn elastica(elements: usize, force: [&str; 2], torque: &str) -> Ready {
    parse(&format!(
        r#"{{ "name": "elastica", "dimension": 2, "ground": {{ "markers": {{ "wall": [0, 0] }} }},
        "bodies": [ {{ "name": "rod", "type": "flexible_beam", "frame": "absolute", "length": 1, "elements": {elements},
            "stiffness": {{ "EA": 1e8, "EI": 1 }}, "inertia": {{ "rhoA": 1 }}, "markers": {{ "root": [0, 0], "tip": [1, 0] }} }} ],
        "joints": [ {{ "name": "clamp", "type": "weld", "between": ["ground.wall", "rod.root"] }} ],
        "forces": [ {{ "name": "load", "type": "applied_force", "at": "rod.tip", "force": ["{}", "{}"] }},
            {{ "name": "moment", "type": "applied_torque", "at": "rod.tip", "torque": "{torque}" }} ] }}"#,
        force[0], force[1]
    ))
}

#[test]
fn probe() {
    for n in [1, 2, 4, 8, 16, 32] {
        let ready = elastica(n, ["0", "4*t"], "0");
        let q = equilibrium(&ready, 10);
        let tip = place(&ready, &q, "rod.tip");
        println!("{n} {:?}", [tip[0] - 0.671054, tip[1] - 0.6699641]);
    }
    for n in [2, 4, 8, 16, 32] {
        let bend = parse(&format!(
            r#"{{ "name": "bend", "dimension": 3, "ground": {{ "markers": {{ "wall": [0, 0, 0] }} }},
        "bodies": [ {{ "name": "rod", "type": "flexible_beam", "frame": "absolute", "length": "100*pi/4", "elements": {n}, "theory": "timoshenko",
            "material": {{ "E": 1e7, "nu": 0, "rho": 1 }}, "section": {{ "rectangle": {{ "height": 1, "width": 1 }} }}, "curvature": [0, 0, 0.01],
            "markers": {{ "root": [0, 0, 0], "tip": ["100*pi/4", 0, 0] }} }} ],
        "joints": [ {{ "name": "clamp", "type": "weld", "between": ["ground.wall", "rod.root"] }} ],
        "forces": [ {{ "name": "load", "type": "applied_force", "at": "rod.tip", "force": [0, 0, "600*t"] }} ] }}"#
        ));
        let rest = place(&bend, bend.0.start().0, "rod.tip");
        let tip = place(&bend, &equilibrium(&bend, 10), "rod.tip");
        println!("{n} {rest:?} {:?}", [0, 1, 2].map(|i| tip[i] - rest[i]));
    }
}
