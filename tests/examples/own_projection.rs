//! An own projection: what is done to q and v after each step.

use holonom::Result;
use holonom::methods::Method;
use holonom::research::methods::{Dynamics, Listed, Projection, ProjectionEntry, StepError};
use holonom::system::Need;

/// Velocities back to G v + phi_t = 0, moving least in the mass metric; positions drift.
pub static VELOCITIES: ProjectionEntry = ProjectionEntry {
    name: "velocities",
    about: "G v + phi_t = 0 after each step",
    options: &[],
    make: |_choice, system| Ok(Some(Box::new(Velocities { dv: vec![0.0; system.dimensions().v] }))),
};

struct Velocities {
    dv: Vec<f64>,
}

impl Projection for Velocities {
    fn project(&mut self, t: f64, q: &mut [f64], v: &mut [f64], dynamics: &mut Dynamics) -> Result<(), StepError> {
        dynamics.evaluate(t, q, v, Need::MASS | Need::CONSTRAINTS | Need::G);
        dynamics.factor_truncated()?;
        // M dv + G^T mu = 0, G dv = phi'
        dynamics.kkt.solve_projection(&dynamics.terms.phi_dot, &mut self.dv)?;
        v.iter_mut().zip(&self.dv).for_each(|(v, dv)| *v -= dv);
        Ok(())
    }
}

#[test]
fn a_method_takes_it_by_its_entry() -> Result<()> {
    let method = Method { projection: VELOCITIES.spec(), ..Method::default() };
    assert_eq!(method.triple(), "index1 + dop853 + velocities");
    // Tolerances are 1e-8.
    assert!(super::swing(&method)? < 1e-7);
    Ok(())
}
