//! Cubics between the points of a signal, with exact bounds on their values and derivatives.

use crate::math::array::from_fn;
/// Coefficients of 1, s, s^2 and s^3, with s the distance from the point to the left.
pub type Cubic = [f64; 4];

/// The cubic over an interval of width `h` with given values and slopes at both ends.
pub fn hermite(h: f64, y0: f64, y1: f64, s0: f64, s1: f64) -> Cubic {
    let m = (y1 - y0) / h;
    let t = (s0 + s1 - 2.0 * m) / h;
    [y0, s0, (m - s0) / h - t, t / h]
}

/// The derivative of order `order`.
pub fn derived(cubic: &Cubic, order: usize) -> Cubic {
    (0..order.min(4)).fold(*cubic, |[_, b, c, d], _| [b, 2.0 * c, 3.0 * d, 0.0])
}

pub fn value(cubic: &Cubic, s: f64) -> f64 {
    let [a, b, c, d] = cubic;
    ((d * s + c) * s + b) * s + a
}

/// Least and largest value over `from..to`: at the ends, or where the derivative is zero.
pub fn bounds(cubic: &Cubic, from: f64, to: f64) -> [f64; 2] {
    let [b, c, d, _] = derived(cubic, 1);
    // b + c s + d s^2 = 0, without cancellation.
    let root = (c * c - 4.0 * b * d).max(0.0).sqrt();
    let q = -0.5 * (c + root.copysign(c));
    let inner = [q / d, b / q].into_iter().filter(|s| from < *s && *s < to);
    [from, to].into_iter().chain(inner).map(|s| value(cubic, s)).fold(NONE, |all, y| hull(all, [y, y]))
}

/// The bounds of no number.
pub const NONE: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];

pub fn hull(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0].min(b[0]), a[1].max(b[1])]
}

/// The derivatives of these orders are bounded over whole ranges of intervals.
const ORDERS: usize = 3;

/// Bounds on value, slope and curvature over ranges of intervals, by a tree of ranges twice as wide each.
#[derive(Clone, Debug, PartialEq)]
pub struct BoundsTree {
    /// Node k has the children 2k and 2k + 1; the intervals are the last half.
    nodes: Vec<[[f64; 2]; ORDERS]>,
}

impl BoundsTree {
    /// The tree of cubics with the widths of their intervals.
    pub fn new(cubics: impl ExactSizeIterator<Item = (Cubic, f64)>) -> Self {
        let n = cubics.len();
        let mut nodes = vec![[NONE; ORDERS]; n];
        nodes.extend(cubics.map(|(cubic, h)| from_fn(|k| bounds(&derived(&cubic, k), 0.0, h))));
        for k in (1..n).rev() {
            nodes[k] = from_fn(|order| hull(nodes[2 * k][order], nodes[2 * k + 1][order]));
        }
        BoundsTree { nodes }
    }

    /// Bounds on the derivative of this order over the intervals `from..to`; all numbers beyond the second.
    pub fn over(&self, order: usize, from: usize, to: usize) -> [f64; 2] {
        if order >= ORDERS {
            return [f64::NEG_INFINITY, f64::INFINITY];
        }
        let n = self.nodes.len() / 2;
        let mut left = from + n;
        let mut right = to + n;
        let mut all = NONE;
        while left < right {
            if left % 2 == 1 {
                all = hull(all, self.nodes[left][order]);
                left += 1;
            }
            if right % 2 == 1 {
                right -= 1;
                all = hull(all, self.nodes[right][order]);
            }
            (left, right) = (left / 2, right / 2);
        }
        all
    }
}
