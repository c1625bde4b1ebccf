//! The equations of equilibrium at one place, and their Newton matrix.

use super::failure;
use crate::error::Result;
use crate::formulation::{Dynamics, ExponentialMap};
use crate::math::kkt::{Pattern, SaddlePoint, Unsymmetric};
use crate::math::{largest, largest_in};
use crate::system::{MechanicalSystem, Need, OperatingPoint, Tangent};
use crate::tolerances;

/// Coordinates and multipliers.
#[derive(Clone, Debug)]
pub(super) struct EquilibriumPoint {
    /// Coordinates, then the states xi.
    pub q: Vec<f64>,
    pub lambda: Vec<f64>,
}

/// A place with the multipliers that balance it best, and the residual force.
pub(super) struct Balance {
    pub place: EquilibriumPoint,
    pub force: Vec<f64>,
}

/// A change of q along the directions of v, of xi in its own, and of lambda.
pub(super) struct EquilibriumChange {
    pub q: Vec<f64>,
    pub lambda: Vec<f64>,
}

/// ```text
/// [ K + shift I  G^T ] [ dq      ]   [ force ]
/// [ G            0   ] [ dlambda ] = [ -phi  ]
/// ```
///
/// without the rows of phi that depend on others; columns of states xi are those of C.
pub(super) struct EquilibriumSystem<'a> {
    pub dynamics: Dynamics<'a>,
    pub t: f64,
    pub tangent: Tangent,
    pub scales: Vec<f64>,
    /// Linear systems solved.
    pub iterations: usize,
    matrix: Unsymmetric<f64>,
    /// [I G^T; G 0], a metric in which 1 rad equals 1 m. In that of M, which rotates a short link more easily than it
    /// moves it, chains would kink.
    level: SaddlePoint,
    ones: Vec<f64>,
    /// Independent rows of phi, and their part of G with the places of its values in the whole.
    rows: Vec<usize>,
    g: Pattern,
    entries: Vec<usize>,
    values: Vec<f64>,
    /// Number of coordinates, which come first in a place.
    pub coordinates: usize,
    /// v: zero but for the states xi of the present terms.
    pub still: Vec<f64>,
    retraction: ExponentialMap,
}

impl<'a> EquilibriumSystem<'a> {
    /// Memory, and the independent rows of phi, found at a place where phi = 0.
    pub fn new(system: &'a dyn MechanicalSystem, t: f64, place: &[f64]) -> Result<Self> {
        let n = system.dimensions();
        let mut dynamics = Dynamics::new(system);
        let (q, xi) = place.split_at(n.q);
        let still = [&vec![0.0; n.moving()], xi].concat();
        let mut tangent = Tangent::new(&dynamics.structure.tangent);
        let at = OperatingPoint { t, q, v: &still, vdot: &still, lambda: &vec![0.0; n.lambda] };
        if !system.tangent(at, &mut tangent, &mut dynamics.scratch) {
            return Err(failure::no_tangent());
        }
        let (dropped, _) = dynamics.dependent_rows(t, q, &still);
        dynamics.drop_rows(&dropped);
        let rows: Vec<usize> = (0..n.lambda).filter(|row| !dropped.contains(row)).collect();
        let place = |row: usize| rows.binary_search(&row).ok();
        let all = dynamics.structure.g.entries.iter().enumerate();
        let (entries, places) = all.filter_map(|(k, &(i, j))| Some((k, (place(i)?, j)))).unzip();
        let g = Pattern { rows: rows.len(), cols: n.v, entries: places };
        let structure = &dynamics.structure;
        let matrix = Unsymmetric::new(&structure.mass, &structure.tangent, &g);
        let mut level = SaddlePoint::new(&Pattern::diagonal(n.v), &structure.g);
        level.drop_rows(&dropped);
        Ok(EquilibriumSystem {
            level,
            ones: vec![1.0; n.v],
            tangent,
            matrix: matrix.ok_or_else(failure::no_memory)?.keeping_rows(),
            scales: system.facts().scales.clone(),
            iterations: 0,
            values: vec![0.0; g.entries.len()],
            retraction: ExponentialMap::new(system),
            coordinates: n.q,
            dynamics,
            t,
            rows,
            g,
            entries,
            still,
        })
    }

    /// Evaluates the terms at a place.
    pub fn evaluate(&mut self, q: &[f64]) {
        let (q, xi) = q.split_at(self.coordinates);
        let moving = self.still.len() - xi.len();
        self.still[moving..].copy_from_slice(xi);
        self.dynamics.evaluate(self.t, q, &self.still, Need::DYNAMICS);
    }

    /// f - G^T lambda from the present terms.
    pub fn force(&self, lambda: &[f64]) -> Vec<f64> {
        let terms = &self.dynamics.terms;
        let g = &self.dynamics.structure.g;
        let mut reaction = vec![0.0; terms.f.len()];
        g.multiply_transposed(&terms.g, lambda, &mut reaction);
        terms.f.iter().zip(reaction).map(|(f, reaction)| f - reaction).collect()
    }

    /// max |phi| from the present terms, in units of the scene's scale.
    pub fn gap(&self) -> f64 {
        largest_in(&self.scales, &self.dynamics.terms.phi)
    }

    /// Evaluates the terms at a place and finds the multipliers of least residual force.
    pub fn balance(&mut self, q: &[f64]) -> Option<Balance> {
        self.evaluate(q);
        let terms = &self.dynamics.terms;
        self.level.factor(&self.ones, &terms.g).ok()?;
        let mut top = terms.f.clone();
        let mut lambda = vec![0.0; self.scales.len()];
        self.level.solve(&mut top, &mut lambda).ok()?;
        let force = self.force(&lambda);
        force
            .iter()
            .all(|x| x.is_finite())
            .then_some(Balance { place: EquilibriumPoint { q: q.to_vec(), lambda }, force })
    }

