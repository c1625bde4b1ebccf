//! Symbols of joints.

use super::canvas::{BOLD, Canvas, Layer, THIN};
use super::snapshot::{Link, Sight};
use super::view::{along, direction};
use crate::body::{cross, dot, norm, sub};
use crate::joint::Axis;
use crate::plot::Tint;
use std::f64::consts::{PI, TAU};

/// Radius of a hinge, pixels.
const HINGE: f64 = 4.2;
/// Distance of the rails from the line of a slide, and their extension beyond its travel, pixels.
const RAIL: f64 = 9.0;
const REACH: f64 = 16.0;

fn axis(link: &Link) -> Option<[f64; 3]> {
    let (Axis::Along(axis) | Axis::Turn(axis)) = link.axis?;
    direction(axis)
}

/// Draws a circle, in space with its axis.
pub fn revolute(pen: &mut Canvas, link: &Link, _: &Sight) {
    let at = link.ends[1].r;
    let ink = pen.ink(0.0);
    if let Some(axis) = axis(link) {
        let end = |size: f64| pen.beside((at, axis.map(|x| x * size)));
        let spots = vec![end(-13.0), end(13.0)];
        pen.line(spots, ink, THIN);
    }
    pen.ring(pen.spot(at), HINGE, ink);
}

/// Draws two rails along the travel of the slide, hatched where they belong to the ground.
pub fn slot(pen: &mut Canvas, link: &Link, sight: &Sight) {
    let Some(axis) = axis(link) else { return };
    let foot = link.ends[0].r;
    let point = link.ends[1].r;
    let place = dot(&axis, &sub(&point, &foot));
    let (low, high) = sight.travel.unwrap_or((place, place));
    // The rails pass through the point even if the joint has drifted.
    let at = |s: f64| along(point, axis, s - place);
    let ink = pen.ink(0.25);
    pen.layer = Layer::Rod;
    let Some((x, y)) = pen.rails(at(low), at(high), axis, RAIL, REACH, ink) else { return };
    if link.carriers[0].is_none() {
        let ends = [pen.spot(at(low)).moved(-REACH * x, -REACH * y), pen.spot(at(high)).moved(REACH * x, REACH * y)];
        for (end, sign) in ends.into_iter().zip([1.0, -1.0]) {
            for k in 0..3 {
                let along = sign * (3.0 + 5.0 * f64::from(k));
                let corner = |out: f64, back: f64| {
                    let right = along - back;
                    let up = -RAIL - out;
                    end.moved(right * x - up * y, right * y + up * x)
                };
                let stroke = vec![corner(0.0, 0.0), corner(5.0, 4.0)];
                pen.line(stroke, ink, 1.0);
            }
        }
    }
    pen.layer = Layer::Joint;
}

/// Draws rails and a hinge's circle.
pub fn cylindrical(pen: &mut Canvas, link: &Link, sight: &Sight) {
    slot(pen, link, sight);
    pen.ring(pen.spot(link.ends[1].r), HINGE, pen.ink(0.0));
}

/// Draws rails and a dot.
pub fn point_on_line(pen: &mut Canvas, link: &Link, sight: &Sight) {
    slot(pen, link, sight);
    pen.disc(pen.spot(link.ends[1].r), 3.6, pen.ink(0.0));
}

/// Draws a ball in its socket.
pub fn spherical(pen: &mut Canvas, link: &Link, _: &Sight) {
    let spot = pen.spot(link.ends[1].r);
    let ink = pen.ink(0.0);
    pen.ring(spot, 6.0, ink);
    pen.disc(spot, 3.8, ink);
}

/// Draws a circle with the two pins of the cross.
pub fn universal(pen: &mut Canvas, link: &Link, _: &Sight) {
    let at = link.ends[1].r;
    let ink = pen.ink(0.0);
    pen.ring(pen.spot(at), 9.5, ink);
    for pin in [link.ends[0].axes[0], link.ends[1].axes[1]] {
        let end = |size: f64| pen.beside((at, pin.map(|x| x * size)));
        let spots = vec![end(-9.5), end(9.5)];
        pen.line(spots, ink, BOLD);
    }
}

/// Draws a patch of the plane.
pub fn planar(pen: &mut Canvas, link: &Link, _: &Sight) {
    let at = link.ends[1].r;
    let ink = pen.ink(0.3);
    let Some(normal) = axis(link) else { return };
    let [first, second] = super::view::square_to(normal, link.ends[0].axes[0]);
    let corner = |a: f64, b: f64| pen.beside((at, along(first.map(|x| x * a), second, b)));
    let spots = vec![corner(-20.0, -20.0), corner(20.0, -20.0), corner(20.0, 20.0), corner(-20.0, 20.0)];
    pen.shape(spots, ink, THIN, (ink, 0.12));
    pen.disc(pen.spot(at), 2.6, ink);
}

