//! A beam cut into finite elements.

use super::element::MeshElement;
use super::gauss::{gauss_legendre, on_interval};
use super::integrals::{IntegrationPoint, discs, piece};
use super::line::{Shapes, Station};
use super::profile::Profile;
use super::reference::ReferenceLine;
use super::shape::MassIntegrals;
use super::spec::{Axial, FrameConditions};
use crate::body::{cross, dot, sub};
use crate::math::array::from_fn;
use crate::tolerances;

/// Gauss points on an element of a uniform straight beam: exact for squares of cubics.
const POINTS: usize = 4;
/// Gauss points on other elements: exact for squares of cubics times a fifth power of s, and on an arc to 1e-10.
const TAPERED: usize = 6;

/// Gauss points that integrate squares of rotations, which are at most quadratic, exactly.
const TURNS: usize = 3;

/// Elements from node to node; node k has x, y, r in the plane and x, y, z, rx, ry, rz in space, an element with
/// quadratic axial displacement also x of its middle. The floating frame fixes some of these coordinates.
#[derive(Clone, Debug)]
pub struct Mesh<const D: usize> {
    /// Abscissae of the nodes, m.
    pub nodes: Vec<f64>,
    line: ReferenceLine,
    elements: Vec<MeshElement>,
    axial: Axial,
    profile: Profile,
    /// Index of each nodal coordinate among the free ones; `None` if the frame fixes it.
    free: Vec<Option<usize>>,
}

impl<const D: usize> Mesh<D> {
    const PER_NODE: usize = if D == 2 { 3 } else { 6 };

    /// Axial displacement within an element.
    pub fn axial(&self) -> Axial {
        self.axial
    }

    /// Abscissa of an element's left end, m.
    pub fn start(&self, element: usize) -> f64 {
        self.nodes[element]
    }

    /// A mesh of at least `elements` elements with nodes at both ends and at all `markers`.
    pub fn new(line: ReferenceLine, elements: usize, markers: &[f64], profile: Profile, axial: Axial) -> Self {
        let nodes = subdivide(&breaks(line.length, markers), elements);
        let elements = nodes
            .windows(2)
            .map(|ends| MeshElement::new(&line, ends[0], ends[1], &profile.at(0.5 * (ends[0] + ends[1]))))
            .collect();
        let mut mesh = Mesh { nodes, line, elements, axial, profile, free: Vec::new() };
        mesh.free = (0..mesh.total()).map(Some).collect();
        mesh
    }

    /// Fixes the coordinates that are zero in the floating frame.
    #[must_use]
    pub fn fix(mut self, conditions: FrameConditions) -> Self {
        let last = self.nodes.len() - 1;
        let fixed: Vec<usize> = match conditions {
            FrameConditions::Tangent => self.node(0).collect(),
            FrameConditions::Chord if D == 2 => vec![0, 1, self.first(last) + 1],
            FrameConditions::Chord => vec![0, 1, 2, 3, self.first(last) + 1, self.first(last) + 2],
            FrameConditions::Mean => Vec::new(),
        };
        let mut next = 0..;
        self.free = (0..self.total()).map(|i| if fixed.contains(&i) { None } else { next.next() }).collect();
        self
    }

    /// Number of elements.
    pub fn count(&self) -> usize {
        self.elements.len()
    }

    /// Number of coordinates that are not fixed.
    pub fn coordinates(&self) -> usize {
        self.free.iter().flatten().count()
    }

    fn stride(&self) -> usize {
        Self::PER_NODE + usize::from(self.axial == Axial::Quadratic)
    }

    fn total(&self) -> usize {
        (self.nodes.len() - 1) * self.stride() + Self::PER_NODE
    }

    fn first(&self, node: usize) -> usize {
        node * self.stride()
    }

    fn node(&self, node: usize) -> std::ops::Range<usize> {
        self.first(node)..self.first(node) + Self::PER_NODE
    }

