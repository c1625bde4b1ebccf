//! The full model as JSON, from which poorer ones are made.

use crate::error::Result;
use crate::prepared::{Model, Overrides};
use crate::scene::document::{complete, elements_mut, read, take};
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
    /// As [`Model::load_with`]; no end time.
    pub fn load(path: &Path, overrides: &Overrides) -> Result<Source> {
        let prepared = Model::load_with(path, overrides)?;
        let scene = read(&scene::read_text(path)?)?;
        let folder = scene::folder(Some(path));
        Source::settled(scene, folder, prepared, overrides).map_err(|error| error.in_file(path))
    }

    /// A scene that files in the current folder belong to.
    ///
    /// # Errors
    /// It is none, or has no end time.
    pub fn new(scene: Value, overrides: &Overrides) -> Result<Source> {
        let folder = Path::new("");
        let whole = overrides.elements.resolve(folder, scene.clone(), &overrides.set)?;
        Source::settled(scene, folder, Model::new(whole, overrides)?, overrides)
    }

    fn settled(mut scene: Value, folder: &Path, prepared: Model, overrides: &Overrides) -> Result<Source> {
        complete(&mut scene, folder, &overrides.set)?;
        let prepared = prepared.settled()?;
        let span = prepared.span()?;
        for (name, value) in &overrides.set {
            scene["parameters"][name] = json!(value);
        }
        scene["simulation"]["t_end"] = json!(span.end);
        scene["simulation"]["output_step"] = json!(span.output_step);
        write_method(&mut scene, &prepared.method);
        Ok(Source { scene, folder: folder.to_path_buf(), elements: overrides.elements.clone() })
    }

    /// A model of it, ready to run.
    ///
    /// # Errors
    /// What the change has made of the scene is none, or cannot be assembled.
    pub fn prepare(&self, scene: &Value) -> Result<Model> {
        let scene = self.elements.resolve(&self.folder, scene.clone(), &[])?;
        Model::new(scene, &Overrides::default())
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
        take(&mut scene, "$schema");
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
    take(simulation, "method");
    match step {
        Some(step) => simulation["step"] = json!(step),
        None => drop(take(simulation, "step")),
    }
}
