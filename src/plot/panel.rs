//! One panel: axes, and the data drawn between them.

use super::heat::HeatMap;
use super::item::{Item, Tint};
use super::series::{Band, ColorSeries, Series};

/// Map from values to lengths.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scale {
    /// Equal lengths for equal differences.
    #[default]
    Linear,
    /// Equal lengths for equal ratios. Zero and negative values are drawn at a floor, which the figure states.
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

impl From<&str> for AxisSpec {
    fn from(label: &str) -> Self {
        Self { label: label.to_string(), ..Self::default() }
    }
}

impl From<String> for AxisSpec {
    fn from(label: String) -> Self {
        Self { label, ..Self::default() }
    }
}

impl AxisSpec {
    /// Makes the axis logarithmic.
    pub fn log(self) -> Self {
        Self { scale: Scale::Log, ..self }
    }

    /// Makes the axis one of angles in degrees.
    pub fn degrees(self) -> Self {
        Self { is_angle: true, ..self }
    }

    /// Sets texts at 0, 1, 2 ... that replace numbers.
    pub fn names(self, names: impl IntoIterator<Item = String>) -> Self {
        Self { names: names.into_iter().collect(), ..self }
    }

    /// Sets fixed limits.
    pub fn range(self, low: f64, high: f64) -> Self {
        Self { range: Some((low, high)), ..self }
    }
}

/// A text near a point in data coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct Annotation {
    /// x of the point.
    pub x: f64,
    /// y of the point.
    pub y: f64,
    /// The text.
    pub text: String,
    /// Its colour.
    pub tint: Tint,
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
    /// Points coloured by a third value; all of a panel share one colour bar.
    pub color_series: Vec<ColorSeries>,
    /// A map of cells below everything else; it shares the colour bar.
    pub heat_map: Option<HeatMap>,
    /// Coloured areas below the series.
    pub bands: Vec<Band>,
    /// True if thin lines are drawn through zero.
    pub zero_lines: bool,
    /// Dashed vertical lines: x and label, which may be empty.
    pub verticals: Vec<(f64, String)>,
    /// Texts at points.
    pub annotations: Vec<Annotation>,
    /// Items drawn on top of the series, in this order.
    pub items: Vec<Item>,
    /// A small drawing around (0, 0), placed in the corner where it hides least.
    pub inset: Vec<Item>,
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

    /// Adds points coloured by a third value.
    pub fn color_series(mut self, series: ColorSeries) -> Self {
        self.color_series.push(series);
        self
    }

    /// Adds a coloured area below the series.
    pub fn band(mut self, band: Band) -> Self {
        self.bands.push(band);
        self
    }

    /// Draws thin lines through zero.
    pub fn zero_lines(self) -> Self {
        Self { zero_lines: true, ..self }
    }

    /// Sets the map of cells.
    pub fn heat_map(self, map: HeatMap) -> Self {
        Self { heat_map: Some(map), ..self }
    }

    /// Adds a dashed vertical line at `x`.
    pub fn vertical(mut self, x: f64, label: impl Into<String>) -> Self {
        self.verticals.push((x, label.into()));
        self
    }

    /// Adds a text at a point.
    pub fn annotate(self, x: f64, y: f64, text: impl Into<String>) -> Self {
        self.annotate_in(Tint::Ink(0.0), x, y, text)
    }

    /// Adds items to draw.
    pub fn items(mut self, items: impl IntoIterator<Item = Item>) -> Self {
        self.items.extend(items);
        self
    }

    /// Adds a text in a colour at a point.
    pub fn annotate_in(mut self, tint: Tint, x: f64, y: f64, text: impl Into<String>) -> Self {
        self.annotations.push(Annotation { x, y, text: text.into(), tint });
        self
    }

    /// Makes one unit of x as long as one unit of y.
    pub fn equal_aspect(self) -> Self {
        Self { equal_aspect: true, ..self }
    }

    /// Sets the height between the axes, in nominal pixels.
    pub fn height(self, height: f64) -> Self {
        Self { height: Some(height), ..self }
    }
}
