//! Flexible bodies.

mod section;
mod shape;
mod spec;

pub use section::Section;
pub use shape::{Elastic, Line, Piece, PointShape, SectionShape, Stretch, Symmetric};
pub use spec::{Axial, Damping, FlexibleBeam, FrameConditions, FrameKind, OneOrMany, Ritz, Theory};
