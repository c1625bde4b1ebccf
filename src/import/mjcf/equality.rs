//! Equalities: constraints that close loops and couple joints.

use super::{MjcfReader, named};
use crate::error::{Error, Result, suggest};
use crate::import::robot::{Coupling, Loop};
use crate::import::transform::Transform;
use crate::import::xml::{Element, attribute, faulty, place};
use crate::math::array::Each;
use roxmltree::Node;
use std::collections::HashMap;

impl<'a, 'i> MjcfReader<'a, 'i> {
    pub fn equalities(&mut self, joints: &HashMap<String, usize>) -> Result<()> {
        for (node, name) in named(self.root, "equality") {
            let tag = node.tag_name().name();
            let element = self.classes.element(node, &["equality"], None)?;
            if element.is("active", "false") {
                self.told.add("equalities that are not active:", &name);
                continue;
            }
            match tag {
                "connect" => self.close(&element, &name, "spherical", connected)?,
                "weld" => self.close(&element, &name, "weld", welded)?,
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

    /// A joint between two sites, or where `frames` says on two bodies.
    fn close(&mut self, element: &Element, name: &str, kind: &'static str, frames: Frames) -> Result<()> {
        let node = element.node;
        let (links, frames) = if node.has_attribute("site1") {
            let [(a, at_a), (b, at_b)] = [self.site(node, "site1")?, self.site(node, "site2")?];
            ([a, b], [Some(at_a), Some(at_b)])
        } else {
            let frames = frames(element)?;
            (self.two_bodies(node)?, frames)
        };
        self.robot.loops.push(Loop { name: name.to_string(), kind, links, frames });
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

    /// Link and frame of the site that an attribute names.
    fn site(&self, node: Node, key: &str) -> Result<(usize, Transform)> {
        let name = attribute(node, key)?;
        self.sites.get(name).copied().ok_or_else(|| {
            let mut known: Vec<&str> = self.sites.keys().map(String::as_str).collect();
            known.sort_unstable();
            Error::unknown("site", name, known).placed(place(node))
        })
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

/// Reads the frames of a [`Loop`] on two bodies.
type Frames = fn(&Element) -> Result<[Option<Transform>; 2]>;

fn connected(element: &Element) -> Result<[Option<Transform>; 2]> {
    let anchor = element.numbers("anchor")?.ok_or_else(|| faulty(element.node, "<connect> has no `anchor`"))?;
    Ok([Some(Transform { r: anchor, ..Transform::default() }), None])
}

/// The second body at `relpose` in the first one, or where it is in the file.
fn welded(element: &Element) -> Result<[Option<Transform>; 2]> {
    let [x, y, z, turn @ ..] = element.numbers::<7>("relpose")?.unwrap_or_default();
    let size = turn.iter().map(|x| x * x).sum::<f64>().sqrt();
    // A quaternion of zeros stands for the pose in the file.
    Ok(if size > 0.0 {
        [Some(Transform { r: [x, y, z], turn: turn.each(|x| x / size) }), Some(Transform::default())]
    } else {
        [Some(Transform::default()), None]
    })
}
