//! Layout: limits and marks of the axes, and the size of each panel.

use super::chart::ColorBar;
use super::panel::Scale;
use super::ticks::{Room, Ticks};
use super::*;

const LABEL_GAP: f64 = 6.0;
/// Height of the strip above a frame with factors and notes.
const STRIP: f64 = 22.0;
/// Height of the marks below a frame without labels.
const MARKS: f64 = 6.0;
/// Limits of the width and the height that can be set.
const WIDTHS: (f64, f64) = (240.0, 4000.0);
const HEIGHTS: (f64, f64) = (60.0, 4000.0);

/// A panel with its axes, and the room that it needs.
#[derive(Clone, Debug)]
pub(super) struct Placed<'a> {
    pub panel: &'a Panel,
    pub x: Axis,
    pub y: Axis,
    pub x_label: Label,
    pub y_label: Label,
    pub bar: Option<ColorBar>,
    pub looks: Vec<Look>,
    /// The rectangle between the axes; before it is drawn only its size counts.
    pub frame: Rect,
    /// Distances of the frame from the left and right ends of its column, and from the label of the y axis, the same in
    /// all panels.
    pub margins: (f64, f64, f64),
    /// True if the x axis is labelled here, not at a panel below.
    pub shows_x: bool,
}

impl<'a> Placed<'a> {
    fn new(panel: &'a Panel, (x, margin): (Extent, Option<f64>), shows_x: bool) -> Self {
        let count = panel.series.iter().filter(|series| series.is_counted()).count();
        let (_, y) = extents(std::slice::from_ref(panel));
        Self {
            panel,
            x: Axis::new(&panel.x, &x, margin),
            y: Axis::new(
                &panel.y,
                &y,
                Some(if panel.heat_map.is_some() { 0.0 } else { margin.unwrap_or(0.0).max(0.06) }),
            ),
            x_label: Label::default(),
            y_label: Label::default(),
            bar: ColorBar::new(panel),
            looks: panel.series.iter().enumerate().map(|(index, series)| look(series, index, count)).collect(),
            frame: Rect::default(),
            margins: (0.0, 0.0, 0.0),
            shows_x,
        }
    }

    /// Returns the position of a point in the picture; none if it is not a number.
    pub fn at(&self, x: f64, y: f64) -> Option<Pt> {
        Some(self.frame.at(self.x.place(x)?, self.y.place(y)?))
    }

    /// Returns the values at a position in the picture.
    pub fn values(&self, (x, y): Pt) -> (f64, f64) {
        let (width, height) = self.frame.size();
        (self.x.value((x - self.frame.left) / width), self.y.value((self.frame.bottom - y) / height))
    }

    /// Returns the notes on values drawn at the floor.
    pub fn note(&self) -> String {
        let bar = self.bar.as_ref().and_then(|bar| bar.axis.note("values", "coloured as"));
        let notes = [self.x.note("x", "drawn at"), self.y.note("y", "drawn at"), bar];
        notes.into_iter().flatten().collect::<Vec<_>>().join("; ")
    }

    /// Returns the height of the strip above the frame for factors and notes.
    pub fn strip(&self) -> f64 {
        let bar = self.bar.as_ref().map_or("", |bar| &bar.axis.ticks.factor);
        if [&self.y.ticks.factor, &self.note(), bar].iter().all(|text| text.is_empty()) { 0.0 } else { STRIP }
    }

    /// Returns the height of the strip and the panel's title above it.
    pub fn above(&self) -> f64 {
        self.strip() + if self.panel.title.trim().is_empty() { 0.0 } else { 22.0 }
    }

    /// Returns the height of the marks and labels below the frame.
    pub fn below(&self) -> f64 {
        let factor = if self.x.ticks.factor.is_empty() { 0.0 } else { LINE_HEIGHT * LABEL_SIZE };
        let label = (LABEL_DISTANCE + LINE_HEIGHT * TICK_SIZE + self.x_label.height().max(factor)).round();
        if self.shows_x { label } else { MARKS }
    }

    pub fn height(&self) -> f64 {
        self.above() + self.frame.size().1 + self.below()
    }

    /// Returns the margin that this panel needs at the right.
    fn right(&self) -> f64 {
        let last = self.x.ticks.major.last().filter(|_| self.shows_x);
        let overhang = last.map_or(0.0, |(value, label)| {
            let place = self.x.place(*value).unwrap_or(1.0);
            0.5 * text::width(label, TICK_SIZE) - (1.0 - place) * self.frame.size().0
        });
        EDGE + overhang.max(2.0).max(self.bar.as_ref().map_or(0.0, ColorBar::width))
    }

    /// Chooses marks and breaks labels for a frame of this size.
    fn fit(&mut self, width: f64, height: f64) {
        self.frame = Rect::new((0.0, 0.0), (width, height));
        if self.panel.equal_aspect && [&self.x, &self.y].iter().all(|axis| axis.spec.scale == Scale::Linear) {
            self.equalize();
        }
        let height = self.frame.size().1;
        self.x.ticks = Ticks::new(&self.x, Room::Along(width));
        self.y.ticks = Ticks::new(&self.y, Room::Upwards(height));
        self.x_label = Label::new(&self.panel.x.label, LABEL_SIZE, width, 2);
        self.y_label = Label::new(&self.panel.y.label, LABEL_SIZE, 1.08 * height, 3);
        self.bar.iter_mut().for_each(|bar| bar.fit(height));
    }

