//! What implicit methods linearize about.

use super::{Dae, Dynamics, Halt};
use crate::math::kkt::{Pattern, SaddlePoint};
use crate::system::{Loaded, MechanicalSystem, Need, Tangent};

/// Why an implicit method has no matrix.
pub const NO_TANGENT: Halt = Halt::Unsuitable {
    reason: "implicit methods need K and C, which these equations do not give",
    hint: "implement MechanicalSystem::tangent, or use a method that needs none, such as phem56 with index2",
};

/// M, G, L, K and C at one state, with the factors of [M G^T; G 0] where shifts are solved for.
pub struct Linearized {
    pub(super) dae: Dae,
    pub(super) mass: Vec<f64>,
    pub(super) g: Vec<f64>,
    pub(super) l: Vec<f64>,
    pub(super) tangent: Tangent,
    pub(super) shifts: Option<SaddlePoint>,
    dropped: Vec<usize>,
    /// t, q, v, v' and lambda of the state; empty before there is one.
    point: Vec<f64>,
}

impl Linearized {
    pub fn new(dae: Dae, system: &dyn MechanicalSystem) -> Self {
        let structure = system.structure();
        let zeros = |pattern: &Pattern| vec![0.0; pattern.entries.len()];
        Linearized {
            dae,
            mass: zeros(&structure.mass),
            g: zeros(&structure.g),
            l: zeros(&structure.g),
            tangent: Tangent::new(&structure.tangent),
            shifts: dae.has_shifts().then(|| SaddlePoint::new(&structure.mass, &structure.g)),
            dropped: Vec::new(),
            point: Vec::with_capacity(
                1 + system.dimensions().q + 2 * system.dimensions().v + system.dimensions().lambda,
            ),
        }
    }

    /// t, q, v, v' and lambda of the state, from which [`recall`](Self::recall) takes them again.
    pub fn point(&self) -> &[f64] {
        &self.point
    }

    /// Takes them at the state of a [`point`](Self::point), which was counted before.
    ///
    /// # Errors
    /// As [`update`](Self::update).
    pub fn recall(&mut self, point: &[f64], dynamics: &mut Dynamics) -> Result<(), Halt> {
        let (n, counted) = (dynamics.system.dimensions(), dynamics.statistics);
        let Some((&t, rest)) = point.split_first().filter(|(_, rest)| rest.len() == n.q + 2 * n.v + n.lambda) else {
            return Ok(());
        };
        let (q, rest) = rest.split_at(n.q);
        let (v, rest) = rest.split_at(n.v);
        let (vdot, lambda) = rest.split_at(n.v);
        self.update(Loaded { t, q, v, vdot, lambda }, dynamics)?;
        dynamics.statistics = counted;
        Ok(())
    }

    /// Takes them at a state. One evaluation of K and C.
    ///
    /// # Errors
    /// [`NO_TANGENT`]; a singular state, where shifts are solved for.
    pub fn update(&mut self, at: Loaded, dynamics: &mut Dynamics) -> Result<(), Halt> {
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
        self.point.clear();
        self.point.push(at.t);
        [at.q, at.v, at.vdot, at.lambda].into_iter().for_each(|values| self.point.extend_from_slice(values));
        if let Some(shifts) = &mut self.shifts {
            if self.dropped != dynamics.dropped {
                shifts.drop_rows(&dynamics.dropped);
                self.dropped.clone_from(&dynamics.dropped);
            }
            dynamics.statistics.factorizations += 1;
            shifts.factor(&self.mass, &self.g)?;
        }
        Ok(())
    }
}
