//! Why a figure could not be written.

use std::path::PathBuf;

/// Why a figure could not be written; every variant names the path.
#[derive(Debug, thiserror::Error)]
pub enum PlotError {
    /// The extension says neither SVG nor PNG.
    #[error("cannot write the figure {}: its name must end in .svg or .png", .path.display())]
    Extension {
        /// The path asked for.
        path: PathBuf,
    },
    /// The path is a folder.
    #[error("cannot write the figure {}: this is a folder, not a file", .path.display())]
    Directory {
        /// The path asked for.
        path: PathBuf,
    },
    /// The operating system refused.
    #[error("cannot write the figure {}: {source}", .path.display())]
    Write {
        /// The path asked for.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The figure could not be turned into pixels.
    #[error("cannot draw the figure {}: {reason}", .path.display())]
    Draw {
        /// The path asked for.
        path: PathBuf,
        /// What went wrong.
        reason: String,
    },
}
