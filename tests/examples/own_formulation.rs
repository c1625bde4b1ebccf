//! An own formulation: a vector field q', v' for explicit integrators.

use holonom::Result;
use holonom::methods::Method;
use holonom::research::methods::{Dynamics, Formulation, FormulationEntry, Listed, OptionDoc, StepError};

/// phi'' + rate phi' = 0
pub static BRAKED: FormulationEntry = FormulationEntry {
    name: "braked",
    about: "phi'' + rate phi' = 0",
    options: &[OptionDoc { name: "rate", about: "at which phi' decays, 1/s (default 1)" }],
    dae: None,
    field: Some(|spec, _system| Ok(Box::new(Braked { rate: spec.not_negative("rate", 1.0)? }))),
};

struct Braked {
    rate: f64,
}

impl Formulation for Braked {
    fn derivative(
        &mut self,
        t: f64,
        q: &[f64],
        v: &[f64],
        dynamics: &mut Dynamics,
        qdot: &mut [f64],
        vdot: &mut [f64],
    ) -> Result<(), StepError> {
        // M v' + G^T lambda = f and G v' = gamma + what the closure says, of each row.
        dynamics.solve(t, q, v, |_phi, phi_dot| -self.rate * phi_dot)?;
        dynamics.system.rate(q, v, qdot);
        vdot.copy_from_slice(&dynamics.vdot);
        Ok(())
    }
}

#[test]
fn a_method_takes_it_by_its_entry() -> Result<()> {
    let method = Method { formulation: BRAKED.spec().with("rate", "2"), ..Method::default() };
    assert_eq!(method.triple(), "braked:rate=2 + dop853 + manifold");
    // Tolerances are 1e-8.
    assert!(super::swing(&method)? < 1e-7);
    Ok(())
}
