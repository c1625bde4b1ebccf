//! What one run of the full model tells about its parts.

use super::recorded::Recorded;
use super::source::Source;
use crate::body::{Energy, Frame, dot, in_space};
use crate::formulation::Dynamics;
use crate::linearize::State;
use crate::math::Taylor;
use crate::math::array::{Each, from_fn};
use crate::prepared::{AnyMechanism, Model};
use crate::scene::document::{self, carrier, find, is_rigid, text};
use crate::study::Watched;
use crate::system::{Mechanism, Need, OperatingPoint, Scratch, Terms, Theory};
use serde_json::{Map, Value, json};

/// The largest number of states that the estimates look at.
const STATES: usize = 200;
/// The largest number of them at which derivatives and changed models are evaluated.
const FEW: usize = 25;

/// The full model and states along its motion.
pub struct Facts {
    /// The scene.
    pub source: Source,
    /// The scene ready to run.
    pub prepared: Model,
    /// Names of the outputs that the promise is about.
    pub watched: Vec<String>,
    states: Vec<State>,
    /// Placements of all markers, a row for each state.
    placed: Vec<Vec<PlacedMarker>>,
    /// Kinetic energy of each body of the model at each state, J.
    kinetic: Vec<Vec<f64>>,
    /// Rows of G that were found redundant.
    pub redundant: Vec<usize>,
    /// False where the states are small motions about the start, which tell nothing about work.
    is_motion: bool,
}

/// Position and axes of a marker in the world.
#[derive(Clone, Copy, Debug)]
pub struct PlacedMarker {
    /// Origin, m.
    pub r: [f64; 3],
    /// Unit axes.
    pub axes: [[f64; 3]; 3],
    /// Angle in the plane, rad.
    pub turn: f64,
    /// Velocity of the origin, m/s.
    pub velocity: [f64; 3],
    /// Angular velocity in the world, rad/s.
    pub spin: [f64; 3],
}

impl PlacedMarker {
    /// A marker of a scene at this place.
    pub fn marker(&self, dimension: usize) -> Value {
        match dimension {
            2 => json!({ "position": self.r[..2], "angle": self.turn }),
            _ => json!({ "position": self.r, "z_axis": self.axes[2], "x_axis": self.axes[0] }),
        }
    }
}

impl Facts {
    /// Facts from a recorded run of the model.
    pub fn new(source: Source, prepared: Model, watched: Vec<String>, recorded: Recorded) -> Facts {
        let Recorded { states, redundant, .. } = recorded;
        let stride = states.len().div_ceil(STATES).max(1);
        let states: Vec<State> = states.into_iter().step_by(stride).collect();
        Facts { is_motion: true, ..Facts::at_start(source, prepared, watched, states, redundant) }
    }

    /// Facts from small motions about the start, the first of `states`.
    pub(super) fn at_start(
        source: Source,
        prepared: Model,
        watched: Vec<String>,
        states: Vec<State>,
        redundant: Vec<usize>,
    ) -> Facts {
        let (placed, kinetic) = match &prepared.mechanism {
            AnyMechanism::Planar(mechanism) => seen(mechanism, &states),
            AnyMechanism::Spatial(mechanism) => seen(mechanism, &states),
        };
        Facts { source, prepared, watched, states, placed, kinetic, redundant, is_motion: false }
    }

    /// The scene as JSON.
    pub fn scene(&self) -> &Value {
        &self.source.scene
    }

    /// 2 in the plane, 3 in space.
    pub fn dimension(&self) -> usize {
        self.prepared.mechanism.dimension()
    }

    /// Value of a number of the scene.
    pub fn number(&self, value: &Value) -> Option<f64> {
        document::value(value, &self.prepared.parameters)
    }

    /// Largest kinetic energy of a body, nodes of an absolute beam taken together, relative to that of all.
    pub fn kinetic_share(&self, body: &str) -> f64 {
        let names = &self.prepared.mechanism.markers().body_names;
        let own: Vec<bool> = names.iter().map(|name| carrier(name) == body).collect();
        let of = |row: &Vec<f64>| row.iter().zip(&own).filter(|(_, own)| **own).map(|(energy, _)| energy).sum();
        let all = self.kinetic_energy();
        if all > 0.0 { self.kinetic.iter().map(of).fold(0.0, f64::max) / all } else { 1.0 }
    }

    /// Largest kinetic energy of all bodies, J.
    pub fn kinetic_energy(&self) -> f64 {
        self.kinetic.iter().map(|row| row.iter().sum()).fold(0.0, f64::max)
    }

