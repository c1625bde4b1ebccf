//! What a scene does not have of a model.

use crate::error::short_list;
use std::collections::BTreeMap;

/// Names of bodies, joints and actuators, under what is left out of them.
#[derive(Default)]
pub struct Told {
    owners: BTreeMap<String, Vec<String>>,
}

impl Told {
    /// `what`, as in "limits of the joints", is left out of this one.
    pub fn add(&mut self, what: impl Into<String>, name: &str) {
        let names = self.owners.entry(what.into()).or_default();
        if names.last().is_none_or(|last| last != name) {
            names.push(name.to_string());
        }
    }

    pub fn add_if(&mut self, is_so: bool, what: &str, name: &str) {
        if is_so {
            self.add(what, name);
        }
    }

    /// A sentence each.
    pub fn sentences(self) -> impl Iterator<Item = String> {
        self.owners.into_iter().map(|(what, names)| format!("{what} {}", short_list(&names)))
    }
}
