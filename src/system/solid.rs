//! Rigid bodies at a state: derivatives along their velocities, without those of their coordinates.

use super::gather::MovingFrames;
use super::seed::{SeedDirection, fix};
use crate::body::{Dual6, Frame, Freedom, Wrench, cross, sub};
use crate::math::array::{Each, from_fn};
use crate::math::{Scalar, Taylor};
use crate::scene::Part;

/// A rigid body at a state. A direction of its velocities is a translation t of the centre c or a rotation u about it.
/// With r = c + a for a point and e for an axis, and the angular velocity w,
///
/// ```text
/// along q, at fixed v and v':  d(r, r', r'') = (t, 0, 0) or (u x a, u x a', u x a''),  d(e, e', e'') likewise
/// along v:                     d(r', r'') = (t, 0) or (u x a, u x a' + w x (u x a))
/// along v':                    d(r'') = t or u x a
/// ```
///
/// for coordinates change as if all that the body carries were translated or turned, rates with it.
pub(super) struct Solid<const D: usize> {
    /// World axes of the translations, of which as many count as there are.
    components: [usize; 3],
    translations: usize,
    /// Axes of the rotations in the world, likewise.
    axes: [[f64; D]; 3],
    rotations: usize,
    /// The centre with its motion.
    pub centre: [Taylor<f64>; D],
    /// Angular velocity in the world.
    spin: [f64; 3],
    /// Number of the first of its directions among those that are differentiated along.
    first: usize,
}

impl<const D: usize> Solid<D> {
    /// A body at the frames `motion` of all markers.
    pub fn new(part: &Part<D>, freedom: &Freedom, motion: &MovingFrames<D>) -> Self {
        let own = &motion[part.first_marker];
        let offset = &part.body.markers()[0].offset;
        let mut centre = own.r;
        for (axis, &x) in own.axes.iter().zip(offset).filter(|(_, x)| **x != 0.0) {
            centre.iter_mut().zip(axis).for_each(|(centre, &axis)| *centre -= axis * x);
        }
        let Freedom { translations, rotations } = freedom;
        let mut components = [0; 3];
        let mut axes = [[0.0; D]; 3];
        components.iter_mut().zip(translations).for_each(|(component, &k)| *component = k);
        for (axis, turn) in axes.iter_mut().zip(rotations) {
            *axis = from_fn(|i| own.axes.iter().zip(turn).map(|(e, part)| e[i].x * part).sum());
        }
        let translations = translations.len();
        let rotations = rotations.len();
        Solid { components, translations, axes, rotations, centre, spin: own.angular_velocity(), first: 0 }
    }

    /// The same with its directions behind those of another body.
    pub fn behind(self, other: &Self) -> Self {
        Solid { first: other.count(), ..self }
    }

    /// Number of the first of its directions among those that are differentiated along.
    pub fn first(&self) -> usize {
        self.first
    }

    /// The position of the centre.
    pub fn place(&self) -> [f64; D] {
        self.centre.each(|c| c.x)
    }

    /// Number of velocities.
    pub fn count(&self) -> usize {
        self.translations + self.rotations
    }

    /// Components of the translations with their velocities.
    pub fn translations(&self) -> impl Iterator<Item = (usize, usize)> {
        self.components.iter().copied().zip(0..self.translations)
    }

    /// Numbers of the axes of rotation with their velocities.
    pub fn rotations(&self) -> impl Iterator<Item = (usize, usize)> {
        (0..self.rotations).map(|k| (k, self.translations + k))
    }

    /// u x a for axis number `k`.
    #[inline]
    pub fn turned(&self, k: usize, a: &[f64; D]) -> [f64; D] {
        if D == 2 {
            return from_fn(|i| [-a[1], a[0]][i]);
        }
        let turned = cross(&self.axes[k], a);
        from_fn(|i| turned[i])
    }

