//! Figures of the mechanism, from snapshots.

use super::canvas::Canvas;
use super::glyphs::ElementTravel;
use super::motion::DrawnMotion;
use super::snapshot::{Link, Snapshot, snapshot, up};
use super::traces::{Trace, curves};
use super::view::{View, direction};
use super::{bodies, glyphs, ground};
use crate::body::{dot, norm, sub, unit};
use crate::error::significant;
use crate::joint::Axis;
use crate::linearize::State;
use crate::math::bounds;
use crate::plot::{Align, Animation, AxisSpec, Figure, Item, ItemForm, Panel, Series, Spot, Tint};
use crate::prepared::{AnyMechanism, Model};

#[derive(Clone, Debug)]
pub struct Look {
    pub view: View,
    /// True if bodies are labelled with their names.
    pub labels: bool,
    /// Markers whose paths are drawn.
    pub traces: Vec<Trace>,
}

impl Look {
    /// The front view, or the isometric view in space; without labels and traces.
    pub fn plain(mechanism: &AnyMechanism) -> Self {
        let view = match mechanism {
            AnyMechanism::Planar(_) => View::planar(),
            AnyMechanism::Spatial(_) => View::isometric(up(mechanism)),
        };
        Look { view, labels: false, traces: Vec::new() }
    }
}

/// Draws the mechanism at one time.
pub fn mechanism_figure(prepared: &Model, look: &Look, state: &State) -> Figure {
    let scene = snapshot(&prepared.mechanism, state);
    let mut items = supports(look, std::slice::from_ref(&scene));
    items.extend(picture(look, &scene, &ElementTravel { travels: Vec::new(), lengths: lengths(&scene) }, 0.0));
    let panel = panel(look, &scene, [items.as_slice()].into_iter(), &[]).items(items);
    let title = format!("{}, t = {} s", prepared.name, significant(state.t, 4));
    Figure::new().title(title).panel(labelled(look, &scene, panel))
}

/// Paleness of the earliest picture and of the last but one.
const PALE: (f64, f64) = (0.8, 0.45);

/// Draws the mechanism at several times in one figure, earlier ones paler.
pub fn stroboscope_figure(motion: &DrawnMotion, look: &Look, times: &[f64]) -> Figure {
    let prepared = motion.prepared;
    let scenes: Vec<Snapshot> = times.iter().map(|t| snapshot(&prepared.mechanism, &motion.state(*t))).collect();
    let course = course(motion);
    let mut items = supports(look, &scenes);
    let last = scenes.len().saturating_sub(1);
    let paleness = |k: usize| match k {
        _ if k == last => 0.0,
        _ => PALE.0 + (PALE.1 - PALE.0) * k as f64 / (last - 1).max(1) as f64,
    };
    for (k, scene) in scenes.iter().enumerate() {
        items.extend(look.traces.iter().map(|trace| dot_on_path(look, scene, trace, paleness(k))));
        items.extend(picture(look, scene, &course, paleness(k)));
    }
    let series = curves(motion, &look.view, &look.traces);
    let Some(full) = scenes.last() else { return Figure::new() };
    let mut panel = panel(look, full, [items.as_slice()].into_iter(), &series).items(items);
    panel.series = series;
    panel.keys = keys(times, paleness);
    Figure::new().title(motion.title.clone()).panel(labelled(look, full, panel))
}

/// Returns the times in the shades of their pictures.
fn keys(times: &[f64], paleness: impl Fn(usize) -> f64) -> Vec<(String, Tint)> {
    let stride = times.len().div_ceil(12).max(1);
    let last = times.len().saturating_sub(1);
    let shown = (0..times.len()).filter(|k| (last - k).is_multiple_of(stride));
    shown.map(|k| (format!("t = {} s", significant(times[k], 3)), Tint::Ink(paleness(k)))).collect()
}

fn dot_on_path(look: &Look, scene: &Snapshot, trace: &Trace, paleness: f64) -> Item {
    let (x, y) = look.view.flat(scene.markers[trace.marker].r);
    let tint = trace.body.map_or(Tint::Ink(paleness), |body| Tint::Body(body, 0.6 * paleness));
    Item { spots: vec![Spot::data(x, y)], tint, form: ItemForm::Disc(3.4) }
}

