//! Scenes: JSON in, a checked model out.
//!
//! [`Scene::load`] reads a file, [`SceneBuilder`] makes one in code, and [`Elements`] adds kinds of bodies, joints and
//! forces from outside the crate.

mod absolute_beam;
mod actions;
mod beam_mass;
mod beam_outputs;
mod builder;
mod connections;
pub(crate) mod document;
mod elements;
mod fingerprint;
mod format;
#[doc(hidden)]
pub mod generate;
mod gravity;
mod inputs;
mod json;
mod keys;
mod kinematics;
pub(crate) mod locate;
mod markers;
mod measures;
mod model;
mod names;
mod outputs;
mod parts;
mod place;
mod resolve;
mod schema;
mod signals;
mod start;
mod states;
#[doc(hidden)]
pub mod units;

#[doc(hidden)]
pub use absolute_beam::BeamLine;
pub use builder::SceneBuilder;
pub(crate) use document::refined;
pub use elements::Elements;
#[doc(hidden)]
pub use format::Assembly;
pub use format::{Automatic, Simulation};
#[doc(hidden)]
pub use measures::MeasureKind;
pub use model::Model;
#[doc(hidden)]
pub use model::{
    Combination, Connection, EnergyPart, Measure, ModelForce, ModelInput, ModelJoint, ModelOutput, Part, Target,
};
#[doc(hidden)]
pub use model::{FORCE_SIZE, TORQUE_SIZE};
#[doc(hidden)]
pub use place::{Cut, Place, Reading};
#[doc(hidden)]
pub use start::KIND as INITIAL;

#[doc(hidden)]
pub use serde_json::json;

use crate::error::{Error, Result, excerpt, nearest};
use crate::math::expression::{Number, Parameters};
use crate::method_spec::OwnMethods;
use format::SceneFile;
use serde_json::Value;
use std::path::Path;

/// A checked scene: all names and expressions are resolved; the start is not yet consistent with the joints.
pub struct Scene {
    /// Name of the scene and of its folder of results.
    pub name: String,
    /// Free text about the mechanism; empty if not given.
    pub about: String,
    /// Sources of its data and known results.
    pub references: Vec<String>,
    /// Values of the named parameters, overrides applied.
    pub parameters: Parameters,
    /// Bodies, joints, forces, outputs and inputs.
    #[doc(hidden)]
    pub model: AnyModel,
    /// The model with further joints that hold the joint coordinates of `initial`, and with joints that hold their
    /// rates; `None` where it gives none of these.
    #[doc(hidden)]
    pub held: [Option<Box<AnyModel>>; 2],
    /// Initial guess of q for assembly, in the order of the bodies.
    pub q: Vec<f64>,
    /// Initial guess of v, in the order of the bodies.
    pub v: Vec<f64>,
    /// Coordinates, or bodies, whose values and rates assembly does not change.
    pub hold: Vec<String>,
    /// Settings of the simulation, as they are given.
    #[doc(hidden)]
    pub simulation: Simulation,
    /// Own methods that its settings may name.
    pub(crate) methods: OwnMethods,
    /// Hash of what it says of the mechanism.
    pub fingerprint: String,
}

/// A model in the plane or in space.
pub enum AnyModel {
    /// A model in the plane: three coordinates a rigid body.
    Planar(Model<2>),
    /// A model in space: seven coordinates a rigid body, a unit quaternion among them.
    Spatial(Model<3>),
}

impl Scene {
    /// Reads a scene file. `overrides` replace parameters.
    ///
    /// # Errors
    /// A file that cannot be read or is not a scene; the error says where in it, and what would be right.
    pub fn load(path: &Path, overrides: &[(String, Number)]) -> Result<Scene> {
        Elements::default().load(path, overrides)
    }

    /// Reads a scene from text; files that it names are in the current folder.
    ///
    /// # Errors
    /// Text that is not a scene.
    pub fn parse(text: &str, overrides: &[(String, Number)]) -> Result<Scene> {
        Elements::default().parse(text, overrides)
    }

    /// Time at the start of the motion, s.
    ///
    /// # Errors
    /// A `t_start` that cannot be evaluated.
    pub fn start_time(&self) -> Result<f64> {
        let Some(number) = &self.simulation.t_start else { return Ok(0.0) };
        let start = number.evaluate(&self.parameters);
        start.map_err(|error| Error::from(error).under("t_start").under("simulation"))
    }
}

/// Reads scenes with these kinds of elements.
impl Elements {
    /// As [`Scene::load`].
    ///
    /// # Errors
    /// As [`Scene::load`].
    pub fn load(&self, path: &Path, overrides: &[(String, Number)]) -> Result<Scene> {
        let text = read_text(path)?;
        self.parse_in(folder(Some(path)), &text, overrides).map_err(|error| place(error, path, &text))
    }

