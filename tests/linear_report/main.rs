//! Linear models as files, text and figures.

mod comparison;
mod files;
mod sample;
mod text;
