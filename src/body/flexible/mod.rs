//! Flexible bodies.

mod section;
mod shape;
mod spec;

pub use section::{Section, curvature};
pub use shape::{Elastic, Line, Piece, PointShape, SectionShape, Stretch, Symmetric};
pub use spec::{
    Axial, Damping, Elasticity, FlexibleBeam, FrameConditions, FrameKind, OneOrMany, Ritz,
    SectionShape as SectionGeometry, Stiffness, Theory,
};

use super::{BodySpec, Build, Built, Initial, Marker};
use crate::error::{Error, Result};

impl BodySpec for FlexibleBeam {
    const TYPE: &'static str = "flexible_beam";

    fn build<const D: usize>(&self, _: Vec<Marker<D>>, _: &Initial, _: &Build<D>) -> Result<Built<D>> {
        Err(Error::input("no beam in a floating frame yet").under("frame"))
    }
}
