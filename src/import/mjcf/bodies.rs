//! The tree of bodies.

use super::MjcfReader;
use crate::error::{Error, Result};
use crate::import::robot::{Joint, JointType, Link};
use crate::import::transform::Transform;
use crate::import::xml::{Element, all, place, texts};
use roxmltree::Node;

/// An element of a body, in a frame of it.
pub struct PlacedElement<'a, 'i> {
    pub node: Node<'a, 'i>,
    /// That of the `<frame>`s around it.
    pub frame: Transform,
    /// Default class of what names none.
    pub class: Option<&'a str>,
}

/// Elements of a body that are read, or that have no mechanics.
const KNOWN: [&str; 9] = ["body", "inertial", "joint", "freejoint", "geom", "site", "frame", "camera", "light"];

impl<'a, 'i> MjcfReader<'a, 'i> {
    pub fn worldbody(&mut self) -> Result<()> {
        self.bodies.insert("world".to_string(), 0);
        let mut pending = Vec::new();
        for world in all(self.root, "worldbody") {
            let class = world.attribute("childclass");
            let parts = self.contents(world, Transform::default(), class)?;
            self.sites(&parts, 0)?;
            let has_geoms = parts.iter().any(|part| part.node.has_tag_name("geom"));
            self.told.add_if(has_geoms, "contacts of the bodies", "world");
            pending.extend(self.children(parts, 0));
        }
        // Bodies in the order of the file, without recursion: chains may be long.
        pending.reverse();
        while let Some((body, parent)) = pending.pop() {
            let first = pending.len();
            let children = self.body(&body, parent)?;
            pending.extend(children);
            pending[first..].reverse();
        }
        Ok(())
    }

    /// The elements of a body, with those of the `<frame>`s in it.
    fn contents(
        &self,
        owner: Node<'a, 'i>,
        frame: Transform,
        class: Option<&'a str>,
    ) -> Result<Vec<PlacedElement<'a, 'i>>> {
        let mut parts = Vec::new();
        for node in owner.children().filter(Node::is_element) {
            if node.has_tag_name("frame") {
                let inner = frame.then(&self.settings.place(&Element::plain(node))?);
                parts.extend(self.contents(node, inner, node.attribute("childclass").or(class))?);
            } else {
                parts.push(PlacedElement { node, frame, class });
            }
        }
        Ok(parts)
    }

    /// The bodies among the elements of a body; what is not read is told.
    fn children(&mut self, parts: Vec<PlacedElement<'a, 'i>>, owner: usize) -> Vec<(PlacedElement<'a, 'i>, usize)> {
        for part in &parts {
            let tag = part.node.tag_name().name();
            let is_known = KNOWN.contains(&tag);
            self.told.add_if(!is_known, &format!("{tag} of the bodies"), &self.robot.links[owner].name);
        }
        parts.into_iter().filter(|part| part.node.has_tag_name("body")).map(|part| (part, owner)).collect()
    }

    /// Adds a body with its joints; returns the bodies in it.
    fn body(&mut self, body: &PlacedElement<'a, 'i>, parent: usize) -> Result<Vec<(PlacedElement<'a, 'i>, usize)>> {
        let node = body.node;
        let link = self.robot.links.len();
        let name = node.attribute("name").map_or_else(|| format!("body_{link}"), str::to_string);
        if self.bodies.insert(name.clone(), link).is_some() {
            return Err(Error::input(format!("the name `{name}` is taken")).placed(place(node)));
        }
        let element = Element::plain(node);
        self.told.add_if(element.has("gravcomp")?, "gravcomp of the bodies", &name);
        self.told.add_if(element.is("mocap", "true"), "motion from outside (mocap) of the bodies", &name);
        let pose = body.frame.then(&self.settings.place(&element)?);
        let class = node.attribute("childclass").or(body.class);
        let parts = self.contents(node, Transform::default(), class)?;
        let geoms = parts.iter().filter(|part| part.node.has_tag_name("geom")).map(|part| part.node);
        self.robot.links.push(Link { meshes: texts(geoms, "mesh"), ..Link::new(name.clone(), node) });
        self.robot.links[link].mass = self.mass(&parts, &name).map_err(|error| error.element(&name))?;
        self.hold(&parts, parent, link, pose).map_err(|error| error.element(&name))?;
        self.sites(&parts, link)?;
        Ok(self.children(parts, link))
    }

    /// Adds the joints of a body, each between two links in a row; between the first and the last one are links without
    /// mass.
    fn hold(&mut self, parts: &[PlacedElement<'a, 'i>], parent: usize, link: usize, pose: Transform) -> Result<()> {
        let joints: Vec<&PlacedElement> = parts.iter().filter(|part| is_joint(part.node)).collect();
        let name = self.robot.links[link].name.clone();
        if joints.is_empty() {
            let at = self.robot.links[link].at;
            let weld = Joint::new(format!("{name}_weld"), at, JointType::Fixed, [parent, link], pose);
            self.robot.joints.push(weld);
            return Ok(());
        }
        let mut from = parent;
        let mut origin = pose;
        for (number, part) in joints.iter().enumerate() {
            let mut to = link;
            if number + 1 < joints.len() {
                to = self.robot.links.len();
                let between = Link::new(format!("{name}_{}", number + 1), part.node);
                self.robot.links.push(Link { is_between: true, ..between });
            }
            let joint = self.joint(part, &name, [from, to], origin)?;
            self.robot.joints.push(joint);
            (from, origin) = (to, Transform::default());
        }
        Ok(())
    }

    /// Adds the sites of a body as markers.
    fn sites(&mut self, parts: &[PlacedElement<'a, 'i>], link: usize) -> Result<()> {
        for part in parts.iter().filter(|part| part.node.has_tag_name("site")) {
            let element = self.classes.element(part.node, &["site"], part.class)?;
            let frame = part.frame.then(&self.settings.place(&element)?);
            if let Some(name) = part.node.attribute("name") {
                self.sites.insert(name.to_string(), (link, frame));
                self.robot.links[link].markers.push((name.to_string(), frame));
            }
        }
        Ok(())
    }
}

fn is_joint(node: Node) -> bool {
    node.has_tag_name("joint") || node.has_tag_name("freejoint")
}
