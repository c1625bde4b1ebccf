//! Figures of the mode shapes.

use super::figures::{Look, labelled, lengths, panel, picture, supports};
use super::glyphs::ElementTravel;
use super::snapshot::{Snapshot, snapshot};
use super::view::along;
use crate::body::{norm, sub};
use crate::error::{short, significant};
use crate::formulation::ExponentialMap;
use crate::linearize::{Complex, Kind, LinearModel, Mode, ModePair, State, pairs};
use crate::math::bounds;
use crate::plot::{Figure, Item, Tint};
use crate::prepared::Model;
use std::f64::consts::TAU;

/// Amplitude of the point that moves most, as a part of the mechanism's size.
const TRAVEL: f64 = 0.08;
/// A mode that moves no point by more than STILL of the size per unit, such as the rotation of a wheel, has the
/// amplitude SPIN.
const STILL: f64 = 1e-3;
const SPIN: f64 = 0.35;
/// The amplitude is halved until the two extreme positions lie on a line through the operating point to this part of
/// its length: large rotations would open the joints, since shapes satisfy the constraints to first order only.
const BEND: f64 = 0.3;
const HALVINGS: usize = 12;

/// A mode shape with an amplitude that can be seen.
pub struct Swing<'a> {
    prepared: &'a Model,
    model: &'a LinearModel,
    mode: &'a Mode,
    /// Largest amplitude, in units of the shape, and phase of the shape, rad.
    amplitude: f64,
    phase: f64,
}

/// Draws the slowest physical modes, one panel each: the operating point in grey, the mechanism at both ends of its
/// motion. `None` where no mode has a shape.
pub fn mode_figure(prepared: &Model, look: &Look, model: &LinearModel) -> Option<Figure> {
    let found = shaped(model);
    let drawn = &found[..found.len().min(6)];
    let rest = at_rest(prepared, model);
    let ground = supports(look, std::slice::from_ref(&rest));
    let pictures: Vec<Vec<Item>> =
        drawn.iter().map(|(_, pair)| picture_of(prepared, look, model, pair.mode, &rest)).collect();
    // The same axes for all, so that they can be compared.
    let empty = panel(look, &rest, pictures.iter().map(Vec::as_slice).chain([ground.as_slice()]), &[]);
    let panels = drawn.iter().zip(pictures).map(|((number, pair), items)| {
        let panel = empty.clone().title(format!("mode {number}: {}", mode_title(pair)));
        labelled(look, &rest, panel.items(ground.iter().cloned().chain(items)))
    });
    let name = format!("{}, modes at t = {} s", prepared.name, significant(model.point.t, 4));
    let figure = panels.fold(Figure::new().title(name), Figure::panel);
    match figure.panels.len() {
        0 => None,
        1 => Some(figure),
        _ => Some(Figure { columns: 2, width: 1000.0, ..figure }),
    }
}

/// Returns the physical modes with a shape, with their numbers.
pub fn shaped(model: &LinearModel) -> Vec<(usize, ModePair<'_>)> {
    let numbered = pairs(model, Kind::Physical).into_iter().enumerate().map(|(i, pair)| (i + 1, pair));
    numbered.filter(|(_, pair)| pair.mode.shape.iter().any(|part| part.norm() > 0.0)).collect()
}

/// Returns frequency and damping ratio of an oscillating mode, the rate of another.
pub fn mode_title(pair: &ModePair) -> String {
    let mode = pair.mode;
    let text = if mode.is_zero() {
        "0 Hz".to_string()
    } else if mode.value.im != 0.0 {
        format!("{} Hz, ζ = {}", short(mode.frequency()), short(mode.clean_damping()))
    } else {
        format!("{} 1/s, no oscillation", short(mode.value.re))
    };
    text.replace('-', "−")
}

pub fn at_rest(prepared: &Model, model: &LinearModel) -> Snapshot {
    let point = &model.point;
    snapshot(&prepared.mechanism, &State { t: point.t, q: point.q.clone(), v: point.v.clone() })
}

