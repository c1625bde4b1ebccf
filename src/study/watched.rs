//! Quantities of a motion that are compared.

use crate::error::{Result, find};
use crate::simulate::Observation;
use crate::system::{Column, MechanicalSystem, OperatingPoint, Scratch};
use crate::trajectory::{on_pieces, recorded, values};

/// The quantities that are compared: outputs, or all coordinates of a system without outputs.
#[derive(Clone, Debug)]
pub struct Watched {
    /// Names and units.
    pub columns: Vec<Column>,
    /// Number of outputs of the system, and indices of the compared ones; none for coordinates.
    outputs: Option<(usize, Vec<usize>)>,
}

impl Watched {
    /// The outputs with these names, all where none is named.
    ///
    /// # Errors
    /// A name that is not an output of the system.
    pub fn new(system: &dyn MechanicalSystem, names: &[String]) -> Result<Watched> {
        let known = recorded(system);
        if known.is_empty() && names.is_empty() {
            let coordinate = |name| Column { name, unit: String::new() };
            return Ok(Watched {
                columns: system.facts().names.q.clone().into_iter().map(coordinate).collect(),
                outputs: None,
            });
        }
        let place = |name: &String| find("output", name, known.iter().map(|column| column.name.as_str()));
        let places: Vec<usize> = match names {
            [] => (0..known.len()).collect(),
            names => names.iter().map(place).collect::<Result<_>>()?,
        };
        let columns = places.iter().map(|place| known[*place].clone()).collect();
        Ok(Watched { columns, outputs: Some((known.len(), places)) })
    }

    /// Returns their values at a row of a run.
    pub fn read_row(&self, system: &dyn MechanicalSystem, state: &Observation, scratch: &mut Scratch) -> Vec<f64> {
        on_pieces(state, scratch, |scratch| self.read(system, (state.loaded(), state.works), scratch))
    }

    /// Returns their values at a state with its works.
    pub fn read(&self, system: &dyn MechanicalSystem, at: (OperatingPoint, &[f64]), scratch: &mut Scratch) -> Vec<f64> {
        let Some((count, places)) = &self.outputs else { return at.0.q.to_vec() };
        let all = values(system, at.0, at.1, *count, scratch);
        places.iter().map(|place| all[*place]).collect()
    }
}
