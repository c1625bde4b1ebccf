//! Options and functions of the commands that make linear models.

use super::common::{MethodOptions, Output, SceneOptions, Talk, number, unprintable};
use crate::analysis::ValidityRange;
use crate::error::{Error, Result};
use crate::linearize::{Chart, Linear, LinearizationMethod, Operating, State, at_rest, kinks, states_of, tighten};
use crate::method_spec::MethodSpec;
use crate::prepared::Model;
use crate::report::linear::stem_at;
use crate::report::{Answer, Folder};
use serde_json::Value;

/// Which linear model.
#[derive(clap::Args)]
pub struct ModelOptions {
    /// mcs, rcs, baumgarte, penalty, augmented_lagrangian or force_projection, with options as in baumgarte:alpha=5
    #[arg(long, default_value = "mcs")]
    pub method: String,
    #[command(flatten)]
    pub chart: ChartOptions,
}

/// Coordinates of the perturbation.
#[derive(clap::Args)]
pub struct ChartOptions {
    /// Coordinates of the perturbation: intrinsic, mass_orthogonal, frozen, or independent coordinates NAME[,NAME]
    /// (default: intrinsic, or mass_orthogonal with bodies in floating frames)
    #[arg(long, value_name = "CHART", conflicts_with = "independent")]
    chart: Option<String>,
    /// Independent coordinates, the same as --chart NAME[,NAME]
    #[arg(long, value_name = "NAME[,NAME...]")]
    independent: Option<String>,
}

/// At which states of the motion.
#[derive(clap::Args)]
pub struct StateOptions {
    /// Times of the states, s (default: the start)
    #[arg(long, value_name = "T[,T...]", value_parser = number, value_delimiter = ',', allow_negative_numbers = true)]
    at: Vec<f64>,
    /// Find the static equilibrium that belongs to the state first
    #[arg(long)]
    equilibrium: bool,
}

/// What the commands share that have a result for each of some states.
#[derive(clap::Args)]
pub struct AtStates {
    #[command(flatten)]
    pub scene: SceneOptions,
    #[command(flatten)]
    pub states: StateOptions,
    #[command(flatten)]
    pub run: MethodOptions,
    #[command(flatten)]
    pub talk: Talk,
    #[command(flatten)]
    pub output: Output,
}

impl AtStates {
    pub fn load(&self) -> Result<Model> {
        self.run.load_tight(&self.scene, &self.talk)
    }

    pub fn in_file(&self) -> impl Fn(Error) -> Error + Copy {
        |error| error.in_file(&self.scene.path)
    }

    /// Publishes the results at all states, which `result` [adds](Self::add). As JSON one alone is no list.
    pub fn conclude(
        &self,
        prepared: &Model,
        mut result: impl FnMut(&Operating, &mut Folder) -> Result<Value>,
    ) -> Result<()> {
        let places = self.states.states(prepared, &self.talk).map_err(self.in_file())?;
        let mut folder = self.output.folder(&prepared.name)?;
        let mut results = places.iter().map(|place| result(place, &mut folder)).collect::<Result<Vec<Value>>>()?;
        let all = if results.len() == 1 { results.remove(0) } else { Value::Array(results) };
        self.talk.conclude(folder, &all, String::new)
    }

    /// Writes an answer on the state at `t`, and prints its text; returns the JSON if that is requested, else null.
    pub fn add(
        &self,
        folder: &mut Folder,
        what: &str,
        prepared: &Model,
        t: f64,
        answer: &impl Answer,
    ) -> Result<Value> {
        let sealed = answer.stage(folder, &stem_at(what, t), self.talk.origin(prepared))?;
        self.talk.say(&answer.text())?;
        if self.talk.json { serde_json::to_value(sealed).map_err(unprintable) } else { Ok(Value::Null) }
    }
}

impl ChartOptions {
    pub fn chart(&self) -> Option<Chart> {
        self.chart.as_ref().or(self.independent.as_ref()).map(|text| Chart::parse(text))
    }
}

impl ModelOptions {
    pub fn request(&self) -> Result<Linear> {
        let method = MethodSpec::parse(&self.method).and_then(|method| {
            method.entry::<LinearizationMethod>()?;
            Ok(method)
        });
        Ok(Linear { method: method.map_err(|error| error.under("--method"))?, chart: self.chart.chart() })
    }
}

impl MethodOptions {
    /// Loads the scene with these settings, its tolerances tightened for linear models.
    pub fn load_tight(&self, scene: &SceneOptions, talk: &Talk) -> Result<Model> {
        let overrides = self.overrides(scene, None);
        let mut prepared = talk.load(&scene.path, &overrides)?;
        tighten(&mut prepared, &overrides);
        Ok(prepared)
    }
}

impl StateOptions {
    pub fn count(&self) -> usize {
        self.at.len().max(1)
    }

    pub fn states<'a>(&self, prepared: &'a Model, talk: &Talk) -> Result<Vec<Operating<'a>>> {
        let found = self.operating(prepared, talk)?;
        for place @ Operating { state, doubt, .. } in &found {
            talk.warn(doubt);
            talk.warn(&ValidityRange::warnings_at(prepared.system(), state.t, &state.q));
            talk.warn(&kinks(place.system(), state)?);
        }
        Ok(found)
    }

    /// The state of another scene at a time.
    pub fn at<'a>(&self, prepared: &'a Model, talk: &Talk, t: f64) -> Result<Operating<'a>> {
        let own = StateOptions { at: vec![t], equilibrium: self.equilibrium };
        let found = own.states(prepared, talk)?.pop();
        found.ok_or_else(|| Error::input(format!("there is no state at t = {t} s")))
    }

    fn operating<'a>(&self, prepared: &'a Model, talk: &Talk) -> Result<Vec<Operating<'a>>> {
        let times = if self.at.is_empty() { vec![prepared.start_time()] } else { self.at.clone() };
        if !self.equilibrium {
            let bar = talk.progress(times.len() as u64, &prepared.name);
            let found = states_of(prepared, &times, |_| bar.inc(1))?;
            return Ok(found.into_iter().map(|state| Operating::moving(prepared, state)).collect());
        }
        times.into_iter().map(|t| at_rest(prepared, &State { t, ..State::start(prepared) })).collect()
    }
}
