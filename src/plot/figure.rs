//! A whole figure, and its file formats.

use std::path::Path;

use crate::error::{Error, Result};
use crate::files::write_whole;

use super::panel::Panel;
use super::shape::Drawing;
use super::{draw, raster, svg};

/// Width of one journal column in nominal pixels.
const COLUMN_WIDTH: f64 = 640.0;

/// One or several panels, stacked. Panels with the same x axis share it: the limits are common and only the
/// last one is labelled. A legend that is the same in all panels is drawn once.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Title above the panels.
    pub title: Option<String>,
    /// Panels from top to bottom, or row by row.
    pub panels: Vec<Panel>,
    /// Number of panels side by side.
    pub columns: usize,
    /// Width in nominal pixels; 640 is one journal column (85 mm). The height follows from the panels.
    pub width: f64,
}

impl Default for Figure {
    fn default() -> Self {
        Self { title: None, panels: Vec::new(), columns: 1, width: COLUMN_WIDTH }
    }
}

impl Figure {
    /// An empty figure, one journal column wide.
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets the title.
    pub fn title(mut self, title: impl Into<String>) -> Self {
        self.title = Some(title.into());
        self
    }

    /// Adds a panel below the others.
    pub fn panel(mut self, panel: Panel) -> Self {
        self.panels.push(panel);
        self
    }

    /// Sets the number of panels side by side.
    pub fn columns(mut self, columns: usize) -> Self {
        self.columns = columns;
        self
    }

    /// Sets the width in nominal pixels (640 is one journal column); text keeps its size.
    pub fn width(mut self, width: f64) -> Self {
        self.width = width;
        self
    }

    /// Writes the figure as SVG or PNG, by the extension of the path. The file is replaced in one step.
    ///
    /// # Errors
    /// The extension is another one; the path is a folder or cannot be written; there is no PNG of the figure: see
    /// [`Figure::to_png`].
    pub fn save(&self, path: impl AsRef<Path>) -> Result<()> {
        let path = path.as_ref();
        let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
        let bytes = match extension.to_str() {
            Some("svg") => self.to_svg().into_bytes(),
            Some("png") => self.to_png().map_err(|reason| Error::file(path, reason))?,
            _ => return Err(Error::file(path, "the name of a figure must end in .svg or .png")),
        };
        write_whole(path, &bytes).map_err(|error| Error::file(path, error))
    }

    /// Returns the figure as SVG text.
    pub fn to_svg(&self) -> String {
        svg::render(&self.drawing())
    }

    /// Returns the bytes of a PNG file.
    ///
    /// # Errors
    /// It has more pixels than the limit; the feature `figures` is off.
    pub fn to_png(&self) -> Result<Vec<u8>, String> {
        raster::png(&self.drawing())
    }

    pub(super) fn drawing(&self) -> Drawing {
        draw::figure(self)
    }
}
