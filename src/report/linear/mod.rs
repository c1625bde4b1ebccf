//! Linear models as files, text and figures.

mod files;
mod loci;
mod loci_figures;
mod response;
mod text;
mod validation;

pub use files::{LinearFile, OperatingPointFile, linear_stem};
pub use loci::{LociFile, LociSummary, loci_table};
pub use loci_figures::{frequency_figure, loci_figure};
pub use response::{FrequencyResponse, Response, ResponseFile, bode_figure};
pub use text::comparison_text;
pub use validation::{Deviation, ErrorOrder, ValidationFile, sequence_figure, validation_figure};

use crate::linearize::LinearModel;
use crate::system::Names;

/// A linear model with what it is a model of.
#[derive(Clone, Copy)]
pub struct Linear<'a> {
    pub scene: &'a str,
    /// Of the coordinates, velocities and multipliers of the operating point.
    pub names: &'a Names,
    pub model: &'a LinearModel,
}
