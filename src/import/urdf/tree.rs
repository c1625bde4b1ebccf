//! The tree of links and joints.

use super::read::{Joint, Kind, Robot};
use super::transform::Transform;
use crate::error::{Error, Result, short_list};
use std::collections::HashMap;

/// Places of the links at the positions of the joints, and the links that are one body.
pub struct Tree {
    /// Index of the link that is the base.
    pub base: usize,
    /// Frame of each link in that of the base.
    pub frames: Vec<Transform>,
    /// The same at position zero of all joints.
    pub at_zero: Vec<Transform>,
    /// For each link, the first of those that fixed joints hold together with it; the base for its own.
    pub body: Vec<usize>,
    /// Indices of the parent and child of each joint.
    pub ends: Vec<[usize; 2]>,
    /// Position of each joint, rad or m.
    pub positions: Vec<f64>,
}

impl Tree {
    pub fn of(robot: &Robot, base: Option<&str>, positions: Vec<f64>) -> Result<Tree> {
        let index = indices(robot)?;
        let ends = robot.joints.iter().map(|joint| joint_ends(joint, &index)).collect::<Result<Vec<_>>>()?;
        let parents = parents(robot, &ends)?;
        let roots: Vec<usize> = (0..robot.links.len()).filter(|link| parents[*link].is_none()).collect();
        let root = match roots[..] {
            [root] => root,
            [] => {
                return Err(Error::input("the links make no tree: no link is without a parent").hint("check <parent>s"));
            }
            _ => {
                let names: Vec<String> = roots.iter().map(|root| robot.links[*root].name.clone()).collect();
                return Err(Error::input(format!(
                    "the links make {} trees; their roots: {}",
                    names.len(),
                    short_list(&names)
                ))
                .hint("join them by joints"));
            }
        };
        let order = order(robot, &parents, &ends)?;
        let mut frames = vec![Transform::default(); robot.links.len()];
        let mut at_zero = frames.clone();
        let mut body: Vec<usize> = (0..robot.links.len()).collect();
        for link in order {
            if let Some(index) = parents[link] {
                let (joint, parent) = (&robot.joints[index], ends[index][0]);
                frames[link] = frames[parent].then(&joint.origin).then(&joint.moved(positions[index]));
                at_zero[link] = at_zero[parent].then(&joint.origin);
                if joint.kind == Kind::Fixed {
                    body[link] = body[parent];
                }
            }
        }
        let base = base.map_or(Ok(root), |name| find(robot, name).map_err(|error| error.under("--base")))?;
        let held = body[base];
        let [frames, at_zero] = [frames, at_zero].map(|frames| {
            let back = frames[base].inverse();
            frames.iter().map(|frame| back.then(frame)).collect()
        });
        body.iter_mut().filter(|body| **body == held).for_each(|body| *body = base);
        Ok(Tree { base, frames, at_zero, body, ends, positions })
    }
}

/// Index of a link by its name.
pub fn find(robot: &Robot, name: &str) -> Result<usize> {
    crate::error::find("link", name, robot.links.iter().map(|link| link.name.as_str()))
}

fn indices(robot: &Robot) -> Result<HashMap<&str, usize>> {
    let mut index = HashMap::new();
    for (i, link) in robot.links.iter().enumerate() {
        if index.insert(link.name.as_str(), i).is_some() {
            return Err(Error::input(format!("the name `{}` is taken", link.name)).placed(link.place));
        }
    }
    match index.is_empty() {
        true => Err(Error::input("the robot has no link")),
        false => Ok(index),
    }
}

fn joint_ends(joint: &Joint, index: &HashMap<&str, usize>) -> Result<[usize; 2]> {
    let find = |name: &str| {
        let mut known: Vec<&str> = index.keys().copied().collect();
        known.sort_unstable();
        index
            .get(name)
            .copied()
            .ok_or_else(|| Error::unknown("link", name, known).element(&joint.name).placed(joint.place))
    };
    Ok([find(&joint.parent)?, find(&joint.child)?])
}

/// The joint above each link.
fn parents(robot: &Robot, ends: &[[usize; 2]]) -> Result<Vec<Option<usize>>> {
    let mut parents = vec![None; robot.links.len()];
    for (joint, [_, child]) in ends.iter().enumerate() {
        if let Some(other) = parents[*child].replace(joint) {
            let (joint, other): (&Joint, &Joint) = (&robot.joints[joint], &robot.joints[other]);
            return Err(Error::input(format!("`{}` is the child of `{}` too", joint.child, other.name))
                .element(&joint.name)
                .placed(joint.place)
                .hint("a link has one parent; close loops with --close"));
        }
    }
    Ok(parents)
}

/// The links, each after its parent.
fn order(robot: &Robot, parents: &[Option<usize>], ends: &[[usize; 2]]) -> Result<Vec<usize>> {
    let parent_of = |link: usize| parents[link].map(|joint| ends[joint][0]);
    let depth =
        |link: usize| std::iter::successors(Some(link), |link| parent_of(*link)).take(parents.len() + 1).count();
    let mut all: Vec<(usize, usize)> = (0..parents.len()).map(|link| (depth(link), link)).collect();
    if let Some((_, link)) = all.iter().find(|(depth, _)| *depth > parents.len()) {
        let link = &robot.links[*link];
        return Err(Error::input("its joints go in a circle").element(&link.name).placed(link.place));
    }
    all.sort_unstable();
    Ok(all.into_iter().map(|(_, link)| link).collect())
}
