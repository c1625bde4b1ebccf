//! Shape functions of a straight beam element between two sections of the reference line.
//!
//! Its axis x is parallel to the chord, at the mean distance of the line from it, and rigid arms join it to the nodes;
//! y is that of the section in its middle. The line itself, where the mass is, is off the axis and rotates with the
//! sections of the element. Strains are per length of the line. On an arc rigid motions are exact, bending in its plane
//! is of fourth order in the length of the element, and bending out of it, which is coupled to torsion, of second
//! order.

use super::line::{Bending, Cross};
use super::reference::ReferenceLine;
use super::section::Section;
use super::spec::Axial;
use crate::body::{cross, dot, norm, scale, sub};
use crate::math::array::{Each, from_fn};

/// One element, with the shear parameters of its bending along y and z.
#[derive(Clone, Copy, Debug)]
pub struct MeshElement {
    /// Left end of its axis, m; `axes` are the element's own. Both are in the axes of the floating frame.
    start: [f64; 3],
    axes: [[f64; 3]; 3],
    /// Vector from a node to the end of its axis, in its own axes, m.
    arm: [f64; 3],
    /// Length of the axis, m.
    length: f64,
    /// Ratio of `length` to the length of the line between its ends.
    shortness: f64,
    /// 12 EI/(GA length^2) of bending along y and z: zero without shear.
    shear: [f64; 2],
}

impl MeshElement {
    /// The element between two abscissae; the line must rotate by less than half a turn between them.
    pub fn new(line: &ReferenceLine, from: f64, to: f64, section: &Section) -> Self {
        let start = line.at(from).1;
        let end = line.at(to).1;
        let ([_, side, _], middle) = line.at(0.5 * (from + to));
        let chord = sub(&end, &start);
        let length = norm(&chord);
        let x = chord.each(|c| c / length);
        let y = sub(&side, &scale(&x, dot(&x, &side)));
        let y = y.each(|c| c / norm(&y));
        let axes = [x, y, cross(&x, &y)];
        // The mean of an arc is two thirds of its sagitta, up to the fourth power of its length.
        let sagitta: [f64; 3] = from_fn(|k| middle[k] - 0.5 * (start[k] + end[k]));
        let arm = [0.0, dot(&y, &sagitta), dot(&axes[2], &sagitta)].each(|part| part * 2.0 / 3.0);
        let start = from_fn(|k| start[k] + arm[1] * y[k] + arm[2] * axes[2][k]);
        let ratio = |ei: f64, ga: f64| 12.0 * ei / (ga * length * length);
        let shear = [ratio(section.ei[1], section.ga[0]), ratio(section.ei[0], section.ga[1])];
        MeshElement { start, axes, arm, length, shortness: length / (to - from), shear }
    }

    /// Displacement functions, at point r of the line, of the coordinates of both nodes and of the middle: x, y, r of
    /// each node in the plane; x, y, z, rx, ry, rz in space, along the axes of the floating frame; the middle one along
    /// the element.
    pub fn shapes<const D: usize>(&self, r: &[f64; 3], axial: Axial) -> Vec<Cross> {
        let beside = sub(r, &self.start);
        let [x, y, z] = self.axes.each(|axis| dot(&axis, &beside));
        let mut own = self.own_shapes::<D>((x / self.length).clamp(0.0, 1.0), axial);
        self.add_arms::<D>(&mut own);
        own.iter_mut().for_each(|shape| self.carry(shape, y, z));
        // Displacements of a node, then its rotations.
        for group in own.chunks_exact_mut(Self::per_node::<D>()).flat_map(|node| node.chunks_exact_mut(D)) {
            let given = group.to_vec();
            for (j, shape) in group.iter_mut().enumerate() {
                *shape = Cross::default();
                (0..D).for_each(|k| shape.add(self.axes[k][j], &given[k]));
            }
        }
        own
    }

    const fn per_node<const D: usize>() -> usize {
        if D == 2 { 3 } else { 6 }
    }

    /// Adds the displacement of the ends of the axis by rotations of the nodes.
    fn add_arms<const D: usize>(&self, own: &mut [Cross]) {
        for node in own.chunks_exact_mut(Self::per_node::<D>()) {
            let (moves, turns) = node.split_at_mut(D);
            for (turn, axis) in turns.iter_mut().zip(if D == 2 { 2.. } else { 0.. }) {
                let lever = cross(&from_fn(|k| if k == axis { 1.0 } else { 0.0 }), &self.arm);
                moves.iter().zip(lever).for_each(|(shape, part)| turn.add(part, shape));
            }
        }
    }

