//! Position sweeps: a scene assembled at its start time for many values of one parameter, along one branch.
//!
//! ```
//! use holonom::sweep::{Family, Range};
//!
//! // A crank of length 1 on a rod of length 2, held at an angle; the piston slides along x.
//! let family = Family::parse_with(r#"{
//!     "name": "slider_crank", "dimension": 2, "parameters": { "angle": 0.5 },
//!     "ground": { "markers": { "O": [0, 0] } },
//!     "bodies": [
//!         { "name": "pin", "type": "point_mass", "mass": 1, "initial": { "position": ["cos(angle)", "sin(angle)"] } },
//!         { "name": "piston", "type": "point_mass", "mass": 1, "initial": { "position": [3, 0] } } ],
//!     "joints": [
//!         { "name": "crank", "type": "equation", "expression": "pin.x - cos(angle)" },
//!         { "name": "crank2", "type": "equation", "expression": "pin.y - sin(angle)" },
//!         { "name": "rod", "type": "distance", "between": ["pin", "piston"], "length": 2 },
//!         { "name": "guide", "type": "equation", "expression": "piston.y" } ],
//!     "outputs": [{ "name": "x", "measure": "position", "of": "piston", "component": "x" }]
//! }"#, &Default::default())?;
//! let range: Range = "angle=0..3:31".parse()?;
//! let sweep = family.sweep(&range, |_| ())?;
//! assert!(sweep.limits.is_empty());
//! for point in &sweep.points {
//!     let (sin, cos) = point.value.sin_cos();
//!     assert!((point.outputs[0] - (cos + (4.0 - sin * sin).sqrt())).abs() < 1e-9);
//! }
//! # Ok::<(), holonom::Error>(())
//! ```
//!
//! The sweep begins at the scene's own value of the parameter, which is the design position, and goes outwards on both
//! sides. Each assembly begins at the state before it, moved as the scene's own guess moves, and is accepted where
//! Newton's method contracts from its first step on; else the step of the parameter is halved. So the branch is
//! followed, and its end is found to about a ten-millionth of the range.
//!
//! Positions depend on the parameter alone. Velocities are those of the scene, made consistent. Multipliers, and
//! outputs that read them, are those of the equations of motion at that state, `M v' + G^T lambda = f`, with the
//! accelerations due to the forces there. They are those of statics only where the mechanism has no degrees of freedom
//! and nothing moves.

mod branch;
mod range;
mod walk;

pub use crate::prepared::Family;
pub use range::Range;

use crate::math::largest;
use crate::system::{Column, Names};
use crate::tolerances;

/// The states of a sweep.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// Name of the scene.
    pub scene: String,
    /// The values of the parameter.
    pub range: Range,
    /// Names of q, v and lambda.
    pub names: Names,
    /// Names and units of the outputs.
    pub outputs: Vec<Column>,
    /// The scene's own value of the parameter.
    pub own_value: f64,
    /// The state at `own_value`; none where that is not in the range.
    pub own: Option<Point>,
    /// The states at the values that were reached, in the order of the range.
    pub points: Vec<Point>,
    /// The ends of the branch that lie in the range.
    pub limits: Vec<BranchLimit>,
    /// The state nearest to a singular one, among all that were assembled, also between the values.
    pub nearest_singular: Nearest,
}

impl Sweep {
    /// All states in the order of the range: the points, the scene's own and the ends of the branch.
    pub fn curve(&self) -> Vec<&Point> {
        let ends = self.limits.iter().map(|limit| &limit.point);
        let mut curve: Vec<&Point> = self.points.iter().chain(&self.own).chain(ends).collect();
        let place = |point: &Point| (point.value - self.range.from) / (self.range.to - self.range.from);
        curve.sort_by(|a, b| place(a).total_cmp(&place(b)));
        curve.dedup_by(|a, b| a.value == b.value);
        curve
    }

    /// True if no coordinate depends on the parameter, as on a stiffness or a mass.
    pub fn moves_nothing(&self) -> bool {
        let first = self.points.first().map_or(&[][..], |point| &point.q);
        let is_same = |point: &Point| {
            let change = point.q.iter().zip(first).map(|(a, b)| (a - b).abs());
            change.fold(0.0, f64::max) <= tolerances::SAME * (1.0 + largest(first))
        };
        self.limits.is_empty() && self.points.len() > 1 && self.points.iter().all(is_same)
    }
}

/// An assembled state.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Value of the parameter.
    pub value: f64,
    /// Coordinates, n_q.
    pub q: Vec<f64>,
    /// Velocities, n_v.
    pub v: Vec<f64>,
    /// Multipliers, n_c.
    pub lambda: Vec<f64>,
    /// Outputs, in the order of [`Sweep::outputs`].
    pub outputs: Vec<f64>,
    /// Rank indicator of the constraints with the held directions: 1 is far from singular, 0 singular.
    pub rank_indicator: f64,
}

/// An end of the branch.
#[derive(Clone, Debug, PartialEq)]
#[doc(hidden)]
pub struct BranchLimit {
    /// The last state that was reached.
    pub point: Point,
    /// No state was found at this distance in the parameter beyond `point`.
    pub within: f64,
    /// The next value of the range, which was not reached.
    pub unreached: f64,
    /// The reason, from the assembly beyond the end.
    pub reason: String,
}

/// The state with the least rank indicator.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[doc(hidden)]
pub struct Nearest {
    /// Value of the parameter.
    pub value: f64,
    /// Rank indicator of the constraints there: 1 is far from singular, 0 singular.
    pub rank_indicator: f64,
}
