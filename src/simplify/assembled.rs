//! The start as assembled, in the words of the scene.

use super::facts::{initial, placed};
use super::source::Source;
use crate::linearize::State;
use crate::prepared::Model;
use crate::scene::document::{carrier, elements, find_mut, text};
use crate::tolerances::SAME;
use serde_json::Value;

/// The scene with the start of all bodies that assembly moves. A simpler model is assembled by itself, and from
/// the guesses of the scene it would come to another start. What assembly leaves where it is keeps its expressions.
/// Where the start of a moved body cannot be written (elastic coordinates, an angle that is `free` in space) all stays as
/// it is.
pub fn carried(source: &Source, prepared: &Model) -> Source {
    let moves = &prepared.assembly.moves;
    let is_moved = |body: &&Value| moves.iter().any(|change| carrier(&change.name) == text(body, "name"));
    let moved: Vec<&Value> = elements(&source.scene, "bodies").iter().filter(is_moved).collect();
    if moved.is_empty() {
        return source.clone();
    }
    let start = State::start(prepared);
    let places = placed(prepared, &start);
    let own = |body: &&Value| Some((text(body, "name").to_string(), initial(prepared, &start, &places, body)?));
    let Some(starts) = moved.iter().map(own).collect::<Option<Vec<_>>>() else { return source.clone() };
    let mut scene = source.scene.clone();
    for (name, initial) in starts {
        if let Ok(body) = find_mut(&mut scene, "bodies", &name) {
            body["initial"] = initial;
        }
    }
    let near = |own: &[f64], other: &[f64]| {
        own.len() == other.len() && own.iter().zip(other).all(|(x, y)| (x - y).abs() <= SAME * (1.0 + x.abs()))
    };
    let is_same = |again: Model| near(&start.q, again.start().0) && near(&start.v, again.start().1);
    if source.prepare(&scene).is_ok_and(is_same) { Source { scene, ..source.clone() } } else { source.clone() }
}
