//! Shape functions of a straight beam element between two sections of the reference line.
//!
//! Its axis x is the chord; y is that of the section in its middle. The line itself, where the mass is, lies beside the
//! chord and turns with the sections of the element. Strains are a length of the line. On an arc all this is of second order
//! in the length of the element, and a rigid motion is exact.

use super::line::{Bending, Cross};
use super::reference::ReferenceLine;
use super::section::Section;
use super::spec::Axial;
use crate::body::{cross, dot, norm, scale, sub};
use std::array::from_fn;

/// One element, with what shear does to its bending along y and z.
#[derive(Clone, Copy, Debug)]
pub struct Element {
    /// Its left end, m, and its own axes, both in those of the floating frame.
    start: [f64; 3],
    axes: [[f64; 3]; 3],
    /// m
    length: f64,
    /// By the length of the line between its ends.
    shortness: f64,
    /// 12 EI/(GA length^2) of bending along y and z: zero without shear.
    shear: [f64; 2],
}

impl Element {
    /// Between two abscissae, from one to the other of which the line turns by less than half a turn.
    pub fn new(line: &ReferenceLine, [from, to]: [f64; 2], section: &Section) -> Self {
        let [start, end] = [from, to].map(|s| line.at(s).1);
        let ([_, side, _], _) = line.at(0.5 * (from + to));
        let chord = sub(&end, &start);
        let length = norm(&chord);
        let x = chord.map(|c| c / length);
        let y = sub(&side, &scale(&x, dot(&x, &side)));
        let y = y.map(|c| c / norm(&y));
        let ratio = |ei: f64, ga: f64| 12.0 * ei / (ga * length * length);
        let shear = [ratio(section.ei[1], section.ga[0]), ratio(section.ei[0], section.ga[1])];
        Element { start, axes: [x, y, cross(&x, &y)], length, shortness: length / (to - from), shear }
    }

    /// What the coordinates of both nodes, then the middle one, do at the place r of the line: x, y, r each node in the
    /// plane; x, y, z, rx, ry, rz in space, along the axes of the floating frame; the middle one along the element.
    pub fn shapes<const D: usize>(&self, r: &[f64; 3], axial: Axial) -> Vec<Cross> {
        let arm = sub(r, &self.start);
        let [x, y, z] = self.axes.map(|axis| dot(&axis, &arm));
        let mut own = self.own_shapes::<D>((x / self.length).clamp(0.0, 1.0), axial);
        own.iter_mut().for_each(|shape| self.carry(shape, [y, z]));
        // Displacements, then rotations of a node, as many as there are of them.
        let per_node = if D == 2 { 3 } else { 6 };
        let group = |i: usize| match i % per_node / D * D {
            first if i < 2 * per_node && first + D <= per_node => Some(i / per_node * per_node + first),
            _ => None,
        };
        let along = |i: usize| match group(i) {
            None => own[i],
            Some(first) => {
                let mut sum = Cross::default();
                (0..D).for_each(|k| sum.add(self.axes[k][i - first], &own[first + k]));
                sum
            }
        };
        (0..own.len()).map(along).collect()
    }

    /// A shape of the chord as that of the line at [y, z] beside it, its vectors in the axes of the floating frame.
    fn carry(&self, shape: &mut Cross, [y, z]: [f64; 2]) {
        let turned = cross(&shape.rotation, &[0.0, y, z]);
        let moved: [f64; 3] = from_fn(|k| shape.displacement[k] + turned[k]);
        let in_frame = |v: &[f64; 3]| from_fn(|j| (0..3).map(|k| self.axes[k][j] * v[k]).sum());
        (shape.displacement, shape.rotation) = (in_frame(&moved), in_frame(&shape.rotation));
        shape.strain.iter_mut().for_each(|strain| *strain *= self.shortness);
        // Half their squares are strains.
        shape.slope.iter_mut().for_each(|slope| *slope *= self.shortness.sqrt());
    }

    /// The middle of its chord, m, and the direction in which its coordinate moves it.
    pub fn middle(&self) -> ([f64; 3], [f64; 3]) {
        let x = self.axes[0];
        (from_fn(|k| self.start[k] + 0.5 * self.length * x[k]), x)
    }

    /// The same at xi of the chord, all in the element's own axes.
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

    /// Of both ends and the middle, which is there for quadratic displacement only.
    fn axial(&self, xi: f64, axial: Axial) -> [Cross; 3] {
        let [values, slopes] = match axial {
            Axial::Linear => [[1.0 - xi, xi, 0.0], [-1.0, 1.0, 0.0]],
            Axial::Quadratic => [
                [(1.0 - xi) * (1.0 - 2.0 * xi), xi * (2.0 * xi - 1.0), 4.0 * xi * (1.0 - xi)],
                [4.0 * xi - 3.0, 4.0 * xi - 1.0, 4.0 - 8.0 * xi],
            ],
        };
        std::array::from_fn(|i| Cross::axial(values[i], slopes[i] / self.length))
    }

    /// Deflection and turn at the left end, then at the right: the exact solutions of a Timoshenko beam without load
    /// between its ends, whose shear is constant (Przemieniecki, Theory of Matrix Structural Analysis, section 5.6;
    /// Reddy, An Introduction to the Finite Element Method, section 5.3); Hermite's cubics where `shear` is zero.
    fn bending(&self, xi: f64, shear: f64) -> [Bending; 4] {
        let (l, x2, x3) = (self.length, xi * xi, xi * xi * xi);
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
        rows.map(|row| {
            let [w, slope, turn, turn_rate] = row.map(|value| value / (1.0 + shear));
            Bending { w, slope, turn, turn_rate }
        })
    }
}
