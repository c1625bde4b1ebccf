//! A signal with fewer points.

use crate::error::percent;
use crate::simplify::edit::{elements, find_mut, text};
use crate::simplify::{Candidate, Facts, Proposal};
use serde_json::{Value, json};

/// One point in so many is kept.
const PARTS: [usize; 3] = [8, 4, 2];

/// A signal keeps one point in eight, four or two, its last one too. By the largest difference at the points that go,
/// relative to its range.
pub struct CoarserSignal;

impl Candidate for CoarserSignal {
    fn name(&self) -> &'static str {
        "coarser_signal"
    }

    fn propose(&self, facts: &Facts) -> Vec<Proposal> {
        let signals = elements(facts.scene(), "signals").iter().map(|signal| text(signal, "name"));
        signals.flat_map(|name| PARTS.map(|part| proposal(facts, name, part))).flatten().collect()
    }
}

fn proposal(facts: &Facts, name: &str, part: usize) -> Option<Proposal> {
    let of =
        |all: &[std::sync::Arc<crate::math::signal::Signal>]| all.iter().find(|signal| signal.name() == name).cloned();
    let signal = of(facts.prepared.parameters.signals())?;
    let knots = signal.knots();
    let last = knots.last().filter(|_| (knots.len() - 1) % part != 0);
    let points: Vec<[f64; 2]> = knots.iter().step_by(part).chain(last).map(|x| [*x, signal.apply(*x)]).collect();
    let (name, count) = (name.to_string(), points.len());
    let (subject, what) = (name.clone(), format!("{name} has {count} of its {} points", knots.len()));
    let edit = move |scene: &mut Value| {
        let signal = find_mut(scene, "signals", &name)?;
        ["file", "columns"]
            .iter()
            .for_each(|key| drop(signal.as_object_mut().and_then(|keys| keys.shift_remove(*key))));
        signal["points"] = json!(points);
        Ok(())
    };
    let mut scene = facts.scene().clone();
    edit(&mut scene).ok()?;
    let coarse = of(facts.source.prepare(&scene).ok()?.parameters.signals())?;
    let values = || knots.iter().map(|x| signal.apply(*x));
    let range = values().fold(f64::MIN, f64::max) - values().fold(f64::MAX, f64::min);
    let effect = knots.iter().map(|x| (coarse.apply(*x) - signal.apply(*x)).abs()).fold(0.0, f64::max) / range;
    let why = format!("between those it differs by {} of its range at most", percent(effect));
    (count < knots.len()).then(|| Proposal { subject, what, why, effect, edit: Box::new(edit) })
}
