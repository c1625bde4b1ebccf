//! A kind of simplification.

use super::edit::remove_named;
use super::facts::Facts;
use crate::error::percent;
use serde_json::Value;

/// A change of the scene; an error says why it is not possible, as after other changes.
pub type Edit = Box<dyn Fn(&mut Value) -> Result<(), String> + Send + Sync>;

/// A kind of simplification: it looks at the full model and its motion, and proposes changes of the scene.
///
/// A proposal is only that: the changed scene is run whole, and kept if the watched outputs stay within the promise. An
/// own kind is tried beside those of the [`registry`](super::registry):
///
/// ```
/// use holonom::prepared::Overrides;
/// use holonom::simplify::{Candidate, Facts, Proposal, SimplificationSettings, Source, registry, simplify};
/// use serde_json::{Value, json};
///
/// /// Springs have no preload, by the work of that.
/// struct Unloaded;
///
/// impl Candidate for Unloaded {
///     fn name(&self) -> &'static str {
///         "unloaded"
///     }
///
///     fn propose(&self, facts: &Facts) -> Vec<Proposal> {
///         let forces = facts.scene()["forces"].as_array().into_iter().flatten().enumerate();
///         let preloaded = forces.filter(|(_, force)| force.get("preload").is_some());
///         let proposal = |(i, force): (usize, &Value)| {
///             let edit = move |scene: &mut Value| {
///                 scene["forces"][i]["preload"] = json!(0);
///                 Ok(())
///             };
///             let mut scene = facts.scene().clone();
///             edit(&mut scene).ok()?;
///             let (subject, effect) = (force["name"].as_str()?.to_string(), facts.work_share(&scene)?);
///             let what = format!("{subject} has no preload");
///             Some(Proposal { subject, what, why: "it does hardly any work".to_string(), effect, edit: Box::new(edit) })
///         };
///         preloaded.filter_map(proposal).collect()
///     }
/// }
///
/// let scene = json!({
///     "name": "oscillator", "dimension": 2, "ground": { "markers": { "O": [0, 0] } },
///     "bodies": [{ "name": "block", "type": "point_mass", "mass": 1, "initial": { "position": [1.5, 0] } }],
///     "forces": [{ "name": "spring", "type": "spring_damper", "between": ["ground.O", "block"],
///                  "stiffness": 100, "free_length": 1, "preload": 0.01 }],
///     "outputs": [{ "name": "x", "measure": "position", "of": "block", "component": "x" }],
///     "simulation": { "t_end": 1 }
/// });
/// let kinds = [registry(), &[&Unloaded]].concat();
/// let source = Source::new(scene, &Overrides::default())?;
/// let found = simplify(&source, &SimplificationSettings::default(), &kinds, &|| false, &mut |_, _| ())?;
/// assert!(found.left_out().any(|trial| trial.what == ["spring has no preload"]));
/// # Ok::<(), holonom::Error>(())
/// ```
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
    /// Rough estimate of its effect on outputs, relative: 0.01 for a per cent. What it does at once to the outputs at
    /// states of the motion is seen to by the search, where the changed scene has the same coordinates.
    pub effect: f64,
    /// The change.
    pub edit: Edit,
}

/// The change that removes an element of a list, with what refers to it.
pub(super) fn removal(list: &'static str, name: &str) -> Edit {
    let name = name.to_string();
    Box::new(move |scene| remove_named(scene, list, &name))
}

impl Proposal {
    /// A change that takes away the mass of a body, by its share of the kinetic energy.
    pub(super) fn without_mass(facts: &Facts, body: &str, what: &str, edit: Edit) -> Proposal {
        let effect = facts.kinetic_share(body);
        Proposal {
            subject: body.to_string(),
            what: format!("{body} {what}"),
            why: format!("it has {} of the kinetic energy", percent(effect)),
            effect,
            edit,
        }
    }
}
