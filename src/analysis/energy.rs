//! The energy balance: kinetic + potential = initial + work.

use crate::simulate::Observation;
use crate::system::{MechanicalSystem, Scratch};
use crate::tolerances::report as tolerances;
use serde::Serialize;

/// Energy at the start and the end, and the largest error of the balance. The work of dampers, applied forces, tyres
/// and moving constraints is integrated along with the motion, so the error is the method's.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
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
    /// The same as part of the energy turned over: the largest of kinetic energy, change of potential and work. None where
    /// that is nothing beside the round-off of the energies, or beside what is tolerated.
    pub relative_max_error: Option<f64>,
    /// What the tolerated errors of all steps add up to at most, J; none for fixed steps.
    pub tolerated: Option<f64>,
}

/// The largest sizes of energies along a motion, J.
#[derive(Clone, Copy, Debug, Default)]
struct Sizes {
    kinetic: f64,
    potential: f64,
    /// Of the change of potential, and the work.
    change: f64,
}

/// Follows the balance along a motion.
#[derive(Clone, Debug, Default)]
pub struct EnergyMeter {
    balance: Option<EnergyBalance>,
    potential: f64,
    sizes: Sizes,
}

/// One row of the ledger.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ledger {
    pub kinetic: f64,
    pub potential: f64,
    pub work: f64,
    pub error: f64,
}

impl EnergyBalance {
    /// Whether a balance is open by more than the tolerance, or the order of a method, leads to expect.
    pub fn is_open(&self) -> bool {
        let Some(part) =
            self.relative_max_error.filter(|part| part.is_nan() || *part > tolerances::ENERGY_ROUND_OFF.sqrt())
        else {
            return false;
        };
        part.is_nan()
            || part > tolerances::ENERGY_OPEN
            || self.tolerated.is_some_and(|tolerated| self.max_error > tolerances::ENERGY_BEYOND * tolerated)
    }
}

impl EnergyMeter {
    /// Adds an accepted state.
    pub fn add(&mut self, system: &dyn MechanicalSystem, state: &Observation, scratch: &mut Scratch) {
        let Some(row) = self.ledger(system, state, scratch) else { return };
        let total = row.kinetic + row.potential;
        if self.balance.is_none() {
            self.potential = row.potential;
        }
        let balance = self.balance.get_or_insert(EnergyBalance { initial: total, ..EnergyBalance::default() });
        (balance.last, balance.work) = (total, state.work);
        balance.max_error = balance.max_error.max(row.error.abs());
        if let Some(tolerated) = state.tolerated {
            *balance.tolerated.get_or_insert(0.0) += tolerated;
        }
        let Sizes { kinetic, potential, change } = &mut self.sizes;
        *kinetic = kinetic.max(row.kinetic);
        *potential = potential.max(row.potential.abs());
        *change = change.max((row.potential - self.potential).abs()).max(state.work.abs());
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
        let Sizes { kinetic, potential, change } = self.sizes;
        let turned_over = kinetic.max(change);
        self.balance.map(|balance| {
            let nothing = (tolerances::ENERGY_ROUND_OFF * potential)
                .max(tolerances::ENERGY_UNSEEN * balance.tolerated.unwrap_or(0.0));
            let relative_max_error = (turned_over > nothing).then(|| balance.max_error / turned_over);
            EnergyBalance { relative_max_error, ..balance }
        })
    }
}
