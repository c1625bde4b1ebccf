//! Places of bodies that start elsewhere.

use super::facts::{Facts, PlacedMarker};
use crate::body::{dot, norm, sub};
use crate::math::array::{Each, from_fn};
use crate::math::rotation::{axes_from_quaternion, quaternion_from_axes, quaternion_from_vector, quaternion_product};
use crate::math::screw::quaternion;
use crate::scene::document::{elements, is_rigid, take, text};
use serde_json::{Value, json};
use std::f64::consts::{PI, TAU};

/// How far the bodies have gone at each state, as part of what they do at most.
pub fn progress(facts: &Facts) -> Vec<f64> {
    let travel = facts.travel();
    let mut most = vec![0.0f64; facts.states().len()];
    let part = |own: f64, all: f64| if all > 0.0 { own / all } else { 0.0 };
    let bodies = elements(facts.scene(), "bodies").iter();
    for path in bodies.filter_map(|body| facts.path(text(body, "name"))) {
        for (most, place) in most.iter_mut().zip(&path) {
            let gap = sub(&place.r, &path[0].r);
            let turn = rotation(&path[0], place);
            let shift = norm(&gap);
            let turn = norm(&turn);
            *most = most.max(part(shift, travel.shift)).max(part(turn, travel.turn));
        }
    }
    most
}

/// Writes the start of a body. One in space with freedoms of its own keeps the rotation from which they count.
pub fn start_at(body: &mut Value, place: &PlacedMarker, dimension: usize) {
    if !is_rigid(body) {
        return;
    }
    let is_point = text(body, "type") == "point_mass";
    let is_guided = body.get("free").is_some();
    if !body["initial"].is_object() {
        body["initial"] = json!({});
    }
    let initial = &mut body["initial"];
    initial["position"] = json!(place.r[..dimension]);
    initial["velocity"] = json!(place.velocity[..dimension]);
    if dimension == 2 && !is_point {
        (initial["angle"], initial["angular_velocity"]) = (json!(place.turn), json!(place.spin[2]));
    } else if !is_point && !is_guided {
        ["z_axis", "x_axis"].iter().for_each(|key| drop(take(initial, key)));
        initial["rotation"] = json!(quaternion_from_axes(&place.axes));
        initial["angular_velocity"] = json!(place.axes.each(|axis| dot(&axis, &place.spin)));
    }
}

/// A place moved by a part of the displacement from `first` to `now`.
pub fn further(place: &PlacedMarker, first: &PlacedMarker, now: &PlacedMarker, part: f64) -> PlacedMarker {
    let turned = quaternion_from_vector(&rotation(first, now).each(|x| part * x));
    PlacedMarker {
        r: from_fn(|i| place.r[i] + part * (now.r[i] - first.r[i])),
        axes: axes_from_quaternion(&quaternion_product(&turned, &quaternion_from_axes(&place.axes))),
        turn: place.turn + part * wrapped(now.turn - first.turn),
        ..*place
    }
}

/// Rotation vector from one place to another, in the world.
fn rotation(first: &PlacedMarker, now: &PlacedMarker) -> [f64; 3] {
    // R[i][j] = sum of now_k[i] first_k[j] over the axes k.
    let matrix: [[f64; 3]; 3] = from_fn(|i| from_fn(|j| (0..3).map(|k| now.axes[k][i] * first.axes[k][j]).sum()));
    let (w, x) = quaternion(&matrix);
    let half = norm(&x);
    let angle = 2.0 * half.atan2(w.abs());
    x.each(|x| if half > 0.0 { w.signum() * angle * x / half } else { 0.0 })
}

/// Angle of the second of two markers against the first, about its z axis.
pub fn angle(markers: &[PlacedMarker; 2]) -> f64 {
    let [one, other] = markers;
    dot(&one.axes[1], &other.axes[0]).atan2(dot(&one.axes[0], &other.axes[0]))
}

/// Displacement of the second of two markers along an axis of the first.
pub fn slide(markers: &[PlacedMarker; 2], axis: usize) -> f64 {
    let [one, other] = markers;
    dot(&one.axes[axis], &sub(&other.r, &one.r))
}

/// An angle between -pi and pi.
pub fn wrapped(angle: f64) -> f64 {
    angle - TAU * ((angle + PI) / TAU).floor()
}
