//! One panel: axes, and the data drawn between them.

use super::{Item, ItemForm, Spot, Tint};

/// Label, scale and limits of an axis. Made from its label: `"time (s)".into()`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AxisSpec {
    /// Quantity and unit, like `"position drift (m)"`. Numbers after `^` are set as superscripts.
    pub label: String,
    /// True if equal lengths are equal ratios; zero and negative values then lie below the frame.
    pub is_log: bool,
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
    pub fn log(self) -> Self {
        Self { is_log: true, ..self }
    }

    pub fn range(self, low: f64, high: f64) -> Self {
        Self { range: Some((low, high)), ..self }
    }
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Style {
    /// A line; one of eight or more lines in a panel gets dashes as well, to be told apart in grey.
    #[default]
    Line,
    Dashed,
    Dotted,
    Thin,
    /// A thin grey dashed line that helps to read the others.
    Guide,
    Dots,
    LineDots,
    /// A small grey cross at every point, for data in the background.
    Crosses,
}

/// Points that belong together. A NaN or an infinity breaks the line.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    /// Name in the legend; empty: not listed.
    pub label: String,
    /// (x, y), in drawing order.
    pub points: Vec<(f64, f64)>,
    pub style: Style,
    /// Index in the palette (seven colours, repeated); the index in the panel if none.
    pub color: Option<usize>,
}

impl Series {
    pub fn line(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self { label: label.into(), points, ..Self::default() }
    }

    pub fn dots(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self::line(label, points).style(Style::Dots)
    }

    pub fn style(self, style: Style) -> Self {
        Self { style, ..self }
    }

    pub fn color(self, color: usize) -> Self {
        Self { color: Some(color), ..self }
    }
}

/// Axes and the data drawn between them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Panel {
    pub title: String,
    pub x: AxisSpec,
    pub y: AxisSpec,
    pub series: Vec<Series>,
    /// The axis of the colour bar, of which values beyond the limits have the colour of the limit.
    pub colors: AxisSpec,
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
    pub fn new(x: impl Into<AxisSpec>, y: impl Into<AxisSpec>) -> Self {
        Self { x: x.into(), y: y.into(), ..Self::default() }
    }

    pub fn title(self, title: impl Into<String>) -> Self {
        Self { title: title.into(), ..self }
    }

    pub fn series(mut self, series: Series) -> Self {
        self.series.push(series);
        self
    }

    pub fn items(mut self, items: impl IntoIterator<Item = Item>) -> Self {
        self.items.extend(items);
        self
    }

    /// Adds a text at the side of a point where it hides least.
    pub fn note(mut self, tint: Tint, x: f64, y: f64, text: impl Into<String>) -> Self {
        self.items.push(Item { spots: vec![Spot::data(x, y)], tint, form: ItemForm::Note(text.into()) });
        self
    }

    pub fn height(self, height: f64) -> Self {
        Self { height: Some(height), ..self }
    }
}