    /// Turns a function of the axis into that of the line at [y, z] from it, with vectors in the axes of the floating
    /// frame.
    fn carry(&self, shape: &mut Cross, y: f64, z: f64) {
        let turned = cross(&shape.rotation, &[0.0, y, z]);
        let moved: [f64; 3] = from_fn(|k| shape.displacement[k] + turned[k]);
        let in_frame = |v: &[f64; 3]| from_fn(|j| (0..3).map(|k| self.axes[k][j] * v[k]).sum());
        (shape.displacement, shape.rotation) = (in_frame(&moved), in_frame(&shape.rotation));
        shape.strain.iter_mut().for_each(|strain| *strain *= self.shortness);
        // Half the squares of slopes are strains, so slopes take the square root.
        shape.slope.iter_mut().for_each(|slope| *slope *= self.shortness.sqrt());
    }

    /// The middle of its axis, m, and the direction of the middle coordinate.
    pub fn middle(&self) -> ([f64; 3], [f64; 3]) {
        let x = self.axes[0];
        (from_fn(|k| self.start[k] + 0.5 * self.length * x[k]), x)
    }

    /// Displacement functions of the ends of its axis at 0 <= xi <= 1, all in the element's own axes.
    fn own_shapes<const D: usize>(&self, xi: f64, axial: Axial) -> Vec<Cross> {
        let stretch = self.axial(xi, axial);
        let along_y = self.bending(xi, self.shear[0]).map(Cross::bending_y);
        let mut shapes = Vec::with_capacity(13);
        for node in 0..2 {
            let [deflection, turn] = [along_y[2 * node], along_y[2 * node + 1]];
            if D == 2 {
                shapes.extend([stretch[node], deflection, turn]);
                continue;
            }
            let along_z = self.bending(xi, self.shear[1]).map(Cross::bending_z);
            // ry turns against the slope of bending along z.
            let [deflection_z, turn_y] = [along_z[2 * node], along_z[2 * node + 1].scaled(-1.0)];
            let sign = [-1.0, 1.0][node];
            let twist = Cross::torsion([1.0 - xi, xi][node], sign / self.length);
            shapes.extend([stretch[node], deflection, deflection_z, twist, turn_y, turn]);
        }
        if axial == Axial::Quadratic {
            shapes.push(stretch[2]);
        }
        shapes
    }

    /// Axial functions of both ends and of the middle; the last is zero for linear displacement.
    fn axial(&self, xi: f64, axial: Axial) -> [Cross; 3] {
        let [values, slopes] = match axial {
            Axial::Linear => [[1.0 - xi, xi, 0.0], [-1.0, 1.0, 0.0]],
            Axial::Quadratic => [
                [(1.0 - xi) * (1.0 - 2.0 * xi), xi * (2.0 * xi - 1.0), 4.0 * xi * (1.0 - xi)],
                [4.0 * xi - 3.0, 4.0 * xi - 1.0, 4.0 - 8.0 * xi],
            ],
        };
        from_fn(|i| Cross::axial(values[i], slopes[i] / self.length))
    }

    /// Deflection and turn at the left end, then at the right: the exact solutions of a Timoshenko beam without load
    /// between its ends, whose shear is constant (Przemieniecki, Theory of Matrix Structural Analysis, section 5.6;
    /// Reddy, An Introduction to the Finite Element Method, section 5.3); Hermite's cubics where `shear` is zero.
    fn bending(&self, xi: f64, shear: f64) -> [Bending; 4] {
        let l = self.length;
        let x2 = xi * xi;
        let x3 = xi * xi * xi;
        let bubble = 0.5 * shear * (xi - x2);
        let bubble_slope = 0.5 * shear * (1.0 - 2.0 * xi);
        // Values of the deflection, its slope, the turn and its rate, times 1 + shear.
        let rows = [
            [
                1.0 - 3.0 * x2 + 2.0 * x3 + shear * (1.0 - xi),
                (6.0 * (x2 - xi) - shear) / l,
                6.0 * (x2 - xi) / l,
                6.0 * (2.0 * xi - 1.0) / (l * l),
            ],
            [
                l * (xi - 2.0 * x2 + x3 + bubble),
                1.0 - 4.0 * xi + 3.0 * x2 + bubble_slope,
                1.0 - 4.0 * xi + 3.0 * x2 + shear * (1.0 - xi),
                (6.0 * xi - 4.0 - shear) / l,
            ],
            [
                3.0 * x2 - 2.0 * x3 + shear * xi,
                (6.0 * (xi - x2) + shear) / l,
                6.0 * (xi - x2) / l,
                6.0 * (1.0 - 2.0 * xi) / (l * l),
            ],
            [
                l * (x3 - x2 - bubble),
                3.0 * x2 - 2.0 * xi - bubble_slope,
                3.0 * x2 - 2.0 * xi + shear * xi,
                (6.0 * xi - 2.0 + shear) / l,
            ],
        ];
        rows.each(|row| {
            let [w, slope, turn, turn_rate] = row.each(|value| value / (1.0 + shear));
            Bending { w, slope, turn, turn_rate }
        })
    }
}
