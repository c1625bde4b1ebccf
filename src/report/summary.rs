//! `summary.json`.

use super::table::{OutputValues, named};
use super::warnings::{at_round_off, warnings};
use super::{Origin, TextTable, error_bar};
use crate::analysis::{Drift, EnergyBalance, Extremes, Passing, Record, Singularity};
use crate::error::{Failure, Warning, clock, short_list, significant};
use crate::formulation::Statistics;
use crate::initial::Assembly;
use crate::math::kkt::has_least_norm;
use crate::prepared::Model;
use crate::simulate::{Checkpoint, Leg, Method, Outcome, Stiffness};
use crate::study::ErrorBars;
use serde::{Serialize, Serializer};
use serde_json::{Map, Value};

#[derive(Clone, Debug, Serialize)]
pub struct Summary {
    #[serde(flatten)]
    pub origin: Origin,
    scene: String,
    method: Chosen,
    /// `completed` or `failed`.
    status: &'static str,
    pub failure: Option<Failure>,
    t_end: f64,
    wall_seconds: f64,
    statistics: Statistics,
    drift: Drift,
    /// None where the system defines no potential.
    energy: Option<EnergyBalance>,
    singularity: Singularity,
    /// Fast modes that the method cannot step over; none where it can, or is implicit.
    stiffness: Option<Stiffness>,
    assembly: Assembly,
    pub error: Option<ErrorBars>,
    /// Extremes of each output over the rows, by its name.
    #[serde(serialize_with = "by_name")]
    outputs: Vec<Extremes>,
    r#final: FinalState,
    /// Hash of what the scene says of the mechanism.
    scene_hash: String,
    /// State from which `--start` continues; none where the run could not begin.
    pub restart: Option<Checkpoint>,
}

#[derive(Clone, Debug, Serialize)]
struct Chosen {
    /// Method of the longest leg.
    #[serde(flatten)]
    method: Method,
    #[serde(skip_serializing_if = "Option::is_none")]
    chosen_because: Option<String>,
    /// The legs in their order, where the method changed during the run.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    legs: Vec<Leg>,
    /// Work of the methods tried, besides that of the methods of the legs.
    #[serde(skip_serializing_if = "Option::is_none")]
    trials: Option<Statistics>,
}

impl Chosen {
    fn of(prepared: &Model, legs: &[Leg], end: f64) -> Self {
        let ends = legs.iter().skip(1).map(|leg| leg.from).chain([end]);
        let longest =
            legs.iter().zip(ends).max_by(|(a, a_end), (b, b_end)| (a_end - a.from).total_cmp(&(b_end - b.from)));
        Chosen {
            method: longest.map_or(&prepared.method, |(leg, _)| &leg.method).clone(),
            chosen_because: longest.map(|(leg, _)| leg.because.clone()),
            legs: if legs.len() > 1 { legs.to_vec() } else { Vec::new() },
            trials: legs.iter().map(Leg::tried).reduce(|sum, trials| sum + trials),
        }
    }

    fn text(&self) -> String {
        let only = self.chosen_because.iter().filter(|_| self.legs.is_empty());
        let first = only.map(|because| format!("  auto: {because}\n"));
        let later = self.legs.iter().skip(1).map(|Leg { from, method, because, .. }| {
            format!("  auto: from t = {} s on by {}. {because}\n", clock(*from), method.triple())
        });
        first.chain(later).collect()
    }
}

#[derive(Clone, Debug, Default, Serialize)]
struct FinalState {
    t: f64,
    q: Map<String, Value>,
    v: Map<String, Value>,
    lambda: Map<String, Value>,
    outputs: OutputValues,
}

