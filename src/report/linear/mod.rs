//! Linear models as files, text and figures.

mod arrays;
mod bode;
mod comparison;
mod curves;
mod damping;
mod file;
mod loci;
mod loci_file;
mod loci_text;
pub(super) mod pairs;
mod range;
mod response;
mod text;
mod validation;
mod validation_file;

pub use bode::{Response, bode_figure};
pub use comparison::{Comparison, compare, comparison_text};
pub use curves::frequency_figure;
pub use file::{LinearFile, OperatingPointFile, linear_stem};
pub use loci::loci_figure;
pub use loci_file::{LociFile, LociSummary, loci_table};
pub use response::{FrequencyResponse, ResponseFile};
pub use validation::{Deviation, ErrorOrder, validation_figure};
pub use validation_file::{ValidationFile, ladder_figure};

use crate::error::Result;
use crate::files::{mat, npz};
use crate::linearize::LinearModel;
use crate::report::Folder;
use crate::system::Names;

/// A linear model with what it is a model of.
#[derive(Clone, Copy)]
pub struct Linear<'a> {
    pub scene: &'a str,
    /// Of the coordinates, velocities and multipliers of the operating point.
    pub names: &'a Names,
    pub model: &'a LinearModel,
}

impl Linear<'_> {
    /// Writes the model as JSON, for NumPy and for MATLAB; `stem` is the name of the files without their ends.
    ///
    /// # Errors
    /// Files that cannot be written.
    pub fn write(&self, folder: &mut Folder, stem: &str) -> Result<()> {
        folder.write_json(&format!("{stem}.json"), &self.file())?;
        let arrays = self.arrays();
        folder.write(&format!("{stem}.npz"), &npz::write(&arrays)?)?;
        folder.write(&format!("{stem}.mat"), &mat::write(&arrays)?)
    }
}
