//! Minimal coordinates: the equations on the tangent space of the constraints.

use super::dense::Dense;
use super::{Dynamics, Formulation, FormulationEntry, SPARSE, StepError};
use crate::error::Error;
use crate::math::Piece;
use crate::math::kkt::{CorrectionChart, Reduced};
use crate::math::memory::refuse_dense;
use crate::math::newton::{Limits, Monitor, relative};
use crate::system::{MechanicalSystem, Need};
use crate::tolerances;
use crate::tolerances::RANK;

/// With G_b Z = 0 at the start (q_b, v_b) of a step, and Y normal to Z in the metric of diag(M_b),
///
/// ```text
/// q = q_b + Z u + Y c,  phi(q, t) = 0,   v = v_b + Z u' + Y d,  G v + phi_t = 0                  n - m coordinates u
/// v' = Y0 y + Z0 z,  G Z0 = 0,  G Y0 y = gamma,  Z0^T M Z0 z = Z0^T (f - M Y0 y),  Y0^T G^T lambda = Y0^T (f - M v')
/// ```
///
/// The first line is a chart of the manifold: c by Newton's method, d from one linear system. The second, from a
/// pivoted QR of G^T at the state itself, gives u'' = the part of v' along Z. So 2 (n - m) states are integrated, and
/// the constraints are satisfied to round-off on both levels at every stage and step without a projection. Source:
/// Potra, Rheinboldt, Mech. Struct. Mach. 19 (1991) 1-18; Kim, Vanderploeg, J. Mech. Transm. Autom. Des. 108 (1986)
/// 183-188.
///
/// An integrator sees (q, v) and (q', v') in all n directions. Since c and d follow from u, u' and t, the chart ignores
/// the parts along Y that the integrator computes; these, of the method's order too, are the guess of Newton's method.
/// Every accepted step has a base of its own, whose QR is a small part of the work of the stages, so that a chart is
/// never used far from its base; slopes at the end of a step are those at the start of the next. A step within which
/// Newton's method does not converge is too long for its chart, and rejected. With quaternions, q' = N v, the chart is
/// not affine: q = (q_b + N Z u)/|.|, then corrections N Y c; all else is the same.
///
/// G may be rank deficient: lambda is then the one of least norm. Order in q, v, lambda: that of the integrator. Dense,
/// about 3 n m^2 + 4 n^2 (n - m) + 3 m^3 operations per stage, and about three evaluations of phi and G: for small
/// systems.
pub const ENTRY: FormulationEntry = FormulationEntry {
    name: "null_space",
    about: "minimal coordinates in the tangent space, with a new base each step: no drift; dense",
    options: &[],
    dae: None,
    field: Some(|_, system| {
        let n = system.dimensions();
        refuse_dense("null_space", n.v, n.v.max(n.lambda), COPIES).map_err(|error| error.hint(SPARSE))?;
        let tangent_space = TangentSpace::new(system);
        Ok(Box::new(tangent_space.ok_or_else(|| Error::input("null_space: M and G do not fit each other"))?))
    }),
};

/// Number of matrices: G^T, Z^T M Z and three of the chart, for the steps and again for output rows.
const COPIES: f64 = 10.0;

struct TangentSpace {
    field: Dense,
    chart: CorrectionChart,
    /// True while states belong to a step, and so to the chart; other states are used as they are.
    is_within: bool,
    /// t, q and the pieces of functions at the base.
    base: (f64, Vec<f64>, Vec<Piece>),
    /// The state on the manifold, q and v.
    q: Vec<f64>,
    v: Vec<f64>,
    /// A correction along v, the same as a change of q, and G v + phi_t.
    step: Vec<f64>,
    rate: Vec<f64>,
    rows: Vec<f64>,
}

/// Limits on changes relative to the largest component: they halve at least until round-off, or else the state is not
/// in the chart, or on another branch of the constraints.
const LIMITS: Limits = Limits {
    round_off: f64::EPSILON,
    stagnation: tolerances::ROOT_OF_ROUND_OFF,
    contraction: tolerances::NEWTON_HALVES,
    ..Limits::NONE
};

