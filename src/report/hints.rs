//! What looks superfluous or missing at the start, in words.

use crate::error::{percent, short_list, significant};
use crate::simplify::{Hints, RodForce, Unseen};
use crate::tolerances::SAME;

pub fn hints_text(hints: &Hints) -> String {
    if !hints.skipped.is_empty() {
        return format!("what looks superfluous was not looked for: {}\n", hints.skipped.lines().next().unwrap_or(""));
    }
    let is_slow = |mode: &&Unseen| hints.slowest_seen.is_none_or(|slowest| mode.circular_frequency < slowest);
    let (slow, fast): (Vec<&Unseen>, Vec<&Unseen>) = hints.unseen.iter().partition(is_slow);
    let mut text = String::new();
    if !hints.changes.is_empty() || !fast.is_empty() {
        text += "looks superfluous in small motions about the start; `holonom simplify` measures it along the whole:\n";
    }
    hints.changes.iter().for_each(|hint| text += &format!("  {}: {}\n", hint.what, hint.why));
    text += &modes(&fast).map_or(String::new(), |modes| format!("  {modes}\n"));
    text +=
        &rods("only pull in small motions about the start, where ropes would do", &hints.rods, |rod| rod.least > 0.0);
    text += &rods("are compressed at the start, where ropes would not do", &hints.rods, |rod| rod.at_start < 0.0);
    text + &modes(&slow).map_or(String::new(), |modes| format!("an output may be missing: {modes}\n"))
}

/// A line about the rods of this kind, with their forces at the start; empty where there is none.
fn rods(what: &str, rods: &[RodForce], is_of: impl Fn(&RodForce) -> bool) -> String {
    let force = |rod: &RodForce| format!("{} by {} N", rod.name, significant(rod.at_start.abs(), 4));
    let told: Vec<String> = rods.iter().filter(|rod| is_of(rod)).map(force).collect();
    if told.is_empty() { String::new() } else { format!("rods that {what}: {}\n", short_list(&told)) }
}

fn modes(modes: &[&Unseen]) -> Option<String> {
    let frequency = |mode: &&Unseen| mode.circular_frequency;
    let least = modes.iter().map(frequency).reduce(f64::min)?;
    let most = modes.iter().map(frequency).reduce(f64::max)?;
    let seen = modes.iter().map(|mode| mode.seen).fold(0.0, f64::max);
    let mut moves: Vec<String> = modes.iter().flat_map(|mode| mode.moves.clone()).collect();
    moves.sort();
    moves.dedup();
    let least = significant(least, 3);
    let most = significant(most, 3);
    let which = match modes.len() {
        1 => format!("the mode at {least} 1/s"),
        count => format!("{count} modes from {least} to {most} 1/s"),
    };
    let of = if moves.is_empty() { String::new() } else { format!(" ({})", short_list(&moves)) };
    let which = format!("{which}{of}");
    Some(match seen {
        little if little < SAME => format!("no output sees {which}"),
        _ => format!("outputs see at most {} of {which}, by what they see of others", percent(seen)),
    })
}
