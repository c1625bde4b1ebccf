//! Bodies as rounded hulls of the markers of their joints and forces.

use super::canvas::{BOLD, Canvas, Layer, THIN};
use super::hull::{hull, rounded};
use super::snapshot::{Limb, Pose};
use super::view::{along, straight};
use crate::body::{dot, norm, sub};
use crate::plot::{Spot, Tint};

/// Radius of a point mass, and half the side of a body without extent, pixels.
const MASS: f64 = 7.5;
const BLOCK: f64 = 11.0;
/// Radius of the symbol of a centre of mass, pixels.
const CENTRE: f64 = 4.6;

/// Returns the mean depth of a body, larger is nearer to the viewer.
pub fn depth(pen: &Canvas, limb: &Limb) -> f64 {
    let sum: f64 = limb.points.iter().map(|point| pen.view.depth(*point)).sum();
    sum / limb.points.len().max(1) as f64
}

pub fn draw(pen: &mut Canvas, limb: &Limb, color: usize) {
    pen.layer = Layer::Body;
    match limb.points.as_slice() {
        [] => {}
        _ if limb.line.len() > 1 => ribbon(pen, &limb.line, color),
        [point] if !limb.oriented => point_mass(pen, *point, color),
        [point] => block(pen, &Pose { r: *point, axes: limb.centre.axes }, color),
        points => {
            let flat: Vec<(f64, f64)> = points.iter().map(|point| pen.view.flat(*point)).collect();
            let around = rounded(&hull(&flat)).into_iter();
            let spots = around.map(|(at, way)| Spot::data(at.0, at.1).moved(6.5 * way.0, 6.5 * way.1)).collect();
            fill(pen, spots, color);
            if !limb.oriented {
                point_mass(pen, limb.centre.r, color);
            } else if limb.may_spin {
                spin(pen, limb, color);
            }
        }
    }
}

/// Half the width of a beam, pixels.
const BEAM: f64 = 3.4;

/// Draws a band along a line.
fn ribbon(pen: &mut Canvas, line: &[[f64; 3]], color: usize) {
    let flat: Vec<(f64, f64)> = line.iter().map(|point| pen.view.flat(*point)).collect();
    let normal = |i: usize| {
        let a = flat[i.saturating_sub(1)];
        let b = flat[(i + 1).min(flat.len() - 1)];
        let x = b.0 - a.0;
        let y = b.1 - a.1;
        let size = x.hypot(y);
        if size > 0.0 { (-y / size, x / size) } else { (0.0, 0.0) }
    };
    let side = |i: usize, out: f64| {
        let (x, y) = normal(i);
        Spot::data(flat[i].0, flat[i].1).moved(out * x, out * y)
    };
    let left = (0..flat.len()).map(|i| side(i, BEAM));
    let right = (0..flat.len()).rev().map(|i| side(i, -BEAM));
    fill(pen, left.chain(right).collect(), color);
}

fn fill(pen: &mut Canvas, spots: Vec<Spot>, color: usize) {
    let edge = pen.color(color, 0.0);
    let inner = Tint::Body(color, 0.0);
    if pen.paleness > 0.0 {
        pen.shape(spots, edge, THIN, (inner, 0.05));
        return;
    }
    // A layer of paper colour below, so that this picture stands out from earlier ones.
    pen.area(spots.clone(), Tint::Ink(1.0), 0.55);
    pen.shape(spots, edge, BOLD, (inner, 0.25));
}

fn point_mass(pen: &mut Canvas, r: [f64; 3], color: usize) {
    pen.disc(pen.spot(r), MASS, pen.color(color, 0.0));
    pen.disc(pen.spot(r), MASS - BOLD, pen.color(color, 0.35));
}

/// Draws a square in the plane, a cube in space, for a body of which only position and orientation are known.
fn block(pen: &mut Canvas, pose: &Pose, color: usize) {
    let sides = pose.axes.map(|axis| axis.map(|x| BLOCK * x));
    let corner = |signs: [f64; 3]| (0..3).fold([0.0; 3], |sum, i| along(sum, sides[i], signs[i]));
    let signs = |k: usize| [0, 1, 2].map(|bit| if k >> bit & 1 == 1 { 1.0 } else { -1.0 });
    let flat: Vec<(f64, f64)> = (0..8).map(|k| pen.view.flat(corner(signs(k)))).collect();
    let spots = hull(&flat).iter().map(|(right, up)| pen.spot(pose.r).moved(*right, *up)).collect();
    fill(pen, spots, color);
    // The edges at the corner nearest to the viewer make it look solid.
    let nearest = sides.map(|side| if pen.view.depth(side) < 0.0 { -1.0 } else { 1.0 });
    for i in (0..3)
        .filter(|i| pen.view.depth(sides[*i]).abs() > 1e-6 * BLOCK && pen.view.depth(sides[*i]).abs() < 0.999 * BLOCK)
    {
        let mut other = nearest;
        other[i] = -nearest[i];
        let edge = vec![pen.beside((pose.r, corner(nearest))), pen.beside((pose.r, corner(other)))];
        pen.line(edge, pen.color(color, 0.0), THIN);
    }
}

/// Draws a ring with a spoke around a straight body in space, to show its rotation about its own axis.
fn spin(pen: &mut Canvas, limb: &Limb, color: usize) {
    let Some(axis) = straight(&limb.points) else { return };
    let hint = limb.centre.axes.iter().copied().min_by(|a, b| dot(a, &axis).abs().total_cmp(&dot(b, &axis).abs()));
    let plane = [axis, hint.unwrap_or(axis)];
    let ring = pen.arc(limb.centre.r, plane, (0.0, std::f64::consts::TAU), (0.0, 13.0));
    let tint = pen.color(color, 0.0);
    let spoke = vec![pen.spot(limb.centre.r), ring[0]];
    pen.line(ring, tint, THIN);
    pen.line(spoke, tint, THIN);
}

/// Draws a circle with two dark quarters at the centre of mass, and a line to the body's middle where it lies outside.
pub fn centre(pen: &mut Canvas, limb: &Limb, color: usize) {
    if !limb.oriented || limb.points.len() < 2 || !limb.line.is_empty() {
        return;
    }
    pen.layer = Layer::Mark;
    let at = pen.spot(limb.centre.r);
    if let Some(foot) = foot(&limb.points, limb.centre.r) {
        pen.dashes(vec![at, pen.spot(foot)], pen.color(color, 0.3), THIN);
    }
    let ink = pen.color(color, 0.0);
    pen.disc(at, CENTRE, ink);
    pen.disc(at, CENTRE - 1.2, Tint::Ink(1.0));
    for from in [0.0, std::f64::consts::PI] {
        let step = |i: usize| {
            let angle = from + std::f64::consts::FRAC_PI_2 * i as f64 / 4.0;
            at.moved((CENTRE - 0.6) * angle.cos(), (CENTRE - 0.6) * angle.sin())
        };
        pen.area([at].into_iter().chain((0..=4).map(step)).collect(), ink, 1.0);
    }
}

/// Returns the point of a bar nearest to a point.
fn foot(points: &[[f64; 3]], r: [f64; 3]) -> Option<[f64; 3]> {
    let axis = straight(points)?;
    let place = |point: [f64; 3]| dot(&axis, &sub(&point, &points[0]));
    let places = points.iter().map(|point| place(*point));
    let (low, high) = places.fold((0.0f64, 0.0f64), |(low, high), at| (low.min(at), high.max(at)));
    let foot = along(points[0], axis, place(r).clamp(low, high));
    (norm(&sub(&foot, &r)) > 1e-6 * (high - low)).then_some(foot)
}
