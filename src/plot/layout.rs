//! Layout: limits and marks of the axes, and the size of each panel.

use super::ticks::Room;
use super::*;

/// Height of the strip above a frame with factors, and of a title above that.
const STRIP: f64 = 22.0;

/// A panel with its axes, and the room that it needs.
pub(super) struct PlacedPanel<'a> {
    pub panel: &'a Panel,
    pub x: PlotAxis,
    pub y: PlotAxis,
    /// The axis of the colour bar, if anything is coloured.
    pub bar: Option<PlotAxis>,
    pub looks: Vec<Look>,
    /// The rectangle between the axes; before it is drawn only its size counts.
    pub frame: Rect,
    /// Room at the left of the frame for labels, and at its right, the same in all panels.
    pub margins: (f64, f64),
    /// True if the x axis is labelled here, not at a panel below.
    pub shows_x: bool,
}

impl<'a> PlacedPanel<'a> {
    /// The panel, whose x axis is that of a group.
    fn new(panel: &'a Panel, group: &[Panel], shows_x: bool) -> Self {
        // A panel with markers needs room at the ends, and then all have it.
        let margin = group.iter().filter_map(margin).reduce(f64::max);
        let value = |item: &Item| if let Tint::Value(value) = item.tint { Some(value) } else { None };
        let mut colors = panel.items.iter().filter_map(value).peekable();
        Self {
            panel,
            x: PlotAxis::new(&panel.x, group.iter().flat_map(points).map(|point| point.0), margin),
            y: PlotAxis::new(&panel.y, points(panel).map(|point| point.1), Some(margin.unwrap_or(0.0).max(0.06))),
            bar: colors.peek().is_some().then(|| PlotAxis::new(&panel.colors, colors, None)),
            looks: looks(&panel.series),
            frame: Rect::default(),
            margins: (0.0, 0.0),
            shows_x,
        }
    }

    pub fn color(&self, tint: Tint) -> Color {
        let pale = |color, paleness: f64| mix(color, PAPER, paleness.clamp(0.0, 1.0));
        match tint {
            Tint::Ink(paleness) => pale(INK, paleness),
            Tint::Body(place, paleness) => pale(COLORS[place % COLORS.len()], paleness),
            Tint::Value(value) => {
                let place = self.bar.as_ref().and_then(|bar| bar.place(value));
                place.map_or(PAPER, |place| scale_color((place * COLOR_STEPS as f64) as usize))
            }
        }
    }

    /// Returns the height of the strip above the frame for factors.
    pub fn strip(&self) -> f64 {
        let has_factor = self.bar.iter().chain([&self.y]).any(|axis| !axis.ticks.factor.is_empty());
        if has_factor { STRIP } else { 0.0 }
    }

    fn above(&self) -> f64 {
        self.strip() + if self.panel.title.trim().is_empty() { 0.0 } else { STRIP }
    }

    pub fn below(&self) -> f64 {
        let factor = if self.x.ticks.factor.is_empty() { 0.0 } else { LINE_HEIGHT * LABEL_SIZE };
        let label = LABEL_DISTANCE + LINE_HEIGHT * TICK_SIZE + self.x.label.height().max(factor);
        if self.shows_x { label.round() } else { 6.0 }
    }

    /// Puts the frame into a column of the figure, and returns the lower end of the panel.
    pub fn put(&mut self, start: f64, width: f64, top: f64) -> f64 {
        let end = top + self.above() + self.frame.size().1 + self.below();
        // The frame lies in the middle of pixels, where its lines are sharp.
        let left = (start + self.frame.left).round() + 0.5;
        let right = start + width - self.margins.1 - 0.51;
        self.frame = Rect { left, top: top + self.above() + 0.5, right, bottom: end - self.below() + 0.49 };
        self.margins.0 = self.margins.0.min(left - start);
        end
    }

    fn right(&self) -> f64 {
        let overhang = self.x.ticks.major.last().map_or(0.0, |(value, label)| {
            let place = self.x.place(*value).unwrap_or(1.0);
            0.5 * text::width(label, TICK_SIZE) - (1.0 - place) * self.frame.size().0
        });
        EDGE + overhang.max(2.0).max(self.bar.as_ref().map_or(0.0, chart::bar_width))
    }

