//! Positions of joints, as the command line gives them.

use super::robot::Robot;
use crate::error::{Error, Result};
use crate::math::expression::constant;
use std::collections::HashMap;
use std::str::FromStr;

/// The position of a joint: `JOINT=VALUE`, rad or m.
#[derive(Clone, Debug, PartialEq)]
pub struct Given {
    /// Name of the joint in the file.
    pub joint: String,
    /// Its angle, rad, or its displacement, m.
    pub value: f64,
}

impl FromStr for Given {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let form = "write JOINT=VALUE, in rad or m, such as knee=0.5 or hip=-pi/6";
        let faulty = |what: String| Error::input(what).hint(form);
        let (joint, value) = text.rsplit_once('=').ok_or_else(|| faulty(format!("`{text}` has no value")))?;
        let value = constant(value).filter(|value| value.is_finite());
        let value = value.ok_or_else(|| faulty(format!("the position of `{joint}` is no number")))?;
        Ok(Given { joint: joint.to_string(), value })
    }
}

/// The position of each joint: as given, or as that of the joint that it follows, or that of the file.
pub fn positions(robot: &Robot, given: &[Given]) -> Result<Vec<f64>> {
    let known = || robot.joints.iter().map(|joint| joint.name.as_str());
    let index: HashMap<&str, usize> = known().enumerate().rev().map(|(index, name)| (name, index)).collect();
    let mut positions = vec![None; robot.joints.len()];
    for Given { joint, value } in given {
        let place = *index.get(joint.as_str()).ok_or_else(|| Error::unknown("joint", joint, known()))?;
        if !robot.joints[place].has_coordinate() {
            return Err(Error::input(format!("`{joint}` has no coordinate")).hint("joints that turn or slide have one"));
        }
        if positions[place].replace(*value).is_some() {
            return Err(Error::input(format!("`{joint}` has two positions")).hint("give one of them"));
        }
    }
    for coupling in &robot.couplings {
        let of_file = coupling.leader.map_or(0.0, |leader| robot.joints[leader].reference);
        let lead = coupling.leader.and_then(|leader| positions[leader]).unwrap_or(of_file);
        positions[coupling.follower].get_or_insert(coupling.position(&robot.joints, lead));
    }
    let all = positions.into_iter().zip(&robot.joints);
    Ok(all.map(|(position, joint)| position.unwrap_or(joint.reference)).collect())
}
