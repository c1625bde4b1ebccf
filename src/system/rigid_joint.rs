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
//! | rotation in the plane | turn_B - turn_A less full turns | d | 0 |
//! | rotation in space, e of A and b of B | e . b | -d . n | (d . e) (d . b) - d^2 e . b + (w_A x d) . n |
//!
//! with u = r/abs(r) and n = e x b. RowWriter of G are the generalized forces of what a unit of lambda does to the bodies: a
//! force e or u on B at its marker and the opposite on A, at the marker of A, but of B if e moves with A; or a moment -n
//! on B and n on A.

use super::rows::JointRows;
use super::terms::Need;
use crate::body::{Frame, Freedom, MarkerId, Pose, cross, dot, in_space, sub, twist_len};
use crate::joint::{ClosedForm, Joint, Lock, within_half_turn};
use crate::math::array::{Each, from_fn};
use crate::math::kkt::Lever;
use crate::math::{Scalar, Taylor};
use crate::scene::{Connection, Model};
use std::ops::Range;
use std::sync::Arc;

/// A joint whose markers are on rigid bodies or on the ground.
pub(super) struct RigidJoint<const D: usize> {
    form: ClosedForm<D>,
    rows: Range<usize>,
    sides: [JointSide<D>; 2],
    /// Place of its blocks in G, that of A before that of B.
    first_entry: usize,
    /// True if all translations of a point are locked and nothing else, between bodies that can move all ways.
    is_point: bool,
}

/// A marker of the joint on its body.
struct JointSide<const D: usize> {
    /// Index of the body's pose; that of the ground is the last.
    body: usize,
    offset: [f64; D],
    /// Axes of the joint in those of the body.
    axes: [[f64; D]; D],
    turn: f64,
    freedom: Arc<Freedom>,
    is_moving: bool,
}

/// What joints write.
pub(super) struct JointTerms<'a> {
    pub phi: &'a mut [f64],
    pub phi_dot: &'a mut [f64],
    pub phi_t: &'a mut [f64],
    pub gamma: &'a mut [f64],
    pub g: &'a mut [f64],
}

/// A vector along the motion at v' = 0.
type Path<const D: usize> = [Taylor<f64>; D];

