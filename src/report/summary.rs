//! `summary.json`.

use super::warnings::warnings;
use super::{Table, check_error};
use crate::analysis::{Drift, EnergyBalance, Passing, Record, Singularity};
use crate::compare::CheckError;
use crate::error::{Failure, Warning, clock, short_list, significant};
use crate::formulation::Statistics;
use crate::initial::{Assembly, Level, Move};
use crate::prepared::PreparedScene;
use crate::simulate::{Checkpoint, Leg, Method, Outcome, Stiffness};
use serde::Serialize;
use serde_json::{Map, Value};

/// A run in numbers.
#[derive(Clone, Debug, Serialize)]
pub struct Summary {
    /// Version of the program, and how it was called; nothing from the library.
    pub holonom: &'static str,
    pub command: Vec<String>,
    pub parameters: Map<String, Value>,
    /// What makes the result doubtful; nothing known does where it is empty.
    pub warnings: Vec<Warning>,
    pub scene: String,
    pub method: Chosen,
    pub status: &'static str,
    pub failure: Option<Failure>,
    pub t_end: f64,
    pub wall_seconds: f64,
    pub statistics: Statistics,
    pub drift: Drift,
    pub energy: Option<EnergyBalance>,
    pub singularity: Singularity,
    /// Modes that the method cannot step over; none where it can, or is implicit.
    pub stiffness: Option<Stiffness>,
    pub assembly: AssemblySummary,
    /// The error by a second run, where that was asked for.
    pub check_error: Option<CheckError>,
    pub r#final: FinalState,
    /// From where `--start` goes on; none where the run could not begin.
    pub restart: Option<Checkpoint>,
}

/// The method, and why where it was left to the program.
#[derive(Clone, Debug, Serialize)]
pub struct Chosen {
    /// That of the longest leg.
    #[serde(flatten)]
    pub method: Method,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub chosen_because: Option<String>,
    /// Where the method changed on the way, all in their order.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub legs: Vec<Leg>,
    /// Work of the methods that tried, beside that of those that carried the motion.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub trials: Option<Statistics>,
}

