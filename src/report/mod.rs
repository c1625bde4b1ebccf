//! Results as files and text.

mod check;
mod check_error;
mod drift;
mod equilibrium;
mod figures;
mod files;
mod finished;
mod hints;
pub mod linear;
pub mod mechanism;
mod origin;
mod rows;
mod simplify;
pub mod stress;
mod summary;
mod sweep;
mod sweep_figure;
mod table;
mod tables;
pub mod tradeoff;
mod warnings;

pub use check::{Check, check};
pub use drift::{drift_text, stabilizations_figure, stabilizations_table};
pub use equilibrium::EquilibriumFile;
pub use figures::{MOST_COORDINATES, drift_figure, energy_figure, outputs_figure};
pub use files::{Folder, Written, write_whole};
pub use finished::FinishedRun;
pub use origin::{Origin, Repeatable, Sealed};
pub use rows::RowFiles;
pub use simplify::{simplify_figure, simplify_table, simplify_text};
pub use summary::{Summary, summarize};
pub use sweep::SweepSummary;
pub use sweep_figure::{SweepLook, sweep_figure};
pub use table::Table;
pub use tables::{cell, sweep_table, table, trajectory_arrays, trajectory_table};
pub use warnings::uncertain_kinds;
