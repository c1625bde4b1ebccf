//! Maps over extremes as figures, files and words.

mod figure;
mod file;
mod words;

pub use figure::stress_figure;
pub use file::{MapFile, StressFile, stress_page, stress_table};
pub use words::{gain_table, sentences};
