//! The deformation of parts whose theory is valid up to some deformation only.

use super::critical::{Load, POINTS, loads};
use super::theory::{Limited, Theory};
use super::turnings::carried;
use crate::body::flexible::PointShape;
use crate::body::{Bent, MarkerId, dot, norm};
use crate::math::array::{Each, from_fn};
use crate::scene::{Model, Part};

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

/// The parts of a model whose theory has a limit, and the places at which their deformation is evaluated.
pub(super) fn limits<const D: usize>(model: &Model<D>) -> (Vec<Limited>, Vec<Extent<D>>) {
    let bodies = model.bodies.iter().flat_map(|part| {
        let moved = bending(part).map(|extent| (Theory::SmallDisplacements, extent));
        let buckled = loads(model, part).into_iter().map(|(theory, loads)| (theory, Extent::Loads(loads)));
        moved.into_iter().chain(buckled).map(|(theory, extent)| (part.name.clone(), theory, extent))
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

impl<const D: usize> Extent<D> {
    /// Deformation of the part at q, in the unit of its limit.
    pub fn deformation(&self, model: &Model<D>, q: &[f64]) -> f64 {
        match self {
            Extent::Points { first_q, length, points } => points
                .iter()
                .map(|point| norm(&point.displacement(|dof| q[first_q + dof])) / length)
                .fold(0.0, f64::max),
            Extent::Loads(loads) => loads.iter().map(|load| load.at(q).abs()).fold(0.0, f64::max),
            Extent::Ends(elements) => {
                elements.iter().map(|ends| norm(&turn_between(model, *ends, q))).fold(0.0, f64::max)
            }
            Extent::Line(elements) => roughness(model, elements, q),
        }
    }
}

/// int (kappa - kappa*)^2 / int kappa^2 with kappa the curvatures of the elements and kappa* linear in each and
/// continuous: the error estimate in energy of Zienkiewicz and Zhu (Int. J. Numer. Meth. Engng. 24, 1987). Zero
/// where the line is straight up to round-off.
fn roughness<const D: usize>(model: &Model<D>, elements: &[[MarkerId; 2]], q: &[f64]) -> f64 {
    let last = elements.len() - 1;
    let mut around = [0, 0, 1].each(|i| turn_between(model, elements[i], q));
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
        around = [here, after, if i + 2 <= last { turn_between(model, elements[i + 2], q) } else { after }];
    }
    // A line that bends by less is as good as straight.
    if bend > 0.5 { change / whole } else { 0.0 }
}

/// Rotation vector of the second marker relative to the first, rad.
fn turn_between<const D: usize>(model: &Model<D>, ends: [MarkerId; 2], q: &[f64]) -> [f64; 3] {
    // The orientation does not depend on the velocities: q stands in for v.
    let [a, b] = ends.map(|marker| carried(model, marker, q, q));
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
