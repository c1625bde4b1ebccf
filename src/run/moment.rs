//! A state of a motion with its names.

use crate::error::{Error, Result};
use crate::simulate::Observation;
use crate::system::{MechanicalSystem, Names, Need, OperatingPoint, Scratch, Terms};
use crate::trajectory::{on_pieces, recorded};
use nalgebra::DMatrix;
use std::sync::{Arc, Mutex, PoisonError};

/// A state of a motion with its accelerations, multipliers and outputs, which it gives by name.
#[derive(Clone, Debug)]
pub struct Moment {
    /// Time, s.
    pub t: f64,
    /// Coordinates, n_q.
    pub q: Vec<f64>,
    /// Velocities, n_v.
    pub v: Vec<f64>,
    /// Accelerations, n_v. Not a number in an input that is a function of the state, on which they depend.
    pub vdot: Vec<f64>,
    /// Multipliers, n_c. Not a number where `vdot` is not.
    pub lambda: Vec<f64>,
    /// Outputs, in their order, and the works since the start.
    pub outputs: Vec<f64>,
    labels: Arc<Labels>,
}

/// The names in a moment, and the first name that was asked for and is none of them.
#[derive(Debug, Default)]
struct Labels {
    names: Names,
    outputs: Vec<String>,
    /// Number of works, the last of the outputs.
    works: usize,
    unknown: Mutex<Option<String>>,
}

impl Moment {
    /// All values zero, with the names of a system.
    pub(super) fn of(system: &dyn MechanicalSystem) -> Self {
        let n = system.dimensions();
        let outputs: Vec<String> = recorded(system).into_iter().map(|column| column.name).collect();
        let facts = system.facts();
        let names = facts.names.clone();
        let works = facts.works.len();
        Moment {
            t: 0.0,
            q: vec![0.0; n.q],
            v: vec![0.0; n.v],
            vdot: vec![0.0; n.v],
            lambda: vec![0.0; n.lambda],
            outputs: vec![0.0; outputs.len()],
            labels: Arc::new(Labels { names, outputs, works, unknown: Mutex::default() }),
        }
    }

    /// The output of this name; not a number if there is none. In a function that a run calls, the run then ends with
    /// an error that names it.
    pub fn output(&self, name: &str) -> f64 {
        match self.labels.outputs.iter().position(|known| known == name) {
            Some(place) => self.outputs[place],
            None => self.refuse(name),
        }
    }

    /// The coordinate, velocity, multiplier or output of this name, as in the header of a trajectory; not a number if
    /// there is none, as in [`output`](Self::output).
    pub fn get(&self, name: &str) -> f64 {
        let Names { q, v, lambda } = &self.labels.names;
        let all = [(q, &self.q), (v, &self.v), (lambda, &self.lambda), (&self.labels.outputs, &self.outputs)];
        let find = |(names, values): (&Vec<String>, &Vec<f64>)| {
            names.iter().position(|known| known == name).map(|place| values[place])
        };
        all.into_iter().find_map(find).unwrap_or_else(|| self.refuse(name))
    }

    fn refuse(&self, name: &str) -> f64 {
        let mut unknown = self.labels.unknown.lock().unwrap_or_else(PoisonError::into_inner);
        unknown.get_or_insert_with(|| name.to_string());
        f64::NAN
    }

    /// M of this system at the state, n_v x n_v.
    pub fn mass(&self, system: &dyn MechanicalSystem) -> DMatrix<f64> {
        let terms = self.terms(system, Need::MASS);
        let pattern = &system.structure().mass;
        let mut mass = pattern.matrix(&terms.mass);
        for (&(i, j), value) in pattern.entries.iter().zip(&terms.mass).filter(|((i, j), _)| i != j) {
            mass[(j, i)] += value;
        }
        mass
    }

    /// G of this system at the state, n_c x n_v: the Jacobian of the constraints along the directions of v, with the
    /// nonholonomic rows last.
    pub fn g(&self, system: &dyn MechanicalSystem) -> DMatrix<f64> {
        system.structure().g.matrix(&self.terms(system, Need::G).g)
    }

    fn terms(&self, system: &dyn MechanicalSystem, need: Need) -> Terms {
        let mut terms = Terms::new(system);
        system.evaluate(self.t, &self.q, &self.v, need, &mut terms, &mut Scratch::default());
        terms
    }

    /// An error if a name was asked for that there is not.
    pub(super) fn check_names(&self) -> Result<()> {
        let unknown = self.labels.unknown.lock().unwrap_or_else(PoisonError::into_inner).take();
        let Some(name) = unknown else { return Ok(()) };
        let Names { q, v, lambda } = &self.labels.names;
        let known = self.labels.outputs.iter().chain(q).chain(v).chain(lambda);
        Err(Error::unknown("output or coordinate", &name, known.map(String::as_str)))
    }

    /// Reads a state of a run.
    pub(super) fn read(&mut self, system: &dyn MechanicalSystem, state: &Observation, scratch: &mut Scratch) {
        self.t = state.t;
        self.q.copy_from_slice(state.q);
        self.v.copy_from_slice(state.v);
        self.vdot.copy_from_slice(state.vdot);
        self.lambda.copy_from_slice(state.lambda);
        let first_work = self.outputs.len() - state.works.len();
        self.outputs[first_work..].copy_from_slice(state.works);
        on_pieces(state, scratch, |scratch| system.outputs(state.loaded(), &mut self.outputs[..first_work], scratch));
    }

    /// Reads a state whose accelerations are not known.
    pub(super) fn read_unloaded(
        &mut self,
        system: &dyn MechanicalSystem,
        at: (f64, &[f64], &[f64]),
        scratch: &mut Scratch,
    ) {
        let (t, q, v) = at;
        self.t = t;
        self.q.copy_from_slice(q);
        self.v.copy_from_slice(v);
        self.vdot.fill(f64::NAN);
        self.lambda.fill(f64::NAN);
        self.outputs.fill(f64::NAN);
        let first_work = self.outputs.len() - self.labels.works;
        let at = OperatingPoint { t, q, v, vdot: &self.vdot, lambda: &self.lambda };
        system.outputs(at, &mut self.outputs[..first_work], scratch);
    }
}
