//! Mechanisms so far from the origin that the rounding of their positions exceeds the tolerance.

use super::AnyMechanism;
use crate::body::{norm, sub};
use crate::error::{Error, Result, short, two_digits};
use crate::math::array::Each;
use crate::math::largest;
use crate::scene::Connection;
use crate::simulate::Method;
use crate::system::{MechanicalSystem, Mechanism, Scratch};

/// Rounding of a lever that steps can be controlled with. Unit: `[1]` of rtol. Why: with 2 a double pendulum took three
/// times the steps, with 20 two hundred times. Test: `a_tolerance_below_the_rounding_of_positions_is_refused`.
const ROUNDING_TOLERATED: f64 = 4.0;

/// Refuses a tolerance that no step can keep: a position x is known to eps x, and the direction of a lever l to eps x/l,
/// by which velocities and accelerations are off. Shorter steps do not improve that.
pub fn refuse_rounding(mechanism: &AnyMechanism, q: &[f64], method: &Method) -> Result<()> {
    let lever = match mechanism {
        AnyMechanism::Planar(mechanism) => longest_lever(mechanism, q),
        AnyMechanism::Spatial(mechanism) => longest_lever(mechanism, q),
    };
    let system = mechanism.system();
    let far = largest(system.dimensions().without_turns(q));
    let rounding = f64::EPSILON * far / lever;
    // Nearer ones are rounded by 1e-12 of the lever.
    let is_far = far > 1e4 * lever && rounding > ROUNDING_TOLERATED * method.rtol;
    if method.step.is_some() || lever == 0.0 || !is_far {
        return Ok(());
    }
    let reason = format!(
        "coordinates of {} are rounded by {} of the longest lever of the joints, {} m: no step keeps rtol {}",
        two_digits(far),
        two_digits(rounding),
        two_digits(lever),
        short(method.rtol)
    );
    Err(Error::input(reason)
        .under("rtol")
        .under("simulation")
        .hint("put the origin near the mechanism, or give a larger --rtol"))
}

/// The longest distance between the markers of a joint, or from one of them to the origin of its body, m. Without
/// joints, the same for forces between two markers.
fn longest_lever<const D: usize>(mechanism: &Mechanism<D>, q: &[f64]) -> f64 {
    let still = vec![0.0; mechanism.dimensions().v];
    let frames = mechanism.frames(q, &still, &mut Scratch::default());
    let place = |marker: usize| frames[marker].r.each(|x| x.x);
    let model = mechanism.model();
    let reach = |marker: usize| {
        let part = model.carrier(marker);
        part.map_or(0.0, |part| norm(&part.body.markers()[marker - part.first_marker].offset))
    };
    let lever = |markers: &[usize]| {
        let apart = markers.iter().skip(1).map(|&marker| norm(&sub(&place(marker), &place(markers[0]))));
        apart.chain(markers.iter().map(|&marker| reach(marker))).fold(0.0, f64::max)
    };
    let of_joints = model.joints.iter().map(|joint: &Connection<_>| lever(&joint.markers)).fold(0.0, f64::max);
    let of_forces = model.forces.iter().filter(|force| force.markers.len() > 1).map(|force| lever(&force.markers));
    if model.joints.is_empty() { of_forces.fold(0.0, f64::max) } else { of_joints }
}
