//! Bushing: springs and dampers along and about all axes.

use super::{Action, BuiltForce, ForceKernel, ForceSpec, Instant, Motion};
use crate::body::{Build, Wrench, cross, dot, norm, scale, small_rotation, small_rotation_torque, sub, twist_len};
use crate::error::{Error, Result};
use crate::math::array::{Each, from_fn};
use crate::math::expression::Number;
use crate::math::{Scalar, Taylor};
use schemars::JsonSchema;
use serde::Deserialize;

/// Linear stiffness and damping against displacement and rotation of the second marker, in the axes of the first: 3
/// numbers (x, y, angle) in the plane, 6 (x, y, z, rx, ry, rz) in space. Rotations in space are meant to be small: the
/// rotation vector is that of the skew part of the relative rotation, of the length of its sine, and the torque is minus the
/// gradient of the energy stored in it. Runs in which it turns farther are warned of.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Bushing {
    /// Markers `body.marker` of two bodies.
    pub between: [String; 2],
    /// N/m and N m/rad.
    pub stiffness: Vec<Number>,
    /// N s/m and N m s/rad. Default: zero.
    pub damping: Option<Vec<Number>>,
}

impl ForceSpec for Bushing {
    const TYPE: &'static str = "bushing";

    fn build<const D: usize>(&self, build: &Build<D>) -> Result<BuiltForce<D>> {
        let markers = build.between(&self.between)?;
        build.oriented("between", &markers)?;
        let k = coefficients("stiffness", &self.stiffness, build)?;
        let c = self.damping.as_ref().map_or(Ok([0.0; 6]), |damping| coefficients("damping", damping, build))?;
        Ok(BuiltForce { force: Box::new(Cushion { k, c }), markers })
    }
}

fn coefficients<const D: usize>(field: &str, numbers: &[Number], build: &Build<D>) -> Result<[f64; 6]> {
    if numbers.len() != twist_len(D) {
        return Err(Error::input(format!("expected {} numbers, found {}", twist_len(D), numbers.len()))
            .under(field)
            .hint(if D == 2 { "along x and y and about z" } else { "along x, y, z and about x, y, z" }));
    }
    let mut all = [0.0; 6];
    for (i, number) in numbers.iter().enumerate() {
        all[i] = build.not_negative(&format!("{field}[{i}]"), number)?;
    }
    Ok(all)
}

struct Cushion {
    k: [f64; 6],
    c: [f64; 6],
}

impl Cushion {
    /// Force along coordinate i, -(k x + c x'), and the stored energy k x^2/2.
    fn law<S: Scalar>(&self, i: usize, displacement: Taylor<S>) -> (S, Taylor<S>) {
        let force = -(displacement.x * self.k[i] + displacement.d * self.c[i]);
        (force, displacement.square() * (0.5 * self.k[i]))
    }
}

impl<const D: usize> ForceKernel<D> for Cushion {
    fn depends_on_velocities(&self) -> bool {
        self.c.iter().any(|c| *c > 0.0)
    }

    fn takes_small_rotations(&self) -> bool {
        D == 3 && self.k[3..].iter().chain(&self.c[3..]).any(|coefficient| *coefficient > 0.0)
    }

    fn act<S: Scalar>(&self, frames: &Motion<S, D>, _: Instant<S>, out: &mut [Wrench<S, D>]) -> Action<S> {
        let [a, b] = [&frames[0], &frames[1]];
        let gap = sub(&b.r, &a.r);
        let mut potential = Taylor::fixed(S::zero());
        let mut force = [S::zero(); D];
        let mut torque = [S::zero(); 3];
        for (i, axis) in a.axes.iter().enumerate() {
            let (component, stored) = self.law(i, dot(axis, &gap));
            potential += stored;
            let along = scale(&axis.each(|x| x.x), component);
            force = from_fn(|k| force[k] + along[k]);
        }
        if D == 2 {
            let (moment, stored) = self.law(2, b.turn - a.turn);
            potential += stored;
            torque[2] = moment;
        } else {
            let rotation = small_rotation(a, b);
            let mut moment = [S::zero(); 3];
            for (i, axis) in a.axes.iter().enumerate() {
                let angle = (0..3).fold(Taylor::fixed(S::zero()), |sum, k| sum + axis[k] * rotation[k]);
                let (component, stored) = self.law(3 + i, angle);
                potential += stored;
                (0..3).for_each(|k| moment[k] += axis[k].x * component);
            }
            torque = small_rotation_torque(&a.map(|x| x.x), &b.map(|x| x.x), &moment);
        }
        // The reaction acts at the second marker too, so at the first it has the moment of the gap.
        let lever = cross(&gap.each(|x| x.x), &force);
        out[1] = Wrench { force, torque };
        out[0] = Wrench { force: force.each(|x| -x), torque: from_fn(|k| -(torque[k] + lever[k])) };
        Action { potential, magnitude: norm(&force) }
    }
}
