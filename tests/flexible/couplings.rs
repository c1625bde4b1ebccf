//! Every kind of joint and force on markers of floating beams: at their ends, along them, and off their axes.

use crate::scenes::differences::{moved, slope};
use crate::scenes::examples::{FORCES, JOINTS, Nature};
use crate::scenes::{dop853, parse, shipped};
use holonom::method_spec::MethodSpec;
use holonom::prepared::AnyMechanism;
use holonom::scene::{AnyModel, Scene};
use holonom::simulate::{Method, Span};
use holonom::system::{MechanicalSystem, Mechanism, Need, OperatingPoint, Scratch, Terms};

/// Beams of every make, in the plane and in space.
const MAKES: [&str; 6] = [
    r#""elements": 2, "geometric_stiffening": true, "theory": "timoshenko""#,
    r#""elements": 2, "frame_conditions": "chord", "axial": "quadratic", "geometric_stiffening": "cubic""#,
    r#""elements": 2, "frame_conditions": "mean", "curvature": CURVATURE, "rotary_inertia": true, "geometric_stiffening": true"#,
    r#""elements": 4, "frame_conditions": "mean", "modes": 2, "theory": "timoshenko""#,
    r#""elements": 4, "frame_conditions": "chord", "modes": 1, "damping": { "rayleigh": { "mass": 1, "stiffness": 0.01 } }"#,
    r#""ritz": { "bending": ["x^2", "x^3"], "axial": ["x"] IN_SPACE }, "geometric_stiffening": true"#,
];

/// Marker p is off the axis and turned, r along it or at an end.
fn beam(name: &str, dimension: usize, make: usize) -> String {
    let keys = MAKES[make];
    match dimension {
        2 => format!(
            r#"{{ "name": "{name}", "type": "flexible_beam", "frame": "floating", "length": 1.2, {},
            "stiffness": {{ "EA": 90, "EI": 3, "GA": 40 }}, "inertia": {{ "rhoA": 1.3, "rhoI": 0.02 }},
            "markers": {{ "p": {{ "position": [0.5, 0.1], "angle": 0.4 }}, "r": [{}, 0] }} }}"#,
            keys.replace("IN_SPACE", "").replace("CURVATURE", "0.7"),
            [1.2, 0.8][make % 2]
        ),
        _ => format!(
            r#"{{ "name": "{name}", "type": "flexible_beam", "frame": "floating", "length": 1.2, {},
            "stiffness": {{ "EA": 90, "EI": [3, 4], "GA": [40, 30], "GJ": 2 }},
            "inertia": {{ "rhoA": 1.3, "rhoI": [0.02, 0.03] }},
            "markers": {{ "p": {{ "position": [0.5, 0.1, -0.15], "rotation": [0.3, -0.5, 0.2] }}, "r": [{}, 0, 0] }} }}"#,
            keys.replace("IN_SPACE", r#", "bending_z": ["x^2"], "torsion": ["x"]"#)
                .replace("CURVATURE", "[0.3, -0.5, 0.7]"),
            [1.2, 0.8][make % 2]
        ),
    }
}

/// Beams `a` and `b`, the ground, and one element between A and B.
fn pair(dimension: usize, makes: [usize; 2], element: &str, a: &str) -> AnyMechanism {
    let bodies = [beam("a", dimension, makes[0]), beam("b", dimension, makes[1])].join(", ");
    let ground = match dimension {
        2 => r#""p": { "position": [0.2, 0.4], "angle": 0.7 }, "r": [0.5, -0.3]"#,
        _ => r#""p": { "position": [0.2, 0.4, 0.1], "rotation": [0.3, -0.5, 0.2] }, "r": [0.5, -0.3, 0.2]"#,
    };
    let element = element.replace("A.", &format!("{a}.")).replace("B.", "b.");
    let gravity = if dimension == 2 { "[1, -2]" } else { "[1, -2, 3]" };
    let text = format!(
        r#"{{ "name": "pair", "dimension": {dimension}, "gravity": {gravity}, "ground": {{ "markers": {{ {ground} }} }},
        "bodies": [ {bodies} ], {element} }}"#
    );
    match Scene::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}")).model {
        AnyModel::Planar(model) => AnyMechanism::Planar(Mechanism::new(model)),
        AnyModel::Spatial(model) => AnyMechanism::Spatial(Mechanism::new(model)),
    }
}

/// Numbers in (-1, 1) from a linear congruential generator (Knuth's MMIX).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
    fn list(&mut self, n: usize) -> Vec<f64> {
        (0..n).map(|_| self.next()).collect()
    }
}

