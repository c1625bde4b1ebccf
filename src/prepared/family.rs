//! A scene as a function of its parameters.

use super::{AnyMechanism, Overrides, PreparedScene};
use crate::error::{Error, Result, Warning, suggest};
use crate::math::expression::Number;
use crate::scene::{self, Elements, Scene};
use crate::system::Column;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// A scene of which parameters will be varied. Its text is read once.
pub struct Family {
    text: String,
    document: Value,
    path: Option<PathBuf>,
    elements: Elements,
    set: Vec<(String, Number)>,
}

impl Family {
    /// Reads a scene file, with the elements and parameters of `overrides`.
    ///
    /// # Errors
    /// As [`Scene::load`].
    pub fn load(path: &Path, overrides: &Overrides) -> Result<Family> {
        Family::new(scene::read_text(path)?, Some(path.to_path_buf()), overrides)
    }

    /// Reads a scene from text.
    ///
    /// # Errors
    /// As [`Scene::parse`].
    pub fn parse(text: &str, overrides: &Overrides) -> Result<Family> {
        Family::new(text.to_string(), None, overrides)
    }

    fn new(text: String, path: Option<PathBuf>, Overrides { elements, set, .. }: &Overrides) -> Result<Family> {
        let document = scene::read_json(&text).map_err(|error| match &path {
            Some(path) => scene::place(error, path, &text),
            None => error,
        })?;
        let family = Family { text, document, path, elements: elements.clone(), set: set.clone() };
        family.scene()?;
        Ok(family)
    }

    /// The scene with its own value of the parameter.
    ///
    /// # Errors
    /// As [`Scene::parse`].
    pub fn scene(&self) -> Result<Scene> {
        self.with(&self.set).map_err(|error| self.place(error))
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
        let set: Vec<(String, Number)> = self.set.iter().cloned().chain(own).collect();
        self.with(&set)
    }

    fn with(&self, set: &[(String, Number)]) -> Result<Scene> {
        self.elements.resolve(scene::folder(self.path.as_deref()), self.document.clone(), set)
    }

    /// Warnings about the start; none where it cannot be assembled, which a sweep reports better.
    pub fn doubts(&self) -> Vec<Warning> {
        let prepared = self.scene().and_then(|scene| PreparedScene::new(scene, &Overrides::default()));
        prepared.map_or(Vec::new(), |prepared| prepared.doubts)
    }

    /// The outputs of the scene.
    ///
    /// # Errors
    /// As [`Scene::parse`].
    pub fn outputs(&self) -> Result<Vec<Column>> {
        Ok(AnyMechanism::new(self.scene()?.model).system().columns())
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
        match &self.path {
            Some(path) => scene::place(error, path, &self.text),
            None => error,
        }
    }
}
