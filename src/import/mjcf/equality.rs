//! Equalities: constraints that close loops and couple joints.

use super::Reader;
use super::element::Element;
use crate::error::{Error, Result, suggest};
use crate::import::robot::{Coupling, Loop};
use crate::import::transform::Transform;
use crate::import::xml::{all, attribute, faulty, place};
use crate::math::array::Each;
use roxmltree::Node;
use std::collections::HashMap;

impl<'a, 'i> Reader<'a, 'i> {
    pub fn equalities(&mut self, joints: &HashMap<String, usize>) -> Result<()> {
        let nodes = all(self.root, "equality").flat_map(|section| section.children()).filter(Node::is_element);
        for (number, node) in nodes.enumerate() {
            let tag = node.tag_name().name();
            let name = node.attribute("name").map_or_else(|| format!("{tag}_{}", number + 1), str::to_string);
            let element = self.classes.element(node, &["equality"], None)?;
            if element.is("active", "false") {
                self.told.add("equalities that are not active:", &name);
                continue;
            }
            match tag {
                "connect" => self.connect(&element, &name)?,
                "weld" => self.weld(&element, &name)?,
                "joint" => self.couple(node, &name, joints)?,
                _ => {
                    self.told.add(format!("equalities of the type {tag}:"), &name);
                    continue;
                }
            }
            self.told.add("softness of the equalities, which are exact constraints here:", &name);
        }
        Ok(())
    }

    /// A point of two bodies, or the origins of two sites.
    fn connect(&mut self, element: &Element, name: &str) -> Result<()> {
        if let Some(closed) = self.between_sites(element.node, name, "spherical")? {
            self.robot.loops.push(closed);
            return Ok(());
        }
        let anchor = element.numbers("anchor")?.ok_or_else(|| faulty(element.node, "<connect> has no `anchor`"))?;
        let frames = [Some(Transform { r: anchor, ..Transform::default() }), None];
        let links = self.two_bodies(element.node)?;
        self.robot.loops.push(Loop { name: name.to_string(), kind: "spherical", links, frames });
        Ok(())
    }

    /// The second body at `relpose` in the first one, or where it is in the file; or two sites.
    fn weld(&mut self, element: &Element, name: &str) -> Result<()> {
        if let Some(closed) = self.between_sites(element.node, name, "weld")? {
            self.robot.loops.push(closed);
            return Ok(());
        }
        let [x, y, z, turn @ ..] = element.numbers::<7>("relpose")?.unwrap_or_default();
        let size = turn.iter().map(|x| x * x).sum::<f64>().sqrt();
        // A quaternion of zeros stands for the pose in the file.
        let frames = if size > 0.0 {
            [Some(Transform { r: [x, y, z], turn: turn.each(|x| x / size) }), Some(Transform::default())]
        } else {
            [Some(Transform::default()), None]
        };
        let links = self.two_bodies(element.node)?;
        self.robot.loops.push(Loop { name: name.to_string(), kind: "weld", links, frames });
        Ok(())
    }

    fn two_bodies(&self, node: Node) -> Result<[usize; 2]> {
        let find = |name: &str| {
            self.bodies.get(name).copied().ok_or_else(|| {
                let known = self.robot.links.iter().map(|link| link.name.as_str());
                Error::unknown("body", name, known).placed(place(node))
            })
        };
        Ok([find(attribute(node, "body1")?)?, find(node.attribute("body2").unwrap_or("world"))?])
    }

    fn between_sites(&self, node: Node, name: &str, kind: &'static str) -> Result<Option<Loop>> {
        if node.attribute("site1").is_none() {
            return Ok(None);
        }
        let find = |key: &str| {
            let name = attribute(node, key)?;
            let found = self.sites.get(name).copied();
            let mut known: Vec<&str> = self.sites.keys().map(String::as_str).collect();
            known.sort_unstable();
            found.ok_or_else(|| Error::unknown("site", name, known).placed(place(node)))
        };
        let [(a, at_a), (b, at_b)] = [find("site1")?, find("site2")?];
        Ok(Some(Loop { name: name.to_string(), kind, links: [a, b], frames: [Some(at_a), Some(at_b)] }))
    }

    /// q1 - q1_0 = a0 + a1 (q2 - q2_0) + ... + a4 (q2 - q2_0)^4; a0 alone without a second joint.
    fn couple(&mut self, node: Node, name: &str, joints: &HashMap<String, usize>) -> Result<()> {
        let element = Element::plain(node);
        let mut coefficients = element.list("polycoef")?;
        if element.text("polycoef").is_none() {
            coefficients = vec![0.0, 1.0];
        }
        let follower = self.joint_of(node, attribute(node, "joint1")?, joints)?;
        let leader = node.attribute("joint2").map(|name| self.joint_of(node, name, joints)).transpose()?;
        if leader == Some(follower) {
            return Err(faulty(node, "the joint is coupled with itself").hint("name two joints").element(name));
        }
        self.robot.couplings.push(Coupling { follower, leader, coefficients, name: Some(name.to_string()) });
        Ok(())
    }

    /// A joint that has a coordinate.
    pub fn joint_of(&self, node: Node, name: &str, joints: &HashMap<String, usize>) -> Result<usize> {
        let known = || self.robot.joints.iter().map(|joint| joint.name.as_str());
        let index = *joints
            .get(name)
            .ok_or_else(|| faulty(node, format!("there is no joint `{name}`")).hint(suggest(name, known())))?;
        if self.robot.joints[index].has_coordinate() {
            Ok(index)
        } else {
            Err(faulty(node, format!("`{name}` has no coordinate")).hint("name a hinge or a slide"))
        }
    }
}
