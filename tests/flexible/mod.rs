//! Flexible beams in whole scenes: published motions, closed forms, both kinds against each other, energy, outputs, and
//! what is refused.

mod agreement;
mod assembly;
mod beams;
mod couplings;
mod curved;
mod energy;
mod inextensible;
mod outputs;
mod refusals;
mod rigid;
mod rotating;
mod slider_crank;
mod spin_up;
mod tapered;

/// Numbers with three digits.
fn brief(numbers: &[f64]) -> String {
    numbers.iter().map(|x| format!("{x:.2e}")).collect::<Vec<_>>().join(", ")
}