    /// As [`Scene::parse`].
    ///
    /// # Errors
    /// As [`Scene::parse`].
    pub fn parse(&self, text: &str, overrides: &[(String, Number)]) -> Result<Scene> {
        self.parse_in(folder(None), text, overrides)
    }

    /// Reads a scene from text; files that it names are in `folder`.
    ///
    /// # Errors
    /// As [`Scene::parse`].
    pub fn parse_in(&self, folder: &Path, text: &str, overrides: &[(String, Number)]) -> Result<Scene> {
        self.resolve(folder, read_json(text)?, overrides)
    }

    /// The scene of a document; files that it names are in `folder`.
    pub(crate) fn resolve(&self, folder: &Path, mut json: Value, overrides: &[(String, Number)]) -> Result<Scene> {
        if !json.is_object() {
            return Err(Error::input(format!("a scene is a JSON object, found {}", crate::body::show(&json)))
                .hint("begin with {\"name\": ..., \"dimension\": 2, ...}"));
        }
        let origins = document::complete(&mut json, folder, overrides)?;
        let fingerprint = fingerprint::fingerprint(&json, folder);
        // The long lists are moved, not copied.
        let mut taken = |key: &str| json.get_mut(key).and_then(Value::as_array_mut).map(std::mem::take);
        let bodies = taken("bodies").unwrap_or_default();
        let joints = taken("joints").unwrap_or_default();
        let forces = taken("forces").unwrap_or_default();
        let file = crate::body::parse::<SceneFile>(&json).map(|file| SceneFile { bodies, joints, forces, ..file });
        let scene = file.and_then(|file| resolve::build(file, self, overrides, folder));
        scene.map(|scene| Scene { fingerprint, ..scene }).map_err(|error| origins.place(name_element(error, &json)))
    }
}

/// The document in a text.
pub(crate) fn read_json(text: &str) -> Result<Value> {
    if text.trim_start_matches('\u{feff}').trim().is_empty() {
        return Err(Error::input("the file is empty").hint("a scene is a JSON object; see `holonom schema`"));
    }
    json::read(text)
}

/// Folder of the scene file, from which the files that it names are found.
pub(crate) fn folder(scene: Option<&Path>) -> &Path {
    scene.and_then(Path::parent).unwrap_or(Path::new(""))
}

/// Adds the name of the input, output or signal in which the path lies, unless it is known.
fn name_element(error: Error, json: &Value) -> Error {
    let Error::Input(input) = &error else { return error };
    let lists = ["states", "inputs", "outputs", "signals"];
    let name = input.path.split_once('[').filter(|(list, _)| lists.contains(list)).and_then(|(list, rest)| {
        let (index, rest) = rest.split_once(']')?;
        // An error in the name itself quotes it already.
        let element = json.get(list)?.get(index.parse::<usize>().ok()?).filter(|_| rest != ".name")?;
        element.get("name")?.as_str().map(str::to_string)
    });
    match name {
        Some(name) => error.element(excerpt(&name)),
        None => error,
    }
}

/// Adds file, line and column.
pub(crate) fn place(error: Error, path: &Path, text: &str) -> Error {
    let error = error.in_file(path);
    match &error {
        Error::Input(input) if input.file.as_deref() == Some(path) && !input.path.is_empty() => {
            let place = locate::locate(text, &input.path);
            error.placed(place)
        }
        _ => error,
    }
}

/// The text of a scene file.
pub(crate) fn read_text(path: &Path) -> Result<String> {
    let bytes = crate::files::read(path).map_err(|error| Error::file(path, explain(path, &error)))?;
    String::from_utf8(bytes).map_err(|error| {
        let good = String::from_utf8_lossy(&error.as_bytes()[..error.utf8_error().valid_up_to()]);
        let place = locate::line_and_column(&good, good.len());
        Error::input("this is not text in UTF-8").hint("save the scene as UTF-8").placed(place).in_file(path)
    })
}

fn explain(path: &Path, error: &std::io::Error) -> String {
    use std::io::ErrorKind::*;
    match error.kind() {
        NotFound => match similar(path) {
            Some(name) => format!("there is no such file; did you mean `{name}`?"),
            None => "there is no such file".to_string(),
        },
        PermissionDenied => "no permission to read it".to_string(),
        _ if path.is_dir() => "this is a directory; name a scene file".to_string(),
        _ => error.to_string(),
    }
}

/// A file in the same folder whose name is like that of `path`.
fn similar(path: &Path) -> Option<String> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut names: Vec<String> = std::fs::read_dir(folder)
        .ok()?
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .filter(|name| name.ends_with(".json") || Path::new(name).extension() == path.extension())
        .collect();
    names.sort();
    let found = path.file_name()?.to_str()?;
    let near = nearest(found, names.iter().map(String::as_str))?;
    Some(
        folder.join(near).strip_prefix(".").map_or_else(|_| folder.join(near), Path::to_path_buf).display().to_string(),
    )
}
