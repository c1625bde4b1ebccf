//! What kind of file a figure becomes.

use std::path::Path;

use super::error::PlotError;

/// What a file name asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Svg,
    Png,
}

impl Format {
    /// By the extension, in any case of letters.
    pub fn of(path: &Path) -> Result<Self, PlotError> {
        let extension = path.extension().and_then(|text| text.to_str()).unwrap_or_default().to_ascii_lowercase();
        match extension.as_str() {
            _ if path.is_dir() => Err(PlotError::Directory { path: path.to_path_buf() }),
            "svg" => Ok(Self::Svg),
            "png" => Ok(Self::Png),
            _ => Err(PlotError::Extension { path: path.to_path_buf() }),
        }
    }
}
