//! Text on the error of a run.

use super::TextTable;
use crate::error::significant;
use crate::error::{Warning, clock, percent, short};
use crate::simulate::Method;
use crate::study::ErrorBars;

const UNCHECKED: &str = "errors are estimated of single steps only: --check-error measures what they add up to";
const UNCHECKED_STEP: &str = "nothing estimates the errors of fixed steps: --check-error measures them";
const PENALIZED: &str =
    "no tolerance or step takes away the error O(1/penalty): take a larger penalty for a smaller one";

/// Returns the step, or the tolerances.
pub fn accuracy(Method { rtol, atol, step, .. }: &Method) -> String {
    match step {
        Some(step) => format!("step {} s", clock(*step)),
        None => format!("rtol {rtol:e}, atol {atol:e}"),
    }
}

/// Returns the error bars, or a note that the error is not known.
pub fn text(method: &Method, bars: Option<&ErrorBars>) -> String {
    let found = match (bars, method.step) {
        (Some(bars), _) => table(bars),
        (None, Some(_)) => format!("  {UNCHECKED_STEP}\n"),
        (None, None) => format!("  {UNCHECKED}\n"),
    };
    let penalized = if method.formulation.name == "penalty" { format!("  {PENALIZED}\n") } else { String::new() };
    format!("\n{found}{penalized}")
}

fn table(bars: &ErrorBars) -> String {
    let mut table = TextTable::new(&["error bar", "max", "final", ""]).words(3);
    for (name, bar) in &bars.outputs {
        table.row([name.clone(), format!("±{:.1e}", bar.max), format!("±{:.1e}", bar.last), bar.unit.clone()]);
    }
    let amplified = match &bars.amplification {
        Ok(factor) => {
            format!("the motion itself amplifies small changes of its start {} times", significant(*factor, 2))
        }
        Err(cause) => format!("how much the motion itself amplifies small changes is not known: {cause}"),
    };
    let opinion: String = bars.second_opinion.iter().map(|opinion| format!("  {opinion}\n")).collect();
    let work = percent(bars.work);
    format!("{table}  from a companion with {}, for {work} of the work\n{opinion}  {amplified}\n", of_companion(bars))
}

fn of_companion(bars: &ErrorBars) -> String {
    match bars.step {
        Some(step) => format!("step {} s", clock(step)),
        None => format!("rtol {}, atol {}", short(bars.rtol), short(bars.atol)),
    }
}

pub fn cut_short(bars: &ErrorBars) -> Option<Warning> {
    let failure = bars.failure.as_ref()?;
    let text = format!(
        "the companion of the run, with {}, ended at t = {} s: {}; error bars are those up to there",
        of_companion(bars),
        clock(failure.t),
        failure.reason
    );
    let hint = match failure.hint.as_str() {
        "" => "compare with another integrator or projection",
        hint => hint,
    };
    Some(Warning::new(text, hint))
}
