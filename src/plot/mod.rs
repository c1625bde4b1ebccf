//! Figures from data, as SVG or PNG files. This module does not depend on mechanics.
//!
//! A [`Figure`] stacks one or several [`Panel`]s. plotters draws all of them on a backend that records shapes. The
//! shapes are written as SVG, or drawn by tiny-skia as PNG and GIF, so that all show the same picture. Text is measured with the embedded
//! DejaVu Sans; no font of the system is needed.
//!
//! Sizes are in nominal pixels. A figure is 640 of them wide by default and meant to be printed 85 mm wide
//! (one journal column), where its text is 6 to 7 pt high.

mod axis;
mod chart;
mod data;
mod draw;
mod figure;
mod item;
mod layout;
mod legend;
mod notes;
mod palette;
mod panel;
#[cfg(feature = "figures")]
mod raster;
mod shape;
mod sketch;
mod svg;
mod text;
mod ticks;

pub use figure::{Animation, Figure};
pub use item::{Item, ItemForm, Spot, Tint};
pub use panel::{AxisSpec, Panel, Series, Style};
pub use shape::Align;

use axis::PlotAxis;
use data::Marker;
use layout::PlacedPanel;
use palette::*;
use plotters::element::{Circle, Cross, Polygon, Rectangle};
use plotters::style::Color as _;
use shape::{Color, Drawing, Font, Paint, Pt, Rect, Shape, Stroke, Text, is_closed};
use sketch::{Done, Page, PlotChart, StrokedLine, font, line, units, words};
use text::{HALF_DIGIT, LINE_HEIGHT, Label, Rich};

#[cfg(all(test, feature = "figures"))]
mod tests;
