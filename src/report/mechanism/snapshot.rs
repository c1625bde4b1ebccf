//! Positions of bodies, joints and forces at one time, in space for planar and spatial scenes alike.

use super::view::{along, direction, straight};
use crate::body::{Bent, Frame, Marker, Solid, Wrench, cross, dot, in_space, norm, sub, twist_len};
use crate::force::Wheel;
use crate::joint::{Axis, Joint, JointOver, MOST_ROWS, markers_per_pass};
use crate::linearize::State;
use crate::math::{Regime, Taylor, Time};
use crate::prepared::{AnyMechanism, in_either};
use crate::scene::{BeamLine, Connection, Model, ModelJoint, Part};
use crate::system::{Mechanism, Scratch};

/// A marker in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Position, m.
    pub r: [f64; 3],
    /// Unit axes.
    pub axes: [[f64; 3]; 3],
}

#[derive(Clone, Debug)]
pub struct Limb {
    pub name: String,
    /// Markers of its joints and forces, each position once.
    pub points: Vec<[f64; 3]>,
    /// The deformed line of a beam; empty for other bodies.
    pub line: Vec<[f64; 3]>,
    /// Centre of mass, with the body's axes.
    pub centre: Pose,
    /// False for point masses.
    pub oriented: bool,
    /// True if its markers move against each other.
    pub is_elastic: bool,
    /// True if it may rotate about its own axis, which its outline does not show.
    pub may_spin: bool,
}

#[derive(Clone, Debug)]
pub struct Link {
    pub name: String,
    pub kind: &'static str,
    pub ends: Vec<Pose>,
    pub carriers: Vec<Option<usize>>,
    pub axis: Option<Axis>,
    /// Derivative of the first row of a joint with respect to a rotation of each marker about its z axis.
    pub turns: Vec<f64>,
    pub wheel: Option<Wheel>,
    /// Force at its first marker, N.
    pub force: [f64; 3],
    pub torque: [f64; 3],
}

/// Properties of the whole motion that a symbol needs.
pub struct Sight {
    pub is_planar: bool,
    /// Range of a slide along its axis during the motion, m.
    pub travel: Option<(f64, f64)>,
    /// Distance of the first two markers at the start, m.
    pub length: f64,
}

#[derive(Clone, Debug)]
pub struct Snapshot {
    pub is_planar: bool,
    pub limbs: Vec<Limb>,
    pub joints: Vec<Link>,
    pub forces: Vec<Link>,
    pub markers: Vec<Pose>,
}

/// Returns the index of the axis against gravity, 0 to 2; in space without gravity the third one.
pub fn up(mechanism: &AnyMechanism) -> usize {
    match mechanism {
        AnyMechanism::Planar(_) => 1,
        AnyMechanism::Spatial(mechanism) => {
            let gravity = mechanism.model().gravity;
            let strongest = (0..3).max_by(|i, j| gravity[*i].abs().total_cmp(&gravity[*j].abs())).unwrap_or(2);
            if gravity[strongest] < 0.0 { strongest } else { 2 }
        }
    }
}

pub fn snapshot(mechanism: &AnyMechanism, state: &State) -> Snapshot {
    in_either!(mechanism, mechanism => of(mechanism, state))
}

/// Returns the shapes of each body, placed from its centre of mass.
pub fn solids(mechanism: &AnyMechanism) -> Vec<Vec<Solid>> {
    in_either!(mechanism, mechanism => mechanism.model().given_bodies().iter().map(centred).collect())
}

fn centred<const D: usize>(part: &Part<D>) -> Vec<Solid> {
    // The first marker is the origin of the body, from which shapes are placed.
    let origin = in_space(&part.body.markers()[0].offset);
    let shifted = |solid: &Solid| Solid { at: along(solid.at, origin, 1.0), ..solid.clone() };
    part.solids.iter().map(shifted).collect()
}

/// Returns the size of the force in each joint, N: of -G^T lambda at its second marker, or at its only one.
pub fn reactions(mechanism: &AnyMechanism, state: &State, lambda: &[f64]) -> Vec<f64> {
    in_either!(mechanism, mechanism => reactions_of(mechanism, state, lambda))
}

fn reactions_of<const D: usize>(mechanism: &Mechanism<D>, state: &State, lambda: &[f64]) -> Vec<f64> {
    let frames = frames(mechanism, state);
    let time = Time { t: state.t, regime: Regime::FREE.turned(mechanism.turned(&state.q)) };
    let size = |(i, joint): (usize, &ModelJoint<D>)| {
        let own: Vec<_> = joint.markers.iter().map(|marker| frames[*marker]).collect();
        let slot = own.len().min(2) - 1;
        let mut rows = [[0.0; 6]; MOST_ROWS];
        let rows = &mut rows[..joint.element.row_names().len()];
        JointOver::<f64, D>::gradient(&*joint.element, &own, time, slot / markers_per_pass(D), rows);
        let first = slot % markers_per_pass(D) * twist_len(D);
        let lambda = &lambda[mechanism.rows_of_joint(i)];
        let force = |k: usize| lambda.iter().zip(&*rows).map(|(lambda, row)| lambda * row[first + k]).sum::<f64>();
        (0..D).map(|k| force(k).powi(2)).sum::<f64>().sqrt()
    };
    mechanism.model().joints.iter().enumerate().map(size).collect()
}

