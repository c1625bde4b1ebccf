//! A scene as a function of its parameters.

use super::{AnyMechanism, Model, Overrides};
use crate::error::{Error, Failure, Result, Warning, short, suggest};
use crate::math::expression::Number;
use crate::scene::{self, Scene};
use crate::system::Column;
use rayon::prelude::*;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A scene of which parameters will be varied. Its text is read once.
///
/// ```
/// use holonom::prelude::*;
///
/// let periods = Family::load("models/pendulum.json")?.each("l", linspace(1.0, 2.0, 3), |model| {
///     let mut run = model.run();
///     let End::Event(quarter) = run.until(|x| x.output("angle"), 10.0)? else { return Ok(f64::INFINITY) };
///     Ok(4.0 * quarter)
/// })?;
/// assert!(periods[0] < periods[1] && periods[1] < periods[2]);
/// # Ok::<(), holonom::Error>(())
/// ```
#[derive(Clone)]
pub struct Family {
    text: Arc<str>,
    json: Arc<Value>,
    path: Option<PathBuf>,
    overrides: Overrides,
}

impl Family {
    /// Reads a scene file.
    ///
    /// # Errors
    /// As [`Scene::load`].
    pub fn load(path: impl AsRef<Path>) -> Result<Family> {
        Family::load_with(path.as_ref(), &Overrides::default())
    }

    /// The same with other settings, parameters and kinds of elements.
    ///
    /// # Errors
    /// As [`Scene::load`].
    pub fn load_with(path: &Path, overrides: &Overrides) -> Result<Family> {
        Family::read(path, overrides)?.checked()
    }

    /// Reads a scene from text.
    ///
    /// # Errors
    /// As [`Scene::parse`].
    pub fn parse(text: &str) -> Result<Family> {
        Family::parse_with(text, &Overrides::default())
    }

    /// Reads a scene from text, with the settings, parameters and kinds of elements of `overrides`.
    ///
    /// # Errors
    /// As [`Scene::parse`].
    pub fn parse_with(text: &str, overrides: &Overrides) -> Result<Family> {
        Family::of_text(text.to_string(), None, overrides)?.checked()
    }

    /// A scene file that is not checked yet.
    pub(super) fn read(path: &Path, overrides: &Overrides) -> Result<Family> {
        Family::of_text(scene::read_text(path)?, Some(path.to_path_buf()), overrides)
    }

    pub(super) fn of_text(text: String, path: Option<PathBuf>, overrides: &Overrides) -> Result<Family> {
        let json = scene::read_json(&text).map_err(|error| placed(error, path.as_deref(), &text))?;
        Ok(Family { text: text.into(), json: Arc::new(json), path, overrides: overrides.clone() })
    }

    fn checked(self) -> Result<Family> {
        self.scene()?;
        Ok(self)
    }

    /// The scene with its own value of the parameter.
    ///
    /// # Errors
    /// As [`Scene::parse`].
    pub fn scene(&self) -> Result<Scene> {
        self.resolved().map_err(|error| self.place(error))
    }

    /// The scene with another value of a parameter.
    ///
    /// # Errors
    /// As [`Scene::parse`]: the value may be outside of what the scene's expressions are defined for.
    pub fn scene_at(&self, parameter: &str, value: f64) -> Result<Scene> {
        self.scene_with(&[parameter.to_string()], &[value])
    }

    /// The scene with other values of some parameters.
    ///
    /// # Errors
    /// As [`Family::scene_at`].
    pub fn scene_with(&self, parameters: &[String], values: &[f64]) -> Result<Scene> {
        let own = parameters.iter().cloned().zip(values.iter().map(|value| Number::Value(*value)));
        let mut family = self.clone();
        family.overrides.set.extend(own);
        family.resolved()
    }

    /// The model with the scene's own values.
    ///
    /// # Errors
    /// As [`Model::load`].
    pub fn model(&self) -> Result<Model> {
        let model = self.resolved().and_then(|scene| Model::new(scene, &self.overrides));
        let model = model.map_err(|error| self.place(error))?;
        Ok(Model { family: Some(self.clone()), ..model })
    }

