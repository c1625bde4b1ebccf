//! A robot as its file describes it, in any of the formats.

use super::transform::Transform;
use super::xml::faulty;
use crate::body::{MassProperties, norm};
use crate::error::{Error, Result, excerpt, suggest};
use crate::math::array::Each;
use crate::math::rotation::quaternion_from_vector;
use crate::scene::locate::line_and_column;
use roxmltree::Node;

/// Links joined by joints to a tree, and what closes loops.
pub struct Robot<'a> {
    /// The text that places refer to.
    pub text: &'a str,
    /// URDF or MJCF.
    pub format: &'static str,
    pub name: String,
    /// m/s^2
    pub gravity: [f64; 3],
    pub links: Vec<Link>,
    pub joints: Vec<Joint>,
    pub couplings: Vec<Coupling>,
    pub loops: Vec<Loop>,
    pub motors: Vec<Motor>,
    /// What the reader has no place for, a sentence each.
    pub left_out: Vec<String>,
}

impl<'a> Robot<'a> {
    /// A robot without links.
    pub fn new(root: Node<'_, 'a>, format: &'static str, name: &str) -> Self {
        Robot {
            text: root.document().input_text(),
            format,
            name: name.to_string(),
            gravity: [0.0, 0.0, -9.81],
            links: Vec::new(),
            joints: Vec::new(),
            couplings: Vec::new(),
            loops: Vec::new(),
            motors: Vec::new(),
            left_out: Vec::new(),
        }
    }

    /// Adds the element and its line and column to an error.
    pub fn blame(&self, error: Error, name: &str, at: usize) -> Error {
        error.element(name).placed(line_and_column(self.text, at))
    }
}

pub struct Link {
    pub name: String,
    /// Byte of the text at which it begins.
    pub at: usize,
    /// From the origin of the link, in its axes; `None` where the file gives none.
    pub mass: Option<MassProperties>,
    /// Points of interest, in the frame of the link.
    pub markers: Vec<(String, Transform)>,
    /// Files of its meshes.
    pub meshes: Vec<String>,
    /// True if it stands between two joints of one link of the file.
    pub is_between: bool,
}

impl Link {
    /// A link without mass.
    pub fn new(name: String, node: Node) -> Self {
        let at = node.range().start;
        Link { name, at, mass: None, markers: Vec::new(), meshes: Vec::new(), is_between: false }
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum JointType {
    Revolute,
    Prismatic,
    Planar,
    Spherical,
    Floating,
    Fixed,
}

pub struct Joint {
    pub name: String,
    /// Byte of the text at which it begins.
    pub at: usize,
    pub kind: JointType,
    /// Index of a link.
    pub parent: usize,
    /// Index of a link.
    pub child: usize,
    /// Frame of the child in that of the parent at the position `reference`.
    pub origin: Transform,
    /// Point of the joint in the frame of the child, m.
    pub anchor: [f64; 3],
    /// In the frame of the child.
    pub axis: [f64; 3],
    /// Position in the file, rad or m.
    pub reference: f64,
    /// N m s/rad or N s/m.
    pub damping: f64,
    /// N m/rad or N/m.
    pub stiffness: f64,
    /// Position without force of the spring, rad or m.
    pub relaxed: f64,
    /// Inertia of the coordinate itself, kg m^2 or kg, as of a rotor behind a gear.
    pub armature: f64,
}

impl JointType {
    /// The kind that a file of these kinds calls `found`.
    pub fn find(node: Node, found: &str, known: &[(&str, JointType)]) -> Result<JointType> {
        known.iter().find(|(name, _)| *name == found).map(|(_, kind)| *kind).ok_or_else(|| {
            faulty(node, format!("there is no joint of type `{}`", excerpt(found)))
                .hint(suggest(found, known.iter().map(|(name, _)| *name)))
        })
    }
}

impl Joint {
    /// A joint that holds the child at a place in the parent.
    pub fn new(name: String, at: usize, kind: JointType, links: [usize; 2], origin: Transform) -> Self {
        let [parent, child] = links;
        Joint {
            name,
            at,
            kind,
            parent,
            child,
            origin,
            anchor: [0.0; 3],
            axis: [0.0, 0.0, 1.0],
            reference: 0.0,
            damping: 0.0,
            stiffness: 0.0,
            relaxed: 0.0,
            armature: 0.0,
        }
    }

    /// True if its position is one number.
    pub fn has_coordinate(&self) -> bool {
        matches!(self.kind, JointType::Revolute | JointType::Prismatic)
    }

    /// The frame of the child at a position in that at the position of the file.
    pub fn moved(&self, position: f64) -> Transform {
        let size = norm(&self.axis);
        let travel = position - self.reference;
        if travel == 0.0 || size == 0.0 {
            return Transform::default();
        }
        let along = self.axis.each(|x| travel * x / size);
        match self.kind {
            JointType::Revolute => Transform { r: [0.0; 3], turn: quaternion_from_vector(&along) }.about(&self.anchor),
            JointType::Prismatic => Transform { r: along, ..Transform::default() },
            JointType::Planar | JointType::Spherical | JointType::Floating | JointType::Fixed => Transform::default(),
        }
    }
}

/// q - q0 = sum_k c_k (p - p0)^k: the coordinate q of a joint follows that of another, p; q0 and p0 are their positions
/// in the file.
pub struct Coupling {
    /// Index of the joint that follows.
    pub follower: usize,
    /// Index of the joint that it follows; `None` if that does not move.
    pub leader: Option<usize>,
    /// c_0, c_1, ...
    pub coefficients: Vec<f64>,
    /// What its name begins with, if it has one.
    pub name: Option<String>,
}

impl Coupling {
    /// Position of the follower.
    pub fn position(&self, joints: &[Joint], lead: f64) -> f64 {
        let travel = self.leader.map_or(0.0, |leader| lead - joints[leader].reference);
        let sum = self.coefficients.iter().rev().fold(0.0, |sum, c| sum * travel + c);
        joints[self.follower].reference + sum
    }
}

/// A joint that closes a loop: `spherical` or `weld`.
pub struct Loop {
    pub name: String,
    pub kind: &'static str,
    /// Indices of two links.
    pub links: [usize; 2],
    /// Frames of its markers in those of the links; `None`: where that of the first one is in the file.
    pub frames: [Option<Transform>; 2],
}

/// A force or torque of a motor along the coordinate of a joint.
pub struct Motor {
    pub name: String,
    /// Index of the joint.
    pub joint: usize,
}
