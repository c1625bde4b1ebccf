//! The energy balance: kinetic + potential = initial + work.

use crate::simulate::Observation;
use crate::system::{MechanicalSystem, Scratch};
use serde::Serialize;

/// Energy at the start and the end, and the largest error of the balance. The work of dampers, applied forces, tyres
/// and moving constraints is integrated along with the motion, so the error is the method's.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct EnergyBalance {
    /// Kinetic + potential at the start, J.
    pub initial: f64,
    /// Kinetic + potential at the end, J.
    #[serde(rename = "final")]
    pub last: f64,
    /// Work put in since the start, J.
    pub work: f64,
    /// max |kinetic + potential - initial - work|, J.
    pub max_error: f64,
    /// The same against the largest kinetic energy.
    pub relative_max_error: f64,
}

/// Follows the balance along a motion.
#[derive(Clone, Debug, Default)]
pub struct EnergyMeter {
    balance: Option<EnergyBalance>,
    largest_kinetic: f64,
}

/// One row of the ledger.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ledger {
    pub kinetic: f64,
    pub potential: f64,
    pub work: f64,
    pub error: f64,
}

impl EnergyMeter {
    /// Adds an accepted state.
    pub fn add(&mut self, system: &dyn MechanicalSystem, state: &Observation, scratch: &mut Scratch) {
        let Some(row) = self.ledger(system, state, scratch) else { return };
        let total = row.kinetic + row.potential;
        let start = EnergyBalance { initial: total, last: total, work: 0.0, max_error: 0.0, relative_max_error: 0.0 };
        let balance = self.balance.get_or_insert(start);
        (balance.last, balance.work) = (total, state.work);
        balance.max_error = balance.max_error.max(row.error.abs());
        self.largest_kinetic = self.largest_kinetic.max(row.kinetic);
        if self.largest_kinetic > 0.0 {
            balance.relative_max_error = balance.max_error / self.largest_kinetic;
        }
    }

    /// The balance at a state; `None` where the system states no potential.
    pub fn ledger(&self, system: &dyn MechanicalSystem, state: &Observation, scratch: &mut Scratch) -> Option<Ledger> {
        let energy = system.energy(state.t, state.q, state.v, scratch)?;
        let total = energy.kinetic + energy.potential;
        let initial = self.balance.map_or(total, |balance| balance.initial);
        let error = total - initial - state.work;
        Some(Ledger { kinetic: energy.kinetic, potential: energy.potential, work: state.work, error })
    }

    pub fn balance(&self) -> Option<EnergyBalance> {
        self.balance
    }
}
