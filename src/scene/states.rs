//! States xi of a scene, each a body of one velocity with its rate as a force.

use super::format::StateSpec;
use super::measures::OutputSpec;
use super::model::{Connection, ModelForce};
use super::names::check_name;
use super::parts::SceneParts;
use crate::body::{Build, BuiltBody, StateBody};
use crate::error::{Error, Result};
use crate::force::{Force, StateRate};

/// Adds the states after all bodies, with their initial values.
pub fn place<const D: usize>(
    specs: &[StateSpec],
    outputs: &[OutputSpec],
    parts: &mut SceneParts<D>,
    build: &Build<D>,
) -> Result<()> {
    for (i, spec) in specs.iter().enumerate() {
        let place = |error: Error| error.under(format!("states[{i}]"));
        let others = &specs[..i];
        let name = spec.name.as_str();
        let taken = [
            (name == "t" || name == "pi", "a name that every expression knows"),
            (others.iter().any(|known| known.name == name), "that of another state"),
            (build.parameters.get(name).is_some(), "that of a parameter"),
            (outputs.iter().any(|known| known.name == name), "that of an output"),
        ];
        let free = match taken.iter().find(|(taken, _)| *taken) {
            Some((_, what)) => {
                Err(Error::input(format!("the name `{name}` is {what}")).hint("give each state a name of its own"))
            }
            None => check_name(name),
        };
        free.map_err(|error| place(error.under("name")))?;
        let initial = spec.initial.as_ref().map_or(Ok(0.0), |initial| build.number("initial", initial));
        let v = vec![initial.map_err(|error| place(error.element(name)))?];
        parts.place_state(name, BuiltBody { body: Box::new(StateBody::new()), q: Vec::new(), v });
    }
    Ok(())
}

/// The rates of the states, which may use all of them.
pub fn rates<const D: usize>(specs: &[StateSpec], build: &Build<D>) -> Result<Vec<ModelForce<D>>> {
    let rate = |(i, (spec, &(_, marker))): (usize, (&StateSpec, &(String, usize)))| {
        let acting = build.acting("rate", &spec.rate, true).and_then(|rate| StateRate::new(marker, rate));
        let rate = acting.map_err(|error| error.element(&spec.name).under(format!("states[{i}]")))?;
        build.own("state", &spec.name);
        let name = format!("{}'", spec.name);
        let markers = rate.markers().to_vec();
        Ok(Connection { name, kind: "rate", element: Box::new(rate) as Box<dyn Force<D>>, markers })
    };
    specs.iter().zip(&build.markers.states).enumerate().map(rate).collect()
}
