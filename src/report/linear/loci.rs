//! Eigenvalues in the complex plane.

use super::damping::{Ray, rays};
use super::pairs::are_conjugate;
use super::range::{drawn, padded, robust};
use crate::error::short;
use crate::linearize::{Branch, Complex, Kind};
use crate::plot::{AxisSpec, ColorSeries, Figure, Panel, Series, Style, Tint};
use std::collections::BTreeMap;

/// Free part of an axis at both ends.
const FREE: f64 = 0.06;
/// An axis is at least this part of the other one long, so that round-off does not fill it.
const LEAST: f64 = 0.02;
/// Places in the palette.
const VERMILION: usize = 1;
const BLACK: usize = 6;
/// About the pixels between the axes, across and up.
const PIXELS: (f64, f64) = (440.0, 400.0);

/// Ranges of real and imaginary parts.
#[derive(Clone, Copy, Debug)]
struct Window {
    re: (f64, f64),
    im: (f64, f64),
}

/// The eigenvalues with time or a parameter as colour, which `along` names with its unit. Only the upper half is drawn
/// where the lower one is its mirror image; the axes follow the physical eigenvalues and those
/// that may be. `None` without finite eigenvalues.
pub fn loci_figure(title: &str, along: impl Into<AxisSpec>, branches: &[Branch]) -> Option<Figure> {
    let along = along.into();
    let (drawn, left_out) = drawn(branches);
    let branches = drawn.as_slice();
    let is_upper = are_mirrored(branches);
    let shown: Vec<Branch> = branches.iter().map(|branch| finite(branch, is_upper)).collect();
    let of = |kind: Kind| shown.iter().filter(move |branch| branch.kind == kind);
    let physical = || of(Kind::Physical).chain(of(Kind::Uncertain));
    let window = window(physical(), is_upper).or_else(|| window(of(Kind::Spurious), is_upper))?;
    let axis = |label: &str, (low, high): (f64, f64)| AxisSpec::from(label).range(low, high);
    let mut panel = Panel::new(axis("real part (1/s)", window.re), axis("imaginary part (rad/s)", window.im))
        .height(PIXELS.1)
        .title(if left_out.is_empty() { outside_note(&shown, &window) } else { left_out });
    panel = frame_lines(panel, &window, is_upper);
    for (kind, name, style) in
        [(Kind::Spurious, "spurious", Style::Crosses), (Kind::Uncertain, "uncertain", Style::Dots)]
    {
        let others = points(of(kind)).map(|(_, value)| (value.re, value.im)).collect::<Vec<_>>();
        if !others.is_empty() {
            panel = panel.series(Series::dots(name, others).style(style).color(VERMILION));
        }
    }
    panel = panel.series(Series::line("", joined(of(Kind::Physical))).style(Style::Thin).color(BLACK));
    let colored: Vec<(f64, f64, f64)> =
        points(of(Kind::Physical)).map(|(at, value)| (value.re, value.im, at)).collect();
    if !colored.is_empty() {
        panel = panel.color_series(ColorSeries { scale: along.scale, ..ColorSeries::new(along.label, colored) });
    }
    Some(Figure::new().title(title).panel(panel))
}

/// The finite points of a branch; those below the real axis become gaps where only the upper half is drawn.
fn finite(branch: &Branch, is_upper: bool) -> Branch {
    let is_shown = |value: Complex<f64>| {
        value.re.is_finite() && value.im.is_finite() && !(is_upper && value.im < 0.0) && branch.kind != Kind::Infinite
    };
    let gap = Complex::new(f64::NAN, f64::NAN);
    let points = branch.points.iter().map(|(at, value)| (*at, if is_shown(*value) { *value } else { gap }));
    Branch { kind: branch.kind, points: points.collect() }
}

fn points<'a>(branches: impl Iterator<Item = &'a Branch>) -> impl Iterator<Item = (f64, Complex<f64>)> {
    branches.flat_map(|branch| &branch.points).copied().filter(|(_, value)| value.re.is_finite())
}

/// The branches as one line with gaps. Between two states a pair becomes real at the axis, not on the way to it.
fn joined<'a>(branches: impl Iterator<Item = &'a Branch>) -> Vec<(f64, f64)> {
    let mut line = Vec::new();
    for branch in branches {
        for (i, (_, value)) in branch.points.iter().enumerate() {
            let before = i.checked_sub(1).map_or(*value, |before| branch.points[before].1);
            if (before.im == 0.0) != (value.im == 0.0) {
                line.push((if value.im == 0.0 { before.re } else { value.re }, 0.0));
            }
            line.push((value.re, value.im));
        }
        line.push((f64::NAN, f64::NAN));
    }
    line
}

