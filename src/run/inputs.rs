//! Inputs of a run: functions of the state, or values held between samples.

use super::Moment;
use crate::error::{Error, Result, short};
use crate::formulation::Law;
use crate::math::largest;
use crate::system::{Excitation, MechanicalSystem, Need, Scratch, Terms};
use crate::tolerances;
use nalgebra::DMatrix;
use std::sync::{Arc, Mutex, PoisonError};

/// An input u of a run. A closure `|t: f64, x: &Moment| ..` is one that is evaluated with the equations, at every stage
/// of a step: it has to be a function of its arguments alone. [`every`] makes one that is sampled, as by a digital
/// controller.
pub struct Input<'a>(InputFunction<'a>);

enum InputFunction<'a> {
    Continuous(Continuous),
    Sampled { period: f64, law: Sampled<'a> },
}

type Continuous = Box<dyn Fn(f64, &Moment) -> f64 + Send + Sync>;
type Sampled<'a> = Box<dyn FnMut(&Moment) -> f64 + Send + 'a>;

/// An input that is sampled with this period, s, from the start on, and held between the samples. Steps end on samples,
/// and the closure is called once at each: it may have a memory, such as that of an integral.
pub fn every<'a>(period: f64, law: impl FnMut(&Moment) -> f64 + Send + 'a) -> Input<'a> {
    Input(InputFunction::Sampled { period, law: Box::new(law) })
}

impl<F: Fn(f64, &Moment) -> f64 + Send + Sync + 'static> From<F> for Input<'_> {
    fn from(law: F) -> Self {
        Input(InputFunction::Continuous(Box::new(law)))
    }
}

/// A sampled input with its place among those of the system.
struct Sampler<'a> {
    place: usize,
    period: f64,
    law: Sampled<'a>,
    /// Number of the next sample.
    next: u64,
}

/// The inputs of a run at their places.
#[derive(Default)]
pub(super) struct Inputs<'a> {
    count: usize,
    samplers: Vec<Sampler<'a>>,
    /// The continuous ones.
    pub law: Option<Arc<Law>>,
}

impl<'a> Inputs<'a> {
    /// Finds the places of named inputs.
    ///
    /// # Errors
    /// An unknown name; an input that is no force; a period that is not positive.
    pub fn new(system: &dyn MechanicalSystem, named: Vec<(String, Input<'a>)>, moment: &Moment) -> Result<Self> {
        let facts = system.facts();
        let known: Vec<&str> = facts.inputs.iter().map(|input| input.name.as_str()).collect();
        let excitations = facts.excitations();
        let mut samplers = Vec::new();
        let mut laws = Vec::new();
        let count = if named.is_empty() { 0 } else { known.len() };
        for (name, Input(kind)) in named {
            let place = crate::error::find("input", &name, known.iter().copied())?;
            if excitations[place] != Excitation::Force {
                return Err(Error::input(format!(
                    "the input `{name}` moves a driver or a road, whose rates count, too"
                ))
                .hint("give it a \"value\" in the scene, or drive by a force"));
            }
            match kind {
                InputFunction::Continuous(law) => laws.push((place, law)),
                InputFunction::Sampled { period, .. } if !(period > 0.0 && period.is_finite()) => {
                    return Err(Error::input(format!("the input `{name}` is sampled every {} s", short(period)))
                        .hint("give a period above zero"));
                }
                InputFunction::Sampled { period, law } => samplers.push(Sampler { place, period, law, next: 0 }),
            }
        }
        let law = (!laws.is_empty()).then(|| continuous(laws, moment.clone()));
        Ok(Inputs { count, samplers, law })
    }

    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Refuses a system whose evaluation leaves out the inputs: u = 1 must change f by df/du.
    ///
    /// # Errors
    /// Such a system.
    pub fn check_added(&self, system: &dyn MechanicalSystem, t: f64, q: &[f64], v: &[f64]) -> Result<()> {
        let mut slopes = DMatrix::zeros(v.len(), self.count);
        system.input_forces(t, q, v, &mut slopes, &mut Scratch::default());
        let f = |inputs: Vec<f64>| {
            let mut terms = Terms::new(system);
            let mut scratch = Scratch::default();
            scratch.inputs = inputs;
            system.evaluate(t, q, v, Need::DYNAMICS, &mut terms, &mut scratch);
            terms.f
        };
        let without = f(self.zeros());
        let is_seen = slopes.amax() > tolerances::SAME * largest(&without);
        if is_seen && f(vec![1.0; self.count]) == without {
            return Err(Error::input("the equations have inputs, and an evaluation does not add them")
                .hint("`evaluate` adds df/du times `scratch.inputs` to f"));
        }
        Ok(())
    }

    /// Values before the first sample.
    pub fn zeros(&self) -> Vec<f64> {
        vec![0.0; self.count]
    }

    /// Passes over the samples before `t`, of a run that began at `start` and is continued.
    pub fn go_on(&mut self, t: f64, start: f64) {
        for sampler in &mut self.samplers {
            sampler.next = ((t - start) / sampler.period - tolerances::SAME).ceil().max(0.0) as u64;
        }
    }

    /// The next sample after the start of a run, s.
    pub fn next_sample(&self, start: f64) -> f64 {
        self.samplers.iter().map(|sampler| sampler.time(start)).fold(f64::INFINITY, f64::min)
    }

    /// True if a sample is due at `t`.
    pub fn is_due(&self, t: f64, start: f64) -> bool {
        self.samplers.iter().any(|sampler| sampler.is_due(t, start))
    }

    /// Takes the samples that are due at `t` in a run that began at `start`.
    pub fn sample(&mut self, t: f64, start: f64, moment: &Moment, u: &mut [f64]) {
        for sampler in &mut self.samplers {
            if sampler.is_due(t, start) {
                sampler.next += 1;
                u[sampler.place] = (sampler.law)(moment);
            }
        }
    }
}

impl Sampler<'_> {
    fn time(&self, start: f64) -> f64 {
        start + self.next as f64 * self.period
    }

    fn is_due(&self, t: f64, start: f64) -> bool {
        self.time(start) <= t + tolerances::SAME * self.period
    }
}

/// The inputs that are functions of the state.
fn continuous(laws: Vec<(usize, Continuous)>, moment: Moment) -> Arc<Law> {
    let memory = Mutex::new((moment, Scratch::default()));
    Arc::new(move |system: &dyn MechanicalSystem, at: (f64, &[f64], &[f64]), u: &mut [f64]| {
        let mut memory = memory.lock().unwrap_or_else(PoisonError::into_inner);
        let (moment, scratch) = &mut *memory;
        moment.read_unloaded(system, at, scratch);
        laws.iter().for_each(|(place, law)| u[*place] = law(at.0, moment));
    })
}
