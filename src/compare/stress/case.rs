//! One simulation before it is run.

use crate::simulate::Method;
use serde_json::Value;
use std::sync::Arc;

/// What a cell simulates: the scene as text, and how.
#[derive(Clone, Debug)]
pub struct Case {
    /// The scene, shared with other cases until it is changed; null for own equations.
    pub scene: Arc<Value>,
    /// Replaced parameters.
    pub set: Vec<(String, f64)>,
    pub method: Method,
    /// How long, s.
    pub duration: f64,
    /// What is usual for the motion, whose values do not follow changes.
    pub typical: Typical,
    /// Errors of the start along a fixed random direction: of the positions, as a part of the scene's size, and of the
    /// velocities, as a part of that over the period.
    pub start_error: [f64; 2],
}

/// Scales that values are chosen by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Typical {
    /// Mean step of the scene's own method, s.
    pub step: f64,
    /// Mean time from one upward crossing of its mean to the next, of the first output or coordinate that has two; the
    /// duration where none has, s.
    pub period: f64,
}