/// Collects the summary of a run, with warnings from before it.
pub fn summarize(
    prepared: &Model,
    stiffness: Option<Stiffness>,
    early: &[Warning],
    outcome: &Outcome,
    legs: &[Leg],
    record: &Record,
    wall_seconds: f64,
) -> Summary {
    // The error that ended a run may be a consequence of leaving the branch, which is reported first.
    let failure = record.singularity.failure_of(outcome);
    // Fixed steps go on to round-off in any case.
    let at_round_off = at_round_off(&outcome.statistics).filter(|_| prepared.method.step.is_none());
    let warnings = early.iter().cloned().chain(warnings(record)).chain(at_round_off);
    Summary {
        origin: Origin::new(&prepared.parameters, warnings.collect()),
        scene: prepared.name.clone(),
        method: Chosen::of(prepared, legs, outcome.t),
        status: if failure.is_some() { "failed" } else { "completed" },
        failure,
        t_end: outcome.t,
        wall_seconds,
        statistics: outcome.statistics,
        drift: record.drift.clone(),
        energy: record.energy,
        singularity: record.singularity.clone(),
        stiffness,
        assembly: prepared.assembly.clone(),
        error: None,
        outputs: record.extremes.clone(),
        r#final: final_state(record),
        scene_hash: prepared.fingerprint.clone(),
        restart: None,
    }
}

fn final_state(record: &Record) -> FinalState {
    let trajectory = record.full();
    let Some(row) = trajectory.rows.last() else { return FinalState::default() };
    let (q, v, lambda) = trajectory.row_state(row);
    FinalState {
        t: row[0],
        q: named(&trajectory.names.q, q),
        v: named(&trajectory.names.v, v),
        lambda: named(&trajectory.names.lambda, lambda),
        outputs: OutputValues::new(trajectory.outputs.clone(), trajectory.row_outputs(row).to_vec()),
    }
}

impl Summary {
    pub fn text(&self) -> String {
        let Method { formulation, integrator, projection, .. } = &self.method.method;
        let accuracy = error_bar::accuracy(&self.method.method);
        let s = &self.statistics;
        let trials = self.method.trials.filter(|trials| trials.rhs_evaluations > 0);
        let rows = Some(s.rows.rhs_evaluations).filter(|rows| *rows as f64 > 0.1 * s.rhs_evaluations as f64);
        let mut text = format!("{}: {formulation} + {integrator} + {projection}, {accuracy}\n", self.scene);
        text += &self.method.text();
        if let Some(failure) = &self.failure {
            text += &format!("  FAILED at t = {:.6e} s: {}\n  help: {}\n", failure.t, failure.reason, failure.hint);
        }
        text += &self.assembly_text();
        text += &format!(
            "  t = {} s reached in {}: {} steps, {} rejected, {} evaluations{}{}, {} factorizations\n\n",
            clock(self.t_end),
            elapsed(self.wall_seconds),
            s.steps,
            s.rejected,
            s.rhs_evaluations,
            rows.map_or(String::new(), |rows| format!(" and {rows} in rows")),
            trials.map_or(String::new(), |trials| format!(" and {} in trials", trials.rhs_evaluations)),
            s.factorizations
        );
        if s.rank_deficient > s.steps {
            let rows = self.r#final.lambda.len();
            text += if has_least_norm(rows / 2, rows) {
                "  redundant constraints at all states: multipliers are those of least norm\n\n"
            } else {
                "  redundant constraints at all states: `holonom check` says which multipliers are computed\n\n"
            };
        }
        text += &singular_text(&self.singularity);
        let mut drift = TextTable::new(&["drift", "max", "final", "relative max"]);
        for (name, level) in [
            ("position |phi|", &self.drift.position),
            ("velocity |phi'|", &self.drift.velocity),
            ("acceleration |phi''|", &self.drift.acceleration),
        ] {
            let cells = [level.max, level.last, level.relative_max].map(|value| format!("{value:.2e}"));
            drift.row([name.to_string()].into_iter().chain(cells));
        }
        text += &drift.to_string();
        if let Some(energy) = &self.energy {
            let part = energy
                .relative_max_error
                .map_or(String::new(), |part| format!(" ({part:.1e} of the energy converted)"));
            text += &format!(
                "\n  energy {} J -> {} J, work {} J, error of the balance {:.2e} J{part}\n",
                significant(energy.initial, 6),
                significant(energy.last, 6),
                significant(energy.work, 6),
                energy.max_error
            );
        }
        text += &self.outputs_text();
        text + &error_bar::text(&self.method.method, self.error.as_ref())
    }

