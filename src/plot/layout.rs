//! Layout: limits, tick marks, and the rectangle of each panel.

use super::axes::{STRIP, floor_note};
use super::axis::{Axis, Extent, Slack};
use super::color_bar::ColorBar;
use super::figure::Figure;
use super::item::Item;
use super::marks;
use super::palette::{EDGE, LABEL_SIZE, Look, NOTE_SIZE, TICK_LENGTH, TICK_SIZE, look};
use super::panel::{AxisSpec, Panel, Scale};
use super::shape::{Pt, Rect};
use super::text::{self, LINE_HEIGHT, Label};
use super::ticks::{Room, Ticks};

const LABEL_GAP: f64 = 6.0;
/// Limits of the width and the height that can be set.
const WIDTHS: (f64, f64) = (240.0, 4000.0);
const HEIGHTS: (f64, f64) = (60.0, 4000.0);

/// A panel with its axes, marks and position.
#[derive(Clone, Debug)]
pub(super) struct Placed<'a> {
    pub panel: &'a Panel,
    pub x: Axis,
    pub y: Axis,
    pub x_ticks: Ticks,
    pub y_ticks: Ticks,
    pub x_label: Label,
    pub y_label: Label,
    /// Baseline of the last line of the y label, the same in all panels.
    pub y_label_at: f64,
    pub bar: Option<ColorBar>,
    pub looks: Vec<Look>,
    pub frame: Rect,
    /// True if the x axis is labelled here, not at a panel below.
    pub shows_x: bool,
    /// Font size of texts on cells.
    pub word_size: f64,
}

impl Placed<'_> {
    /// Returns the position of a point in the picture; none if it is not a number.
    pub fn at(&self, x: f64, y: f64) -> Option<Pt> {
        let (x, y) = (self.x.place(x)?, self.y.place(y)?);
        Some((self.frame.left + x * self.frame.width(), self.frame.bottom - y * self.frame.height()))
    }

    /// Returns a rectangle between the axes (0 to 1, y up) in the picture.
    pub fn rect(&self, unit: &Rect) -> Rect {
        let (x, y) = (self.frame.left, self.frame.bottom);
        let (width, height) = (self.frame.width(), self.frame.height());
        let (left, right) = (x + unit.left * width, x + unit.right * width);
        Rect { left, right, top: y - unit.bottom * height, bottom: y - unit.top * height }
    }

    /// Returns the notes on values drawn at the floor.
    pub fn note(&self) -> String {
        let notes = [
            floor_note(&self.x, "x", "drawn at"),
            floor_note(&self.y, "", "drawn at"),
            self.bar.as_ref().and_then(ColorBar::note),
        ];
        notes.into_iter().flatten().collect::<Vec<_>>().join("; ")
    }

    /// Returns the height of the strip above the frame for factors and notes.
    pub fn strip(&self) -> f64 {
        let needed = !self.y_ticks.factor.is_empty()
            || !self.note().is_empty()
            || self.bar.as_ref().is_some_and(ColorBar::has_factor);
        if needed { STRIP } else { 0.0 }
    }

    /// Returns the height of the strip and the panel's title above it.
    pub fn above(&self) -> f64 {
        let title = if self.panel.title.trim().is_empty() { 0.0 } else { LINE_HEIGHT * TICK_SIZE + 2.0 };
        self.strip() + title
    }

    /// Returns the height of the marks and labels below the frame.
    pub fn below(&self) -> f64 {
        if !self.shows_x {
            return 0.0;
        }
        let factor = if self.x_ticks.factor.is_empty() { 0.0 } else { LINE_HEIGHT * LABEL_SIZE };
        TICK_LENGTH + 1.35 * TICK_SIZE + self.x_label.height().max(factor) + 2.0
    }

    /// Returns the distance from the y label to the frame.
    fn label_distance(&self) -> f64 {
        LABEL_GAP + self.y_ticks.widest(TICK_SIZE) + 4.0 + TICK_LENGTH
    }

    fn left_margin(&self, distance: f64) -> f64 {
        EDGE + self.y_label.height() + distance
    }

    fn right_margin(&self, width: f64) -> f64 {
        let overhang = |ticks: &Ticks| {
            let last = ticks.major.last();
            last.map_or(0.0, |tick| 0.5 * text::width(&tick.label, TICK_SIZE) - (1.0 - tick.at) * width)
        };
        EDGE + overhang(&self.x_ticks).max(2.0).max(self.bar.as_ref().map_or(0.0, ColorBar::width))
    }
}

