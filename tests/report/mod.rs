//! Results as files, text and figures.

mod curves;
mod error_bar;
mod figures;
mod finished;
mod glyphs;
mod shown;
mod tables;
