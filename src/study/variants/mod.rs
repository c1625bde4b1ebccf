//! Many variants of one scene, each simulated or linearized, of which only some numbers are recorded.
//!
//! A [`Plan`] says which variants there are. A [`Study`] has the scene, read once, and computes the recorded numbers of
//! one variant from its values alone, so that they do not depend on threads, order or shards. A [`StudyTable`] holds
//! the rows with all that they depend on; it refuses rows of another study.

mod course;
mod measure;
mod plan;
mod points;
mod study;
mod table;

pub use measure::Measure;
pub use plan::{Axis, Plan};
pub use points::{Filling, Sample};
pub use study::{Recorded, Study};
pub use table::{Shard, StudyRow, StudyTable};
