//! What the integration tests share: models as own equations, and short ways to run a method.

#![allow(dead_code, reason = "each test binary uses its own part")]

pub mod counting;
pub mod driven_pendulum;
pub mod equations;
pub mod json_schema;
pub mod motor;
pub mod orders;
pub mod saved;
pub mod stiff;
pub mod unconstrained;

use holonom::analysis::{Record, Recorder};
use holonom::clock;
use holonom::integrator::{self, Tightening};
use holonom::method_spec::MethodSpec;
use holonom::simulate::{Method, Outcome, Span, simulate};
use holonom::system::MechanicalSystem;
use std::time::Duration;

/// Time for so many steps and rows: from now on the clock is counted, so that no test depends on the machine.
pub fn readings(count: u32) -> Duration {
    clock::count_readings();
    clock::TICK * count
}

/// A method by its names as on the command line.
pub fn method(formulation: &str, integrator: &str, projection: &str) -> Method {
    let spec = |text: &str| MethodSpec::parse(text).unwrap();
    Method {
        formulation: spec(formulation),
        integrator: spec(integrator),
        projection: spec(projection),
        ..Method::default()
    }
}

/// The same with a fixed step.
pub fn fixed(formulation: &str, integrator: &str, projection: &str, step: f64) -> Method {
    Method { step: Some(step), ..method(formulation, integrator, projection) }
}

/// Adaptive, with rtol = atol.
pub fn adaptive(formulation: &str, integrator: &str, projection: &str, tolerance: f64) -> Method {
    Method { rtol: tolerance, atol: tolerance, ..method(formulation, integrator, projection) }
}

/// Adaptive, with rtol = atol = `tolerance` of its steps: what is asked of the motion is looser.
pub fn stepwise(formulation: &str, integrator: &str, projection: &str, tolerance: f64) -> Method {
    let method = method(formulation, integrator, projection);
    let asked = asked_for(&method, tolerance);
    Method { rtol: asked, atol: asked, ..method }
}

/// What to ask of a motion so that its steps have the tolerance.
pub fn asked_for(method: &Method, tolerance: f64) -> f64 {
    let Tightening { factor, power, .. } = integrator::find(&method.integrator).unwrap().tightening;
    // Below that steps are controlled by what is asked.
    if tolerance < 1e-11 { tolerance } else { (tolerance / factor).powf(1.0 / power).max(tolerance) }
}

/// From 0 to `end` with rows at both ends only.
pub fn until(end: f64) -> Span {
    Span { start: 0.0, end, output_step: end }
}

/// What a run left behind.
pub struct Run {
    pub outcome: Outcome,
    pub record: Record,
}

impl Run {
    /// q, v and lambda of the last row.
    pub fn last(&self) -> (&[f64], &[f64], &[f64]) {
        self.record.trajectory.row_state(self.record.trajectory.rows.last().unwrap())
    }

    /// max |phi| and max |G v + phi_t| over the accepted steps.
    pub fn drift(&self) -> (f64, f64) {
        (self.record.drift.position.max, self.record.drift.velocity.max)
    }

    pub fn completed(self) -> Self {
        assert_eq!(self.outcome.failure, None);
        self
    }
}

pub fn run(system: &dyn MechanicalSystem, method: &Method, span: Span, start: (&[f64], &[f64])) -> Run {
    let mut recorder = Recorder::new(system);
    let outcome = simulate(system, method, span, start, &mut recorder).unwrap();
    Run { outcome, record: recorder.finish() }
}

/// max |x - y|
pub fn distance(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).fold(0.0, |largest: f64, (x, y)| largest.max((x - y).abs()))
}
