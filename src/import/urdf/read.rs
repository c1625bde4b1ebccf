//! The XML of a robot.

use super::transform::Transform;
use crate::body::norm;
use crate::error::{Error, Result, excerpt, suggest};
use crate::math::rotation::{Matrix3, quaternion_from_vector};
use roxmltree::{Document, Node};

/// A robot as its file describes it.
pub struct Robot {
    pub name: String,
    pub links: Vec<Link>,
    pub joints: Vec<Joint>,
    /// Names of elements that are not used, each once.
    pub unused: Vec<String>,
}

pub struct Link {
    pub name: String,
    /// Line and column.
    pub place: (usize, usize),
    pub inertial: Option<Inertial>,
    /// Files of its meshes.
    pub meshes: Vec<String>,
    /// Names of its elements that are not used, each once.
    pub unused: Vec<String>,
}

pub struct Inertial {
    pub mass: f64,
    /// Frame of the centre of mass in that of the link.
    pub origin: Transform,
    /// About the centre of mass, in the axes of `origin`.
    pub inertia: Matrix3,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    Revolute,
    Prismatic,
    Planar,
    Floating,
    Fixed,
}

pub struct Joint {
    pub name: String,
    pub place: (usize, usize),
    pub kind: Kind,
    pub parent: String,
    pub child: String,
    /// Frame of the child in that of the parent at position zero.
    pub origin: Transform,
    /// In the frame of the child.
    pub axis: [f64; 3],
    /// N m s/rad or N s/m.
    pub damping: f64,
    /// The joint whose coordinate determines its own.
    pub mimic: Option<Mimic>,
    /// Names of its elements that are not used, each once.
    pub unused: Vec<String>,
}

impl Joint {
    /// True if its position is one number.
    pub fn has_coordinate(&self) -> bool {
        matches!(self.kind, Kind::Revolute | Kind::Prismatic)
    }

    /// The frame of the child at a position in that at position zero.
    pub fn moved(&self, position: f64) -> Transform {
        let size = norm(&self.axis);
        if position == 0.0 || size == 0.0 {
            return Transform::default();
        }
        let along = self.axis.map(|x| position * x / size);
        match self.kind {
            Kind::Revolute => Transform { r: [0.0; 3], turn: quaternion_from_vector(&along) },
            Kind::Prismatic => Transform { r: along, ..Transform::default() },
            Kind::Planar | Kind::Floating | Kind::Fixed => Transform::default(),
        }
    }
}

/// coordinate = multiplier coordinate of `joint` + offset.
pub struct Mimic {
    pub joint: String,
    pub multiplier: f64,
    pub offset: f64,
}

const KINDS: [(&str, Kind); 6] = [
    ("revolute", Kind::Revolute),
    ("continuous", Kind::Revolute),
    ("prismatic", Kind::Prismatic),
    ("planar", Kind::Planar),
    ("floating", Kind::Floating),
    ("fixed", Kind::Fixed),
];

/// Reads a robot.
pub fn robot(text: &str) -> Result<Robot> {
    let document = Document::parse(text).map_err(|error| {
        let at = error.pos();
        Error::input(format!("this is not XML: {error}")).placed((at.row as usize, at.col as usize))
    })?;
    let root = document.root_element();
    if root.tag_name().name() != "robot" {
        let found = excerpt(root.tag_name().name());
        return Err(faulty(root, format!("expected a robot, found <{found}>")).hint("a URDF file has the root <robot>"));
    }
    if root.descendants().any(|node| node.tag_name().namespace().is_some_and(|space| space.contains("xacro"))) {
        return Err(faulty(root, "this is a xacro file").hint("expand it first: xacro FILE.xacro > FILE.urdf"));
    }
    let all = |tag: &'static str| root.children().filter(move |node| node.has_tag_name(tag));
    Ok(Robot {
        name: root.attribute("name").unwrap_or("robot").to_string(),
        links: all("link").map(link).collect::<Result<_>>()?,
        joints: all("joint").map(joint).collect::<Result<_>>()?,
        unused: unused(root, &["link", "joint", "material"]),
    })
}

/// Names of the elements in a node that are not among the `used` ones, each once.
fn unused(node: Node, used: &[&str]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for tag in node.children().filter(Node::is_element).map(|node| node.tag_name().name()) {
        if !used.contains(&tag) && !names.iter().any(|known| known == tag) {
            names.push(tag.to_string());
        }
    }
    names
}

fn link(node: Node) -> Result<Link> {
    let name = attribute(node, "name")?.to_string();
    let inertial = child(node, "inertial").map(inertial).transpose().map_err(|error| error.element(&name))?;
    let meshes = node.descendants().filter(|node| node.has_tag_name("mesh"));
    let mut meshes: Vec<String> = meshes.filter_map(|mesh| mesh.attribute("filename").map(str::to_string)).collect();
    meshes.dedup();
    Ok(Link { name, place: place(node), inertial, meshes, unused: unused(node, &["inertial"]) })
}

