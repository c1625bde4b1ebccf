//! Scalars read off markers.

use super::frame::{cross, dot, norm, sub, turned};
use super::turning::TurnAxes;
use super::{Frame, MarkerId, MarkerTable};
use crate::math::array::{Each, from_fn};
use crate::math::{Regime, Scalar, Taylor};
use std::borrow::Borrow;

/// One scalar of a marker, or of a marker against another one, or a rate of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Probe {
    /// Marker that is measured.
    pub of: MarkerId,
    /// Marker against which and in whose axes it is measured; `None` is the world.
    pub to: Option<MarkerId>,
    /// Component that is read.
    pub quantity: Quantity,
    /// Number of time derivatives: 0 for a position, 1 for a velocity, 2 for an acceleration.
    pub order: usize,
}

/// Quantity of markers that a probe reads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Quantity {
    /// Coordinate of the origin of `of` along an axis of `to`, m.
    Position(usize),
    /// The same along a direction given in the axes of `to`, m.
    Along([f64; 3]),
    /// Distance of the origins, m.
    Distance,
    /// Angle in the plane, rad.
    Angle,
    /// Angle in space, rad, counted through full turns.
    Turn {
        /// Index of the counted angle, as [`Build::turning`](super::Build::turning) gives it.
        turning: usize,
        /// The angle at the start is within half a turn of this, rad.
        start: f64,
        /// 1 or -1.
        factor: f64,
        /// Axes by which it is measured; `None` for x of `of` in the x-y plane of `to`.
        axes: Option<TurnAxes>,
    },
    /// Component of the angular velocity along an axis of `to`, rad/s, in the plane the third; its order is 1 or 2.
    Spin(usize),
    /// Component of the angular velocity along an axis of the marker itself, rad/s, in space; its order is 1 or 2.
    OwnSpin(usize),
    /// Value of the scene's output of this number, in SI units; in other outputs alone, which know what it is.
    Output(usize),
}

const AXES: [&str; 3] = ["x", "y", "z"];

impl Probe {
    /// A quantity of `of` against `to`; the marker 0 is the world.
    pub fn new(of: MarkerId, to: MarkerId, quantity: Quantity, order: usize) -> Self {
        Probe { of, to: (to != 0).then_some(to), quantity, order }
    }

    /// `body.marker.x`, `body.x`, `body.angle`, with `'` and `''` for rates; `body.wx` and `body.wx'` in space, about
    /// its own axes.
    pub fn parse<const D: usize>(name: &str, markers: &MarkerTable) -> Option<Probe> {
        let (place, quantity) = name.rsplit_once('.')?;
        let of = markers.find(place).ok()?;
        let base = quantity.trim_end_matches('\'');
        let primes = quantity.len() - base.len();
        let axis = |text: &str| AXES[..D].iter().position(|axis| *axis == text);
        let (quantity, order) = match base.strip_prefix('w') {
            Some(about) if D == 3 => (Quantity::OwnSpin(axis(about)?), primes + 1),
            _ if base == "angle" && D == 2 => (Quantity::Angle, primes),
            _ => (Quantity::Position(axis(base)?), primes),
        };
        (order <= 2).then_some(Probe { of, to: None, quantity, order })
    }

    /// The value of an output.
    pub fn output(number: usize) -> Self {
        Probe { of: 0, to: None, quantity: Quantity::Output(number), order: 0 }
    }

    /// True if the value may depend on derivatives of this order.
    pub fn feels(&self, order: usize) -> bool {
        self.order >= order || matches!(self.quantity, Quantity::Output(_))
    }

    /// The rate of the quantity, if it has one.
    pub fn rate(self) -> Option<Probe> {
        (self.order < 2).then_some(Probe { order: self.order + 1, ..self })
    }

    /// The markers that it reads.
    pub fn markers(&self) -> impl Iterator<Item = MarkerId> {
        std::iter::once(self.of).chain(self.to)
    }

