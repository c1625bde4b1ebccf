//! The energy balance: kinetic + potential = initial + work.

use super::ledger::Ledger;
use crate::simulate::Observation;
use crate::system::{MechanicalSystem, Scratch};
use crate::tolerances;
use crate::trajectory::on_pieces;
use serde::Serialize;

/// An output row whose energy is off by so many errors of the steps is not of their motion: a warning. Unit: `[1]`.
/// Why: dense output is less accurate than steps by ten or so. Test: `a_row_that_no_step_confirms_is_told`.
const ROW_BEYOND_STEPS: f64 = 1e3;

/// The balance of a good run is open by less than so many times what the tolerance lets it. Unit: `[1]`. Why: the
/// promise of the README.
const ENERGY_BEYOND: f64 = 10.0;

/// Energy at the start and the end, and the largest error of the balance. The work of dampers, applied forces, tyres
/// and moving constraints is integrated along with the motion, so the error is the method's.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct EnergyBalance {
    /// Kinetic + potential at the start, J.
    pub initial: f64,
    /// Kinetic + potential at the end, J.
    #[serde(rename = "final")]
    pub last: f64,
    /// Work of non-conservative forces and moving constraints since the start, J.
    pub work: f64,
    /// max |kinetic + potential - initial - work|, J.
    pub max_error: f64,
    /// The same relative to the energy converted: the largest of kinetic energy, change of potential and work. None
    /// where that is negligible against the round-off of the energies, or against the tolerated error.
    pub relative_max_error: Option<f64>,
    /// Upper estimate of the sum of the tolerated errors of all steps, J; none for fixed steps.
    pub tolerated: Option<f64>,
}

/// The largest sizes of energies along a motion, J.
#[derive(Clone, Copy, Debug, Default)]
struct EnergySizes {
    kinetic: f64,
    potential: f64,
    /// Largest change of potential, and work.
    change: f64,
}

/// The step in which the energy balance changes most.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WorstStep {
    /// Time at its end, s.
    pub t: f64,
    /// Change of the balance, J.
    pub change: f64,
    /// The largest change in any other step, J.
    pub other: f64,
    /// Change due to the tolerated errors of the step, J.
    pub tolerated: f64,
    /// Number of steps.
    pub steps: usize,
}

impl WorstStep {
    fn add(&mut self, t: f64, change: f64, tolerated: f64) {
        self.steps += 1;
        if change > self.change {
            *self = WorstStep { t, change, other: self.change, tolerated, ..*self };
        } else {
            self.other = self.other.max(change);
        }
    }

    /// True if the balance changes far more than in any other step, and by more than a part of what is tolerated.
    pub fn is_alone(&self) -> bool {
        self.steps >= 10
            && self.change > tolerances::UNUSUAL_LOSS * self.other
            // Below 0.3, the motion is within its tolerance.
            && self.change > 0.3 * self.tolerated
    }
}

/// The output row with the largest error of the energy balance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WorstRow {
    /// Its time, s.
    pub t: f64,
    /// |error| of its balance, J.
    pub error: f64,
    /// Its kinetic energy and work, J.
    size: f64,
}

impl WorstRow {
    pub(super) fn add(&mut self, t: f64, ledger: &Ledger) {
        if ledger.error.abs() > self.error {
            *self = WorstRow { t, error: ledger.error.abs(), size: ledger.kinetic + ledger.work.abs() };
        }
    }

    /// True if the row has a part of its energy that no step has: rows and steps are not of one motion.
    pub fn contradicts(&self, steps: &EnergyBalance) -> bool {
        let of_steps = steps.max_error.max(steps.tolerated.unwrap_or(0.0));
        self.error > ROW_BEYOND_STEPS * of_steps && self.error > tolerances::TOLD * self.size
    }
}

/// Accumulates the energy balance along a motion.
#[derive(Clone, Debug, Default)]
pub struct EnergyMeter {
    balance: Option<EnergyBalance>,
    potential: f64,
    sizes: EnergySizes,
    /// Error of the balance at the last state, J.
    error: f64,
    worst: WorstStep,
}

impl EnergyBalance {
    /// True if the error is of the size of the energies that were converted: the motion means nothing.
    pub fn is_lost(&self) -> bool {
        self.relative_max_error.is_some_and(|part| part.is_nan() || part > tolerances::LOST_MOTION)
    }

    /// True if the balance has an error larger than the tolerance, or the order of a method, makes likely.
    pub fn is_open(&self) -> bool {
        let Some(part) =
            self.relative_max_error.filter(|part| part.is_nan() || *part > tolerances::ROUND_OFF_OF_SOLUTIONS.sqrt())
        else {
            return false;
        };
        part.is_nan()
            || part > tolerances::TOLD
            || self.tolerated.is_some_and(|tolerated| self.max_error > ENERGY_BEYOND * tolerated)
    }
}

impl EnergyMeter {
    /// Adds an accepted state. Returns its energies; `None` where the system defines no potential.
    pub fn add(&mut self, system: &dyn MechanicalSystem, state: &Observation, scratch: &mut Scratch) -> Option<Ledger> {
        let row = self.ledger(system, state, scratch)?;
        let total = row.kinetic + row.potential;
        if self.balance.is_none() {
            self.potential = row.potential;
        }
        let balance =
            self.balance.get_or_insert(EnergyBalance { initial: total - state.work, ..EnergyBalance::default() });
        (balance.last, balance.work) = (total, state.work);
        balance.max_error = balance.max_error.max(row.error.abs());
        let change = (row.error - std::mem::replace(&mut self.error, row.error)).abs();
        if let Some(tolerated) = state.tolerated {
            *balance.tolerated.get_or_insert(0.0) += tolerated;
            let round_off = tolerances::ROUND_OFF_OF_SOLUTIONS * (row.kinetic + row.potential.abs() + row.work.abs());
            self.worst.add(state.t, change.max(round_off), tolerated);
        }
        let EnergySizes { kinetic, potential, change } = &mut self.sizes;
        *kinetic = kinetic.max(row.kinetic);
        *potential = potential.max(row.potential.abs());
        *change = change.max((row.potential - self.potential).abs()).max(state.work.abs());
        Some(row)
    }

    /// Returns the balance at a state; `None` where the system defines no potential.
    pub fn ledger(&self, system: &dyn MechanicalSystem, state: &Observation, scratch: &mut Scratch) -> Option<Ledger> {
        let energy = on_pieces(state, scratch, |scratch| system.energy(state.t, state.q, state.v, scratch))?;
        let total = energy.kinetic + energy.potential;
        // A run that goes on from another one begins with the work done before.
        let initial = self.balance.map_or(total - state.work, |balance| balance.initial);
        let error = total - initial - state.work;
        Some(Ledger { kinetic: energy.kinetic, potential: energy.potential, work: state.work, error })
    }

    /// Returns the step in which the balance changed most, with controlled steps.
    pub fn worst(&self) -> WorstStep {
        self.worst
    }

    /// Returns the balance up to the last state; `None` before the first state or without a potential.
    pub fn balance(&self) -> Option<EnergyBalance> {
        let EnergySizes { kinetic, potential, change } = self.sizes;
        let turned_over = kinetic.max(change);
        self.balance.map(|balance| {
            let nothing = (tolerances::ROUND_OFF_OF_SOLUTIONS * potential)
                .max(tolerances::UNSEEN * balance.tolerated.unwrap_or(0.0));
            let relative_max_error = (turned_over > nothing).then(|| balance.max_error / turned_over);
            EnergyBalance { relative_max_error, ..balance }
        })
    }
}
