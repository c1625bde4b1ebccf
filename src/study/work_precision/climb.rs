//! Reference runs: a few methods of different families at ever tighter tolerances, cheap ones first.

use super::grid::Triple;
use crate::clock::Stopwatch;
use crate::error::{Failure, Result};
use crate::formulation;
use crate::method_spec::MethodSpec;
use crate::simulate::{Method, Span, atol_of};
use crate::study::budget::{Budget, Limit};
use crate::study::metric::ErrorMetric;
use crate::study::pool::run_all;
use crate::study::run::{Motion, RunSample};
use crate::study::second_opinion::{self, SecondOpinion};
use crate::study::watched::Watched;
use std::time::Duration;

/// Sequence of rtol, from loose to tight.
const LADDER: [f64; 6] = [1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-13];
/// Explicit and implicit methods, one in minimal coordinates, one half-explicit, two of diffsol.
const FAMILIES: [[&str; 3]; 7] = [
    ["index1", "dop853", "exact"],
    ["ggl", "radau_iia", "none"],
    ["null_space", "dopri5", "none"],
    ["index2", "phem56", "manifold"],
    ["index2", "radau_iia", "none"],
    second_opinion::METHODS[0],
    second_opinion::METHODS[1],
];
/// Parts of the budget in CPU time for each method, one after the other: short runs show which methods complete the
/// motion, and longer ones follow where these are not accurate enough.
const PARTS: [f64; 3] = [0.02, 0.06, 0.2];
/// Last part, used where no two methods agree in any digit yet.
const LAST: f64 = 0.4;
/// Parts of the budget in wall-clock time for all of them on a busy machine, without the last part and with it.
const WAITED: [f64; 2] = [0.45, 0.8];
/// In the last part only methods run that need at most this many times the time of the quickest.
const QUICK: f64 = 3.0;

/// Completed runs of one method, from loose to tight.
pub struct MethodRuns {
    triple: Triple,
    pub runs: Vec<RunSample>,
    /// Index of the next one in the sequence.
    next: usize,
    /// The last run that failed.
    failure: Option<RunSample>,
}

/// Makes short runs of all families, then longer ones until two agree to `wanted`.
///
/// # Errors
/// Bad input.
pub fn climb(motion: &Motion, wanted: f64, budget: Duration) -> Result<Vec<MethodRuns>> {
    let mut lines: Vec<MethodRuns> = FAMILIES.into_iter().map(MethodRuns::new).collect();
    let budget = Budget::begin(budget);
    for part in PARTS.into_iter().chain([LAST]) {
        let is_last = part == LAST;
        let error = check(&lines, &motion.watched).map_or(f64::INFINITY, |checked| checked.error.0);
        if error <= if is_last { 0.1 } else { wanted } {
            break;
        }
        let limit = Limit { cpu: budget.all.mul_f64(part), wall: budget.left_of(WAITED[usize::from(is_last)]) };
        let times = lines.iter().map(|line| line.forecast(motion.span)).filter(|time| *time > 0.0);
        let longest = if is_last { QUICK * times.fold(f64::INFINITY, f64::min) } else { f64::INFINITY };
        let up = |line: &mut MethodRuns| -> Result<()> {
            if line.forecast(motion.span) > longest { Ok(()) } else { line.climb(motion, limit) }
        };
        // All at once: their times do not depend on how many cores there are.
        run_all(FAMILIES.len(), lines.iter_mut(), up).into_iter().collect::<Result<()>>()?;
    }
    Ok(lines)
}

impl MethodRuns {
    fn new(names: [&str; 3]) -> Self {
        let [formulation, integrator, projection] = names.map(MethodSpec::named);
        let triple = Triple { formulation, integrator, projection };
        MethodRuns { triple, runs: Vec::new(), next: 0, failure: None }
    }

    /// Makes the next runs that can be expected to fit into a limit for all of them.
    fn climb(&mut self, motion: &Motion, limit: Limit) -> Result<()> {
        let Limit { mut cpu, wall } = limit;
        // Minimal coordinates of large systems do not fit into memory.
        if formulation::make(&self.triple.formulation, motion.system).is_err() {
            return Ok(());
        }
        let watch = Stopwatch::start();
        while let Some(rtol) = LADDER.get(self.next).copied() {
            let wall = wall.saturating_sub(watch.wall());
            let is_over = cpu.is_zero() || wall.is_zero() || self.forecast(motion.span) > cpu.as_secs_f64();
            if is_over || (motion.is_stopped)() {
                break;
            }
            let method = self.triple.at(rtol, atol_of(rtol, motion.ratio), None);
            let run = motion.run(&method, Limit { cpu, wall })?;
            cpu = cpu.saturating_sub(Duration::from_secs_f64(run.seconds));
            if run.is_too_slow {
                self.failure = Some(run);
                break;
            }
            // A method that fails at one tolerance may complete at a tighter one.
            self.next += 1;
            if run.failure.is_some() {
                self.failure = Some(run);
            } else {
                self.failure = None;
                self.runs.push(run);
            }
        }
        Ok(())
    }

