//! Eigenvalues in the complex plane, and frequency and damping of the modes over time or a parameter.

use crate::error::short;
use crate::linearize::{Branch, Complex, Kind, are_conjugate};
use crate::math::{bounds, largest};
use crate::plot::{AxisSpec, ColorSeries, Figure, Panel, Series, Style, Tint};
use crate::tolerances::linearize as tolerances;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// Margin of an axis at both ends, as a part of its length.
const FREE: f64 = 0.06;
/// Least length of an axis relative to the other one, so that round-off does not fill it.
const LEAST: f64 = 0.02;
/// Colours, as indices in the palette.
const VERMILION: usize = 1;
const BLACK: usize = 6;
/// Approximate size of the plane in pixels.
const PIXELS: (f64, f64) = (440.0, 400.0);

/// Ranges of real and imaginary parts.
#[derive(Clone, Copy, Debug)]
struct Window {
    re: (f64, f64),
    im: (f64, f64),
}

/// Draws the eigenvalues in the complex plane, coloured by time or a parameter, which `along` names with its unit. Only
/// the upper half is drawn where the lower one is its mirror image; the axes fit the physical and uncertain
/// eigenvalues. `None` without finite eigenvalues.
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

/// Returns the finite points of a branch; those below the real axis become gaps where only the upper half is drawn.
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

/// Returns the branches as one line with gaps. Between two states a pair becomes real at the axis, not on the way to
/// it.
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

/// True if every eigenvalue below the real axis has its conjugate at the same time or value of the parameter.
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
    // Outliers are large in modulus: a rare real part may still be small compared to the others' imaginary parts.
    let (_, most) = robust(values.iter().map(|value| value.norm()))?;
    values.retain(|value| value.norm() <= most);
    let (re, im) = (bounds(values.iter().map(|value| value.re)), bounds(values.iter().map(|value| value.im)));
    let size = largest(&[re.0, re.1, im.0, im.1]);
    let least = if size > 0.0 { LEAST * size } else { 1.0 };
    let re = with_zero(re, 2.0 * least);
    let im = if is_upper { (0.0, im.1.max(0.0)) } else { with_zero(im, 2.0 * least) };
    Some(Window { re: padded(re, FREE, 2.0 * least), im: padded(im, FREE, 2.0 * least) })
}

/// Extends a range to zero, unless that is far away.
fn with_zero((low, high): (f64, f64), least: f64) -> (f64, f64) {
    let near = 2.0 * (high - low).max(least);
    match () {
        _ if low > 0.0 && low <= near => (0.0, high),
        _ if high < 0.0 && -high <= near => (low, 0.0),
        _ => (low, high),
    }
}

/// Adds the axes of the plane and lines of constant damping.
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

/// Returns a note on the number of points outside the axes.
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

/// Largest number of lines with names.
const MOST_NAMED: usize = 7;
/// Ratio of values above which an axis is logarithmic.
const WIDE: f64 = 100.0;
/// Least length of an axis of damping ratios, for values that differ by round-off only.
const LEAST_DAMPING: f64 = 0.02;

/// Draws |lambda| / 2 pi and -Re(lambda) / |lambda| of the physical eigenvalues, each conjugate pair once; `along`
/// names time or parameter with its unit. `None` without physical eigenvalues.
pub fn frequency_figure(title: &str, along: impl Into<AxisSpec>, branches: &[Branch]) -> Option<Figure> {
    let along = along.into();
    let (drawn, left_out) = drawn(branches);
    let physical = drawn.iter().filter(|branch| branch.kind == Kind::Physical);
    let upper: Vec<&Branch> = physical.filter(|branch| branch.points.iter().any(|point| is_shown(point.1))).collect();
    let frequencies = lines(&upper, |value| value.norm() / TAU);
    let dampings = lines(&upper, |value| if value.norm() > 0.0 { -value.re / value.norm() } else { 0.0 });
    let (frequency_axis, note) = frequency_axis(values(&frequencies))?;
    let note = if left_out.is_empty() { note } else { left_out };
    let damping_axis = damping_axis(values(&dampings));
    let all = |panel: Panel, lines: Vec<Series>| lines.into_iter().fold(panel, Panel::series);
    let frequencies = all(Panel::new(along.clone(), frequency_axis).title(note), frequencies);
    let dampings = all(Panel::new(along, damping_axis), dampings);
    Some(Figure::new().title(title).panel(frequencies).panel(dampings))
}

