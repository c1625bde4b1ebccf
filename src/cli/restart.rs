//! `--start FILE`: the end of another run of the same scene.

use crate::error::{Error, Result, Warning};
use crate::prepared::Model;
use crate::simulate::Checkpoint;
use serde::Deserialize;
use serde_json::{Map, Value};
use std::path::Path;

/// The part of a `summary.json` that is read.
#[derive(Deserialize)]
struct SavedSummary {
    parameters: Map<String, Value>,
    #[serde(default)]
    scene_hash: String,
    r#final: LastRow,
    restart: Option<Checkpoint>,
}

#[derive(Deserialize)]
struct LastRow {
    q: Map<String, Value>,
    v: Map<String, Value>,
}

/// Reads the state from which the run of this summary can continue, with a scene that may be `changed` since.
pub fn read(path: &Path, prepared: &Model, changed: bool) -> Result<Checkpoint> {
    let text = crate::files::read_json(path).map_err(|error| Error::file(path, error))?;
    let saved = serde_json::from_str(&text).map_err(|error| {
        Error::input(format!("it is no summary of a run: {error}"))
            .hint("name the summary.json that `holonom simulate` has written")
    });
    let saved = saved.and_then(|saved| checked(saved, prepared, changed));
    saved.map_err(|error| error.under("--start").in_file(path))
}

/// Refuses a run of another scene, and a state that no run has left.
fn checked(
    SavedSummary { parameters, scene_hash, r#final: LastRow { q, v }, restart }: SavedSummary,
    prepared: &Model,
    changed: bool,
) -> Result<Checkpoint> {
    let names = prepared.system().facts().names.clone();
    let other = |found: &Map<String, Value>, known: &[String]| {
        let is_known = |name: &&String| known.contains(name);
        let new = found.keys().find(|name| !is_known(name)).or(known.iter().find(|name| !found.contains_key(*name)));
        new.cloned().or_else(|| found.keys().zip(known).find(|(a, b)| a != b).map(|(a, _)| a.clone()))
    };
    if let Some(name) = other(&q, &names.q).or_else(|| other(&v, &names.v)) {
        return Err(Error::input(format!(
            "it is of another scene than `{}`: they do not share `{name}`",
            prepared.name
        ))
        .hint("a run goes on with the scene, and the parameters, that it began with"));
    }
    for (name, value) in prepared.parameters.iter() {
        let saved = parameters.get(name).and_then(Value::as_f64);
        if saved != Some(value) && !changed {
            let was = saved.map_or("missing".to_string(), |saved| saved.to_string());
            return Err(Error::input(format!("the parameter `{name}` is {value} here and {was} there"))
                .hint(format!("give --set {name}={was}, or begin anew without --start")));
        }
    }
    if scene_hash != prepared.fingerprint && !changed {
        return Err(Error::input(format!(
            "the scene `{}` is not the one of that run: it was changed since",
            prepared.name
        ))
        .hint("begin anew without --start; or give --changed, if the motion is to go on in the changed scene"));
    }
    let restart =
        restart.ok_or_else(|| Error::input("that run could not begin, so that there is nothing to go on from"))?;
    restart.check(prepared.system())?;
    Ok(restart)
}

/// Returns a warning if the run does not continue as it was.
pub fn doubt(saved: &Checkpoint, prepared: &Model) -> Option<Warning> {
    let t = saved.t();
    let method = saved.method();
    if !prepared.is_automatic && *method != prepared.method {
        return Some(Warning::new(
            format!("the method is another one than up to t = {t} s, and begins anew from the state there"),
            format!("with {} at the same tolerances or step the run would go on as it was", method.triple()),
        ));
    }
    (!saved.is_exact()).then(|| {
        Warning::new(
            format!("{} begins anew at t = {t} s, with what it knows of that state alone", method.integrator.name),
            "the run goes on within the tolerance, but not bit by bit as it would have",
        )
    })
}
