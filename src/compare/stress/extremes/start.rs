//! Start states that are not consistent.

use super::super::extreme::{Extreme, decades};
use super::super::subject::Subject;

pub const BOTH: Extreme = Extreme {
    name: "start_error",
    about: "error of positions, in sizes of the scene, and of velocities, in these over the period",
    apply: |case, error| {
        case.start_error = [error; 2];
        Ok(())
    },
    ..POSITION
};

pub const POSITION: Extreme = Extreme {
    name: "position_error",
    unit: "",
    about: "error of the positions of the start, in sizes of the scene",
    keeps_motion: false,
    suits: is_constrained,
    values: |_| decades(-14, 0, 2),
    apply: |case, error| {
        case.start_error[0] = error;
        Ok(())
    },
};

pub const VELOCITY: Extreme = Extreme {
    name: "velocity_error",
    about: "error of the velocities of the start, in sizes of the scene over the period",
    apply: |case, error| {
        case.start_error[1] = error;
        Ok(())
    },
    ..POSITION
};

fn is_constrained(subject: &Subject) -> bool {
    subject.dimensions.lambda > 0
}
