//! Closed forms for rigid bodies and locked joints against their generic definitions, at random states.

use super::super::variation::{SeedDirection, SeededBody};
use super::super::{MechanicalSystem, Mechanism, Need, OperatingPoint, Scratch, Tangent, Terms};
use crate::body::{Dual6, Frame, Wrench};
use crate::joint::{ClosedForm, Joint, JointKernel, Lock};
use crate::math::array::from_fn;
use crate::math::{Scalar, Taylor, Time};
use crate::scene::{AnyModel, Model, Scene};
use serde_json::{Value, json};

/// Sums of a few products of numbers up to 10.
const ROUND_OFF: f64 = 1e-13;

fn numbers(count: usize) -> Vec<f64> {
    let mut random = fastrand::Rng::with_seed(7);
    (0..count).map(|_| 2.0 * random.f64() - 1.0).collect()
}

/// Joints of a kind between two bodies and between each of three and the ground.
fn scene(dimension: usize, kinds: &[(&str, Value)]) -> AnyModel {
    let at = |x: &[f64]| json!(x[..dimension]);
    let inertia = if dimension == 2 { json!(0.3) } else { json!([0.3, 0.4, 0.5, 0.02, 0.01, 0.03]) };
    let body = |name: &str, free: Value| {
        let p = at(&[0.3, -0.4, 0.7]);
        let r = at(&[-0.2, 0.5, 0.1]);
        let mut body = json!({ "name": name, "type": "rigid", "mass": 1.2, "inertia": inertia,
            "origin": at(&[0.1, 0.2, -0.3]), "markers": { "P": p, "R": r } });
        if !free.is_null() {
            body["free"] = free;
        }
        body
    };
    let guided = if dimension == 2 { json!(["x", "angle"]) } else { json!(["x", "z", "ry"]) };
    let ends = [["a.P", "b.R"], ["ground.G", "a.R"], ["b.P", "ground.G"], ["c.P", "a.P"], ["b.R", "c.R"]];
    let mut joints = Vec::new();
    for (kind, keys) in kinds {
        for (i, between) in ends.iter().enumerate() {
            let mut joint = json!({ "name": format!("{kind}{}", joints.len() + i), "type": kind, "between": between });
            keys.as_object().into_iter().flatten().for_each(|(key, value)| joint[key] = value.clone());
            joints.push(joint);
        }
    }
    let scene = json!({ "name": "random", "dimension": dimension, "gravity": vec![0.0; dimension],
        "ground": { "markers": { "G": at(&[0.4, 0.1, -0.2]) } }, "joints": joints,
        "bodies": [body("a", Value::Null), body("b", Value::Null), body("c", guided),
            { "name": "d", "type": "point_mass", "mass": 1.0 }] });
    Scene::parse(&scene.to_string(), &[]).unwrap().model
}

/// A lock without its closed forms.
struct Generic<const D: usize>(Lock<D>);

impl<const D: usize> JointKernel<D> for Generic<D> {
    fn row_names(&self) -> Vec<&'static str> {
        JointKernel::row_names(&self.0)
    }
    fn depends_on_time(&self) -> bool {
        false
    }
    fn phi<S: Scalar>(&self, frames: &[Frame<S, D>], time: Time<S>, out: &mut [S]) {
        self.0.phi(frames, time, out);
    }
}

fn agree(one: &[f64], other: &[f64], what: &str) {
    assert_eq!(one.len(), other.len());
    assert!(one.iter().any(|x| x.abs() > 0.01), "{what}: only zeros agree");
    for (i, (x, y)) in one.iter().zip(other).enumerate() {
        assert!((x - y).abs() <= ROUND_OFF * (10.0 + x.abs()), "{what}, value {i}: {x} and {y}");
    }
}

fn locked_joints<const D: usize>(closed: Model<D>, mut generic: Model<D>) {
    for joint in &mut generic.joints {
        let Some(ClosedForm::Lock(lock)) = joint.element.closed_form() else { panic!("not a lock") };
        joint.element = Box::new(Generic(lock)) as Box<dyn Joint<D>>;
    }
    let values = [closed, generic].map(|model| {
        let mechanism = Mechanism::new(model);
        let mut scratch = Scratch::default();
        let n = mechanism.dimensions();
        let all = numbers(n.q + 2 * n.v + n.lambda);
        let [q, v] = [&all[..n.q], &all[n.q..][..n.v]];
        let (vdot, lambda) = all[n.q + n.v..].split_at(n.v);
        let at = OperatingPoint { t: 0.0, q, v, vdot, lambda };
        let mut tangent = Tangent::new(&mechanism.structure().tangent);
        mechanism.tangent(at, &mut tangent, &mut scratch);
        let mut terms = Terms::new(&mechanism);
        mechanism.evaluate(0.0, q, v, Need::L, &mut terms, &mut scratch);
        let mut gdd = terms.l.clone();
        mechanism.acceleration_gradient(at, &mut gdd, &mut scratch);
        let mut k = vec![0.0; n.v * n.v];
        let places = &mechanism.structure().tangent.entries;
        places.iter().zip(&tangent.k).for_each(|(&(i, j), value)| k[i * n.v + j] += value);
        (k, terms.l, gdd)
    });
    let [(k, l, gdd), (other_k, other_l, other_gdd)] = &values;
    agree(k, other_k, "K");
    agree(l, other_l, "d(phi')/dq");
    agree(gdd, other_gdd, "d(phi'')/dq");
}

