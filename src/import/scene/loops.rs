//! Joints that close loops.

use super::{Draft, aimed};
use crate::error::{Error, Result};
use crate::import::close::Closure;
use crate::import::names::UniqueNames;
use crate::import::robot::Loop;
use crate::import::transform::Transform;
use crate::import::tree::find;
use serde_json::json;

impl Draft<'_> {
    /// Adds a joint that the command line names.
    pub fn close_by(&mut self, closure: &Closure, names: &mut UniqueNames) -> Result<()> {
        let [(a, at_a), (b, at_b)] = &closure.ends;
        let links = [find(self.robot, a)?, find(self.robot, b)?];
        self.refuse_one_body(links[0], links[1])?;
        let axes = aimed(closure.axis)?;
        // The same axes in the world at the file's positions, so that other positions change the guess alone.
        let turned = self.first_in_second(links[0], links[1]).then(&axes);
        let frames = [Transform { r: *at_a, ..axes }, Transform { r: *at_b, ..turned }];
        self.add_loop(&names.unique(&closure.name), closure.kind, links, frames);
        Ok(())
    }

    /// Adds a joint of the file.
    pub fn close(&mut self, given: &Loop, names: &mut UniqueNames) -> Result<()> {
        let [a, b] = given.links;
        self.refuse_one_body(a, b).map_err(|error| error.element(&given.name))?;
        let own = given.frames[0].unwrap_or_default();
        let other = given.frames[1].unwrap_or_else(|| self.first_in_second(a, b).then(&own));
        self.add_loop(&names.unique(&given.name), given.kind, given.links, [own, other]);
        Ok(())
    }

    /// Frame of the first link in the second one at the file's positions.
    fn first_in_second(&self, a: usize, b: usize) -> Transform {
        self.tree.at_zero[b].inverse().then(&self.tree.at_zero[a])
    }

    fn refuse_one_body(&self, a: usize, b: usize) -> Result<()> {
        if self.tree.body[a] != self.tree.body[b] {
            return Ok(());
        }
        let a = &self.robot.links[a].name;
        let b = &self.robot.links[b].name;
        Err(Error::input(format!("`{a}` and `{b}` are one body")).hint("name links that joints let move"))
    }

    fn add_loop(&mut self, name: &str, kind: &str, links: [usize; 2], frames: [Transform; 2]) {
        let between = [self.mark(links[0], &frames[0], name), self.mark(links[1], &frames[1], name)];
        self.scene.joints.push(json!({ "name": name, "type": kind, "between": between }));
    }
}