/// Draws the mechanism in motion at `times`, `per_second` of them in a second.
pub fn animation(
    motion: &DrawnMotion,
    look: &Look,
    times: Vec<f64>,
    per_second: f64,
    speed: String,
) -> Animation<impl Fn(usize) -> Figure + Sync> {
    let prepared = motion.prepared;
    let course = course(motion);
    let few: Vec<Snapshot> = every(&times, 40).map(|t| snapshot(&prepared.mechanism, &motion.state(t))).collect();
    let fixed = supports(look, &few);
    let moving: Vec<Vec<Item>> = every(&times, 400)
        .map(|t| picture(look, &snapshot(&prepared.mechanism, &motion.state(t)), &course, 0.0).collect())
        .collect();
    let series: Vec<Series> = curves(motion, &look.view, &look.traces)
        .into_iter()
        .map(|curve| Series { label: String::new(), ..curve })
        .collect();
    let all = moving.iter().map(Vec::as_slice).chain([fixed.as_slice()]);
    let empty = few.first().map(|scene| panel(look, scene, all, &series)).unwrap_or_default();
    let count = times.len();
    let look = look.clone();
    let mechanism = &prepared.mechanism;
    let name = motion.title.clone();
    let states: Vec<State> = times.iter().map(|t| motion.state(*t)).collect();
    let step = times.windows(2).map(|pair| pair[1] - pair[0]).next().unwrap_or(1.0);
    let decimals = (-step.log10()).ceil().clamp(0.0, 9.0) as usize;
    let frame = move |k: usize| {
        let scene = snapshot(mechanism, &states[k]);
        let mut items = fixed.clone();
        items.extend(look.traces.iter().map(|trace| dot_on_path(&look, &scene, trace, 0.0)));
        items.extend(picture(&look, &scene, &course, 0.0));
        if look.labels {
            items.extend(scene.limbs.iter().map(|limb| {
                let (x, y) = look.view.flat(limb.centre.r);
                text(Spot::data(x, y).moved(9.0, 9.0), limb.name.clone(), Align::Start)
            }));
        }
        // At the upper corners of the frame.
        let above = |x: f64| Spot::data(x, f64::INFINITY).moved(0.0, 8.0);
        items.push(text(above(f64::INFINITY), format!("t = {:.decimals$} s", states[k].t), Align::End));
        items.push(text(above(f64::NEG_INFINITY), speed.clone(), Align::Start));
        let panel = Panel { series: series.clone(), ..empty.clone() };
        Figure::new().title(name.clone()).panel(panel.items(items))
    };
    Animation { frame, count, per_second }
}

fn text(spot: Spot, text: String, align: Align) -> Item {
    Item { spots: vec![spot], tint: Tint::Ink(0.0), form: ItemForm::Text(text, align) }
}

/// Returns about `most` of the times, evenly chosen.
fn every(times: &[f64], most: usize) -> impl Iterator<Item = f64> + '_ {
    times.iter().copied().step_by(times.len().div_ceil(most).max(1))
}

pub(super) fn supports(look: &Look, scenes: &[Snapshot]) -> Vec<Item> {
    let mut pen = Canvas::new(&look.view, 0.0);
    ground::draw(&mut pen, scenes);
    pen.finish().collect()
}

pub(super) fn picture(
    look: &Look,
    scene: &Snapshot,
    course: &ElementTravel,
    paleness: f64,
) -> impl Iterator<Item = Item> + use<> {
    let mut pen = Canvas::new(&look.view, paleness);
    for (color, limb) in scene.limbs.iter().enumerate() {
        pen.depth = bodies::depth(&pen, limb);
        bodies::draw(&mut pen, limb, color);
        if paleness == 0.0 {
            bodies::centre(&mut pen, limb, color);
        }
    }
    glyphs::draw(&mut pen, scene, course);
    pen.finish().collect::<Vec<_>>().into_iter()
}