    /// Calls `work` with the model at each value of a parameter, over all threads of the pool of rayon that it is
    /// called in, else of the global one. Results are in the order of the values, and do not depend on the number of
    /// threads.
    ///
    /// The variable `RAYON_NUM_THREADS=2` in the environment of the program gives two threads. A pool does so, too:
    ///
    /// ```
    /// use holonom::prelude::*;
    /// use holonom::rayon::ThreadPoolBuilder;
    ///
    /// let family = Family::load("models/pendulum.json")?;
    /// let pool = ThreadPoolBuilder::new().num_threads(2).build().unwrap();
    /// let rows = pool.install(|| family.each("l", linspace(1.0, 2.0, 4), |model| Ok(model.start().0[0])))?;
    /// assert_eq!(rows.len(), 4);
    /// # Ok::<(), holonom::Error>(())
    /// ```
    ///
    /// # Errors
    /// The first error in the order of the values, with the value.
    pub fn each<T: Send>(
        &self,
        parameter: &str,
        values: impl IntoIterator<Item = f64>,
        work: impl Fn(&Model) -> Result<T> + Sync,
    ) -> Result<Vec<T>> {
        let values: Vec<f64> = values.into_iter().collect();
        let variant = |&value: &f64| {
            let result = self.with(parameter, value).model().and_then(|model| work(&model));
            result.map_err(|error| at_value(error, parameter, value))
        };
        let results: Vec<Result<T>> = values.par_iter().map(variant).collect();
        results.into_iter().collect()
    }

    /// The family with another own value of a parameter.
    pub(super) fn with(&self, parameter: &str, value: f64) -> Family {
        let mut family = self.clone();
        family.overrides.set.push((parameter.to_string(), Number::Value(value)));
        family
    }

    fn resolved(&self) -> Result<Scene> {
        let Overrides { elements, set, .. } = &self.overrides;
        elements.resolve(scene::folder(self.path.as_deref()), (*self.json).clone(), set)
    }

    /// Warnings about the start; none where it cannot be assembled, which a sweep reports better.
    pub fn doubts(&self) -> Vec<Warning> {
        let model = self.scene().and_then(|scene| Model::new(scene, &Overrides::default()));
        model.map_or(Vec::new(), |model| model.doubts)
    }

    /// The outputs of the scene.
    ///
    /// # Errors
    /// As [`Scene::parse`].
    pub fn outputs(&self) -> Result<Vec<Column>> {
        Ok(AnyMechanism::new(self.scene()?.model).system().facts().outputs.clone())
    }

    /// The scene's own value of a parameter.
    ///
    /// # Errors
    /// Where the scene has no such parameter.
    pub fn own_value(&self, parameter: &str) -> Result<f64> {
        let scene = self.scene()?;
        scene.parameters.get(parameter).ok_or_else(|| {
            let known = scene.parameters.iter().map(|(name, _)| name);
            Error::input(format!("unknown parameter `{parameter}`")).hint(suggest(parameter, known))
        })
    }

    pub(crate) fn place(&self, error: Error) -> Error {
        placed(error, self.path.as_deref(), &self.text)
    }
}

fn placed(error: Error, path: Option<&Path>, text: &str) -> Error {
    match path {
        Some(path) => scene::place(error, path, text),
        None => error,
    }
}

/// The error of one variant, with its value.
fn at_value(error: Error, parameter: &str, value: f64) -> Error {
    let at = format!("{parameter} = {}", short(value));
    match error {
        Error::Run(failure) => Failure { reason: format!("with {at}: {}", failure.reason), ..failure }.into(),
        error => error.changed(|input| input.message = format!("{} (with {at})", input.message)),
    }
}

/// `count` values from `from` to `to`, both ends among them, at equal distances.
pub fn linspace(from: f64, to: f64, count: usize) -> impl Iterator<Item = f64> {
    let last = count.saturating_sub(1);
    (0..count).map(move |i| if i == last && i > 0 { to } else { from + (to - from) * i as f64 / last.max(1) as f64 })
}
