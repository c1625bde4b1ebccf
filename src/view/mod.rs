//! One HTML page that shows a mechanism in motion: to turn around, with its outputs, drift, energies and modes.
//!
//! ```text
//! Run -> Parts (bodies, joints, forces in frames) + Clip (poses of the frames at each time) + curves -> JSON in page.html
//! ```
//!
//! The page needs no network and no server. It carries its libraries compressed: `libraries.js.gz`, which `build.sh` makes
//! of `entry.js`. Its own code is plain: `mechanism.js` builds and moves the picture, `curves.js` draws the curves, and
//! `app.js` joins both with the controls.

mod clip;
mod curves;
mod encode;
mod glb;
mod gltf;
mod modes;
mod moving;
mod page;
mod parts;
mod primitives;
mod rows;

pub use gltf::glb;
pub use page::{Extras, ROWS, page};

use crate::analysis::Ledger;
use crate::linearize::LinearizationPoint;
use crate::prepared::Model;
use crate::study::ErrorBars;
use crate::system::{OperatingPoint, Scratch};
use crate::trajectory::{Trajectory, values};

/// A motion that a page shows.
pub struct ShownMotion<'a> {
    /// Name beside its colour, where a page shows several.
    pub label: String,
    /// Its scene, with the parameters of the run.
    pub prepared: &'a Model,
    /// Rows with all columns.
    pub trajectory: &'a Trajectory,
    /// Number of its first rows that are shown.
    pub rows: usize,
    /// Largest |phi|, |phi'|, |phi''| at each row; empty where they are not known.
    pub drift: &'a [[f64; 3]],
    /// Energies at each row; empty where they are not known.
    pub energy: &'a [Ledger],
    /// Error bars of the outputs at each row, if they were measured.
    pub bars: Option<&'a ErrorBars>,
}

impl<'a> ShownMotion<'a> {
    /// A motion of which nothing but its rows is known.
    pub fn new(prepared: &'a Model, trajectory: &'a Trajectory) -> Self {
        let rows = trajectory.rows.len();
        ShownMotion { label: prepared.name.clone(), prepared, trajectory, rows, drift: &[], energy: &[], bars: None }
    }
}

/// Returns a motion of one row: the state of a linear model.
pub fn still(prepared: &Model, point: &LinearizationPoint) -> Trajectory {
    let LinearizationPoint { t, q, v, vdot, lambda, .. } = point;
    let system = prepared.system();
    let mut still = Trajectory::new(system);
    let works = vec![0.0; system.facts().works.len()];
    let state = OperatingPoint { t: *t, q, v, vdot, lambda };
    let outputs = values(system, state, &works, still.outputs.len(), &mut Scratch::default());
    still.rows.push([&[*t], &q[..], v, lambda, &outputs].concat());
    still
}
