//! Figures: data in, an SVG or PNG file out. Nothing here knows any mechanics.
//!
//! A [`Figure`] stacks one or several [`Panel`]s. [`Figure::save`] lays them out into a flat list of shapes,
//! then writes that list as SVG or rasterizes it to PNG, so that both show the same picture. Text is
//! measured with the embedded DejaVu Sans; no font or library of the system is needed.
//!
//! Sizes are in nominal pixels. A figure is 640 of them wide by default and meant to be printed 85 mm wide
//! (one journal column), where its text is 6 to 7 pt high.

mod animation;
mod axes;
mod axis;
mod bitmap;
mod clip;
mod color_bar;
mod draw;
mod error;
mod figure;
mod font;
mod gif;
mod heat;
mod item;
mod layout;
mod legend;
mod marks;
mod notes;
mod palette;
mod panel;
mod save;
mod series;
mod shape;
mod svg;
mod text;
mod thin;
mod ticks;

pub use animation::Animation;
pub use error::PlotError;
pub use figure::Figure;
pub use heat::HeatMap;
pub use item::{Align, Item, Place, Spot, Tint};
pub use panel::{Annotation, AxisSpec, Panel, ReferenceLine, Scale};
pub use series::{ColorSeries, Series, Style};

#[cfg(test)]
mod tests;
