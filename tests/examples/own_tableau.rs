//! An own explicit Runge-Kutta method: its tableau.

use holonom::Result;
use holonom::methods::Method;
use holonom::research::methods::{Control, ErrorEstimate, Explicit, IntegratorEntry, Listed, Steps, Tableau};

/// Bogacki and Shampine, Appl. Math. Lett. 2 (1989) 321-325: order 3 with an error estimate of order 2, adaptive steps.
static BS23: IntegratorEntry = IntegratorEntry {
    steps: Steps::Either,
    stability: Some(|| TABLEAU.stability()),
    ..IntegratorEntry::new("bs23", "Bogacki and Shampine's pair, 4 evaluations a step", 3, |setup| {
        Ok(Box::new(Explicit::new(&TABLEAU, setup.len())))
    })
};

static TABLEAU: Tableau = Tableau {
    order: 3,
    c: &[0.0, 1.0 / 2.0, 3.0 / 4.0, 1.0],
    a: &[&[], &[1.0 / 2.0], &[0.0, 3.0 / 4.0], &[2.0 / 9.0, 1.0 / 3.0, 4.0 / 9.0]],
    b: &[2.0 / 9.0, 1.0 / 3.0, 4.0 / 9.0],
    // b minus the weights of order 2; the last weight is that of y' at the new state.
    error: ErrorEstimate::Embedded(&[-5.0 / 72.0, 1.0 / 12.0, 1.0 / 9.0, -1.0 / 8.0]),
    dense: &[],
    control: || Control::new(3.0, 0.2, 5.0),
};

#[test]
fn a_method_takes_it_by_its_entry() -> Result<()> {
    let method = Method { integrator: BS23.spec(), rtol: 1e-6, atol: 1e-6, ..Method::default() };
    assert_eq!(method.triple(), "index1 + bs23 + manifold");
    // Tolerances are 1e-6.
    assert!(super::swing(&method)? < 1e-4);
    Ok(())
}
