//! Polygons that cross themselves.

use crate::math::array::Each;
/// A run of edges in a box along the axes: least and largest x and y.
#[derive(Clone, Copy)]
struct Bounds([[f64; 2]; 2]);

impl Bounds {
    fn of(a: [f64; 2], b: [f64; 2]) -> Self {
        Bounds([0, 1].each(|i| [a[i].min(b[i]), a[i].max(b[i])]))
    }

    fn with(&self, other: &Bounds) -> Self {
        Bounds([0, 1].each(|i| [self.0[i][0].min(other.0[i][0]), self.0[i][1].max(other.0[i][1])]))
    }

    fn is_apart(&self, other: &Bounds) -> bool {
        (0..2).any(|i| self.0[i][1] < other.0[i][0] || other.0[i][1] < self.0[i][0])
    }
}

/// A closed polygon with the boxes of its edges, of pairs of these, and so on: those of node i are in 2 i and 2 i + 1.
struct Outline<'c> {
    corners: &'c [[f64; 2]],
    boxes: Vec<Option<Bounds>>,
    /// Node of the first edge; a power of two.
    first: usize,
}

impl<'c> Outline<'c> {
    fn new(corners: &'c [[f64; 2]]) -> Self {
        let first = corners.len().next_power_of_two();
        let mut boxes = vec![None; 2 * first];
        for (i, corner) in corners.iter().enumerate() {
            boxes[first + i] = Some(Bounds::of(*corner, corners[(i + 1) % corners.len()]));
        }
        for node in (1..first).rev() {
            boxes[node] = match (boxes[2 * node], boxes[2 * node + 1]) {
                (Some(a), Some(b)) => Some(a.with(&b)),
                (one, other) => one.or(other),
            };
        }
        Outline { corners, boxes, first }
    }

    /// True if two edges of this node cross.
    fn crosses(&self, node: usize) -> bool {
        let [a, b] = [2 * node, 2 * node + 1];
        node < self.first && (self.crosses(a) || self.crosses(b) || self.cross(a, b))
    }

    /// True if an edge of one node crosses one of the other, of the same size. Runs whose boxes are apart do not.
    fn cross(&self, a: usize, b: usize) -> bool {
        let [Some(of_a), Some(of_b)] = [self.boxes[a], self.boxes[b]] else { return false };
        if of_a.is_apart(&of_b) {
            return false;
        }
        if a >= self.first {
            return self.edges_cross(a - self.first, b - self.first);
        }
        [2 * a, 2 * a + 1].iter().any(|a| self.cross(*a, 2 * b) || self.cross(*a, 2 * b + 1))
    }

    fn edges_cross(&self, i: usize, j: usize) -> bool {
        let is_apart = |a: usize, b: usize, c: usize, d: usize| self.side(a, b, c) * self.side(a, b, d) >= 0.0;
        !is_apart(i, i + 1, j, j + 1) && !is_apart(j, j + 1, i, i + 1)
    }

    /// Twice the area of a triangle of corners, positive if they go around it against the clock.
    fn side(&self, a: usize, b: usize, c: usize) -> f64 {
        let a = self.corners[a % self.corners.len()];
        let b = self.corners[b % self.corners.len()];
        let c = self.corners[c % self.corners.len()];
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    }
}

/// True if two edges of a closed polygon cross; those that touch do not.
pub fn crosses_itself(corners: &[[f64; 2]]) -> bool {
    !corners.is_empty() && Outline::new(corners).crosses(1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// A star of n corners that passes over `step` of them crosses itself unless the step is one.
    #[test]
    fn stars_cross_themselves_and_circles_do_not() {
        let star = |n: usize, step: usize| -> Vec<[f64; 2]> {
            (0..n).map(|i| (TAU * (i * step) as f64 / n as f64).sin_cos()).map(|(s, c)| [c, s]).collect()
        };
        assert!(crosses_itself(&star(5, 2)) && crosses_itself(&star(20_000, 3)));
        assert!(!crosses_itself(&star(3, 1)) && !crosses_itself(&star(20_000, 1)));
    }

    /// One edge of a comb of teeth reaches over its neighbour.
    #[test]
    fn one_crossing_among_many_edges_is_found() {
        let teeth = 5000;
        let mut comb: Vec<[f64; 2]> = (0..2 * teeth).map(|i| [i as f64, (i % 2) as f64]).collect();
        comb.extend([[2.0 * teeth as f64, -1.0], [0.0, -1.0]]);
        assert!(!crosses_itself(&comb));
        comb[teeth][0] += 3.5;
        assert!(crosses_itself(&comb));
    }
}
