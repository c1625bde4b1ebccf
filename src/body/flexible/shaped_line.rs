//! The line of a beam by its displacement functions.

use super::line::{Cross, Shapes, Station};
use super::section::Section;
use super::shape::{Line, MassIntegrals, PointShape, SectionShape};
use super::shorten::{shorten, shortening};
use crate::body::{Frame, Marker, cross, in_space};
use crate::math::array::from_fn;

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

    fn beyond(&self, s: f64) -> MassIntegrals<D> {
        let mut inertia = self.inertia(s);
        inertia.pieces.iter_mut().filter(|_| self.shortens()).for_each(|piece| shorten(self, s, piece));
        inertia
    }
}
