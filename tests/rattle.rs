//! RATTLE: constraints at round-off, energy without drift over a million steps, and what it refuses.

use crate::common::driven_pendulum::{self, DrivenPendulum};
use crate::common::equations::heavy_top::{self, HeavyTop};
use crate::common::equations::pendulum::{self, Pendulum};
use crate::common::equations::robot_arm::{self, RobotArm};
use crate::common::{fixed, run, until};
use crate::scenes::shipped;
use holonom::analysis::Recorder;
use holonom::simulate::{Observation, Sink, simulate};
use holonom::system::{MechanicalSystem, Scratch};

/// Largest errors over the accepted steps: of the energy, J, in the first and in the second half of a run, of what else
/// stays, and of the constraints.
struct Kept<'a> {
    system: &'a dyn MechanicalSystem,
    scratch: Scratch,
    half: f64,
    momentum: fn(&[f64], &[f64]) -> f64,
    start: Option<[f64; 2]>,
    energy: [f64; 2],
    off: f64,
    drift: [f64; 2],
}

impl Sink for Kept<'_> {
    fn accepted(&mut self, state: &Observation) {
        let energy = self.system.energy(state.t, state.q, state.v, &mut self.scratch).unwrap();
        let now = [energy.kinetic + energy.potential, (self.momentum)(state.q, state.v)];
        let start = self.start.get_or_insert(now);
        let half = &mut self.energy[usize::from(state.t > self.half)];
        *half = half.max((now[0] - start[0]).abs());
        self.off = self.off.max((now[1] - start[1]).abs());
        for (drift, rows) in self.drift.iter_mut().zip([state.phi, state.phi_dot]) {
            *drift = rows.iter().fold(*drift, |largest, row| largest.max(row.abs()));
        }
    }
}

/// `steps` steps of `h`.
fn long_run<'a>(
    system: &'a dyn MechanicalSystem,
    start: (&[f64], &[f64]),
    momentum: fn(&[f64], &[f64]) -> f64,
    (h, steps): (f64, f64),
) -> Kept<'a> {
    let mut kept = Kept {
        system,
        scratch: Scratch::default(),
        half: 0.5 * h * steps,
        momentum,
        start: None,
        energy: [0.0; 2],
        off: 0.0,
        drift: [0.0; 2],
    };
    let method = fixed("index3", "rattle", "none", h);
    let outcome = simulate(system, &method, until(h * steps), start, &mut kept).unwrap();
    assert_eq!(outcome.failure, None);
    kept
}

/// 10000 s.
#[test]
fn pendulum_keeps_its_energy_for_a_million_steps() {
    let Kept { energy: [first, second], drift, .. } =
        long_run(&Pendulum, pendulum::START.motion(), |_, _| 0.0, (0.01, 1e6));
    // 3.6e-3 of 9.81 J: O(h^2), and no growth.
    assert!(first < 4e-3 && second < 1.01 * first, "{first:e} {second:e}");
    // Lengths of 1 m and speeds up to 4.5 m/s.
    assert!(drift[0] < 4.0 * f64::EPSILON && drift[1] < 8.0 * f64::EPSILON * 4.5, "{drift:?}");
}

/// 100 s: 640 turns about its axis.
#[test]
fn top_keeps_its_energy_and_momentum_for_a_hundred_thousand_steps() {
    let (q, v) = heavy_top::start();
    let Kept { energy: [first, second], off, drift, .. } =
        long_run(&HeavyTop, (&q, &v), heavy_top::vertical_momentum, (1e-3, 1e5));
    // 4.588e-6 of 2.7 J: O(h^2), and no growth.
    assert!(first < 4.6e-6 && second < 1.001 * first, "{first:e} {second:e}");
    // The method keeps it: the rounding of 1e5 steps on 0.1 kg m^2/s, at random 300 ulps.
    assert!(off < 1e-14, "{off:e}");
    // Squares of 0.02 m^2, and speeds up to 5 m/s times 0.1 m.
    assert!(drift[0] < 3e-17 && drift[1] < 1e-15, "{drift:?}");
}

#[test]
fn rattle_needs_a_constant_mass() {
    let method = fixed("index3", "rattle", "none", 0.01);
    let failure = run(&RobotArm, &method, until(1.0), robot_arm::START.motion()).outcome.failure.unwrap();
    assert!(failure.t == 0.0 && failure.reason.contains("constant mass"), "{failure:?}");
    let shaft = shipped("universal_shaft", &[]);
    let mut recorder = Recorder::new(shaft.system());
    let error = simulate(shaft.system(), &method, until(1.0), shaft.0.start(), &mut recorder).unwrap_err();
    assert!(error.to_string().contains("N(q) v"), "{error}");
}

#[test]
fn both_constraints_hold() {
    let (q, v) = driven_pendulum::start();
    let run = run(&DrivenPendulum, &fixed("index3", "rattle", "none", 0.01), until(10.0), (&q, &v)).completed();
    let (position, velocity) = run.drift();
    assert!(position < 1e-15 && velocity < 1e-14);
    // One factorization a step and the first.
    assert_eq!(run.outcome.statistics.factorizations, 2 + 1000);
}