/// The numbers of a frame, or of what is on one.
fn all(numbers: impl IntoIterator<Item = Dual6>) -> Vec<f64> {
    numbers.into_iter().flat_map(|x| [x.re].into_iter().chain(x.eps)).collect()
}

fn numbers_of<const D: usize>(frame: &Frame<Taylor<Dual6>, D>) -> Vec<f64> {
    let numbers = frame.r.iter().chain(frame.axes.iter().flatten()).chain([&frame.turn]);
    all(numbers.flat_map(|x| [x.x, x.d, x.dd]))
}

fn rigid_bodies<const D: usize>(model: Model<D>) {
    let mechanism = Mechanism::new(model);
    let n = mechanism.dimensions();
    let state = numbers(n.q + 2 * n.v);
    let (q, rates) = state.split_at(n.q);
    let (v, vdot) = rates.split_at(n.v);
    let at = OperatingPoint { t: 0.0, q, v, vdot, lambda: &[] };
    let mut scratch = Scratch::default();
    let motion = mechanism.at(q, v, &mut scratch, |work, _| {
        mechanism.place(q, v, vdot, work);
        work.motion.clone()
    });
    for (body, part) in mechanism.model().bodies.iter().enumerate() {
        let solid = mechanism.solid(body, &motion).unwrap();
        let directions: Vec<usize> = (part.first_v..part.first_v + part.nv).collect();
        for along in [SeedDirection::Coordinates, SeedDirection::Velocities, SeedDirection::Accelerations] {
            let mut body = SeededBody::default();
            body.vary_state(along, part, &at, &directions);
            let mut frames = vec![Frame::world(); part.body.marker_count()];
            part.body.motion(&body.moved, &body.moved_v, Some(&body.moved_vdot), 0, &mut frames);
            for (index, frame) in frames.iter().enumerate() {
                let mut seeded = Frame::world();
                solid.seed(along, &motion[part.first_marker + index], &mut seeded);
                agree(&numbers_of(&seeded), &numbers_of(frame), &format!("{} {along:?}", part.name));
                let mut random = numbers(5 * 7).into_iter();
                let mut number =
                    || Dual6 { re: random.next().unwrap(), eps: from_fn(|_| random.next().unwrap_or(0.3)) };
                let mut wrench = Wrench { force: from_fn(|_| number()), ..Wrench::zero() };
                if part.body.oriented() {
                    wrench.torque[2] = number();
                }
                let [mut f, mut pulled] = [0; 2].map(|_| vec![Dual6::fixed(0.0); part.nv]);
                part.body.pull_back(index, &body.moved, &frame.map(|x| x.x), &wrench, &mut f);
                let is_moved = along == SeedDirection::Coordinates;
                solid.pull_back(is_moved, &seeded.r.map(|x| x.x), &wrench, &mut pulled);
                agree(&all(pulled), &all(f), &format!("{} forces", part.name));
            }
        }
    }
}

#[test]
fn locked_joints_agree_with_their_kernel() {
    let axis = json!({ "axis": [0.3, -0.8, 0.5] });
    let turned = ["revolute", "prismatic", "cylindrical", "point_on_line"].map(|kind| (kind, axis.clone()));
    let plain = ["revolute", "prismatic", "cylindrical", "point_on_line", "universal", "spherical", "planar", "weld"];
    let in_space = plain.map(|kind| (kind, Value::Null)).into_iter().chain(turned);
    for kind in in_space {
        match [(); 2].map(|()| scene(3, std::slice::from_ref(&kind))) {
            [AnyModel::Spatial(closed), AnyModel::Spatial(generic)] => locked_joints(closed, generic),
            _ => unreachable!("a scene in space"),
        }
    }
    let axis = json!({ "axis": [0.6, -0.8] });
    let slides = ["prismatic", "point_on_line"].map(|kind| (kind, axis.clone()));
    let in_plane = ["revolute", "prismatic", "point_on_line", "weld"].map(|kind| (kind, Value::Null));
    for kind in in_plane.into_iter().chain(slides) {
        match [(); 2].map(|()| scene(2, std::slice::from_ref(&kind))) {
            [AnyModel::Planar(closed), AnyModel::Planar(generic)] => locked_joints(closed, generic),
            _ => unreachable!("a scene in the plane"),
        }
    }
}

/// The places of K are those that it can have: of hinges in the plane the angles of their bodies.
#[test]
fn reactions_of_planar_hinges_change_with_angles_alone() {
    let AnyModel::Planar(model) = scene(2, &[("revolute", Value::Null)]) else { panic!("a scene in the plane") };
    let mechanism = Mechanism::new(model);
    let names = mechanism.names().v;
    let tangent = mechanism.structure().tangent;
    assert!(!tangent.entries.is_empty());
    assert!(tangent.entries.iter().all(|&(i, j)| i == j && names[i].contains("angle")), "{:?}", tangent.entries);
}

#[test]
fn rigid_bodies_move_along_their_velocities_as_over_dual_numbers() {
    for dimension in [2, 3] {
        match scene(dimension, &[]) {
            AnyModel::Planar(model) => rigid_bodies(model),
            AnyModel::Spatial(model) => rigid_bodies(model),
        }
    }
}
