//! What an output of a scene may measure: its keys, and the dimensions of its values.

use super::keys::{missing, named_component};
use super::units::Dimension;
use crate::body::{Build, MarkerId, Repeat};
use crate::error::Result;
use crate::math::expression::Number;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What a user watches: a column of the trajectory and a row of C.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OutputSpec {
    pub name: String,
    pub measure: MeasureKind,
    /// The body, marker, joint or force that is measured.
    pub of: Option<String>,
    /// Two markers, for distances.
    pub between: Option<[String; 2]>,
    /// Marker or body in whose axes, and against which, it is measured; for reactions and forces the axes alone.
    /// Default: the ground.
    pub relative_to: Option<String>,
    /// x, y, z; for reactions and forces also mx, my, mz, and for reactions, where the joint holds a length, axial: the
    /// force in the rod, tension positive (default: the size of the force; of a gear, of the torque; of a driver, its
    /// force or torque along its own coordinate, positive where that grows: so the torque of a motor is the reaction of
    /// its driver; of an equation, its multiplier lambda, in J over the unit of its expression); x or y for the angles
    /// of a universal joint; kinetic, potential or total for energy.
    pub component: Option<String>,
    /// For components of reactions and forces: the body on which they act, that of the first or the second marker of
    /// `between`, or of `at` and `reaction_on`; of a reaction also by the name of the body, as for the markers of an
    /// equation, where the size of the force goes with it, too. Moments are about the origin of that marker. Default:
    /// second; of an applied force or torque first.
    pub on: Option<On>,
    /// On a beam: from its left end, m.
    pub at: Option<Number>,
    /// On a beam, for the strain of a fibre: y, or [y, z] in space, from the centre line, m. Default: zero.
    pub offset: Option<Vec<Number>>,
    /// The expression.
    pub value: Option<Number>,
    /// Unit of its values wherever they are shown, such as deg, rpm, mm, kN or N m; those of linear models and of a
    /// reference table too. Expressions, and outputs in them, are in SI units: one in rad with the unit deg is shown in
    /// degrees. A word that is no known unit of an expression stands on axes alone. Default: that of the SI.
    pub unit: Option<String>,
    #[serde(rename = "repeat")]
    pub _repeat: Option<Repeat>,
}

/// What is measured.
#[derive(Deserialize, Serialize, JsonSchema, Clone, Copy, PartialEq, Eq, Debug)]
#[serde(rename_all = "snake_case")]
pub enum MeasureKind {
    /// rad, of a body or marker against `relative_to`, in space about the z axis of that (for another axis name a
    /// marker with that `z_axis`); counted through full turns. Of a joint that turns about one axis, or a torsion
    /// spring: of its second marker against its first; of a universal joint: `component` x, of its cross about x of the
    /// first marker, or y, of its second marker about its own y against the cross.
    Angle,
    /// rad/s, of a body or marker along an axis of `relative_to`; of a joint or torsion spring the rate of its angle
    AngularVelocity,
    /// rad/s^2, the rate of the angular velocity
    AngularAcceleration,
    /// m, of a body or marker from `relative_to`, in its axes; of a joint that slides: of its second marker from its
    /// first, along the free axis
    Position,
    /// m/s, the rate of the position
    Velocity,
    /// m/s^2, the rate of the velocity: in the axes of a `relative_to` that moves, as it is seen from there
    Acceleration,
    /// m, `between` two markers, or between those of a spring or rod `of`: its length
    Distance,
    /// m/s, the rate of the distance
    DistanceRate,
    /// N or N m, of joint `of` on its second body (or `on` the first), in world axes or those of `relative_to`; the
    /// torque of a motor is that of its driver, without a component
    Reaction,
    /// Tension of a spring (N), size of another force or torque `of`; with a `component` that of what it exerts on its
    /// second body (or `on` the first), in world axes or those of `relative_to`
    Force,
    /// W, of a force or a driver `of`: what it gives to the bodies, negative where it takes
    Power,
    /// J, of a force `of`: the integral of its power from the start of the run, a column of the trajectory alone
    Work,
    /// J, of the whole scene
    Energy,
    /// m, of the centre line of beam `of` `at` a place from where it is at rest, in the beam's own axes
    Deflection,
    /// Axial strain of beam `of` `at` a place, at a fibre with this `offset`
    Strain,
    /// N, tension positive, in beam `of` `at` a place, along its displaced section's axis; `of` is a body or a force
    AxialForce,
    /// N, along y or z of the section, of what is beyond it on what is before
    ShearForce,
    /// N m, about the line of a beam in space
    Torque,
    /// N m, about z or y of the section; positive where the curvature is
    BendingMoment,
    /// `value`, over t, marker quantities such as `crank.tip.x`, with `'` for velocities and `''` for accelerations,
    /// and other outputs by their names
    Expression,
}

/// The body that a reaction or a force acts on.
#[derive(Deserialize, JsonSchema, Clone, PartialEq, Eq, Debug)]
#[serde(untagged)]
pub enum On {
    /// By the order of the markers.
    Side(BodySide),
    /// By its name.
    Body(String),
}

/// One of the two bodies that a joint or force is between.
#[derive(Deserialize, JsonSchema, Clone, Copy, PartialEq, Eq, Debug)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Side")]
pub enum BodySide {
    /// That of the first marker.
    First,
    /// That of the second marker.
    Second,
}

impl OutputSpec {
    /// Name of what is measured.
    pub fn subject(&self) -> Result<&str> {
        self.of.as_deref().ok_or_else(|| missing("of", "name what is measured: a body, marker, joint or force"))
    }

    /// Index of its component among the `known` ones.
    pub fn component_of(&self, default: &str, known: &[&str]) -> Result<usize> {
        named_component(self.component.as_deref().unwrap_or(default), known)
    }

    /// Marker in whose axes, and against which, it is measured.
    pub fn reference<const D: usize>(&self, build: &Build<D>) -> Result<MarkerId> {
        build.marker("relative_to", self.relative_to.as_deref().unwrap_or("ground"))
    }
}

impl MeasureKind {
    /// The keys of an output that go with it.
    pub fn keys(self) -> &'static [&'static str] {
        use MeasureKind::*;
        match self {
            Angle | AngularVelocity | AngularAcceleration | Position | Velocity | Acceleration => {
                &["of", "relative_to", "component"]
            }
            Distance | DistanceRate => &["between", "of"],
            Reaction | Force => &["of", "relative_to", "component", "on"],
            Power | Work => &["of"],
            Energy => &["component"],
            Deflection | ShearForce | BendingMoment => &["of", "at", "component"],
            Strain => &["of", "at", "offset"],
            AxialForce | Torque => &["of", "at"],
            Expression => &["value"],
        }
    }

    /// Physical dimensions of its values: one, or what it is of decides; none for an expression, whose unit its author
    /// gives.
    pub fn dimensions(self) -> &'static [Dimension] {
        use MeasureKind::*;
        match self {
            Angle => &[Dimension::Angle],
            AngularVelocity => &[Dimension::AngularVelocity],
            AngularAcceleration => &[Dimension::AngularAcceleration],
            Position | Distance | Deflection => &[Dimension::Length],
            Velocity | DistanceRate => &[Dimension::Velocity],
            Acceleration => &[Dimension::Acceleration],
            Power => &[Dimension::Power],
            Torque | BendingMoment => &[Dimension::Torque],
            Work | Energy => &[Dimension::Energy],
            Strain => &[Dimension::Strain],
            AxialForce | ShearForce => &[Dimension::Force],
            Reaction | Force => &[Dimension::Force, Dimension::Torque],
            Expression => &[],
        }
    }
}
