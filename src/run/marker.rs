//! Markers of a model at a state.

use super::Moment;
use crate::body::Frame;
use crate::error::{Result, find};
use crate::math::Taylor;
use crate::prepared::{AnyMechanism, Model};
use crate::system::Scratch;

/// A marker in the world; of a mechanism in the plane the third axis is that out of the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MarkerFrame {
    /// Origin, m.
    pub position: [f64; 3],
    /// Velocity of the origin, m/s.
    pub velocity: [f64; 3],
    /// Unit axes: `axes[i]` is the i-th.
    pub axes: [[f64; 3]; 3],
}

impl MarkerFrame {
    fn of<const D: usize>(frame: &Frame<Taylor<f64>, D>) -> Self {
        let mut marker = MarkerFrame { position: [0.0; 3], velocity: [0.0; 3], axes: [[0.0; 3]; 3] };
        marker.axes[2][2] = 1.0;
        for i in 0..D {
            marker.position[i] = frame.r[i].x;
            marker.velocity[i] = frame.r[i].d;
            (0..D).for_each(|j| marker.axes[i][j] = frame.axes[i][j].x);
        }
        marker
    }
}

impl Model {
    /// A marker, such as `crank.A`, or a body's own frame, `crank`, at a state.
    ///
    /// # Errors
    /// An unknown name.
    pub fn marker(&self, name: &str, at: &Moment) -> Result<MarkerFrame> {
        let names = &self.mechanism.markers().names;
        let place = find("marker", name, names.iter().map(String::as_str))?;
        let scratch = &mut Scratch::default();
        Ok(match &self.mechanism {
            AnyMechanism::Planar(mechanism) => MarkerFrame::of(&mechanism.frames(&at.q, &at.v, scratch)[place]),
            AnyMechanism::Spatial(mechanism) => MarkerFrame::of(&mechanism.frames(&at.q, &at.v, scratch)[place]),
        })
    }
}
