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
    /// A line with markers, not at every point when they would touch.
    LineDots,
    /// A small grey cross at every point, for data in the background.
    Crosses,
}

impl Style {
    /// True if the points are joined.
    pub(super) fn has_line(self) -> bool {
        !matches!(self, Self::Dots | Self::Crosses)
    }

    /// True if the points have markers.
    pub(super) fn has_markers(self) -> bool {
        matches!(self, Self::Dots | Self::LineDots | Self::Crosses)
    }
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

    /// True if it is one of the lines that are distinguished by colours and, where they are many, by dashes.
    pub(super) fn is_counted(&self) -> bool {
        !matches!(self.style, Style::Dashed | Style::Dotted | Style::Guide | Style::Crosses)
    }

    /// True if x never decreases, as in a function of time.
    pub(super) fn is_function(&self) -> bool {
        self.points.windows(2).all(|pair| pair[1].0 >= pair[0].0)
    }
}
