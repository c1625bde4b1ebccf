//! Joints between rigid bodies by closed formulas: phi, phi', gamma and G as the kernels give them, to round-off.
//!
//! With the places of the markers r_A, r_B, the arms a from the bodies' origins to them and axes e, all moving with
//! their bodies at v' = 0 (e' = w x e, e'' = w x (w x e)):
//!
//! | row | phi | force on B | moment on A | moment on B |
//! |---|---|---|---|---|
//! | all translations, world axes | e . (r_B - r_A) | e | -a_A x e | a_B x e |
//! | translation along an axis of A | e_A . (r_B - r_A) | e_A | -(a_A + r_B - r_A) x e_A | a_B x e_A |
//! | rod | abs(r_B - r_A) - l | u = (r_B - r_A)/abs(r_B - r_A) | -(a_A + r_B - r_A) x u | a_B x u |
//! | rotation in the plane | turn_B - turn_A | 0 | -1 | 1 |
//! | rotation in space | e_A . e_B | 0 | e_A x e_B | -e_A x e_B |
//!
//! The force on A is the opposite of that on B. A row of G has the generalized forces of these.

use super::rows::JointRows;
use super::{Need, Terms};
use crate::body::{Frame, Freedom, MarkerId, Pose, cross, dot, unit_axes};
use crate::joint::{ClosedForm, Joint};
use crate::math::{Scalar, Taylor};
use crate::scene::{Connection, Model};
use std::array::from_fn;

/// A joint whose markers are on rigid bodies or on the ground.
pub(super) struct RigidJoint<const D: usize> {
    form: ClosedForm<D>,
    first_row: usize,
    sides: [Side<D>; 2],
}

/// A marker of the joint on its body.
struct Side<const D: usize> {
    /// Index of the body's pose; that of the ground is the last.
    body: usize,
    offset: [f64; D],
    /// Axes of the joint in those of the body.
    axes: [[f64; D]; D],
    turn: f64,
    freedom: Freedom,
    /// Place of its block in G.
    first_entry: usize,
}

/// A vector along the motion at v' = 0.
type Path<const D: usize> = [Taylor<f64>; D];

/// The joint at one state, row by row.
struct Rows<'a, const D: usize> {
    joint: &'a RigidJoint<D>,
    poses: [&'a Pose<D>; 2],
    /// From the bodies' origins to the markers, m.
    arms: [[f64; D]; 2],
    need: Need,
    terms: &'a mut Terms,
    /// Number of rows written.
    count: usize,
}

impl<const D: usize> RigidJoint<D> {
    /// The joint with its places; none if it has no closed form or is on a body that is not rigid.
    pub fn new(model: &Model<D>, joint: &Connection<Box<dyn Joint<D>>>, rows: &JointRows) -> Option<Self> {
        let form = joint.element.closed_form()?;
        let &[a, b] = joint.markers.as_slice() else { return None };
        let side = |slot, marker| Side::new(model, &form, marker, rows.first_entry(slot).unwrap_or(0));
        Some(RigidJoint { sides: [side(0, a)?, side(1, b)?], form, first_row: rows.first })
    }

    /// Writes phi, phi', phi_t and gamma, and the entries of G, as far as needed.
    pub fn evaluate(&self, poses: &[Pose<D>], need: Need, terms: &mut Terms) {
        let [a, b] = &self.sides;
        let poses = [&poses[a.body], &poses[b.body]];
        let arms = [poses[0].carried(&a.offset), poses[1].carried(&b.offset)];
        let origins = [poses[0].origin(), poses[1].origin()];
        let gap: Path<D> = from_fn(|k| origins[1][k] + arms[1][k] - (origins[0][k] + arms[0][k]));
        let arms = arms.map(value);
        let mut rows = Rows { joint: self, poses, arms, need, terms, count: 0 };
        match &self.form {
            ClosedForm::Rod(length) => rows.rod(&gap, *length),
            ClosedForm::Lock(lock) => {
                match lock.translation.len() == D {
                    true => (0..D).for_each(|i| rows.along_world(&gap, i)),
                    false => lock.translation.iter().for_each(|&i| rows.along_axis(&gap, i)),
                }
                lock.rotation.iter().for_each(|&pair| rows.rotation(pair));
            }
        }
    }
}

