//! Flexible bodies.

mod beam;
mod damping;
mod element;
mod gauss;
mod integrals;
mod line;
mod mesh;
pub mod modal;
mod profile;
mod read_section;
mod reduce;
mod reference;
mod ritz;
mod section;
mod shape;
mod shaped_line;
mod shorten;
mod spec;
#[cfg(test)]
mod tests;

use crate::modes::natural as eigen;
pub use beam::{MOST_ELEMENTS, elastic_beam};
pub use gauss::{gauss_legendre, on_interval};
pub use profile::Profile;
pub use reference::{ReferenceLine, curvature};
pub use section::Section;
pub use shape::{Disc, Elastic, Line, MassIntegrals, Piece, PointShape, Second, SectionShape, Stretch, Symmetric};
pub use spec::{
    Axial, Damping, Elasticity, FlexibleBeam, FrameConditions, FrameKind, OneOrMany, Ritz,
    SectionShape as SectionGeometry, Stiffness, Theory,
};