/// Returns the positions of all markers.
pub fn markers(mechanism: &AnyMechanism, state: &State) -> Vec<Pose> {
    in_either!(mechanism, mechanism => frames(mechanism, state).iter().map(pose).collect())
}

fn frames<const D: usize>(mechanism: &Mechanism<D>, state: &State) -> Vec<Frame<Taylor<f64>, D>> {
    mechanism.frames(&state.q, &state.v, &mut Scratch::default())
}

fn pose<const D: usize>(frame: &Frame<Taylor<f64>, D>) -> Pose {
    let value = frame.map(|x| x.x);
    let axis = |i: usize| if i < D { in_space(&value.axes[i]) } else { [0.0, 0.0, 1.0] };
    Pose { r: in_space(&value.r), axes: [axis(0), axis(1), axis(2)] }
}

fn of<const D: usize>(mechanism: &Mechanism<D>, state: &State) -> Snapshot {
    let model = mechanism.model();
    let frames = frames(mechanism, state);
    let poses: Vec<Pose> = frames.iter().map(pose).collect();
    let used = used(model);
    let time = Time { t: Taylor::time(state.t), regime: Regime::FREE.turned(mechanism.turned(&state.q)) };
    let joints = model.joints.iter().map(|joint| {
        let own: Vec<_> = joint.markers.iter().map(|marker| frames[*marker]).collect();
        let axis = own.first().and_then(|first| joint.element.joint_axis(&first.map(|x| x.x)));
        Link { axis, turns: turns(&*joint.element, &own, time.map(|t| t.x)), ..link(model, joint, &poses) }
    });
    let forces = model.given_forces().iter().map(|force| {
        let own: Vec<_> = force.markers.iter().map(|marker| frames[*marker]).collect();
        let mut wrenches = vec![Wrench::<f64, D>::zero(); own.len()];
        force.element.act(&own, time, &mut wrenches);
        let Wrench { force: push, torque } = wrenches.first().copied().unwrap_or(Wrench::zero());
        let wheel = force.element.wheel(&own, time);
        Link { wheel, force: in_space(&push), torque, ..link(model, force, &poses) }
    });
    let joints: Vec<Link> = joints.collect();
    let limb =
        |part: &Part<D>| Limb { line: line(part, &frames[part.first_marker], &state.q), ..limb(part, &poses, &used) };
    let mut limbs: Vec<Limb> = model.given_bodies().iter().map(limb).collect();
    model.beams.iter().for_each(|beam| join(beam, &mut limbs, |body| frames[model.bodies[body].first_marker]));
    limbs.iter_mut().enumerate().for_each(|(i, limb)| limb.may_spin = D == 3 && may_spin(limb, i, &joints));
    Snapshot { is_planar: D == 2, limbs, joints, forces: forces.collect(), markers: poses }
}

fn turns<const D: usize>(joint: &dyn Joint<D>, frames: &[Frame<Taylor<f64>, D>], time: Time<f64>) -> Vec<f64> {
    let mut rows = [[0.0; 6]; MOST_ROWS];
    let rows = &mut rows[..joint.row_names().len()];
    let turn = |(i, frame): (usize, &Frame<Taylor<f64>, D>)| {
        JointOver::<f64, D>::gradient(joint, frames, time, i / markers_per_pass(D), rows);
        let row = rows.first().copied().unwrap_or_default();
        match &row[i % markers_per_pass(D) * twist_len(D)..] {
            [_, _, _, x, y, z, ..] if D == 3 => dot(&[*x, *y, *z], &pose(frame).axes[2]),
            [_, _, turn, ..] => *turn,
            _ => 0.0,
        }
    };
    frames.iter().enumerate().map(turn).collect()
}

/// Returns true for each marker that a joint or force uses.
fn used<const D: usize>(model: &Model<D>) -> Vec<bool> {
    let mut used = vec![false; model.marker_count()];
    let joints = model.joints.iter().flat_map(|joint| &joint.markers);
    let forces = model.forces.iter().flat_map(|force| &force.markers);
    joints.chain(forces).for_each(|marker| used[*marker] = true);
    used
}

