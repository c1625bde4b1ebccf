//! Results as files and text: what a command computes is an [`Answer`], and a [`Folder`] publishes it.

mod answer;
mod check;
mod drift;
mod equilibrium;
mod error_bar;
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
mod study;
mod study_figure;
mod summary;
mod sweep;
mod sweep_figure;
mod table;
mod tables;
pub mod tradeoff;
mod warnings;

pub use answer::Answer;
pub(crate) use answer::object;
pub use check::{Check, check};
pub use drift::Stabilizations;
pub use equilibrium::EquilibriumReport;
#[cfg(feature = "view")]
pub(crate) use figures::quantity;
pub use figures::{Ending, MOST_COORDINATES, Shown, drift_figure, energy_figure, outputs_figure};
pub use files::{Folder, Format, Written, write_whole};
pub use finished::FinishedRun;
pub use origin::{Origin, Sealed};
pub use rows::RowFiles;
pub use simplify::simplify_figure;
pub use study::StudyAnswer;
pub use summary::{Summary, summarize};
pub use sweep::SweepAnswer;
pub use sweep_figure::SweepLook;
pub use table::{OutputValues, TextTable};
pub use tables::{cell, table, trajectory_arrays};
pub use warnings::uncertain_kinds;
