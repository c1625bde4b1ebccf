//! The state about which implicit methods linearize, with its matrices.

use super::{Dae, Dynamics, StepError};
use crate::math::kkt::{Pattern, SaddlePoint, Singular};
use crate::system::{Dimensions, MechanicalSystem, Need, OperatingPoint, Tangent};
use serde::{Deserialize, Serialize};

/// Error of an implicit method on equations without K and C.
pub const NO_TANGENT: StepError = StepError::Unsuitable {
    reason: "implicit methods need K and C, which these equations do not give",
    hint: "implement MechanicalSystem::tangent, or use a method that needs none, such as phem56 with index2",
};

/// M, G, L, K and C at one state, with the factors of [M + S  G^T; G  0] for the equations of the shifts.
pub struct Linearized {
    pub(super) dae: Dae,
    pub(super) mass: Vec<f64>,
    pub(super) g: Vec<f64>,
    pub(super) l: Vec<f64>,
    pub(super) tangent: Tangent,
    pub(super) shifts: Option<SaddlePoint>,
    metric: Metric,
    /// s for which the metric is factored, and the rows that are dropped from it.
    weighed: Option<f64>,
    dropped: Vec<usize>,
    /// The state, from which the matrices can be evaluated again.
    pub point: Point,
}

/// A state with its accelerations and multipliers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    t: f64,
    q: Vec<f64>,
    v: Vec<f64>,
    vdot: Vec<f64>,
    lambda: Vec<f64>,
}

impl Point {
    /// True if it is one of a system of these dimensions.
    pub fn fits(&self, n: Dimensions) -> bool {
        self.q.len() == n.q && self.v.len() == n.v && self.vdot.len() == n.v && self.lambda.len() == n.lambda
    }

    /// The same by reference.
    pub fn borrowed(&self) -> OperatingPoint<'_> {
        let Point { t, q, v, vdot, lambda } = self;
        OperatingPoint { t: *t, q, v, vdot, lambda }
    }
}

impl Linearized {
    /// Memory for the Jacobian of `dae` on a system.
    pub fn new(dae: Dae, system: &dyn MechanicalSystem) -> Self {
        let structure = system.structure();
        let n = system.dimensions();
        let zeros = |pattern: &Pattern| vec![0.0; pattern.entries.len()];
        let vector = |length: usize| vec![0.0; length];
        let point = Point { t: 0.0, q: vector(n.q), v: vector(n.v), vdot: vector(n.v), lambda: vector(n.lambda) };
        let metric = Metric::new(system);
        let shifts = dae.has_shifts().then(|| SaddlePoint::new(&metric.pattern, &structure.g));
        Linearized {
            dae,
            mass: zeros(&structure.mass),
            g: zeros(&structure.g),
            l: zeros(&structure.g),
            tangent: Tangent::new(&structure.tangent),
            shifts,
            metric,
            weighed: None,
            dropped: Vec::new(),
            point,
        }
    }

    /// Evaluates the matrices at a state. One evaluation of K and C.
    ///
    /// # Errors
    /// [`NO_TANGENT`].
    pub fn update(&mut self, at: OperatingPoint, dynamics: &mut Dynamics) -> Result<(), StepError> {
        let need = if self.dae.needs_l() { Need::DYNAMICS | Need::L } else { Need::DYNAMICS };
        dynamics.evaluate(at.t, at.q, at.v, need);
        if !dynamics.system.tangent(at, &mut self.tangent, &mut dynamics.scratch) {
            return Err(NO_TANGENT);
        }
        dynamics.statistics.jacobian_evaluations += 1;
        let terms = &dynamics.terms;
        self.mass.copy_from_slice(&terms.mass);
        self.g.copy_from_slice(&terms.g);
        self.l.copy_from_slice(&terms.l);
        self.weighed = None;
        let Point { t, q, v, vdot, lambda } = &mut self.point;
        *t = at.t;
        q.copy_from_slice(at.q);
        v.copy_from_slice(at.v);
        vdot.copy_from_slice(at.vdot);
        lambda.copy_from_slice(at.lambda);
        Ok(())
    }

    /// S of the last [`weigh`](Self::weigh), n_v.
    pub fn stiffness(&self) -> &[f64] {
        &self.metric.stiffness
    }

    /// Sets the metric of the shifts to M + S for a step with s = dq/da; to M where velocities are shifted, too.
    /// One factorization, if it is another metric than before.
    ///
    /// # Errors
    /// A singular matrix.
    pub fn weigh(&mut self, s: f64, dynamics: &mut Dynamics) -> Result<(), Singular> {
        let Some(shifts) = &mut self.shifts else { return Ok(()) };
        if self.dropped != dynamics.dropped {
            shifts.drop_rows(&dynamics.dropped);
            self.dropped.clone_from(&dynamics.dropped);
        } else if self.weighed == Some(s) {
            return Ok(());
        }
        self.weighed = None;
        let stiffening = if self.dae.eta.is_none() { s } else { 0.0 };
        self.metric.take(stiffening, &self.mass, &dynamics.structure.tangent, &self.tangent.k);
        dynamics.statistics.factorizations += 1;
        shifts.factor(&self.metric.values, &self.g)?;
        self.weighed = Some(s);
        Ok(())
    }
}

/// M + S with S_i = s K_ii of the coordinates with s K_ii > M_ii, else 0. With M alone the light and stiff ones would
/// be shifted most, and oscillate from then on. M + s K would shift all as constraint forces do within the step, but K
/// contains reactions, too, of either sign.
struct Metric {
    /// The pattern of M, followed by the diagonal.
    pattern: Pattern,
    values: Vec<f64>,
    /// Coordinates with mass, without states xi.
    diagonal: Vec<usize>,
    moving: usize,
    masses: Vec<f64>,
    stiffness: Vec<f64>,
}

impl Metric {
    fn new(system: &dyn MechanicalSystem) -> Self {
        let mass = &system.structure().mass;
        let n = system.dimensions();
        let mut diagonal: Vec<usize> =
            mass.entries.iter().filter(|(i, j)| i == j && *i < n.moving()).map(|(i, _)| *i).collect();
        diagonal.sort_unstable();
        diagonal.dedup();
        let entries: Vec<_> = mass.entries.iter().copied().chain(diagonal.iter().map(|&i| (i, i))).collect();
        let [masses, stiffness] = [0; 2].map(|_| vec![0.0; n.v]);
        let values = Vec::with_capacity(entries.len());
        Metric { pattern: Pattern { entries, ..**mass }, values, diagonal, moving: n.moving(), masses, stiffness }
    }

    fn take(&mut self, s: f64, mass: &[f64], tangent: &Pattern, k: &[f64]) {
        let Metric { pattern, values, diagonal, moving, masses, stiffness } = self;
        write_diagonal(pattern, mass, masses);
        write_diagonal(tangent, k, stiffness);
        for (i, (stiffness, mass)) in stiffness.iter_mut().zip(masses).enumerate() {
            let is_stiff = i < *moving && *mass > 0.0 && s * *stiffness > *mass;
            *stiffness = if is_stiff { s * *stiffness } else { 0.0 };
        }
        values.clear();
        values.extend(mass.iter().copied().chain(diagonal.iter().map(|&i| stiffness[i])));
    }
}

/// Writes the diagonal of a matrix.
pub fn write_diagonal(pattern: &Pattern, values: &[f64], diagonal: &mut [f64]) {
    diagonal.fill(0.0);
    let entries = pattern.entries.iter().zip(values).filter(|((i, j), _)| i == j);
    entries.for_each(|(&(i, _), value)| diagonal[i] += value);
}
