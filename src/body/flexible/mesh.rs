//! A beam cut into finite elements.

use super::element::Element;
use super::gauss::{gauss_legendre, on_interval};
use super::integrals::{Sample, discs, piece};
use super::line::{Shapes, Station};
use super::profile::Profile;
use super::shape::Inertia;
use super::spec::{Axial, FrameConditions};

/// Gauss points on an element that integrate squares of cubics exactly ...
const POINTS: usize = 4;
/// ... and those that do so with a mass or a stiffness up to the fifth power of s.
const TAPERED: usize = 6;

/// Gauss points that integrate squares of turns exactly, quadratics at most.
const TURNS: usize = 3;

/// So close together, in lengths of the beam, two markers share a node.
const SAME: f64 = 1e-9;

/// Elements from node to node; node k has x, y, r in the plane and x, y, z, rx, ry, rz in space, an element with quadratic
/// axial displacement x of its middle too. Some of these coordinates the floating frame fixes.
#[derive(Clone, Debug)]
pub struct Mesh<const D: usize> {
    /// Abscissae of the nodes, m.
    pub nodes: Vec<f64>,
    elements: Vec<Element>,
    axial: Axial,
    profile: Profile,
    /// Coordinates by their number among those of all nodes; `None` where the frame fixes them.
    free: Vec<Option<usize>>,
}

impl<const D: usize> Mesh<D> {
    const PER_NODE: usize = if D == 2 { 3 } else { 6 };

    /// Axial displacement within an element.
    pub fn axial(&self) -> Axial {
        self.axial
    }

    /// Where an element begins, m.
    pub fn start(&self, element: usize) -> f64 {
        self.nodes[element]
    }

    /// At least `elements` elements with nodes at both ends and all `markers`.
    pub fn new(length: f64, elements: usize, markers: &[f64], profile: Profile, axial: Axial) -> Self {
        let nodes = subdivide(&breaks(length, markers), elements);
        let elements = nodes
            .windows(2)
            .map(|ends| Element::new(ends[1] - ends[0], &profile.at(0.5 * (ends[0] + ends[1]))))
            .collect();
        let mut mesh = Mesh { nodes, elements, axial, profile, free: Vec::new() };
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

    /// Free coordinates of an element in increasing order, and what they do at `xi` of it.
    fn in_element(&self, element: usize, xi: f64) -> Station {
        let ends = self.node(element).chain(self.node(element + 1));
        let middle = (self.axial == Axial::Quadratic).then(|| self.first(element) + Self::PER_NODE);
        let shapes = self.elements[element].shapes::<D>(xi, self.axial);
        let free = ends.chain(middle).zip(shapes).filter_map(|(i, shape)| Some((self.free[i]?, shape)));
        let mut free: Vec<_> = free.collect();
        free.sort_unstable_by_key(|(dof, _)| *dof);
        let (dofs, shapes) = free.into_iter().unzip();
        Station { dofs, shapes }
    }

    /// Free coordinates of an element with `points` samples of it.
    pub fn samples(&self, element: usize, points: usize) -> (Vec<usize>, Vec<Sample>) {
        self.samples_from(self.nodes[element], element, points)
    }

    /// The same of the part of an element from `start` on.
    fn samples_from(&self, start: f64, element: usize, points: usize) -> (Vec<usize>, Vec<Sample>) {
        let [from, to] = [self.nodes[element], self.nodes[element + 1]];
        let rule = gauss_legendre(points);
        let sample = |at: (f64, f64)| {
            Sample::new(&self.profile, at, self.in_element(element, (at.0 - from) / (to - from)).shapes)
        };
        (self.in_element(element, 0.5).dofs, on_interval(&rule, [start, to]).map(sample).collect())
    }

    /// Gauss points on an element that integrate mass and stiffness.
    pub fn points(&self) -> usize {
        if self.profile.is_uniform() { POINTS } else { TAPERED }
    }

    /// Motions of all nodes that deform nothing: translations, then rotations, those about y and z with the centre
    /// `about`.
    pub fn rigid_motions(&self, about: f64) -> Vec<Vec<f64>> {
        let mut motions = vec![vec![0.0; self.total()]; Self::PER_NODE];
        for (k, s) in self.nodes.iter().enumerate() {
            let at = self.first(k);
            for (part, motion) in motions.iter_mut().enumerate() {
                motion[at + part] = 1.0;
            }
            let arm = s - about;
            if D == 2 {
                motions[2][at + 1] = arm;
            } else {
                motions[4][at + 2] = -arm;
                motions[5][at + 1] = arm;
            }
            if self.axial == Axial::Quadratic && k + 1 < self.nodes.len() {
                motions[0][at + Self::PER_NODE] = 1.0;
            }
        }
        motions
    }
}

impl<const D: usize> Shapes for Mesh<D> {
    fn length(&self) -> f64 {
        self.nodes.last().copied().unwrap_or(0.0)
    }

    /// At a node the element before it counts: only strains differ between the two.
    fn at(&self, s: f64) -> Station {
        let element = self.nodes.partition_point(|node| *node < s).saturating_sub(1).min(self.count() - 1);
        let [from, to] = [self.nodes[element], self.nodes[element + 1]];
        self.in_element(element, ((s - from) / (to - from)).clamp(0.0, 1.0))
    }

    fn breaks(&self) -> Vec<f64> {
        self.nodes.clone()
    }

    fn density(&self, s: f64) -> f64 {
        self.profile.at(s).rho_a
    }

    /// An element a piece.
    fn inertia<const E: usize>(&self, s: f64) -> Inertia<E> {
        let mut inertia = Inertia::default();
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
    let inside = |s: &&f64| **s > SAME * length && **s < (1.0 - SAME) * length;
    let mut places: Vec<f64> = markers.iter().filter(inside).copied().collect();
    places.extend([0.0, length]);
    places.sort_by(f64::total_cmp);
    places.dedup_by(|b, a| *b - *a < SAME * length);
    places
}

/// One element between each two places, then further ones where elements are longest.
fn subdivide(places: &[f64], elements: usize) -> Vec<f64> {
    let stretches: Vec<f64> = places.windows(2).map(|ends| ends[1] - ends[0]).collect();
    let mut counts = vec![1_usize; stretches.len()];
    for _ in stretches.len()..elements {
        let size = |k: usize| stretches[k] / counts[k] as f64;
        // Equal stretches differ by rounding only: the first of them is next.
        let next = (1..counts.len()).fold(0, |best, k| if size(k) > size(best) * (1.0 + SAME) { k } else { best });
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
