//! Coordinate projection, iterated to round-off.

use super::{Entry, Projection, move_back};
use crate::error::Result;
use crate::formulation::{Dynamics, Halt, OptionDoc};
use crate::math::largest;
use crate::system::Need;

/// ```text
/// min |q - q~|_M  s.t.  phi = 0,   then   min |v - v~|_M  s.t.  G v + phi_t = 0
/// ```
///
/// Source: Eich, SIAM J. Numer. Anal. 30 (1993) 1467-1482. Newton's method with the mass matrix as metric, until the
/// residual no longer falls; order of the integrator kept; a residual that stops
/// falling before is refused. One evaluation and factorization an iteration, and one more,
/// which the velocities share with the test of the residual.
pub const ENTRY: Entry = Entry {
    name: "exact",
    about: "positions by Newton's method to round-off, then velocities",
    options: &[OptionDoc { name: "iterations", about: "most Newton iterations (default 10)" }],
    make: |choice, system| {
        let n = system.dimensions();
        Ok(Some(Box::new(Exact {
            scales: system.scales(),
            most: choice.whole("iterations", MOST, 1..=1000)?,
            rate: vec![0.0; n.q],
            step: vec![0.0; n.v],
        })))
    },
};

/// Who allows fewer iterations than by default takes what they leave.
const MOST: usize = 10;
/// A residual of this part of the scene's size is no round-off, nor what redundant rows may contradict each other by.
const OPEN: f64 = 1e-9;

struct Exact {
    most: usize,
    scales: Vec<f64>,
    rate: Vec<f64>,
    step: Vec<f64>,
}

impl Exact {
    fn is_open(&self, phi: &[f64]) -> bool {
        phi.iter().zip(&self.scales).any(|(phi, scale)| phi.abs() > OPEN * scale)
    }
}

impl Projection for Exact {
    fn project(&mut self, t: f64, q: &mut [f64], v: &mut [f64], dynamics: &mut Dynamics) -> Result<(), Halt> {
        let need = Need::MASS | Need::CONSTRAINTS | Need::G;
        let (mut last, mut iterations) = (f64::INFINITY, 0);
        loop {
            dynamics.statistics.projections += 1;
            dynamics.evaluate(t, q, v, need);
            dynamics.factor_truncated()?;
            let residual = largest(&dynamics.terms.phi);
            // Near round-off the residual stops falling; another step would only stir it.
            if iterations == self.most || residual == 0.0 || residual > 0.5 * last {
                let is_limited = iterations == self.most && self.most < MOST;
                if !is_limited && self.is_open(&dynamics.terms.phi) {
                    return Err(Halt::Open);
                }
                break;
            }
            (last, iterations) = (residual, iterations + 1);
            dynamics.kkt.solve_projection(&dynamics.terms.phi, &mut self.step)?;
            move_back(q, &self.step, &mut self.rate, dynamics.system);
        }
        dynamics.kkt.solve_projection(&dynamics.terms.phi_dot, &mut self.step)?;
        v.iter_mut().zip(&self.step).for_each(|(v, dv)| *v -= dv);
        Ok(())
    }
}
