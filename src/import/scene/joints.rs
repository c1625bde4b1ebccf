//! The joints of a scene, with their springs, dampers, rotors and motors.

use super::{Draft, aimed, whole};
use crate::error::Result;
use crate::import::names::UniqueNames;
use crate::import::robot::{Coupling, Joint, JointType, Motor};
use crate::import::transform::{Transform, about};
use serde_json::{Value, json};
use std::f64::consts::PI;

impl Draft<'_> {
    pub fn joint(&mut self, index: usize, names: &mut UniqueNames) -> Result<()> {
        let joint = &self.robot.joints[index];
        let kind = match joint.kind {
            JointType::Fixed | JointType::Floating => {
                self.joints.between.push(Default::default());
                return Ok(());
            }
            JointType::Revolute => "revolute",
            JointType::Prismatic => "prismatic",
            JointType::Planar => "planar",
            JointType::Spherical => "spherical",
        };
        let name = self.joints.names[index].clone();
        let between = self.mark_joint(joint, &name)?;
        self.scene.joints.push(json!({ "name": name, "type": kind, "between": between }));
        match joint.kind {
            JointType::Spherical => self.damp_ball(joint, &name, &between[0], &between[1]),
            JointType::Planar => {}
            _ => self.coordinate(index, &name, &between, names),
        }
        self.joints.between.push(between);
        Ok(())
    }

    /// Markers of a joint in its parent and its child; in the file's position the coordinate between them is that of
    /// the file.
    fn mark_joint(&mut self, joint: &Joint, name: &str) -> Result<[String; 2]> {
        let axes = match joint.kind {
            JointType::Spherical => Transform::default(),
            _ => aimed(joint.axis).map_err(|error| self.robot.blame(error, &joint.name, joint.at))?,
        };
        let of_child = Transform { r: joint.anchor, ..axes };
        let mut of_parent = joint.origin.then(&of_child);
        if joint.reference != 0.0 {
            of_parent = of_parent.then(&back(joint));
        }
        Ok([self.mark(joint.parent, &of_parent, name), self.mark(joint.child, &of_child, name)])
    }

    /// The output and the start of the coordinate, and what acts along it.
    fn coordinate(&mut self, index: usize, name: &str, between: &[String; 2], names: &mut UniqueNames) {
        let [from, to] = between;
        let joint = &self.robot.joints[index];
        let mut output = json!({ "name": name, "measure": "angle", "of": to, "relative_to": from });
        let coordinate = if joint.kind == JointType::Revolute { "angle" } else { "position" };
        if joint.kind == JointType::Prismatic {
            (output["measure"], output["component"]) = (json!("position"), json!("z"));
        }
        let force = if joint.kind == JointType::Revolute { hinge_force } else { slider_force };
        self.scene.forces.extend(force(joint, name, [from, to]));
        self.scene.outputs.push(output);
        if !self.joints.follows[index] {
            self.scene.initial.insert(format!("{name}.{coordinate}"), whole(self.tree.positions[index]));
        }
        if joint.armature != 0.0 {
            self.rotor(index, name, names);
        }
    }

    /// Adds a wheel that turns with the coordinate q of a joint, about an axis of the ground: its energy J q'^2/2 is that
    /// of the joint's own inertia J, and it has no weight and no gyroscopic torque.
    fn rotor(&mut self, index: usize, name: &str, names: &mut UniqueNames) {
        let rotor = names.unique(&format!("{name}_rotor"));
        let inertia = self.robot.joints[index].armature;
        let position = self.tree.positions[index];
        self.scene
            .bodies
            .push(json!({ "name": rotor, "type": "rigid", "mass": 0, "inertia": inertia, "free": ["rz"] }));
        self.scene.outputs.push(json!({ "name": rotor, "measure": "angle", "of": rotor }));
        self.scene.joints.push(json!({ "name": rotor, "type": "equation",
            "expression": format!("{rotor} - ({name} - ({position}))") }));
    }

    /// Torque c w on the child of a ball joint, w being the angular velocity of the parent against it, in its axes.
    fn damp_ball(&mut self, joint: &Joint, name: &str, from: &str, to: &str) {
        if joint.damping == 0.0 {
            return;
        }
        let mut torque = Vec::new();
        for axis in ["x", "y", "z"] {
            let rate = format!("{name}_w{axis}");
            self.scene.outputs.push(json!({ "name": rate, "measure": "angular_velocity", "of": from,
                "relative_to": to, "component": axis }));
            torque.push(format!("({})*{rate}", joint.damping));
        }
        self.scene.forces.push(json!({ "name": name, "type": "applied_torque", "at": to, "axes": "marker",
            "torque": torque, "reaction_on": from }));
    }

    /// Adds the equation of a joint whose coordinate follows that of another.
    pub fn coupling(&mut self, coupling: &Coupling, names: &mut UniqueNames) {
        let of = |joint: usize| {
            let reference = self.robot.joints[joint].reference;
            let name = &self.joints.names[joint];
            if reference == 0.0 { name.clone() } else { format!("({name} - ({reference}))") }
        };
        let follower = of(coupling.follower);
        let mut expression = follower;
        for (power, coefficient) in coupling.coefficients.iter().enumerate() {
            let factor = match (power, coupling.leader) {
                (0, _) => String::new(),
                (_, None) => continue,
                (1, Some(leader)) => format!("*{}", of(leader)),
                (_, Some(leader)) => format!("*{}^{power}", of(leader)),
            };
            if power < 2 || *coefficient != 0.0 {
                expression += &format!(" - ({coefficient}){factor}");
            }
        }
        let name = coupling.name.clone();
        let name = name.unwrap_or_else(|| format!("{}_mimic", self.joints.names[coupling.follower]));
        self.scene.joints.push(json!({ "name": names.unique(&name), "type": "equation", "expression": expression }));
    }

    /// Adds an input that is the force or torque of a motor along the coordinate of a joint.
    pub fn motor(&mut self, motor: &Motor, names: &mut UniqueNames) {
        let name = names.unique(&motor.name);
        let [from, to] = &self.joints.between[motor.joint];
        let (kind, key) = match self.robot.joints[motor.joint].kind {
            JointType::Revolute => ("applied_torque", "torque"),
            _ => ("applied_force", "force"),
        };
        self.scene.forces.push(json!({ "name": name, "type": kind, "at": to, "axes": "marker", key: [0, 0, 0],
            "reaction_on": from }));
        self.scene.inputs.push(json!({ "name": name, "force": name, "component": "z" }));
    }
}