fn inertial(node: Node) -> Result<Inertial> {
    let mass = child(node, "mass").ok_or_else(|| faulty(node, "the inertial has no mass"))?;
    let inertia = child(node, "inertia").ok_or_else(|| faulty(node, "the inertial has no inertia"))?;
    let [xx, xy, xz, yy, yz, zz] =
        ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"].map(|key| number(inertia, key, Some(0.0)));
    let [xx, xy, xz, yy, yz, zz] = [xx?, xy?, xz?, yy?, yz?, zz?];
    Ok(Inertial {
        mass: number(mass, "value", None)?,
        origin: origin(node)?,
        inertia: [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]],
    })
}

fn joint(node: Node) -> Result<Joint> {
    let name = attribute(node, "name")?.to_string();
    read_joint(node, &name).map_err(|error| error.element(&name))
}

fn read_joint(node: Node, name: &str) -> Result<Joint> {
    let found = attribute(node, "type")?;
    let (_, kind) = KINDS.iter().find(|(known, _)| *known == found).ok_or_else(|| {
        faulty(node, format!("there is no joint of type `{}`", excerpt(found)))
            .hint(suggest(found, KINDS.iter().map(|(name, _)| *name)))
    })?;
    let link = |tag: &'static str| -> Result<String> {
        let end = child(node, tag).ok_or_else(|| faulty(node, format!("the joint has no <{tag}>")))?;
        Ok(attribute(end, "link")?.to_string())
    };
    let axis = child(node, "axis").map(|axis| numbers(axis, "xyz", [1.0, 0.0, 0.0])).transpose()?;
    let dynamics = child(node, "dynamics");
    let of = |key| dynamics.map_or(Ok(0.0), |dynamics| number(dynamics, key, Some(0.0)));
    let mut unused = unused(node, &["parent", "child", "origin", "axis", "dynamics", "mimic"]);
    if of("friction")? != 0.0 {
        unused.push("friction".to_string());
    }
    Ok(Joint {
        name: name.to_string(),
        place: place(node),
        kind: *kind,
        parent: link("parent")?,
        child: link("child")?,
        origin: origin(node)?,
        axis: axis.unwrap_or([1.0, 0.0, 0.0]),
        damping: of("damping")?,
        mimic: child(node, "mimic").map(mimic).transpose()?,
        unused,
    })
}

fn mimic(node: Node) -> Result<Mimic> {
    Ok(Mimic {
        joint: attribute(node, "joint")?.to_string(),
        multiplier: number(node, "multiplier", Some(1.0))?,
        offset: number(node, "offset", Some(0.0))?,
    })
}

fn origin(node: Node) -> Result<Transform> {
    let Some(origin) = child(node, "origin") else { return Ok(Transform::default()) };
    Ok(Transform::new(numbers(origin, "xyz", [0.0; 3])?, numbers(origin, "rpy", [0.0; 3])?))
}

fn child<'a, 'i>(node: Node<'a, 'i>, tag: &str) -> Option<Node<'a, 'i>> {
    node.children().find(|child| child.has_tag_name(tag))
}

fn attribute<'a>(node: Node<'a, '_>, key: &str) -> Result<&'a str> {
    let tag = node.tag_name().name().to_string();
    node.attribute(key).ok_or_else(|| faulty(node, format!("<{tag}> has no `{key}`")))
}

/// A number, or `default` where it is not given.
fn number(node: Node, key: &str, default: Option<f64>) -> Result<f64> {
    match (node.attribute(key), default) {
        (None, Some(default)) => Ok(default),
        _ => parsed(node, key, attribute(node, key)?),
    }
}

fn parsed(node: Node, key: &str, text: &str) -> Result<f64> {
    let value = text.trim().parse().ok().filter(|value: &f64| value.is_finite());
    value.ok_or_else(|| faulty(node, format!("expected a number in `{key}`, found \"{}\"", excerpt(text))))
}

fn numbers(node: Node, key: &str, default: [f64; 3]) -> Result<[f64; 3]> {
    let Some(text) = node.attribute(key) else { return Ok(default) };
    let all = text.split_whitespace().map(|word| parsed(node, key, word)).collect::<Result<Vec<f64>>>()?;
    all.try_into().map_err(|all: Vec<f64>| faulty(node, format!("expected 3 numbers in `{key}`, found {}", all.len())))
}

fn place(node: Node) -> (usize, usize) {
    let at = node.document().text_pos_at(node.range().start);
    (at.row as usize, at.col as usize)
}

fn faulty(node: Node, message: impl Into<String>) -> Error {
    Error::input(message).placed(place(node))
}
