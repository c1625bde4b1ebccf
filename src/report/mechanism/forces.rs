//! Symbols of forces.

use super::canvas::{BOLD, Canvas, Layer, THIN};
use super::joints::turn;
use super::snapshot::{Link, Sight};
use super::view::{along, direction};
use crate::body::{cross, dot, sub, unit};
use crate::plot::{Spot, Tint};
use std::f64::consts::TAU;

const COILS: usize = 16;
/// Half the width of a spring: pixels, and part of its length at the start.
const WIDTH: (f64, f64) = (3.0, 0.018);

/// Draws a zigzag between its ends.
pub fn spring_damper(pen: &mut Canvas, link: &Link, sight: &Sight) {
    let a = link.ends[0].r;
    let b = link.ends[1].r;
    let (x, y) = pen.view.flat(sub(&b, &a));
    let size = x.hypot(y);
    let (nx, ny) = if size > 1e-12 { (-y / size, x / size) } else { (0.0, 1.0) };
    // A fifth of the length at both ends is straight.
    let at = |part: f64, out: f64| {
        let (x, y) = pen.view.flat(along(a, sub(&b, &a), part));
        let wide = out * WIDTH.1 * sight.length;
        Spot::data(x + wide * nx, y + wide * ny).moved(out * WIDTH.0 * nx, out * WIDTH.0 * ny)
    };
    let mut spots: Vec<Spot> = vec![at(0.0, 0.0), at(0.2, 0.0)];
    spots.extend((0..COILS).map(|k| {
        let side = if k % 2 == 0 { 1.0 } else { -1.0 };
        at(0.2 + 0.6 * (k as f64 + 0.5) / COILS as f64, side)
    }));
    spots.extend([at(0.8, 0.0), at(1.0, 0.0)]);
    let ends = [spots[0], spots[spots.len() - 1]];
    let ink = pen.ink(0.25);
    pen.layer = Layer::Rod;
    pen.line(spots, ink, THIN);
    ends.into_iter().for_each(|end| pen.disc(end, 2.8, ink));
}

/// Draws a spiral about the axis of the first marker.
pub fn torsion_spring(pen: &mut Canvas, link: &Link, _: &Sight) {
    let first = &link.ends[0];
    let steps = 60;
    let spot = |i: usize| {
        let part = f64::from(i as u32) / f64::from(steps);
        let angle = 2.5 * TAU * part;
        let way = along(first.axes[0].map(|x| x * angle.cos()), first.axes[1], angle.sin());
        pen.beside((first.r, way.map(|x| x * (4.0 + 13.0 * part))))
    };
    let spots = (0..=steps as usize).map(spot).collect();
    pen.line(spots, pen.ink(0.25), THIN);
}

/// Draws a bold line between its ends.
pub fn beam(pen: &mut Canvas, link: &Link, _: &Sight) {
    let spots = [0, 1].map(|end| pen.view.flat(link.ends[end].r)).map(|(x, y)| Spot::data(x, y)).to_vec();
    pen.layer = Layer::Rod;
    pen.line(spots, pen.ink(0.25), BOLD);
}

/// Draws a cushion between its ends.
pub fn bushing(pen: &mut Canvas, link: &Link, _: &Sight) {
    let [a, b] = [pen.spot(link.ends[0].r), pen.spot(link.ends[1].r)];
    pen.layer = Layer::Rod;
    let ink = pen.ink(0.3);
    pen.disc(a, 17.5, ink);
    pen.disc(a, 16.0, pen.ink(0.7));
    pen.line(vec![a, b], ink, BOLD);
    pen.disc(a, 2.8, ink);
}

/// Draws an arrow from the point of application.
pub fn applied_force(pen: &mut Canvas, link: &Link, _: &Sight) {
    let Some(way) = direction(link.force) else { return };
    let at = link.ends[0].r;
    pen.layer = Layer::Arrow;
    let spots = vec![pen.spot(at), pen.beside((at, way.map(|x| x * 44.0)))];
    pen.arrow(spots, pen.ink(0.0), BOLD);
}

/// Draws an arrow around the point of application.
pub fn applied_torque(pen: &mut Canvas, link: &Link, _: &Sight) {
    pen.layer = Layer::Arrow;
    let ink = pen.ink(0.0);
    turn(pen, link.ends[0].r, link.torque, 15.0, ink);
}

/// Draws the tyre as a circle, and the road.
pub fn tyre(pen: &mut Canvas, link: &Link, sight: &Sight) {
    let Some(wheel) = link.wheel else { return };
    let hub = &link.ends[0];
    let up = unit(if sight.is_planar { 1 } else { 2 });
    // In space its axle is the horizontal part of the marker's y axis.
    let level = |axis: [f64; 3]| direction(along(axis, up, -dot(&axis, &up)));
    let axle = if sight.is_planar { unit(2) } else { level(hub.axes[1]).unwrap_or(unit(1)) };
    let circle = pen.arc(hub.r, [axle, up], (0.0, TAU), (wheel.radius, 0.0));
    let ink = pen.ink(0.35);
    pen.layer = Layer::Rod;
    if pen.paleness == 0.0 {
        pen.area(circle.clone(), Tint::Ink(0.0), 0.08);
    }
    pen.line(circle, ink, 3.0);
    let below = along(hub.r, up, wheel.road - dot(&up, &hub.r));
    let forward = cross(&axle, &up);
    let end = |part: f64| along(below, forward, part * wheel.radius);
    let road = vec![pen.spot(end(-1.3)), pen.spot(end(1.3))];
    pen.layer = Layer::Ground;
    pen.line(road, ink, THIN);
    for k in -6..=6 {
        let foot = pen.spot(end(0.2 * f64::from(k)));
        pen.line(vec![foot, foot.moved(-5.0, -6.0)], ink, 1.0);
    }
}
