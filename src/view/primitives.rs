//! Meshes of size 1 that a glTF file places and scales.

use std::f64::consts::{PI, TAU};

/// Translation, rotation [x, y, z, w] and scale of a node.
pub type Placement = ([f64; 3], [f64; 4], [f64; 3]);

/// A mesh of size 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Primitive {
    /// Radius 1 about y, from y = 0 to y = 1.
    Cylinder,
    /// Radius 1.
    Sphere,
    /// Edges of length 1, centred.
    Cube,
}

/// All meshes, in the order of their numbers.
pub const ALL: [Primitive; 3] = [Primitive::Cylinder, Primitive::Sphere, Primitive::Cube];
const SIDES: usize = 16;
const RINGS: usize = 8;

impl Primitive {
    /// Returns corners and triangles, counterclockwise from outside.
    pub fn mesh(self) -> (Vec<[f32; 3]>, Vec<u16>) {
        match self {
            // A box is a cylinder with four sides between two rings.
            Primitive::Cube => surface(&[(0.5f64.sqrt(), -0.5), (0.5f64.sqrt(), 0.5)], 4),
            Primitive::Cylinder => surface(&[(1.0, 0.0), (1.0, 1.0)], SIDES),
            Primitive::Sphere => {
                let ring = |k: usize| (PI * k as f64 / RINGS as f64).sin_cos();
                surface(&(0..=RINGS).map(ring).map(|(radius, height)| (radius, -height)).collect::<Vec<_>>(), SIDES)
            }
        }
    }
}

/// A surface of revolution about y through rings (radius, y) from bottom to top, closed at both ends.
fn surface(rings: &[(f64, f64)], sides: usize) -> (Vec<[f32; 3]>, Vec<u16>) {
    let mut corners = Vec::new();
    for (radius, y) in rings {
        for side in 0..sides {
            let (s, c) = (TAU * (side as f64 + 0.5) / sides as f64).sin_cos();
            corners.push([(radius * c) as f32, *y as f32, (radius * s) as f32]);
        }
    }
    let last = rings.len() - 1;
    let poles = [(0, rings[0].1), (last, rings[last].1)];
    corners.extend(poles.map(|(_, y)| [0.0, y as f32, 0.0]));
    let corner = |ring: usize, side: usize| (ring * sides + side % sides) as u16;
    let (bottom, top) = ((rings.len() * sides) as u16, (rings.len() * sides + 1) as u16);
    let mut triangles = Vec::new();
    for side in 0..sides {
        for ring in 0..last {
            let [a, b] = [corner(ring, side), corner(ring, side + 1)];
            let [c, d] = [corner(ring + 1, side), corner(ring + 1, side + 1)];
            triangles.extend([a, c, b, b, c, d]);
        }
        triangles.extend([bottom, corner(0, side), corner(0, side + 1)]);
        triangles.extend([top, corner(last, side + 1), corner(last, side)]);
    }
    (corners, triangles)
}
