//! Maps over extremes as figures, files and words.

mod figure;
mod file;
mod markdown;
mod words;

pub use figure::stress_figure;
pub use file::{MapFile, StressFile, stress_table};
pub use markdown::stress_page;
pub use words::{gain_table, sentences};