/// Frames anywhere, elastic coordinates of up to 0.1.
fn place(system: &dyn MechanicalSystem, random: &mut Random) -> Vec<f64> {
    let is_frame = |name: &str| {
        let own = name.split('.').nth(1).unwrap();
        ["x", "y", "z", "angle", "qw", "qx", "qy", "qz"].contains(&own)
    };
    let names = system.facts().names.q.clone();
    let own = system.dimensions().q_without_turns();
    let mut q: Vec<f64> =
        names[..own].iter().map(|name| random.next() * if is_frame(name) { 1.0 } else { 0.1 }).collect();
    q.resize(names.len(), 0.0);
    system.normalize(&mut q);
    q
}

fn terms(system: &dyn MechanicalSystem, t: f64, q: &[f64], v: &[f64]) -> Terms {
    let mut terms = Terms::new(system);
    system.evaluate(t, q, v, Need::DYNAMICS, &mut terms, &mut Scratch::default());
    terms
}

/// Truncation 3e-18 of fifth derivatives: arms on sections that turn with 100 rad/s have some 1e9.
fn close(found: &[f64], expected: &[f64], what: &str) {
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() < 1e-8 * (1.0 + a.abs()), "{what}: {found:?} against {expected:?}");
    }
}

fn scale(values: &[f64], factor: f64) -> Vec<f64> {
    values.iter().map(|x| x * factor).collect()
}

