//! Verdicts in sentences.

use crate::error::{short, two_digits};
use crate::math::bounds;
use crate::report::TextTable;
use crate::study::stress::{
    AxisSide, Best, Bound, GainRun, GainVerdict, MapAxis, MethodVerdict, Reason, Status, StepVerdict, Stressed,
};
use crate::tolerances::WRONG_MOTION;

/// Returns the verdict on a map: a sentence or two for each method.
pub fn sentences(stressed: &Stressed) -> Vec<String> {
    let gains = stressed.gains();
    let mut all: Vec<String> = if gains.is_empty() {
        stressed.verdicts().iter().map(|verdict| general(stressed, verdict)).collect()
    } else {
        gains.iter().map(gain).collect()
    };
    if stressed.is_empty() {
        all.push(format!("No cell has a value of {}: there is no figure.", stressed.map.quantity.label()));
    }
    all
}

fn span(values: impl Iterator<Item = f64>) -> Option<String> {
    let (low, high) = bounds(values);
    match low.total_cmp(&high) {
        std::cmp::Ordering::Less => Some(format!("{} to {}", two_digits(low), two_digits(high))),
        std::cmp::Ordering::Equal => Some(two_digits(low)),
        std::cmp::Ordering::Greater => None,
    }
}

/// Returns the best gains, their errors, and the drift with post-stabilization on the same steps.
fn gain(verdict: &GainVerdict) -> String {
    let GainVerdict { method, quantity, steps, left_out, too_slow, .. } = verdict;
    let held = [("manifold", (|step| &step.manifold) as LevelOf), ("the integrator alone", |step| &step.none)];
    let held = held.map(|(name, level)| holds(name, steps, level)).join("; ");
    let unknown: Vec<String> = [(*left_out, Status::LeftOut), (*too_slow, Status::TooSlow)]
        .into_iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, status)| format!("{count} {}", status.word()))
        .collect();
    let unknown = if unknown.is_empty() { String::new() } else { format!(" Not known: {}.", unknown.join(", ")) };
    format!(
        "{method}, {} drift: {}. Within {} % in outputs and energy, {held}.{unknown}",
        quantity.name(),
        best(verdict),
        100.0 * WRONG_MOTION
    )
}

/// Returns the result of Baumgarte's gains, and of the methods without gains.
fn best(verdict: &GainVerdict) -> String {
    let GainVerdict { steps, left_out, too_slow, .. } = verdict;
    let is_whole = left_out + too_slow == 0;
    let best: Vec<(f64, Best)> = steps.iter().filter_map(|step| Some((step.step, step.best?))).collect();
    let (Some((fine, at_fine)), Some((coarse, at_coarse))) = (best.first(), best.last()) else {
        let ended: usize = steps.iter().map(|step| step.gains_ended).sum();
        let none = match (ended, is_whole) {
            (0, _) => "no gain was run to an end".to_string(),
            (_, true) => "Baumgarte completes with no gain".to_string(),
            (ended, false) => {
                format!("Baumgarte completes with none of the {ended} gains and steps that came to an end")
            }
        };
        return format!("{none}; {}", beside(steps));
    };
    let left = span(best.iter().map(|(_, best)| best.value)).unwrap_or_default();
    let error = span(best.iter().filter_map(|(_, best)| best.error));
    let error = error.map_or(String::new(), |error| format!(" with an error of {error}"));
    let at_coarse = short(at_coarse.gain);
    let coarse = short(*coarse);
    let at_fine = short(at_fine.gain);
    let fine = short(*fine);
    let farther = verdict.farther.as_ref().map_or(String::new(), |farther| {
        let step = short(farther.step);
        let gain = short(farther.gain);
        let ratio = two_digits(farther.ratio);
        let output = &farther.output;
        format!(
            "; at h = {step} the gain that drifts least, {gain} 1/s, is {ratio} times as far off as none in {output}"
        )
    });
    format!(
        "Baumgarte's best gain goes from {at_coarse} 1/s at h = {coarse} to {at_fine} at h = {fine} and leaves \
         {left}{error}; {}{farther}. On the same steps {}",
        even(verdict, is_whole),
        beside(steps)
    )
}

/// A gain whose drift exceeds the best by this factor is not good.
const EVEN: f64 = 10.0;

/// Returns a sentence on one gain for all steps.
fn even(verdict: &GainVerdict, is_whole: bool) -> String {
    match verdict.steady {
        Some(steady) if steady.ratio < EVEN => {
            format!(
                "{} 1/s is within a factor of {} of the best at all of them",
                short(steady.gain),
                two_digits(steady.ratio)
            )
        }
        Some(steady) => format!(
            "no gain is good at all of them: the most even, {} 1/s, leaves {} times the best at one of them",
            short(steady.gain),
            two_digits(steady.ratio)
        ),
        None if is_whole => "no gain completes at all of them".to_string(),
        None => "no gain is known to complete at all of them".to_string(),
    }
}

type LevelOf = fn(&StepVerdict) -> &GainRun;

/// Returns the drift of the methods without gains.
fn beside(steps: &[StepVerdict]) -> String {
    let methods: [(&str, LevelOf); 3] = [
        ("(2/h, 1/h²)", |step| &step.own_gains),
        ("manifold", |step| &step.manifold),
        ("manifold twice", |step| &step.manifold_twice),
    ];
    let left = methods.map(|(name, level)| {
        let left = span(steps.iter().filter_map(|step| level(step).drift));
        let ended = steps.iter().filter(|step| level(step).status.is_ended()).count();
        match (left, ended) {
            (Some(left), _) => format!("{name} leaves {left}"),
            (None, 0) => format!("{name} was not run to an end"),
            (None, ended) if ended == steps.len() => format!("{name} completes nowhere"),
            (None, ended) => format!("{name} completes at none of the {ended} steps that came to an end"),
        }
    });
    left.join(", ")
}