impl TangentSpace {
    fn new(system: &dyn MechanicalSystem) -> Option<Self> {
        let n = system.dimensions();
        let structure = system.structure();
        let zeros = |n: usize| vec![0.0; n];
        Some(TangentSpace {
            field: Dense(Reduced::new(&structure.mass, &structure.g, RANK)?),
            chart: CorrectionChart::new(&structure.mass, &structure.g),
            is_within: false,
            base: (f64::NAN, zeros(n.q), Vec::new()),
            q: zeros(n.q),
            v: zeros(n.v),
            step: zeros(n.v),
            rate: zeros(n.q),
            rows: zeros(n.lambda),
        })
    }

    /// The state on the manifold with the u and u' of (q, v).
    fn lift(&mut self, t: f64, q: &[f64], v: &[f64], dynamics: &mut Dynamics) -> Result<(), StepError> {
        self.q.copy_from_slice(q);
        self.v.copy_from_slice(v);
        dynamics.system.normalize(&mut self.q);
        self.lift_position(t, dynamics)?;
        self.lift_velocity(dynamics)
    }

    /// Newton's method with the matrix of the guess, which is renewed where that converges too slowly.
    fn lift_position(&mut self, t: f64, dynamics: &mut Dynamics) -> Result<(), StepError> {
        let mut is_factored = false;
        converge(|renews| {
            dynamics.evaluate(t, &self.q, &self.v, Need::CONSTRAINTS | Need::G);
            if !std::mem::replace(&mut is_factored, true) || renews {
                self.chart.factor(&dynamics.terms.g, dynamics.dense_reference);
            }
            self.chart.solve(&dynamics.terms.phi, &mut self.step);
            dynamics.system.rate(&self.q, &self.step, &mut self.rate);
            self.q.iter_mut().zip(&self.rate).for_each(|(q, rate)| *q -= rate);
            dynamics.system.normalize(&mut self.q);
            change(&self.step, &self.q)
        })
    }

    /// Solves for d with the matrix of a nearby position, by a few iterations.
    fn lift_velocity(&mut self, dynamics: &Dynamics) -> Result<(), StepError> {
        converge(|_| {
            self.rows.copy_from_slice(&dynamics.terms.phi_t);
            dynamics.structure.g.multiply(&dynamics.terms.g, &self.v, &mut self.rows);
            self.chart.solve(&self.rows, &mut self.step);
            self.v.iter_mut().zip(&self.step).for_each(|(v, step)| *v -= step);
            change(&self.step, &self.v[..dynamics.system.dimensions().moving()])
        })
    }
}

fn converge(correct: impl FnMut(bool) -> Result<f64, StepError>) -> Result<(), StepError> {
    if Monitor::default().solve(LIMITS, correct)? { Ok(()) } else { Err(StepError::NotConverged) }
}

fn change(step: &[f64], x: &[f64]) -> Result<f64, StepError> {
    if step.iter().all(|step| step.is_finite()) { Ok(relative(step, x)) } else { Err(StepError::NotFinite) }
}

impl Formulation for TangentSpace {
    fn is_dense(&self) -> bool {
        true
    }

    fn derivative(
        &mut self,
        t: f64,
        q: &[f64],
        v: &[f64],
        dynamics: &mut Dynamics,
        qdot: &mut [f64],
        vdot: &mut [f64],
    ) -> Result<(), StepError> {
        if !self.is_within {
            return self.field.derivative(t, q, v, dynamics, qdot, vdot);
        }
        self.lift(t, q, v, dynamics)?;
        self.field.derivative(t, &self.q, &self.v, dynamics, qdot, vdot)
    }

    fn begin_step(&mut self, t: f64, q: &[f64], v: &[f64], dynamics: &mut Dynamics) -> Result<(), StepError> {
        self.is_within = true;
        if self.base.0 != t || self.base.1 != q || self.base.2 != dynamics.scratch.pieces {
            dynamics.evaluate(t, q, v, Need::MASS | Need::G);
            self.chart.rebase(&dynamics.terms.mass, &dynamics.terms.g);
            self.base.0 = t;
            self.base.1.copy_from_slice(q);
            self.base.2.clone_from(&dynamics.scratch.pieces);
        }
        Ok(())
    }

    fn keeps_constraints(&self) -> bool {
        true
    }

    fn end_step(&mut self, t: f64, q: &mut [f64], v: &mut [f64], dynamics: &mut Dynamics) -> Result<(), StepError> {
        self.is_within = false;
        self.lift(t, q, v, dynamics)?;
        q.copy_from_slice(&self.q);
        v.copy_from_slice(&self.v);
        Ok(())
    }
}
