//! The scene of a study, and one variant of it.

use super::course::Course;
use super::measure::{Measure, What};
use crate::analysis::{Record, Recorder};
use crate::error::{Error, INTERRUPTED, Result, clock};
use crate::integrator;
use crate::linearize::{Kind, Linear, LinearModel, Operating, State, at_rest};
use crate::method_spec::MethodSpec;
use crate::prepared::{Family, Model, Overrides};
use crate::simulate::{Method, Outcome, Span, Stop};
use crate::study::companion::Completed;
use crate::study::error_bar::ErrorBars;
use crate::study::price::Worker;
use crate::system::Column;
use crate::tolerances;
use crate::trajectory::{Trajectory, recorded};
use std::path::Path;

/// A scene whose parameters are varied, with the numbers that are recorded of each variant.
pub struct Study {
    family: Family,
    /// Settings of every variant, the same that a command for one of them gives.
    pub overrides: Overrides,
    /// Names of the parameters that are varied.
    pub names: Vec<String>,
    /// Numbers of the motion. It is not simulated if there are none.
    pub measures: Vec<Measure>,
    /// Number of eigenvalues of the linear model at the start; none where it is not made.
    pub modes: Option<usize>,
    is_at_rest: bool,
}

/// What a study records.
pub struct Recorded<'r> {
    /// Measures in words, separated by commas.
    pub measures: &'r [String],
    /// True for the eigenvalues of the linear model at the start.
    pub modes: bool,
    /// True for the linear model at the equilibrium that belongs to the start.
    pub is_at_rest: bool,
}

/// Columns of an eigenvalue, with their units.
const OF_EIGENVALUE: [(&str, &str); 4] = [("re", "1/s"), ("im", "1/s"), ("frequency", "Hz"), ("damping", "")];

impl Study {
    /// Reads a scene whose nominal variant is `prepared`, by `overrides`. A method that the program is to choose is
    /// chosen once, for the nominal variant. Without `recorded` the final values of the outputs are recorded.
    ///
    /// # Errors
    /// A parameter that the scene does not have, or that `overrides` sets; a measure that cannot be read; a linear model
    /// that does not exist.
    pub fn new(
        path: &Path,
        prepared: &Model,
        overrides: &Overrides,
        names: &[String],
        recorded: Recorded,
    ) -> Result<Study> {
        let family = Family::load_with(path, overrides)?;
        for name in names {
            family.own_value(name)?;
            if overrides.set.iter().any(|(set, _)| set == name) {
                return Err(Error::input(format!("`{name}` is set and varied")).under("--set").hint("do one of both"));
            }
        }
        let measures = measures(prepared, &recorded)?;
        let modes = recorded.modes.then(|| Ok::<_, Error>(eigenvalues(&model(prepared, recorded.is_at_rest)?).len()));
        let mut overrides = overrides.clone();
        let is_at_rest = recorded.is_at_rest;
        if !measures.is_empty() && !measures.iter().any(Measure::needs_rows) {
            let Span { start, end, .. } = prepared.span()?;
            overrides.output_step = Some(end - start);
        }
        let study = Study { family, overrides, names: names.to_vec(), measures, modes: modes.transpose()?, is_at_rest };
        study.check(prepared).map_err(|error| error.under("--record"))?;
        Ok(study)
    }

    /// Fixes the method of all variants.
    #[must_use]
    pub fn with_method(mut self, method: &Method) -> Study {
        self.overrides.method = None;
        self.overrides.formulation = Some(method.formulation.clone());
        self.overrides.integrator = Some(method.integrator.clone());
        self.overrides.projection = Some(method.projection.clone());
        self.overrides.rtol = Some(method.rtol);
        self.overrides.atol = Some(method.atol);
        self.overrides.step = Some(method.step.unwrap_or(0.0));
        self
    }

    /// True if a second run gives error bars.
    pub fn needs_error(&self) -> bool {
        self.measures.iter().any(Measure::needs_error)
    }

