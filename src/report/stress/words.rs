//! Verdicts in words that a person can act on.

use crate::error::short;
use crate::measure::stress::{Axis, Best, Bound, GainVerdict, Reason, Side, Status, StepVerdict, Stressed, Verdict};
use crate::report::Table;

/// The verdict on a map: a sentence or two for each method.
pub fn sentences(stressed: &Stressed) -> Vec<String> {
    let gains = stressed.gains();
    if gains.is_empty() {
        return stressed.verdicts().iter().map(|verdict| general(stressed, verdict)).collect();
    }
    gains.iter().map(gain).collect()
}

fn two(value: f64) -> String {
    short(format!("{value:.1e}").parse().unwrap_or(value))
}

fn span(values: impl Iterator<Item = f64> + Clone) -> Option<String> {
    let low = values.clone().fold(f64::INFINITY, f64::min);
    let high = values.fold(f64::NEG_INFINITY, f64::max);
    match low.total_cmp(&high) {
        std::cmp::Ordering::Less => Some(format!("{low:.1e} to {high:.1e}")),
        std::cmp::Ordering::Equal => Some(format!("{low:.1e}")),
        std::cmp::Ordering::Greater => None,
    }
}

/// Which gain is best where, and what post-stabilization leaves on the same steps.
fn gain(verdict: &GainVerdict) -> String {
    let GainVerdict { method, quantity, steps, steady } = verdict;
    let what = format!("{method}, {} drift", quantity.name());
    let best: Vec<(f64, Best)> = steps.iter().map_while(|step| Some((step.step, step.best?))).collect();
    let (Some((fine, at_fine)), Some((coarse, at_coarse))) = (best.first(), best.last()) else {
        return format!("{what}: Baumgarte completes with no gain. {}", holds(steps));
    };
    let left = span(best.iter().map(|(_, best)| best.value)).unwrap_or_default();
    let [at_coarse, coarse, at_fine, fine] = [at_coarse.gain, *coarse, at_fine.gain, *fine].map(short);
    let even = match steady {
        Some(steady) if steady.ratio < EVEN => {
            format!("{} 1/s is within a factor of {} of the best at all of them", short(steady.gain), two(steady.ratio))
        }
        Some(steady) => format!(
            "no gain is good at all of them: the most even, {} 1/s, leaves {} times the best at one of them",
            short(steady.gain),
            two(steady.ratio)
        ),
        None => "no gain completes at all of them".to_string(),
    };
    format!(
        "{what}: Baumgarte's best gain goes from {at_coarse} 1/s at h = {coarse} to {at_fine} at h = {fine} and leaves {left}; \
         {even}; {}. {}",
        beside(steps),
        holds(steps)
    )
}

/// A gain that leaves so many times the best is not good.
const EVEN: f64 = 10.0;

type Level = fn(&StepVerdict) -> Option<f64>;

/// What the methods without gains leave.
fn beside(steps: &[StepVerdict]) -> String {
    let methods: [(&str, Level); 3] = [
        ("(2/h, 1/h²)", |step| step.own_gains),
        ("manifold", |step| step.manifold),
        ("manifold twice", |step| step.manifold_twice),
    ];
    let left = methods.map(|(name, value)| {
        let left = span(steps.iter().filter_map(value));
        left.map_or(format!("{name} completes nowhere"), |left| format!("{name} leaves {left}"))
    });
    left.join(", ")
}

/// Up to which step runs complete.
fn holds(steps: &[StepVerdict]) -> String {
    let until = |value: Level| {
        let held = steps.iter().take_while(|step| value(step).is_some()).last();
        held.map_or("at none of the steps".to_string(), |step| format!("until h = {}", short(step.step)))
    };
    format!("manifold holds {}, the integrator alone {}.", until(|step| step.manifold), until(|step| step.none))
}

/// How many cells completed, what they left, and where and why the others did not.
fn general(stressed: &Stressed, verdict: &Verdict) -> String {
    let Verdict { method, cells, completed, others, range, bounds, reasons } = verdict;
    let name = if method.is_empty() { String::new() } else { format!("{method}: ") };
    let mut text = format!("{name}{completed} of {cells} cells completed");
    if let Some([low, high]) = range {
        text += &format!(", {} {low:.1e} to {high:.1e}", stressed.map.quantity.label());
    }
    let counts: Vec<String> = others.iter().map(|(status, count)| format!("{count} {}", status.word())).collect();
    if !counts.is_empty() {
        text += &format!("; {}", counts.join(", "));
    }
    if !bounds.is_empty() {
        let all: Vec<String> = bounds.iter().map(|bound| place(stressed, bound)).collect();
        text += &format!("; what ends badly does so {}", all.join(" and "));
    }
    let worst =
        reasons.iter().find(|reason| matches!(reason.status, Status::Failed | Status::Refused | Status::Diverged));
    match worst {
        Some(reason) => text + &because(stressed, reason),
        None => text + ".",
    }
}

fn place(stressed: &Stressed, bound: &Bound) -> String {
    let axis = if stressed.map.x.name == bound.axis { &stressed.map.x } else { &stressed.map.y };
    let value = with_unit(axis, &short(bound.value));
    let axis = bound.axis.replace('_', " ");
    match bound.side {
        Side::From => format!("from {axis} {value} on"),
        Side::UpTo => format!("up to {axis} {value}"),
    }
}

fn with_unit(axis: &Axis, value: &str) -> String {
    if axis.unit.is_empty() { value.to_string() } else { format!("{value} {}", axis.unit) }
}

fn because(stressed: &Stressed, reason: &Reason) -> String {
    let (x, y) = (&stressed.map.x, &stressed.map.y);
    let at = [(x, &reason.x), (y, &reason.y)].map(|(axis, label)| format!("{} {}", axis.name, with_unit(axis, label)));
    format!(". {} of them say, as at {}: {}.", reason.count, at.join(", "), reason.reason)
}

/// What each step leaves, by gain and by projection.
pub fn gain_table(verdict: &GainVerdict) -> Table {
    let mut table =
        Table::new(&["h (s)", "none", "best gain (1/s)", "leaves", "(2/h, 1/h²)", "manifold", "manifold × 2"]);
    let cell = |value: Option<f64>| value.map_or("-".to_string(), |value| format!("{value:.2e}"));
    for step in &verdict.steps {
        let best = step.best.map_or("-".to_string(), |best| short(best.gain));
        let left = [step.best.map(|best| best.value), step.own_gains, step.manifold, step.manifold_twice].map(cell);
        table.row([short(step.step), cell(step.none), best].into_iter().chain(left));
    }
    table
}
