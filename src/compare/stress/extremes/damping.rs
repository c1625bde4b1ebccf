//! Weak and strong dampers.

use super::super::extreme::{Extreme, decades};
use super::super::json::has;
use super::stiffness::set;
use std::sync::Arc;

pub const EXTREME: Extreme = Extreme {
    name: "damping",
    unit: "N s/m",
    about: "damping of all springs (N s/m, N m s/rad), bushings and tyres",
    keeps_motion: false,
    suits: |subject| has(&subject.base.scene, "forces", &["damping"]),
    values: |_| decades(-2, 12, 2),
    apply: |case, value| set(Arc::make_mut(&mut case.scene), "damping", value),
};
