//! Greedy search: changes are tried where they save most, and kept while the promise is kept.

use super::bench::Bench;
use super::candidate::{Candidate, Proposal};
use super::facts::Facts;
use super::nearby::Robustness;
use super::run::ModelRun;
use crate::error::{percent, short_list};
use serde::Serialize;
use serde_json::Value;
use std::collections::VecDeque;

/// Part of the promise that the numerical error of a method may have.
pub const NUMERICAL: f64 = 0.1;
/// A change with an estimated effect of so many times the promise is not tried.
const HOPELESS: f64 = 3.0;
/// A change with a larger estimated effect is not tried.
const TOO_MUCH: f64 = 0.5;
/// A model that takes so much more work is not simpler.
const DEARER: f64 = 1.1;
/// A model may take so many times the CPU time of the richest: more than the clock of a busy machine errs by.
const SLOWER: f64 = 2.0;
/// An alternative with less than this part of the estimated effect is another matter.
const ALIKE: f64 = 0.5;

/// A change that was proposed, or several together.
#[derive(Clone, Debug, Serialize)]
pub struct Trial {
    /// Kind of simplification.
    pub candidate: String,
    /// What it is about, such as the names of bodies.
    pub subjects: Vec<String>,
    /// What is done to each.
    pub what: Vec<String>,
    /// Why it may be harmless.
    pub why: String,
    /// Estimated relative effect.
    pub estimated: f64,
    /// Run of the model with all that was kept before and this change; none where it was not run.
    pub run: Option<ModelRun>,
    /// True if the change was kept.
    pub is_kept: bool,
    /// Reason why it was not; empty if it was.
    pub reason: String,
}

/// The model that the search has come to.
pub struct FoundModel {
    pub scene: Value,
    pub run: ModelRun,
    /// The promise on motions nearby; none where these are not tried, or nothing was changed.
    pub robustness: Option<Robustness>,
    /// All changes in the order in which they were tried.
    pub trials: Vec<Trial>,
}

impl FoundModel {
    /// Takes a model that keeps the promise, if it does so on motions nearby.
    ///
    /// # Errors
    /// Reason why it does not.
    pub fn take(&mut self, bench: &mut Bench, scene: Value, run: &ModelRun) -> Result<(), String> {
        self.robustness = bench.robustness(&scene)?;
        (self.scene, self.run) = (scene, run.clone());
        Ok(())
    }
}

/// A proposal with the kind that made it.
struct Idea {
    candidate: &'static str,
    proposal: Proposal,
    /// Expected effect: the estimate, until an alternative is measured.
    expected: f64,
    size: usize,
}

/// Indices of ideas that are tried together.
type IdeaGroup = Vec<usize>;

struct ModelSearch<'a, 'b> {
    bench: &'a mut Bench<'b>,
    ideas: Vec<Idea>,
    settled: Vec<(&'static str, String)>,
    reserved: usize,
    found: FoundModel,
}

/// Tries the changes that the candidates propose after what was tried, `reserved` runs being left over.
pub fn search(
    bench: &mut Bench,
    facts: &Facts,
    candidates: &[&dyn Candidate],
    trials: Vec<Trial>,
    reserved: usize,
) -> FoundModel {
    let found = FoundModel { scene: facts.scene().clone(), run: bench.richest.clone(), robustness: None, trials };
    let mut search = ModelSearch { bench, ideas: Vec::new(), settled: Vec::new(), reserved, found };
    let own = facts.at_once(&facts.prepared.mechanism);
    for candidate in candidates {
        for proposal in candidate.propose(facts) {
            search.consider(candidate.name(), proposal, facts, &own);
        }
    }
    let mut queue = search.queue();
    while let Some(group) = queue.pop_front() {
        search.attempt(group, &mut queue);
    }
    search.found
}

impl ModelSearch<'_, '_> {
    /// Takes up a proposal that is possible by itself and not hopeless. Its effect is at least what it does at once to
    /// the outputs at states of the full model.
    fn consider(
        &mut self,
        candidate: &'static str,
        mut proposal: Proposal,
        facts: &Facts,
        own: &Option<Vec<Vec<f64>>>,
    ) {
        let within = self.bench.promise.within;
        let most = TOO_MUCH.min(HOPELESS * within);
        let hopeless =
            || format!("its estimated effect is more than {}, of which {} is promised", percent(most), percent(within));
        let mechanism = match proposal.effect {
            // To build what is not tried takes more time than runs do, where there are hundreds.
            effect if effect.is_nan() || effect > most => Err(hopeless()),
            _ => {
                let mut scene = self.found.scene.clone();
                (proposal.edit)(&mut scene).and_then(|()| self.bench.mechanism(&scene))
            }
        };
        let at_once = mechanism.as_ref().ok().and_then(|mechanism| facts.at_once(mechanism)).zip(own.as_ref());
        if let Some(difference) = at_once.and_then(|(other, own)| self.bench.promise.difference(own, &other)) {
            proposal.effect = proposal.effect.max(difference);
        }
        let refusal = match &mechanism {
            Err(reason) => Some(reason.clone()),
            Ok(_) => (proposal.effect.is_nan() || proposal.effect > most).then(hopeless),
        };
        let known = self.ideas.len();
        let dimensions = mechanism.map(|mechanism| mechanism.system().dimensions());
        let expected = proposal.effect;
        let size = dimensions.map_or(0, |n| n.v + n.lambda);
        self.ideas.push(Idea { candidate, proposal, expected, size });
        if let Some(reason) = refusal {
            let trial = self.trial(&[known], None, reason);
            self.found.trials.push(trial);
            self.ideas.pop();
        }
    }