/// True if finite, and not the lower one of a pair.
fn is_shown(value: Complex<f64>) -> bool {
    value.re.is_finite() && value.im.is_finite() && value.im >= 0.0
}

fn lines(branches: &[&Branch], value: impl Fn(Complex<f64>) -> f64) -> Vec<Series> {
    let is_named = (2..=MOST_NAMED).contains(&branches.len());
    let point = |(at, there): &(f64, Complex<f64>)| (*at, if is_shown(*there) { value(*there) } else { f64::NAN });
    let line = |(i, branch): (usize, &&Branch)| {
        let name = if is_named { format!("mode {}", i + 1) } else { String::new() };
        // Real here, elsewhere the lower one of a pair: it must not hide the other one, which may be as large.
        let is_partner = branch.points.iter().any(|(_, value)| value.im < 0.0);
        let style = if is_partner { Style::Thin } else { Style::Line };
        Series::line(name, branch.points.iter().map(point).collect()).style(style)
    };
    branches.iter().enumerate().map(line).collect()
}

fn values(lines: &[Series]) -> Vec<f64> {
    let points = lines.iter().flat_map(|line| &line.points);
    points.map(|point| point.1).filter(|value| value.is_finite()).collect()
}

/// True if values are all above zero and of different sizes.
fn are_wide(values: &[f64]) -> bool {
    let (low, high) = bounds(values.iter().copied());
    low > 0.0 && high > WIDE * low
}

/// Returns the axis and a note on values outside it.
fn frequency_axis(values: Vec<f64>) -> Option<(AxisSpec, String)> {
    let axis = AxisSpec::from("frequency |λ|/2π (Hz)");
    if are_wide(&values) {
        return Some((axis.log(), String::new()));
    }
    let range = robust(values.iter().copied())?;
    let outside = values.iter().filter(|value| !(range.0..=range.1).contains(*value)).count();
    let (low, high) = padded(range, FREE, 0.0);
    Some(match outside {
        0 => (axis, String::new()),
        1 => (axis.range(low, high), "1 point lies outside".to_string()),
        _ => (axis.range(low, high), format!("{outside} points lie outside")),
    })
}

fn damping_axis(values: Vec<f64>) -> AxisSpec {
    let axis = AxisSpec::from("damping ratio");
    let (low, high) = bounds(values.iter().copied());
    match high - low {
        span if span < tolerances::EIGENVALUES_AGREE => {
            let (low, high) = padded((low, high), 0.0, LEAST_DAMPING);
            axis.range(low, high)
        }
        _ if are_wide(&values) => axis.log(),
        _ => axis,
    }
}

/// Damping ratios of the lines.
const RATIOS: [f64; 13] = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 0.9, 0.97];
/// Angles of the lines from the imaginary axis in the figure, degrees: the first and last, and the least between two.
const FIRST: f64 = 9.0;
const LAST: f64 = 80.0;
const BETWEEN: f64 = 14.0;

/// A ray of constant damping from the origin to the border of the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    pub ratio: f64,
    pub end: (f64, f64),
}

/// Returns rays that are well apart in the figure: real parts from `low` (below zero), imaginary ones up to `high`,
/// with `pixels` per unit along both.
pub fn rays(low: f64, high: f64, pixels: (f64, f64)) -> Vec<Ray> {
    if !(low < 0.0 && high > 0.0) {
        return Vec::new();
    }
    let mut found: Vec<Ray> = Vec::new();
    let mut before = FIRST - BETWEEN;
    for ratio in RATIOS {
        let (x, y) = (-ratio, (1.0 - ratio * ratio).sqrt());
        let angle = (-x * pixels.0).atan2(y * pixels.1).to_degrees();
        if (before + BETWEEN..=LAST).contains(&angle) {
            let size = (low / x).min(high / y);
            found.push(Ray { ratio, end: (size * x, size * y) });
            before = angle;
        }
    }
    found
}

