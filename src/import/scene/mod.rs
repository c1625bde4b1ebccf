//! The scene of a robot.

mod bodies;
mod joints;
mod left_out;
mod loops;
mod valid;

use super::names::UniqueNames;
use super::robot::Robot;
use super::transform::Transform;
use super::tree::Tree;
use super::{Imported, Options};
use crate::body::aim;
use crate::error::Result;
use crate::math::rotation::quaternion_from_axes;
use left_out::{about, doubts, left_out};
use serde_json::{Map, Value, json};

/// The scene at the positions of the joints, with what was left out.
pub fn build(robot: &Robot, tree: &Tree, options: &Options) -> Result<Imported> {
    let mut names = UniqueNames::default();
    let mut draft = Draft::new(robot, tree, options, &mut names);
    draft.mark_links(&mut names);
    draft.joints.names = robot.joints.iter().map(|joint| names.unique(&joint.name)).collect();
    for index in 0..robot.joints.len() {
        draft.joint(index, &mut names)?;
    }
    for coupling in &robot.couplings {
        draft.coupling(coupling, &mut names);
    }
    for given in &robot.loops {
        draft.close(given, &mut names)?;
    }
    for closure in &options.closures {
        draft.close_by(closure, &mut names).map_err(|error| error.under("--close"))?;
    }
    for motor in &robot.motors {
        draft.motor(motor, &mut names);
    }
    draft.add_bodies();
    let mut left_out = left_out(robot, tree, &draft);
    left_out.extend(names.changed.iter().map(|(old, new)| format!("the name `{old}`, now `{new}`")));
    let scene = draft.scene(options);
    let warnings = doubts(robot).into_iter().chain(draft.warnings).collect();
    Ok(Imported { scene, left_out, warnings })
}

#[derive(Default)]
struct Lists {
    bodies: Vec<Value>,
    joints: Vec<Value>,
    forces: Vec<Value>,
    inputs: Vec<Value>,
    outputs: Vec<Value>,
    initial: Map<String, Value>,
}

/// The joints of the robot in the scene.
#[derive(Default)]
struct Joints {
    names: Vec<String>,
    /// Markers of each joint in the parent and in the child; empty where it has none.
    between: Vec<[String; 2]>,
    /// True for those whose coordinate follows that of another.
    follows: Vec<bool>,
}

struct Draft<'a> {
    robot: &'a Robot<'a>,
    tree: &'a Tree,
    is_free: bool,
    /// Names of the links in the scene.
    links: Vec<String>,
    /// Markers of the body that each link is the first of.
    markers: Vec<Map<String, Value>>,
    joints: Joints,
    /// Links without mass and inertia that are bodies which move.
    massless: Vec<String>,
    warnings: Vec<String>,
    scene: Lists,
}

impl<'a> Draft<'a> {
    fn new(robot: &'a Robot, tree: &'a Tree, options: &Options, names: &mut UniqueNames) -> Self {
        let mut follows = vec![false; robot.joints.len()];
        robot.couplings.iter().for_each(|coupling| follows[coupling.follower] = true);
        Draft {
            robot,
            tree,
            is_free: options.is_free,
            links: robot.links.iter().map(|link| names.unique(&link.name)).collect(),
            markers: vec![Map::new(); robot.links.len()],
            joints: Joints { follows, ..Joints::default() },
            massless: Vec::new(),
            warnings: Vec::new(),
            scene: Lists::default(),
        }
    }

    fn is_ground(&self, body: usize) -> bool {
        body == self.tree.base && !self.is_free
    }

    /// Frame of a link in its body.
    fn in_body(&self, link: usize) -> Transform {
        self.tree.frames[self.tree.body[link]].inverse().then(&self.tree.frames[link])
    }

    /// Links that are held together with another have a marker of their name; points of interest have one each.
    fn mark_links(&mut self, names: &mut UniqueNames) {
        for (link, given) in self.robot.links.iter().enumerate() {
            if self.tree.body[link] != link {
                let name = self.links[link].clone();
                self.mark(link, &Transform::default(), &name);
            }
            for (name, frame) in &given.markers {
                self.mark(link, frame, &names.unique(name));
            }
        }
    }

    /// Adds a marker at a frame of a link; returns its full name.
    fn mark(&mut self, link: usize, frame: &Transform, name: &str) -> String {
        let place = marker(&self.in_body(link).then(frame));
        let body = self.tree.body[link];
        self.markers[body].insert(name.to_string(), place);
        let owner = if self.is_ground(body) { "ground" } else { &self.links[body] };
        format!("{owner}.{name}")
    }

    fn scene(&mut self, options: &Options) -> Value {
        let lists = std::mem::take(&mut self.scene);
        let mut scene = json!({
            "name": UniqueNames::default().unique(&self.robot.name),
            "about": about(self.robot, options),
            "dimension": 3,
            "gravity": self.robot.gravity.map(whole),
            "bodies": lists.bodies,
            "joints": lists.joints,
            "forces": lists.forces,
            "outputs": lists.outputs,
            "simulation": { "t_end": 1 },
        });
        if !lists.inputs.is_empty() {
            scene["inputs"] = Value::Array(lists.inputs);
        }
        if !self.is_free {
            scene["ground"] = json!({ "markers": self.markers[self.tree.base] });
        }
        // Of loops at most some of the coordinates can be given.
        let has_loops = !options.closures.is_empty() || !self.robot.loops.is_empty();
        if !has_loops && !lists.initial.is_empty() {
            scene["initial"] = Value::Object(lists.initial);
        }
        scene
    }
}

/// A number, without a point where it is zero.
fn whole(x: f64) -> Value {
    if x == 0.0 { json!(0) } else { json!(x) }
}

/// A frame whose z axis is along `axis`.
fn aimed(axis: [f64; 3]) -> Result<Transform> {
    Ok(Transform { r: [0.0; 3], turn: quaternion_from_axes(&aim(Some(axis), None)?) })
}

fn marker(frame: &Transform) -> Value {
    if *frame == (Transform { r: frame.r, ..Transform::default() }) {
        return json!(frame.r);
    }
    json!({ "position": frame.r, "rotation": frame.turn })
}
