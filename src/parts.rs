//! Own joints, forces and bodies, and scenes built in code.
//!
//! A part is a specification, which a scene states as JSON, and a kernel with its equation over any scalar. [`Elements`]
//! makes a specification known to scenes. A joint's kernel returns phi, a force's its wrenches, a body's its frames and
//! energy. All derivatives follow. [The guide](crate::guide::rust) has a complete example of each.
//!
//! ```
//! use holonom::parts::{Elements, SceneBuilder, json};
//! use holonom::run::{Model, Overrides};
//!
//! let scene = SceneBuilder::new("fall", 2)
//!     .with("gravity", json!([0, -9.81]))
//!     .body("ball", "point_mass", json!({ "mass": 1, "initial": { "position": [0, 2] } }))
//!     .build(&Elements::default())?;
//! let ball = Model::new(scene, &Overrides::default())?;
//! assert_eq!(ball.assembly.vdot, [0.0, -9.81]);
//! # Ok::<(), holonom::Error>(())
//! ```

pub use crate::body::{
    BodyFacts, BodyKernel, BodySpec, Build, BuiltBody, Frame, Initial, Marker, Wrench, cross, dot, norm, scale, sub,
};
pub use crate::force::{Action, BuiltForce, ForceKernel, ForceSpec, Instant, Motion};
pub use crate::joint::{BuiltJoint, JointKernel, JointSpec};
pub use crate::math::expression::Number;
pub use crate::math::{Taylor, Time};
#[doc(no_inline)]
pub use crate::run::Scene;
#[doc(no_inline)]
pub use crate::scene::json;
pub use crate::scene::{Elements, SceneBuilder};
#[doc(no_inline)]
pub use crate::system::{Energy, Scalar};
