//! Random mechanisms as scenes: trees and loops of rods in the plane and in space, on springs with dampers.

use crate::scenes::{Ready, parse};
use serde_json::{Value, json};

/// What makes a mechanism, all else follows from it.
#[derive(Clone, Copy, Debug)]
pub struct Recipe {
    /// 2 or 3
    pub dimension: usize,
    pub rods: usize,
    /// Whether the last rod ends on the ground.
    pub is_loop: bool,
    /// Whether each rod but the first hangs on the one before it, or on any earlier one.
    pub is_chain: bool,
    /// Whether a constraint is stated twice.
    pub is_redundant: bool,
    pub seed: u64,
}

/// Numbers in (-1, 1), the same for the same seed.
pub struct Numbers(pub u64);

impl Numbers {
    pub fn next(&mut self) -> f64 {
        // Steele, Lea, Flood, "Fast splittable pseudorandom number generators" (2014).
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    pub fn point(&mut self, dimension: usize) -> Vec<f64> {
        (0..dimension).map(|_| self.next()).collect()
    }

    /// Between 0.5 and 1.5.
    fn size(&mut self) -> f64 {
        1.0 + 0.5 * self.next()
    }
}

fn add(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a + b).collect()
}

impl Recipe {
    pub fn scene(&self) -> Ready {
        parse(&self.json().to_string())
    }

    /// Rods begin at earlier ends and end about a metre away; all bodies have the axes of the ground at the start.
    pub fn json(&self) -> Value {
        let mut numbers = Numbers(self.seed);
        let mut ends = Vec::<Vec<f64>>::new();
        let mut ground = serde_json::Map::new();
        let mut bodies = Vec::new();
        let mut joints = Vec::new();
        let mut forces = Vec::new();
        ground.insert("O".to_string(), json!(vec![0.0; self.dimension]));
        for i in 0..self.rods {
            let before = if self.is_chain {
                i.checked_sub(1)
            } else {
                i.checked_sub(1).map(|last| self.seed as usize % (last + 1))
            };
            let (begin, socket) = match before {
                None => (vec![0.0; self.dimension], "ground.O".to_string()),
                Some(k) => (ends[k].clone(), format!("rod{k}.end")),
            };
            let mut along: Vec<f64> = numbers.point(self.dimension);
            along[i % self.dimension] += 1.5;
            ends.push(add(&begin, &along));
            bodies.push(self.rod(i, &begin, &along, &mut numbers));
            let pin = if self.dimension == 2 { "revolute" } else { "spherical" };
            joints
                .push(json!({ "name": format!("pin{i}"), "type": pin, "between": [socket, format!("rod{i}.begin")] }));
            ground.insert(format!("S{i}"), json!(add(&add(&begin, &along), &numbers.point(self.dimension))));
            forces.push(json!({
                "name": format!("spring{i}"), "type": "spring_damper", "between": [format!("ground.S{i}"), format!("rod{i}.side")],
                "stiffness": 100.0 * numbers.size(), "damping": numbers.size(), "free_length": 0.2 * numbers.size()
            }));
        }
        self.close(&ends, &mut ground, &mut joints);
        let gravity: Vec<f64> =
            (0..self.dimension).map(|i| if i + 1 == self.dimension { -9.81 } else { 0.0 }).collect();
        json!({
            "name": "random", "dimension": self.dimension, "gravity": gravity, "ground": { "markers": ground },
            "bodies": bodies, "joints": joints, "forces": forces
        })
    }

    fn rod(&self, i: usize, begin: &[f64], along: &[f64], numbers: &mut Numbers) -> Value {
        let half: Vec<f64> = along.iter().map(|x| 0.5 * x).collect();
        let back: Vec<f64> = half.iter().map(|x| -x).collect();
        let inertia = if self.dimension == 2 {
            json!(0.1 * numbers.size())
        } else {
            // Any three that differ by less than the triangle inequality allows.
            json!([0.1 * numbers.size(), 0.12, 0.1])
        };
        json!({
            "name": format!("rod{i}"), "type": "rigid", "mass": numbers.size(), "inertia": inertia,
            "markers": { "begin": back, "end": half, "side": numbers.point(self.dimension) },
            "initial": { "position": add(begin, &half) }
        })
    }

    fn close(&self, ends: &[Vec<f64>], ground: &mut serde_json::Map<String, Value>, joints: &mut Vec<Value>) {
        let last = ends.len() - 1;
        if self.is_loop {
            let pin = if self.dimension == 2 { "revolute" } else { "spherical" };
            ground.insert("E".to_string(), json!(ends[last]));
            joints.push(json!({ "name": "close", "type": pin, "between": ["ground.E", format!("rod{last}.end")] }));
        }
        if self.is_redundant {
            let length = ends[0].iter().map(|x| x * x).sum::<f64>().sqrt();
            joints.push(json!({
                "name": "again", "type": "distance", "between": ["ground.O", "rod0.end"], "length": length
            }));
        }
    }
}
