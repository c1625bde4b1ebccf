//! Every kind of measure in the plane and in space, of every kind of joint, force and beam, at states away from all special
//! positions.

use crate::outputs_tangent::compare::check;
use crate::scenes::examples::{FORCES, JOINTS};
use holonom::prepared::AnyMechanism;
use holonom::scene::Scene;
use holonom::system::{MechanicalSystem, OperatingPoint};

const BODIES: [&str; 2] = [
    r#""dimension": 2, "gravity": [0.3, -9.81],
    "ground": { "markers": { "w": { "position": [0.2, 0.4], "angle": 0.7 } } },
    "bodies": [
      { "name": "a", "type": "rigid", "mass": 1.3, "inertia": 0.4,
        "markers": { "p": { "position": [0.3, -0.2], "angle": 0.4 }, "r": [-0.1, 0.6] } },
      { "name": "b", "type": "rigid", "mass": 0.8, "inertia": 0.2, "origin": [0.1, -0.1],
        "markers": { "p": { "position": [-0.4, 0.1], "angle": -0.8 }, "r": [0.2, 0.3] } },
      { "name": "c", "type": "rigid", "mass": 0.5, "inertia": 0.1, "free": ["y", "angle"], "markers": { "p": [0.1, 0.2] } },
      { "name": "d", "type": "point_mass", "mass": 0.5 } ]"#,
    r#""dimension": 3, "gravity": [0.3, 0.2, -9.81],
    "ground": { "markers": { "w": { "position": [0.2, 0.4, 0.1], "rotation": [0.3, -0.5, 0.2] } } },
    "bodies": [
      { "name": "a", "type": "rigid", "mass": 1.3, "inertia": [0.4, 0.5, 0.6],
        "markers": { "p": { "position": [0.3, -0.2, 0.5], "z_axis": [1, 2, 3] }, "r": [-0.1, 0.6, 0.2] } },
      { "name": "b", "type": "rigid", "mass": 0.8, "inertia": [0.2, 0.3, 0.25, 0.02, -0.01, 0.03],
        "markers": { "p": { "position": [-0.4, 0.1, -0.3], "rotation": [0.1, 0.9, -0.4] }, "r": [0.2, 0.3, -0.6] } },
      { "name": "c", "type": "rigid", "mass": 0.5, "inertia": [0.1, 0.2, 0.3], "free": ["x", "z", "ry"],
        "markers": { "p": [0.1, 0.2, 0.3] } },
      { "name": "d", "type": "point_mass", "mass": 0.5 } ]"#,
];

/// The system of a scene, not assembled.
pub fn mechanism(json: &str) -> AnyMechanism {
    let scene = Scene::parse(json, &[]).unwrap_or_else(|error| panic!("{error}\n{json}"));
    AnyMechanism::new(scene.model)
}

