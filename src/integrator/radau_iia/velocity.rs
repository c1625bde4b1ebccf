//! The velocity of a state that was found from phi = 0 alone.

use crate::formulation::StepError;
use crate::integrator::Problem;
use crate::integrator::sums::add;
use crate::system::Need;

/// Projects v on G v + phi_t = 0, nearest in the mass metric, and factors the matrix of the state:
///
/// ```text
/// [M  G^T] [dv]   [ 0    ]
/// [G  0  ] [. ] = [-phi' ]
/// ```
///
/// A step of index 3 finds v from phi = 0 by a division by h: that part of v has order s only, and would be the start
/// of the next step. Source: Hairer, Wanner, Solving Ordinary Differential Equations II, VII.2, projection of the
/// velocities.
pub fn project(problem: &mut Problem, t: f64, y: &mut [f64]) -> Result<(), StepError> {
    let (q, v) = problem.split_mut(y);
    let dynamics = &mut problem.dynamics;
    dynamics.system.normalize(q);
    dynamics.evaluate(t, q, v, Need::DYNAMICS);
    dynamics.factor_truncated()?;
    dynamics.vdot.fill(0.0);
    dynamics.lambda.iter_mut().zip(&dynamics.terms.phi_dot).for_each(|(row, phi_dot)| *row = -phi_dot);
    dynamics.kkt.solve(&mut dynamics.vdot, &mut dynamics.lambda)?;
    add(v, &dynamics.vdot);
    Ok(())
}
