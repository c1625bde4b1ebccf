//! The modes of the start, and those that a simpler model has lost.

use crate::error::{Error, Result, Warning, percent, significant};
use crate::linearize::{Complex, Fate, Linear, LinearModel, State, against, damping, frequency};
use crate::method_spec::MethodSpec;
use crate::prepared::Model;
use crate::tolerances::UNSEEN;

/// Velocities of the largest scene of which all modes are computed, with some 40 matrices of that size.
const MOST: usize = 300;
/// A lost mode is told where an output sees more of it, of what it sees of others with the same energy.
const SEEN: f64 = 0.1;
/// Number of modes that are told.
const TOLD: usize = 3;
/// A mode has lost its damping where it keeps a smaller part of its decay rate, if its damping ratio was above `DAMPED`.
const KEPT: f64 = 0.5;
const DAMPED: f64 = 0.01;
/// Relative difference of eigenvalues of which one is the image of the other; damping keeps them from being it exactly.
const OPPOSITE: f64 = 0.1;

/// The linear model of the start.
///
/// # Errors
/// A scene with more than 300 velocities; a start without a linear model.
pub fn at_start(prepared: &Model) -> Result<LinearModel> {
    let velocities = prepared.system().dimensions().v;
    if velocities > MOST {
        return Err(Error::input(format!("it has {velocities} velocities; of up to {MOST} all modes are computed")));
    }
    let mut variation = State::start(prepared).variation(prepared)?;
    variation.linearize(&Linear { method: MethodSpec::named("mcs"), chart: None })
}

/// Warnings where outputs see modes of the start, or damping of these, that the simpler model has not: a motion that
/// excites them is another one than that of the promise.
pub fn lost(richest: &Model, simpler: &Model) -> Vec<Warning> {
    let time = richest.span().map_or(1.0, |span| span.end - span.start);
    let (found, is_at_rest) = match at_start(richest).and_then(|own| Ok((own, at_start(simpler)?))) {
        Ok((own, other)) => (against(&own, &other, time), own.point.is_equilibrium && other.point.is_equilibrium),
        Err(error) => {
            let text = format!("whether modes are lost is not known: {error:#}");
            return vec![Warning::new(text, "compare by `holonom linearize --modes N --against`")];
        }
    };
    let is_undamped = |mode: &Fate| {
        let decay = |value: Complex<f64>| 0.0 - value.re;
        damping(mode.value) > DAMPED && mode.there.is_some_and(|there| decay(there) < KEPT * decay(mode.value))
    };
    // Off equilibrium eigenvalues do not tell what grows. Values are without rounding.
    let grows = |value: Complex<f64>| is_at_rest && value.re > 0.0;
    // What grows is seen in the end, however little of it outputs see at first.
    let is_told = |mode: &&Fate| mode.seen > SEEN || grows(mode.value) && mode.seen > UNSEEN;
    let seen = || found.modes.iter().filter(is_told);
    // Of a mode that grows and its image that decays as fast, as of what stands upright, the first is told.
    let is_image = |mode: &Fate| mode.value.re < 0.0 && seen().any(|other| is_opposite(other.value, mode.value));
    let lost: Vec<&Fate> = seen().filter(|mode| mode.there.is_none() && !is_image(mode)).collect();
    let is_turned = |mode: &&Fate| mode.there.is_some_and(|there| grows(there) != grows(mode.value));
    let turned: Vec<&Fate> = seen().filter(is_turned).collect();
    let undamped: Vec<&Fate> = seen().filter(|mode| is_undamped(mode) && !is_turned(mode)).collect();
    let word = if is_at_rest { ", unstable" } else { ", growing at the start" };
    let share = |mode: &Fate| percent(mode.seen) + if mode.value.re > 0.0 { word } else { "" };
    let other = |mode: &Fate| if grows(mode.value) { "no longer unstable" } else { "unstable now" }.to_string();
    let damped = |mode: &Fate| {
        let own = Some(mode.value).map_or(0.0, damping);
        let there = mode.there.map_or(0.0, damping);
        format!("damping ratio {} is {}", significant(own, 2), significant(there, 2))
    };
    [
        warning("the simpler model has lost modes of the start", &lost, share),
        warning("the simpler model differs in the stability of modes of the start", &turned, other),
        warning("the simpler model has lost damping of modes of the start", &undamped, damped),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// True if one is minus the other, both real.
fn is_opposite(one: Complex<f64>, other: Complex<f64>) -> bool {
    one.im == 0.0 && other.im == 0.0 && (one.re + other.re).abs() <= OPPOSITE * one.re.abs()
}

/// A warning about these modes, with a remark on each; none where there is none.
fn warning(what: &str, modes: &[&Fate], remark: impl Fn(&Fate) -> String) -> Option<Warning> {
    let tell = |mode: &&Fate| format!("{} Hz ({})", significant(frequency(mode.value), 4), remark(mode));
    let told: Vec<String> = modes.iter().take(TOLD).map(tell).collect();
    let more = if modes.len() > TOLD { format!(" and {} more", modes.len() - TOLD) } else { String::new() };
    (!modes.is_empty()).then(|| {
        Warning::new(
            format!("{what} that outputs see, of others with the same energy being 100 %: {}{more}", told.join(", ")),
            "a motion that excites them is not that of the promise; `holonom linearize --against` compares all modes",
        )
    })
}
