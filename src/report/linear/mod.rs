//! Linear models as files, text and figures.

mod against;
mod along;
mod bode_figure;
mod crossings;
mod drawn;
mod files;
mod loci;
mod mode_figures;
mod notes;
mod pair;
mod phase;
mod plane;
mod ranges;
mod rays;
mod response;
mod span;
mod text;
mod transition;
mod turning;
mod validation;

pub use against::AgainstAnswer;
pub use along::{AlongAnswer, ArrayFormat};
pub use bode_figure::{Magnitude, bode_figure};
pub use files::{LinearAnswer, stem_at};
pub use loci::LociAnswer;
pub use mode_figures::{frequency_figure, motion_figure};
pub use pair::Response;
pub use plane::loci_figure;
pub use response::FrequencyResponse;
pub use span::SpanAnswer;
pub use text::{MethodsAnswer, comparison_text};
pub use transition::Transition;
pub use validation::{ValidationAnswer, validation_figure};

use crate::linearize::LinearModel;
use crate::system::Names;

/// A linear model with the names of its scene.
#[derive(Clone, Copy)]
pub struct NamedModel<'a> {
    pub scene: &'a str,
    /// Names of the coordinates, velocities and multipliers of the operating point.
    pub names: &'a Names,
    pub model: &'a LinearModel,
}
