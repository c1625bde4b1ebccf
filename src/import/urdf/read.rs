//! The XML of a robot.

use super::mimic::couplings;
use crate::body::MassProperties;
use crate::error::{Error, Result, excerpt, short, short_list, suggest};
use crate::import::robot::{Joint, Kind, Link, Robot};
use crate::import::transform::Transform;
use crate::import::xml::{all, attribute, child, faulty, number, numbers, place, unused};
use roxmltree::Node;
use std::collections::{BTreeMap, HashMap};

/// Joints with the names of their elements that are not used.
type Joints = Vec<(Joint, Vec<String>)>;

const KINDS: [(&str, Kind); 6] = [
    ("revolute", Kind::Revolute),
    ("continuous", Kind::Revolute),
    ("prismatic", Kind::Prismatic),
    ("planar", Kind::Planar),
    ("floating", Kind::Floating),
    ("fixed", Kind::Fixed),
];

/// Reads a robot.
pub fn read<'i>(root: Node<'_, 'i>) -> Result<Robot<'i>> {
    if root.descendants().any(|node| node.tag_name().namespace().is_some_and(|space| space.contains("xacro"))) {
        return Err(faulty(root, "this is a xacro file").hint("expand it first: xacro FILE.xacro > FILE.urdf"));
    }
    let links = all(root, "link").map(link).collect::<Result<Vec<Link>>>()?;
    let index = indices(root, &links)?;
    let joints = all(root, "joint").map(|node| joint(node, &index)).collect::<Result<Joints>>()?;
    let mut left_out = left_out(root, &joints);
    let (joints, _): (Vec<Joint>, Vec<_>) = joints.into_iter().unzip();
    let mut robot = Robot {
        text: root.document().input_text(),
        format: "URDF",
        name: root.attribute("name").unwrap_or("robot").to_string(),
        gravity: [0.0, 0.0, -9.81],
        links,
        joints,
        couplings: Vec::new(),
        loops: Vec::new(),
        motors: Vec::new(),
        left_out: Vec::new(),
    };
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

/// What the scene has no place for.
fn left_out(root: Node, joints: &[(Joint, Vec<String>)]) -> Vec<String> {
    let elements = unused(root, &["link", "joint", "material"]);
    let elements = (!elements.is_empty()).then(|| format!("elements {}", short_list(&elements)));
    let of_joints = joints.iter().map(|(joint, unused)| (joint.name.as_str(), unused.clone()));
    let of_links =
        all(root, "link").map(|node| (node.attribute("name").unwrap_or_default(), unused(node, &["inertial"])));
    elements.into_iter().chain(of_elements("joints", of_joints)).chain(of_elements("links", of_links)).collect()
}

/// Elements of joints or links that are not used, with the names of those.
fn of_elements<'a>(what: &str, all: impl Iterator<Item = (&'a str, Vec<String>)>) -> Vec<String> {
    let mut owners: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for (name, unused) in all {
        unused.into_iter().for_each(|tag| owners.entry(tag).or_default().push(name.to_string()));
    }
    owners.iter().map(|(tag, names)| format!("{tag} of the {what} {}", short_list(names))).collect()
}

fn link(node: Node) -> Result<Link> {
    let name = attribute(node, "name")?.to_string();
    let mass = child(node, "inertial").map(inertial).transpose().map_err(|error| error.element(&name))?;
    let meshes = node.descendants().filter(|node| node.has_tag_name("mesh"));
    let mut meshes: Vec<String> = meshes.filter_map(|mesh| mesh.attribute("filename").map(str::to_string)).collect();
    meshes.dedup();
    Ok(Link { name, at: node.range().start, mass, markers: Vec::new(), meshes, is_between: false })
}

fn inertial(node: Node) -> Result<MassProperties> {
    let of_mass = child(node, "mass").ok_or_else(|| faulty(node, "the inertial has no mass"))?;
    let inertia = child(node, "inertia").ok_or_else(|| faulty(node, "the inertial has no inertia"))?;
    let [xx, xy, xz, yy, yz, zz] =
        ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"].map(|key| number(inertia, key, Some(0.0)));
    let [xx, xy, xz, yy, yz, zz] = [xx?, xy?, xz?, yy?, yz?, zz?];
    let mass = number(of_mass, "value", None)?;
    if mass < 0.0 {
        return Err(faulty(of_mass, format!("the mass is {}, but cannot be negative", short(mass)))
            .hint("correct its sign; a hole belongs into the mass and inertia of the link that it is in"));
    }
    let own = MassProperties { mass, centre: [0.0; 3], inertia: [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]] };
    Ok(origin(node)?.mass(&own))
}

fn joint(node: Node, links: &HashMap<&str, usize>) -> Result<(Joint, Vec<String>)> {
    let name = attribute(node, "name")?.to_string();
    read_joint(node, &name, links).map_err(|error| error.element(&name))
}

fn read_joint(node: Node, name: &str, links: &HashMap<&str, usize>) -> Result<(Joint, Vec<String>)> {
    let found = attribute(node, "type")?;
    let (_, kind) = KINDS.iter().find(|(known, _)| *known == found).ok_or_else(|| {
        faulty(node, format!("there is no joint of type `{}`", excerpt(found)))
            .hint(suggest(found, KINDS.iter().map(|(name, _)| *name)))
    })?;
    let ends = [end(node, "parent", links)?, end(node, "child", links)?];
    let dynamics = child(node, "dynamics");
    let of = |key| dynamics.map_or(Ok(0.0), |dynamics| number(dynamics, key, Some(0.0)));
    let mut unused = unused(node, &["parent", "child", "origin", "axis", "dynamics", "mimic"]);
    if of("friction")? != 0.0 {
        unused.push("friction".to_string());
    }
    let mut joint = Joint::new(name.to_string(), node.range().start, *kind, ends, origin(node)?);
    joint.damping = of("damping")?;
    joint.axis = child(node, "axis").map_or(Ok([1.0, 0.0, 0.0]), |axis| numbers(axis, "xyz", [1.0, 0.0, 0.0]))?;
    Ok((joint, unused))
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
    let Some(origin) = child(node, "origin") else { return Ok(Transform::default()) };
    Ok(Transform::new(numbers(origin, "xyz", [0.0; 3])?, numbers(origin, "rpy", [0.0; 3])?))
}
