//! A kind of simplification.

use super::facts::Facts;
use serde_json::Value;

/// A change of the scene; an error says why it is not possible, as after other changes.
pub type Edit = Box<dyn Fn(&mut Value) -> Result<(), String> + Send + Sync>;

/// A kind of simplification: it looks at the richest model and its motion, and proposes changes of the scene.
///
/// A proposal is only that: the changed scene is run whole, and kept if the watched outputs stay within the promise.
pub trait Candidate: Sync {
    /// Name in tables, such as `rigid_body`.
    fn name(&self) -> &'static str;

    /// The changes that make sense. Those of one subject are alternatives: one of them is kept at most, the one that
    /// saves most. An output that a change cannot keep it takes away; a scene without a watched output is refused.
    fn propose(&self, facts: &Facts) -> Vec<Proposal>;
}

/// A change of the scene, with what it is expected to do.
pub struct Proposal {
    /// What it is about, such as the name of a body.
    pub subject: String,
    /// What it does: `rod1 becomes a distance without mass`.
    pub what: String,
    /// Why it may be harmless: `0.3 % of the kinetic energy`.
    pub why: String,
    /// Rough estimate of its effect on outputs, relative: 0.01 for a per cent.
    pub effect: f64,
    /// The change.
    pub edit: Edit,
}