    /// Placements of a marker along the motion.
    pub fn path(&self, marker: &str) -> Option<Vec<PlacedMarker>> {
        let marker = self.marker(marker)?;
        Some(self.placed.iter().map(|row| row[marker]).collect())
    }

    /// Placement of a marker at the start.
    pub fn place(&self, marker: &str) -> Option<PlacedMarker> {
        Some(self.placed.first()?[self.marker(marker)?])
    }

    fn marker(&self, name: &str) -> Option<usize> {
        marker(&self.prepared, name)
    }

    /// The element of this name in a list of the scene.
    pub fn element(&self, list: &str, name: &str) -> Option<&Value> {
        find(self.scene(), list, name)
    }

    /// Start of a rigid body or point mass as assembled: the keys of its `initial`.
    pub fn initial(&self, body: &str) -> Option<Value> {
        let body = self.element("bodies", body)?;
        initial(&self.prepared, self.states.first()?, self.placed.first()?, body)
    }

    /// Largest displacement of a beam in a floating frame relative to its length.
    pub fn deformation(&self, beam: &str) -> Option<f64> {
        let system = self.prepared.system();
        let limited = system.facts().limited.clone();
        let is_own = |part: &crate::system::Limited| part.part == beam && part.theory == Theory::SmallDisplacements;
        let place = limited.iter().position(is_own)?;
        let mut now = vec![0.0; limited.len()];
        let at = |state: &State| {
            system.deformations(&state.q, &mut now);
            now[place]
        };
        Some(self.states.iter().map(at).fold(0.0, f64::max))
    }

    /// The states: those of [`path`](Self::path).
    pub fn states(&self) -> &[State] {
        &self.states
    }

    /// A few states along the recorded motion.
    pub fn few_states(&self) -> impl Iterator<Item = &State> {
        self.states.iter().step_by(self.states.len().div_ceil(FEW).max(1))
    }

    /// Values of the watched outputs that a model gives to a few states of the recorded motion; `None` where it has
    /// other coordinates, or no accelerations there.
    pub fn at_once(&self, model: &AnyMechanism) -> Option<Vec<Vec<f64>>> {
        let own = self.prepared.system().facts().names.clone();
        let other = model.system().facts().names.clone();
        (own.q == other.q && own.v == other.v).then(|| self.read(model, &self.watched, self.few_states())).flatten()
    }

    /// Values of outputs that a model of the same coordinates gives to states; `None` where it has no such outputs, or no
    /// accelerations there.
    pub fn read<'a>(
        &'a self,
        model: &AnyMechanism,
        outputs: &[String],
        states: impl Iterator<Item = &'a State>,
    ) -> Option<Vec<Vec<f64>>> {
        let system = model.system();
        let watched = Watched::new(system, outputs).ok()?;
        let mut dynamics = Dynamics::new(system);
        let mut scratch = Scratch::default();
        let read = |State { t, q, v }: &State| {
            dynamics.solve(*t, q, v, |_, _| 0.0).ok()?;
            let vdot = &dynamics.vdot;
            let lambda = &dynamics.lambda;
            Some(watched.read(system, (OperatingPoint { t: *t, q, v, vdot, lambda }, &[]), &mut scratch))
        };
        states.map(read).collect()
    }

    /// Work on the recorded motion of the forces that a change adds or takes away, at most over time, relative to the
    /// energy that the motion turns over; `None` where the change alters the coordinates, and where no motion is known.
    pub fn work_share(&self, edited: &Value) -> Option<f64> {
        let edited = self.source.prepare(edited).ok().filter(|_| self.is_motion)?;
        let systems = [self.prepared.system(), edited.system()];
        let [own, other] = systems.map(|system| system.facts().names.clone());
        if own.q != other.q || own.v != other.v {
            return None;
        }
        let mut scratch = [Scratch::default(), Scratch::default()];
        let mut terms = systems.map(Terms::new);
        let mut work = 0.0;
        let mut most = 0.0f64;
        let mut before = None;
        for state in &self.states {
            for ((system, terms), scratch) in systems.iter().zip(&mut terms).zip(&mut scratch) {
                system.evaluate(state.t, &state.q, &state.v, Need::FORCE, terms, scratch);
            }
            let [own, other] = [&terms[0].f, &terms[1].f];
            let power: f64 = own.iter().zip(other).zip(&state.v).map(|((own, other), v)| (own - other) * v).sum();
            if let Some((t, last)) = before.replace((state.t, power)) {
                work += 0.5 * (state.t - t) * (power + last);
                most = most.max(work.abs());
            }
        }
        Some(most / self.turnover()).filter(|share| share.is_finite())
    }

    /// The larger of the swings of the kinetic energy and of the potential, J: that of a car that rolls on is turned over
    /// by nothing.
    pub(super) fn turnover(&self) -> f64 {
        let system = self.prepared.system();
        let mut scratch = Scratch::default();
        let energy = |state: &State| system.energy(state.t, &state.q, &state.v, &mut scratch);
        let all: Vec<_> = self.states.iter().filter_map(energy).collect();
        let swing = |of: fn(&Energy) -> f64| {
            let values = || all.iter().map(of);
            values().fold(f64::MIN, f64::max) - values().fold(f64::MAX, f64::min)
        };
        swing(|energy| energy.kinetic).max(swing(|energy| energy.potential))
    }
}

