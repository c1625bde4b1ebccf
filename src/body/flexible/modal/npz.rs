//! Modal data in NumPy's `.npz` files: a zip archive with one `.npy` file for each array.

use super::array::Array;
use super::spec::{Lumped, ModalData, Node, Nodes};
use crate::error::{Error, Result, suggest};
use crate::files::npy::Npy;
use crate::files::npz::{self, Archive, member as bytes};
use std::path::Path;

/// Keys of arrays that have the same meaning as in JSON.
const PLAIN: [&str; 8] = [
    "mass",
    "center",
    "inertia",
    "modal_mass",
    "modal_stiffness",
    "modal_damping",
    "linear_coupling",
    "angular_coupling",
];
const NODES: [&str; 4] = ["node_names", "node_positions", "node_translations", "node_rotations"];
const LUMPED: [&str; 3] = ["lumped_masses", "lumped_positions", "lumped_translations"];

/// # Errors
/// Bad input: a file that is no archive of arrays, unknown or missing keys, arrays that do not fit.
pub fn read(path: &Path) -> Result<ModalData<Array>> {
    let mut archive = npz::open(path)?;
    let names = archive.file_names().filter_map(|name| name.ok().map(|name| name.into_owned()));
    let keys: Vec<String> = names.map(|name| name.trim_end_matches(".npy").to_string()).collect();
    let known = || PLAIN.into_iter().chain(NODES).chain(LUMPED);
    if let Some(key) = keys.iter().find(|key| !known().any(|name| name == **key)) {
        return Err(Error::input(format!("unknown key `{key}`")).hint(suggest(key, known())));
    }
    let mut plain = Vec::new();
    for key in PLAIN {
        plain.push(array(&mut archive, key)?);
    }
    let mut plain = plain.into_iter();
    let mut take = || plain.next().flatten();
    Ok(ModalData {
        mass: take(),
        center: take(),
        inertia: take(),
        modal_mass: take(),
        modal_stiffness: take(),
        modal_damping: take(),
        linear_coupling: take(),
        angular_coupling: take(),
        lumped: lumped(&mut archive)?,
        nodes: nodes(&mut archive)?,
    })
}

fn array(archive: &mut Archive, key: &str) -> Result<Option<Array>> {
    let Some(bytes) = bytes(archive, key)? else { return Ok(None) };
    let npy = Npy::parse(&bytes).map_err(|error| error.under(key))?;
    let values = npy.numbers().map_err(|error| error.under(key))?;
    if values.is_empty() {
        return Err(Error::input("the array is empty").under(key));
    }
    if let Some(bad) = values.iter().find(|value| !value.is_finite()) {
        return Err(Error::input(format!("holds {bad}")).under(key).hint("all numbers must be finite"));
    }
    Ok(Some(Array { shape: npy.shape, values }))
}

fn texts(archive: &mut Archive, key: &str) -> Result<Option<Vec<String>>> {
    let Some(bytes) = bytes(archive, key)? else { return Ok(None) };
    let texts = Npy::parse(&bytes).and_then(|npy| npy.texts());
    texts.map(Some).map_err(|error| error.under(key).hint("names are text, as '<U8'"))
}

fn missing(key: &str) -> Error {
    Error::input(format!("the key `{key}` is missing"))
}

/// Entry `i` of an array whose first index runs over `count` nodes or masses.
fn part(array: &Array, key: &str, i: usize, count: usize) -> Result<Array> {
    match array.shape.split_first() {
        Some((&length, rest)) if length == count => {
            let size: usize = rest.iter().product();
            Ok(Array { shape: rest.to_vec(), values: array.values[i * size..(i + 1) * size].to_vec() })
        }
        _ => Err(Error::input(format!("expected {count} rows, found shape {:?}", array.shape)).under(key)),
    }
}

fn nodes(archive: &mut Archive) -> Result<Option<Nodes<Array>>> {
    let Some(positions) = array(archive, NODES[1])? else { return Ok(None) };
    let translations = array(archive, NODES[2])?.ok_or_else(|| missing(NODES[2]))?;
    let rotations = array(archive, NODES[3])?;
    let count = positions.shape.first().copied().unwrap_or(0);
    let numbered = || (1..=count).map(|i| format!("node{i}")).collect();
    let names = texts(archive, NODES[0])?.unwrap_or_else(numbered);
    if names.len() != count {
        return Err(Error::input(format!("expected {count} names, found {}", names.len())).under(NODES[0]));
    }
    let node = |(i, name): (usize, String)| {
        let position = part(&positions, NODES[1], i, count)?;
        let translation = part(&translations, NODES[2], i, count)?;
        let rotation = rotations.as_ref().map(|array| part(array, NODES[3], i, count)).transpose()?;
        Ok((name, Node { position, translation, rotation }))
    };
    names.into_iter().enumerate().map(node).collect::<Result<_>>().map(|nodes| Some(Nodes(nodes)))
}

fn lumped(archive: &mut Archive) -> Result<Option<Vec<Lumped<Array>>>> {
    let Some(masses) = array(archive, LUMPED[0])? else { return Ok(None) };
    let positions = array(archive, LUMPED[1])?.ok_or_else(|| missing(LUMPED[1]))?;
    let translations = array(archive, LUMPED[2])?.ok_or_else(|| missing(LUMPED[2]))?;
    let count = masses.values.len();
    let one = |(i, mass): (usize, &f64)| {
        let position = part(&positions, LUMPED[1], i, count)?;
        Ok(Lumped { mass: Array::number(*mass), position, translation: part(&translations, LUMPED[2], i, count)? })
    };
    masses.values.iter().enumerate().map(one).collect::<Result<Vec<_>>>().map(Some)
}
