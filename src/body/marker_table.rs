//! The markers of a scene by their names.

use crate::error::{Error, Result, nearest, suggest};
use std::collections::HashMap;

/// Index of a marker among all markers of a scene, those of the ground included.
pub type MarkerId = usize;

/// The markers of a scene by their full names, `body.marker`.
#[derive(Clone, Debug, Default)]
pub struct MarkerTable {
    /// Full names in order; `body` alone names the marker at the body's own frame.
    pub names: Vec<String>,
    /// Index of the body that carries it; `None` is the ground.
    pub bodies: Vec<Option<usize>>,
    /// Names of the bodies, nodes of absolute beams among them.
    pub body_names: Vec<String>,
    /// False for point masses, whose markers have no orientation.
    pub oriented: Vec<bool>,
    /// Names of the states with their markers, which no reference can name.
    pub states: Vec<(String, MarkerId)>,
    places: HashMap<String, MarkerId>,
}

impl MarkerTable {
    /// Adds a marker; that of the body's own frame has to be its first.
    pub fn add(&mut self, name: String, body: Option<usize>, oriented: bool) {
        self.places.insert(name.clone(), self.names.len());
        self.names.push(name);
        self.bodies.push(body);
        self.oriented.push(oriented);
    }

    /// Adds the marker of a state, a body of its own.
    pub fn add_state(&mut self, name: String, body: usize) {
        self.states.push((name.clone(), self.names.len()));
        self.names.push(name);
        self.bodies.push(Some(body));
        self.oriented.push(false);
    }

    /// True if a marker has this name; that of a body or `ground` names its own frame.
    pub fn has_body(&self, name: &str) -> bool {
        self.places.contains_key(name)
    }

    /// Index of the marker with this full name.
    pub fn find(&self, name: &str) -> Result<MarkerId> {
        self.places.get(name).copied().ok_or_else(|| {
            let given = self.names.len() - self.states.len();
            let names = || self.names[..given].iter().map(String::as_str);
            // A body's own frame may be meant; where nothing is near, its markers are listed alone.
            let hint = match nearest(name, names()) {
                Some(near) => format!("did you mean `{near}`?"),
                None => suggest(name, names().filter(|known| known.contains('.'))),
            };
            Error::input(format!("there is no marker `{name}`")).hint(hint)
        })
    }
}