/// Whether every eigenvalue below the real axis has its conjugate at the same place of time or parameter.
fn are_mirrored(branches: &[Branch]) -> bool {
    let mut upper: BTreeMap<u64, Vec<Complex<f64>>> = BTreeMap::new();
    let all = || branches.iter().flat_map(|branch| &branch.points);
    all()
        .filter(|(_, value)| value.im > 0.0)
        .for_each(|(at, value)| upper.entry(at.to_bits()).or_default().push(*value));
    let has_partner = |at: f64, value: Complex<f64>| {
        upper.get(&at.to_bits()).is_some_and(|list| list.iter().any(|other| are_conjugate(*other, value)))
    };
    all().filter(|(_, value)| value.im < 0.0).all(|(at, value)| has_partner(*at, *value))
}

fn window<'a>(branches: impl Iterator<Item = &'a Branch>, is_upper: bool) -> Option<Window> {
    let mut values: Vec<Complex<f64>> = points(branches).map(|(_, value)| value).collect();
    // Far off is what is large: a real part that is rare may still be small beside the others' imaginary parts.
    let (_, largest) = robust(values.iter().map(|value| value.norm()))?;
    values.retain(|value| value.norm() <= largest);
    let extent = |part: fn(&Complex<f64>) -> f64| {
        let parts = values.iter().map(part);
        (parts.clone().fold(f64::INFINITY, f64::min), parts.fold(f64::NEG_INFINITY, f64::max))
    };
    let (re, im) = (extent(|value| value.re), extent(|value| value.im));
    let size = [re.0, re.1, im.0, im.1].into_iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    let least = if size > 0.0 { LEAST * size } else { 1.0 };
    let re = with_zero(re, 2.0 * least);
    let im = if is_upper { (0.0, im.1.max(0.0)) } else { with_zero(im, 2.0 * least) };
    Some(Window { re: padded(re, FREE, 2.0 * least), im: padded(im, FREE, 2.0 * least) })
}

/// The range with zero in it, unless it is far away.
fn with_zero((low, high): (f64, f64), least: f64) -> (f64, f64) {
    let near = 2.0 * (high - low).max(least);
    match () {
        _ if low > 0.0 && low <= near => (0.0, high),
        _ if high < 0.0 && -high <= near => (low, 0.0),
        _ => (low, high),
    }
}

/// The axes of the plane and lines of constant damping.
fn frame_lines(panel: Panel, window: &Window, is_upper: bool) -> Panel {
    let Window { re, im } = *window;
    let across = Series::line("", vec![(re.0, 0.0), (re.1, 0.0)]).style(Style::Thin).color(BLACK);
    let up = Series::line("", vec![(0.0, im.0), (0.0, im.1)]).color(BLACK);
    let pixels = (PIXELS.0 / (re.1 - re.0), PIXELS.1 / (im.1 - im.0));
    let rays = rays(re.0, im.1, pixels);
    let (origin, gap) = ((0.0, 0.0), (f64::NAN, f64::NAN));
    let line = |ray: &Ray| {
        let lower = if is_upper { gap } else { (ray.end.0, -ray.end.1) };
        [ray.end, origin, lower, gap]
    };
    let guide = Series::line("", rays.iter().flat_map(line).collect()).style(Style::Guide);
    let panel = panel.series(guide).series(across).series(up);
    rays.iter().fold(panel, |panel, ray| {
        let (x, y) = (0.93 * ray.end.0, 0.93 * ray.end.1);
        panel.annotate_in(Tint::Ink(0.4), x, y, format!("ζ = {}", short(ray.ratio)))
    })
}

/// How many points lie outside the axes.
fn outside_note(shown: &[Branch], window: &Window) -> String {
    let inside = |value: Complex<f64>| {
        (window.re.0..=window.re.1).contains(&value.re) && (window.im.0..=window.im.1).contains(&value.im)
    };
    let count = |kind: Kind| {
        points(shown.iter().filter(|branch| branch.kind == kind)).filter(|(_, value)| !inside(*value)).count()
    };
    let kinds = [
        (count(Kind::Physical), "physical"),
        (count(Kind::Uncertain), "uncertain"),
        (count(Kind::Spurious), "spurious"),
    ];
    let words: Vec<String> =
        kinds.iter().filter(|(count, _)| *count > 0).map(|(count, kind)| format!("{count} {kind}")).collect();
    match (words.is_empty(), kinds.iter().map(|(count, _)| count).sum::<usize>()) {
        (true, _) => String::new(),
        (_, 1) => format!("{} point lies outside", words.join(" and ")),
        _ => format!("{} points lie outside", words.join(" and ")),
    }
}
