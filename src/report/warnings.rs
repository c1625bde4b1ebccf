//! Reasons to doubt a result although it was computed to the end.

use crate::analysis::{Drift, EnergyBalance, MOST_JUMPS, Record, WorstStep};
use crate::error::Warning;
use crate::error::significant;
use crate::formulation::Statistics;
use crate::tolerances;
use crate::trajectory::Gap;

pub fn warnings(record: &Record) -> Vec<Warning> {
    let energy = record.energy.as_ref().filter(|energy| energy.is_open()).map(open_balance);
    let energy = energy.or_else(|| record.worst_step.is_alone().then(|| energy_jump(&record.worst_step)));
    let row = record.energy.as_ref().filter(|energy| record.worst_row.contradicts(energy)).map(|_| odd_row(record));
    let doubts = open_joints(&record.drift).into_iter().chain(energy).chain(row).chain(gaps(record));
    doubts.chain(record.range.warnings()).chain(many_jumps(record.jumps)).collect()
}

/// Returns a warning of uncertain classes of eigenvalues, by these methods, each of which may be named more than once.
pub fn uncertain_kinds<'m>(methods: impl Iterator<Item = &'m str>) -> Option<Warning> {
    let mut names: Vec<&str> = Vec::new();
    methods.for_each(|method| {
        if !names.contains(&method) {
            names.push(method)
        }
    });
    let text = || {
        format!("kinds of eigenvalues are uncertain by {}: no gap tells physical from spurious ones", names.join(", "))
    };
    (!names.is_empty())
        .then(|| Warning::new(text(), "take --method mcs, which has no spurious ones, or larger penalties and gains"))
}

/// Returns a warning if round-off, not the tolerance, limits the errors of controlled steps.
pub fn at_round_off(&Statistics { steps, stagnated, .. }: &Statistics) -> Option<Warning> {
    let text =
        || format!("{stagnated} of {steps} steps end at round-off, not at the tolerance: errors are larger than that");
    let hint = "a looser --rtol gives the same in less time; --check-error measures errors; for smaller ones choose a \
                method of higher order, such as dop853, or radau_iia for stiff motions";
    (stagnated as f64 > 0.1 * steps as f64).then(|| Warning::new(text(), hint))
}

fn open_joints(drift: &Drift) -> Option<Warning> {
    let open = drift.position.relative_final;
    let text =
        || format!("the joints have come apart by {open:.1e} of the scene's size: the motion is not that of the scene");
    (open > tolerances::TOLD).then(|| Warning::new(text(), "choose a projection such as `manifold`, or a smaller step"))
}

fn open_balance(energy: &EnergyBalance) -> Warning {
    let in_words = |part: f64| {
        if part < 1.0 {
            format!(", {} % of the energy converted", significant(100.0 * part, 2))
        } else {
            format!(", {} times the energy converted", significant(part, 2))
        }
    };
    let part = energy.relative_max_error.map_or(String::new(), in_words);
    let expected = match energy.tolerated {
        Some(tolerated) => format!("the tolerated errors of all steps make {tolerated:.1e} J"),
        None => "a step that is short enough leaves far less".to_string(),
    };
    let text = format!("the energy balance does not close, by {:.1e} J{part}; {expected}", energy.max_error);
    let hint = match energy.tolerated {
        Some(_) => "compare with a tighter --rtol and --atol, and with another integrator",
        None => "compare with a smaller --step, and with an adaptive integrator",
    };
    Warning::new(text, hint)
}

fn odd_row(record: &Record) -> Warning {
    let t = significant(record.worst_row.t, 6);
    let error = record.worst_row.error;
    let text = format!(
        "the row at t = {t} s has an energy that no step has, by {error:.1e} J: a short force acts between steps"
    );
    Warning::new(text, "give a --step below its duration, or an explicit integrator such as dop853, which meets it")
}

fn many_jumps(jumps: usize) -> Option<Warning> {
    let text = || {
        format!("quantities jump at {jumps} times: the table has a row on both sides of the first {MOST_JUMPS} of them")
    };
    let hint =
        "least and greatest values in summary.json are from both sides of all; a smaller --output-step shows more";
    (jumps > MOST_JUMPS).then(|| Warning::new(text(), hint))
}

fn energy_jump(&WorstStep { t, change, other, tolerated, .. }: &WorstStep) -> Warning {
    let times = significant(change / other, 2);
    let part = significant(change / tolerated, 2);
    let text = format!(
        "the energy balance changes by {change:.1e} J in the step to t = {t:.6} s, {times} times as much as in any other \
         step and {part} times what its tolerated errors make: the motion may be wrong from there on"
    );
    Warning::new(text, "compare with another --rtol and --atol, and with another integrator")
}

fn gaps(record: &Record) -> Vec<Warning> {
    let rows = record.rows;
    let warning = |Gap { name, first, count }: &Gap| {
        let text = format!(
            "the output `{name}` has no finite value at {count} of {rows} times, first at t = {first:.6} s: its cells are empty"
        );
        Warning::new(text, "look for what it is not defined for")
    };
    record.gaps.iter().map(warning).collect()
}