    fn fit(&mut self, width: f64, height: f64) {
        self.frame = Rect::new((0.0, 0.0), (width, height));
        if self.panel.equal_aspect && [&self.x, &self.y].iter().all(|axis| !axis.spec.is_log) {
            self.equalize();
        }
        let upright = Room { length: self.frame.size().1, is_upright: true };
        self.x.fit(Room { length: width, is_upright: false }, self.shows_x);
        self.bar.iter_mut().chain([&mut self.y]).for_each(|axis| axis.fit(upright, true));
    }

    /// Makes units equally long: by the height of the frame if it stays moderate, and by wider limits otherwise.
    fn equalize(&mut self) {
        let x = self.x.high - self.x.low;
        let y = self.y.high - self.y.low;
        let (width, height) = self.frame.size();
        let height = (width * (y / x)).max(0.3 * width).min(height).round();
        self.frame.bottom = height;
        let unit = (x / width).max(y / height);
        for (axis, span) in [(&mut self.x, unit * width), (&mut self.y, unit * height)] {
            let more = (0.5 * (span - (axis.high - axis.low))).max(0.0);
            if more.is_finite() {
                (axis.low, axis.high) = (axis.low - more, axis.high + more);
            }
        }
    }
}

/// Returns the width of the figure and its panels, whose frames have the same left and right margins.
pub(super) fn place(figure: &Figure) -> (f64, Vec<PlacedPanel<'_>>) {
    let whole = if figure.width.is_finite() { figure.width.clamp(240.0, 4000.0).round() } else { 240.0 };
    let total = whole / columns(figure) as f64;
    let mut all = panels(figure);
    let mut left = 80.0;
    let mut right = 20.0;
    // Marks depend on the space for them, and the space on their labels; three rounds settle it.
    for _ in 0..3 {
        let width = (total - left - right).max(60.0);
        all.iter_mut().for_each(|placed| placed.fit(width, frame_height(placed.panel, figure.panels.len(), width)));
        let largest = |part: fn(&PlacedPanel) -> f64| all.iter().map(part).fold(0.0, f64::max);
        let distance = 6.0 + largest(|placed| placed.y.ticks.widest()) + LABEL_DISTANCE;
        left = (EDGE + largest(|placed| placed.y.label.height()) + distance).max(40.0).min(0.45 * total).ceil();
        right = largest(|placed| placed.right()).min(0.4 * total).ceil();
        for placed in &mut all {
            placed.margins = (distance + placed.y.label.height(), right);
        }
    }
    all.iter_mut().for_each(|placed| placed.frame.left = left);
    (whole, all)
}

pub(super) fn columns(figure: &Figure) -> usize {
    figure.columns.clamp(1, figure.panels.len().max(1))
}

/// Returns the panels with their axes. Panels one above another with the same x axis share its limits.
fn panels(figure: &Figure) -> Vec<PlacedPanel<'_>> {
    let panels = &figure.panels[..];
    let is_like_first = |panel: &Panel| panel.x == panels[0].x && !panel.equal_aspect;
    let is_shared = columns(figure) == 1 && panels.iter().all(is_like_first);
    let place = |index: usize| {
        let group = if is_shared { panels } else { &panels[index..=index] };
        PlacedPanel::new(&panels[index], group, !is_shared || index + 1 == panels.len())
    };
    (0..panels.len()).map(place).collect()
}

/// Returns the points that the axes must show. One of the data counts only if both of its coordinates are numbers.
fn points(panel: &Panel) -> impl Iterator<Item = Pt> + '_ {
    let data = panel.series.iter().flat_map(|series| series.points.iter().copied());
    let whole = data.filter(|point| point.0.is_finite() && point.1.is_finite());
    let spots = panel.items.iter().flat_map(|item| &item.spots).map(|spot| spot.at);
    whole.chain(spots)
}

/// Returns the margin of the x axis. Functions of x fill the width, as time series do.
fn margin(panel: &Panel) -> Option<f64> {
    let has_markers = |series: &Series| matches!(series.style, Style::Dots | Style::LineDots | Style::Crosses);
    let is_function = |series: &Series| series.points.windows(2).all(|pair| pair[1].0 >= pair[0].0);
    let is_plain = |series: &Series| is_function(series) && !has_markers(series);
    let is_full = !panel.equal_aspect && panel.series.iter().all(is_plain);
    (!is_full).then_some(0.05)
}

fn frame_height(panel: &Panel, count: usize, width: f64) -> f64 {
    let usual = match count {
        _ if panel.equal_aspect => 0.85 * width,
        0 | 1 => 340.0,
        2 => 240.0,
        _ => 190.0,
    };
    panel.height.filter(|height| height.is_finite()).unwrap_or(usual).clamp(60.0, 4000.0).round()
}
