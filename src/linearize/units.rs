//! Units of the states, inputs and outputs of a linear model.

use super::Coordinates;
use crate::system::MechanicalSystem;

/// Units of the numbers of a linear model; empty where one is not known.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Units {
    /// Units of x.
    pub states: Vec<String>,
    /// Units of u.
    pub inputs: Vec<String>,
    /// Units of y.
    pub outputs: Vec<String>,
}

/// Unit of z in charts with R^T M R = 1.
const NORMAL: &str = "kg^0.5 m";

impl Units {
    /// Those in a chart, with inputs of which derivatives of these orders are inputs of the model.
    pub(super) fn new(system: &dyn MechanicalSystem, chart: &Coordinates, orders: &[usize]) -> Self {
        let k = chart.freedom();
        let is_named = !["intrinsic", "mass_orthogonal", "frozen"].contains(&chart.name.as_str());
        let z: Vec<&str> = chart.states[..k].iter().map(|name| if is_named { along(name) } else { NORMAL }).collect();
        let facts = system.facts();
        let own = facts.inputs.iter().map(|column| column.unit.clone());
        let inputs: Vec<(String, usize)> = own.zip(orders.iter().copied()).collect();
        let rates = z.iter().map(|unit| rate(unit, 1));
        let internal = std::iter::repeat_n(String::new(), chart.r.ncols() - k);
        let of_inputs = inputs.iter().flat_map(|(unit, order)| (0..*order).map(move |i| rate(unit, i)));
        Units {
            states: z.iter().map(|unit| unit.to_string()).chain(rates).chain(internal).chain(of_inputs).collect(),
            inputs: inputs.iter().map(|(unit, order)| rate(unit, *order)).collect(),
            outputs: facts.outputs.iter().map(|column| column.unit.clone()).collect(),
        }
    }
}

/// Returns the unit of a change along a direction, by its name.
fn along(name: &str) -> &'static str {
    match () {
        _ if ["angle", "rx", "ry", "rz"].iter().any(|end| name.ends_with(end)) => "rad",
        _ if [".x", ".y", ".z"].iter().any(|end| name.ends_with(end)) => "m",
        _ => "",
    }
}

/// Returns the unit of a derivative: `m/s^2` for the second of `m`.
fn rate(unit: &str, order: usize) -> String {
    let per = match order {
        _ if unit.is_empty() => String::new(),
        0 => String::new(),
        1 => "/s".to_string(),
        order => format!("/s^{order}"),
    };
    format!("{unit}{per}")
}
