//! Text of a work-precision measurement.

use super::{MethodsAnswer, accuracy, milliseconds};
use crate::error::clock;
use crate::report::TextTable;
use crate::report::table::count;
use crate::study::work_precision::{Cell, Lack, Outcome, Reference, WorkPrecision, cheapest_by_method};
use std::fmt::Write;

/// Returns the recommendations, the cheapest run of each method for the digits, and the methods that did not reach them.
pub(super) fn text(answer: &MethodsAnswer) -> String {
    let MethodsAnswer { measured, recommendations, digits, .. } = answer;
    let digits = *digits;
    let mut text = head(measured);
    for same in recommendations.chunk_by(|a, b| a.sentence == b.sentence) {
        let [first, .., last] = same else {
            let digits = count(same[0].places.digits as usize, "digit");
            text += &format!("  for {digits}: {}\n", same[0].sentence);
            continue;
        };
        text += &format!("  for {} to {} digits: {}\n", first.places.digits, last.places.digits, first.sentence);
    }
    let asked = recommendations.iter().find(|advice| advice.places.digits == digits);
    let most = asked.or(recommendations.last());
    if let Some(Lack { why, hint, .. }) = measured.lacks(digits) {
        text += &format!("  for {digits} digits: none; {why}\n    {hint}\n");
    }
    text += &most.map_or(String::new(), |advice| format!("\n  {}\n{}", advice.command, families(measured, advice)));
    let digits = most.map_or(digits, |advice| advice.places.digits);
    let left_out = measured.left_out.iter().map(|what| format!("\n  left out: {what}\n"));
    text + &tables(measured, digits) + &left_out.collect::<String>()
}

fn head(measured: &WorkPrecision) -> String {
    let mut text = format!(
        "{}: speed for accuracy, {} s to {} s\n",
        measured.scene,
        clock(measured.t_start),
        clock(measured.t_end)
    );
    let Some(reference) = &measured.reference else { return text };
    let Reference { from, checked_by, is_independent, error, worst, values, .. } = reference;
    let names = match &values.names[..] {
        few if few.len() <= 6 => few.join(", "),
        many => format!("{} and {} more", many[..5].join(", "), many.len() - 5),
    };
    let _ =
        writeln!(text, "  compared at {} times of the motion, each relative to its size in it: {names}", measured.rows);
    let _ = writeln!(text, "  reference: {from}; differs from {checked_by} by {error:.0e} ({worst})");
    if let Some(opinion) = &reference.second_opinion {
        let _ = writeln!(text, "  {opinion}");
    }
    if !is_independent {
        text += "  no second method came as far: the reference's error is only its change with the tolerance\n";
    }
    text + "\n"
}

/// Returns the saving or the additional cost of implicit methods.
fn families(measured: &WorkPrecision, advice: &super::Advice) -> String {
    let pair = |place: Option<usize>| {
        let cell = &measured.cells[place?];
        Some((cell.method.triple(), cell.cost?))
    };
    let (Some(explicit), Some(implicit)) = (pair(advice.places.explicit), pair(advice.places.implicit)) else {
        return String::new();
    };
    let (winner, other, words) = if explicit.1 < implicit.1 {
        (&explicit, &implicit, ["explicit", "implicit"])
    } else {
        (&implicit, &explicit, ["implicit", "explicit"])
    };
    let ratio = crate::error::short(format!("{:.1e}", other.1 / winner.1).parse().unwrap_or(0.0));
    format!(
        "  the best {} method, {}, is {ratio} times as fast as the best {} one, {} ({})\n",
        words[0],
        winner.0,
        words[1],
        other.0,
        milliseconds(other.1)
    )
}

/// Returns the cheapest run of each method that has the digits; the others by their digits.
fn tables(measured: &WorkPrecision, digits: u32) -> String {
    let (reached, others) = cheapest_by_method(&measured.cells, digits);
    let first = format!("{digits} digits or more");
    let headings = [&first, "accuracy", "digits", "CPU", "rhs", "factored", "max |φ|", "max |φ′|"];
    let mut table = TextTable::new(&headings).words(1);
    for cell in reached.iter().map(|place| &measured.cells[*place]) {
        table.row(line(cell));
    }
    let mut text = format!("\n{table}");
    if !others.is_empty() {
        let mut table = TextTable::new(&["fewer digits", "accuracy", "digits", "CPU", "what then"]).words(1).words(4);
        for cell in others.iter().map(|place| &measured.cells[*place]) {
            let ends = measured.cells.iter().filter(|other| other.is_of(&cell.method));
            let then = ends.filter(|other| other.decades > cell.decades || cell.reason().is_some()).find_map(reason);
            let cells = line(cell);
            table.row(cells.into_iter().take(4).chain([then.unwrap_or_default()]));
        }
        text += &format!("\n{table}");
    }
    text
}

fn reason(cell: &Cell) -> Option<String> {
    match &cell.outcome {
        Outcome::Completed { .. } => None,
        Outcome::Skipped { reason } | Outcome::TooSlow { reason, .. } => Some(format!("1e-{}: {reason}", cell.decades)),
        Outcome::Failed { failure, .. } => {
            Some(format!("1e-{}: failed at t = {:.3e} s: {}", cell.decades, failure.t, failure.reason))
        }
    }
}

fn line(cell: &Cell) -> Vec<String> {
    let mut cells = vec![cell.method.triple(), accuracy(&cell.method)];
    let Outcome::Completed { statistics, drift, .. } = &cell.outcome else {
        cells.extend(["-", "-"].map(String::from));
        return cells;
    };
    cells.extend([
        format!("{:.1}", cell.digits().unwrap_or(0.0)),
        cell.cost.map_or(String::new(), milliseconds),
        statistics.whole().rhs_evaluations.to_string(),
        statistics.whole().factorizations.to_string(),
        format!("{:.0e}", drift.position),
        format!("{:.0e}", drift.velocity),
    ]);
    cells
}
