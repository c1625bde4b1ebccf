//! An own integrator: one step of y' = F(t, y), with y = (q, v, work).

use holonom::Result;
use holonom::methods::Method;
use holonom::research::methods::{Control, Integrator, IntegratorEntry, Listed, Problem, StepError, StepStart};

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

#[test]
fn a_method_takes_it_by_its_entry() -> Result<()> {
    let method = Method { integrator: MIDPOINT.spec(), step: Some(1e-3), ..Method::default() };
    assert_eq!(method.triple(), "index1 + midpoint + manifold");
    // O(h^2) with h = 1e-3 s.
    assert!(super::swing(&method)? < 1e-5);
    Ok(())
}