/// The rows of a joint at one state.
struct RowWriter<'a, const D: usize> {
    sides: &'a [JointSide<D>; 2],
    poses: [&'a Pose<D>; 2],
    /// phi, phi' and gamma; none where they are not needed.
    levels: Option<[&'a mut [f64]; 3]>,
    /// Blocks of A and B in G; none where G is not needed.
    blocks: Option<[&'a mut [f64]; 2]>,
}

impl<const D: usize> RigidJoint<D> {
    /// The joint with its places; none if it has no closed form or is on a body that is not rigid.
    pub fn new(
        model: &Model<D>,
        freedoms: &[Option<Arc<Freedom>>],
        joint: &Connection<Box<dyn Joint<D>>>,
        rows: &JointRows,
    ) -> Option<Self> {
        let form = joint.element.closed_form()?;
        let &[a, b] = joint.markers.as_slice() else { return None };
        let sides = [JointSide::new(model, freedoms, &form, a)?, JointSide::new(model, freedoms, &form, b)?];
        let is_point = match &form {
            ClosedForm::Lock(lock) => lock.translation.len() == D && lock.rotation.is_empty(),
            ClosedForm::Rod(_) => false,
        };
        let is_free = |side: &JointSide<D>| [0, twist_len(D)].contains(&side.freedom.count());
        let is_point = is_point && sides.iter().all(is_free);
        Some(RigidJoint { form, rows: rows.rows.clone(), sides, first_entry: rows.first_entry(), is_point })
    }

    /// Its first row, and its first entry of G.
    pub fn places(&self) -> (usize, usize) {
        (self.rows.start, self.first_entry)
    }

    /// Counts its places from this row and this entry on.
    pub fn count_from(&mut self, row: usize, entry: usize) {
        self.rows = self.rows.start - row..self.rows.end - row;
        self.first_entry -= entry;
    }

    /// The blocks of a point: its rows are e_i of the world.
    pub fn levers(&self) -> Vec<Lever> {
        let [a, b] = &self.sides;
        let ahead = D * a.freedom.count();
        let blocks = [(a, 0, -1.0), (b, ahead, 1.0)].into_iter();
        let moving = blocks.filter(|(side, ..)| self.is_point && side.is_moving);
        moving.map(|(_, place, sign)| Lever { first_entry: self.first_entry + place, sign }).collect()
    }

    /// Writes phi, phi' and gamma, and the entries of G, as far as needed.
    #[inline]
    pub fn evaluate(&self, poses: &[Pose<D>], need: Need, terms: &mut JointTerms) {
        let poses = [&poses[self.sides[0].body], &poses[self.sides[1].body]];
        if D == 2 && self.is_point {
            self.point_in_plane(poses[0], poses[1], need, terms)
        } else {
            self.any(poses, need, terms)
        }
    }

    #[inline(never)]
    fn any(&self, poses: [&Pose<D>; 2], need: Need, terms: &mut JointTerms) {
        let JointTerms { phi, phi_dot, gamma, g, .. } = terms;
        let [a, b] = &self.sides;
        let gap = sub(&poses[1].place(&b.offset), &poses[0].place(&a.offset));
        let sizes = [a, b].each(|side| self.rows.len() * side.freedom.count());
        let blocks = need.includes(Need::G).then(|| {
            let (first, second) = g[self.first_entry..][..sizes[0] + sizes[1]].split_at_mut(sizes[0]);
            [first, second]
        });
        let rows = self.rows.clone();
        let levels = need
            .includes(Need::CONSTRAINTS)
            .then(|| [&mut phi[rows.clone()], &mut phi_dot[rows.clone()], &mut gamma[rows]]);
        let mut rows = RowWriter { sides: &self.sides, poses, levels, blocks };
        match &self.form {
            ClosedForm::Rod(length) => rows.rod(&gap, *length),
            ClosedForm::Lock(lock) => {
                rows.translations(lock, &gap);
                rows.rotations(lock);
            }
        }
    }

    /// The rows of a point in the plane: G = [-I, (a_y, -a_x), I, (-b_y, b_x)] with the arms a and b.
    fn point_in_plane(&self, a: &Pose<D>, b: &Pose<D>, need: Need, terms: &mut JointTerms) {
        let arms = [a.carried(&self.sides[0].offset), b.carried(&self.sides[1].offset)];
        if need.includes(Need::CONSTRAINTS) {
            let row = self.rows.start;
            if let Some(phi) = terms.phi[row..].first_chunk_mut::<2>() {
                *phi = from_fn(|k| (b.r[k] + arms[1][k].x) - (a.r[k] + arms[0][k].x));
            }
            if let Some(phi_dot) = terms.phi_dot[row..].first_chunk_mut::<2>() {
                *phi_dot = from_fn(|k| (b.velocity[k] + arms[1][k].d) - (a.velocity[k] + arms[0][k].d));
            }
            if let Some(gamma) = terms.gamma[row..].first_chunk_mut::<2>() {
                *gamma = from_fn(|k| arms[0][k].dd - arms[1][k].dd);
            }
        }
        if need.includes(Need::G) {
            let on_a = self.sides[0].is_moving;
            let on_b = self.sides[1].is_moving;
            let blocks = &mut terms.g[self.first_entry..];
            if on_a {
                write_lever(-1.0, &arms[0], blocks);
            }
            if on_b {
                write_lever(1.0, &arms[1], &mut blocks[if on_a { 6 } else { 0 }..]);
            }
        }
    }
}

/// [s I | s (-a_y, a_x)]
#[inline(always)]
fn write_lever<const D: usize>(sign: f64, arm: &Path<D>, block: &mut [f64]) {
    if let Some(block) = block.first_chunk_mut::<6>() {
        *block = [sign, 0.0, -sign * arm[1].x, 0.0, sign, sign * arm[0].x];
    }
}

impl<const D: usize> JointSide<D> {
    fn new(
        model: &Model<D>,
        freedoms: &[Option<Arc<Freedom>>],
        form: &ClosedForm<D>,
        marker: MarkerId,
    ) -> Option<Self> {
        let (body, freedom, place) = match model.markers.bodies[marker] {
            None => (model.bodies.len(), Arc::default(), &model.ground[marker]),
            Some(body) => {
                let part = &model.bodies[body];
                (body, freedoms[body].clone()?, &part.body.markers()[marker - part.first_marker])
            }
        };
        let axes = match form {
            ClosedForm::Lock(lock) => from_fn(|i| lock.axis(&Frame::world().at(place), i)),
            ClosedForm::Rod(_) => place.axes,
        };
        let is_moving = freedom.count() > 0;
        Some(JointSide { body, offset: place.offset, axes, turn: place.turn, freedom, is_moving })
    }

    /// Writes a row of the block.
    #[inline(always)]
    fn write(&self, row: usize, force: &[f64; D], moment: &[f64; 3], block: &mut [f64]) {
        let width = self.freedom.count();
        self.freedom.write(force, moment, &mut block[row * width..][..width]);
    }
}

impl<const D: usize> RowWriter<'_, D> {
    fn rod(&mut self, gap: &Path<D>, length: f64) {
        let distance = dot(gap, gap).sqrt();
        let u = from_fn(|k| gap[k].x / distance.x);
        let own = [self.poses[0].own(&u), self.poses[1].own(&u)];
        self.force(0, distance - length, u, own, [0.0; D]);
    }

    #[inline]
    fn translations(&mut self, lock: &Lock<D>, gap: &Path<D>) {
        let [a, b] = self.poses;
        if lock.translation.len() == D {
            // One by one, as the compiler then knows the axis.
            self.along_world(0, gap);
            self.along_world(1, gap);
            if D == 3 {
                self.along_world(2, gap);
            }
            return;
        }
        let seen = a.seen(gap);
        let ahead = a.own(&from_fn(|k| gap[k].x));
        for (row, &i) in lock.translation.iter().enumerate() {
            let axis = self.sides[0].axes[i];
            let e = a.rotated(&axis);
            let level = (1..D).fold(seen[0] * e[0], |sum, k| sum + seen[k] * e[k]);
            self.force(row, level, e, [axis, b.own(&e)], ahead);
        }
    }

    #[inline(always)]
    fn along_world(&mut self, i: usize, gap: &Path<D>) {
        let [a, b] = self.poses;
        let e = from_fn(|k| if k == i { 1.0 } else { 0.0 });
        self.force(i, gap[i], e, [from_fn(|k| a.axes[k][i]), from_fn(|k| b.axes[k][i])], [0.0; D]);
    }

    #[inline]
    fn rotations(&mut self, lock: &Lock<D>) {
        let [a, b] = self.poses;
        let first = lock.translation.len();
        if D == 2 {
            for row in first..first + lock.rotation.len() {
                let turn = b.turn + self.sides[1].turn - (a.turn + self.sides[0].turn);
                let level = Taylor::new(within_half_turn(turn), b.spin[2] - a.spin[2], 0.0);
                self.row(row, level, &[0.0; D], &[0.0, 0.0, -1.0], &[0.0, 0.0, 1.0]);
            }
            return;
        }
        let d = sub(&b.spin, &a.spin);
        let square = dot(&d, &d);
        let turned = cross(&a.spin, &d);
        for (row, &(i, j)) in lock.rotation.iter().enumerate() {
            let e = in_space(&a.rotated(&self.sides[0].axes[i]));
            let x = in_space(&b.rotated(&self.sides[1].axes[j]));
            let cosine = dot(&e, &x);
            let n = cross(&e, &x);
            let second = dot(&d, &e) * dot(&d, &x) - square * cosine + dot(&turned, &n);
            let n_in = |pose: &Pose<D>, sign: f64| in_space(&pose.own(&from_fn(|k| sign * n[k])));
            let level = Taylor::new(cosine, -dot(&d, &n), second);
            self.row(first + row, level, &[0.0; D], &n_in(a, 1.0), &n_in(b, -1.0));
        }
    }

    /// A row with the force `e` on B, and its opposite on A at `ahead` of A's marker, with `e` and `ahead` in the axes of
    /// the bodies.
    #[inline(always)]
    fn force(&mut self, row: usize, level: Taylor<f64>, e: [f64; D], own: [[f64; D]; 2], ahead: [f64; D]) {
        let [a, b] = self.sides;
        let lever = from_fn(|k| a.offset[k] + ahead[k]);
        self.row(row, level, &e, &cross(&own[0], &lever), &cross(&b.offset, &own[1]));
    }

    /// Writes a row with the force `e` on B and its opposite on A, and the moments about their origins, in their axes.
    #[inline(always)]
    fn row(&mut self, row: usize, level: Taylor<f64>, e: &[f64; D], on_a: &[f64; 3], on_b: &[f64; 3]) {
        if let Some([phi, phi_dot, gamma]) = &mut self.levels {
            (phi[row], phi_dot[row], gamma[row]) = (level.x, level.d, -level.dd);
        }
        if let Some([a, b]) = &mut self.blocks {
            self.sides[0].write(row, &from_fn(|k| -e[k]), on_a, a);
            self.sides[1].write(row, e, on_b, b);
        }
    }
}
