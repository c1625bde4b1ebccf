//! Closed forms of mass distributions of uniform density.

use crate::body::{cross, dot, scale, sub};
use crate::math::array::{Each, from_fn};
use crate::math::rotation::Matrix3;

/// A volume of uniform density: its spread is the integral of x x^T over its mass, with x from its centre, divided by
/// the mass. The tensor of inertia of the mass m is m (tr(S) 1 - S).
#[derive(Clone, Copy)]
pub struct Uniform {
    /// m^3; zero where an extent is missing.
    pub volume: f64,
    /// Centre of mass in the shape's axes, m.
    pub centre: [f64; 3],
    /// m^2, in the shape's axes.
    pub spread: Matrix3,
}

/// (a b^T + b a^T)/2
fn square(a: [f64; 3], b: [f64; 3]) -> Matrix3 {
    from_fn(|i| from_fn(|j| 0.5 * (a[i] * b[j] + b[i] * a[j])))
}

/// Adds `factor` times a matrix.
pub fn add(sum: &mut Matrix3, factor: f64, matrix: &Matrix3) {
    for (row, other) in sum.iter_mut().zip(matrix) {
        row.iter_mut().zip(other).for_each(|(x, y)| *x += factor * y);
    }
}

fn diagonal(entries: [f64; 3]) -> Matrix3 {
    from_fn(|i| from_fn(|j| if i == j { entries[i] } else { 0.0 }))
}

impl Uniform {
    fn centred(volume: f64, spread: [f64; 3]) -> Self {
        Uniform { volume, centre: [0.0; 3], spread: diagonal(spread) }
    }

    /// Edges along x, y and z.
    pub fn cuboid(edges: [f64; 3]) -> Self {
        let [a, b, c] = edges;
        Self::centred(a * b * c, [a * a, b * b, c * c].each(|square| square / 12.0))
    }

    /// Hollow cylinder about z.
    pub fn tube(outer: f64, inner: f64, length: f64) -> Self {
        let across = 0.25 * (outer * outer + inner * inner);
        let along = length * length / 12.0;
        let section = std::f64::consts::PI * (outer - inner) * (outer + inner);
        Self::centred(section * length, [across, across, along])
    }

    /// Full sphere.
    pub fn sphere(radius: f64) -> Self {
        Self::centred(4.0 / 3.0 * std::f64::consts::PI * radius.powi(3), [0.2 * radius * radius; 3])
    }

    /// Cylinder between two points; a radius of zero makes it slender.
    pub fn rod(from: [f64; 3], to: [f64; 3], radius: f64) -> Self {
        let along = sub(&to, &from);
        let square_of_length = dot(&along, &along);
        let mut spread =
            square(along, along).each(|row| row.each(|x| x * (1.0 / 12.0 - 0.25 * radius * radius / square_of_length)));
        add(&mut spread, 1.0, &diagonal([0.25 * radius * radius; 3]));
        let volume = std::f64::consts::PI * radius * radius * square_of_length.sqrt();
        Uniform { volume, centre: from_fn(|i| 0.5 * (from[i] + to[i])), spread }
    }

    /// Prism over a polygon in the x-y plane, its corners in order, from -thickness/2 to thickness/2; the sum over the
    /// triangles between its first corner and each edge.
    pub fn prism(corners: &[[f64; 2]], thickness: f64) -> Self {
        let first = corners.first().copied().unwrap_or([0.0; 2]);
        let arms: Vec<[f64; 3]> = corners.iter().map(|c| [c[0] - first[0], c[1] - first[1], 0.0]).collect();
        let mut area = 0.0;
        let mut moment = [0.0; 3];
        let mut second = [[0.0; 3]; 3];
        for pair in arms.windows(2) {
            let part = 0.5 * cross(&pair[0], &pair[1])[2];
            area += part;
            moment = from_fn(|i| moment[i] + part * (pair[0][i] + pair[1][i]) / 3.0);
            for (a, b) in [(0, 0), (1, 1), (0, 1)] {
                add(&mut second, part / 6.0, &square(pair[a], pair[b]));
            }
        }
        let middle = scale(&moment, 1.0 / area);
        let mut spread = second.each(|row| row.each(|x| x / area));
        add(&mut spread, -1.0, &square(middle, middle));
        spread[2][2] = thickness * thickness / 12.0;
        Uniform {
            volume: area.abs() * thickness,
            centre: from_fn(|i| [first[0], first[1], 0.0][i] + middle[i]),
            spread,
        }
    }

    /// What has this tensor of inertia about its centre, kg m^2.
    pub fn of_tensor(mass: f64, centre: [f64; 3], tensor: &Matrix3) -> Self {
        let mut spread = diagonal([0.5 * (tensor[0][0] + tensor[1][1] + tensor[2][2]) / mass; 3]);
        add(&mut spread, -1.0 / mass, tensor);
        Uniform { volume: 0.0, centre, spread }
    }

    /// The same at a place: `axes[i]` is its i-th axis.
    pub fn placed(&self, at: [f64; 3], axes: &Matrix3) -> Self {
        let turned = |v: &[f64; 3]| -> [f64; 3] { from_fn(|k| (0..3).map(|i| axes[i][k] * v[i]).sum()) };
        let columns = self.spread.each(|row| turned(&row));
        let spread = from_fn(|i| turned(&columns.each(|row| row[i])));
        let offset = turned(&self.centre);
        Uniform { volume: self.volume, centre: from_fn(|i| at[i] + offset[i]), spread }
    }
}

/// Mass, centre and tensor of inertia about the centre of parts (mass, distribution); holes have negative masses.
pub fn sum(parts: &[(f64, Uniform)]) -> (f64, [f64; 3], Matrix3) {
    let mass: f64 = parts.iter().map(|(mass, _)| mass).sum();
    let centre: [f64; 3] = from_fn(|i| parts.iter().map(|(mass, part)| mass * part.centre[i]).sum::<f64>() / mass);
    let mut spread = [[0.0; 3]; 3];
    for (mass, part) in parts {
        let arm = sub(&part.centre, &centre);
        add(&mut spread, *mass, &part.spread);
        add(&mut spread, *mass, &square(arm, arm));
    }
    let mut tensor = diagonal([spread[0][0] + spread[1][1] + spread[2][2]; 3]);
    add(&mut tensor, -1.0, &spread);
    (mass, centre, tensor)
}
