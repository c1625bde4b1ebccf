//! Lines and points of a panel.

/// Style of a series.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Style {
    /// A line; one of eight or more lines in a panel gets dashes as well, to be told apart in grey.
    #[default]
    Line,
    /// A dashed line.
    Dashed,
    /// A dotted line.
    Dotted,
    /// A thin line.
    Thin,
    /// A thin grey dashed line that helps to read the others.
    Guide,
    /// A marker at every point.
    Dots,
    /// A line with a marker at every point.
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
    /// Line, dashes, dots.
    pub style: Style,
    /// Index in the palette (seven colours, repeated); the index in the panel if none.
    pub color: Option<usize>,
}

impl Series {
    /// A line.
    pub fn line(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self { label: label.into(), points, ..Self::default() }
    }

    /// Separate points.
    pub fn dots(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self::line(label, points).style(Style::Dots)
    }

    /// Sets the style.
    pub fn style(self, style: Style) -> Self {
        Self { style, ..self }
    }

    /// Sets the colour by its index in the palette.
    pub fn color(self, color: usize) -> Self {
        Self { color: Some(color), ..self }
    }
}
