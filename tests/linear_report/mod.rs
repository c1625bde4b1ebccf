//! Linear models as files, text and figures.

mod comparison;
mod figures;
mod files;
mod sample;
mod text;