/// Part of the values at each end that is outside the core of a range.
const TAIL: f64 = 0.1;
/// Values within this many lengths of the core beyond it still belong to the range.
const REACH: f64 = 2.0;

/// Returns the range of all values, or of most where the others are far off. None without values.
pub fn robust(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    let mut sorted: Vec<f64> = values.filter(|value| value.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let last = sorted.len().checked_sub(1)?;
    let at = |part: f64| sorted[(part * last as f64).round() as usize];
    let (low, high) = (at(TAIL), at(1.0 - TAIL));
    let reach = if high > low { REACH * (high - low) } else { f64::INFINITY };
    Some((at(0.0).max(low - reach), at(1.0).min(high + reach)))
}

/// Returns a range with margins at both ends, of at least the length `least`.
pub fn padded((low, high): (f64, f64), part: f64, least: f64) -> (f64, f64) {
    let missing = (0.5 * (least - (high - low))).max(0.0);
    let pad = part * (high - low).max(least) + missing;
    (low - pad, high + pad)
}

/// Largest number of physical branches drawn, of pairs one.
const MOST_DRAWN: usize = 12;

/// Returns the branches that a figure shows, the slowest of the physical ones and all others, and a note on the dropped
/// ones.
pub fn drawn(branches: &[Branch]) -> (Vec<Branch>, String) {
    let slowest = |branch: &Branch| {
        let sizes = branch.points.iter().map(|(_, value)| value.norm()).filter(|size| size.is_finite());
        sizes.fold(f64::INFINITY, f64::min)
    };
    let is_counted =
        |branch: &&Branch| branch.kind == Kind::Physical && branch.points.iter().any(|(_, value)| value.im >= 0.0);
    let mut sizes: Vec<f64> = branches.iter().filter(is_counted).map(slowest).collect();
    if sizes.len() <= MOST_DRAWN {
        return (branches.to_vec(), String::new());
    }
    sizes.sort_by(f64::total_cmp);
    // Both of a pair are equally slow but for rounding.
    let bound = sizes[MOST_DRAWN - 1] * (1.0 + 1e-9);
    let is_drawn = |branch: &&Branch| branch.kind != Kind::Physical || slowest(branch) <= bound;
    let note = format!("the {MOST_DRAWN} slowest of {} modes; all are in the files", sizes.len());
    (branches.iter().filter(is_drawn).cloned().collect(), note)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rays_end_at_the_axes_and_look_apart() {
        for (low, high) in [(-1.0, 1.0), (-2.0, 100.0), (-500.0, 300.0)] {
            let pixels = (300.0 / -low, 300.0 / high);
            let found = rays(low, high, pixels);
            assert!((1..=6).contains(&found.len()), "{low} {high} {found:?}");
            for ray in found {
                let (x, y) = ray.end;
                assert!((x - low).abs() < 1e-9 * -low || (y - high).abs() < 1e-9 * high);
                assert!((-x / x.hypot(y) - ray.ratio).abs() < 1e-12);
            }
        }
        assert!(rays(0.0, 1.0, (1.0, 1.0)).is_empty() && rays(-1.0, 0.0, (1.0, 1.0)).is_empty());
    }

    #[test]
    fn few_far_values_are_left_outside() {
        let near = (0..100).map(|k| f64::from(k) * 0.01);
        assert_eq!(robust(near.clone()), Some((0.0, 0.99)));
        let (low, high) = robust(near.chain([1e6, -1e9, f64::NAN])).unwrap();
        assert!(low > -3.0 && high < 4.0, "{low} {high}");
        assert_eq!(robust([2.0; 9].into_iter()), Some((2.0, 2.0)));
        assert_eq!(robust([0.0, 1e6].into_iter()), Some((0.0, 1e6)));
        assert_eq!(robust(std::iter::empty()), None);
    }

    #[test]
    fn ranges_have_a_length() {
        assert_eq!(padded((1.0, 1.0), 0.0, 2.0), (0.0, 2.0));
        assert_eq!(padded((0.0, 10.0), 0.1, 2.0), (-1.0, 11.0));
    }
}
