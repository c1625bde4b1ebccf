//! The XML of a robot.

use super::mimic::couplings;
use crate::body::MassProperties;
use crate::error::{Error, Result, short, short_list};
use crate::import::robot::{Joint, JointType, Link, Robot};
use crate::import::told::Told;
use crate::import::transform::Transform;
use crate::import::xml::{Element, all, attribute, child, faulty, place, texts, unused};
use roxmltree::Node;
use std::collections::HashMap;

const KINDS: [(&str, JointType); 6] = [
    ("revolute", JointType::Revolute),
    ("continuous", JointType::Revolute),
    ("prismatic", JointType::Prismatic),
    ("planar", JointType::Planar),
    ("floating", JointType::Floating),
    ("fixed", JointType::Fixed),
];

pub fn read<'i>(root: Node<'_, 'i>) -> Result<Robot<'i>> {
    if root.descendants().any(|node| node.tag_name().namespace().is_some_and(|space| space.contains("xacro"))) {
        return Err(faulty(root, "this is a xacro file").hint("expand it first: xacro FILE.xacro > FILE.urdf"));
    }
    let links = all(root, "link").map(link).collect::<Result<Vec<Link>>>()?;
    let index = indices(root, &links)?;
    let mut robot = Robot::new(root, "URDF", root.attribute("name").unwrap_or("robot"));
    let mut of_joints = Told::default();
    for node in all(root, "joint") {
        let name = attribute(node, "name")?;
        let joint = joint(node, name, &index, &mut of_joints).map_err(|error| error.element(name))?;
        robot.joints.push(joint);
    }
    let mut of_links = Told::default();
    for (node, link) in all(root, "link").zip(&links) {
        unused(node, &["inertial"]).iter().for_each(|tag| of_links.add(format!("{tag} of the links"), &link.name));
    }
    robot.links = links;
    let elements = unused(root, &["link", "joint", "material"]);
    let mut left_out = Vec::from_iter((!elements.is_empty()).then(|| format!("elements {}", short_list(&elements))));
    left_out.extend(of_joints.sentences().chain(of_links.sentences()));
    robot.couplings = couplings(root, &robot, &mut left_out)?;
    robot.left_out = left_out;
    Ok(robot)
}

fn indices<'l>(root: Node, links: &'l [Link]) -> Result<HashMap<&'l str, usize>> {
    let mut index = HashMap::new();
    for ((i, link), node) in links.iter().enumerate().zip(all(root, "link")) {
        if index.insert(link.name.as_str(), i).is_some() {
            return Err(faulty(node, format!("the name `{}` is taken", link.name)));
        }
    }
    Ok(index)
}

fn link(node: Node) -> Result<Link> {
    let name = attribute(node, "name")?.to_string();
    let mass = child(node, "inertial").map(inertial).transpose().map_err(|error| error.element(&name))?;
    let meshes = texts(node.descendants().filter(|node| node.has_tag_name("mesh")), "filename");
    Ok(Link { mass, meshes, ..Link::new(name, node) })
}

fn inertial(node: Node) -> Result<MassProperties> {
    let of_mass = child(node, "mass").ok_or_else(|| faulty(node, "the inertial has no mass"))?;
    let inertia = child(node, "inertia").ok_or_else(|| faulty(node, "the inertial has no inertia"))?;
    let inertia = Element::plain(inertia);
    let xx = inertia.number_or("ixx", 0.0)?;
    let xy = inertia.number_or("ixy", 0.0)?;
    let xz = inertia.number_or("ixz", 0.0)?;
    let yy = inertia.number_or("iyy", 0.0)?;
    let yz = inertia.number_or("iyz", 0.0)?;
    let zz = inertia.number_or("izz", 0.0)?;
    let mass = Element::plain(of_mass).needed("value")?;
    if mass < 0.0 {
        return Err(faulty(of_mass, format!("the mass is {}, but cannot be negative", short(mass)))
            .hint("correct its sign; a hole belongs into the mass and inertia of the link that it is in"));
    }
    let own = MassProperties { mass, centre: [0.0; 3], inertia: [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]] };
    Ok(origin(node)?.mass(&own))
}

fn joint(node: Node, name: &str, links: &HashMap<&str, usize>, told: &mut Told) -> Result<Joint> {
    let kind = JointType::find(node, attribute(node, "type")?, &KINDS)?;
    let ends = [end(node, "parent", links)?, end(node, "child", links)?];
    let dynamics = child(node, "dynamics").map(Element::plain);
    let of = |key| dynamics.as_ref().map_or(Ok(0.0), |dynamics| dynamics.number_or(key, 0.0));
    let unused = unused(node, &["parent", "child", "origin", "axis", "dynamics", "mimic"]);
    unused.iter().for_each(|tag| told.add(format!("{tag} of the joints"), name));
    told.add_if(of("friction")? != 0.0, "friction of the joints", name);
    let mut joint = Joint::new(name.to_string(), node.range().start, kind, ends, origin(node)?);
    joint.damping = of("damping")?;
    joint.axis = child(node, "axis")
        .map_or(Ok([1.0, 0.0, 0.0]), |axis| Element::plain(axis).numbers_or("xyz", [1.0, 0.0, 0.0]))?;
    Ok(joint)
}

/// The link at an end of a joint.
fn end(node: Node, tag: &'static str, links: &HashMap<&str, usize>) -> Result<usize> {
    let end = child(node, tag).ok_or_else(|| faulty(node, format!("the joint has no <{tag}>")))?;
    let name = attribute(end, "link")?;
    links.get(name).copied().ok_or_else(|| {
        let mut known: Vec<&str> = links.keys().copied().collect();
        known.sort_unstable();
        Error::unknown("link", name, known).placed(place(node))
    })
}

fn origin(node: Node) -> Result<Transform> {
    let Some(origin) = child(node, "origin").map(Element::plain) else { return Ok(Transform::default()) };
    Ok(Transform::new(origin.numbers_or("xyz", [0.0; 3])?, origin.numbers_or("rpy", [0.0; 3])?))
}
