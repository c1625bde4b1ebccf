//! What is moved in a motion nearby.

use super::candidates::Plane;
use super::displaced::{angle, further, progress, slide, start_at, wrapped};
use super::facts::{Facts, PlacedMarker, placed};
use super::source::Source;
use crate::body::dot;
use crate::linearize::State;
use crate::math::array::{Each, from_fn};
use crate::math::random::Random;
use crate::prepared::Model;
use crate::scene::document::{
    elements, elements_mut, find_mut, is_rigid, mentions, multiply, multiply_velocities, number, pair, take, text,
};
use crate::system::Scratch;
use crate::tolerances::SAME;
use rayon::prelude::*;
use serde_json::{Value, json};

/// What of the full model can be moved.
pub struct Movable<'a> {
    source: &'a Source,
    facts: &'a Facts,
    /// Numbers among its parameters.
    pub parameters: Vec<String>,
    /// True if it has velocities at the start.
    pub velocities: bool,
    /// True if it can start elsewhere.
    pub positions: bool,
    /// Inputs with values, and signals.
    pub inputs: Vec<String>,
    /// Points of the signals that are in files.
    points: Vec<(String, Value)>,
    /// How far the bodies have gone by each state, as part of what they do at most.
    progress: Vec<f64>,
}

/// How far it is moved.
#[derive(Default)]
pub struct Move {
    parameters: Vec<f64>,
    velocities: f64,
    inputs: f64,
    /// Change of each joint coordinate that the scene gives at the start.
    joints: Vec<(String, f64)>,
    /// Start of each body as assembled; none where positions stay.
    starts: Vec<(String, PlacedMarker)>,
}

