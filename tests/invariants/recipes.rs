//! Random mechanisms, and the same ones seen otherwise.

use crate::scenes::random::{Numbers, Recipe};
use serde_json::{Value, json};

/// Trees and loops, planar and spatial, every fifth one with a constraint stated twice.
pub fn recipe(number: u64) -> Recipe {
    let dimension = 2 + (number % 2) as usize;
    // A planar loop of two rods is stiff.
    let is_loop = number % 4 >= 2;
    let rods = 2 + (number / 2 % 3) as usize;
    let is_loop = is_loop && rods + dimension > 4;
    Recipe {
        dimension,
        rods,
        is_loop,
        is_chain: is_loop || number.is_multiple_of(3),
        is_redundant: number % 5 == 4,
        seed: number,
    }
}

/// Without the joints, springs and weights that come from outside, and moving: springs pull between the rods.
pub fn floating(number: u64) -> Value {
    let mut scene = Recipe { is_loop: false, is_redundant: false, ..recipe(number) }.json();
    let mut numbers = Numbers(number);
    let dimension = scene["dimension"].as_u64().unwrap() as usize;
    let rods = scene["bodies"].as_array().unwrap().len();
    scene["joints"].as_array_mut().unwrap().remove(0);
    scene["gravity"] = json!(vec![0.0; dimension]);
    for (i, spring) in scene["forces"].as_array_mut().unwrap().iter_mut().enumerate() {
        spring["between"][0] = json!(format!("rod{}.side", (i + 1) % rods));
    }
    for body in scene["bodies"].as_array_mut().unwrap() {
        body["initial"]["velocity"] = json!(numbers.point(dimension));
        body["initial"]["angular_velocity"] =
            if dimension == 2 { json!(numbers.next()) } else { json!(numbers.point(3)) };
    }
    scene
}

/// Bodies, joints and forces in the opposite order.
pub fn reversed(mut scene: Value) -> Value {
    for key in ["bodies", "joints", "forces"] {
        scene[key].as_array_mut().unwrap().reverse();
    }
    scene
}

/// A displacement of everything: a turn about the last axis of the plane or of space, and a shift.
#[derive(Clone, Copy)]
pub struct Displacement {
    pub angle: f64,
    pub shift: [f64; 3],
}

impl Displacement {
    pub fn turned(&self, point: &[f64]) -> Vec<f64> {
        let (sin, cos) = self.angle.sin_cos();
        let mut turned = point.to_vec();
        (turned[0], turned[1]) = (cos * point[0] - sin * point[1], sin * point[0] + cos * point[1]);
        turned
    }

    pub fn moved(&self, point: &[f64]) -> Vec<f64> {
        self.turned(point).iter().zip(self.shift).map(|(x, shift)| x + shift).collect()
    }

    pub fn scene(&self, mut scene: Value) -> Value {
        let numbers =
            |value: &Value| -> Vec<f64> { value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect() };
        scene["gravity"] = json!(self.turned(&numbers(&scene["gravity"])));
        for marker in scene["ground"]["markers"].as_object_mut().unwrap().values_mut() {
            *marker = json!(self.moved(&numbers(marker)));
        }
        let is_planar = scene["dimension"] == 2;
        for body in scene["bodies"].as_array_mut().unwrap() {
            let initial = &mut body["initial"];
            initial["position"] = json!(self.moved(&numbers(&initial["position"])));
            if is_planar {
                initial["angle"] = json!(self.angle)
            } else {
                initial["rotation"] = json!([0.0, 0.0, self.angle])
            }
        }
        scene
    }
}