    /// The least change of q that closes the joints, to first order, from the present terms.
    pub fn closing(&mut self) -> Option<EquilibriumChange> {
        let terms = &self.dynamics.terms;
        self.level.factor(&self.ones, &terms.g).ok()?;
        let phi: Vec<f64> = terms.phi.iter().map(|phi| -phi).collect();
        let mut q = vec![0.0; self.still.len()];
        self.level.solve_projection(&phi, &mut q).ok()?;
        Some(EquilibriumChange { q, lambda: Vec::new() })
    }

    /// Keeps all rows from now on, so that multipliers are those of least norm.
    pub fn release(&mut self) {
        self.dynamics.drop_rows(&[]);
        self.level.drop_rows(&[]);
    }

    /// Factors the matrix at a place whose terms are evaluated; false where it is singular.
    pub fn factor(&mut self, place: &EquilibriumPoint, shift: f64) -> bool {
        let q = &place.q[..self.coordinates];
        let vdot = &vec![0.0; self.still.len()];
        let at = OperatingPoint { t: self.t, q, v: &self.still, vdot, lambda: &place.lambda };
        let Dynamics { system, structure, terms, scratch, .. } = &mut self.dynamics;
        system.tangent(at, &mut self.tangent, scratch);
        let moving = system.dimensions().moving();
        let Tangent { k, c } = &mut self.tangent;
        let entries = structure.tangent.entries.iter().zip(k.iter_mut().zip(c));
        entries.filter(|((_, j), _)| *j >= moving).for_each(|(_, (k, c))| *k = *c);
        self.matrix.clear();
        self.matrix.add(&structure.tangent, &self.tangent.k, 1.0, false);
        (0..self.still.len()).for_each(|i| self.matrix.add_entry(i, i, shift));
        self.values.iter_mut().zip(&self.entries).for_each(|(value, &entry)| *value = terms.g[entry]);
        self.matrix.factor(&self.g, &self.values).is_ok()
    }

    /// Solves with `force` and the phi of the present terms.
    pub fn solve(&mut self, force: &[f64]) -> Option<EquilibriumChange> {
        self.iterations += 1;
        let mut q = force.to_vec();
        let mut rows: Vec<f64> = self.rows.iter().map(|&row| -self.dynamics.terms.phi[row]).collect();
        self.matrix.solve(&mut q, &mut rows).ok()?;
        let mut lambda = vec![0.0; self.scales.len()];
        self.rows.iter().zip(rows).for_each(|(&row, value)| lambda[row] = value);
        Some(EquilibriumChange { q, lambda })
    }

    /// The place after `part` of a change.
    pub fn moved(&mut self, from: &EquilibriumPoint, change: &EquilibriumChange, part: f64) -> EquilibriumPoint {
        let dq: Vec<f64> = change.q.iter().map(|dq| part * dq).collect();
        let mut q = from.q.clone();
        let ((own, xi), moving) = (q.split_at_mut(self.coordinates), self.dynamics.system.dimensions().moving());
        self.retraction.apply(self.dynamics.system, &from.q[..own.len()], &dq, own);
        xi.iter_mut().zip(&dq[moving..]).for_each(|(xi, d)| *xi += d);
        let lambda = from.lambda.iter().zip(&change.lambda).map(|(lambda, d)| lambda + part * d).collect();
        EquilibriumPoint { q, lambda }
    }

    /// |dq| in the metric of the present M: one unit for all coordinates.
    pub fn size(&self, dq: &[f64]) -> f64 {
        let mut product = vec![0.0; dq.len()];
        self.dynamics.structure.mass.multiply_symmetric(&self.dynamics.terms.mass, dq, &mut product);
        dq.iter().zip(product).map(|(dq, p)| dq * p).sum::<f64>().max(0.0).sqrt()
    }

    /// Sum of the magnitudes of the forces and reactions on each velocity, from the present terms.
    pub fn sizes(&self, place: &EquilibriumPoint) -> Vec<f64> {
        let terms = &self.dynamics.terms;
        let structure = &self.dynamics.structure;
        let mut sizes: Vec<f64> = terms.f.iter().map(|f| f.abs()).collect();
        for (&(i, j), g) in structure.g.entries.iter().zip(&terms.g) {
            sizes[j] += (g * place.lambda[i]).abs();
        }
        sizes
    }

    /// Sum of |K_ij| over j for each i, by K of the last factorization.
    pub fn stiffness(&self) -> Vec<f64> {
        let mut sums = vec![0.0; self.still.len()];
        for (&(i, _), k) in self.dynamics.structure.tangent.entries.iter().zip(&self.tangent.k) {
            sums[i] += k.abs();
        }
        sums
    }

    /// True if a force is within round-off: of the forces and reactions that it is the sum of, and of coordinates
    /// rounded by an ulp where K is that of the last factorization.
    pub fn is_round_off(&self, place: &EquilibriumPoint, force: &[f64]) -> bool {
        let reach = 1.0f64.max(largest(&place.q));
        let sizes = self.sizes(place).into_iter().zip(self.stiffness());
        let size: Vec<f64> = sizes.map(|(force, stiffness)| force + stiffness * reach).collect();
        let least = tolerances::ROOT_OF_ROUND_OFF * largest(&size);
        force.iter().zip(&size).all(|(force, size)| force.abs() <= tolerances::ROUND_OFF_OF_SUMS * size.max(least))
            && self.gap() <= tolerances::ROOT_OF_ROUND_OFF
    }
}
