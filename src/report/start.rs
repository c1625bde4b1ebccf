//! What `check` says of the motion at the start.

use super::Table;
use crate::error::significant;
use crate::initial::Assembly;
use crate::math::largest;
use crate::study::Study;
use crate::system::{Loaded, Scratch};
use crate::tolerances::report as tolerances;
use serde::Serialize;
use serde_json::{Map, Value};

/// Rates and outputs at the assembled start.
#[derive(Clone, Debug, Serialize)]
pub struct Start {
    /// max |v| and max |v'|, m and rad per s and s^2.
    pub velocity: f64,
    pub acceleration: f64,
    /// Whether nothing moves, and nothing will.
    pub is_equilibrium: bool,
    pub outputs: Map<String, Value>,
    #[serde(skip)]
    units: Vec<String>,
}

impl Start {
    pub fn of(study: &Study) -> Start {
        let Assembly { q, v, vdot, lambda, .. } = &study.assembly;
        let columns = study.system().columns();
        let mut values = vec![0.0; columns.len()];
        let at = Loaded { t: study.start_time(), q, v, vdot, lambda };
        study.system().outputs(at, &mut values, &mut Scratch::default());
        let (velocity, acceleration) = (largest(v), largest(vdot));
        Start {
            velocity,
            acceleration,
            is_equilibrium: velocity == 0.0 && acceleration < tolerances::RESTING_START,
            outputs: columns
                .iter()
                .map(|column| column.name.clone())
                .zip(values.into_iter().map(Value::from))
                .collect(),
            units: columns.into_iter().map(|column| column.unit).collect(),
        }
    }

    pub fn text(&self) -> String {
        let mut text = match (self.is_equilibrium, self.velocity) {
            (true, _) => format!("static equilibrium: at rest, accelerations below {:.1e}\n", self.acceleration),
            (false, 0.0) => {
                format!("at rest, accelerations up to {} m/s^2 or rad/s^2\n", significant(self.acceleration, 4))
            }
            _ => String::new(),
        };
        if !self.outputs.is_empty() {
            let mut table = Table::new(&["output at the start", "", ""]);
            for ((name, value), unit) in self.outputs.iter().zip(&self.units) {
                let value = value.as_f64().map_or("?".to_string(), |value| significant(value, 8));
                table.row([name.clone(), value, unit.clone()]);
            }
            text += &format!("\n{table}\n");
        }
        text
    }
}