/// Returns an empty panel whose axes contain all items and curves, with a margin for symbols of fixed size.
pub(super) fn panel<'a>(
    look: &Look,
    scene: &Snapshot,
    items: impl Iterator<Item = &'a [Item]>,
    series: &[Series],
) -> Panel {
    let spots = items.flatten().flat_map(|item| &item.spots).map(|spot| spot.at);
    let places: Vec<(f64, f64)> = spots.chain(series.iter().flat_map(|series| series.points.iter().copied())).collect();
    let (left, right) = bounds(places.iter().map(|place| place.0));
    let (bottom, top) = bounds(places.iter().map(|place| place.1));
    let span = (right - left).max(top - bottom);
    let room = if span > 0.0 { 0.085 * span } else { 0.5 };
    let [x, y] = look.view.labels();
    let x = AxisSpec::from(x).range(left - room, right + room);
    let y = AxisSpec::from(y).range(bottom - room, top + room);
    // The axes of space are in the corner where they hide least.
    let hides = |(x, y): &(f64, f64)| {
        let is_near = |place: &&(f64, f64)| (place.0 - x).abs().max((place.1 - y).abs()) < 0.09 * span;
        places.iter().filter(is_near).count()
    };
    let corners = [(left, bottom), (right, bottom), (left, top), (right, top)];
    let free = corners.into_iter().min_by_key(hides).filter(|_| !scene.is_planar);
    let triad = free.map(|(x, y)| triad(&look.view, x > left, y > bottom));
    Panel { equal_aspect: true, ..Panel::new(x, y) }.items(triad.into_iter().flatten())
}

/// Length of the arrows that show the axes of space, pixels.
const TRIAD: f64 = 27.0;

fn triad(view: &View, is_right: bool, is_top: bool) -> Vec<Item> {
    let mut pen = Canvas::new(view, 0.0);
    let side = |is_far: bool| if is_far { 1.0 } else { -1.0 };
    let x = side(is_right);
    let y = side(is_top);
    let foot = Spot::data(x * f64::INFINITY, y * f64::INFINITY).moved(-42.0 * x, -42.0 * y);
    for (i, name) in ["x", "y", "z"].into_iter().enumerate() {
        let (right, up) = view.flat(unit(i));
        pen.depth = view.depth(unit(i));
        if right.hypot(up) > 1e-6 {
            pen.arrow(vec![foot, foot.moved(TRIAD * right, TRIAD * up)], pen.ink(0.3), super::canvas::THIN);
            // The letter is beyond the head, centred on the arrow's line.
            let far = TRIAD + 12.0 / right.hypot(up).max(0.5);
            pen.text(foot.moved(far * right, far * up - 5.0), name);
        }
    }
    pen.finish().collect()
}

/// Adds names at the bodies.
pub(super) fn labelled(look: &Look, scene: &Snapshot, mut panel: Panel) -> Panel {
    if look.labels {
        for (color, limb) in scene.limbs.iter().enumerate() {
            let count = limb.points.len().max(1) as f64;
            let flat = limb.points.iter().map(|point| look.view.flat(*point));
            let (x, y) = flat.fold((0.0, 0.0), |sum, point| (sum.0 + point.0, sum.1 + point.1));
            panel = panel.note(Tint::Body(color, 0.0), x / count, y / count, limb.name.clone());
        }
    }
    panel
}

fn course(motion: &DrawnMotion) -> ElementTravel {
    let mechanism = &motion.prepared.mechanism;
    let slides = |link: &Link| ["prismatic", "cylindrical", "point_on_line"].contains(&link.kind);
    let place = |link: &Link| match link.axis {
        Some(Axis::Along(axis)) if slides(link) => Some(dot(&direction(axis)?, &sub(&link.ends[1].r, &link.ends[0].r))),
        _ => None,
    };
    let first = snapshot(mechanism, &motion.state(motion.reach().0));
    let mut course = ElementTravel { travels: vec![None; first.joints.len()], lengths: lengths(&first) };
    let times = if first.joints.iter().any(slides) { motion.times(300) } else { Vec::new() };
    for t in times {
        let scene = snapshot(mechanism, &motion.state(t));
        for (way, place) in course.travels.iter_mut().zip(scene.joints.iter().map(place)) {
            let Some(place) = place else { continue };
            let (low, high) = way.unwrap_or((place, place));
            *way = Some((low.min(place), high.max(place)));
        }
    }
    course
}

pub(super) fn lengths(scene: &Snapshot) -> Vec<f64> {
    let distance = |link: &Link| match link.ends.as_slice() {
        [a, b, ..] => norm(&sub(&b.r, &a.r)),
        _ => 0.0,
    };
    scene.forces.iter().map(distance).collect()
}
