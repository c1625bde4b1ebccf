//! Linear models as files, text and figures.

mod against;
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
mod text;
mod turning;
mod validation;

pub use against::{AgainstFile, LociAgainst, with_others};
pub use bode_figure::{Magnitude, bode_figure};
pub use crossings::with_thresholds;
pub use files::{LinearFile, OperatingPointFile, linear_stem};
pub use loci::{LociFile, LociSummary, loci_table};
pub use mode_figures::{frequency_figure, motion_figure};
pub use pair::Response;
pub use plane::loci_figure;
pub use response::{FrequencyResponse, ResponseFile};
pub use text::comparison_text;
pub use turning::speeds;
pub use validation::{ValidationFile, validation_figure};

use crate::linearize::LinearModel;
use crate::system::Names;

/// A linear model with the names of its scene.
#[derive(Clone, Copy)]
pub struct Linear<'a> {
    /// Name of the scene.
    pub scene: &'a str,
    /// Names of the coordinates, velocities and multipliers of the operating point.
    pub names: &'a Names,
    /// The model.
    pub model: &'a LinearModel,
}
