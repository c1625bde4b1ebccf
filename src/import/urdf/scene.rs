//! The scene of a robot.

use super::close::Closure;
use super::names::Names;
use super::read::{Kind, Link, Mimic, Robot};
use super::transform::Transform;
use super::tree::{Tree, find};
use super::{Imported, Options};
use crate::body::{MassProperties, aim};
use crate::error::{Error, Result, excerpt, short_list, suggest};
use crate::math::rotation::{Matrix3, quaternion_from_axes};
use serde_json::{Map, Value, json};
use std::array::from_fn;
use std::collections::BTreeMap;

/// The scene at the positions of the joints, with what was left out.
pub fn build(robot: &Robot, tree: &Tree, options: &Options) -> Result<Imported> {
    let mut names = Names::default();
    let links: Vec<String> = robot.links.iter().map(|link| names.unique(&link.name)).collect();
    let mut draft = Draft {
        robot,
        tree,
        is_free: options.is_free,
        links,
        markers: vec![Map::new(); robot.links.len()],
        scene: Lists::default(),
    };
    draft.mark_merged_links();
    let joints: Vec<String> = robot.joints.iter().map(|joint| names.unique(&joint.name)).collect();
    for (index, name) in joints.iter().enumerate() {
        draft.joint(index, name)?;
    }
    for (index, mimic) in robot.joints.iter().enumerate().filter_map(|(i, joint)| Some((i, joint.mimic.as_ref()?))) {
        let name = names.unique(&format!("{}_mimic", joints[index]));
        draft.mimic(index, mimic, &joints, &name)?;
    }
    for closure in &options.closures {
        let name = names.unique(&closure.name);
        draft.close(closure, &name).map_err(|error| error.under("--close"))?;
    }
    let mut left_out = left_out(robot, tree, &draft);
    left_out.extend(names.changed.iter().map(|(old, new)| format!("the name `{old}`, now `{new}`")));
    Ok(Imported { scene: draft.scene(options), left_out })
}

/// Elements of the scene so far.
#[derive(Default)]
struct Lists {
    joints: Vec<Value>,
    forces: Vec<Value>,
    outputs: Vec<Value>,
    initial: Map<String, Value>,
}

struct Draft<'a> {
    robot: &'a Robot,
    tree: &'a Tree,
    is_free: bool,
    /// Names of the links in the scene.
    links: Vec<String>,
    /// Markers of the body that each link is the first of.
    markers: Vec<Map<String, Value>>,
    scene: Lists,
}

