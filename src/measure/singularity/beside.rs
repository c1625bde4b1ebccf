//! Whether a state is singular, or its constraints redundant everywhere: by the rank of G beside it.

use crate::formulation::Dynamics;
use crate::math::largest;
use crate::system::{MechanicalSystem, Need};
use crate::tolerances::report as tolerances;

/// The rows of G that depend on others at a state near the given one, in a direction that the constraints allow and that
/// has nothing special.
pub fn dependent_beside(system: &dyn MechanicalSystem, t: f64, q: &[f64]) -> Vec<usize> {
    let mut dynamics = Dynamics::new(system);
    let n = system.dimensions();
    let (rest, mut step, mut rate) = (vec![0.0; n.v], vec![0.0; n.v], vec![0.0; n.q]);
    let mut aside = q.to_vec();
    step.iter_mut().enumerate().for_each(|(i, x)| *x = (1.0 + 0.7 * i as f64 * (i as f64 + 3.0)).sin());
    dynamics.evaluate(t, q, &rest, Need::MASS | Need::CONSTRAINTS | Need::G);
    // [M G^T; G 0] [d; .] = [r; 0]: an arbitrary force moves the mechanism as it can.
    if dynamics.factor().is_err() || dynamics.kkt.solve(&mut step, &mut vec![0.0; n.lambda]).is_err() {
        return Vec::new();
    }
    let size = largest(&step).max(f64::MIN_POSITIVE);
    step.iter_mut().for_each(|x| *x *= tolerances::STATE_BESIDE / size);
    for sweep in 0..=tolerances::STATE_BESIDE_SWEEPS {
        system.rate(&aside, &step, &mut rate);
        let sign = if sweep == 0 { 1.0 } else { -1.0 };
        aside.iter_mut().zip(&rate).for_each(|(q, rate)| *q += sign * rate);
        system.normalize(&mut aside);
        dynamics.evaluate(t, &aside, &rest, Need::MASS | Need::CONSTRAINTS | Need::G);
        if dynamics.factor().is_err() || dynamics.kkt.solve_projection(&dynamics.terms.phi, &mut step).is_err() {
            return Vec::new();
        }
    }
    dynamics.dependent_rows(t, &aside, &rest).0
}
