//! Keys of a massless beam in a scene.

use super::Beam;
use crate::body::Build;
use crate::body::flexible::{Elasticity, OneOrMany, Section, SectionGeometry, Stiffness, Theory, curvature};
use crate::error::Result;
use crate::force::{BuiltForce, ForceSpec};
use crate::math::expression::Number;
use schemars::JsonSchema;
use serde::Deserialize;

/// A massless elastic beam between two markers, geometrically exact. It is relaxed where the second marker lies
/// `length` along the x axis of the first and has the same axes, or is bent from there by `curvature`. In space the
/// second marker may turn against the first by less than half a turn, in the plane by less than a full one; a run warns
/// where it comes near to that. Its
/// magnitude is the axial force, tension positive.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BeamForce {
    /// Markers `body.marker` of two bodies.
    pub between: [String; 2],
    /// m
    pub length: Number,
    /// Default: `euler_bernoulli`.
    #[serde(default)]
    pub theory: Theory,
    /// With `section`; or give `stiffness`.
    pub material: Option<Elasticity>,
    pub section: Option<SectionGeometry>,
    /// Instead of `material` and `section`.
    pub stiffness: Option<Stiffness>,
    /// Default: none.
    pub damping: Option<BeamDamping>,
    /// Of the relaxed beam, 1/m: one number in the plane; in space [twist, about y, about z].
    pub curvature: Option<OneOrMany>,
}

/// Damping of a massless beam.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BeamDamping {
    /// Stresses are stiffness times (strain + this times the rate of strain), s.
    pub stiffness: Number,
}

impl ForceSpec for BeamForce {
    const TYPE: &'static str = "beam";

    fn build<const D: usize>(&self, build: &Build<D>) -> Result<BuiltForce<D>> {
        let markers = build.between(&self.between)?;
        build.oriented("between", &markers)?;
        let length = build.positive("length", &self.length)?;
        let section = Section::massless(
            self.material.as_ref(),
            self.section.as_ref(),
            self.stiffness.as_ref(),
            self.theory,
            build,
        )?;
        let damping = self.damping.as_ref();
        let damping = damping.map_or(Ok(0.0), |given| build.not_negative("damping.stiffness", &given.stiffness))?;
        let beam = Beam::new::<D>(&section, length, curvature(self.curvature.as_ref(), build)?, damping);
        Ok(BuiltForce { force: Box::new(beam), markers })
    }
}
