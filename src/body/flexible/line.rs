//! The line of a beam: what every way to describe its displacements (elements, functions, modes) has in common.
//!
//! Displacements (u, w_y, w_z) of the line and rotations (r_x, r_y, r_z) of its sections are small. With ' = d/ds:
//!
//! ```text
//! extension u',  shear w_y' - r_z and w_z' + r_y,  twist r_x',  curvatures r_y' and r_z'
//! strain of the fibre at (y, z):  u' - y r_z' + z r_y'
//! ```
//!
//! so that where sections stay square to the line r_z = w_y' and r_y = -w_z'. On a line that is curved at rest strains and
//! slopes are in the axes of its elements, displacements and rotations in those of the floating frame.

use super::profile::Profile;
use super::reference::ReferenceLine;
use super::section::Section;
use super::shape::{Inertia, Line, PointShape, SectionShape};
use super::shorten::{shorten, shortening};
use crate::body::{Frame, Marker, cross, in_space};
use std::array::from_fn;

/// What one coordinate does to one section.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cross {
    /// Of the line: u, w_y, w_z where it is straight.
    pub displacement: [f64; 3],
    /// r_x, r_y, r_z
    pub rotation: [f64; 3],
    /// In the order of [`SectionShape::strains`].
    pub strain: [f64; 6],
    /// w_y', w_z'
    pub slope: [f64; 2],
}

impl Cross {
    /// Extension by u with slope u'.
    pub fn axial(u: f64, slope: f64) -> Self {
        Cross { displacement: [u, 0.0, 0.0], strain: [slope, 0.0, 0.0, 0.0, 0.0, 0.0], ..Self::default() }
    }

    /// Twist by an angle with slope.
    pub fn torsion(angle: f64, slope: f64) -> Self {
        Cross { rotation: [angle, 0.0, 0.0], strain: [0.0, 0.0, 0.0, slope, 0.0, 0.0], ..Self::default() }
    }

    /// Bending along y: deflection w, its slope, the section's turn from w towards the line's slope, and its rate.
    pub fn bending_y(Bending { w, slope, turn, turn_rate }: Bending) -> Self {
        Cross {
            displacement: [0.0, w, 0.0],
            rotation: [0.0, 0.0, turn],
            strain: [0.0, slope - turn, 0.0, 0.0, 0.0, turn_rate],
            slope: [slope, 0.0],
        }
    }

    /// Bending along z: the section's turn about y is against the slope.
    pub fn bending_z(Bending { w, slope, turn, turn_rate }: Bending) -> Self {
        Cross {
            displacement: [0.0, 0.0, w],
            rotation: [0.0, -turn, 0.0],
            strain: [0.0, 0.0, slope - turn, 0.0, -turn_rate, 0.0],
            slope: [0.0, slope],
        }
    }

    /// self += factor other
    pub fn add(&mut self, factor: f64, other: &Cross) {
        let into = |a: &mut [f64], b: &[f64]| a.iter_mut().zip(b).for_each(|(a, b)| *a += factor * b);
        into(&mut self.displacement, &other.displacement);
        into(&mut self.rotation, &other.rotation);
        into(&mut self.strain, &other.strain);
        into(&mut self.slope, &other.slope);
    }

    pub fn scaled(&self, factor: f64) -> Self {
        let mut scaled = Cross::default();
        scaled.add(factor, self);
        scaled
    }
}

/// Bending in one plane: the deflection, its slope, the turn of the section (the slope without shear) and its rate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bending {
    pub w: f64,
    pub slope: f64,
    pub turn: f64,
    pub turn_rate: f64,
}

/// What the coordinates that reach a place do there.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Station {
    pub dofs: Vec<usize>,
    pub shapes: Vec<Cross>,
}

/// Displacements of the line of a beam as functions of the place.
pub trait Shapes: Send + Sync {
    fn reference(&self) -> &ReferenceLine;
    /// At 0 <= s <= length.
    fn at(&self, s: f64) -> Station;
    /// Places between which the shapes are smooth, both ends among them.
    fn breaks(&self) -> Vec<f64>;
    fn profile(&self) -> &Profile;
    /// Whether the line keeps its length as it bends. Default: no.
    fn shortens(&self) -> bool {
        false
    }
    /// The mass from `s` on, without what the line shortens by; one piece of all coordinates where it does.
    fn inertia<const D: usize>(&self, s: f64) -> Inertia<D>;
}

impl<F: Shapes, const D: usize> Line<D> for F {
    fn length(&self) -> f64 {
        self.reference().length
    }

    fn at_rest(&self, s: f64) -> Frame<f64, D> {
        self.reference().section(s)
    }

    fn point(&self, mut place: [f64; D]) -> PointShape<D> {
        let s = std::mem::replace(&mut place[0], 0.0);
        let (section, Station { dofs, shapes }) = (self.reference().section(s), self.at(s));
        let rest = section.at(&Marker::point(place)).r;
        let arm = Frame { r: [0.0; D], ..section }.at(&Marker::point(place)).r;
        let translation = |shape: &Cross| {
            let turned = cross(&shape.rotation, &in_space(&arm));
            from_fn(|k| shape.displacement[k] + turned[k])
        };
        PointShape {
            rest,
            arm,
            dofs,
            translation: shapes.iter().map(translation).collect(),
            rotation: shapes.iter().map(|shape| shape.rotation).collect(),
            shortening: if self.shortens() { shortening(self, s) } else { Vec::new() },
        }
    }

    fn section(&self, s: f64) -> SectionShape {
        let Station { dofs, shapes } = self.at(s);
        let strains = shapes.iter().map(|shape| shape.strain).collect();
        SectionShape { dofs, strains }
    }

    fn material(&self, s: f64) -> Section {
        self.profile().at(s)
    }

    fn beyond(&self, s: f64) -> Inertia<D> {
        let mut inertia = self.inertia(s);
        inertia.pieces.iter_mut().filter(|_| self.shortens()).for_each(|piece| shorten(self, s, piece));
        inertia
    }
}
