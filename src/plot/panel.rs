//! One panel: axes, and the data drawn between them.

use super::{Form, Item, Series, Spot, Tint};

/// Map from values to lengths.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scale {
    /// Equal lengths for equal differences.
    #[default]
    Linear,
    /// Equal lengths for equal ratios. Zero and negative values lie below the frame.
    Log,
}

/// Label, scale and limits of an axis. Made from its label: `"time (s)".into()`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AxisSpec {
    /// Quantity and unit, like `"position drift (m)"`. Numbers after `^` are set as superscripts.
    pub label: String,
    /// Linear or logarithmic.
    pub scale: Scale,
    /// Fixed limits; taken from the data when absent or unusable.
    pub range: Option<(f64, f64)>,
    /// True if values are angles in degrees, with marks at multiples of 15, 45, 90 ...
    pub is_angle: bool,
    /// Texts at 0, 1, 2 ... that replace numbers.
    pub names: Vec<String>,
}

impl<T: Into<String>> From<T> for AxisSpec {
    fn from(label: T) -> Self {
        Self { label: label.into(), ..Self::default() }
    }
}

impl AxisSpec {
    /// Makes the axis logarithmic.
    pub fn log(self) -> Self {
        Self { scale: Scale::Log, ..self }
    }

    /// Sets fixed limits.
    pub fn range(self, low: f64, high: f64) -> Self {
        Self { range: Some((low, high)), ..self }
    }
}

/// Axes and the data drawn between them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Panel {
    /// Title above the axes; may be empty.
    pub title: String,
    /// The horizontal axis.
    pub x: AxisSpec,
    /// The vertical axis.
    pub y: AxisSpec,
    /// Lines and points.
    pub series: Vec<Series>,
    /// The axis of the colour bar, of which values beyond the limits have the colour of the limit.
    pub colors: AxisSpec,
    /// Points coloured by a third value on the colour bar.
    pub colored: Vec<(f64, f64, f64)>,
    /// Items drawn on top of the series, in this order.
    pub items: Vec<Item>,
    /// Colours that the legend explains in addition to the series.
    pub keys: Vec<(String, Tint)>,
    /// True if one unit of x is as long as one unit of y (both linear).
    pub equal_aspect: bool,
    /// Height between the axes in nominal pixels; chosen if none.
    pub height: Option<f64>,
}

impl Panel {
    /// An empty panel between two axes.
    pub fn new(x: impl Into<AxisSpec>, y: impl Into<AxisSpec>) -> Self {
        Self { x: x.into(), y: y.into(), ..Self::default() }
    }

    /// Sets the title.
    pub fn title(self, title: impl Into<String>) -> Self {
        Self { title: title.into(), ..self }
    }

    /// Adds a series.
    pub fn series(mut self, series: Series) -> Self {
        self.series.push(series);
        self
    }

    /// Adds items to draw.
    pub fn items(mut self, items: impl IntoIterator<Item = Item>) -> Self {
        self.items.extend(items);
        self
    }

    /// Adds a text at the side of a point where it hides least.
    pub fn note(mut self, tint: Tint, x: f64, y: f64, text: impl Into<String>) -> Self {
        self.items.push(Item { spots: vec![Spot::data(x, y)], tint, form: Form::Note(text.into()) });
        self
    }

    /// Sets the height between the axes, in nominal pixels.
    pub fn height(self, height: f64) -> Self {
        Self { height: Some(height), ..self }
    }
}
