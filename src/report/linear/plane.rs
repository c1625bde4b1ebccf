//! Eigenvalues over a parameter in the complex plane.

use super::drawn;
use super::ranges::{VERMILION, fitted, notes, robust, shaded};
use super::rays::{Ray, rays};
use crate::error::{short, significant};
use crate::linearize::{Branch, Complex, Kind, are_conjugate};
use crate::plot::{AxisSpec, Figure, Item, ItemForm, Panel, Series, Spot, Style, Tint};
use std::collections::BTreeMap;

/// Colour of the axes, as an index in the palette.
const BLACK: usize = 6;
/// Approximate size of the plane in pixels.
const PIXELS: (f64, f64) = (440.0, 400.0);

#[derive(Clone, Copy, Debug)]
struct Window {
    re: (f64, f64),
    im: (f64, f64),
}

/// Draws the eigenvalues in the complex plane, coloured by a parameter, which `along` names with its unit. Only the
/// upper half is drawn where the lower one is its mirror image. Each axis fits the parts of the physical and uncertain
/// eigenvalues; the half in which modes grow is shaded. With `speeds` the modes are those of a Campbell diagram, see
/// [`frequency_figure`](super::frequency_figure). `None` without finite eigenvalues.
pub fn loci_figure(
    title: &str,
    along: impl Into<AxisSpec>,
    branches: &[Branch],
    speeds: &[(f64, f64)],
) -> Option<Figure> {
    let (drawn, left_out) = drawn::branches(branches, drawn::count(branches, speeds));
    let is_upper = are_mirrored(&drawn);
    let shown: Vec<Branch> = drawn.iter().map(|branch| finite(branch, is_upper)).collect();
    let of = |kind: Kind| shown.iter().filter(move |branch| branch.kind == kind);
    let physical = || of(Kind::Physical).chain(of(Kind::Uncertain));
    let window = window(physical()).or_else(|| window(of(Kind::Spurious)))?;
    let axis = |label: &str, (low, high): (f64, f64)| AxisSpec::from(label).range(low, high);
    let mut panel = Panel::new(axis("real part (1/s)", window.re), axis("imaginary part (rad/s)", window.im))
        .height(PIXELS.1)
        .title(notes([left_out, outside_note(&shown, &window)]));
    let data: Vec<Complex<f64>> = points(shown.iter()).map(|(_, value)| value).collect();
    let shaded = shaded(panel, (window.re.0.max(0.0), window.re.1), window.im);
    panel = frame_lines(shaded, &window, is_upper, &data);
    for (kind, name, style) in
        [(Kind::Spurious, "spurious", Style::Crosses), (Kind::Uncertain, "uncertain", Style::Dots)]
    {
        let others = points(of(kind)).map(|(_, value)| (value.re, value.im)).collect::<Vec<_>>();
        if !others.is_empty() {
            panel = panel.series(Series::dots(name, others).style(style).color(VERMILION));
        }
    }
    let curves: Vec<Branch> = drawn.iter().map(|branch| finite(&branch.curve(), is_upper)).collect();
    // One line with gaps.
    let line = |branch: &Branch| -> Vec<(f64, f64)> {
        let points = branch.points.iter().map(|(_, value)| (value.re, value.im));
        points.chain([(f64::NAN, f64::NAN)]).collect()
    };
    let curves = curves.iter().filter(|branch| branch.kind == Kind::Physical).flat_map(line).collect();
    panel = panel.series(Series::line("", curves).style(Style::Thin).color(BLACK));
    panel.colors = along.into();
    Some(Figure::new().title(title).panel(panel.items(dots(points(of(Kind::Physical)), &window))))
}

/// Returns dots for the eigenvalues of a window, at most some thousand, in the order of the values that colour them.
fn dots(points: impl Iterator<Item = (f64, Complex<f64>)>, Window { re, im }: &Window) -> Vec<Item> {
    let is_within = |x: f64, limits: &(f64, f64)| (limits.0..=limits.1).contains(&x);
    let mut shown: Vec<_> = points.filter(|(_, value)| is_within(value.re, re) && is_within(value.im, im)).collect();
    shown.sort_by(|a, b| a.0.total_cmp(&b.0));
    let dot = |(at, value): (f64, Complex<f64>)| Item {
        spots: vec![Spot::data(value.re, value.im)],
        tint: Tint::Value(at),
        form: ItemForm::Disc(2.7),
    };
    let step = shown.len().div_ceil(4000).max(1);
    shown.into_iter().step_by(step).map(dot).collect()
}

/// Returns the finite points of a branch; those below the real axis become gaps where only the upper half is drawn.
fn finite(branch: &Branch, is_upper: bool) -> Branch {
    let is_shown = |value: Complex<f64>| {
        value.re.is_finite() && value.im.is_finite() && !(is_upper && value.im < 0.0) && branch.kind != Kind::Infinite
    };
    let gap = Complex::new(f64::NAN, f64::NAN);
    let points = branch.points.iter().map(|(at, value)| (*at, if is_shown(*value) { *value } else { gap }));
    Branch { kind: branch.kind, points: points.collect(), slopes: Vec::new() }
}