    /// Names and units of the recorded numbers.
    pub fn columns(&self) -> Vec<Column> {
        let of_measures = self.measures.iter().map(|Measure { text, unit, .. }| (text.clone(), unit.as_str()));
        let of_modes = (1..=self.modes.unwrap_or(0))
            .flat_map(|i| OF_EIGENVALUE.map(|(name, unit)| (format!("eigenvalue{i}.{name}"), unit)));
        of_measures.chain(of_modes).map(|(name, unit)| Column { name, unit: unit.to_string() }).collect()
    }

    /// Returns the recorded numbers of a variant, or the reason why there are none; none where `is_over` ended it.
    pub fn run(&self, values: &[f64], is_over: &(dyn Fn() -> bool + Sync)) -> Option<Result<Vec<f64>, String>> {
        if is_over() {
            return None;
        }
        match self.prepare(values).and_then(|prepared| self.record(&prepared, is_over)) {
            Ok(recorded) => Some(Ok(recorded)),
            Err(_) if is_over() => None,
            Err(error) => Some(Err(format!("{error:#}").lines().next().unwrap_or_default().to_string())),
        }
    }

    fn prepare(&self, values: &[f64]) -> Result<Model> {
        Model::new(self.family.scene_with(&self.names, values)?, &self.overrides)
    }

    fn record(&self, prepared: &Model, is_over: &(dyn Fn() -> bool + Sync)) -> Result<Vec<f64>> {
        let mut all = if self.measures.is_empty() { Vec::new() } else { self.simulate(prepared, is_over)? };
        let Some(count) = self.modes else { return Ok(all) };
        let found = eigenvalues(&model(prepared, self.is_at_rest)?);
        if found.len() != count {
            let message = format!("the linear model has {} eigenvalues, and that of the scene {count}", found.len());
            return Err(Error::input(message));
        }
        all.extend(found.concat());
        Ok(all)
    }

    fn simulate(&self, prepared: &Model, is_over: &(dyn Fn() -> bool + Sync)) -> Result<Vec<f64>> {
        let system = prepared.system();
        let span = prepared.span()?;
        let mut courses = self.courses(prepared)?;
        let stop = || is_over().then(|| Stop { reason: INTERRUPTED.to_string(), hint: String::new() });
        let width = Trajectory::new(system).headings().len();
        let is_read: Vec<bool> =
            (0..width).map(|column| courses.iter().flatten().any(|course| course.reads(column))).collect();
        let mut add = |row: &[f64]| courses.iter_mut().flatten().for_each(|course| course.add(row));
        let mut recorder = Recorder::new(system).with_jumps().with_stop(stop);
        if !self.needs_error() {
            recorder = recorder.with_passed_rows(|column| is_read[column], |row| add(row.values));
        }
        let (outcome, legs) = prepared.simulate(&prepared.method, span, &mut recorder)?;
        let record = recorder.finish();
        if let Some(failure) = record.singularity.failure_of(&outcome) {
            return Err(failure.into());
        }
        let mut bars = None;
        if self.needs_error() {
            record.trajectory.rows.iter().for_each(|row| add(row));
            let (trajectory, statistics) = (&record.trajectory, outcome.statistics);
            let run = Completed { span, trajectory, legs: &legs, statistics };
            bars = Some(ErrorBars::of(prepared, run, (&|_| (), &stop)));
        }
        let number = |(measure, course): (&Measure, &Option<Course>)| match (&measure.what, course, &bars) {
            (What::Error(output), _, Some(bars)) => bars.outputs.get(*output).map_or(f64::NAN, |(_, bar)| bar.max),
            (_, Some(course), _) => course.value(),
            (what, ..) => of_run(what, prepared, &outcome, &record),
        };
        Ok(self.measures.iter().zip(&courses).map(number).collect())
    }