impl Draft<'_> {
    fn is_ground(&self, body: usize) -> bool {
        body == self.tree.base && !self.is_free
    }

    /// Frame of a link in its body.
    fn in_body(&self, link: usize) -> Transform {
        self.tree.frames[self.tree.body[link]].inverse().then(&self.tree.frames[link])
    }

    /// Links that are held together with another have a marker of their name.
    fn mark_merged_links(&mut self) {
        for link in (0..self.links.len()).filter(|link| self.tree.body[*link] != *link) {
            let (marker, name) = (marker(&self.in_body(link)), self.links[link].clone());
            self.markers[self.tree.body[link]].insert(name, marker);
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

    fn joint(&mut self, index: usize, name: &str) -> Result<()> {
        let (joint, [parent, child]) = (&self.robot.joints[index], self.tree.ends[index]);
        let kind = match joint.kind {
            Kind::Fixed | Kind::Floating => return Ok(()),
            Kind::Revolute => "revolute",
            Kind::Prismatic => "prismatic",
            Kind::Planar => "planar",
        };
        let turned = aimed(joint.axis).map_err(|error| error.element(&joint.name).placed(joint.place))?;
        let between = [self.mark(parent, &joint.origin.then(&turned), name), self.mark(child, &turned, name)];
        let [from, to] = &between;
        self.scene.joints.push(json!({ "name": name, "type": kind, "between": between }));
        let mut output = json!({ "name": name, "measure": "angle", "of": to, "relative_to": from });
        match joint.kind {
            Kind::Revolute if joint.damping > 0.0 => self
                .scene
                .forces
                .push(json!({ "name": name, "type": "torsion_spring", "between": between, "damping": joint.damping })),
            Kind::Prismatic => {
                (output["measure"], output["component"]) = (json!("position"), json!("z"));
                if joint.damping > 0.0 {
                    let along = [json!(0), json!(0), json!(format!("-({})*{name}'", joint.damping))];
                    self.scene.forces.push(json!({ "name": name, "type": "applied_force", "at": to, "axes": "marker",
                        "force": along, "reaction_on": from }));
                }
            }
            Kind::Planar => return Ok(()),
            _ => {}
        }
        let coordinate = if joint.kind == Kind::Revolute { "angle" } else { "position" };
        let position = self.tree.positions[index];
        let position = if position == 0.0 { json!(0) } else { json!(position) };
        self.scene.initial.insert(format!("{name}.{coordinate}"), position);
        self.scene.outputs.push(output);
        Ok(())
    }

    /// Adds the equation of a joint whose coordinate follows that of another.
    fn mimic(&mut self, index: usize, mimic: &Mimic, names: &[String], name: &str) -> Result<()> {
        let Mimic { joint, multiplier, offset } = mimic;
        let (own, all) = (&self.robot.joints[index], &self.robot.joints);
        let place = |error: Error| error.element(&own.name).placed(own.place);
        let of = all.iter().position(|known| known.name == *joint).ok_or_else(|| {
            let hint = suggest(joint, all.iter().map(|known| known.name.as_str()));
            place(Error::input(format!("it mimics `{}`, which is no joint", excerpt(joint))).hint(hint))
        })?;
        if let Some(other) = [own, &all[of]].into_iter().find(|joint| !joint.has_coordinate()) {
            let message = format!("it mimics another joint, and `{}` has no coordinate", other.name);
            return Err(place(Error::input(message).hint("joints that turn or slide mimic others of these")));
        }
        let expression = format!("{} - ({multiplier})*{} - ({offset})", names[index], names[of]);
        self.scene.joints.push(json!({ "name": name, "type": "equation", "expression": expression }));
        let start = format!("{}.", names[index]);
        self.scene.initial.retain(|coordinate, _| !coordinate.starts_with(&start));
        Ok(())
    }

    fn close(&mut self, closure: &Closure, name: &str) -> Result<()> {
        let [(a, at_a), (b, at_b)] = &closure.ends;
        let [a, b] = [find(self.robot, a)?, find(self.robot, b)?];
        if self.tree.body[a] == self.tree.body[b] {
            return Err(Error::input(format!("`{}` and `{}` are one body", closure.ends[0].0, closure.ends[1].0))
                .hint("name links that joints let move"));
        }
        let axes = aimed(closure.axis)?;
        // The same axes in the world at position zero, so that positions of joints change the guess alone.
        let turned = self.tree.at_zero[b].inverse().then(&self.tree.at_zero[a]).then(&axes);
        let between = [
            self.mark(a, &Transform { r: *at_a, ..axes }, name),
            self.mark(b, &Transform { r: *at_b, ..turned }, name),
        ];
        self.scene.joints.push(json!({ "name": name, "type": closure.kind, "between": between }));
        Ok(())
    }

    fn members(&self, body: usize) -> impl Iterator<Item = (usize, &Link)> {
        self.robot.links.iter().enumerate().filter(move |(link, _)| self.tree.body[*link] == body)
    }

    /// Mass properties of a body from its origin, in its axes.
    fn mass_properties(&self, body: usize) -> MassProperties {
        let parts = self.members(body).filter_map(|(link, given)| {
            let inertial = given.inertial.as_ref()?;
            let frame = self.in_body(link).then(&inertial.origin);
            Some(MassProperties { mass: inertial.mass, centre: frame.r, inertia: turned(&inertial.inertia, &frame) })
        });
        MassProperties::sum(parts.collect())
    }

    fn body(&self, body: usize) -> Value {
        let MassProperties { mass, centre, inertia: j } = self.mass_properties(body);
        let place = self.tree.frames[body];
        json!({
            "name": self.links[body], "type": "rigid", "mass": mass,
            "inertia": [j[0][0], j[1][1], j[2][2], j[1][0], j[2][0], j[2][1]],
            "origin": centre.map(|x| -x),
            "markers": self.markers[body],
            "initial": { "position": place.r, "rotation": place.turn },
        })
    }

    /// First links of all bodies that move.
    fn bodies(&self) -> impl Iterator<Item = usize> {
        (0..self.links.len()).filter(|link| self.tree.body[*link] == *link && !self.is_ground(*link))
    }

    fn scene(&self, options: &Options) -> Value {
        let mut scene = json!({
            "name": Names::default().unique(&self.robot.name),
            "about": about(self.robot, options),
            "dimension": 3,
            "gravity": [0, 0, -9.81],
            "bodies": self.bodies().map(|body| self.body(body)).collect::<Vec<_>>(),
            "joints": self.scene.joints,
            "forces": self.scene.forces,
            "outputs": self.scene.outputs,
            "simulation": { "t_end": 1 },
        });
        if !self.is_free {
            scene["ground"] = json!({ "markers": self.markers[self.tree.base] });
        }
        // Of loops at most some of the coordinates can be given.
        if options.closures.is_empty() && !self.scene.initial.is_empty() {
            scene["initial"] = Value::Object(self.scene.initial.clone());
        }
        scene
    }
}

/// A frame whose z axis is along `axis`.
fn aimed(axis: [f64; 3]) -> Result<Transform> {
    Ok(Transform { r: [0.0; 3], turn: quaternion_from_axes(&aim(Some(axis), None)?) })
}

fn marker(frame: &Transform) -> Value {
    match *frame == (Transform { r: frame.r, ..Transform::default() }) {
        true => json!(frame.r),
        false => json!({ "position": frame.r, "rotation": frame.turn }),
    }
}

/// A tensor given in the axes of a frame.
fn turned(tensor: &Matrix3, frame: &Transform) -> Matrix3 {
    let columns = tensor.map(|row| frame.rotated(&row));
    from_fn(|i| frame.rotated(&columns.map(|column| column[i])))
}

fn about(robot: &Robot, options: &Options) -> String {
    let meshes = robot.links.iter().filter(|link| !link.meshes.is_empty());
    let meshes: Vec<String> = meshes.map(|link| format!("{}: {}", link.name, link.meshes.join(", "))).collect();
    let told = if meshes.is_empty() { String::new() } else { format!(" Meshes, not used: {}.", meshes.join("; ")) };
    let given: Vec<String> =
        options.positions.iter().map(|given| format!("{} = {}", given.joint, given.value)).collect();
    let at = if given.is_empty() { String::new() } else { format!(" but {}", given.join(", ")) };
    format!("The robot {} from its URDF, joints at position zero{at}.{told}", robot.name)
}

/// What the scene does not have.
fn left_out(robot: &Robot, tree: &Tree, draft: &Draft) -> Vec<String> {
    let told = |names: Vec<String>, text: &str| (!names.is_empty()).then(|| format!("{text} {}", short_list(&names)));
    let damped = robot.joints.iter().filter(|joint| joint.damping > 0.0 && !joint.has_coordinate());
    let massless = draft.bodies().filter(|body| draft.mass_properties(*body).mass == 0.0);
    let fixed = robot.joints.iter().zip(&tree.ends).filter(|(joint, _)| joint.kind == Kind::Fixed);
    let fixed: Vec<String> = fixed.map(|(_, [_, child])| robot.links[*child].name.clone()).collect();
    [
        told(damped.map(|joint| joint.name.clone()).collect(), "damping of the joints"),
        told(
            massless.map(|body| robot.links[body].name.clone()).collect(),
            "mass, which the file does not give, of the links",
        ),
        told(fixed, "fixed joints: what they hold is one body, with markers for the links"),
        told(robot.unused.clone(), "elements"),
    ]
    .into_iter()
    .flatten()
    .chain(of_elements("joints", robot.joints.iter().map(|joint| (&joint.name, &joint.unused))))
    .chain(of_elements("links", robot.links.iter().map(|link| (&link.name, &link.unused))))
    .collect()
}

/// Elements of joints or links that are not used, with the names of those.
fn of_elements<'a>(what: &str, all: impl Iterator<Item = (&'a String, &'a Vec<String>)>) -> Vec<String> {
    let mut owners: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for (name, unused) in all {
        unused.iter().for_each(|tag| owners.entry(tag).or_default().push(name.clone()));
    }
    owners.iter().map(|(tag, names)| format!("{tag} of the {what} {}", short_list(names))).collect()
}