    /// Makes units equally long: by the height of the frame if none is set and it stays moderate, and by wider limits
    /// otherwise.
    fn equalize(&mut self) {
        let (x, y) = (self.x.high - self.x.low, self.y.high - self.y.low);
        let (width, height) = self.frame.size();
        let natural = (width * (y / x)).max(0.3 * width).min(height).round();
        if self.panel.height.is_none() {
            self.frame.bottom = natural;
        }
        let unit = (x / width).max(y / self.frame.size().1);
        let height = self.frame.size().1;
        for (axis, span) in [(&mut self.x, unit * width), (&mut self.y, unit * height)] {
            let more = (0.5 * (span - (axis.high - axis.low))).max(0.0);
            if more.is_finite() {
                (axis.low, axis.high) = (axis.low - more, axis.high + more);
            }
        }
    }
}

/// Returns the width of the figure and its panels, whose frames have the same left and right margins.
pub(super) fn place(figure: &Figure) -> (f64, Vec<Placed<'_>>) {
    let whole = if figure.width.is_finite() { figure.width.clamp(WIDTHS.0, WIDTHS.1).round() } else { WIDTHS.0 };
    let total = whole / columns(figure) as f64;
    let mut all = panels(figure);
    let (mut left, mut right, mut distance) = (80.0, 20.0, 0.0);
    // Marks depend on the space for them, and the space on their labels; three rounds settle it.
    for _ in 0..3 {
        let width = (total - left - right).max(60.0);
        all.iter_mut().for_each(|placed| placed.fit(width, frame_height(placed.panel, figure.panels.len(), width)));
        let largest = |part: fn(&Placed) -> f64| all.iter().map(part).fold(0.0, f64::max);
        distance = LABEL_GAP + largest(|placed| placed.y.ticks.widest()) + LABEL_DISTANCE;
        left = (EDGE + largest(|placed| placed.y_label.height()) + distance).max(40.0).min(0.45 * total).ceil();
        right = largest(|placed| placed.right()).min(0.4 * total).ceil();
    }
    all.iter_mut().for_each(|placed| placed.margins = (left, right, distance));
    (whole, all)
}

/// Returns the number of panels side by side.
pub(super) fn columns(figure: &Figure) -> usize {
    figure.columns.clamp(1, figure.panels.len().max(1))
}

/// Returns the panels with their axes. Panels one above another with the same x axis share its limits.
fn panels(figure: &Figure) -> Vec<Placed<'_>> {
    let panels = &figure.panels[..];
    let same = |a: &Panel, b: &Panel| (a.x.scale, a.x.range, &a.x.label) == (b.x.scale, b.x.range, &b.x.label);
    let is_shared = columns(figure) == 1
        && panels.windows(2).all(|pair| same(&pair[0], &pair[1]))
        && !panels.iter().any(|panel| panel.equal_aspect);
    // A panel with markers needs room at the ends, and then all have it.
    let x = |panels: &[Panel]| (extents(panels).0, panels.iter().filter_map(margin).reduce(f64::max));
    let all = panels.iter().enumerate();
    if is_shared {
        return all.map(|(index, panel)| Placed::new(panel, x(panels), index + 1 == panels.len())).collect();
    }
    all.map(|(index, panel)| Placed::new(panel, x(&panels[index..=index]), true)).collect()
}

/// Returns the ranges that the axes must show. A point counts only if both of its coordinates are numbers.
fn extents(panels: &[Panel]) -> (Extent, Extent) {
    let (mut x, mut y) = (Extent::default(), Extent::default());
    for panel in panels {
        let points = panel.series.iter().flat_map(|series| series.points.iter().copied());
        let colored = panel.color_series.iter().flat_map(|series| series.points.iter().map(|point| (point.0, point.1)));
        let bands = panel.bands.iter().flat_map(|band| &band.points).flat_map(|at| [(at.0, at.1), (at.0, at.2)]);
        let texts = panel.annotations.iter().map(|note| (note.x, note.y));
        let whole = points.chain(colored).chain(bands).chain(texts).chain(panel.items.iter().flat_map(Item::data));
        for (at_x, at_y) in whole.filter(|point| point.0.is_finite() && point.1.is_finite()) {
            x.add(at_x);
            y.add(at_y);
        }
        let shown = |at: &f64| panel.x.scale == Scale::Linear || *at > 0.0;
        panel.verticals.iter().map(|line| line.0).filter(shown).for_each(|at| x.add(at));
        let map = panel.heat_map.iter();
        map.for_each(|map| map.extend(&mut x, &mut y, (panel.x.scale, panel.y.scale)));
    }
    (x, y)
}

/// Returns the margin of the x axis. Functions of x fill the width, as time series do.
fn margin(panel: &Panel) -> Option<f64> {
    let only_functions = panel.color_series.is_empty()
        && panel.series.iter().all(|series| !series.style.has_markers() && series.is_function());
    match panel.heat_map {
        Some(_) => Some(0.0),
        None if !panel.items.is_empty() => Some(0.08),
        None if only_functions && !panel.equal_aspect => None,
        None => Some(0.05),
    }
}

fn frame_height(panel: &Panel, count: usize, width: f64) -> f64 {
    let usual = match count {
        _ if panel.equal_aspect => 0.85 * width,
        _ if panel.heat_map.is_some() && count == 1 => 0.75 * width,
        0 | 1 => 340.0,
        2 => 240.0,
        _ => 190.0,
    };
    panel.height.filter(|height| height.is_finite()).unwrap_or(usual).clamp(HEIGHTS.0, HEIGHTS.1).round()
}
