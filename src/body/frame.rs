//! Frames: the position and orientation of a marker, through which joints and forces see a body.

use crate::math::array::{Each, from_fn};
use crate::math::{Dual, Scalar, Taylor};

/// Number of components of a twist or wrench: (x, y, angle) in the plane, three and three in space.
pub const fn twist_len(dimension: usize) -> usize {
    if dimension == 2 { 3 } else { 6 }
}

/// Position and orientation of a marker in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame<S, const D: usize> {
    /// Origin in the world, m.
    pub r: [S; D],
    /// `axes[i]` is the marker's i-th unit axis in the world.
    pub axes: [[S; D]; D],
    /// Angle of turn in the plane, rad, counted through full turns; zero in space, where no such angle exists.
    pub turn: S,
}

/// Force and torque that act at a marker, in world components. In the plane only `torque[2]` counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench<S, const D: usize> {
    /// Force, N.
    pub force: [S; D],
    /// Torque about the marker's origin, N m.
    pub torque: [S; 3],
}

/// A frame fixed to a rigid body, in the body's axes and from its centre of mass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Marker<const D: usize> {
    /// Position in the body's frame, m.
    pub offset: [f64; D],
    /// Unit axes in the body's axes: `axes[i]` is the i-th.
    pub axes: [[f64; D]; D],
    /// Angle against the body in the plane, rad; zero in space.
    pub turn: f64,
}

impl<const D: usize> Marker<D> {
    /// A point whose axes are the body's.
    pub fn point(offset: [f64; D]) -> Self {
        Marker { offset, axes: from_fn(|i| from_fn(|j| if i == j { 1.0 } else { 0.0 })), turn: 0.0 }
    }
}

impl<S: Scalar, const D: usize> Frame<S, D> {
    /// The world's own frame.
    pub fn world() -> Self {
        Frame { r: [S::zero(); D], axes: unit_axes(), turn: S::zero() }
    }

    /// The frame of a marker that is fixed in this one.
    #[inline]
    pub fn at(&self, marker: &Marker<D>) -> Self {
        let mut r = self.r;
        add_rotated(&mut r, &self.axes, &marker.offset);
        let axes = from_fn(|i| {
            let mut axis = [S::zero(); D];
            add_rotated(&mut axis, &self.axes, &marker.axes[i]);
            axis
        });
        Frame { r, axes, turn: self.turn + marker.turn }
    }

    /// The frame with `change` applied to each number.
    #[inline]
    pub fn map<T: Scalar>(&self, change: impl Fn(S) -> T) -> Frame<T, D> {
        Frame { r: self.r.map(&change), axes: self.axes.each(|axis| axis.map(&change)), turn: change(self.turn) }
    }
}

/// target += sum_j components_j axes_j
#[inline]
fn add_rotated<S: Scalar, const D: usize>(target: &mut [S; D], axes: &[[S; D]; D], components: &[f64; D]) {
    for (axis, &component) in axes.iter().zip(components) {
        if component != 0.0 {
            for (t, &a) in target.iter_mut().zip(axis) {
                *t += a * component;
            }
        }
    }
}

impl<const D: usize> Frame<f64, D> {
    /// The marker with its axes, given in those of this frame, in the axes that this frame itself is given in.
    pub fn carry(&self, marker: Marker<D>) -> Marker<D> {
        let Frame { axes, turn, .. } = self.at(&marker);
        Marker { axes, turn, ..marker }
    }
}

impl<S: Scalar, const D: usize> Frame<Taylor<S>, D> {
    /// Velocity of the origin, m/s.
    pub fn velocity(&self) -> [S; D] {
        self.r.each(|x| x.d)
    }

    /// Angular velocity in the world, rad/s, from w x e = e' for each axis; in the plane (0, 0, turn').
    pub fn angular_velocity(&self) -> [S; 3] {
        if D == 2 {
            return [S::zero(), S::zero(), self.turn.d];
        }
        let mut twice = [S::zero(); 3];
        for axis in &self.axes {
            let spin = cross(&axis.each(|a| a.x), &axis.each(|a| a.d));
            (0..3).for_each(|i| twice[i] += spin[i]);
        }
        twice.each(|w| w * 0.5)
    }

    /// Angular velocity w in the world, rad/s, and w' = (sum e x e'')/2, rad/s^2, as its rate.
    pub fn spin(&self) -> [Taylor<S>; 3] {
        let mut twice = [S::zero(); 3];
        for axis in &self.axes {
            let change = cross(&axis.each(|a| a.x), &axis.each(|a| a.dd));
            (0..3).for_each(|i| twice[i] += change[i]);
        }
        if D == 2 {
            twice[2] = self.turn.dd * 2.0;
        }
        let w = self.angular_velocity();
        from_fn(|i| Taylor::new(w[i], twice[i] * 0.5, S::zero()))
    }
}

