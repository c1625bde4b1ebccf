//! Parts whose theory is valid up to some deformation only, and the deformation that they have.

use super::critical::{Load, loads};
use super::mechanism::Mechanism;
use crate::body::flexible::PointShape;
use crate::body::{Bent, MarkerId, dot, norm};
use crate::math::array::{Each, from_fn};
use crate::scene::{Model, Part};
use std::f64::consts::PI;

/// Part of the energy of bending that elements miss, of order 2 in their length, that a finer mesh aims at. Unit:
/// `[1]`.
const MESH_AIM: f64 = 0.02;

/// A quarter turn may be passed by so much of it. Unit: `[1]`.
const QUARTER_TURN: f64 = 0.01;

/// A line whose elements turn by less together is as good as straight. Unit: `[rad]`.
const STRAIGHT: f64 = 0.5;

/// Assumption of a part about its deformation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Theory {
    /// Displacements in a floating frame are small against the length: they enter the elastic forces linearly.
    SmallDisplacements,
    /// Bending moments in a floating frame in space are small against those at which the beam buckles sideways: the
    /// softening of lateral bending and twist together is neglected.
    SmallMoments,
    /// Axial forces in a floating frame are small against the Euler load, where their stiffening of bending is
    /// neglected.
    SmallAxialForces,
    /// The rotation of a bushing in space is small against a radian.
    SmallRotations,
    /// The ends of an element rotate relative to each other by less than pi in space, 2 pi in the plane.
    Helix {
        /// 2 or 3.
        dimension: usize,
        /// Number of elements of the beam.
        elements: usize,
    },
    /// The curvature of a beam changes little between neighbouring elements, each of which has a constant one.
    Mesh {
        /// Number of elements of the beam.
        elements: usize,
    },
}

/// A part whose theory has a limit.
#[derive(Clone, Debug, PartialEq)]
pub struct Limited {
    /// Name in the scene, such as `rod`.
    pub part: String,
    /// The assumption that limits it.
    pub theory: Theory,
}

impl Theory {
    /// The deformation up to which the theory is valid: displacement over length, load over critical load, or rad. A
    /// cantilever that bends by a tenth of its length under a load at its tip is off by 1 % of that.
    pub fn most(self) -> f64 {
        match self {
            Theory::SmallDisplacements => 0.1,
            // Part of the critical loads. Lateral stiffness falls with the square of the moment, bending stiffness with
            // the force itself: the crank of the IVP test set reaches 0.22 and is simulated without the effect.
            Theory::SmallMoments | Theory::SmallAxialForces => 0.3,
            // The sine is 4 % less than the angle.
            Theory::SmallRotations => 0.5,
            // Below the limits of 2 pi and pi, with a margin since the observed states may be some way apart.
            Theory::Helix { dimension: 2, .. } => 1.5 * PI,
            Theory::Helix { .. } => 0.75 * PI,
            // A rubber pendulum of 12 elements, off by 6 % in places, reaches 18 %.
            Theory::Mesh { .. } => 0.1,
        }
    }

    /// Number of elements needed. Helix: none rotates by more than pi/2 where one of the present elements rotates by
    /// `turn`, rad. Mesh: the error falls to the aim where it is `turn` now. Otherwise 0.
    pub fn elements_for(self, turn: f64) -> usize {
        match self {
            Theory::Helix { elements, .. } => (elements as f64 * turn / (0.5 * PI) - QUARTER_TURN).ceil() as usize,
            Theory::Mesh { elements } => (elements as f64 * (turn / MESH_AIM).sqrt()).ceil() as usize,
            _ => 0,
        }
    }
}

/// The places of a part at which its deformation is evaluated.
pub(super) enum Extent<const D: usize> {
    /// Points of a body, with its first elastic coordinate and its length, m.
    Points { first_q: usize, length: f64, points: Vec<PointShape<D>> },
    /// Section loads over critical loads, as combinations of elastic coordinates.
    Loads(Vec<Load>),
    /// Both ends of each element.
    Ends(Vec<[MarkerId; 2]>),
    /// Both ends of each element of a line of elements of equal length.
    Line(Vec<[MarkerId; 2]>),
}

/// Number of equal parts of a beam's line at whose ends the deformation is evaluated, besides at its markers.
pub(super) const POINTS: usize = 8;

