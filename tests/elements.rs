//! Every kind of joint and force at random states: derivatives against differences, power, momentum, potential.
//!
//! The tables in `scenes/examples.rs` hold an example for each kind; the tests walk the registries, so that a kind
//! without one fails.

use crate::scenes::differences::{moved, slope};
use crate::scenes::examples::{BETWEEN, FORCES, JOINTS, Nature};
use holonom::prepared::AnyMechanism;
use holonom::scene::Scene;
use holonom::system::{MechanicalSystem, Mechanism, Need, Scratch, Terms};
use holonom::{force, joint, scene::AnyModel};

const PLANAR_BODIES: &str = r#"
  "dimension": 2,
  "ground": { "markers": { "p": { "position": [0.2, 0.4], "angle": 0.7 }, "r": [0.5, -0.3] } },
  "bodies": [
    { "name": "a", "type": "rigid", "mass": 1.3, "inertia": 0.4,
      "markers": { "p": { "position": [0.3, -0.2], "angle": 0.4 }, "r": [-0.1, 0.6] } },
    { "name": "b", "type": "rigid", "mass": 0.8, "inertia": 0.2, "origin": [0.1, -0.1], FREE
      "markers": { "p": { "position": [-0.4, 0.1], "angle": -0.8 }, "r": [0.2, 0.3] } } ]"#;

const SPATIAL_BODIES: &str = r#"
  "dimension": 3,
  "ground": { "markers": { "p": { "position": [0.2, 0.4, 0.1], "rotation": [0.3, -0.5, 0.2] }, "r": [0.5, -0.3, 0.2] } },
  "bodies": [
    { "name": "a", "type": "rigid", "mass": 1.3, "inertia": [0.4, 0.5, 0.6],
      "markers": { "p": { "position": [0.3, -0.2, 0.5], "z_axis": [1, 2, 3] }, "r": [-0.1, 0.6, 0.2] } },
    { "name": "b", "type": "rigid", "mass": 0.8, "inertia": [0.2, 0.3, 0.25, 0.02, -0.01, 0.03], FREE
      "markers": { "p": { "position": [-0.4, 0.1, -0.3], "rotation": [0.1, 0.9, -0.4] }, "r": [0.2, 0.3, -0.6] } } ]"#;

