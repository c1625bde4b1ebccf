//! Actuators: motors become inputs; inertia and damping of any are those of its joint.

use super::{MjcfReader, named};
use crate::error::Result;
use crate::import::robot::Motor;
use crate::import::xml::Element;
use std::collections::HashMap;

impl<'a, 'i> MjcfReader<'a, 'i> {
    pub fn actuators(&mut self, joints: &HashMap<String, usize>) -> Result<()> {
        for (node, name) in named(self.root, "actuator") {
            let tag = node.tag_name().name();
            let Some(joint) = node.attribute("joint").or(node.attribute("jointinparent")) else {
                self.told.add(format!("actuators of the type {tag}:"), &name);
                continue;
            };
            let element = self.classes.element(node, &[tag, "general"], None)?;
            let is_motor = tag == "motor" && self.is_scalar(joint, joints);
            if is_motor || !joints.contains_key(joint) {
                let joint = self.joint_of(node, joint, joints)?;
                self.tell_motor(&element, &name)?;
                self.robot.motors.push(Motor { name, joint });
            } else {
                self.told.add(format!("actuators of the type {tag}:"), &name);
            }
            if ["motor", "general", "position"].contains(&tag) && self.is_scalar(joint, joints) {
                self.reflect(&element, joints[joint])?;
            }
        }
        Ok(())
    }

    fn is_scalar(&self, joint: &str, joints: &HashMap<String, usize>) -> bool {
        joints.get(joint).is_some_and(|joint| self.robot.joints[*joint].has_coordinate())
    }

    /// Inertia and damping of an actuator at the joint behind its gear: both times the square of the ratio.
    fn reflect(&mut self, element: &Element, joint: usize) -> Result<()> {
        let ratio = element.first_or("gear", 1.0)?;
        let armature = element.first_or("armature", 0.0)?;
        let damping = element.first_or("damping", 0.0)?;
        self.robot.joints[joint].armature += ratio * ratio * armature;
        self.robot.joints[joint].damping += ratio * ratio * damping;
        Ok(())
    }

    fn tell_motor(&mut self, element: &Element, name: &str) -> Result<()> {
        let gear = element.first_or("gear", 1.0)?;
        self.told.add_if(gear != 1.0, "gear of the motors, whose inputs are gear times the control in N m or N:", name);
        let is_bounded = element.has("ctrlrange")? || element.has("forcerange")?;
        self.told.add_if(is_bounded, "bounds of the motors", name);
        Ok(())
    }
}