    /// u . m for axis number `k`.
    #[inline]
    pub fn about<S: Scalar>(&self, k: usize, m: &[S; 3]) -> S {
        if D == 2 {
            return m[2];
        }
        m[0] * self.axes[k][0] + m[1] * self.axes[k][1] + m[2] * self.axes[k][D - 1]
    }

    /// u . p for axis number `k`; zero in the plane.
    #[inline]
    pub fn along(&self, k: usize, p: &[f64; D]) -> f64 {
        (0..D).map(|i| self.axes[k][i] * p[i]).sum()
    }

    /// The axis of a rotation in space.
    pub fn axis(&self, k: usize) -> &[f64; D] {
        &self.axes[k]
    }

    /// The frame of one of its markers, differentiated along all of its velocities.
    pub fn seed(&self, along: SeedDirection, frame: &Frame<Taylor<f64>, D>, out: &mut Frame<Taylor<Dual6>, D>) {
        fix(frame, out);
        for (i, velocity) in self.translations() {
            along.level(&mut out.r[i]).eps[self.first + velocity] = 1.0;
        }
        let arm = sub(&frame.r, &self.centre);
        for (k, velocity) in self.rotations() {
            self.turn(along, k, self.first + velocity, &arm, &mut out.r);
            frame
                .axes
                .iter()
                .zip(&mut out.axes)
                .for_each(|(e, out)| self.turn(along, k, self.first + velocity, e, out));
            if D == 2 {
                along.level(&mut out.turn).eps[self.first + velocity] = 1.0;
            }
        }
    }

    /// Writes the derivatives of a vector that the body carries along one rotation.
    #[inline]
    fn turn(
        &self,
        along: SeedDirection,
        k: usize,
        direction: usize,
        a: &[Taylor<f64>; D],
        out: &mut [Taylor<Dual6>; D],
    ) {
        let turned = self.turned(k, &a.each(|a| a.x));
        (0..D).for_each(|i| along.level(&mut out[i]).eps[direction] = turned[i]);
        if along == SeedDirection::Accelerations {
            return;
        }
        let mut rate = self.turned(k, &a.each(|a| a.d));
        if along == SeedDirection::Coordinates {
            let curvature = self.turned(k, &a.each(|a| a.dd));
            (0..D).for_each(|i| out[i].d.eps[direction] = rate[i]);
            rate = curvature;
        } else {
            let spun = spun(&self.spin, &turned);
            (0..D).for_each(|i| rate[i] += spun[i]);
        }
        (0..D).for_each(|i| out[i].dd.eps[direction] = rate[i]);
    }

    /// f += J^T w for a wrench at a point; `is_varied` if the derivatives are those along its own coordinates.
    pub fn pull_back(&self, is_varied: bool, at: &[Dual6; D], wrench: &Wrench<Dual6, D>, f: &mut [Dual6]) {
        let mut centre = self.centre.each(|c| Dual6::fixed(c.x));
        for (i, velocity) in self.translations() {
            centre[i].eps[self.first + velocity] = f64::from(u8::from(is_varied));
            f[velocity] += wrench.force[i];
        }
        let lever = cross(&sub(at, &centre), &wrench.force);
        let moment: [Dual6; 3] = from_fn(|i| wrench.torque[i] + lever[i]);
        for (k, velocity) in self.rotations() {
            f[velocity] += self.about(k, &moment);
            if is_varied {
                // The axes turn too: d(u_k) = u_l x u_k.
                let m = from_fn(|i| moment[i].re);
                for (l, other) in self.rotations() {
                    f[velocity].eps[self.first + other] += self.along(l, &self.turned(k, &m));
                }
            }
        }
    }
}

/// w x a
fn spun<const D: usize>(w: &[f64; 3], a: &[f64; D]) -> [f64; D] {
    if D == 2 {
        return from_fn(|i| [-w[2] * a[1], w[2] * a[0]][i]);
    }
    let w: [f64; D] = from_fn(|i| w[i]);
    let spun = cross(&w, a);
    from_fn(|i| spun[i])
}
