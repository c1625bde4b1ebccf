//! Symbol of the ground.

use super::canvas::{Canvas, Layer, THIN};
use super::snapshot::{Link, Snapshot};
use super::view::{along, direction};
use crate::body::{norm, sub};
use crate::plot::Spot;

/// Kinds that pull at the ground along a line: their wall is perpendicular to it, unless its direction changes.
const PULLING: [&str; 1] = ["spring_damper"];
/// A line counts as of changing direction if its mean direction is shorter than this.
const STEADY: f64 = 0.95;
/// Kinds whose own symbol shows the ground.
const BARE: [&str; 5] = ["prismatic", "cylindrical", "point_on_line", "equation", "driver"];

/// Draws a hatched support at every marker of the ground that has a joint or force. It is on the side away from the
/// bodies, in all of the pictures, so that it hides none of them.
pub fn draw(pen: &mut Canvas, pictures: &[Snapshot]) {
    let Some(first) = pictures.first() else { return };
    let all = |scene: &Snapshot| scene.joints.iter().chain(&scene.forces).cloned().collect::<Vec<Link>>();
    let mut done: Vec<[f64; 3]> = Vec::new();
    for link in all(first) {
        for (end, _) in link.ends.iter().zip(&link.carriers).filter(|(_, body)| body.is_none()) {
            let at = end.r;
            if BARE.contains(&link.kind) || done.iter().any(|known| norm(&sub(known, &at)) < 1e-9) {
                continue;
            }
            done.push(at);
            let way = mean(pictures, at).unwrap_or([0.0; 3]);
            let is_wall = PULLING.contains(&link.kind) && norm(&way) > STEADY;
            let way = pen.view.flat(way);
            support(pen, at, way, is_wall);
        }
    }
}

/// Returns the mean direction from a point of the ground to the bodies connected there; shorter than one where it
/// changes.
fn mean(pictures: &[Snapshot], at: [f64; 3]) -> Option<[f64; 3]> {
    let mut sum = [0.0; 3];
    let mut count = 0.0;
    for scene in pictures {
        for link in scene.joints.iter().chain(&scene.forces) {
            let here = link
                .ends
                .iter()
                .zip(&link.carriers)
                .any(|(end, body)| body.is_none() && norm(&sub(&end.r, &at)) < 1e-9);
            for body in link.carriers.iter().flatten().filter(|_| here) {
                let way = sub(&scene.limbs[*body].centre.r, &at);
                sum = along(sum, direction(way).unwrap_or([0.0; 3]), 1.0);
                count += 1.0;
            }
        }
    }
    (count > 0.0).then(|| sum.map(|x| x / count))
}

fn support(pen: &mut Canvas, at: [f64; 3], (x, y): (f64, f64), is_wall: bool) {
    let size = x.hypot(y);
    // Away from the bodies: exactly for a wall, upwards or downwards for a bearing.
    let has_side = size > 1e-9;
    let out = if is_wall && has_side {
        (-x / size, -y / size)
    } else if y < -0.35 * size && has_side {
        (0.0, 1.0)
    } else {
        (0.0, -1.0)
    };
    pen.layer = Layer::Ground;
    pen.depth = pen.view.depth(at);
    let spot = pen.spot(at);
    let ink = pen.ink(0.25);
    let corner = |side: f64, far: f64| spot.moved(far * out.0 - side * out.1, far * out.1 + side * out.0);
    let base = if is_wall { 0.0 } else { 14.0 };
    if !is_wall {
        let triangle: Vec<Spot> = vec![corner(0.0, 0.0), corner(8.5, base), corner(-8.5, base)];
        pen.shape(triangle, ink, THIN, (crate::plot::Tint::Ink(1.0), 1.0));
    }
    pen.line(vec![corner(-14.0, base), corner(14.0, base)], ink, THIN);
    for k in 0..6 {
        let side = -11.0 + 5.0 * f64::from(k);
        pen.line(vec![corner(side, base), corner(side - 4.0, base + 6.0)], ink, 1.0);
    }
}