impl Chosen {
    fn of(prepared: &PreparedScene, legs: &[Leg], end: f64) -> Self {
        let ends = legs.iter().skip(1).map(|leg| leg.from).chain([end]);
        let longest =
            legs.iter().zip(ends).max_by(|(a, a_end), (b, b_end)| (a_end - a.from).total_cmp(&(b_end - b.from)));
        Chosen {
            method: longest.map_or(&prepared.method, |(leg, _)| &leg.method).clone(),
            chosen_because: longest.map(|(leg, _)| leg.because.clone()),
            legs: if legs.len() > 1 { legs.to_vec() } else { Vec::new() },
            trials: legs.iter().map(|leg| leg.trials).reduce(|sum, trials| sum + trials),
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

/// What assembly did.
#[derive(Clone, Debug, Serialize)]
pub struct AssemblySummary {
    pub before: Level,
    pub after: Level,
    pub moves: Vec<Move>,
}

impl From<&Assembly> for AssemblySummary {
    fn from(assembly: &Assembly) -> Self {
        AssemblySummary { before: assembly.before, after: assembly.after, moves: assembly.moves.clone() }
    }
}

/// The last row, by names.
#[derive(Clone, Debug, Serialize)]
pub struct FinalState {
    pub t: f64,
    pub q: Map<String, Value>,
    pub v: Map<String, Value>,
    pub lambda: Map<String, Value>,
    pub outputs: Map<String, Value>,
}

/// Work of rows is told where it is more than this part of that of the steps.
const SHOWN: f64 = 0.1;

/// Collects the summary of a run, with warnings from before it.
pub fn summarize(
    (prepared, stiffness, early): (&PreparedScene, Option<Stiffness>, &[Warning]),
    (outcome, legs): (&Outcome, &[Leg]),
    record: &Record,
    wall_seconds: f64,
) -> Summary {
    // What ended a run may be no more than what came of leaving the branch.
    let failure = record.singularity.failure().or(outcome.failure.clone());
    let parameters = prepared.parameters.iter().map(|(name, value)| (name.to_string(), Value::from(value))).collect();
    Summary {
        holonom: env!("CARGO_PKG_VERSION"),
        command: Vec::new(),
        parameters,
        warnings: early.iter().cloned().chain(warnings(record)).collect(),
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
        assembly: (&prepared.assembly).into(),
        check_error: None,
        r#final: final_state(record),
        restart: None,
    }
}

fn final_state(record: &Record) -> FinalState {
    let trajectory = &record.trajectory;
    let named = |names: &mut dyn Iterator<Item = &String>, values: &[f64]| -> Map<String, Value> {
        names.zip(values).map(|(name, value)| (name.clone(), Value::from(*value))).collect()
    };
    let Some(row) = trajectory.rows.last() else {
        let empty = Map::new;
        return FinalState { t: 0.0, q: empty(), v: empty(), lambda: empty(), outputs: empty() };
    };
    let (q, v, lambda) = trajectory.row_state(row);
    FinalState {
        t: row[0],
        q: named(&mut trajectory.names.q.iter(), q),
        v: named(&mut trajectory.names.v.iter(), v),
        lambda: named(&mut trajectory.names.lambda.iter(), lambda),
        outputs: named(&mut trajectory.outputs.iter().map(|column| &column.name), trajectory.row_outputs(row)),
    }
}

impl Summary {
    /// The summary as a person reads it.
    pub fn text(&self, units: &[(String, String)]) -> String {
        let Method { formulation, integrator, projection, rtol, atol, step } = &self.method.method;
        let accuracy = match step {
            Some(step) => format!("step {} s", clock(*step)),
            None => format!("rtol {rtol:e}, atol {atol:e}"),
        };
        let s = &self.statistics;
        let trials = self.method.trials.filter(|trials| trials.rhs_evaluations > 0);
        let rows = Some(s.rows.rhs_evaluations).filter(|rows| *rows as f64 > SHOWN * s.rhs_evaluations as f64);
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
            text += "  redundant constraints at all states: multipliers are those of least norm\n\n";
        }
        text += &singular_text(&self.singularity);
        let mut drift = Table::new(&["drift", "max", "final", "relative max"]);
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
                .map_or(String::new(), |part| format!(" ({part:.1e} of what was turned over)"));
            text += &format!(
                "\n  energy {} J -> {} J, work {} J, error of the balance {:.2e} J{part}\n",
                significant(energy.initial, 6),
                significant(energy.last, 6),
                significant(energy.work, 6),
                energy.max_error
            );
        }
        text += &self.outputs_text(units);
        text + &check_error::text(&self.method.method, self.check_error.as_ref())
    }

    /// The same with the error by a second run.
    pub fn checked(mut self, check: CheckError) -> Self {
        self.warnings.extend(check_error::cut_short(&check));
        self.check_error = Some(check);
        self
    }

    /// A line that says how far the start was moved, where it was.
    fn assembly_text(&self) -> String {
        let Some(largest) = self.assembly.moves.first() else { return String::new() };
        format!(
            "  assembly moved {} coordinates and velocities, most {}: {} -> {}\n",
            self.assembly.moves.len(),
            largest.name,
            significant(largest.from, 6),
            significant(largest.to, 6)
        )
    }

    fn outputs_text(&self, units: &[(String, String)]) -> String {
        if self.r#final.outputs.is_empty() {
            return String::new();
        }
        let mut table = Table::new(&[&format!("at t = {} s", clock(self.r#final.t)), "", ""]);
        for ((name, value), (_, unit)) in self.r#final.outputs.iter().zip(units) {
            let value = value.as_f64().map_or("?".to_string(), |value| significant(value, 12));
            table.row([name.clone(), value, unit.clone()]);
        }
        format!("\n{table}")
    }
}

/// A wall time as a person reads it.
fn elapsed(seconds: f64) -> String {
    match seconds {
        short if short < 1.0 => format!("{} ms", significant(1e3 * seconds, 3)),
        long if long < 1000.0 => format!("{} s", significant(seconds, 3)),
        _ => format!("{seconds:.0} s"),
    }
}

/// Times of singular states that are named.
const NAMED: usize = 5;

/// What a person reads of singular states.
fn singular_text(found: &Singularity) -> String {
    let Some(nearest) = found.nearest else { return String::new() };
    if found.passed.is_empty() {
        let condition = nearest.condition.map_or(String::new(), |condition| format!(", condition {condition:.1e}"));
        let [rank_indicator, t] = [nearest.rank_indicator, nearest.t].map(|value| significant(value, 3));
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
        text += &match rank < regular_rank {
            true => format!("  rank {rank} there, {regular_rank} beside: dependent rows of {joints}\n"),
            false => format!("  nearly dependent rows of {joints}\n"),
        };
    }
    text + "\n"
}
