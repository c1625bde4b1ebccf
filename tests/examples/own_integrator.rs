//! An own integrator: one step of y' = F(t, y), with y = (q, v, work).

use holonom::parts::Elements;
use holonom::prelude::*;
use holonom::research::methods::{Control, Integrator, IntegratorEntry, Listed, Problem, StepError, StepStart};
use holonom::run::Overrides;

/// The explicit midpoint rule, y_1 = y + h F(t + h/2, y + h/2 F(t, y)).
pub static MIDPOINT: IntegratorEntry = IntegratorEntry::new("midpoint", "the explicit midpoint rule", 2, |setup| {
    let zeros = || vec![0.0; setup.len()];
    Ok(Box::new(Midpoint { middle: zeros(), slope: zeros(), control: Control::new(2.0, 0.2, 5.0) }))
});

struct Midpoint {
    middle: Vec<f64>,
    slope: Vec<f64>,
    control: Control,
}

impl Integrator for Midpoint {
    fn attempt(&mut self, problem: &mut Problem, from: StepStart, to: &mut [f64]) -> Result<Option<f64>, StepError> {
        let h = from.h;
        let ahead = |out: &mut [f64], h: f64, slope: &[f64]| {
            out.iter_mut().zip(from.y.iter().zip(slope)).for_each(|(out, (y, slope))| *out = y + h * slope);
        };
        ahead(&mut self.middle, 0.5 * h, from.slope);
        problem.derivative(from.t + 0.5 * h, &self.middle, &mut self.slope)?;
        ahead(to, h, &self.slope);
        Ok(None)
    }

    /// Steps are fixed, but a method with an error estimate is controlled by it.
    fn control(&mut self) -> &mut Control {
        &mut self.control
    }
}

const PENDULUM: &str = r#"{
    "name": "pendulum", "dimension": 2, "gravity": [0, -9.81],
    "bodies": [{ "name": "bob", "type": "point_mass", "mass": 2, "initial": { "position": [0.5, 0] } }],
    "joints": [{ "name": "rod", "type": "distance", "between": ["ground", "bob"], "length": 0.5 }],
    "simulation": { "integrator": "midpoint", "step": 1e-3, "t_end": 2 } }"#;

fn main() -> Result<()> {
    // A scene names it as it names a built-in one.
    let overrides = Overrides { elements: Elements::default().with_method(&MIDPOINT)?, ..Overrides::default() };
    let pendulum = Family::parse_with(PENDULUM, &overrides)?.model()?;
    let mut run = pendulum.run();
    run.to(2.0)?;
    // O(h^2) with h = 1e-3 s.
    assert!(run.record().energy_error() < 1e-5);
    println!("{}: energy {:.1e}", pendulum.method.triple(), run.record().energy_error());

    // In code a method takes its entry.
    let method = Method { integrator: MIDPOINT.spec(), step: Some(1e-3), ..Method::default() };
    assert_eq!(method.triple(), "index1 + midpoint + manifold");
    let end = simulate(&pendulum, method, pendulum.start(), 0.0..2.0)?.state;
    assert_eq!(end.q, run.state()?.q);
    Ok(())
}

#[test]
fn a_scene_and_a_method_take_it() -> holonom::Result<()> {
    main()
}