/// From position zero of a joint to that of the file, in the axes of its marker.
fn back(joint: &Joint) -> Transform {
    match joint.kind {
        JointType::Revolute => Transform { r: [0.0; 3], turn: about(2, -joint.reference) },
        _ => Transform { r: [0.0, 0.0, -joint.reference], ..Transform::default() },
    }
}

fn hinge_force(joint: &Joint, name: &str, between: [&str; 2]) -> Option<Value> {
    let Joint { stiffness, damping, relaxed, reference, .. } = joint;
    if *stiffness == 0.0 && *damping == 0.0 {
        return None;
    }
    let mut force = json!({ "name": name, "type": "torsion_spring", "between": between });
    // The scene's own spring counts its angle from within half a turn of the relaxed one, and feeds no energy.
    let is_usual = *stiffness >= 0.0 && *damping >= 0.0;
    if !is_usual || (*stiffness != 0.0 && (relaxed - reference).abs() > PI) {
        let law = format!("({stiffness})*(angle - ({relaxed})) + ({damping})*rate");
        force["law"] = json!(law);
        force["free_angle"] = json!(reference);
        return Some(force);
    }
    let given = [
        ("damping", *damping),
        ("stiffness", *stiffness),
        ("free_angle", if *stiffness == 0.0 { 0.0 } else { *relaxed }),
    ];
    given.into_iter().filter(|(_, value)| *value != 0.0).for_each(|(key, value)| force[key] = json!(value));
    Some(force)
}

fn slider_force(joint: &Joint, name: &str, between: [&str; 2]) -> Option<Value> {
    let [from, to] = between;
    let Joint { stiffness, damping, relaxed, .. } = joint;
    let spring = (*stiffness != 0.0).then(|| format!("-({stiffness})*({name} - ({relaxed}))"));
    let damper = (*damping != 0.0).then(|| format!("-({damping})*{name}'"));
    let along = [spring, damper].into_iter().flatten().collect::<Vec<_>>().join(" ");
    (!along.is_empty()).then(|| {
        json!({ "name": name, "type": "applied_force", "at": to, "axes": "marker", "force": [0, 0, along],
            "reaction_on": from })
    })
}