/// Lays out all panels with frames of the same left and right border; tops and bottoms are set one by one when drawing.
pub(super) fn place(figure: &Figure) -> (f64, Vec<Placed<'_>>) {
    let whole = if figure.width.is_finite() { figure.width.clamp(WIDTHS.0, WIDTHS.1) } else { WIDTHS.0 };
    let columns = columns(figure);
    let total = whole / columns as f64;
    let shared = columns == 1 && shares_x(&figure.panels);
    let mut all = prepare(figure, shared);
    let (mut left, mut right, mut distance) = (80.0, 20.0, 0.0);
    // Marks depend on the space for them, and the space on their labels; three rounds settle it.
    for _ in 0..3 {
        let width = (total - left - right).max(60.0);
        for placed in &mut all {
            let height = frame_height(placed.panel, figure.panels.len(), width);
            fit(placed, Rect::new(left, 0.0, width, height));
        }
        distance = all.iter().map(Placed::label_distance).fold(0.0, f64::max);
        left = all.iter().map(|placed| placed.left_margin(distance)).fold(40.0, f64::max).min(0.45 * total).ceil();
        right = all.iter().map(|placed| placed.right_margin(width)).fold(0.0, f64::max).min(0.4 * total).ceil();
    }
    for (index, placed) in all.iter_mut().enumerate() {
        let begin = (total * (index % columns) as f64).round();
        placed.frame.left = begin + left + 0.5;
        placed.y_label_at = begin + left - distance - 0.22 * LABEL_SIZE;
        placed.frame.right = begin + (total - right).round() - 0.5;
        placed.word_size = marks::word_size(placed);
    }
    (whole, all)
}

/// Returns the number of panels side by side.
pub(super) fn columns(figure: &Figure) -> usize {
    figure.columns.clamp(1, figure.panels.len().max(1))
}

/// True if the panels have the same x axis.
fn shares_x(panels: &[Panel]) -> bool {
    let same = |a: &Panel, b: &Panel| a.x.scale == b.x.scale && a.x.range == b.x.range && a.x.label == b.x.label;
    panels.windows(2).all(|pair| same(&pair[0], &pair[1])) && !panels.iter().any(|panel| panel.equal_aspect)
}

fn prepare(figure: &Figure, shared: bool) -> Vec<Placed<'_>> {
    let mut extents: Vec<(Extent, Extent)> = figure.panels.iter().map(extents).collect();
    let mut slacks: Vec<Slack> = figure.panels.iter().map(|panel| slack(panel).0).collect();
    if shared {
        let mut common = Extent::default();
        extents.iter().for_each(|(x, _)| common.merge(x));
        extents.iter_mut().for_each(|(x, _)| *x = common);
        // A panel with markers needs room at the ends, and then all have it.
        let wide = slacks.iter().copied().find(|slack| matches!(slack, Slack::Part(_)));
        let common = wide.or(slacks.first().copied()).unwrap_or(Slack::Exact);
        slacks.fill(common);
    }
    let last = figure.panels.len().saturating_sub(1);
    let whole = figure.panels.iter().enumerate().zip(extents.iter().zip(slacks));
    whole.map(|((index, panel), (extent, margin))| one(panel, extent, margin, !shared || index == last)).collect()
}

fn one<'a>(panel: &'a Panel, (x, y): &(Extent, Extent), x_slack: Slack, shows_x: bool) -> Placed<'a> {
    let count = panel.series.iter().filter(|series| series.is_counted()).count();
    Placed {
        panel,
        x: Axis::new(&panel.x, x, x_slack),
        y: Axis::new(&panel.y, y, slack(panel).1),
        x_ticks: Ticks::default(),
        y_ticks: Ticks::default(),
        x_label: Label::default(),
        y_label: Label::default(),
        y_label_at: 0.0,
        bar: ColorBar::new(panel),
        looks: panel.series.iter().enumerate().map(|(index, series)| look(series, index, count)).collect(),
        frame: Rect::default(),
        shows_x,
        word_size: NOTE_SIZE,
    }
}