impl<S: Scalar, const D: usize> Frame<S, D> {
    /// The frame with its derivatives along its own twist: direction `first` moves it along x; rotations are about the
    /// world's axes through its origin, so de = w x e.
    #[inline]
    #[doc(hidden)]
    pub fn seeded(&self, first: usize) -> Frame<Dual<S, 6>, D> {
        let mut frame = self.map(Dual::fixed);
        for i in 0..D {
            frame.r[i].eps[first + i] = S::one();
        }
        if D == 2 {
            frame.turn.eps[first + 2] = S::one();
        }
        for (axis, seeded) in self.axes.iter().zip(&mut frame.axes) {
            if D == 2 {
                seeded[0].eps[first + 2] = -axis[1];
                seeded[1].eps[first + 2] = axis[0];
            } else {
                for k in 0..3 {
                    let next = (k + 1) % 3;
                    let last = (k + 2) % 3;
                    // (e_k x a): component next is -a_last, component last is a_next.
                    seeded[next].eps[first + 3 + k] = -axis[last];
                    seeded[last].eps[first + 3 + k] = axis[next];
                }
            }
        }
        frame
    }
}

impl<S: Scalar, const D: usize> Wrench<S, D> {
    /// No force and no torque.
    pub fn zero() -> Self {
        Wrench { force: [S::zero(); D], torque: [S::zero(); 3] }
    }

    /// From the components in the order of a twist: (fx, fy, m) in the plane, force and torque in space.
    #[inline]
    pub fn from_twist_order(components: &[S]) -> Self {
        let mut wrench = Self::zero();
        wrench.force.copy_from_slice(&components[..D]);
        if D == 2 {
            wrench.torque[2] = components[2];
        } else {
            wrench.torque.copy_from_slice(&components[3..6]);
        }
        wrench
    }
}

impl<S: Scalar, const D: usize> Wrench<S, D> {
    /// Power of the wrench at a moving frame, f.v + m.w, W.
    pub fn power(&self, frame: &Frame<Taylor<S>, D>) -> S {
        let force = frame.r.iter().zip(self.force).fold(S::zero(), |sum, (r, f)| sum + r.d * f);
        let has_torque = self.torque != [S::zero(); 3];
        if has_torque { force + dot(&frame.angular_velocity(), &self.torque) } else { force }
    }
}

/// The axes of the world.
pub fn unit_axes<S: Scalar, const D: usize>() -> [[S; D]; D] {
    from_fn(|i| from_fn(|j| if i == j { S::one() } else { S::zero() }))
}

/// Unit vector along axis k.
#[inline]
pub fn unit(k: usize) -> [f64; 3] {
    from_fn(|i| if i == k { 1.0 } else { 0.0 })
}

/// a . b
#[inline]
pub fn dot<S: Scalar, const D: usize>(a: &[S; D], b: &[S; D]) -> S {
    let mut sum = a[0] * b[0];
    for i in 1..D {
        sum += a[i] * b[i];
    }
    sum
}

/// Length of a vector; at zero, where it is not differentiable, the derivatives are zero.
#[inline]
pub fn norm<S: Scalar, const D: usize>(a: &[S; D]) -> S {
    let square = dot(a, a);
    if square.value() == 0.0 { S::zero() } else { square.sqrt() }
}

/// a - b
#[inline]
pub fn sub<S: Scalar, const D: usize>(a: &[S; D], b: &[S; D]) -> [S; D] {
    from_fn(|i| a[i] - b[i])
}

/// factor a
#[inline]
pub fn scale<S: Scalar, const D: usize>(a: &[S; D], factor: S) -> [S; D] {
    a.each(|x| x * factor)
}

/// The vector with these components along axes.
#[inline]
pub fn turned<S: Scalar, const D: usize>(axes: &[[S; D]; D], components: &[f64; 3]) -> [S; D] {
    let mut vector = [S::zero(); D];
    add_rotated(&mut vector, axes, &from_fn(|i| components[i]));
    vector
}

/// A vector of the plane as one of space, with z = 0.
pub fn in_space<const D: usize>(vector: &[f64; D]) -> [f64; 3] {
    from_fn(|i| if i < D { vector[i] } else { 0.0 })
}

/// a x b in space; in the plane the vectors lie in it and only the third component is not zero.
#[inline]
pub fn cross<S: Scalar, const D: usize>(a: &[S; D], b: &[S; D]) -> [S; 3] {
    let z = a[0] * b[1] - a[1] * b[0];
    if D == 2 {
        return [S::zero(), S::zero(), z];
    }
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], z]
}