fn points<'a>(branches: impl Iterator<Item = &'a Branch>) -> impl Iterator<Item = (f64, Complex<f64>)> {
    branches.flat_map(|branch| &branch.points).copied().filter(|(_, value)| value.re.is_finite())
}

/// True if every eigenvalue below the real axis has its conjugate at the same value of the parameter.
fn are_mirrored(branches: &[&Branch]) -> bool {
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

/// Returns the axes that fit eigenvalues, each part by itself; few far ones may be outside.
fn window<'a>(branches: impl Iterator<Item = &'a Branch>) -> Option<Window> {
    let mut values: Vec<Complex<f64>> = points(branches).map(|(_, value)| value).collect();
    let (_, size) = robust(values.iter().map(|value| value.norm()), 0.0)?;
    values.retain(|value| value.norm() <= size);
    let re = fitted(values.iter().map(|value| value.re), size)?;
    let im = fitted(values.iter().map(|value| value.im), size)?;
    Some(Window { re, im })
}

/// Adds the axes of the plane and lines of constant damping, their names away from the data.
fn frame_lines(panel: Panel, window: &Window, is_upper: bool, data: &[Complex<f64>]) -> Panel {
    let Window { re, im } = *window;
    let across = Series::line("", vec![(re.0, 0.0), (re.1, 0.0)]).style(Style::Thin).color(BLACK);
    let up = Series::line("", vec![(0.0, im.0), (0.0, im.1)]).style(Style::Thin).color(BLACK);
    let pixels = (PIXELS.0 / (re.1 - re.0), PIXELS.1 / (im.1 - im.0));
    let rays = rays(re.0, im.1, pixels);
    let origin = (0.0, 0.0);
    let gap = (f64::NAN, f64::NAN);
    let line = |ray: &Ray| {
        let lower = if is_upper { gap } else { (ray.end.0, -ray.end.1) };
        [ray.end, origin, lower, gap]
    };
    let guide = Series::line("", rays.iter().flat_map(line).collect()).style(Style::Guide);
    let panel = panel.series(guide).series(across).series(up);
    rays.iter().fold(panel, |panel, ray| {
        let (x, y) = free_place(ray, data, pixels);
        panel.note(Tint::Ink(0.4), x, y, format!("ζ = {}", short(ray.ratio)))
    })
}

/// Places of a name along its ray, as parts of its length, where the usual one is taken.
const OTHERS: [f64; 3] = [0.8, 0.65, 0.5];
/// Distance from the data that leaves room for a name, pixels.
const ENOUGH: f64 = 100.0;

/// Returns the place of the name along a ray: the usual one unless that is near the data.
fn free_place(ray: &Ray, data: &[Complex<f64>], pixels: (f64, f64)) -> (f64, f64) {
    let place = |part: f64| (part * ray.end.0, part * ray.end.1);
    let distance = |part: f64| {
        let (x, y) = place(part);
        let apart = data.iter().map(|value| (pixels.0 * (value.re - x)).hypot(pixels.1 * (value.im - y)));
        apart.fold(ENOUGH, f64::min)
    };
    let farther = |one: f64, other: f64| if distance(other) > distance(one) { other } else { one };
    if distance(0.93) >= ENOUGH { place(0.93) } else { place(OTHERS.into_iter().fold(OTHERS[0], farther)) }
}

/// Returns a note on the number of points outside the axes, and on growth among them.
fn outside_note(shown: &[Branch], window: &Window) -> String {
    let is_outside = |value: Complex<f64>| {
        !(window.re.0..=window.re.1).contains(&value.re) || !(window.im.0..=window.im.1).contains(&value.im)
    };
    let outside = |kind: Kind| {
        points(shown.iter().filter(move |branch| branch.kind == kind))
            .map(|(_, value)| value)
            .filter(|value| is_outside(*value))
    };
    let kinds = [(Kind::Physical, "physical"), (Kind::Uncertain, "uncertain"), (Kind::Spurious, "spurious")];
    let counts = kinds.map(|(kind, name)| (outside(kind).count(), name));
    let words: Vec<String> =
        counts.iter().filter(|(count, _)| *count > 0).map(|(count, kind)| format!("{count} {kind}")).collect();
    let lie = match counts.iter().map(|(count, _)| count).sum::<usize>() {
        0 => return String::new(),
        1 => format!("{} point lies outside", words.join(" and ")),
        _ => format!("{} points lie outside", words.join(" and ")),
    };
    let growth = outside(Kind::Physical).map(|value| value.re).fold(0.0, f64::max);
    if growth > window.re.1.max(0.0) { format!("{lie}, real parts up to {} 1/s", significant(growth, 3)) } else { lie }
}