/// The parts of a model whose theory has a limit, and the places at which their deformation is evaluated.
pub(super) fn limits<const D: usize>(model: &Model<D>) -> (Vec<Limited>, Vec<Extent<D>>) {
    let bodies = model.bodies.iter().flat_map(|part| {
        let moved = bending(part).map(|extent| (Theory::SmallDisplacements, extent));
        moved.into_iter().chain(loads(model, part)).map(|(theory, extent)| (part.name.clone(), theory, extent))
    });
    let helix = |elements| Theory::Helix { dimension: D, elements };
    let lines = model.beams.iter().flat_map(|beam| {
        let ends = model.forces[beam.forces()].iter().map(|element| [element.markers[0], element.markers[1]]);
        let ends: Vec<_> = ends.collect();
        let elements = ends.len();
        let name = || beam.name.clone();
        let mesh = (elements > 2).then(|| (name(), Theory::Mesh { elements }, Extent::Line(ends.clone())));
        std::iter::once((name(), helix(elements), Extent::Ends(ends))).chain(mesh)
    });
    let forces = model.given_forces().iter().filter_map(|force| {
        let theory = match force.kind {
            "beam" => helix(1),
            _ if force.element.takes_small_rotations() => Theory::SmallRotations,
            _ => return None,
        };
        Some((force.name.clone(), theory, Extent::Ends(vec![[force.markers[0], force.markers[1]]])))
    });
    bodies.chain(lines).chain(forces).map(|(part, theory, extent)| (Limited { part, theory }, extent)).unzip()
}

/// Places of a body with elastic coordinates, which are the last ones of its q.
fn bending<const D: usize>(part: &Part<D>) -> Option<Extent<D>> {
    let first_q = part.first_q + part.nq - part.facts.elastic_count;
    let mut points = part.body.shapes().to_vec();
    let mut length = part.facts.reach;
    if let Some(Bent { line, .. }) = part.body.bent() {
        length = line.length();
        let place = |k: usize| from_fn(|i| if i == 0 { length * k as f64 / POINTS as f64 } else { 0.0 });
        points.extend((0..=POINTS).map(|k| line.point(place(k))));
    }
    (!points.is_empty() && length > 0.0).then_some(Extent::Points { first_q, length, points })
}

impl<const D: usize> Mechanism<D> {
    /// Deformation of a part at q, in the unit of its limit.
    pub(super) fn deformation(&self, extent: &Extent<D>, q: &[f64]) -> f64 {
        match extent {
            Extent::Points { first_q, length, points } => points
                .iter()
                .map(|point| norm(&point.displacement(|dof| q[first_q + dof])) / length)
                .fold(0.0, f64::max),
            Extent::Loads(loads) => loads.iter().map(|load| load.at(q).abs()).fold(0.0, f64::max),
            Extent::Ends(elements) => {
                elements.iter().map(|ends| norm(&self.turn_between(*ends, q))).fold(0.0, f64::max)
            }
            Extent::Line(elements) => self.roughness(elements, q),
        }
    }

    /// int (kappa - kappa*)^2 / int kappa^2 with kappa the curvatures of the elements and kappa* linear in each and
    /// continuous: the error estimate in energy of Zienkiewicz and Zhu (Int. J. Numer. Meth. Engng. 24, 1987). Zero
    /// where the line is straight up to round-off.
    fn roughness(&self, elements: &[[MarkerId; 2]], q: &[f64]) -> f64 {
        let last = elements.len() - 1;
        let mut around = [0, 0, 1].each(|i| self.turn_between(elements[i], q));
        let mut change = 0.0;
        let mut whole = 0.0;
        let mut bend = 0.0;
        for i in 0..=last {
            let [before, here, after] = around;
            let span = if i == 0 || i == last { 1.0 } else { 2.0 };
            let jump: [f64; 3] = from_fn(|k| (after[k] - before[k]) / span);
            change += dot(&jump, &jump) / 12.0;
            whole += dot(&here, &here);
            bend += norm(&here);
            around = [here, after, if i + 2 <= last { self.turn_between(elements[i + 2], q) } else { after }];
        }
        if bend > STRAIGHT { change / whole } else { 0.0 }
    }

    /// Rotation vector of the second marker relative to the first, rad.
    fn turn_between(&self, ends: [MarkerId; 2], q: &[f64]) -> [f64; 3] {
        // The orientation does not depend on the velocities: q stands in for v.
        let [a, b] = ends.map(|marker| self.carried(marker, q, q));
        if D == 2 {
            return [0.0, 0.0, b.turn() - a.turn()];
        }
        let part = |i: usize, j: usize| dot(&a.axis(i), &b.axis(j));
        // `sine` is 2 sin(angle) times the axis; `cosine` is 2 cos(angle).
        let sine = [part(2, 1) - part(1, 2), part(0, 2) - part(2, 0), part(1, 0) - part(0, 1)];
        let size = norm(&sine);
        let cosine = part(0, 0) + part(1, 1) + part(2, 2) - 1.0;
        let angle = size.atan2(cosine);
        if size > 0.0 { sine.each(|x| x * angle / size) } else { [angle, 0.0, 0.0] }
    }
}