    /// Returns a line for each output with its last value and its extremes; nothing where there is none.
    fn outputs_text(&self) -> String {
        if self.outputs.is_empty() {
            return String::new();
        }
        let last = format!("at t = {} s", clock(self.r#final.t));
        let mut table = TextTable::new(&["output", &last, "min", "at s", "max", "at s", "rms", ""]).words(7);
        for (output, last) in self.outputs.iter().zip(self.r#final.outputs.values()) {
            let Extremes { name, unit, min, t_min, max, t_max, rms, .. } = output;
            let cell = |value: Option<f64>, digits| value.map_or("?".to_string(), |value| significant(value, digits));
            let last = cell(Some(*last).filter(|last| last.is_finite()), 12);
            let extremes = [min, t_min, max, t_max, rms].map(|value| cell(*value, 5));
            table.row([name.clone(), last].into_iter().chain(extremes).chain([unit.clone()]));
        }
        format!("\n{table}")
    }

    pub fn checked(mut self, bars: ErrorBars) -> Self {
        self.origin.warnings.extend(error_bar::cut_short(&bars));
        self.error = Some(bars);
        self
    }

    /// Returns a line on the changes of the start by assembly, if any.
    fn assembly_text(&self) -> String {
        let Some(largest) = self.assembly.moves.first() else { return String::new() };
        format!(
            "  assembly moved {}; the largest change is that of {}: {} -> {}\n",
            super::table::count(self.assembly.moves.len(), "state"),
            largest.name,
            significant(largest.from, 6),
            significant(largest.to, 6)
        )
    }
}

fn elapsed(seconds: f64) -> String {
    match seconds {
        short if short < 1.0 => format!("{} ms", significant(1e3 * seconds, 3)),
        long if long < 1000.0 => format!("{} s", significant(seconds, 3)),
        _ => format!("{seconds:.0} s"),
    }
}

/// Largest number of singular states whose times are given.
const NAMED: usize = 5;

fn singular_text(found: &Singularity) -> String {
    let Some(nearest) = found.nearest else { return String::new() };
    if found.passed.is_empty() {
        let condition = nearest.condition.map_or(String::new(), |condition| format!(", condition {condition:.1e}"));
        let rank_indicator = significant(nearest.rank_indicator, 3);
        let t = significant(nearest.t, 3);
        return format!("  nearest to a singular state at t = {t} s: rank indicator {rank_indicator}{condition}\n\n");
    }
    let times = |kind: bool| -> Vec<String> {
        let of_kind = found.passed.iter().filter(|passing| passing.is_singular == kind);
        of_kind.map(|passing| format!("{:.9}", passing.t).trim_end_matches('0').to_string()).collect()
    };
    let mut text = String::new();
    for (what, times) in [("passed singular states", times(true)), ("came near to singular states", times(false))] {
        if times.is_empty() {
            continue;
        }
        let more = if times.len() > NAMED { format!(" ... ({} in all)", times.len()) } else { String::new() };
        text += &format!("  {what} at t = {}{more} s\n", times[..times.len().min(NAMED)].join(", "));
    }
    let named = found.passed.iter().find(|passing| !passing.joints.is_empty());
    if let Some(Passing { rank: Some(rank), regular_rank, joints, .. }) = named {
        let joints = short_list(joints);
        text += &if rank < regular_rank {
            format!("  rank {rank} there, {regular_rank} beside: dependent rows of {joints}\n")
        } else {
            format!("  nearly dependent rows of {joints}\n")
        };
    }
    text + "\n"
}

fn by_name<S: Serializer>(outputs: &[Extremes], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(outputs.iter().map(|output| (&output.name, output)))
}
