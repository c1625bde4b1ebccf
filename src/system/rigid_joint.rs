//! Joints between rigid bodies by closed formulas: phi, phi', gamma and G as the kernels give them, to round-off.
//!
//! With the arms a from the origins of the bodies to the markers, r = r_B - r_A between the markers and d = w_B - w_A,
//! at v' = 0, where w' = 0 and a' = w x a:
//!
//! | row | phi | phi' | phi'' |
//! |---|---|---|---|
//! | all translations, e_i of the world | e . r | e . r' | e . r'' |
//! | translation along e of A | e . r | e . (r' - w_A x r) | e . (r'' - 2 w_A x r' + w_A x (w_A x r)) |
//! | rod | abs(r) - l | u . r' | (r' . r' - phi'^2)/abs(r) + u . r'' |
//! | rotation in the plane | turn_B - turn_A | d | 0 |
//! | rotation in space, e of A and b of B | e . b | -d . n | (d . e) (d . b) - d^2 e . b + (w_A x d) . n |
//!
//! with u = r/abs(r) and n = e x b. Rows of G are the generalized forces of what a unit of lambda does to the bodies: a
//! force e or u on B at its marker and the opposite on A, at its own marker for e of the world, else at that of B since
//! e moves with A and u with r; or a moment -n on B and n on A.

use super::rows::JointRows;
use super::{Need, Terms};
use crate::body::{Frame, Freedom, MarkerId, Pose, cross, dot, in_space, sub, unit_axes};
use crate::joint::{ClosedForm, Joint, Lock};
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

/// The rows of a joint at one state, written one after the other.
struct Rows<'a, const D: usize> {
    sides: &'a [Side<D>; 2],
    poses: [&'a Pose<D>; 2],
    /// From the origins of the bodies to the markers, m.
    arms: [[f64; D]; 2],
    need: Need,
    terms: &'a mut Terms,
    first: usize,
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
        let sides = &self.sides;
        let poses = [&poses[sides[0].body], &poses[sides[1].body]];
        let [a, b] = [poses[0].place(&sides[0].offset), poses[1].place(&sides[1].offset)];
        let arms = [sub(&value(&a), &poses[0].r), sub(&value(&b), &poses[1].r)];
        let mut rows = Rows { sides, poses, arms, need, terms, first: self.first_row, count: 0 };
        match &self.form {
            ClosedForm::Rod(length) => rows.rod(&sub(&b, &a), *length),
            ClosedForm::Lock(lock) => {
                rows.translations(lock, &sub(&b, &a));
                rows.rotations(lock);
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
        self.force(distance - length, &gap.map(|x| x.x / distance.x), &value(gap));
    }

    #[inline]
    fn translations(&mut self, lock: &Lock<D>, gap: &Path<D>) {
        if lock.translation.len() == D {
            return (0..D).for_each(|i| self.force(gap[i], &unit_axes()[i], &[0.0; D]));
        }
        let (seen, ahead) = (self.poses[0].seen(gap), value(gap));
        for &i in lock.translation {
            let e = self.poses[0].rotated(&self.sides[0].axes[i]);
            let level = (1..D).fold(seen[0] * e[0], |sum, k| sum + seen[k] * e[k]);
            self.force(level, &e, &ahead);
        }
    }

    #[inline]
    fn rotations(&mut self, lock: &Lock<D>) {
        let [a, b] = self.poses;
        if D == 2 {
            for _ in lock.rotation {
                let turn = b.turn + self.sides[1].turn - (a.turn + self.sides[0].turn);
                self.moment(Taylor::new(turn, b.spin[2] - a.spin[2], 0.0), [0.0, 0.0, -1.0]);
            }
            return;
        }
        let d = sub(&b.spin, &a.spin);
        let (square, turned) = (dot(&d, &d), cross(&a.spin, &d));
        for &(i, j) in lock.rotation {
            let (e, axis) = (in_space(&a.rotated(&self.sides[0].axes[i])), in_space(&b.rotated(&self.sides[1].axes[j])));
            let (cosine, n) = (dot(&e, &axis), cross(&e, &axis));
            let second = dot(&d, &e) * dot(&d, &axis) - square * cosine + dot(&turned, &n);
            self.moment(Taylor::new(cosine, -dot(&d, &n), second), n);
        }
    }

    /// A row with the force `e` on B, and its opposite on A at `ahead` of A's marker.
    #[inline]
    fn force(&mut self, level: Taylor<f64>, e: &[f64; D], ahead: &[f64; D]) {
        let lever: [f64; D] = from_fn(|k| self.arms[0][k] + ahead[k]);
        let (opposite, moments) = (e.map(|x| -x), [cross(e, &lever), cross(&self.arms[1], e)]);
        self.row(level, [&opposite, e], moments);
    }

    /// A row with the moment `n` on A, and its opposite on B.
    #[inline]
    fn moment(&mut self, level: Taylor<f64>, n: [f64; 3]) {
        self.row(level, [&[0.0; D]; 2], [n, n.map(|x| -x)]);
    }

    /// The next row, with the forces and moments about the origins of both bodies.
    #[inline]
    fn row(&mut self, level: Taylor<f64>, forces: [&[f64; D]; 2], moments: [[f64; 3]; 2]) {
        let row = self.first + self.count;
        if self.need.includes(Need::CONSTRAINTS) {
            let Terms { phi, phi_dot, phi_t, gamma, .. } = &mut *self.terms;
            (phi[row], phi_dot[row], phi_t[row], gamma[row]) = (level.x, level.d, 0.0, -level.dd);
        }
        if self.need.includes(Need::G) {
            for (i, side) in self.sides.iter().enumerate() {
                let width = side.freedom.count();
                let entries = &mut self.terms.g[side.first_entry + self.count * width..][..width];
                side.freedom.write(self.poses[i], forces[i], &moments[i], entries);
            }
        }
        self.count += 1;
    }
}

fn value<const D: usize>(path: &Path<D>) -> [f64; D] {
    path.map(|x| x.x)
}