/// `initial` of a rigid body or point mass at a state with these places of markers; none of another.
pub fn initial(prepared: &Model, state: &State, places: &[PlacedMarker], body: &Value) -> Option<Value> {
    let name = text(body, "name");
    let kind = text(body, "type");
    if !is_rigid(body) {
        return None;
    }
    let dimension = prepared.mechanism.dimension();
    let PlacedMarker { r, axes, turn, velocity, spin } = *places.get(marker(prepared, name)?)?;
    let mut start = Map::new();
    start.insert("position".to_string(), json!(r[..dimension]));
    start.insert("velocity".to_string(), json!(velocity[..dimension]));
    if kind == "rigid" && dimension == 2 {
        start.insert("angle".to_string(), json!(turn));
        start.insert("angular_velocity".to_string(), json!(spin[2]));
    } else if kind == "rigid" {
        let names = prepared.system().facts().names.q.clone();
        match names.iter().position(|own| *own == format!("{name}.qw")) {
            Some(first) => drop(start.insert("rotation".to_string(), json!(state.q.get(first..first + 4)?))),
            // The rotation from which its coordinates count.
            None => {
                let given = body["initial"].as_object().into_iter().flatten();
                let kept = given.filter(|(key, _)| ["rotation", "z_axis", "x_axis"].contains(&key.as_str()));
                start.extend(kept.map(|(key, value)| (key.clone(), value.clone())));
            }
        }
        start.insert("angular_velocity".to_string(), json!(axes.each(|axis| dot(&axis, &spin))));
    }
    Some(Value::Object(start))
}

/// Index of a marker, or of the frame of a body, among all markers.
pub(super) fn marker(prepared: &Model, name: &str) -> Option<usize> {
    prepared.mechanism.markers().find(name).ok()
}

/// Placements of all markers at a state.
pub(super) fn placed(prepared: &Model, state: &State) -> Vec<PlacedMarker> {
    let mut scratch = Scratch::default();
    match &prepared.mechanism {
        AnyMechanism::Planar(mechanism) => places(mechanism, state, &mut scratch),
        AnyMechanism::Spatial(mechanism) => places(mechanism, state, &mut scratch),
    }
}

fn places<const D: usize>(mechanism: &Mechanism<D>, state: &State, scratch: &mut Scratch) -> Vec<PlacedMarker> {
    let frames = mechanism.frames(&state.q, &state.v, scratch);
    let axis = |axes: &[[f64; D]; D], i: usize| if i < D { in_space(&axes[i]) } else { [0.0, 0.0, 1.0] };
    let place = |moving: &Frame<Taylor<f64>, D>| {
        let frame = moving.map(|x| x.x);
        let velocity = in_space(&moving.velocity());
        let spin = moving.angular_velocity();
        let axes = from_fn(|i| axis(&frame.axes, i));
        PlacedMarker { r: in_space(&frame.r), axes, turn: frame.turn, velocity, spin }
    };
    frames.iter().map(place).collect()
}

type StateFacts = (Vec<Vec<PlacedMarker>>, Vec<Vec<f64>>);

/// Placements of the markers and kinetic energies of the bodies at each state.
fn seen<const D: usize>(mechanism: &Mechanism<D>, states: &[State]) -> StateFacts {
    let mut scratch = Scratch::default();
    let model = mechanism.model();
    let kinetic = |state: &State| -> Vec<f64> {
        let of = |part: &crate::scene::Part<D>| {
            let q = part.coordinates(&state.q);
            let v = part.velocities(&state.v);
            part.body.energy(q, v, &model.gravity).kinetic
        };
        model.bodies.iter().map(of).collect()
    };
    let kinetic = states.iter().map(kinetic).collect();
    (states.iter().map(|state| places(mechanism, state, &mut scratch)).collect(), kinetic)
}
