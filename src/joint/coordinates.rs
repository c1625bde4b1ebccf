//! The coordinates that a joint leaves free, by name, and the rows that give them values.

use super::driver::{angle_beyond, relative_turn};
use super::lock::{ALL_BUT_Z, Lock, NONE};
use super::{Joint, JointKernel};
use crate::body::{Frame, dot, sub};
use crate::math::{Scalar, Time};

/// A relative coordinate of a joint's second marker against its first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum JointCoordinate {
    /// Along this axis of the joint, m.
    Translation(usize),
    /// About the joint's axis, rad.
    Angle,
    /// Of a universal joint, about its pin in the first marker, rad.
    FirstPin,
    /// Of a universal joint, about its pin in the second marker, rad.
    SecondPin,
}

impl<const D: usize> Lock<D> {
    /// Names of the coordinates that it leaves free, as far as each is one number: `position` along its only free axis
    /// (`x` and `y` of two), `angle`, and `angle1` and `angle2` of a universal joint.
    pub fn coordinates(&self) -> Vec<(&'static str, JointCoordinate)> {
        use JointCoordinate::*;
        let free: Vec<usize> = (0..D).filter(|axis| !self.translation.contains(axis)).collect();
        let translations = match free[..] {
            [axis] => vec![("position", Translation(axis))],
            [x, y] => vec![("x", Translation(x)), ("y", Translation(y))],
            _ => Vec::new(),
        };
        let rotations = match self.rotation {
            _ if D == 2 && self.rotation == NONE => vec![("angle", Angle)],
            _ if D == 3 && self.rotation == ALL_BUT_Z => vec![("angle", Angle)],
            [(0, 1)] if D == 3 => vec![("angle1", FirstPin), ("angle2", SecondPin)],
            _ => Vec::new(),
        };
        translations.into_iter().chain(rotations).collect()
    }
}

/// The row coordinate - value - rate t of a joint that locks what `lock` does.
pub fn given<const D: usize>(lock: Lock<D>, coordinate: JointCoordinate, value: f64, rate: f64) -> Box<dyn Joint<D>> {
    Box::new(GivenCoordinate { lock, coordinate, value, rate })
}

struct GivenCoordinate<const D: usize> {
    lock: Lock<D>,
    coordinate: JointCoordinate,
    value: f64,
    rate: f64,
}

impl<const D: usize> JointKernel<D> for GivenCoordinate<D> {
    fn row_names(&self) -> Vec<&'static str> {
        vec![match self.coordinate {
            JointCoordinate::Translation(_) => "x",
            _ => "angle",
        }]
    }

    fn depends_on_time(&self) -> bool {
        self.rate != 0.0
    }

    fn phi<S: Scalar>(&self, frames: &[Frame<S, D>], time: Time<S>, out: &mut [S]) {
        let [a, b] = [&frames[0], &frames[1]];
        let value = time.t * self.rate + self.value;
        let axis = |frame: &Frame<S, D>, i: usize| self.lock.axis(frame, i);
        // Cosine and sine of the angle.
        let turned = match self.coordinate {
            JointCoordinate::Translation(i) => {
                out[0] = dot(&axis(a, i), &sub(&b.r, &a.r)) - value;
                return;
            }
            JointCoordinate::Angle if D == 2 => {
                out[0] = b.turn - a.turn - value;
                return;
            }
            JointCoordinate::Angle => relative_turn(&self.lock, a, b),
            // R = R_x(angle1) R_y(angle2): y_B is turned from y_A about x_A, x_B from x_A about y_B.
            JointCoordinate::FirstPin => (dot(&axis(a, 1), &axis(b, 1)), dot(&axis(a, 2), &axis(b, 1))),
            JointCoordinate::SecondPin => (dot(&axis(a, 0), &axis(b, 0)), dot(&axis(a, 0), &axis(b, 2))),
        };
        out[0] = angle_beyond(turned, value);
    }
}