/// Returns the ranges that the axes must show. A point counts only if both of its coordinates are numbers.
fn extents(panel: &Panel) -> (Extent, Extent) {
    let (mut x, mut y) = (Extent::default(), Extent::default());
    let points = panel.series.iter().flat_map(|series| series.points.iter().copied());
    let colored = panel.color_series.iter().flat_map(|series| series.points.iter().map(|point| (point.0, point.1)));
    let items = panel.items.iter().flat_map(Item::data);
    let texts = panel.annotations.iter().map(|note| (note.x, note.y));
    let whole =
        points.chain(colored).chain(texts).chain(items).filter(|point| point.0.is_finite() && point.1.is_finite());
    for (at_x, at_y) in whole {
        x.add(at_x);
        y.add(at_y);
    }
    let shown = |at: &f64| panel.x.scale == Scale::Linear || *at > 0.0;
    panel.verticals.iter().map(|line| line.0).filter(shown).for_each(|at| x.add(at));
    if let Some(map) = &panel.heat_map {
        map.extend(&mut x, &mut y, (panel.x.scale, panel.y.scale));
    }
    (x, y)
}

/// Returns the margins of the axes. Functions of x fill the width, as time series do.
fn slack(panel: &Panel) -> (Slack, Slack) {
    if panel.heat_map.is_some() {
        return (Slack::Exact, Slack::Exact);
    }
    if !panel.items.is_empty() {
        return (Slack::Part(0.08), Slack::Part(0.08));
    }
    let only_functions = panel.color_series.is_empty()
        && panel.series.iter().all(|series| !series.style.has_markers() && series.is_function());
    if only_functions && !panel.equal_aspect {
        (Slack::Round, Slack::Part(0.06))
    } else {
        (Slack::Part(0.05), Slack::Part(0.06))
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

/// Chooses marks and breaks labels for a frame.
fn fit(placed: &mut Placed, frame: Rect) {
    placed.frame = frame;
    if placed.panel.equal_aspect && placed.x.scale == Scale::Linear && placed.y.scale == Scale::Linear {
        equalize(placed);
    }
    let (width, height) = (placed.frame.width(), placed.frame.height());
    placed.x_ticks = ticks(&placed.x, &placed.panel.x, Room { length: width, size: TICK_SIZE, along: true });
    placed.y_ticks = ticks(&placed.y, &placed.panel.y, Room { length: height, size: TICK_SIZE, along: false });
    placed.x_label = Label::new(&placed.panel.x.label, LABEL_SIZE, width, 2);
    placed.y_label = Label::new(&placed.panel.y.label, LABEL_SIZE, 1.08 * height, 3);
    if let Some(bar) = &mut placed.bar {
        bar.fit(height);
    }
}

fn ticks(axis: &Axis, spec: &AxisSpec, room: Room) -> Ticks {
    if spec.names.is_empty() { Ticks::new(axis, room) } else { Ticks::named(axis, &spec.names, room) }
}

/// Makes units equally long: by the height of the frame if none is set and it stays moderate, and by wider limits
/// otherwise.
fn equalize(placed: &mut Placed) {
    let (x, y) = (placed.x.high - placed.x.low, placed.y.high - placed.y.low);
    let (width, height) = (placed.frame.width(), placed.frame.height());
    if placed.panel.height.is_none() {
        let natural = (width * (y / x)).clamp(0.3 * width, height);
        placed.frame.bottom = placed.frame.top + if natural.is_finite() { natural.round() } else { height };
    }
    let unit = (x / width).max(y / placed.frame.height());
    widen(&mut placed.x, unit * width);
    widen(&mut placed.y, unit * placed.frame.height());
}

fn widen(axis: &mut Axis, span: f64) {
    let more = 0.5 * (span - (axis.high - axis.low));
    if more > 0.0 && more.is_finite() {
        (axis.low, axis.high) = (axis.low - more, axis.high + more);
    }
}
