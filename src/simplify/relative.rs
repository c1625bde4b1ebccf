//! Motions of markers against each other.

use super::facts::{Facts, PlacedMarker};
use crate::body::{dot, norm, sub};
use crate::math::array::{Each, from_fn};
use crate::math::largest;
use crate::scene::document::{elements, text};

/// Motion of a marker against another, seen from that.
#[derive(Clone, Copy, Debug, Default)]
pub struct Relative {
    /// Largest distance of the second marker from where it is at the start, m.
    pub shift: f64,
    /// Largest angle between the z axes against that at the start, rad; zero in the plane.
    pub tilt: f64,
    /// Largest rotation against the start, rad.
    pub turn: f64,
}

impl Relative {
    /// The larger of displacement and rotation, each relative to that of `all`.
    pub fn part(&self, all: &Relative) -> f64 {
        let part = |motion: f64, all: f64| if motion > 0.0 { motion / all } else { 0.0 };
        part(self.shift, all.shift).max(part(self.turn, all.turn))
    }
}

impl Facts {
    /// Relative motion of the markers `a` and `b`.
    pub fn relative(&self, a: &str, b: &str) -> Option<Relative> {
        let pairs: Vec<(PlacedMarker, PlacedMarker)> = self.path(a)?.into_iter().zip(self.path(b)?).collect();
        let local = |(a, b): &(PlacedMarker, PlacedMarker)| {
            let gap = sub(&b.r, &a.r);
            let rotation: [[f64; 3]; 3] = from_fn(|i| from_fn(|j| dot(&a.axes[j], &b.axes[i])));
            (a.axes.each(|axis| dot(&axis, &gap)), rotation)
        };
        let start = local(pairs.first()?);
        let mut largest = Relative::default();
        for now in pairs.iter().map(local) {
            let shift = sub(&now.0, &start.0);
            let cosines: [f64; 3] = from_fn(|i| dot(&now.1[i], &start.1[i]));
            let trace: f64 = cosines.iter().sum();
            largest.shift = largest.shift.max(norm(&shift));
            largest.tilt = largest.tilt.max(cosines[2].clamp(-1.0, 1.0).acos());
            largest.turn = largest.turn.max((0.5 * (trace - 1.0)).clamp(-1.0, 1.0).acos());
        }
        Some(largest)
    }

    /// Length between the markers `a` and `b` along the motion: least, mean and largest, m.
    pub fn lengths(&self, a: &str, b: &str) -> Option<[f64; 3]> {
        let pairs = self.path(a)?.into_iter().zip(self.path(b)?);
        let length = |(a, b): (PlacedMarker, PlacedMarker)| norm(&sub(&b.r, &a.r));
        let lengths: Vec<f64> = pairs.map(length).collect();
        let least = lengths.iter().copied().fold(f64::INFINITY, f64::min);
        Some([least, lengths.iter().sum::<f64>() / lengths.len().max(1) as f64, largest(&lengths)])
    }

    /// Largest displacement, m, and largest rotation, rad, of the bodies of the scene against the start.
    pub fn travel(&self) -> Relative {
        let bodies = elements(self.scene(), "bodies").iter();
        let motions = bodies.filter_map(|body| self.relative("ground", text(body, "name")));
        motions.fold(Relative::default(), |largest, body| Relative {
            shift: largest.shift.max(body.shift),
            tilt: largest.tilt.max(body.tilt),
            turn: largest.turn.max(body.turn),
        })
    }
}
