//! Keys of a flexible beam in a scene.

use crate::math::expression::Number;
use schemars::JsonSchema;
use serde::Deserialize;

/// A slender beam. Its origin is its left end, where the x axis runs along it; markers lie at [s, y] or [s, y, z] with
/// 0 <= s <= length, in the axes of the section at s. The numbers of `section`, `stiffness` and `inertia` may be expressions of s, such as
/// "0.1*(1 - s/4)": a tapered beam. A section that jumps needs a marker there, for a node.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FlexibleBeam {
    /// `floating`: rigid coordinates of a frame that moves with the beam, and small elastic displacements in it.
    /// `absolute`: positions and rotations of the nodes themselves, geometrically exact, for large deformation.
    pub frame: FrameKind,
    /// m
    pub length: Number,
    /// Number of finite elements. A node is put at every marker, which may add some. Left out with `ritz`.
    pub elements: Option<Number>,
    /// Default: `euler_bernoulli`.
    #[serde(default)]
    pub theory: Theory,
    /// With `section`; or give `stiffness` and `inertia`.
    pub material: Option<Material>,
    /// Form and size of the section.
    pub section: Option<SectionShape>,
    /// Instead of `material` and `section`.
    pub stiffness: Option<Stiffness>,
    /// Instead of `material` and `section`.
    pub inertia: Option<SectionInertia>,
    /// Default: none.
    pub damping: Option<Damping>,
    /// Curvature of the relaxed beam, 1/m: one number in the plane; in space [twist, about y, about z]. Floating with elements
    /// and the frame conditions `tangent` and `mean` only.
    pub curvature: Option<OneOrMany>,
    /// Floating only: how the frame moves with the beam. Default: `tangent`.
    pub frame_conditions: Option<FrameConditions>,
    /// Floating only: axial displacement within an element. Default: `linear`.
    pub axial: Option<Axial>,
    /// Floating only: rotary inertia of sections that bending turns (Rayleigh). Default: true for `timoshenko`, else false.
    pub rotary_inertia: Option<bool>,
    /// Floating only: axial force stiffens or softens bending. `true`: by the shortening of a bent line, with the axial
    /// energy EA (u' + w'^2/2)^2/2 a length. `"cubic"`: without its last term, EA (u'^2 + u' w'^2)/2, which is the law of the
    /// IVP test set's problem `crank`; it has no minimum where the slopes are large. With
    /// `modes`, or `ritz` without axial functions, nothing can stretch: `true` keeps the length of the line, whose points move
    /// along it by -int w'^2/2. Default: false.
    #[serde(default)]
    pub geometric_stiffening: Stiffening,
    /// Floating only: Craig-Bampton reduction to the static modes of the markers and so many fixed-interface modes.
    pub modes: Option<Number>,
    /// Floating only: displacement functions of choice instead of finite elements.
    pub ritz: Option<Ritz>,
}

/// Coordinates of the beam.
#[derive(Deserialize, JsonSchema, Clone, Copy, Debug, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum FrameKind {
    /// Small elastic displacements in a frame that moves with the beam.
    Floating,
    /// Nodes in absolute coordinates with geometrically exact elements between them.
    Absolute,
}

/// Beam theory of the finite elements.
#[derive(Deserialize, JsonSchema, Clone, Copy, Debug, PartialEq, Eq, Default)]
#[serde(rename_all = "snake_case")]
pub enum Theory {
    /// Sections stay square to the line.
    #[default]
    EulerBernoulli,
    /// Shear deforms the sections.
    Timoshenko,
}

/// Conditions that fix the floating frame to the beam.
#[derive(Deserialize, JsonSchema, Clone, Copy, Debug, PartialEq, Eq, Default)]
#[serde(rename_all = "snake_case")]
pub enum FrameConditions {
    /// The frame is fixed to the section at the left end.
    #[default]
    Tangent,
    /// The frame's origin is the left end, its x axis passes through the right end; in space it turns with the left end
    /// about x.
    Chord,
    /// Elastic displacements have no linear or angular momentum to first order (mean axes of Buckens).
    Mean,
}

/// Interpolation of the axial displacement.
#[derive(Deserialize, JsonSchema, Clone, Copy, Debug, PartialEq, Eq, Default)]
#[serde(rename_all = "snake_case")]
pub enum Axial {
    /// Two nodes in each element: constant extension.
    #[default]
    Linear,
    /// A middle node in each element.
    Quadratic,
}

#[derive(Deserialize, JsonSchema, Clone, Copy, Debug, PartialEq, Eq)]
#[serde(untagged, expecting = "expected true, false or \"cubic\"")]
pub enum Stiffening {
    Switch(bool),
    Law(StiffeningLaw),
}

