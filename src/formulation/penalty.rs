//! Penalty on the constraints, with or without updates of the multipliers.

use super::linearized::write_diagonal;
use super::{Dynamics, Formulation, FormulationEntry, StepError};
use crate::error::Result;
use crate::math::kkt::{Pattern, SaddlePoint};
use crate::method_spec::{MethodSpec, OptionDoc};
use crate::system::{MechanicalSystem, Need, Structure, Terms};
use std::sync::Arc;

/// ```text
/// (M + G^T a G) v' = f + G^T a c,   c = gamma - 2 xi omega phi' - omega^2 phi,   lambda = a (G v' - c)
/// ```
///
/// with a = penalty / mean over the rows of (G diag(M)^-1 G^T)_jj, fixed at the state where a run starts, so that the
/// field is smooth. (The whole M^-1 would cost one solution per row.) Source: Bayo, Garcia de Jalon, Serna, Comput.
/// Methods Appl. Mech. Eng. 71 (1988) 183-195. Error of v' and lambda against `baumgarte:alpha=xi omega,beta=omega`:
/// O(1/penalty), whatever the step. Order in q, v, lambda: that of the integrator, to the motion of the penalty
/// equations.
///
/// G may be rank deficient, by redundant rows or at a singular position: the matrix stays regular. There, the
/// contradiction of redundant rows is multiplied by a in lambda (1e-9 of the reactions with the default). Cost: solved
/// as a saddle-point system with a slack for each row, which contains no ill-conditioned M + G^T a G; about that of
/// index 1. The rank of G is not reported. An adaptive integrator with a projection takes very small steps where the
/// tolerance is below the error of the penalty, since each step leaves the manifold by that: raise the penalty.
pub const ENTRY: FormulationEntry = FormulationEntry {
    name: "penalty",
    about: "(M + G^T a G) v' = f + G^T a c: error O(1/penalty), redundant rows and singular positions allowed",
    options: &[PENALTY, OMEGA, XI],
    dae: None,
    field: Some(|spec, system| Ok(Box::new(Penalty::new(1, spec, system)?))),
};

/// Option `penalty` of penalty and augmented-Lagrangian formulations.
pub const PENALTY: OptionDoc =
    OptionDoc { name: "penalty", about: "mass on the constraints over that of the mechanism (default 1e7)" };
/// Default of [`PENALTY`].
const DEFAULT_PENALTY: f64 = 1e7;
/// Option `omega` of penalty and augmented-Lagrangian formulations.
pub const OMEGA: OptionDoc =
    OptionDoc { name: "omega", about: "frequency at which phi is pulled back, 1/s (default 10)" };
/// Option `xi` of penalty and augmented-Lagrangian formulations.
pub const XI: OptionDoc = OptionDoc { name: "xi", about: "damping ratio of phi (default 1)" };

/// The formulation with a tenth of its penalty, whose error O(1/penalty) is ten times as large; any other as it is.
pub(crate) fn softer(formulation: &MethodSpec) -> MethodSpec {
    match formulation.positive(PENALTY.name, DEFAULT_PENALTY) {
        Ok(penalty) if formulation.name == ENTRY.name => {
            formulation.clone().with(PENALTY.name, &format!("{:e}", 0.1 * penalty))
        }
        _ => formulation.clone(),
    }
}

/// Saddle-point form with a slack s = (lambda_i - lambda)/a, solved `iterations` times from lambda_0 = 0:
///
/// ```text
/// [ M  0  G^T ] [ v'     ]   [ f        ]
/// [ 0  a  I   ] [ s      ] = [ lambda_i ]
/// [ G  I  0   ] [ lambda ]   [ c        ]
/// ```
pub(super) struct Penalty {
    iterations: usize,
    penalty: f64,
    omega: f64,
    xi: f64,
    /// a of the run; before it is fixed, that of each state.
    weight: Option<f64>,
    kkt: SaddlePoint,
    mass: Vec<f64>,
    g: Vec<f64>,
    top: Vec<f64>,
    c: Vec<f64>,
}