impl<'a> Movable<'a> {
    /// What the model can be built with at both ends of its range.
    pub fn new(source: &'a Source, facts: &'a Facts, by: f64) -> Movable<'a> {
        let scene = &source.scene;
        let points = elements(scene, "signals").iter().filter_map(|signal| points(facts, signal)).collect();
        let velocities = facts.prepared.start().1.iter().any(|v| *v != 0.0);
        let progress = progress(facts);
        let mut all = Movable {
            source,
            facts,
            parameters: Vec::new(),
            velocities,
            positions: false,
            inputs: Vec::new(),
            points,
            progress,
        };
        all.parameters = all.movable_parameters(by);
        let given = elements(scene, "inputs").iter().filter(|input| input.get("value").is_some());
        let names = given.chain(elements(scene, "signals")).map(|element| text(element, "name").to_string());
        all.inputs = names.collect();
        let inputs = |inputs: f64| Move { inputs, ..Move::default() };
        if !all.inputs.is_empty() && ![by, -by].iter().all(|u| all.builds(&inputs(*u))) {
            all.inputs.clear();
        }
        // Assembly closes joints by what gives way: beams would start strained.
        all.positions = elements(scene, "bodies").iter().all(is_rigid)
            && [by, -by].iter().all(|u| all.restarted(scene, Move::default(), *u).is_ok());
        all
    }

    /// True if there is nothing.
    pub fn is_empty(&self) -> bool {
        self.parameters.is_empty() && !self.velocities && !self.positions && self.inputs.is_empty()
    }

    fn builds(&self, change: &Move) -> bool {
        self.source.prepare(&self.moved(&self.source.scene, change)).is_ok()
    }

    /// Numbers of elements and modes stay.
    fn movable_parameters(&self, by: f64) -> Vec<String> {
        let scene = &self.source.scene;
        let numbers = scene["parameters"].as_object().into_iter().flatten();
        let numbers =
            numbers.filter(|(_, value)| value.as_f64().is_some_and(|value| value != 0.0)).map(|(name, _)| name);
        let counts = |name: &str| {
            let bodies = elements(scene, "bodies").iter();
            bodies.flat_map(|body| [&body["elements"], &body["modes"]]).any(|count| mentions(count, name))
        };
        let builds = |name: &str, u: f64| {
            let mut scene = scene.clone();
            move_parameter(&mut scene, name, u);
            self.source.prepare(&scene).is_ok()
        };
        let is_possible = |name: &&String| !counts(name) && builds(name, by) && builds(name, -by);
        numbers.collect::<Vec<_>>().into_par_iter().filter(is_possible).cloned().collect()
    }

    /// The motion of this number, and the scene of the full model.
    ///
    /// # Errors
    /// Reason why that cannot start so.
    pub fn draw(&self, sample: u64, by: f64) -> Result<(Move, Value), String> {
        let mut random = Random(1 + sample);
        let mut next = || by * random.uniform();
        let parameters = self.parameters.iter().map(|_| next()).collect();
        let [velocities, start, inputs] = [next(), next(), next()];
        let change = Move { parameters, velocities, inputs, ..Move::default() };
        if self.positions {
            self.restarted(&self.source.scene, change, start)
        } else {
            let scene = self.moved(&self.source.scene, &change);
            Ok((change, scene))
        }
    }

    /// The change with a start that is `u` of the way further, and the scene of the full model with both.
    fn restarted(&self, scene: &Value, mut change: Move, u: f64) -> Result<(Move, Value), String> {
        let start = |scene: &Value| self.source.prepare(scene).map_err(|error| format!("{error:#}"));
        let first = start(&self.moved(scene, &change))?;
        let before = self.places(&first);
        let (state, part) = self.ahead(u).ok_or("nothing moves")?;
        change.joints = self.joints(state, part).ok_or("a coordinate at the start cannot be moved")?;
        let ahead = |(name, place): (String, PlacedMarker)| {
            let path = self.facts.path(&name)?;
            let place = further(&place, &path[0], path.get(state)?, part);
            Some((name, place))
        };
        change.starts = before.clone().into_iter().filter_map(ahead).collect();
        let there = start(&self.moved(scene, &change))?;
        // Assembly closes joints, and may strain springs by that.
        let energies = potential(&first).zip(potential(&there));
        if energies.is_some_and(|(first, there)| (there - first).abs() > self.facts.turnover()) {
            return Err("springs would be strained".to_string());
        }
        // As assembled, so that every model starts there.
        change.starts = self.places(&there);
        let near = |own: &[f64; 3], other: &[f64; 3]| own.iter().zip(other).all(|(x, y)| (x - y).abs() <= SAME);
        let is_there = |((_, own), (_, other)): (&(String, PlacedMarker), &(String, PlacedMarker))| {
            near(&own.r, &other.r) && own.axes.iter().zip(&other.axes).all(|(own, other)| near(own, other))
        };
        if before.iter().zip(&change.starts).all(is_there) {
            return Err("the joints do not let it move".to_string());
        }
        let scene = self.moved(scene, &change);
        Ok((change, scene))
    }

    /// Start of the bodies.
    fn places(&self, prepared: &Model) -> Vec<(String, PlacedMarker)> {
        let all = placed(prepared, &State::start(prepared));
        let names = elements(&self.source.scene, "bodies").iter().map(|body| text(body, "name"));
        names.filter_map(|name| Some((name.to_string(), *all.get(super::facts::marker(prepared, name)?)?))).collect()
    }

    /// The first state at which the bodies have gone that far, and the part of the way there; less than 0 for back.
    fn ahead(&self, u: f64) -> Option<(usize, f64)> {
        let state = self.progress.iter().position(|part| *part > 0.0 && *part >= u.abs())?;
        Some((state, u / self.progress[state]))
    }

    /// Change of the joint coordinates that the scene gives at the start, by a `fraction` of that until a state; `None`
    /// where it is not known.
    fn joints(&self, state: usize, fraction: f64) -> Option<Vec<(String, f64)>> {
        let given = self.source.scene["initial"].as_object().into_iter().flatten().map(|(key, _)| key);
        let change = |key: &String| Some((key.clone(), fraction * self.joint_change(key, state)?));
        given.filter(|key| !key.ends_with('\'')).map(change).collect()
    }

    /// Change of the joint coordinate `key` from the start to a state; `None` where it is not known.
    fn joint_change(&self, key: &str, state: usize) -> Option<f64> {
        let (joint, coordinate) = key.split_once('.')?;
        let joint = self.facts.element("joints", joint).filter(|joint| joint.get("axis").is_none())?;
        let [one, other] = pair(joint)?;
        let one = self.facts.path(one)?;
        let other = self.facts.path(other)?;
        let first = [one[0], other[0]];
        let now = [*one.get(state)?, *other.get(state)?];
        match coordinate {
            "angle" => Some(wrapped(angle(&now) - angle(&first))),
            "position" => {
                let along = if self.facts.dimension() == 2 { 0 } else { 2 };
                Some(slide(&now, along) - slide(&first, along))
            }
            _ => None,
        }
    }

    /// A scene, the richest or a simpler one, so moved.
    pub fn moved(&self, scene: &Value, change: &Move) -> Value {
        let mut scene = scene.clone();
        for (name, u) in self.parameters.iter().zip(&change.parameters) {
            move_parameter(&mut scene, name, *u);
        }
        if change.velocities != 0.0 {
            multiply_velocities(&mut scene, 1.0 + change.velocities);
        }
        if change.inputs != 0.0 {
            self.scale_inputs(&mut scene, 1.0 + change.inputs);
        }
        for (key, change) in &change.joints {
            if let Some(value) = scene.get_mut("initial").and_then(|initial| initial.get_mut(key)) {
                *value = json!(format!("({}) + {change}", number(value)));
            }
        }
        let dimension = if scene["dimension"] == 2 { 2 } else { 3 };
        for (name, place) in &change.starts {
            let place = self.seen(name, place, dimension);
            if let (Ok(body), Some(place)) = (find_mut(&mut scene, "bodies", name), place) {
                start_at(body, &place, dimension);
            }
        }
        scene
    }

    /// The place of a body in a scene of so many dimensions: in the plane that a mechanism in space moves in.
    fn seen(&self, body: &str, place: &PlacedMarker, dimension: usize) -> Option<PlacedMarker> {
        if dimension == self.facts.dimension() {
            return Some(*place);
        }
        let plane = Plane::new(self.facts);
        let start = self.facts.place(body)?;
        let own = plane.seen_from(body, &start)[0];
        let flat = |vector: &[f64; 3]| plane.axes.each(|axis| dot(&axis, vector));
        let direction =
            |place: &PlacedMarker| -> [f64; 3] { from_fn(|i| (0..3).map(|k| own[k] * place.axes[k][i]).sum()) };
        let before = plane.angle(&direction(&start));
        let now = plane.angle(&direction(place));
        Some(PlacedMarker {
            r: flat(&place.r),
            turn: before + wrapped(now - before),
            velocity: flat(&place.velocity),
            spin: flat(&place.spin),
            ..*place
        })
    }

    fn scale_inputs(&self, scene: &mut Value, factor: f64) {
        for input in elements_mut(scene, "inputs") {
            input.get_mut("value").into_iter().for_each(|value| multiply(value, factor));
        }
        for signal in elements_mut(scene, "signals") {
            if let Some((_, points)) = self.points.iter().find(|(name, _)| *name == text(signal, "name"))
                && signal.get("points").is_none()
            {
                signal["points"] = points.clone();
                ["file", "columns"].iter().for_each(|key| drop(take(signal, key)));
            }
            elements_mut(signal, "points")
                .filter_map(|point| point.get_mut(1))
                .for_each(|value| multiply(value, factor));
        }
    }
}

/// Potential energy at the start, J.
fn potential(prepared: &Model) -> Option<f64> {
    let ((q, v), t) = (prepared.start(), prepared.start_time());
    Some(prepared.system().energy(t, q, v, &mut Scratch::default())?.potential)
}

/// Points of a signal that is in a file.
fn points(facts: &Facts, signal: &Value) -> Option<(String, Value)> {
    let name = text(signal, "name");
    let _ = signal.get("file")?;
    let signal = facts.prepared.parameters.signals().iter().find(|signal| signal.name() == name)?;
    let points: Vec<[f64; 2]> = signal.knots().iter().map(|x| [*x, signal.apply(*x)]).collect();
    Some((name.to_string(), json!(points)))
}

fn move_parameter(scene: &mut Value, name: &str, u: f64) {
    let value = scene["parameters"][name].as_f64().unwrap_or(0.0);
    scene["parameters"][name] = json!(value * (1.0 + u));
}
