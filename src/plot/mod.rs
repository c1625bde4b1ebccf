//! Figures from data, as SVG or PNG files. This module does not depend on mechanics.
//!
//! A [`Figure`] stacks one or several [`Panel`]s. [`Figure::save`] lays them out into a flat list of shapes,
//! then writes that list as SVG or has tiny-skia draw it as PNG, so that both show the same picture. Text is
//! measured with the embedded DejaVu Sans; no font or library of the system is needed.
//!
//! Sizes are in nominal pixels. A figure is 640 of them wide by default and meant to be printed 85 mm wide
//! (one journal column), where its text is 6 to 7 pt high.

mod animation;
mod axes;
mod axis;
mod clip;
mod color_bar;
mod draw;
mod figure;
mod font;
mod heat;
mod item;
mod layout;
mod legend;
mod marks;
mod notes;
mod palette;
mod panel;
#[cfg(feature = "figures")]
mod raster;
mod series;
mod shape;
mod svg;
mod text;
mod thin;
mod ticks;

pub use animation::Animation;
pub use figure::Figure;
pub use heat::HeatMap;
pub use item::{Item, Place, Spot, Tint};
pub use panel::{Annotation, AxisSpec, Panel, Scale};
pub use series::{ColorSeries, Series, Style};
pub use shape::Align;

#[cfg(all(test, feature = "figures"))]
mod tests;

/// Replaces the raster formats where the libraries that draw them are not compiled in.
#[cfg(not(feature = "figures"))]
mod raster {
    use super::shape::{Drawing, Shape};

    type Picture = Result<Vec<u8>, String>;

    fn none(what: &str) -> Picture {
        Err(format!("holonom is built without {what}: the feature `figures`"))
    }

    pub(super) fn png(_: &Drawing) -> Picture {
        none("PNG")
    }

    pub(super) fn gif(
        _: &Drawing,
        _: usize,
        _: f64,
        _: &impl Fn(usize) -> Vec<Shape>,
        _: impl FnMut(usize),
    ) -> Picture {
        none("GIF")
    }
}
