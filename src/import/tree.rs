//! The tree of links and joints.

use super::robot::{Joint, JointType, Robot};
use super::transform::Transform;
use crate::error::{Error, Result, short_list};

/// Places of the links at the positions of the joints, and the links that are one body.
pub struct Tree {
    /// Index of the link that is the base.
    pub base: usize,
    /// Frame of each link in that of the base.
    pub frames: Vec<Transform>,
    /// The same at the positions of the file.
    pub at_zero: Vec<Transform>,
    /// For each link, the first of those that fixed joints hold together with it; the base for its own.
    pub body: Vec<usize>,
    /// Links of each body, under its first.
    pub members: Vec<Vec<usize>>,
    /// Position of each joint, rad or m.
    pub positions: Vec<f64>,
}

impl Tree {
    pub fn of(robot: &Robot, base: Option<&str>, positions: Vec<f64>) -> Result<Tree> {
        let parents = parents(robot)?;
        let root = root(robot, &parents)?;
        let mut frames = vec![Transform::default(); robot.links.len()];
        let mut at_zero = frames.clone();
        let mut body: Vec<usize> = (0..robot.links.len()).collect();
        for link in order(robot, root, &parents)? {
            let Some(index) = parents[link] else { continue };
            let joint = &robot.joints[index];
            frames[link] = frames[joint.parent].then(&joint.origin).then(&joint.moved(positions[index]));
            at_zero[link] = at_zero[joint.parent].then(&joint.origin);
            if joint.kind == JointType::Fixed {
                body[link] = body[joint.parent];
            }
        }
        let base = base.map_or(Ok(root), |name| find(robot, name).map_err(|error| error.under("--base")))?;
        let held = body[base];
        let from_base = |frames: Vec<Transform>| -> Vec<Transform> {
            let back = frames[base].inverse();
            frames.iter().map(|frame| back.then(frame)).collect()
        };
        let frames = from_base(frames);
        let at_zero = from_base(at_zero);
        body.iter_mut().filter(|body| **body == held).for_each(|body| *body = base);
        let mut members = vec![Vec::new(); body.len()];
        body.iter().enumerate().for_each(|(link, body)| members[*body].push(link));
        Ok(Tree { base, frames, at_zero, body, members, positions })
    }
}

/// Index of a link by its name.
pub fn find(robot: &Robot, name: &str) -> Result<usize> {
    crate::error::find("link", name, robot.links.iter().map(|link| link.name.as_str()))
}

/// The joint above each link.
fn parents(robot: &Robot) -> Result<Vec<Option<usize>>> {
    let mut parents = vec![None; robot.links.len()];
    for (index, joint) in robot.joints.iter().enumerate() {
        if let Some(other) = parents[joint.child].replace(index) {
            let other: &Joint = &robot.joints[other];
            let child = &robot.links[joint.child].name;
            let error = Error::input(format!("`{child}` is the child of `{}` too", other.name));
            return Err(robot
                .blame(error, &joint.name, joint.at)
                .hint("a link has one parent; close loops with --close"));
        }
    }
    Ok(parents)
}

/// The only link without a joint above it.
fn root(robot: &Robot, parents: &[Option<usize>]) -> Result<usize> {
    let roots: Vec<usize> = (0..robot.links.len()).filter(|link| parents[*link].is_none()).collect();
    match roots[..] {
        [root] => Ok(root),
        [] if robot.links.is_empty() => Err(Error::input("the robot has no link")),
        [] => Err(Error::input("the links make no tree: no link is without a parent").hint("check <parent>s")),
        _ => {
            let names: Vec<String> = roots.iter().map(|root| robot.links[*root].name.clone()).collect();
            let number = names.len();
            Err(Error::input(format!("the links make {number} trees; their roots: {}", short_list(&names)))
                .hint("join them by joints"))
        }
    }
}

/// The links, each after its parent.
fn order(robot: &Robot, root: usize, parents: &[Option<usize>]) -> Result<Vec<usize>> {
    let mut children = vec![Vec::new(); robot.links.len()];
    robot.joints.iter().for_each(|joint| children[joint.parent].push(joint.child));
    let mut order = vec![root];
    let mut next = 0;
    while let Some(link) = order.get(next).copied() {
        order.extend(&children[link]);
        next += 1;
    }
    if order.len() == parents.len() {
        return Ok(order);
    }
    // What the root does not reach has parents all the same.
    let mut is_reached = vec![false; parents.len()];
    order.iter().for_each(|link| is_reached[*link] = true);
    let error = Error::input("its joints go in a circle");
    Err(match robot.links.iter().zip(is_reached).find(|(_, is_reached)| !is_reached) {
        Some((link, _)) => robot.blame(error, &link.name, link.at),
        None => error,
    })
}