impl Penalty {
    pub fn new(iterations: usize, spec: &MethodSpec, system: &dyn MechanicalSystem) -> Result<Self> {
        let n = system.dimensions();
        let structure = system.structure();
        let mut mass = Arc::unwrap_or_clone(structure.mass);
        let mut g = Arc::unwrap_or_clone(structure.g);
        mass.entries.extend((n.v..n.v + n.lambda).map(|i| (i, i)));
        g.entries.extend((0..n.lambda).map(|row| (row, n.v + row)));
        (mass.rows, mass.cols, g.cols) = (n.v + n.lambda, n.v + n.lambda, n.v + n.lambda);
        Ok(Penalty {
            iterations,
            penalty: spec.positive(PENALTY.name, DEFAULT_PENALTY)?,
            omega: spec.not_negative("omega", 10.0)?,
            xi: spec.not_negative("xi", 1.0)?,
            weight: None,
            kkt: SaddlePoint::new(&mass, &g),
            mass: vec![0.0; mass.entries.len()],
            g: vec![1.0; g.entries.len()],
            top: vec![0.0; n.v + n.lambda],
            c: vec![0.0; n.lambda],
        })
    }

    fn factor(&mut self, dynamics: &mut Dynamics) -> Result<(), StepError> {
        let Dynamics { terms, structure, .. } = &*dynamics;
        let weight = self.weight.unwrap_or_else(|| self.penalty / mean_compliance(structure, terms));
        let (mass, slack) = self.mass.split_at_mut(terms.mass.len());
        mass.copy_from_slice(&terms.mass);
        slack.fill(weight);
        self.g[..terms.g.len()].copy_from_slice(&terms.g);
        dynamics.statistics.factorizations += 1;
        self.kkt.factor(&self.mass, &self.g).map_err(|singular| dynamics.halt(singular))
    }
}

impl Formulation for Penalty {
    fn settle(&mut self, t: f64, q: &[f64], v: &[f64], dynamics: &mut Dynamics) {
        dynamics.evaluate(t, q, v, Need::MASS | Need::G);
        self.weight = Some(self.penalty / mean_compliance(&dynamics.structure, &dynamics.terms));
    }

    fn settled(&self) -> Vec<f64> {
        Vec::from_iter(self.weight)
    }

    fn recall(&mut self, settled: &[f64]) {
        self.weight = settled.first().copied();
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
        let omega = self.omega;
        let xi = self.xi;
        dynamics.right_sides(t, q, v, |phi, phi_dot| -2.0 * xi * omega * phi_dot - omega * omega * phi);
        self.factor(dynamics)?;
        self.c.copy_from_slice(&dynamics.lambda);
        dynamics.lambda.fill(0.0);
        for _ in 0..self.iterations {
            let (top, slack) = self.top.split_at_mut(v.len());
            top.copy_from_slice(&dynamics.terms.f);
            slack.copy_from_slice(&dynamics.lambda);
            dynamics.lambda.copy_from_slice(&self.c);
            self.kkt.solve(&mut self.top, &mut dynamics.lambda).map_err(|singular| dynamics.halt(singular))?;
        }
        dynamics.vdot.copy_from_slice(&self.top[..v.len()]);
        dynamics.finite()?;
        dynamics.system.rate(q, v, qdot);
        vdot.copy_from_slice(&dynamics.vdot);
        Ok(())
    }
}

/// The mean diagonal entry of G diag(M)^-1 G^T, over coordinates with mass; 1 where G is zero.
pub fn mean_compliance(structure: &Structure, terms: &Terms) -> f64 {
    let Pattern { rows, cols, entries } = &*structure.g;
    let mut diagonal = vec![0.0; *cols];
    write_diagonal(&structure.mass, &terms.mass, &mut diagonal);
    let massive = entries.iter().zip(&terms.g).filter(|((_, i), _)| diagonal[*i] > 0.0);
    let trace: f64 = massive.map(|((_, i), g)| g * g / diagonal[*i]).sum();
    if trace > 0.0 { trace / *rows as f64 } else { 1.0 }
}