    /// The free coordinates of the node nearest to `s`.
    pub fn free_at(&self, s: f64) -> Vec<usize> {
        let distance = |k: &usize| (self.nodes[*k] - s).abs();
        let nearest = (0..self.nodes.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        self.node(nearest.unwrap_or(0)).filter_map(|i| self.free[i]).collect()
    }

    /// Names of the free coordinates: `n3_y` at node 3, `m3_x` at the middle of the element before it.
    pub fn names(&self) -> Vec<String> {
        let parts: &[&str] = if D == 2 { &["x", "y", "r"] } else { &["x", "y", "z", "rx", "ry", "rz"] };
        let name = |i: usize| match (i / self.stride(), i % self.stride()) {
            (node, part) if part < parts.len() => format!("n{node}_{}", parts[part]),
            (node, _) => format!("m{}_x", node + 1),
        };
        (0..self.total()).filter(|&i| self.free[i].is_some()).map(name).collect()
    }

    /// Displacement functions of an element at `s`, with their free coordinates in increasing order.
    fn in_element(&self, element: usize, s: f64) -> Station {
        let ends = self.node(element).chain(self.node(element + 1));
        let middle = (self.axial == Axial::Quadratic).then(|| self.first(element) + Self::PER_NODE);
        let shapes = self.elements[element].shapes::<D>(&self.line.at(s).1, self.axial);
        let free = ends.chain(middle).zip(shapes).filter_map(|(i, shape)| Some((self.free[i]?, shape)));
        let mut free: Vec<_> = free.collect();
        free.sort_unstable_by_key(|(dof, _)| *dof);
        let (dofs, shapes) = free.into_iter().unzip();
        Station { dofs, shapes }
    }

    /// Free coordinates of an element, and its displacement functions at `points` Gauss points.
    pub fn samples(&self, element: usize, points: usize) -> (Vec<usize>, Vec<IntegrationPoint>) {
        self.samples_from(self.nodes[element], element, points)
    }

    /// Free coordinates of an element, and samples of its part from `start` on.
    fn samples_from(&self, start: f64, element: usize, points: usize) -> (Vec<usize>, Vec<IntegrationPoint>) {
        let rule = gauss_legendre(points);
        let sample = |(s, weight): (f64, f64)| {
            IntegrationPoint::new(&self.profile, &self.line, s, weight, self.in_element(element, s).shapes)
        };
        let ends = [start, self.nodes[element + 1]];
        (self.in_element(element, start).dofs, on_interval(&rule, ends).map(sample).collect())
    }

    /// Gauss points on an element that integrate mass and stiffness.
    pub fn points(&self) -> usize {
        if self.profile.is_uniform() && self.line.is_straight() { POINTS } else { TAPERED }
    }

    /// Rigid motions in nodal coordinates: translations, then rotations about the middle of the beam.
    pub fn rigid_motions(&self) -> Vec<Vec<f64>> {
        (0..Self::PER_NODE).map(|part| self.rigid_motion(part)).collect()
    }

    fn rigid_motion(&self, part: usize) -> Vec<f64> {
        let place = |s: f64| self.line.at(s).1;
        let middle = place(0.5 * self.line.length);
        let unit = |axis: usize| from_fn(|k| if k == axis { 1.0 } else { 0.0 });
        let displacement = |r: &[f64; 3]| {
            if part < D { unit(part) } else { cross(&unit(3 + part - Self::PER_NODE), &sub(r, &middle)) }
        };
        let mut motion = vec![0.0; self.total()];
        for (node, &s) in self.nodes.iter().enumerate() {
            let own = &mut motion[self.node(node)];
            own[..D].copy_from_slice(&displacement(&place(s))[..D]);
            own.iter_mut().skip(D).enumerate().for_each(|(k, turn)| *turn = if D + k == part { 1.0 } else { 0.0 });
        }
        for (i, element) in self.elements.iter().enumerate().filter(|_| self.axial == Axial::Quadratic) {
            let (middle, along) = element.middle();
            motion[self.first(i) + Self::PER_NODE] = dot(&along, &displacement(&middle));
        }
        motion
    }
}

impl<const D: usize> Shapes for Mesh<D> {
    fn reference(&self) -> &ReferenceLine {
        &self.line
    }

    /// At a node, the functions of the element to its left; only strains differ between the two.
    fn at(&self, s: f64) -> Station {
        let element = self.nodes.partition_point(|node| *node < s).saturating_sub(1).min(self.count() - 1);
        self.in_element(element, s)
    }

    fn breaks(&self) -> Vec<f64> {
        self.nodes.clone()
    }

    fn profile(&self) -> &Profile {
        &self.profile
    }

    /// One piece for each element.
    fn inertia<const E: usize>(&self, s: f64) -> MassIntegrals<E> {
        let mut inertia = MassIntegrals::default();
        for element in (0..self.count()).filter(|element| self.nodes[element + 1] > s) {
            let start = s.max(self.nodes[element]);
            let (dofs, samples) = self.samples_from(start, element, self.points());
            inertia.pieces.push(piece(dofs, &samples));
            let (dofs, samples) =
                self.samples_from(start, element, if self.profile.is_uniform() { TURNS } else { TAPERED });
            inertia.discs.extend(discs::<E>(&dofs, &samples));
        }
        inertia
    }
}

/// Both ends and the markers between them, in order, each place once.
fn breaks(length: f64, markers: &[f64]) -> Vec<f64> {
    let inside = |s: &&f64| **s > tolerances::SAME * length && **s < (1.0 - tolerances::SAME) * length;
    let mut places: Vec<f64> = markers.iter().filter(inside).copied().collect();
    places.extend([0.0, length]);
    places.sort_by(f64::total_cmp);
    places.dedup_by(|b, a| *b - *a < tolerances::SAME * length);
    places
}

/// One element between each two places, then further ones where the elements are longest.
fn subdivide(places: &[f64], elements: usize) -> Vec<f64> {
    let stretches: Vec<f64> = places.windows(2).map(|ends| ends[1] - ends[0]).collect();
    let mut counts = vec![1_usize; stretches.len()];
    for _ in stretches.len()..elements {
        let size = |k: usize| stretches[k] / counts[k] as f64;
        // Equal stretches differ by rounding only: the first of them is next.
        let next =
            (1..counts.len()).fold(0, |best, k| if size(k) > size(best) * (1.0 + tolerances::SAME) { k } else { best });
        counts[next] += 1;
    }
    let mut nodes = vec![0.0];
    for (ends, &count) in places.windows(2).zip(&counts) {
        let inner = (1..count).map(|i| ends[0] + (ends[1] - ends[0]) * i as f64 / count as f64);
        nodes.extend(inner);
        nodes.push(ends[1]);
    }
    nodes
}