    /// All ideas: of each kind those of different subjects together, the ones that save most first.
    fn queue(&self) -> VecDeque<IdeaGroup> {
        let mut order: Vec<usize> = (0..self.ideas.len()).collect();
        order.sort_by_key(|i| self.ideas[*i].size);
        let mut groups: Vec<IdeaGroup> = Vec::new();
        for i in order {
            let own = &self.ideas[i];
            // The next group of the kind that has no alternative of the subject yet.
            let goes_with =
                |other: &Idea| other.candidate == own.candidate && other.proposal.subject != own.proposal.subject;
            let fits = |group: &&mut IdeaGroup| group.iter().all(|k| goes_with(&self.ideas[*k]));
            match groups.iter_mut().find(fits) {
                Some(group) => group.push(i),
                None => groups.push(vec![i]),
            }
        }
        let key = |group: &IdeaGroup| {
            let saved = group.iter().map(|i| self.ideas[*i].size).min().unwrap_or(0);
            (self.is_doubtful(group), saved)
        };
        groups.sort_by_key(key);
        groups.into()
    }

    fn effect(&self, group: &[usize]) -> f64 {
        group.iter().map(|i| self.ideas[*i].proposal.effect).fold(0.0, f64::max)
    }

    /// True if a group is expected to break the promise.
    fn is_doubtful(&self, group: &[usize]) -> bool {
        group.iter().any(|i| self.ideas[*i].expected > self.bench.promise.within)
    }

    /// Corrects what is expected of the alternatives of a change by what was measured of that, where they are estimated
    /// alike: of those much better by the estimate it tells nothing.
    fn correct(&mut self, of: usize, measured: f64) {
        let Idea { candidate, proposal: Proposal { subject, effect, .. }, .. } = &self.ideas[of];
        let candidate = *candidate;
        let subject = subject.clone();
        let effect = *effect;
        for Idea { candidate: kind, proposal, expected, .. } in &mut self.ideas {
            if *kind == candidate && proposal.subject == subject && proposal.effect >= ALIKE * effect {
                *expected = expected.max(proposal.effect * measured / effect);
            }
        }
    }

    /// Tries what a group has left; one that is refused is tried in halves, those of the smaller effects first.
    fn attempt(&mut self, members: IdeaGroup, queue: &mut VecDeque<IdeaGroup>) {
        let is_open = |i: &usize| {
            let Idea { candidate, proposal, .. } = &self.ideas[*i];
            !self.settled.iter().any(|(kind, subject)| kind == candidate && *subject == proposal.subject)
        };
        let mut group: Vec<usize> = members.into_iter().filter(is_open).collect();
        if group.is_empty() {
            return;
        }
        if self.is_doubtful(&group) && queue.iter().any(|other| !self.is_doubtful(other)) {
            queue.push_back(group);
            return;
        }
        let trial = self.run(&group);
        if let ([own], Some(worst), false) = (&group[..], trial.run.as_ref().and_then(ModelRun::worst), trial.is_kept) {
            self.correct(*own, worst.error);
        }
        if trial.is_kept {
            let subject = |i: &usize| (self.ideas[*i].candidate, self.ideas[*i].proposal.subject.clone());
            self.settled.extend(group.iter().map(subject));
        } else if group.len() > 1 && !self.bench.is_over(self.reserved) {
            group.sort_by(|a, b| self.ideas[*a].proposal.effect.total_cmp(&self.ideas[*b].proposal.effect));
            let larger = group.split_off(group.len().div_ceil(2));
            queue.push_front(larger);
            queue.push_front(group);
        }
        self.found.trials.push(trial);
    }

    fn run(&mut self, group: &[usize]) -> Trial {
        if self.bench.is_over(self.reserved) {
            return self.trial(group, None, "the runs, or the time, were over before".to_string());
        }
        let mut scene = self.found.scene.clone();
        let made = group.iter().try_for_each(|i| (self.ideas[*i].proposal.edit)(&mut scene));
        let made = made.and_then(|()| self.bench.mechanism(&scene));
        let what = self.ideas[group[0]].proposal.what.clone();
        match made.and_then(|_| self.bench.run(&scene, &what, SLOWER * self.bench.richest.seconds)) {
            Err(reason) => self.trial(group, None, reason),
            Ok(run) => {
                let mut reason = self.refusal(&run);
                if reason.is_empty() {
                    reason = self.found.take(self.bench, scene, &run).err().unwrap_or_default();
                }
                self.trial(group, Some(run), reason)
            }
        }
    }

    /// Reason to refuse a model; empty if it is kept.
    fn refusal(&self, run: &ModelRun) -> String {
        let is_dearer = || run.work > DEARER * self.found.run.work;
        let reason = run.refusal(self.bench.promise.within);
        reason.or_else(|| is_dearer().then(|| "it takes more work".to_string())).unwrap_or_default()
    }

    fn trial(&self, group: &[usize], run: Option<ModelRun>, reason: String) -> Trial {
        let list = |text: fn(&Proposal) -> &String| -> Vec<String> {
            group.iter().map(|i| text(&self.ideas[*i].proposal).clone()).collect()
        };
        Trial {
            candidate: self.ideas[group[0]].candidate.to_string(),
            subjects: list(|proposal| &proposal.subject),
            what: list(|proposal| &proposal.what),
            why: short_list(&list(|proposal| &proposal.why)),
            estimated: self.effect(group),
            is_kept: run.is_some() && reason.is_empty(),
            run,
            reason,
        }
    }
}