/// The pair of bodies with one element, `a` or the ground standing for A; `held` frees only some of b's coordinates.
fn pair(dimension: usize, element: &str, a: &str, held: bool) -> Result<AnyMechanism, String> {
    let (bodies, free) = match dimension {
        2 => (PLANAR_BODIES, r#""free": ["y", "angle"],"#),
        _ => (SPATIAL_BODIES, r#""free": ["x", "z", "ry"],"#),
    };
    let bodies = bodies.replace("FREE", if held { free } else { "" });
    let element = element.replace("A.", &format!("{a}.")).replace("B.", "b.");
    let scene = Scene::parse(&format!("{{ \"name\": \"pair\", {bodies}, {element} }}"), &[]);
    Ok(match scene.map_err(|error| error.to_string())?.model {
        AnyModel::Planar(model) => AnyMechanism::Planar(Mechanism::new(model)),
        AnyModel::Spatial(model) => AnyMechanism::Spatial(Mechanism::new(model)),
    })
}

fn as_joint(kind: &str, keys: &str) -> String {
    format!(r#""joints": [{{ "name": "joint", "type": "{kind}", {keys} }}]"#)
}

fn as_force(kind: &str, keys: &str) -> String {
    format!(r#""forces": [{{ "name": "force", "type": "{kind}", {keys} }}]"#)
}

/// A state away from all special positions: joints are not assembled here.
struct State {
    t: f64,
    q: Vec<f64>,
    v: Vec<f64>,
}

/// Numbers in (-1, 1) from a linear congruential generator (Knuth's MMIX).
fn state(system: &dyn MechanicalSystem, seed: u64) -> State {
    let mut bits = 977 * seed + 1;
    let mut random = || {
        bits = bits.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (bits >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    let n = system.dimensions();
    let mut q: Vec<f64> = (0..n.q).map(|_| random()).collect();
    system.normalize(&mut q);
    State { t: 0.5 + 0.4 * random(), q, v: (0..n.v).map(|_| random()).collect() }
}

fn terms(system: &dyn MechanicalSystem, t: f64, q: &[f64], v: &[f64]) -> Terms {
    let mut terms = Terms::new(system);
    system.evaluate(t, q, v, Need::DYNAMICS | Need::L, &mut terms, &mut Scratch::default());
    terms
}

fn potential(system: &dyn MechanicalSystem, t: f64, q: &[f64], v: &[f64]) -> f64 {
    system.energy(t, q, v, &mut Scratch::default()).expect("a mechanism has an energy").potential
}

/// Truncation H^4 f'''''/30 = 2e-15 f''''', where fifth derivatives reach 1e5 next to the axis of an angle, and
/// round-off 1e-16 f/H.
const NEAR: f64 = 1e-8;

fn close(found: &[f64], expected: &[f64], what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() < NEAR * (1.0 + a.abs()), "{what}: {found:?} against {expected:?}");
    }
}

fn unit(n: usize, i: usize) -> Vec<f64> {
    (0..n).map(|j| if i == j { 1.0 } else { 0.0 }).collect()
}

/// Column `column` of G or L: markers on one body have entries of their own at the same place.
fn column(system: &dyn MechanicalSystem, values: &[f64], column: usize) -> Vec<f64> {
    let g = system.structure().g;
    let mut dense = vec![0.0; g.rows];
    let entries = g.entries.iter().zip(values).filter(|((_, j), _)| *j == column);
    entries.for_each(|((i, _), value)| dense[*i] += value);
    dense
}

const SEEDS: u64 = 12;

#[test]
fn every_joint_has_an_example_and_the_rows_it_says() {
    joints_have_examples::<2>();
    joints_have_examples::<3>();
}

fn joints_have_examples<const D: usize>() {
    for entry in joint::registry::<D>() {
        let examples: Vec<_> = JOINTS.iter().filter(|known| known.kind == entry.name).collect();
        assert!(!examples.is_empty(), "joint type {} has no example in this test", entry.name);
        for example in examples {
            let example = if D == 2 { example.planar } else { example.spatial };
            let Some((keys, rows)) = example else {
                let error = pair(D, &as_joint(entry.name, BETWEEN), "a", false).err().expect("it makes no sense here");
                assert!(error.contains("dimension"), "{error}");
                continue;
            };
            let mechanism = pair(D, &as_joint(entry.name, keys), "a", false).unwrap();
            assert_eq!(mechanism.system().dimensions().lambda, rows, "{} in {D} dimensions", entry.name);
        }
    }
}

/// Every joint example between two free bodies, between a free body and one held to some coordinates, and against the
/// ground, at random states.
fn at_joints(check: impl Fn(&dyn MechanicalSystem, &State, &str)) {
    for example in JOINTS {
        for (dimension, keys) in [(2, example.planar), (3, example.spatial)] {
            let Some((keys, _)) = keys else { continue };
            for (a, held) in [("a", false), ("a", true), ("ground", false)] {
                // The angle of the ground is no coordinate.
                let mechanism = pair(dimension, &as_joint(example.kind, keys), a, held).unwrap();
                for seed in 0..SEEDS {
                    let what = format!("{} in {dimension} dimensions from {a}, seed {seed}", example.kind);
                    check(mechanism.system(), &state(mechanism.system(), seed), &what);
                }
            }
        }
    }
}

#[test]
fn g_is_the_slope_of_phi() {
    at_joints(|system, State { t, q, v }, what| {
        let g = terms(system, *t, q, v).g;
        for j in 0..v.len() {
            let along = unit(v.len(), j);
            let slope = slope(|s| terms(system, *t, &moved(system, q, &along, s), v).phi);
            close(&column(system, &g, j), &slope, &format!("G, {what}"));
        }
    });
}

#[test]
fn phi_dot_is_the_rate_of_phi() {
    at_joints(|system, State { t, q, v }, what| {
        let here = terms(system, *t, q, v);
        let rate = slope(|s| terms(system, t + s, &moved(system, q, v, s), v).phi);
        close(&here.phi_dot, &rate, &format!("phi', {what}"));
        let held = slope(|s| terms(system, t + s, q, v).phi);
        close(&here.phi_t, &held, &format!("phi_t, {what}"));
        let mut by_g = here.phi_t.clone();
        for (j, v) in v.iter().enumerate() {
            by_g.iter_mut().zip(column(system, &here.g, j)).for_each(|(sum, g)| *sum += g * v);
        }
        close(&here.phi_dot, &by_g, &format!("G v + phi_t, {what}"));
    });
}

#[test]
fn gamma_is_minus_the_rate_of_phi_dot_at_constant_v() {
    at_joints(|system, State { t, q, v }, what| {
        let gamma = terms(system, *t, q, v).gamma;
        let rate = slope(|s| terms(system, t + s, &moved(system, q, v, s), v).phi_dot);
        close(&gamma, &rate.iter().map(|rate| -rate).collect::<Vec<_>>(), &format!("gamma, {what}"));
    });
}

#[test]
fn l_is_the_slope_of_phi_dot() {
    at_joints(|system, State { t, q, v }, what| {
        let l = terms(system, *t, q, v).l;
        for j in 0..v.len() {
            let along = unit(v.len(), j);
            let slope = slope(|s| terms(system, *t, &moved(system, q, &along, s), v).phi_dot);
            close(&column(system, &l, j), &slope, &format!("L, {what}"));
        }
    });
}

#[test]
fn every_force_has_an_example() {
    let kinds = force::registry::<2>().into_iter().map(|entry| entry.name);
    for kind in kinds.chain(force::registry::<3>().into_iter().map(|entry| entry.name)) {
        assert!(FORCES.iter().any(|known| known.kind == kind), "force type {kind} has no example in this test");
    }
}

/// Every force example at random states, with its own part of f.
fn at_forces(check: impl Fn(&dyn MechanicalSystem, &State, &[f64], Nature, &str)) {
    for example in FORCES {
        for (dimension, keys) in [(2, example.planar), (3, example.spatial)] {
            for held in [false, true] {
                let mechanism = pair(dimension, &as_force(example.kind, keys), "a", held).unwrap();
                let bare = pair(dimension, r#""forces": []"#, "a", held).unwrap();
                for seed in 0..SEEDS {
                    let state = state(mechanism.system(), seed);
                    let all = terms(mechanism.system(), state.t, &state.q, &state.v).f;
                    let inertia = terms(bare.system(), state.t, &state.q, &state.v).f;
                    let f: Vec<f64> = all.iter().zip(inertia).map(|(all, inertia)| all - inertia).collect();
                    let what = format!("{} in {dimension} dimensions, seed {seed}, held {held}", example.kind);
                    check(mechanism.system(), &state, &f, example.nature, &what);
                }
            }
        }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The ledger's power, from wrenches and twists, is f v and what the potential gains.
#[test]
fn generalized_forces_have_the_power_of_the_wrenches() {
    at_forces(|system, State { t, q, v }, f, _, what| {
        let gain = slope(|s| vec![potential(system, t + s, &moved(system, q, v, s), v)]);
        close(&[terms(system, *t, q, v).power], &[dot(f, v) + gain[0]], &format!("power, {what}"));
    });
}

#[test]
fn forces_between_bodies_keep_momentum() {
    at_forces(|system, State { q, v, .. }, f, nature, what| {
        let free = v.len() == 6 || v.len() == 12;
        if free && matches!(nature, Nature::Conservative | Nature::Damper | Nature::Internal) {
            let powers: Vec<f64> = rigid_motions(system, q).iter().map(|motion| dot(f, motion)).collect();
            close(&powers, &vec![0.0; powers.len()], &format!("momentum, {what}"));
        }
    });
}

/// Velocities at which both bodies move as one: along the axes, and about them.
fn rigid_motions(system: &dyn MechanicalSystem, q: &[f64]) -> Vec<Vec<f64>> {
    if system.dimensions().q == system.dimensions().v {
        let about = vec![-q[1], q[0], 1.0, -q[4], q[3], 1.0];
        return vec![[unit(3, 0), unit(3, 0)].concat(), [unit(3, 1), unit(3, 1)].concat(), about];
    }
    let along = (0..3).map(|i| [unit(6, i), unit(6, i)].concat());
    let about = (0..3).map(|i| [turning(&q[..7], i), turning(&q[7..], i)].concat());
    along.chain(about).collect()
}

/// Velocities of a free spatial body that turns about a world axis: e x r, and e in the body's axes.
fn turning(q: &[f64], axis: usize) -> Vec<f64> {
    let mut v = vec![0.0; 6];
    let next = (axis + 1) % 3;
    let last = (axis + 2) % 3;
    (v[next], v[last]) = (-q[last], q[next]);
    let axes = holonom::math::rotation::axes_from_quaternion(&q[3..7]);
    (0..3).for_each(|j| v[3 + j] = axes[j][axis]);
    v
}

#[test]
fn conservative_forces_are_minus_the_slope_of_their_potential() {
    at_forces(|system, State { t, q, v }, f, nature, what| {
        if matches!(nature, Nature::Conservative | Nature::Supported) {
            let slopes = (0..v.len()).map(|j| {
                let along = unit(v.len(), j);
                -slope(|s| vec![potential(system, *t, &moved(system, q, &along, s), v)])[0]
            });
            close(f, &slopes.collect::<Vec<_>>(), &format!("potential, {what}"));
        }
    });
}

#[test]
fn dampers_only_take_energy() {
    at_forces(|system, State { t, q, v }, _, nature, what| {
        let power = terms(system, *t, q, v).power;
        match nature {
            Nature::Damper => assert!(power < 0.0, "{what}: {power}"),
            // Round-off of terms of size 10 to 100.
            Nature::Conservative | Nature::Supported => assert!(power.abs() < 1e-12, "{what}: {power}"),
            _ => {}
        }
    });
}