    /// Returns the courses of the measures that have one, before the first row.
    fn courses(&self, prepared: &Model) -> Result<Vec<Option<Course>>> {
        let trajectory = Trajectory::new(prepared.system());
        let headings = trajectory.headings();
        let output_step = prepared.span()?.output_step;
        let course = |measure: &Measure| match &measure.what {
            What::OfCourse(reduction, text) => {
                let course = Course::new(reduction, text, &headings, &prepared.parameters, output_step);
                course.map(Some).map_err(|error| Error::from(error).element(measure.text.as_str()))
            }
            _ => Ok(None),
        };
        self.measures.iter().map(course).collect()
    }

    /// Refuses measures that cannot be read, and times at which there is no row.
    fn check(&self, prepared: &Model) -> Result<()> {
        if self.measures.is_empty() {
            return Ok(());
        }
        let Span { start, end, output_step } = prepared.span()?;
        for (measure, course) in self.measures.iter().zip(self.courses(prepared)?) {
            let Some(t) = course.and_then(|course| course.asked_time()) else { continue };
            let steps = (t - start) / output_step;
            let is_row = (steps - steps.round()).abs() <= tolerances::SIX_DIGITS
                || (t - end).abs() <= tolerances::SIX_DIGITS * output_step;
            if !is_row
                || t < start - tolerances::SIX_DIGITS * output_step
                || t > end + tolerances::SIX_DIGITS * output_step
            {
                let [start, end, t] = [start, end, t].map(clock);
                let message =
                    format!("there is no row at t = {t} s, but every {output_step} s from {start} s to {end} s");
                return Err(Error::input(message)
                    .element(measure.text.as_str())
                    .hint("give --output-step a part of that time, or --until a later end"));
            }
        }
        Ok(())
    }
}

fn measures(prepared: &Model, asked: &Recorded) -> Result<Vec<Measure>> {
    let outputs = recorded(prepared.system());
    let mut measures = Vec::new();
    for text in asked.measures {
        measures.extend(Measure::parse_list(text, &outputs).map_err(|error| error.under("--record"))?);
    }
    if let Some(i) = (0..measures.len()).find(|&i| measures[..i].iter().any(|known| known.text == measures[i].text)) {
        let message = format!("`{}` is recorded twice", measures[i].text);
        return Err(Error::input(message).under("--record").hint("name it once"));
    }
    if measures.is_empty() && !asked.modes {
        measures.extend(outputs.iter().map(Measure::last_of));
        if measures.is_empty() {
            return Err(Error::input("the scene has no outputs").under("--record").hint("name what to record"));
        }
    }
    Ok(measures)
}

/// Returns a number of the whole run.
fn of_run(what: &What, prepared: &Model, outcome: &Outcome, record: &Record) -> f64 {
    match what {
        What::Drift => record.drift.position.relative_max,
        What::EnergyError => record.energy.map_or(f64::NAN, |energy| energy.max_error),
        What::Steps => outcome.statistics.steps as f64,
        _ => {
            let method = &prepared.method;
            let is_explicit = integrator::find(&method.integrator).is_ok_and(|entry| entry.stability.is_some());
            Worker { method, is_explicit }.work(outcome.statistics)
        }
    }
}

/// Returns the linear model at the start, or at the equilibrium that belongs to it.
fn model(prepared: &Model, is_at_rest: bool) -> Result<LinearModel> {
    let start = State::start(prepared);
    let operating = if is_at_rest {
        at_rest(prepared, &start)?
    } else {
        let projected = prepared.states_at(&[start.t])?.pop();
        Operating::moving(prepared, projected.unwrap_or(start))
    };
    let request = Linear { method: MethodSpec::named("mcs"), chart: None };
    operating.variation()?.linearize(&request)
}

/// Returns real and imaginary part, frequency and damping ratio of each physical eigenvalue, the slowest first.
fn eigenvalues(model: &LinearModel) -> Vec<[f64; 4]> {
    let physical = model.modes.iter().filter(|mode| mode.kind == Kind::Physical);
    physical.map(|mode| [mode.value.re, mode.value.im, mode.frequency(), mode.damping()]).collect()
}
