//! The data of a panel: lines, points and coloured points.

use super::*;

/// Largest number of points of one figure, so that its file stays small.
const LINE_POINTS: usize = 16_000;
const DOTS: usize = 12_000;
/// Coloured points need more space, each colour being a shape of its own.
const COLORED: usize = 4_000;
const DOT_RADIUS: f64 = 2.7;
/// A line that changes its vertical direction by more than this, in pixels, more often than once in this many pixels,
/// is restless.
const RESTLESS: f64 = 4.0;

/// Shape of a point; polygons have their corners in radii.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Marker {
    Circle,
    Cross,
    Polygon(&'static [Pt]),
}

impl Marker {
    pub fn draw(self, page: &Page, (x, y): Pt, radius: f64, color: Color) -> Done {
        let at = |(right, down): &Pt| (x + radius * right, y + radius * down);
        match self {
            Self::Circle => page.draw(&Circle::new((x, y), units(radius), color.filled())),
            Self::Polygon(corners) => page.draw(&Polygon::new(corners.iter().map(at).collect::<Vec<_>>(), color)),
            Self::Cross => {
                let stroke = Stroke { color, width: 0.42 * radius, dash: &[] };
                let ends = [[(-0.9, -0.81), (0.9, 0.81)], [(-0.9, 0.81), (0.9, -0.81)]];
                ends.iter().try_for_each(|ends| page.draw(&Curve(ends.iter().map(at).collect(), stroke)))
            }
        }
    }
}

/// Draws lines and points of a panel, in a figure of `count` series: restless lines below calm ones, then markers, then
/// coloured points.
pub(super) fn series(page: &Page, placed: &Placed, count: usize) -> Done {
    let runs = |series: &Series| runs(placed, series);
    let all: Vec<(&Look, Vec<Vec<Pt>>)> = placed.looks.iter().zip(placed.panel.series.iter().map(runs)).collect();
    let lines = all.iter().filter_map(|(look, runs)| Some(lines(placed, look.line?, runs, count)));
    let (restless, calm): (Vec<_>, Vec<_>) = lines.partition(|(is_restless, ..)| *is_restless);
    for (_, stroke, parts) in restless.into_iter().chain(calm) {
        parts.into_iter().try_for_each(|part| page.draw(&Curve(part, stroke)))?;
    }
    all.iter().try_for_each(|(look, runs)| markers(page, placed, look, runs, count))?;
    colored(page, placed)
}

/// Returns the points in the picture, split where one of them is not a number.
fn runs(placed: &Placed, series: &Series) -> Vec<Vec<Pt>> {
    let places: Vec<Option<Pt>> = series.points.iter().map(|point| placed.at(point.0, point.1)).collect();
    places.split(Option::is_none).map(|run| run.iter().flatten().copied().collect()).collect()
}

/// Returns the lines of a series with their stroke, and true if they are restless: these are thin, since at full width
/// they would be one blot.
fn lines(placed: &Placed, mut stroke: Stroke, runs: &[Vec<Pt>], count: usize) -> (bool, Stroke, Vec<Vec<Pt>>) {
    let full = runs.iter().map(Vec::len).sum::<usize>().max(1);
    let most = |run: &[Pt]| ((LINE_POINTS / count).max(200) * run.len() / full).max(8);
    let thinned = runs.iter().map(|run| thin::clipped(&thin::line(run, most(run)), &placed.frame));
    let parts: Vec<Vec<Pt>> = thinned.flatten().collect();
    let is_restless = parts.iter().map(|part| turns(part)).sum::<usize>() as f64 > placed.frame.size().0 / RESTLESS;
    stroke.width *= if is_restless { 0.5 } else { 1.0 };
    (is_restless, stroke, parts)
}

/// Returns how often a line changes its vertical direction visibly.
fn turns(points: &[Pt]) -> usize {
    let steps = points.windows(2).map(|pair| pair[1].1 - pair[0].1).filter(|step| step.abs() > RESTLESS);
    let signs: Vec<bool> = steps.map(|step| step > 0.0).collect();
    signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

fn markers(page: &Page, placed: &Placed, look: &Look, runs: &[Vec<Pt>], count: usize) -> Done {
    // A single point between two gaps has no line; a dot of the line's width would be missed.
    let marked = runs.iter().filter(|run| look.marker.is_some() || run.len() == 1);
    let points: Vec<Pt> = marked.flatten().copied().filter(|point| placed.frame.contains(*point)).collect();
    let kept = thin::dots(&points, (DOTS / count).max(60));
    let crowd = usize::from(kept.len() > 150) + usize::from(kept.len() > 2000);
    let radius = if look.marker.is_some() { MARKER_RADIUS * [1.0, 0.6, 0.35][crowd] } else { DOT_RADIUS };
    let marker = look.marker.unwrap_or(Marker::Circle);
    kept.into_iter().try_for_each(|i| marker.draw(page, points[i], radius, look.color))
}

/// Draws points coloured by value, in their order, so that later ones stay on top.
fn colored(page: &Page, placed: &Placed) -> Done {
    let points = placed.panel.colored.iter();
    let known = points.filter_map(|point| Some((placed.at(point.0, point.1)?, placed.step(point.2)?)));
    let (places, steps): (Vec<Pt>, Vec<usize>) = known.filter(|(point, _)| placed.frame.contains(*point)).unzip();
    let mut kept = thin::dots(&places, COLORED);
    if kept.chunk_by(|a, b| steps[*a] == steps[*b]).count() > COLORED / 4 {
        // Colours without order: grouping them all keeps the file small, and which is on top is arbitrary anyway.
        kept.sort_by_key(|i| steps[*i]);
    }
    kept.into_iter().try_for_each(|i| Marker::Circle.draw(page, places[i], DOT_RADIUS, scale_color(steps[i])))
}