#[derive(Deserialize, JsonSchema, Clone, Copy, Debug, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum StiffeningLaw {
    Cubic,
}

impl Default for Stiffening {
    fn default() -> Self {
        Stiffening::Switch(false)
    }
}

impl Stiffening {
    /// Factor of the term EA w'^4/8 of the energy; none without stiffening.
    pub fn quartic(self) -> Option<f64> {
        match self {
            Stiffening::Switch(false) => None,
            Stiffening::Switch(true) => Some(1.0),
            Stiffening::Law(StiffeningLaw::Cubic) => Some(0.0),
        }
    }
}

/// A number or a list of them.
#[derive(Deserialize, JsonSchema)]
#[serde(untagged, expecting = "expected a number, an expression such as \"E*b*h\", or a list of these")]
pub enum OneOrMany {
    /// One number.
    One(Number),
    /// A list of numbers.
    Many(Vec<Number>),
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Young's modulus, Pa.
    #[serde(rename = "E")]
    pub e: Number,
    /// Poisson's ratio; gives G = E/(2 (1 + nu)).
    pub nu: Option<Number>,
    /// Shear modulus, Pa, instead of `nu`.
    #[serde(rename = "G")]
    pub g: Option<Number>,
    /// Density, kg/m^3.
    pub rho: Number,
}

/// Elasticity of a massless beam.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Elasticity {
    /// Young's modulus, Pa.
    #[serde(rename = "E")]
    pub e: Number,
    /// Poisson's ratio; gives G = E/(2 (1 + nu)).
    pub nu: Option<Number>,
    /// Shear modulus, Pa, instead of `nu`.
    #[serde(rename = "G")]
    pub g: Option<Number>,
}

/// A section in the y-z plane of the beam; of a `flexible_beam` its numbers may depend on s, m from the left end.
#[derive(Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum SectionShape {
    /// `height` along y, `width` along z, m.
    Rectangle {
        /// Along y, m.
        height: Number,
        /// Along z, m.
        width: Number,
    },
    /// A full circle, or a tube with `inner_radius`, m.
    Circle {
        /// Outer radius, m.
        radius: Number,
        /// Inner radius, m. Default: zero.
        inner_radius: Option<Number>,
    },
}

/// Stiffness of a section. Two numbers where a scene in space has two directions; of a `flexible_beam` they may depend on
/// s, m from the left end.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Stiffness {
    /// N
    #[serde(rename = "EA")]
    pub ea: Number,
    /// About z in the plane; [about y, about z] or one number for both in space, N m^2.
    #[serde(rename = "EI")]
    pub ei: OneOrMany,
    /// With the shear factor: along y in the plane; [along y, along z] or one number for both in space, N.
    #[serde(rename = "GA")]
    pub ga: Option<OneOrMany>,
    /// In space, N m^2.
    #[serde(rename = "GJ")]
    pub gj: Option<Number>,
}

/// Inertia of a section; its numbers may depend on s, m from the left end.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SectionInertia {
    /// Mass per length, kg/m.
    #[serde(rename = "rhoA")]
    pub rho_a: Number,
    /// About z in the plane; [about y, about z] or one number for both in space, kg m. Default: zero in the plane.
    #[serde(rename = "rhoI")]
    pub rho_i: Option<OneOrMany>,
}

/// Damping of the elastic motion.
#[derive(Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Damping {
    /// D = mass M + stiffness K. An absolute beam takes `stiffness` only.
    Rayleigh {
        /// 1/s. Default: zero.
        mass: Option<Number>,
        /// s. Default: zero.
        stiffness: Option<Number>,
    },
    /// Damping ratio of every mode, or of each in turn; floating with `modes` or `ritz` only.
    Modal(OneOrMany),
}

/// Displacement functions of x from 0 to `length`, as expressions over x and the scene's parameters.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Ritz {
    /// Displacements along y, one coordinate each; with slopes as rotations.
    #[serde(default)]
    pub bending: Vec<Number>,
    /// In space: displacements along z.
    #[serde(default)]
    pub bending_z: Vec<Number>,
    /// Displacements along x.
    #[serde(default)]
    pub axial: Vec<Number>,
    /// In space: turns about x, rad.
    #[serde(default)]
    pub torsion: Vec<Number>,
    /// Factor of the mass block of the axial functions. Default: 1, the consistent one; 15 is that of the IVP test set's
    /// problem `crank`.
    pub axial_mass_factor: Option<Number>,
}