fn link<E, const D: usize>(model: &Model<D>, connection: &Connection<E>, poses: &[Pose]) -> Link {
    // States that a force reads are nowhere.
    let is_placed =
        |marker: &&usize| model.markers.bodies[**marker].is_none_or(|body| body < model.given_bodies().len());
    let markers = || connection.markers.iter().filter(is_placed);
    Link {
        name: connection.name.clone(),
        kind: connection.kind,
        ends: markers().map(|marker| poses[*marker]).collect(),
        carriers: markers().map(|marker| model.markers.bodies[*marker]).collect(),
        axis: None,
        turns: Vec::new(),
        wheel: None,
        force: [0.0; 3],
        torque: [0.0; 3],
    }
}

/// True if no joint prevents the rotation of a straight body about its own line, as a hinge away from the line would.
fn may_spin(limb: &Limb, body: usize, joints: &[Link]) -> bool {
    let Some(line) = straight(&limb.points) else { return false };
    let mut own = joints.iter().filter(|joint| joint.carriers.contains(&Some(body)));
    own.all(|joint| match joint.axis {
        Some(Axis::Along(axis)) => norm(&cross(&line, &axis)) < 1e-3 * norm(&axis),
        _ => true,
    })
}

fn limb<const D: usize>(part: &Part<D>, poses: &[Pose], used: &[bool]) -> Limb {
    let own = poses[part.first_marker];
    let offset = in_space(&part.body.markers()[0].offset);
    let r = (0..3).fold(own.r, |r, i| along(r, own.axes[i], -offset[i]));
    let centre = Pose { r, axes: own.axes };
    let mut points: Vec<[f64; 3]> = Vec::new();
    for k in 0..part.body.markers().len() {
        let id = part.first_marker + k;
        // The body's own frame is drawn only if a joint or force uses it.
        if k > 0 || used[id] {
            add(&mut points, poses[id].r);
        }
    }
    let size = points.iter().map(|point| norm(&sub(point, &points[0]))).fold(0.0, f64::max);
    // A centre of mass far from the markers belongs to the outline of the body.
    if points.len() < 2 || distance(&points, r) > 0.25 * size {
        add(&mut points, r);
    }
    Limb {
        name: part.name.clone(),
        points,
        line: Vec::new(),
        centre,
        oriented: part.facts.oriented,
        is_elastic: part.facts.elastic_count > 0,
        may_spin: false,
    }
}

/// Draws the first node of an absolute beam as the whole beam, and drops the others.
fn join<const D: usize>(beam: &BeamLine, limbs: &mut [Limb], node: impl Fn(usize) -> Frame<Taylor<f64>, D> + Copy) {
    let ends = beam
        .abscissae
        .windows(2)
        .flat_map(|ends| (0..8).map(move |k| ends[0] + (ends[1] - ends[0]) * 0.125 * f64::from(k)));
    let places = ends.chain([beam.length()]);
    let line = places.map(|s| in_space(&beam.station(s, node).r)).collect();
    let points: Vec<[f64; 3]> =
        limbs[beam.bodies()].iter_mut().flat_map(|limb| std::mem::take(&mut limb.points)).collect();
    let whole = &mut limbs[beam.first_body];
    (whole.name, whole.line, whole.points) = (beam.name.clone(), line, points);
}

/// Number of pieces of the line of a beam.
const LINE_PIECES: usize = 64;

/// Returns the deformed line of a beam in a floating frame, which is its own marker.
fn line<const D: usize>(part: &Part<D>, own: &Frame<Taylor<f64>, D>, q: &[f64]) -> Vec<[f64; 3]> {
    let Some(Bent { line, first, .. }) = part.body.bent() else { return Vec::new() };
    let own = own.map(|x| x.x);
    let point = |i: usize| {
        let mut rest = [0.0; D];
        rest[0] = line.length() * i as f64 / LINE_PIECES as f64;
        let shape = line.point(rest);
        let moved = shape.displacement(|dof| q[part.first_q + first + dof]);
        let u = std::array::from_fn(|k| shape.rest[k] + moved[k]);
        in_space(&own.at(&Marker::point(u)).r)
    };
    (0..=LINE_PIECES).map(point).collect()
}

fn add(points: &mut Vec<[f64; 3]>, point: [f64; 3]) {
    if points.iter().all(|known| norm(&sub(known, &point)) > 1e-9 * (1.0 + norm(&point))) {
        points.push(point);
    }
}

/// Returns the distance of a point from the nearest line between two of the others.
fn distance(points: &[[f64; 3]], r: [f64; 3]) -> f64 {
    let to_segment = |a: [f64; 3], b: [f64; 3]| {
        let way = direction(sub(&b, &a)).unwrap_or([0.0; 3]);
        let place = dot(&way, &sub(&r, &a)).clamp(0.0, norm(&sub(&b, &a)));
        norm(&sub(&r, &along(a, way, place)))
    };
    let pairs = points.iter().flat_map(|a| points.iter().map(move |b| to_segment(*a, *b)));
    pairs.fold(f64::INFINITY, f64::min)
}
