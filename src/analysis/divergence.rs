//! Motions that a force feeds without end.

use super::ledger::Ledger;
use crate::simulate::{Observation, Stop};
use crate::system::{Feed, MechanicalSystem, Scratch};
use crate::tolerances;

/// Up to so many times what the forces give over a length of the scene, a state shows what the scene holds. Unit:
/// `[1]`. Why: bodies move some lengths. Test: `a_motion_that_a_force_feeds_without_end_ends`.
const ENERGY_OF_EFFORT: f64 = 10.0;

/// A motion may diverge whose energy is beyond what the scene holds by this. Unit: `[1]`. Why: no scene travels a
/// million of its lengths under its largest force. Test: `a_motion_that_a_force_feeds_without_end_ends`.
const ENERGY_DIVERGED: f64 = 1e6;

/// Growth of the energy between two looks at the forces. Unit: `[1]`. Test:
/// `a_motion_that_a_force_feeds_without_end_ends`.
const ENERGY_LOOKED: f64 = 4.0;

/// Compares the energy E, kinetic + change of potential, with what the scene holds.
///
/// A force F gives F x over a distance x. So a scene of length L holds its kinetic energy at the start and the largest
/// F L so far, F the sum of forces and multipliers. F grows with a motion that diverges: states count up to E of some F
/// L. Where E is far beyond, and the force of the largest power grows with it, the motion diverges.
#[derive(Default)]
pub struct Divergence {
    start: Option<MotionStart>,
    /// Energy that the scene holds, J.
    held: f64,
    /// E and the sizes of all forces at the last look at them.
    looked: f64,
    sizes: Vec<f64>,
    /// A length of the scene, m; at least 1.
    length: Option<f64>,
}

struct MotionStart {
    q: Vec<f64>,
    v: Vec<f64>,
    potential: f64,
}

impl Divergence {
    /// Adds an accepted state with its energies. Returns the reason to end the run, if the motion diverges.
    pub fn add(
        &mut self,
        system: &dyn MechanicalSystem,
        state: &Observation,
        ledger: &Ledger,
        scratch: &mut Scratch,
    ) -> Option<Stop> {
        let effort = state.effort? * *self.length.get_or_insert_with(|| system.facts().length.max(1.0));
        let Some(start) = &self.start else {
            self.start = Some(MotionStart { q: state.q.to_vec(), v: state.v.to_vec(), potential: ledger.potential });
            self.held = ledger.kinetic + effort;
            return None;
        };
        let energy = ledger.kinetic + (ledger.potential - start.potential).abs();
        if energy <= ENERGY_OF_EFFORT * effort {
            self.held = self.held.max(effort);
        }
        let is_beyond = energy > ENERGY_DIVERGED * self.held;
        let is_near = ENERGY_LOOKED * energy > ENERGY_DIVERGED * self.held;
        if !is_near || energy < ENERGY_LOOKED * self.looked {
            return None;
        }
        self.looked = energy;
        let feeds = system.feeds(state.t, state.q, state.v, scratch);
        let before = std::mem::replace(&mut self.sizes, feeds.iter().map(|feed| feed.size).collect());
        let (i, feed) = feeds.iter().enumerate().max_by(|a, b| a.1.power.total_cmp(&b.1.power))?;
        // A force in proportion to a motion that diverges grows by 2.
        let has_grown = feed.size > 1.5 * before.get(i).copied().unwrap_or(f64::INFINITY);
        let at_start = system.feeds(state.t, &start.q, &start.v, scratch);
        let is_given = (at_start[i].size - feed.size).abs() <= tolerances::SAME * feed.size;
        (is_beyond && feed.power > 0.0 && has_grown && !is_given).then(|| diverged(feed, energy, self.held))
    }
}

fn diverged(feed: &Feed, energy: f64, held: f64) -> Stop {
    let reason = format!(
        "the motion diverges: its energy has grown to {energy:.1e} J, the scene holds {held:.1e} J, and the force `{}` \
         feeds it with {:.1e} W",
        feed.name, feed.power
    );
    let hint = "check the signs of its law: it drives the motion away from rest in the place of holding it".to_string();
    Stop { reason, hint }
}
