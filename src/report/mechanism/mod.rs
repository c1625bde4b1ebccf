//! Figures and animations of the mechanism.
//!
//! ```text
//! trajectory -> Motion -> State -> Snapshot -> Canvas: bodies, glyphs of joints and forces, ground -> plot items
//! ```
//!
//! To add the symbol of a new kind of joint or force: a function in `joints` or `forces` and a line in `glyphs`.

mod bodies;
mod canvas;
mod figures;
mod forces;
mod glyphs;
mod ground;
mod hull;
mod joints;
mod modes;
mod motion;
mod snapshot;
mod traces;
mod view;

pub use figures::{Look, animation, mechanism_figure, stroboscope_figure};
pub use joints::pitch_radii;
pub use modes::{Swing, at_rest, mode_figure, mode_title, shaped};
pub use motion::DrawnMotion;
pub use snapshot::{Limb, Link, Pose, Snapshot, reactions, snapshot, solids, up};
pub use traces::{Trace, find_trace, output_traces};
pub use view::View;