    /// Returns a lower estimate of the time of the next run, s.
    fn forecast(&self, span: Span) -> f64 {
        let stopped = self.failure.as_ref().and_then(|run| run.whole(span));
        stopped.or_else(|| self.runs.last().map(|run| run.seconds)).unwrap_or(0.0)
    }
}

/// The best run so far, and its error by comparison with another run.
pub struct Checked<'l> {
    pub best: &'l RunSample,
    pub by: Option<&'l RunSample>,
    pub error: (f64, String),
    pub values: ErrorMetric,
}

/// Compares the tightest run, at equal tolerances that of the first method, with the run that agrees best: two methods
/// do not agree in wrong digits by chance. Its own looser run is used where no other is as tight as that.
pub fn check<'l>(lines: &'l [MethodRuns], watched: &Watched) -> Option<Checked<'l>> {
    let own = lines.iter().min_by(|a, b| tightest(a).total_cmp(&tightest(b)))?;
    let (best, rest) = own.runs.split_last()?;
    let others = lines.iter().filter_map(|line| line.runs.last()).filter(|run| !same(run, best));
    let looser = rest.last();
    let is_alone = looser.is_some_and(|looser| others.clone().all(|run| run.method.rtol > looser.method.rtol));
    let candidates = others.chain(looser.filter(|_| is_alone));
    let values = ErrorMetric::of(watched, best);
    let checked = candidates.map(|run| (values.error(&run.rows), run));
    let nearest = checked.min_by(|a, b| a.0.0.total_cmp(&b.0.0));
    let (error, by) = nearest.map_or(((1.0, String::new()), None), |(error, by)| (error, Some(by)));
    Some(Checked { best, by, error, values })
}

/// The difference of the nearest run of diffsol from the values of `checked`; none where diffsol completed none, or is
/// the best itself.
pub fn confirmed(lines: &[MethodRuns], checked: &Checked) -> Option<SecondOpinion> {
    let is_confirming = |run: &RunSample| {
        let Method { formulation, integrator, .. } = &run.method;
        second_opinion::METHODS.iter().any(|names| names[..2] == [formulation.name.as_str(), integrator.name.as_str()])
    };
    if is_confirming(checked.best) {
        return None;
    }
    let theirs = lines.iter().filter_map(|line| line.runs.last()).filter(|run| is_confirming(run));
    let compared = theirs.map(|run| SecondOpinion::of(run.name(), &checked.values, &run.rows));
    compared.min_by(|a, b| a.difference.unwrap_or(f64::INFINITY).total_cmp(&b.difference.unwrap_or(f64::INFINITY)))
}

/// True if both are runs of one method.
pub fn same(a: &RunSample, b: &RunSample) -> bool {
    a.method.triple() == b.method.triple()
}

fn tightest(line: &MethodRuns) -> f64 {
    line.runs.last().map_or(f64::INFINITY, |run| run.method.rtol)
}

/// Returns the failure where no method completed, with the time that the quickest needs, extrapolated from the part it
/// completed.
pub fn nothing(lines: &[MethodRuns], span: Span, budget: Duration) -> Failure {
    let stopped = lines.iter().filter_map(|line| line.failure.as_ref());
    let forecast = |run: &RunSample| run.whole(span).filter(|seconds| *seconds > 0.0);
    let forecasts = stopped.clone().filter_map(|run| Some((&run.method, forecast(run)?)));
    let quickest = forecasts.min_by(|a, b| a.1.total_cmp(&b.1));
    let failures = stopped.clone().filter_map(|run| run.failure.as_ref());
    let t = failures.fold(span.start, |t, failure| t.max(failure.t));
    if let Some((method, seconds)) = quickest {
        return Failure {
            t,
            reason: format!(
                "no method brings the motion to its end in {} s, so that there is nothing to compare with; the quickest, {} at rtol {:e}, would take about {seconds:.1} s",
                budget.as_secs_f64(),
                method.triple(),
                method.rtol
            ),
            hint: format!(
                "give more time by --budget {:.0}s, a shorter motion by --until, or values by --reference FILE",
                (seconds / PARTS[1]).ceil()
            ),
        };
    }
    let mut failed = stopped.filter(|run| !run.is_too_slow).filter_map(|run| run.failure.clone());
    failed.next().unwrap_or_else(|| Failure {
        t,
        reason: "no method starts in the time allowed".to_string(),
        hint: "give more time by --budget".to_string(),
    })
}