impl<const D: usize> Side<D> {
    fn new(model: &Model<D>, form: &ClosedForm<D>, marker: MarkerId, first_entry: usize) -> Option<Self> {
        let (body, freedom, place) = match model.markers.bodies[marker] {
            None => (model.bodies.len(), Freedom::default(), &model.ground[marker]),
            Some(body) => {
                let part = &model.bodies[body];
                (body, part.body.freedom()?, part.body.marker(marker - part.first_marker))
            }
        };
        let axes = match form {
            ClosedForm::Lock(lock) => from_fn(|i| lock.axis(&Frame::world().at(place), i)),
            ClosedForm::Rod(_) => place.axes,
        };
        Some(Side { body, offset: place.offset, axes, turn: place.turn, freedom, first_entry })
    }
}

impl<const D: usize> Rows<'_, D> {
    fn rod(&mut self, gap: &Path<D>, length: f64) {
        let distance = dot(gap, gap).sqrt();
        self.translation(distance - length, gap.map(|x| x.x / distance.x), value(*gap));
    }

    fn along_world(&mut self, gap: &Path<D>, i: usize) {
        self.translation(gap[i], unit_axes()[i], [0.0; D]);
    }

    fn along_axis(&mut self, gap: &Path<D>, i: usize) {
        let axis = self.poses[0].carried(&self.joint.sides[0].axes[i]);
        self.translation(dot(&axis, gap), value(axis), value(*gap));
    }

    /// A row with force `e` on B, which acts on A at `ahead` of A's marker.
    #[inline]
    fn translation(&mut self, level: Taylor<f64>, e: [f64; D], ahead: [f64; D]) {
        let lever: [f64; D] = from_fn(|k| self.arms[0][k] + ahead[k]);
        let moments = [cross(&lever, &e).map(|x| -x), cross(&self.arms[1], &e)];
        self.put(level, e, moments);
    }

    fn rotation(&mut self, (i, j): (usize, usize)) {
        let [a, b] = &self.joint.sides;
        if D == 2 {
            let turn = |side: usize| self.poses[side].turn + self.joint.sides[side].turn;
            let level = Taylor::new(turn(1) - turn(0), self.poses[1].spin[2] - self.poses[0].spin[2], 0.0);
            return self.put(level, [0.0; D], [[0.0, 0.0, -1.0], [0.0, 0.0, 1.0]]);
        }
        let [x, y] = [self.poses[0].carried(&a.axes[i]), self.poses[1].carried(&b.axes[j])];
        let normal = cross(&value(x), &value(y));
        self.put(dot(&x, &y), [0.0; D], [normal, normal.map(|x| -x)]);
    }

    /// The next row, with force `e` on B and the moments on A and B about the origins of their bodies.
    #[inline]
    fn put(&mut self, level: Taylor<f64>, e: [f64; D], moments: [[f64; 3]; 2]) {
        let (count, terms) = (self.count, &mut *self.terms);
        self.count += 1;
        if self.need.includes(Need::CONSTRAINTS) {
            let row = self.joint.first_row + count;
            (terms.phi[row], terms.phi_dot[row], terms.phi_t[row], terms.gamma[row]) = (level.x, level.d, 0.0, -level.dd);
        }
        if self.need.includes(Need::G) {
            for (((side, pose), force), moment) in
                self.joint.sides.iter().zip(self.poses).zip([e.map(|x| -x), e]).zip(&moments)
            {
                let (width, forces) = (side.freedom.components.len(), side.freedom.twist_forces(pose, &force, moment));
                let entries = &mut terms.g[side.first_entry + count * width..][..width];
                entries.iter_mut().zip(&side.freedom.components).for_each(|(entry, &i)| *entry = forces[i]);
            }
        }
    }
}

fn value<const D: usize>(path: Path<D>) -> [f64; D] {
    path.map(|x| x.x)
}
