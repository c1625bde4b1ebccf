//! Text on the error of a run.

use super::Table;
use crate::compare::CheckError;
use crate::error::significant;
use crate::error::{Warning, clock, short};
use crate::simulate::Method;

const UNCHECKED: &str = "errors are estimated of single steps only: --check-error measures what they add up to";
const UNCHECKED_STEP: &str = "nothing estimates the errors of fixed steps: --check-error measures them";
const PENALIZED: &str =
    "the limit is the penalty, whose error O(1/penalty) no tolerance or step takes away: compare with a larger one";

/// Returns the differences to a second run, or a note that the error is not known.
pub fn text(method: &Method, check: Option<&CheckError>) -> String {
    let found = match (check, method.step) {
        (Some(check), _) => differences(check),
        (None, Some(_)) => format!("  {UNCHECKED_STEP}\n"),
        (None, None) => format!("  {UNCHECKED}\n"),
    };
    let is_penalized = method.formulation.name == "penalty";
    format!("\n{found}{}", if is_penalized { format!("  {PENALIZED}\n") } else { String::new() })
}

fn differences(check: &CheckError) -> String {
    let mut table = Table::new(&[&format!("difference to {}", with(check)), "max", "final", ""]).words(3);
    for (name, difference) in &check.outputs {
        let [max, last] = [difference.max, difference.last].map(|value| format!("{value:.1e}"));
        table.row([name.clone(), max, last, difference.unit.clone()]);
    }
    let amplified = match &check.amplification {
        Ok(factor) => {
            format!("the motion itself amplifies small changes of its start {} times", significant(*factor, 2))
        }
        Err(cause) => format!("how much the motion itself amplifies small changes is not known: {cause}"),
    };
    let opinion = check.second_opinion.iter().map(|opinion| format!("  {opinion}\n")).collect::<String>();
    format!("{table}{opinion}  {amplified}\n")
}

fn with(check: &CheckError) -> String {
    match check.step {
        Some(step) => format!("step {} s", clock(step)),
        None => format!("rtol {}, atol {}", short(check.rtol), short(check.atol)),
    }
}

/// Returns a warning if the second run ended early.
pub fn cut_short(check: &CheckError) -> Option<Warning> {
    let failure = check.failure.as_ref()?;
    let text = format!(
        "the second run, with {}, ended at t = {} s: {}; its differences are those up to there",
        with(check),
        clock(failure.t),
        failure.reason
    );
    let hint = match failure.hint.as_str() {
        "" => "compare with another integrator or projection",
        hint => hint,
    };
    Some(Warning::new(text, hint))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Failure;

    /// What was interrupted is not helped by another method.
    #[test]
    fn the_hint_is_that_of_the_failure() {
        let hint = |hint: &str| {
            let failure = Failure { t: 1.0, reason: "interrupted".to_string(), hint: hint.to_string() };
            let amplification = Err(String::new());
            let check = CheckError {
                rtol: 1e-9,
                atol: 1e-11,
                step: None,
                outputs: Vec::new(),
                second_opinion: None,
                amplification,
                failure: Some(failure),
            };
            cut_short(&check).map(|warning| warning.hint)
        };
        assert_eq!(hint("it is in here"), Some("it is in here".to_string()));
        assert!(hint("").is_some_and(|hint| hint.starts_with("compare with")));
    }
}