/// Returns the largest step up to which a method is right, its error there, and the reason of the failure beyond.
fn holds(name: &str, steps: &[StepVerdict], level: LevelOf) -> String {
    let ended: Vec<(f64, &GainRun)> =
        steps.iter().map(|step| (step.step, level(step))).filter(|(_, level)| level.status.is_ended()).collect();
    let held = ended.iter().take_while(|(_, level)| level.holds == Some(true)).count();
    let until = match ended.get(..held) {
        _ if ended.is_empty() => "was not run to an end".to_string(),
        Some([.., (step, _)]) => {
            let error = ended[..held].iter().filter_map(|(_, level)| level.error).fold(0.0, f64::max);
            format!("holds until h = {} (error {})", short(*step), percent(error))
        }
        _ => format!("holds at none of the {} steps that came to an end", ended.len()),
    };
    let then = ended.get(held).map_or(String::new(), |(step, level)| format!(", at {} {}", short(*step), what(level)));
    format!("{name} {until}{then}")
}

fn percent(part: f64) -> String {
    format!("{} %", two_digits(100.0 * part))
}

/// Returns the defect of a simulation outside the tolerance.
fn what(level: &GainRun) -> String {
    match (level.status, level.error, level.energy) {
        (Status::Completed, Some(error), _) if error > WRONG_MOTION => {
            format!("it completes with outputs {} off", percent(error))
        }
        (Status::Completed, _, Some(energy)) if energy > WRONG_MOTION => {
            format!("it completes with energy {} off", percent(energy))
        }
        (Status::Completed, ..) => "it completes, with an error that is not known".to_string(),
        (Status::Refused, ..) => "it is refused".to_string(),
        (status, ..) => format!("it has {}", status.word()),
    }
}

/// Returns the number of completed cells, their range, and the place and reason of the others.
fn general(stressed: &Stressed, verdict: &MethodVerdict) -> String {
    let MethodVerdict { method, cells, completed, others, range, bounds, reasons, .. } = verdict;
    let name = if method.is_empty() { String::new() } else { format!("{method}: ") };
    if others == &[(Status::LeftOut, *cells)] {
        return format!("{name}nothing is known: the budget left out all {cells} cells.");
    }
    let mut text = format!("{name}{completed} of {cells} cells completed");
    if let Some([low, high]) = range {
        text += &format!(", {} {} to {}", stressed.map.quantity.label(), two_digits(*low), two_digits(*high));
    }
    text += &judged(verdict);
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

/// Returns the errors of the completed cells.
fn judged(verdict: &MethodVerdict) -> String {
    let MethodVerdict { completed, held, off, errors, .. } = verdict;
    let Some([low, high]) = errors else {
        return if *completed > 0 { "; how far off they are is not known".to_string() } else { String::new() };
    };
    let unknown = completed - held - off;
    let unknown = if unknown > 0 { format!(", {unknown} not known") } else { String::new() };
    let percent = 100.0 * WRONG_MOTION;
    format!(
        "; {held} of them within {percent} % in outputs and energy, {off} not{unknown}, error {} to {}",
        two_digits(*low),
        two_digits(*high)
    )
}

fn place(stressed: &Stressed, bound: &Bound) -> String {
    let axis = if stressed.map.x.name == bound.axis { &stressed.map.x } else { &stressed.map.y };
    let value = with_unit(axis, &short(bound.value));
    let axis = bound.axis.replace('_', " ");
    match bound.side {
        AxisSide::From => format!("from {axis} {value} on"),
        AxisSide::UpTo => format!("up to {axis} {value}"),
    }
}

fn with_unit(axis: &MapAxis, value: &str) -> String {
    if axis.unit.is_empty() { value.to_string() } else { format!("{value} {}", axis.unit) }
}

fn because(stressed: &Stressed, reason: &Reason) -> String {
    let x = &stressed.map.x;
    let y = &stressed.map.y;
    let place = |axis: &MapAxis, label: &str| format!("{} {}", axis.name, with_unit(axis, label));
    let at_x = place(x, &reason.x);
    let at_y = place(y, &reason.y);
    format!(". {} of them say, as at {at_x}, {at_y}: {}.", reason.count, reason.reason)
}

/// Returns the drift at each step, by gain and by projection.
pub fn gain_table(verdict: &GainVerdict) -> TextTable {
    let headings =
        ["h (s)", "none", "best gain (1/s)", "leaves", "error", "(2/h, 1/h²)", "manifold", "error", "manifold × 2"];
    let mut table = TextTable::new(&headings);
    for step in &verdict.steps {
        let (gain, value, error) = match &step.best {
            Some(best) => (short(best.gain), number(best.value), best.error.map_or("-".to_string(), number)),
            None if step.gains_left_out > 0 => ["left out", "-", "-"].map(String::from).into(),
            None => ["none", "-", "-"].map(String::from).into(),
        };
        let none = shown(&step.none);
        let own = shown(&step.own_gains);
        let once = shown(&step.manifold);
        let twice = shown(&step.manifold_twice);
        let once_error = step.manifold.error.map_or("-".to_string(), number);
        table.row([short(step.step), none, gain, value, error, own, once, once_error, twice]);
    }
    table
}

fn number(value: f64) -> String {
    format!("{value:.2e}")
}

fn shown(level: &GainRun) -> String {
    level.drift.map_or(level.status.word().to_string(), number)
}