/// Draws a square.
pub fn weld(pen: &mut Canvas, link: &Link, _: &Sight) {
    let spot = pen.spot(link.ends[1].r);
    let corners = [(-4.4, -4.4), (4.4, -4.4), (4.4, 4.4), (-4.4, 4.4)].map(|(right, up)| spot.moved(right, up));
    pen.area(corners.to_vec(), pen.ink(0.0), 1.0);
}

/// Draws a thin rod between two balls.
pub fn distance(pen: &mut Canvas, link: &Link, _: &Sight) {
    let ink = pen.ink(0.2);
    let ends = [pen.spot(link.ends[0].r), pen.spot(link.ends[1].r)];
    pen.layer = Layer::Rod;
    pen.line(ends.to_vec(), ink, 3.0);
    ends.into_iter().for_each(|end| pen.disc(end, 3.4, ink));
}

/// Draws an arrow along or about the driven direction.
pub fn driver(pen: &mut Canvas, link: &Link, _: &Sight) {
    let at = link.ends[1].r;
    let ink = pen.ink(0.1);
    pen.layer = Layer::Arrow;
    match link.axis {
        Some(Axis::Turn(axis)) => turn(pen, at, axis, 17.0, ink),
        Some(Axis::Along(axis)) => {
            let step = |size: f64| pen.beside((at, axis.map(|x| x * size)));
            let both = [step(-26.0), step(26.0)];
            pen.arrow(vec![both[0], both[1]], ink, BOLD);
            pen.arrow(vec![both[1], both[0]], ink, BOLD);
        }
        None => {
            let spots = vec![pen.spot(link.ends[0].r), pen.spot(at)];
            pen.dashes(spots, ink, BOLD);
            let way = direction(sub(&at, &link.ends[0].r)).unwrap_or([0.0; 3]);
            let step = |size: f64| pen.beside((at, way.map(|x| x * size)));
            pen.arrow(vec![step(-10.0), step(-4.0)], ink, BOLD);
        }
    }
}

/// Draws an arrow of about three quarters of a revolution about an axis.
pub fn turn(pen: &mut Canvas, at: [f64; 3], axis: [f64; 3], radius: f64, ink: Tint) {
    let Some(axis) = direction(axis) else { return };
    let hint = cross(&axis, &[0.3, -0.4, 0.8]);
    let spots = pen.arc(at, [axis, hint], (0.15 * PI, 1.6 * PI), (0.0, radius));
    pen.arrow(spots, ink, BOLD);
}

/// Returns the radii of the pitch circles of two wheels, m; none for wheels without a distance.
pub fn pitch_radii(link: &Link) -> Option<[f64; 2]> {
    // Proportional to the numbers of teeth.
    let [turn_a, turn_b, ..] = link.turns[..] else { return None };
    let [a, b] = [&link.ends[0], &link.ends[1]];
    let [za, zb] = [turn_a.abs(), turn_b.abs()];
    let gap = sub(&b.r, &a.r);
    // Both circles meet: the gap is the sum of the two radii, which are proportional to the numbers of teeth.
    let out = |axis: [f64; 3], way: [f64; 3]| direction(along(way, axis, -dot(&axis, &way))).unwrap_or([0.0; 3]);
    let inner = if turn_a * turn_b < 0.0 { -1.0 } else { 1.0 };
    let towards = sub(&out(a.axes[2], gap).map(|x| za * x), &out(b.axes[2], gap.map(|x| -x)).map(|x| inner * zb * x));
    let module = dot(&gap, &towards) / dot(&towards, &towards);
    (module.is_finite() && norm(&gap) > 0.0).then(|| [(module * za).abs(), (module * zb).abs()])
}

/// Draws the pitch circles of two wheels, each with a spoke that rotates with it.
pub fn gear(pen: &mut Canvas, link: &Link, _: &Sight) {
    let Some(radii) = pitch_radii(link) else { return };
    pen.layer = Layer::Rod;
    for ((radius, wheel), body) in radii.into_iter().zip(&link.ends).zip(&link.carriers) {
        let tint = body.map_or(pen.ink(0.2), |body| pen.color(body, 0.0));
        let circle = pen.arc(wheel.r, [wheel.axes[2], wheel.axes[0]], (0.0, TAU), (radius, 0.0));
        let spoke = vec![pen.spot(wheel.r), circle[0]];
        pen.area(circle.clone(), tint, 0.07);
        pen.line(circle, tint, THIN);
        pen.line(spoke, tint, THIN);
    }
}

/// Draws a small rhombus at the bodies whose coordinates an equation constrains.
pub fn equation(pen: &mut Canvas, link: &Link, _: &Sight) {
    let ink = pen.ink(0.0);
    for (end, _) in link.ends.iter().zip(&link.carriers).filter(|(_, body)| body.is_some()) {
        let spot = pen.spot(end.r);
        let corners = [(4.0, 0.0), (0.0, 4.0), (-4.0, 0.0), (0.0, -4.0)].map(|(right, up)| spot.moved(right, up));
        pen.area(corners.to_vec(), ink, 1.0);
    }
}