    /// Value of a quantity of order zero.
    pub fn position<S, F, const D: usize>(&self, regime: Regime, frame: impl Fn(MarkerId) -> F) -> S
    where
        S: Scalar,
        F: Borrow<Frame<S, D>>,
    {
        let of = frame(self.of);
        let to = self.to.map(&frame);
        let of = of.borrow();
        let to = to.as_ref().map(|to| to.borrow());
        let gap = || to.map_or(of.r, |to| sub(&of.r, &to.r));
        match self.quantity {
            Quantity::Position(axis) => to.map_or(of.r[axis], |to| dot(&to.axes[axis], &gap())),
            Quantity::Along(direction) => match to {
                Some(to) => dot(&turned(&to.axes, &direction), &gap()),
                None => gap().iter().zip(direction).fold(S::zero(), |sum, (&gap, x)| sum + gap * x),
            },
            Quantity::Distance => norm(&gap()),
            Quantity::Angle => to.map_or(of.turn, |to| of.turn - to.turn),
            Quantity::Turn { turning, start, factor, axes } => {
                let axes = axes.unwrap_or(TurnAxes::OWN);
                let (c, s) = match to {
                    Some(to) => axes.cos_sin(of, to),
                    None => axes.cos_sin(of, &Frame::world()),
                };
                // The first axis of one is along the third of the other: the angle and its derivative are undefined.
                let undefined = s.value() == 0.0 && c.value() == 0.0;
                let angle = if undefined { S::zero() } else { S::atan2(s, c) * factor };
                regime.angle(turning, angle, start)
            }
            Quantity::Spin(_) | Quantity::OwnSpin(_) | Quantity::Output(_) => S::zero(),
        }
    }

    /// Value at moving frames.
    pub fn read<S, F, const D: usize>(&self, regime: Regime, frame: impl Fn(MarkerId) -> F) -> S
    where
        S: Scalar,
        F: Borrow<Frame<Taylor<S>, D>>,
    {
        match self.quantity {
            Quantity::Spin(axis) => self.spin(axis, frame),
            Quantity::OwnSpin(axis) => own_spin(axis, frame(self.of).borrow(), self.order),
            Quantity::Distance if self.order > 0 => self.distance_rate(frame),
            _ => level(self.position(regime, frame), self.order),
        }
    }

    /// Component of the angular velocity, or its rate.
    fn spin<S, F, const D: usize>(&self, axis: usize, frame: impl Fn(MarkerId) -> F) -> S
    where
        S: Scalar,
        F: Borrow<Frame<Taylor<S>, D>>,
    {
        let of = frame(self.of);
        let Some(to) = self.to.map(frame) else {
            return match self.order {
                1 => of.borrow().angular_velocity()[axis],
                _ => of.borrow().spin()[axis].d,
            };
        };
        let spin = sub(&of.borrow().spin(), &to.borrow().spin());
        match D {
            2 => level(spin[2], self.order - 1),
            _ => level(dot(&to.borrow().axes[axis], &from_fn(|i| spin[i])), self.order - 1),
        }
    }

    /// Rate of the distance: at zero distance, where it has none, the speed of separation.
    fn distance_rate<S, F, const D: usize>(&self, frame: impl Fn(MarkerId) -> F) -> S
    where
        S: Scalar,
        F: Borrow<Frame<Taylor<S>, D>>,
    {
        let of = frame(self.of).borrow().r;
        let gap = self.to.map_or(of, |to| sub(&of, &frame(to).borrow().r));
        let is_closed = norm(&gap.each(|x| x.x)).value() == 0.0;
        if is_closed && self.order == 1 { norm(&gap.each(|x| x.d)) } else { level(norm(&gap), self.order) }
    }
}

fn own_spin<S: Scalar, const D: usize>(axis: usize, of: &Frame<Taylor<S>, D>, order: usize) -> S {
    let spin = of.spin();
    level(dot(&of.axes[axis], &from_fn(|i| spin[i])), order - 1)
}

/// Time derivative of this order.
fn level<S>(x: Taylor<S>, order: usize) -> S {
    match order {
        0 => x.x,
        1 => x.d,
        _ => x.dd,
    }
}

/// Rotation vector, rad, that turns frame `a` into frame `b`, for small relative rotations: the sum of the cross
/// products of their axes, halved.
pub fn small_rotation<S: Scalar, const D: usize>(a: &Frame<S, D>, b: &Frame<S, D>) -> [S; 3] {
    let mut twice = [S::zero(); 3];
    for (from, to) in a.axes.iter().zip(&b.axes) {
        let turn = cross(from, to);
        (0..3).for_each(|i| twice[i] += turn[i]);
    }
    twice.each(|x| x * 0.5)
}

/// Torque on `b`, with its opposite on `a`, whose power is `moment` times the rate of [`small_rotation`]: with
/// b' = w x b, 2 rotation' = (sum a_j . b_j) w - sum b_j (a_j . w), so the torque is the transpose of that.
pub fn small_rotation_torque<S: Scalar, const D: usize>(a: &Frame<S, D>, b: &Frame<S, D>, moment: &[S; 3]) -> [S; 3] {
    let mut torque = [S::zero(); 3];
    for (from, to) in a.axes.iter().zip(&b.axes) {
        let cosine = dot(from, to);
        let along = (0..D).fold(S::zero(), |sum, k| sum + to[k] * moment[k]);
        (0..D).for_each(|k| torque[k] += (cosine * moment[k] - from[k] * along) * 0.5);
    }
    torque
}
