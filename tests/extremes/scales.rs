//! Step control where speeds and distances from the origin are large, and where a first guess leads nowhere.

use crate::common::{Run, adaptive, distance, run, stepwise, until};
use crate::scenes::{Ready, parse};
use holonom::analysis::Recorder;
use holonom::math::Scalar;
use holonom::simulate::{Observation, Sink, Stop, simulate};
use holonom::system::Equations;
use std::time::Duration;

/// A pendulum of 1 m beside a pivot at x, with a speed upwards.
fn pendulum(x: f64, speed: f64) -> Ready {
    parse(&format!(
        r#"{{ "name": "pendulum", "dimension": 2, "gravity": [0, -9.81],
             "ground": {{ "markers": {{ "O": [{x:e}, 0] }} }},
             "bodies": [{{ "name": "bob", "type": "point_mass", "mass": 1,
                           "initial": {{ "position": [{:e}, 0], "velocity": [0, {speed:e}] }} }}],
             "joints": [{{ "name": "rod", "type": "distance", "between": ["ground.O", "bob"], "length": 1 }}] }}"#,
        x + 1.0
    ))
}

/// Ends a run that takes far too many steps.
struct Limited<'a>(Recorder<'a>, u64);

impl Sink for Limited<'_> {
    fn accepted(&mut self, state: &Observation) {
        self.1 += 1;
        self.0.accepted(state);
    }
    fn row(&mut self, state: &Observation) {
        self.0.row(state);
    }
    fn stops(&self) -> Option<Stop> {
        (self.1 > 5000).then(|| Stop::deadline(Duration::ZERO))
    }
}

/// Positions are known to 1e-10 m there: Newton's method may not ask for more.
#[test]
fn a_thousand_kilometres_from_the_origin() {
    let here = pendulum(0.0, 0.0);
    let there = pendulum(1e6, 0.0);
    for [formulation, integrator, projection] in [
        ["index1", "dop853", "manifold"],
        ["ggl", "radau_iia", "none"],
        ["ggl", "generalized_alpha", "none"],
        ["index3", "generalized_alpha", "none"],
    ] {
        let method = stepwise(formulation, integrator, projection, 1e-6);
        let near = run(here.system(), &method, until(1.0), here.0.start()).completed();
        let mut sink = Limited(Recorder::new(there.system()), 0);
        let outcome = simulate(there.system(), &method, until(1.0), there.0.start(), &mut sink).unwrap();
        let far = Run { outcome, record: sink.0.finish() }.completed();
        let (q, _, _) = far.last();
        let error = distance(&[q[0] - 1e6, q[1]], near.last().0);
        println!("{formulation} {integrator}: {error:e}");
        // rtol counts from the origin, so that x may be off by a metre times 1e-6 of its distance; y is not.
        assert!(error < 1e-3, "{formulation} {integrator}: {error:e}");
    }
}

/// A motion that turns in 1e-60 s, of which a second derivative says that a first step of 1e-120 s would be good.
#[test]
fn turns_at_any_speed_are_alike() {
    let slow = pendulum(0.0, 1e6);
    let fast = pendulum(0.0, 1e60);
    for [formulation, integrator, projection] in
        [["index1", "dop853", "manifold"], ["index2", "phem56", "none"], ["ggl", "radau_iia", "none"]]
    {
        let method = adaptive(formulation, integrator, projection, 1e-10);
        let first = run(slow.system(), &method, until(1e-5), slow.0.start()).completed();
        let second = run(fast.system(), &method, until(1e-59), fast.0.start()).completed();
        let error = distance(first.last().0, second.last().0);
        // 1.6 turns, with the tolerance over some hundred steps; gravity is nothing beside 1e12 m/s^2.
        assert!(error < 1e-7, "{formulation} {integrator}: {error:e}");
    }
}

/// A mass on a rail whose force is there below 1e-3 m/s only; as strong as at first it would drive it over that in 0.1 us.
struct Shy;

const LIMIT: f64 = 1e-3;
const RATE: f64 = 1e7;

impl Equations for Shy {
    fn size(&self) -> (usize, usize) {
        (2, 1)
    }
    fn mass<S: Scalar>(&self, _t: S, _q: &[S], mass: &mut [S]) {
        mass.copy_from_slice(&[S::one(), S::zero(), S::zero(), S::one()]);
    }
    fn force<S: Scalar>(&self, _t: S, _q: &[S], v: &[S], f: &mut [S]) {
        f[0] = ((-v[0] / LIMIT) + 1.0).sqrt() * (RATE * LIMIT);
        f[1] = S::zero();
    }
    fn phi<S: Scalar>(&self, _t: S, q: &[S], phi: &mut [S]) {
        phi[0] = q[1];
    }
}

/// sqrt(1 - v/v1) falls linearly in time, by RATE/2.
#[test]
fn a_first_guess_where_the_forces_end() {
    let end = 1.5 / RATE;
    let tolerance = 1e-9;
    let exact = LIMIT * (1.0 - (1.0 - 0.5 * RATE * end).powi(2));
    for integrator in ["dop853", "dopri5"] {
        let run = run(&Shy, &adaptive("index1", integrator, "none", tolerance), until(end), (&[0.0; 2], &[0.0; 2]));
        let error = (run.completed().last().1[0] - exact).abs();
        assert!(error < 10.0 * tolerance, "{integrator}: {error:e}");
    }
}
