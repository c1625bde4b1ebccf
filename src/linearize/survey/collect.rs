//! From states to branches.

use super::{Along, Found, Gap, Loci, Outcome, Reached};
use crate::error::Result;
use crate::linearize::{Branch, Sample, track};
use crate::tolerances::linearize as tolerances;
use rayon::prelude::*;
use std::collections::BTreeSet;

/// What lies between two states, as far as it takes to tell the modes apart.
fn refined(
    before: &Found,
    after: &Found,
    halvings: usize,
    between: &impl Fn(&Found, f64) -> Result<Found>,
) -> Vec<Sample> {
    if halvings == 0 || before.sample.leads_clearly_to(&after.sample) {
        return Vec::new();
    }
    // Where there is no model between, modes are told apart as well as may be.
    let Ok(middle) = between(before, 0.5 * (before.sample.at + after.sample.at)) else { return Vec::new() };
    let mut samples = refined(before, &middle, halvings - 1, between);
    let rest = refined(&middle, after, halvings - 1, between);
    samples.push(middle.sample);
    samples.extend(rest);
    samples
}

/// Branches and gaps of what was found at the places; `between` gives the state behind one at another place.
pub(super) fn collect(
    along: Along,
    outcomes: Vec<Outcome>,
    between: impl Fn(&Found, f64) -> Result<Found> + Sync,
) -> Loci {
    let places: Vec<f64> = outcomes.iter().map(|(at, _)| *at).collect();
    let behind = |pair: &[Outcome]| match (&pair[0].1, &pair[1].1) {
        (Ok(before), Ok(after)) => {
            let halvings = if before.sample.modes.len() > tolerances::MANY_MODES {
                tolerances::FEW_HALVINGS
            } else {
                tolerances::HALVINGS
            };
            refined(before, after, halvings, &between)
        }
        _ => Vec::new(),
    };
    let more: Vec<Vec<Sample>> = outcomes.par_windows(2).map(behind).collect();
    let first = outcomes.iter().find_map(|(_, outcome)| outcome.as_ref().ok());
    let (method, chart) = first.map(|found| (found.method.clone(), found.chart.clone())).unwrap_or_default();
    let (mut reached, mut gaps, mut samples, mut doubts) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for ((at, outcome), more) in outcomes.into_iter().zip(more.into_iter().chain([Vec::new()])) {
        match outcome {
            Ok(found) => {
                reached.push(Reached { at, equilibrium: found.is_equilibrium });
                doubts.extend(found.doubt.filter(|_| doubts.is_empty()));
                samples.push(found.sample);
            }
            Err(error) => {
                gaps.push(Gap { at, error });
                samples.push(Sample::gap(at));
            }
        }
        samples.extend(more);
    }
    let branches = asked(track(&samples), &places);
    Loci { along, method, chart, places, reached, gaps, branches, doubts }
}

/// The branches at these places only.
fn asked(branches: Vec<Branch>, places: &[f64]) -> Vec<Branch> {
    let places: BTreeSet<u64> = places.iter().map(|place| place.to_bits()).collect();
    let at_places = |mut branch: Branch| {
        branch.points.retain(|(at, _)| places.contains(&at.to_bits()));
        branch
    };
    branches.into_iter().map(at_places).filter(|branch| !branch.points.is_empty()).collect()
}
