//! Scenes: JSON in, a checked model out.

mod builder;
mod format;
pub mod generate;
mod locate;
mod markers;
mod model;
mod outputs;
mod schema;

pub use format::{Assembly, Simulation};
pub use model::{Connection, Driven, EnergyPart, Measure, Model, Part, Watched};
pub use schema::schema;

use crate::error::{Error, Result};
use crate::math::expression::Parameters;
use format::SceneFile;
use serde_json::Value;
use std::path::Path;

/// A scene with everything resolved but its start.
pub struct Scene {
    pub name: String,
    pub about: String,
    pub references: Vec<String>,
    pub dimension: usize,
    pub parameters: Parameters,
    pub model: AnyModel,
    /// The guess for q and v that assembly starts from.
    pub q: Vec<f64>,
    pub v: Vec<f64>,
    /// Coordinates or bodies that assembly leaves alone.
    pub hold: Vec<String>,
    pub simulation: Simulation,
}

/// A model in the plane or in space.
pub enum AnyModel {
    Planar(Model<2>),
    Spatial(Model<3>),
}

impl Scene {
    /// Reads a scene file. `overrides` replace parameters.
    ///
    /// # Errors
    /// A file that cannot be read or is not a scene; the error says where in it, and what would be right.
    pub fn load(path: &Path, overrides: &[(String, f64)]) -> Result<Scene> {
        let text = std::fs::read_to_string(path).map_err(|error| Error::file(path, explain(path, &error)))?;
        Scene::parse(&text, overrides).map_err(|error| place(error, path, &text))
    }

    /// Reads a scene from text.
    pub fn parse(text: &str, overrides: &[(String, f64)]) -> Result<Scene> {
        if text.trim().is_empty() {
            return Err(Error::input("the file is empty").hint("a scene is a JSON object; see `holonom schema`"));
        }
        let json: Value = serde_json::from_str(text).map_err(not_json)?;
        if !json.is_object() {
            return Err(
                Error::input("a scene is a JSON object").hint("begin with {\"name\": ..., \"dimension\": 2, ...}")
            );
        }
        builder::build(crate::body::parse::<SceneFile>(json)?, overrides)
    }
}

fn not_json(error: serde_json::Error) -> Error {
    let text = error.to_string();
    let message = text.rsplit_once(" at line").map_or(text.as_str(), |(message, _)| message);
    let hint = match message {
        "number out of range" => "JSON numbers go up to about 1.8e308",
        "expected value" => "JSON has no NaN, no Infinity, no comments and no trailing commas; text goes in quotes",
        "trailing comma" => "remove the comma after the last entry",
        _ => "check brackets, commas and quotes here and just before",
    };
    let error = Error::input(format!("this is not JSON: {message}")).hint(hint);
    match error {
        Error::Input(mut input) => {
            input.place = text.rsplit_once(" at line ").and_then(|(_, place)| {
                let (line, column) = place.split_once(" column ")?;
                Some((line.parse().ok()?, column.parse().ok()?))
            });
            Error::Input(input)
        }
        other => other,
    }
}

/// Adds file, line and column.
fn place(error: Error, path: &Path, text: &str) -> Error {
    let Error::Input(mut input) = error else { return error };
    if input.place.is_none() && !input.path.starts_with('-') && !input.path.is_empty() {
        input.place = locate::locate(text, &input.path);
    }
    input.file = Some(path.to_path_buf());
    Error::Input(input)
}

fn explain(path: &Path, error: &std::io::Error) -> String {
    use std::io::ErrorKind::*;
    match error.kind() {
        NotFound => "there is no such file".to_string(),
        PermissionDenied => "no permission to read it".to_string(),
        InvalidData => "it is not text (UTF-8)".to_string(),
        _ if path.is_dir() => "this is a directory; name a scene file".to_string(),
        _ => error.to_string(),
    }
}
