//! The built-in kinds of simplification, a file each.

mod absorbed;
mod beam_spring;
mod branch;
mod flexible_body;
mod geometric_stiffening;
mod merged_bodies;
mod negligible_force;
mod planar;
mod planar_output;
mod plane;
mod point_mass;
mod quasi_static_state;
mod redundant_joint;
mod resting_body;
mod section;
mod stiff_connection;
mod two_force_link;

pub(super) use plane::Plane;
pub(super) use two_force_link::PinnedLink;

use super::candidate::Candidate;

/// Every built-in kind, in the order of the documentation.
pub fn registry() -> &'static [&'static dyn Candidate] {
    &[
        &planar::Planar,
        &flexible_body::FlexibleBody,
        &two_force_link::TwoForceLink,
        &branch::Branch,
        &resting_body::RestingBody,
        &merged_bodies::MergedBodies,
        &point_mass::PointMass,
        &stiff_connection::StiffConnection,
        &redundant_joint::RedundantJoint,
        &geometric_stiffening::GeometricStiffening,
        &negligible_force::NegligibleForce,
        &quasi_static_state::QuasiStaticState,
    ]
}
