//! Shape functions of a beam element over xi = 0..1.

use super::line::{Bending, Cross};
use super::section::Section;
use super::spec::Axial;

/// One element, with what shear does to its bending along y and z.
#[derive(Clone, Copy, Debug)]
pub struct Element {
    /// m
    pub length: f64,
    /// 12 EI/(GA length^2) of bending along y and z: zero without shear.
    pub shear: [f64; 2],
}

impl Element {
    pub fn new(length: f64, section: &Section) -> Self {
        let ratio = |ei: f64, ga: f64| 12.0 * ei / (ga * length * length);
        Element { length, shear: [ratio(section.ei[1], section.ga[0]), ratio(section.ei[0], section.ga[1])] }
    }

    /// What the coordinates of both nodes, then the middle one, do at xi: x, y, r each node in the plane; x, y, z, rx,
    /// ry, rz in space.
    pub fn shapes<const D: usize>(&self, xi: f64, axial: Axial) -> Vec<Cross> {
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
