//! Results as files and text.

mod check;
mod files;
mod summary;
mod table;
mod tables;

pub use check::{Check, check};
pub use files::{Folder, write_whole};
pub use summary::{Summary, summarize};
pub use table::Table;
pub use tables::{energy_table, drift_table, trajectory_table};
