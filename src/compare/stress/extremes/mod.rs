//! One file an extreme.

mod damping;
mod gain;
mod link_ratio;
mod links;
mod mass_ratio;
mod speed;
mod start;
mod step;
mod stiffness;
mod time;
mod tolerance;

use super::extreme::Extreme;

/// Every extreme, in the order of the documentation.
pub fn registry() -> &'static [&'static Extreme] {
    &[
        &step::EXTREME,
        &gain::EXTREME,
        &tolerance::EXTREME,
        &mass_ratio::EXTREME,
        &stiffness::EXTREME,
        &damping::EXTREME,
        &speed::EXTREME,
        &link_ratio::EXTREME,
        &links::EXTREME,
        &time::EXTREME,
        &start::BOTH,
        &start::POSITION,
        &start::VELOCITY,
    ]
}