/// A scene of the bodies above with joints or forces, and outputs by their keys.
fn bodies(dimension: usize, elements: &str, outputs: &[String]) -> AnyMechanism {
    let named = outputs.iter().enumerate().map(|(i, keys)| format!(r#"{{ "name": "y{i}_{}", {keys} }}"#, label(keys)));
    let outputs = named.collect::<Vec<_>>().join(", ");
    mechanism(&format!(r#"{{ "name": "bodies", {}, {elements} "outputs": [ {outputs} ] }}"#, BODIES[dimension - 2]))
}

/// Keys as a name.
fn label(keys: &str) -> String {
    keys.chars().filter(|c| c.is_alphanumeric()).collect()
}

/// Numbers in (-1, 1) from a linear congruential generator (Knuth's MMIX).
pub fn random(seed: u64) -> impl FnMut() -> f64 {
    let mut bits = 977 * seed + 1;
    move || {
        bits = bits.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (bits >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// At a few states, with coordinates up to `size`.
fn at_states(system: &dyn MechanicalSystem, size: f64, near: f64, what: &str) {
    let n = system.dimensions();
    for seed in 0..4 {
        let mut random = random(seed);
        let mut some = |count: usize, size: f64| -> Vec<f64> { (0..count).map(|_| size * random()).collect() };
        let mut q = some(n.q, size);
        let v = some(n.v, 1.0);
        let lambda = some(n.lambda, 3.0);
        system.normalize(&mut q);
        let vdot = some(n.v, 2.0);
        let at = OperatingPoint { t: 0.4, q: &q, v: &v, vdot: &vdot, lambda: &lambda };
        check(system, at, near, &format!("{what}, state {seed}"));
    }
}

/// All numbers are of size one, and differences of order four agree to 1e-11.
const NEAR: f64 = 1e-10;

fn axes(dimension: usize) -> &'static [&'static str] {
    &["x", "y", "z"][..dimension]
}

#[test]
fn kinematics() {
    for dimension in [2, 3] {
        let mut outputs: Vec<String> = [
            r#""measure": "distance", "between": ["ground.w", "b.r"]"#,
            r#""measure": "distance", "between": ["a.p", "b.r"]"#,
            r#""measure": "distance_rate", "between": ["a.p", "d"]"#,
            r#""measure": "distance", "between": ["a.p", "a.r"]"#,
            r#""measure": "angle", "of": "a.p", "relative_to": "b.p""#,
            r#""measure": "angle", "of": "c.p""#,
            r#""measure": "angle", "of": "a.p", "relative_to": "ground.w""#,
            r#""measure": "expression", "value": "a.p.x'*sin(b.r.y) + t*c.p.y^2 + sqrt(1 + d.x'^2)""#,
            r#""measure": "expression", "value": "a.p.x''*b.r.y + d.y''*a.p.x'""#,
            r#""measure": "energy", "component": "kinetic""#,
            r#""measure": "energy", "component": "potential""#,
            r#""measure": "energy""#,
        ]
        .map(String::from)
        .to_vec();
        for axis in axes(dimension) {
            for to in ["ground", "ground.w", "a.r", "b.p"] {
                for measure in ["position", "velocity", "acceleration"] {
                    outputs.push(format!(
                        r#""measure": "{measure}", "of": "b.r", "relative_to": "{to}", "component": "{axis}""#
                    ));
                    outputs.push(format!(
                        r#""measure": "{measure}", "of": "d", "relative_to": "{to}", "component": "{axis}""#
                    ));
                }
                for measure in ["angular_velocity", "angular_acceleration"].into_iter().filter(|_| dimension == 3) {
                    outputs.push(format!(
                        r#""measure": "{measure}", "of": "b.p", "relative_to": "{to}", "component": "{axis}""#
                    ));
                }
            }
        }
        if dimension == 2 {
            for measure in ["angular_velocity", "angular_acceleration"] {
                outputs.push(format!(r#""measure": "{measure}", "of": "b.p", "relative_to": "a""#));
            }
        }
        at_states(
            bodies(dimension, "", &outputs).system(),
            1.0,
            NEAR,
            &format!("kinematics in {dimension} dimensions"),
        );
    }
}

#[test]
fn reactions_of_every_joint() {
    for joint in JOINTS {
        for (dimension, example) in [(2, joint.planar), (3, joint.spatial)] {
            let Some((keys, _)) = example else { continue };
            let keys = keys.replace("A.", "a.").replace("B.", "b.");
            let element = format!(r#""joints": [{{ "name": "joint", "type": "{}", {keys} }}],"#, joint.kind);
            let components: &[&str] =
                if dimension == 2 { &["x", "y", "mz"] } else { &["x", "y", "z", "mx", "my", "mz"] };
            let mut outputs = vec![r#""measure": "reaction", "of": "joint""#.to_string()];
            outputs.push(format!(r#""measure": "expression", "value": "y0_{}*a.r.x'""#, label(&outputs[0])));
            for component in components {
                for (to, on) in [("ground", "second"), ("a.p", "second"), ("c.p", "second"), ("a.p", "first")] {
                    outputs.push(format!(
                        r#""measure": "reaction", "of": "joint", "component": "{component}", "relative_to": "{to}", "on": "{on}""#
                    ));
                }
            }
            if joint.kind == "distance" {
                outputs.push(r#""measure": "reaction", "of": "joint", "component": "axial""#.to_string());
                outputs.extend(["distance", "distance_rate"].map(|m| format!(r#""measure": "{m}", "of": "joint""#)));
            }
            if joint.kind == "driver" {
                outputs.push(r#""measure": "power", "of": "joint""#.to_string());
            }
            at_states(
                bodies(dimension, &element, &outputs).system(),
                1.0,
                NEAR,
                &format!("{} in {dimension}", joint.kind),
            );
        }
    }
}

/// Angles and travels of the joints that have some, with two rates each.
#[test]
fn coordinates_of_joints() {
    for joint in JOINTS {
        for (dimension, example) in [(2, joint.planar), (3, joint.spatial)] {
            let (angles, travels): (&[&str], &[&str]) = match (joint.kind, dimension) {
                ("revolute", _) => (&[""], &[]),
                ("prismatic", _) => (&[], &[""]),
                ("cylindrical", _) | ("point_on_line", 2) => (&[""], &[""]),
                ("point_on_line", _) => (&[], &[r#", "component": "z""#]),
                ("universal", _) => (&[r#", "component": "x""#, r#", "component": "y""#], &[]),
                ("planar", _) => (&[""], &[r#", "component": "x""#, r#", "component": "y""#]),
                _ => continue,
            };
            let Some((keys, _)) = example else { continue };
            let keys = keys.replace("A.", "a.").replace("B.", "b.");
            let element = format!(r#""joints": [{{ "name": "joint", "type": "{}", {keys} }}],"#, joint.kind);
            let of = |measure: &str, component: &str| format!(r#""measure": "{measure}", "of": "joint"{component}"#);
            let turning = ["angle", "angular_velocity", "angular_acceleration"];
            let sliding = ["position", "velocity", "acceleration"];
            let turns = angles.iter().flat_map(|component| turning.map(|measure| of(measure, component)));
            let slides = travels.iter().flat_map(|component| sliding.map(|measure| of(measure, component)));
            let outputs: Vec<String> = turns.chain(slides).collect();
            at_states(bodies(dimension, &element, &outputs).system(), 1.0, NEAR, joint.kind);
        }
    }
}

#[test]
fn magnitudes_and_energies_of_every_force() {
    for force in FORCES {
        for (dimension, keys) in [(2, force.planar), (3, force.spatial)] {
            let keys = keys.replace("A.", "a.").replace("B.", "b.");
            let element = format!(r#""forces": [{{ "name": "force", "type": "{}", {keys} }}],"#, force.kind);
            let mut outputs: Vec<String> = [
                r#""measure": "force", "of": "force""#,
                r#""measure": "power", "of": "force""#,
                r#""measure": "energy", "component": "potential""#,
                r#""measure": "energy""#,
            ]
            .map(String::from)
            .to_vec();
            let [power, energy] = [1, 3].map(|i| format!("y{i}_{}", label(&outputs[i])));
            outputs.push(format!(r#""measure": "expression", "value": "{power}*sin({energy}) + b.p.y''""#));
            for component in if dimension == 2 { &["x", "mz"][..] } else { &["y", "z", "mx", "mz"] } {
                for (to, on) in [("c.p", ""), ("ground", r#", "on": "first""#)] {
                    outputs.push(format!(
                        r#""measure": "force", "of": "force", "component": "{component}", "relative_to": "{to}"{on}"#
                    ));
                }
            }
            let system = bodies(dimension, &element, &outputs);
            at_states(system.system(), 1.0, NEAR, &format!("{} {keys} in {dimension}", force.kind));
        }
    }
}

/// A beam of two elements with both ends free, and a force and a joint on it.
fn beam(dimension: usize, kind: &str, theory: &str, outputs: &str) -> String {
    let (section, zero, tip, gravity) = match dimension {
        2 => (r#""EA": 40, "EI": 3, "GA": 20"#, "0, 0", "2, 0", "0, -9.81"),
        _ => (r#""EA": 40, "EI": [2, 3], "GA": [20, 15], "GJ": 1"#, "0, 0, 0", "2, 0, 0", "0, 0, -9.81"),
    };
    format!(
        r#"{{ "name": "beam", "dimension": {dimension}, "gravity": [{gravity}],
        "ground": {{ "markers": {{ "wall": [{zero}] }} }},
        "bodies": [ {{ "name": "rod", "type": "flexible_beam", {kind}, "length": 2, "elements": 2, "theory": "{theory}",
            "stiffness": {{ {section} }}, "inertia": {{ "rhoA": 1, "rhoI": 0.1 }}, "damping": {{ "rayleigh": {{ "stiffness": 0.02 }} }},
            "markers": {{ "root": [{zero}], "tip": [{tip}] }} }} ],
        "joints": [ {{ "name": "joint", "type": "weld", "between": ["ground.wall", "rod.root"] }} ],
        "forces": [ {{ "name": "force", "type": "spring_damper", "between": ["ground.wall", "rod.tip"], "stiffness": 3 }} ],
        "outputs": [ {outputs} ] }}"#
    )
}

fn beam_outputs(dimension: usize) -> String {
    let offset = if dimension == 2 { "0.04" } else { "0.04, -0.07" };
    let mut all = vec![
        (r#""measure": "axial_force""#.to_string(), true),
        (format!(r#""measure": "strain", "offset": [{offset}]"#), true),
        (r#""measure": "force", "of": "force""#.to_string(), false),
        (r#""measure": "energy", "component": "kinetic""#.to_string(), false),
        (r#""measure": "energy", "component": "potential""#.to_string(), false),
        (r#""measure": "reaction", "of": "joint", "component": "mz", "relative_to": "rod.tip""#.to_string(), false),
        (r#""measure": "reaction", "of": "joint""#.to_string(), false),
        (r#""measure": "velocity", "of": "rod.tip", "relative_to": "rod.root""#.to_string(), false),
        (r#""measure": "angle", "of": "rod.tip", "relative_to": "rod.root""#.to_string(), false),
    ];
    for axis in axes(dimension) {
        all.push((format!(r#""measure": "deflection", "component": "{axis}""#), true));
    }
    for axis in if dimension == 2 { &["z"][..] } else { &["y", "z"] } {
        all.push((format!(r#""measure": "bending_moment", "component": "{axis}""#), true));
    }
    for axis in &axes(dimension)[1..] {
        all.push((format!(r#""measure": "shear_force", "component": "{axis}""#), true));
    }
    if dimension == 3 {
        all.push((r#""measure": "torque""#.to_string(), true));
    }
    let mut outputs = Vec::new();
    for (i, (keys, at_place)) in all.into_iter().enumerate() {
        if at_place {
            [0.0, 0.7, 1.0, 2.0].into_iter().enumerate().for_each(|(place, at)| {
                let name = format!("y{i}_{}_{place}", label(&keys));
                outputs.push(format!(r#"{{ "name": "{name}", {keys}, "of": "rod", "at": {at} }}"#));
            })
        } else {
            outputs.push(format!(r#"{{ "name": "y{i}_{}", {keys} }}"#, label(&keys)))
        }
    }
    outputs.join(", ")
}

#[test]
fn beams_of_both_kinds() {
    for dimension in [2, 3] {
        for frame in ["tangent", "chord", "mean", "absolute"] {
            for theory in ["euler_bernoulli", "timoshenko"] {
                let kind = match frame {
                    "absolute" => r#""frame": "absolute""#.to_string(),
                    _ => format!(
                        r#""frame": "floating", "frame_conditions": "{frame}", "rotary_inertia": true,
                        "geometric_stiffening": true"#
                    ),
                };
                let outputs = beam_outputs(dimension);
                let json = beam(dimension, &kind, theory, &outputs);
                // Nodes at random turn sections by more than half a turn unless they lie near each other.
                at_states(mechanism(&json).system(), 0.3, NEAR, &format!("{frame} {theory} in {dimension}"));
            }
        }
    }
}
