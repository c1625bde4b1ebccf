//! Maps over stress parameters as figures, files and text.

mod figure;
mod file;
mod words;

pub use figure::stress_figure;
pub use file::{FolderMaps, SceneMaps};
pub use words::sentences;
