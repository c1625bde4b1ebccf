//! Names of a scene in the place of those of a robot.

use std::collections::{HashMap, HashSet};

/// Names of letters, digits and underscores, each once.
#[derive(Default)]
pub struct UniqueNames {
    taken: HashSet<String>,
    /// The number that was tried last behind each name.
    numbers: HashMap<String, usize>,
    /// Names that were changed, with the new ones.
    pub changed: Vec<(String, String)>,
}

impl UniqueNames {
    /// The name, or one like it where it cannot stand in a scene or is taken.
    pub fn unique(&mut self, given: &str) -> String {
        let fits = |c: char| if c.is_alphabetic() || c.is_ascii_digit() { c } else { '_' };
        let mut name: String = given.chars().map(fits).collect();
        if !name.starts_with(|c: char| c.is_alphabetic() || c == '_') {
            name.insert(0, '_');
        }
        let mut candidate = name.clone();
        while candidate == "ground" || !self.taken.insert(candidate.clone()) {
            let number = self.numbers.entry(name.clone()).or_insert(1);
            *number += 1;
            candidate = format!("{name}_{number}");
        }
        if candidate != given {
            self.changed.push((given.to_string(), candidate.clone()));
        }
        candidate
    }
}

#[cfg(test)]
mod tests {
    use super::UniqueNames;

    #[test]
    fn names_fit_and_are_unique() {
        let mut names = UniqueNames::default();
        let found = ["arm", "left-arm", "left_arm", "2nd", "", "ground", "ü1"].map(|name| names.unique(name));
        assert_eq!(found, ["arm", "left_arm", "left_arm_2", "_2nd", "_", "ground_2", "ü1"]);
        assert_eq!(names.changed.len(), 5);
    }
}