/// Each kind with makes of beams in turn, from another beam and from the ground.
fn each(
    examples: impl Iterator<Item = (&'static str, [Option<&'static str>; 2])>,
    list: &str,
    mut check: impl FnMut(&AnyMechanism, &dyn Fn(&str) -> AnyMechanism, &str),
) {
    for (i, (kind, keys)) in examples.enumerate() {
        for (dimension, keys) in [2, 3].into_iter().zip(keys) {
            let Some(keys) = keys else { continue };
            for (j, a) in ["a", "ground"].into_iter().enumerate() {
                let makes = [i + j, i + j + 1 + dimension].map(|make| make % MAKES.len());
                let element = format!(r#""{list}": [{{ "name": "it", "type": "{kind}", {keys} }}]"#);
                let with = |element: &str| pair(dimension, makes, element, a);
                check(&with(&element), &with, &format!("{kind} in {dimension} dimensions from {a}, makes {makes:?}"));
            }
        }
    }
}

#[test]
fn joints_on_beams_have_true_derivatives() {
    let mut random = Random(1);
    let examples = JOINTS.iter().map(|it| (it.kind, [it.planar, it.spatial].map(|keys| keys.map(|(keys, _)| keys))));
    each(examples, "joints", |mechanism, _, what| {
        let system = mechanism.system();
        let n = system.dimensions();
        let t = 0.4;
        let q = place(system, &mut random);
        let v = random.list(n.v);
        let here = terms(system, t, &q, &v);
        let at = |s: f64| terms(system, t + s, &moved(system, &q, &v, s), &v);
        close(&slope(|s| at(s).phi), &here.phi_dot, &format!("phi' of {what}"));
        close(&scale(&slope(|s| at(s).phi_dot), -1.0), &here.gamma, &format!("gamma of {what}"));
        let frozen = |s: f64| terms(system, t, &moved(system, &q, &v, s), &v).phi;
        let mut along = vec![0.0; n.lambda];
        system.structure().g.multiply(&here.g, &v, &mut along);
        close(&slope(frozen), &along, &format!("G of {what}"));
        let vdot = random.list(n.v);
        let lambda = random.list(n.lambda);
        crate::scenes::differences::check(
            system,
            OperatingPoint { t, q: &q, v: &v, vdot: &vdot, lambda: &lambda },
            what,
        );
    });
}

#[test]
fn forces_on_beams_have_true_derivatives_and_potentials() {
    let mut random = Random(2);
    let mut conservative = 0;
    for of_nature in [true, false] {
        let chosen =
            FORCES.iter().filter(|it| of_nature == matches!(it.nature, Nature::Conservative | Nature::Supported));
        let examples = chosen.map(|it| (it.kind, [Some(it.planar), Some(it.spatial)]));
        each(examples, "forces", |mechanism, with, what| {
            let system = mechanism.system();
            let n = system.dimensions();
            let t = 0.4;
            let q = place(system, &mut random);
            let v = random.list(n.v);
            let vdot = random.list(n.v);
            let lambda = random.list(n.lambda);
            crate::scenes::differences::check(
                system,
                OperatingPoint { t, q: &q, v: &v, vdot: &vdot, lambda: &lambda },
                what,
            );
            if !of_nature {
                return;
            }
            let bare = with(r#""forces": []"#);
            let own = |q: &[f64]| -> f64 {
                let potential =
                    |system: &dyn MechanicalSystem| system.energy(t, q, &v, &mut Scratch::default()).unwrap().potential;
                potential(system) - potential(bare.system())
            };
            let f = [system, bare.system()].map(|system| terms(system, t, &q, &v).f);
            let power: f64 = (0..n.v).map(|i| (f[0][i] - f[1][i]) * v[i]).sum();
            let lost = slope(|s| vec![-own(&moved(system, &q, &v, s))]);
            close(&lost, &[power], &format!("power of {what}"));
            conservative += 1;
        });
    }
    assert!(conservative >= 20, "{conservative}");
}

/// From the far end of the chain to where the rod is held, m.
const LENGTHS: [&str; 2] = ["sqrt(0.3^2 + 1.9^2)", "sqrt(0.3^2 + 1.9^2 + 0.4^2)"];

/// Two beams, hinged to the wall and welded to each other off their axes, with a rod, a spring and a bushing to the ground;
/// phi and phi' stay at rounding where the projection is exact.
#[test]
fn constraints_on_beams_stay_closed() {
    for dimension in [2, 3] {
        let joints = match dimension {
            2 => ["revolute", "weld"],
            _ => ["universal", "weld"],
        };
        let (gravity, wall, far, root, off, stiffness) = match dimension {
            2 => ("[0, -9.81]", "0, 0", "1.5, 2", "0, 0", "0.6, 0.1", "[500, 400, 5]"),
            _ => ("[0, -9.81, 1]", "0, 0, 0", "1.5, 2, 0.3", "0, 0, 0", "0.6, 0.1, -0.1", "[500, 400, 300, 5, 6, 7]"),
        };
        let tip = if dimension == 2 { "1.2, 0" } else { "1.2, 0, 0" };
        let one = |name: &str, keys: &str, start: &str| {
            let section = match dimension {
                2 => r#""stiffness": { "EA": 2e3, "EI": 30 }, "inertia": { "rhoA": 1.3 }"#,
                _ => r#""stiffness": { "EA": 2e3, "EI": 30, "GJ": 20 }, "inertia": { "rhoA": 1.3, "rhoI": 0.02 }"#,
            };
            format!(
                r#"{{ "name": "{name}", "type": "flexible_beam", "frame": "floating", "length": 1.2, "elements": 2,
                {section}, {keys}, "initial": {{ "position": [{start}] }},
                "markers": {{ "root": [{root}], "off": [{off}], "tip": [{tip}] }} }}"#
            )
        };
        let bodies = [
            one("first", r#""geometric_stiffening": true"#, wall),
            one("second", r#""frame_conditions": "chord""#, off),
        ];
        let ready = parse(&format!(
            r#"{{ "name": "chain", "dimension": {dimension}, "gravity": {gravity},
            "ground": {{ "markers": {{ "wall": [{wall}], "far": [{far}] }} }}, "bodies": [ {} ],
            "joints": [
                {{ "name": "hinge", "type": "{}", "between": ["ground.wall", "first.root"] }},
                {{ "name": "weld", "type": "{}", "between": ["first.off", "second.root"] }},
                {{ "name": "rod", "type": "distance", "between": ["ground.far", "second.tip"], "length": "{}" }} ],
            "forces": [
                {{ "name": "spring", "type": "spring_damper", "between": ["ground.far", "first.tip"], "stiffness": 50 }},
                {{ "name": "bush", "type": "bushing", "between": ["ground.far", "second.off"], "stiffness": {stiffness} }} ] }}"#,
            bodies.join(", "),
            joints[0],
            joints[1],
            LENGTHS[dimension - 2],
        ));
        let method = Method { projection: MethodSpec::named("exact"), ..dop853(1e-9) };
        let run = ready.run(&method, Span { start: 0.0, end: 0.5, output_step: 0.05 });
        let drift = &run.record.drift;
        let energy = run.record.energy.as_ref().unwrap();
        let found = [drift.position.max, drift.velocity.max, energy.relative_max_error.unwrap()];
        println!("chain in {dimension}: {found:?}");
        // Rounding of metres and of some metres a second; energy of 500 steps at 1e-9.
        assert!(found[0] < 1e-12 && found[1] < 1e-11 && found[2] < 1e-6, "{found:?}");
    }
}

/// The shipped slider-crank closes its loop at the end of a bent and stretched rod.
#[test]
fn the_slider_crank_stays_closed() {
    let crank = shipped("flexible_slider_crank", &[]);
    let run = crank.run(&crank.0.method, crank.span());
    let drift = &run.record.drift;
    println!("crank: {:e} {:e}", drift.position.max, drift.velocity.max);
    // Lengths of 0.3 m and rates of 150 rad/s.
    assert!(drift.position.max < 1e-14 && drift.velocity.max < 1e-12, "{:e}", drift.velocity.max);
}
