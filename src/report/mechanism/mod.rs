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
pub use modes::mode_figure;
pub use motion::Motion;
pub use snapshot::up;
pub use traces::{Trace, find_trace, output_traces};
pub use view::View;