fn picture_of(prepared: &Model, look: &Look, model: &LinearModel, mode: &Mode, rest: &Snapshot) -> Vec<Item> {
    let swing = Swing::new(prepared, model, mode, rest);
    let course = ElementTravel { travels: Vec::new(), lengths: lengths(rest) };
    let grey = |item: Item| match item.tint {
        Tint::Body(_, paleness) => Item { tint: Tint::Ink(paleness), ..item },
        _ => item,
    };
    let still = picture(look, rest, &course, 0.6).map(grey);
    let ends = [(0.5 * TAU, 0.5), (0.0, 0.0)];
    let ends = ends.iter().flat_map(|(angle, paleness)| picture(look, &swing.snapshot(*angle), &course, *paleness));
    still.chain(ends).collect()
}

impl<'a> Swing<'a> {
    /// Chooses the amplitude at the operating point `rest`.
    pub fn new(prepared: &'a Model, model: &'a LinearModel, mode: &'a Mode, rest: &Snapshot) -> Self {
        // At this phase the real part of the shape is largest: the sum of squares is real.
        let moving = prepared.system().dimensions().moving();
        let squares: Complex<f64> = mode.shape.iter().take(moving).map(|part| part * part).sum();
        let swing = Swing { prepared, model, mode, amplitude: 1.0, phase: -0.5 * squares.arg() };
        let largest = swing.change(0.0).iter().take(moving).fold(0.0, |most: f64, part| most.max(part.abs()));
        let size = size(rest);
        let step = 1e-4 / largest.max(f64::MIN_POSITIVE);
        let moved = Swing { amplitude: step, ..swing }.snapshot(0.0);
        let travel = travel(rest, &moved) / step;
        let amplitude = if travel > STILL * size * largest { TRAVEL * size / travel } else { SPIN / largest };
        let mut swing = Swing { amplitude, ..swing };
        for _ in 0..HALVINGS {
            if travel <= STILL * size * largest || swing.bend(rest) <= BEND {
                break;
            }
            swing.amplitude *= 0.5;
        }
        swing
    }

    /// Returns the distance of the middle of both ends from the operating point, as a part of their distance.
    fn bend(&self, rest: &Snapshot) -> f64 {
        let one = self.snapshot(0.0);
        let other = self.snapshot(0.5 * TAU);
        let ends = || places(&one).zip(places(&other));
        let middle = ends().zip(places(rest)).map(|((a, b), r)| norm(&sub(&along(a.map(|x| 0.5 * x), b, 0.5), &r)));
        let apart = ends().map(|(a, b)| norm(&sub(&b, &a))).fold(f64::MIN_POSITIVE, f64::max);
        2.0 * middle.fold(0.0, f64::max) / apart
    }

    /// Returns the change of q along the velocity directions at a phase angle, rad.
    fn change(&self, angle: f64) -> Vec<f64> {
        let turn = Complex::from_polar(self.amplitude, self.phase + angle);
        self.mode.shape.iter().map(|part| (part * turn).re).collect()
    }

    /// Returns the mechanism at a phase angle, rad.
    pub fn snapshot(&self, angle: f64) -> Snapshot {
        let point = &self.model.point;
        let system = self.prepared.system();
        let mut q = point.q.clone();
        ExponentialMap::new(system).apply(system, &point.q, &self.change(angle), &mut q);
        snapshot(&self.prepared.mechanism, &State { t: point.t, q, v: point.v.clone() })
    }
}

/// Returns points that can be followed from picture to picture.
fn places(scene: &Snapshot) -> impl Iterator<Item = [f64; 3]> + '_ {
    let lines = scene.limbs.iter().flat_map(|limb| limb.line.iter().copied().chain([limb.centre.r]));
    scene.markers.iter().map(|marker| marker.r).chain(lines)
}

fn travel(from: &Snapshot, to: &Snapshot) -> f64 {
    places(from).zip(places(to)).map(|(a, b)| norm(&sub(&b, &a))).fold(0.0, f64::max)
}

/// Returns the longest side of a box around all points; 1 m where they coincide.
fn size(scene: &Snapshot) -> f64 {
    let side = |i: usize| {
        let (low, high) = bounds(places(scene).map(|place| place[i]));
        high - low
    };
    let longest = (0..3).map(side).fold(0.0, f64::max);
    if longest > 0.0 && longest.is_finite() { longest } else { 1.0 }
}
