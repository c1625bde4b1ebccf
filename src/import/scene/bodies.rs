//! The bodies of a scene.

use super::Draft;
use super::valid::{Repaired, repaired};
use crate::body::MassProperties;
use crate::error::{percent, short, short_list};
use crate::math::array::Each;
use crate::math::rotation::Matrix3;
use serde_json::{Value, json};

impl Draft<'_> {
    /// Adds the bodies that move, before the rotors of joints.
    pub fn add_bodies(&mut self) {
        let rotors = std::mem::take(&mut self.scene.bodies);
        for body in (0..self.links.len()).filter(|link| self.tree.body[*link] == *link) {
            if !self.is_ground(body) {
                let value = self.body(body);
                self.scene.bodies.push(value);
            }
        }
        self.scene.bodies.extend(rotors);
    }

    fn body(&mut self, body: usize) -> Value {
        let MassProperties { mass, centre, inertia } = self.mass_properties(body);
        let j = self.valid(body, mass, inertia);
        let is_massless = mass == 0.0 && j.as_flattened().iter().all(|entry| *entry == 0.0);
        if is_massless && !self.robot.links[body].is_between {
            self.massless.push(self.robot.links[body].name.clone());
        }
        let place = self.tree.frames[body];
        json!({
            "name": self.links[body], "type": "rigid", "mass": mass,
            "inertia": [j[0][0], j[1][1], j[2][2], j[1][0], j[2][0], j[2][1]],
            "origin": centre.each(|x| -x),
            "markers": self.markers[body],
            "initial": { "position": place.r, "rotation": place.turn },
        })
    }

    /// Mass properties of a body from its origin, in its axes.
    fn mass_properties(&self, body: usize) -> MassProperties {
        let own = |link: &usize| Some(self.in_body(*link).mass(self.robot.links[*link].mass.as_ref()?));
        MassProperties::sum(self.tree.members[body].iter().filter_map(own).collect())
    }

    /// The tensor, or the nearest one that a body can have, with a warning.
    fn valid(&mut self, body: usize, mass: f64, tensor: Matrix3) -> Matrix3 {
        let Some(Repaired { tensor, change, before, after }) = repaired(&tensor, mass) else { return tensor };
        let own = |link: &&usize| {
            let given = self.robot.links[**link].mass.as_ref();
            given.is_some_and(|given| repaired(&given.inertia, given.mass).is_some())
        };
        let guilty = self.tree.members[body].iter().filter(own).map(|link| self.robot.links[*link].name.clone());
        let mut guilty: Vec<String> = guilty.collect();
        if guilty.is_empty() {
            guilty.push(self.robot.links[body].name.clone());
        }
        let changed =
            if change == 0.0 { String::new() } else { format!(", a change by {} of the largest", percent(change)) };
        self.warnings.push(format!(
            "no body has the moments of inertia {} kg m^2 of {}; the scene has {}{changed}",
            before.map(short).join(", "),
            short_list(&guilty),
            after.map(short).join(", "),
        ));
        tensor
    }
}
