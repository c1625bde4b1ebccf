//! Parts that hold up to some deformation only, and how far they are deformed.

use super::critical::{Load, loads};
use super::mechanism::Mechanism;
use crate::body::flexible::PointShape;
use crate::body::{Bent, MarkerId, dot, norm};
use crate::scene::{Model, Part};
use crate::tolerances::body as tolerances;
use std::array::from_fn;
use std::f64::consts::PI;

/// What a part assumes of its deformation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Theory {
    /// Displacements in a floating frame are small beside the length: they enter the elastic forces linearly.
    SmallDisplacements,
    /// Bending moments in a floating frame in space are small beside those at which the beam buckles sideways: how they
    /// soften lateral bending and twist together is left out.
    SmallMoments,
    /// Axial forces in a floating frame are small beside the Euler load, where nothing counts how they stiffen bending.
    SmallAxialForces,
    /// What a bushing turns by in space is small beside a radian.
    SmallRotations,
    /// The ends of an element turn against each other by less than half a turn in space, a full one in the plane.
    Helix { dimension: usize, elements: usize },
    /// The curvature of a beam changes little from element to element, each of which has one of its own.
    Mesh { elements: usize },
}

/// A part with such a theory.
#[derive(Clone, Debug, PartialEq)]
pub struct Limited {
    /// Of the scene, such as `rod`.
    pub part: String,
    pub theory: Theory,
}

impl Theory {
    /// The deformation up to which it holds: displacement by length, load by critical load, or rad. A cantilever that bends by a tenth of its
    /// length under a load at its tip is off by 1 % of that.
    pub fn most(self) -> f64 {
        match self {
            Theory::SmallDisplacements => 0.1,
            // Of the critical loads. Lateral stiffness falls with the square of the moment, bending stiffness with the force
            // itself: 0.22 is left out of the IVP test set's crank.
            Theory::SmallMoments | Theory::SmallAxialForces => 0.3,
            // Where the sine is 4 % less than the angle.
            Theory::SmallRotations => 0.5,
            // From half a turn on another turn would do as well; the states that are looked at may be a bit apart.
            Theory::Helix { dimension: 2, .. } => 1.5 * PI,
            Theory::Helix { .. } => 0.75 * PI,
            // A rubber pendulum of 12 elements, 6 % off in places, misses 18 %.
            Theory::Mesh { .. } => 0.1,
        }
    }

    /// The elements of which none turns by more than a quarter turn, where one of those that there are turns by `turn`; or with
    /// an error that is allowed, where it is `turn`.
    pub fn elements_for(self, turn: f64) -> usize {
        match self {
            Theory::Helix { elements, .. } => {
                (elements as f64 * turn / (0.5 * PI) - tolerances::QUARTER_TURN).ceil() as usize
            }
            Theory::Mesh { elements } => (elements as f64 * (turn / tolerances::MESH_AIM).sqrt()).ceil() as usize,
            _ => 0,
        }
    }
}

/// Where a part is looked at.
pub(super) enum Extent<const D: usize> {
    /// Points of a body, with its first elastic coordinate and its length, m.
    Points { first_q: usize, length: f64, points: Vec<PointShape<D>> },
    /// Loads of sections by critical ones, as combinations of elastic coordinates.
    Loads(Vec<Load>),
    /// Both ends of each element.
    Ends(Vec<[MarkerId; 2]>),
    /// The same of a line of elements of one length.
    Line(Vec<[MarkerId; 2]>),
}

/// Equal parts of the line of a beam at whose ends it is looked at, beside its markers.
pub(super) const POINTS: usize = 8;

/// The parts of a model with a limit, and where they are looked at.
pub(super) fn limits<const D: usize>(model: &Model<D>) -> (Vec<Limited>, Vec<Extent<D>>) {
    let bodies = model.bodies.iter().flat_map(|part| {
        let moved = bending(part).map(|extent| (Theory::SmallDisplacements, extent));
        moved.into_iter().chain(loads(model, part)).map(|(theory, extent)| (part.name.clone(), theory, extent))
    });
    let helix = |elements| Theory::Helix { dimension: D, elements };
    let lines = model.beams.iter().flat_map(|beam| {
        let ends = model.forces[beam.forces()].iter().map(|element| [element.markers[0], element.markers[1]]);
        let ends: Vec<_> = ends.collect();
        let (elements, name) = (ends.len(), || beam.name.clone());
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

/// Of a body with elastic coordinates, the last ones.
fn bending<const D: usize>(part: &Part<D>) -> Option<Extent<D>> {
    let first_q = part.first_q + part.nq - part.body.elastic_count();
    let mut points = part.body.shapes().to_vec();
    let mut length = part.body.reach();
    if let Some(Bent { line, .. }) = part.body.bent() {
        length = line.length();
        let place = |k: usize| from_fn(|i| if i == 0 { length * k as f64 / POINTS as f64 } else { 0.0 });
        points.extend((0..=POINTS).map(|k| line.point(place(k))));
    }
    (!points.is_empty() && length > 0.0).then_some(Extent::Points { first_q, length, points })
}

impl<const D: usize> Mechanism<D> {
    /// How far a part is deformed at q, in the unit of its limit.
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

    /// int (kappa - kappa*)^2 / int kappa^2 of the curvatures kappa of the elements and kappa*, which is linear in each and goes
    /// on from one to the next: what Zienkiewicz and Zhu (Int. J. Numer. Meth. Engng. 24, 1987) take for the error in
    /// energy. Zero where the line is as good as straight.
    fn roughness(&self, elements: &[[MarkerId; 2]], q: &[f64]) -> f64 {
        let last = elements.len() - 1;
        let mut around = [0, 0, 1].map(|i| self.turn_between(elements[i], q));
        let (mut change, mut whole, mut bend) = (0.0, 0.0, 0.0);
        for i in 0..=last {
            let [before, here, after] = around;
            let span = if i == 0 || i == last { 1.0 } else { 2.0 };
            let jump: [f64; 3] = from_fn(|k| (after[k] - before[k]) / span);
            change += dot(&jump, &jump) / 12.0;
            whole += dot(&here, &here);
            bend += norm(&here);
            around = [here, after, if i + 2 <= last { self.turn_between(elements[i + 2], q) } else { after }];
        }
        if bend > tolerances::STRAIGHT { change / whole } else { 0.0 }
    }

    /// The rotation vector of the second marker against the first.
    fn turn_between(&self, ends: [MarkerId; 2], q: &[f64]) -> [f64; 3] {
        // How they stand does not depend on how fast they move.
        let [a, b] = ends.map(|marker| self.carried(marker, q, q));
        if D == 2 {
            return [0.0, 0.0, b.turn() - a.turn()];
        }
        let part = |i: usize, j: usize| dot(&a.axis(i), &b.axis(j));
        // Twice the sine and the cosine of its angle, the first along its axis.
        let sine = [part(2, 1) - part(1, 2), part(0, 2) - part(2, 0), part(1, 0) - part(0, 1)];
        let (size, cosine) = (norm(&sine), part(0, 0) + part(1, 1) + part(2, 2) - 1.0);
        let angle = size.atan2(cosine);
        if size > 0.0 { sine.map(|x| x * angle / size) } else { [angle, 0.0, 0.0] }
    }
}
