//! The full model as JSON, from which poorer ones are made.

use super::edit::elements_mut;
use crate::error::{Error, Result};
use crate::prepared::{Overrides, PreparedScene};
use crate::scene::{self, Elements};
use crate::simulate::Method;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// A scene as JSON, with the settings of the command line and its method written in.
#[derive(Clone, Debug)]
pub struct Source {
    /// The scene, with all that it repeats and includes.
    pub scene: Value,
    /// Folder from which the files that it names are found.
    pub folder: PathBuf,
    /// Kinds of elements that it may name.
    pub elements: Elements,
}

impl Source {
    /// Reads a scene and writes parameters, end time and method of the overrides into it.
    ///
    /// # Errors
    /// As [`PreparedScene::load`]; no end time.
    pub fn load(path: &Path, overrides: &Overrides) -> Result<Source> {
        let prepared = PreparedScene::load(path, overrides)?;
        let text = scene::read_text(path)?;
        let parsed = serde_json::from_str(text.trim_start_matches('\u{feff}'));
        let mut scene = parsed.map_err(|error| Error::file(path, error))?;
        let folder = scene::folder(Some(path)).to_path_buf();
        scene::complete(&mut scene, &folder, &overrides.set).map_err(|error| error.in_file(path))?;
        let source = Source { scene, folder, elements: overrides.elements.clone() };
        source.settled(prepared, overrides).map_err(|error| error.in_file(path))
    }

    /// A scene that files in the current folder belong to.
    ///
    /// # Errors
    /// It is none, or has no end time.
    pub fn new(mut scene: Value, overrides: &Overrides) -> Result<Source> {
        scene::complete(&mut scene, Path::new(""), &overrides.set)?;
        let source = Source { scene, folder: PathBuf::new(), elements: overrides.elements.clone() };
        let scene = source.elements.parse_in(&source.folder, &source.scene.to_string(), &overrides.set)?;
        source.settled(PreparedScene::new(scene, overrides)?, overrides)
    }

    fn settled(mut self, prepared: PreparedScene, overrides: &Overrides) -> Result<Source> {
        let prepared = prepared.settled()?;
        let span = prepared.span()?;
        for (name, value) in &overrides.set {
            self.scene["parameters"][name] = json!(value);
        }
        self.scene["simulation"]["t_end"] = json!(span.end);
        self.scene["simulation"]["output_step"] = json!(span.output_step);
        write_method(&mut self.scene, &prepared.method);
        Ok(self)
    }

    /// A model of it, ready to run.
    ///
    /// # Errors
    /// What the change has made of the scene is none, or cannot be assembled.
    pub fn prepare(&self, scene: &Value) -> Result<PreparedScene> {
        let scene = self.elements.parse_in(&self.folder, &scene.to_string(), &[])?;
        PreparedScene::new(scene, &Overrides::default())
    }

    /// The scene with absolute paths of the files that it names, so that it may be written anywhere.
    pub fn anywhere(&self, scene: &Value) -> Value {
        let mut scene = scene.clone();
        let place = |value: &mut Value| {
            let file = value.as_str().map(|file| self.folder.join(file));
            if let Some(whole) = file.and_then(|file| file.canonicalize().ok()) {
                *value = json!(whole);
            }
        };
        if let Some(keys) = scene.as_object_mut() {
            keys.shift_remove("$schema");
        }
        if let Some(reference) = scene.get_mut("simulation").and_then(|simulation| simulation.get_mut("reference")) {
            place(reference);
        }
        for list in ["bodies", "signals"] {
            elements_mut(&mut scene, list).filter_map(|element| element.get_mut("file")).for_each(place);
        }
        scene
    }
}

/// Writes a method into the simulation of a scene.
pub fn write_method(scene: &mut Value, method: &Method) {
    let Method { formulation, integrator, projection, rtol, atol, step } = method;
    let simulation = &mut scene["simulation"];
    for (key, spec) in [("formulation", formulation), ("integrator", integrator), ("projection", projection)] {
        simulation[key] = json!(spec.to_string());
    }
    (simulation["rtol"], simulation["atol"]) = (json!(rtol), json!(atol));
    let keys = simulation.as_object_mut().into_iter();
    keys.for_each(|keys| keys.retain(|key, _| key != "method" && (key != "step" || step.is_some())));
    if let Some(step) = step {
        simulation["step"] = json!(step);
    }
}
