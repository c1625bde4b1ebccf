//! The modes of the start, and those that a simpler model has lost.

use crate::error::{Error, Result, Warning, percent, significant};
use crate::linearize::{Fate, LinearModel, Request, State, against, frequency, linearize};
use crate::method_spec::MethodSpec;
use crate::prepared::PreparedScene;

/// Velocities of the largest scene of which all modes are computed, with some 40 matrices of that size.
const MOST: usize = 300;
/// A lost mode is told where an output sees more of it, of what it sees of others with the same energy.
const SEEN: f64 = 0.1;
/// Number of modes that are told.
const TOLD: usize = 3;

/// The linear model of the start.
///
/// # Errors
/// A scene with more than 300 velocities; a start without a linear model.
pub fn at_start(prepared: &PreparedScene) -> Result<LinearModel> {
    let velocities = prepared.system().dimensions().v;
    if velocities > MOST {
        return Err(Error::input(format!("it has {velocities} velocities; of up to {MOST} all modes are computed")));
    }
    let mut variation = State::start(prepared).variation(prepared)?;
    linearize(&mut variation, &Request { method: MethodSpec::named("mcs"), chart: None })
}

/// A warning where outputs see modes of the start that the simpler model has not: a motion that excites them is another
/// one than that of the promise.
pub fn lost(richest: &PreparedScene, simpler: &PreparedScene) -> Option<Warning> {
    let time = richest.span().map_or(1.0, |span| span.end - span.start);
    let found = match at_start(richest).and_then(|own| Ok((own, at_start(simpler)?))) {
        Ok((own, other)) => against(&own, &other, time),
        Err(error) => {
            let text = format!("whether modes are lost is not known: {error}");
            return Some(Warning::new(text, "compare by `holonom linearize --modes N --against`"));
        }
    };
    let lost: Vec<&Fate> = found.modes.iter().filter(|mode| mode.there.is_none() && mode.seen > SEEN).collect();
    let tell = |mode: &&Fate| format!("{} Hz ({})", significant(frequency(mode.value), 4), percent(mode.seen));
    let told: Vec<String> = lost.iter().take(TOLD).map(tell).collect();
    let more = if lost.len() > TOLD { format!(" and {} more", lost.len() - TOLD) } else { String::new() };
    (!lost.is_empty()).then(|| {
        Warning::new(
            format!(
                "the simpler model has lost modes of the start that outputs see, of others with the same energy being 100 %: {}{more}",
                told.join(", ")
            ),
            "a motion that excites them is not that of the promise; `holonom linearize --against` compares all modes",
        )
    })
}
