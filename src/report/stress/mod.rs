//! Maps over stress parameters as figures, files and text.

mod figure;
mod file;
mod words;

pub use figure::stress_figure;
pub use file::{MapFile, StressFile, stress_page, stress_table};
pub use words::{gain_table, sentences};
