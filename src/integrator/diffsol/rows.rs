//! The rows of a formulation with their exact Jacobian.

use super::directions::Directions;
use crate::formulation::{Dae, DaeRow, Dynamics, NO_TANGENT, Residual, StepError, Unknowns};
use crate::integrator::sums::add;
use crate::math::all_finite;
use crate::math::kkt::{Pattern, Singular};
use crate::system::{Dimensions, Need, OperatingPoint, Structure, Tangent};
use std::ops::Range;

/// ```text
/// q' = N (v + u),   v' = a + w
/// 0 = f - M a - G^T lambda,   0 = M w + G^T eta,   0 = M u + G^T mu
/// 0 = the rows of lambda, eta and mu
/// ```
///
/// the equations of [`Dae`] in x = (q, v, a, lambda, w, eta, u, mu), without the shifts that they do not have. Rows that
/// are dropped, and rows of mu for nonholonomic constraints, set their multiplier to zero.
pub struct EquationRows {
    dae: Dae,
    n: Dimensions,
    places: UnknownRanges,
    dropped: Vec<usize>,
    residual: Residual,
    directions: Directions,
    /// v + u
    velocity: Vec<f64>,
    tangent: Tangent,
    /// d(phi'')/dq along the directions of v.
    gradient: Vec<f64>,
    /// Entries of G by constraint.
    by_constraint: Vec<Vec<usize>>,
}

/// Ranges of the parts of x; those of shifts that the equations do not have are empty.
struct UnknownRanges {
    q: Range<usize>,
    v: Range<usize>,
    a: Range<usize>,
    lambda: Range<usize>,
    w: Range<usize>,
    eta: Range<usize>,
    u: Range<usize>,
    mu: Range<usize>,
}

impl UnknownRanges {
    fn new(dae: Dae, n: Dimensions) -> Self {
        let mut end = 0;
        let mut next = |len: usize| {
            end += len;
            end - len..end
        };
        let of = |is_there: bool, len: usize| if is_there { len } else { 0 };
        let has_w = dae.eta.is_some();
        let has_u = dae.mu.is_some();
        UnknownRanges {
            q: next(n.q),
            v: next(n.v),
            a: next(n.v),
            lambda: next(n.lambda),
            w: next(of(has_w, n.v)),
            eta: next(of(has_w, n.lambda)),
            u: next(of(has_u, n.v)),
            mu: next(of(has_u, n.lambda)),
        }
    }
}

/// The row of one kind of multipliers; none where the equations do not have it.
type RowOf = fn(Dae) -> Option<DaeRow>;

/// Values of the matrices of the Jacobian at one state.
struct Matrices<'m> {
    mass: &'m [f64],
    g: &'m [f64],
    l: &'m [f64],
    gradient: &'m [f64],
    tangent: &'m Tangent,
    q: &'m [f64],
    velocity: &'m [f64],
}

impl EquationRows {
    /// Memory for `dae` on the system of `dynamics`, with the rows that are dropped there.
    pub fn new(dae: Dae, dynamics: &Dynamics) -> Self {
        let system = dynamics.system;
        let structure = &dynamics.structure;
        let n = system.dimensions();
        let mut by_constraint = vec![Vec::new(); n.lambda];
        structure.g.entries.iter().enumerate().for_each(|(entry, (row, _))| by_constraint[*row].push(entry));
        EquationRows {
            dae,
            n,
            places: UnknownRanges::new(dae, n),
            dropped: dynamics.dropped.clone(),
            residual: Residual::new(n),
            directions: Directions::new(system),
            velocity: vec![0.0; n.v],
            tangent: Tangent::new(&structure.tangent),
            gradient: vec![0.0; structure.g.entries.len()],
            by_constraint,
        }
    }

    /// Number of variables.
    pub fn len(&self) -> usize {
        self.places.mu.end
    }

    /// Number of differential variables, q and v.
    pub fn differential(&self) -> usize {
        self.places.v.end
    }

    /// x at the start of a step, given (q, v, works) with the rate, and lambda.
    pub fn start(&self, y: &[f64], slope: &[f64], lambda: &[f64]) -> Vec<f64> {
        let mut x = vec![0.0; self.len()];
        let motion = self.differential();
        x[..motion].copy_from_slice(&y[..motion]);
        x[self.places.a.clone()].copy_from_slice(&slope[self.places.v.clone()]);
        x[self.places.lambda.clone()].copy_from_slice(lambda);
        self.dropped.iter().for_each(|row| x[self.places.lambda.start + row] = 0.0);
        x
    }

    /// Writes F(t, x). One evaluation.
    ///
    /// # Errors
    /// A state or a term that is not finite.
    pub fn evaluate(&mut self, dynamics: &mut Dynamics, t: f64, x: &[f64], out: &mut [f64]) -> Result<(), StepError> {
        let EquationRows { dae, places, residual, velocity, .. } = self;
        let part = |range: &Range<usize>| &x[range.clone()];
        let unknowns = Unknowns {
            a: part(&places.a),
            lambda: part(&places.lambda),
            w: part(&places.w),
            eta: part(&places.eta),
            u: part(&places.u),
            mu: part(&places.mu),
            stiffness: &[],
        };
        let q = part(&places.q);
        let v = part(&places.v);
        residual.evaluate(dae, t, q, v, unknowns, dynamics)?;
        velocity.copy_from_slice(v);
        add(velocity, unknowns.u);
        dynamics.system.rate(q, velocity, &mut out[places.q.clone()]);
        out[places.v.clone()].copy_from_slice(unknowns.a);
        add(&mut out[places.v.clone()], unknowns.w);
        let Residual { motion, w, u, lambda, eta, mu, .. } = &*residual;
        let of_rows = [
            (&places.a, motion),
            (&places.lambda, lambda),
            (&places.w, w),
            (&places.eta, eta),
            (&places.u, u),
            (&places.mu, mu),
        ];
        for (range, values) in of_rows {
            let out = &mut out[range.clone()];
            out.copy_from_slice(&values[..out.len()]);
        }
        self.each_row(|row, multiplier, _| {
            if row.is_none() {
                out[multiplier] = -x[multiplier];
            }
        });
        if all_finite(out) { Ok(()) } else { Err(dynamics.halt(Singular::NotFinite)) }
    }

    /// Writes the powers whose integrals are the works. One evaluation of forces and constraints.
    pub fn powers(&self, dynamics: &mut Dynamics, t: f64, x: &[f64], out: &mut [f64]) {
        let UnknownRanges { q, v, lambda, .. } = &self.places;
        dynamics.statistics.rhs_evaluations += 1;
        dynamics.evaluate(t, &x[q.clone()], &x[v.clone()], Need::FORCE | Need::CONSTRAINTS);
        out.iter_mut().zip(dynamics.powers(&x[lambda.clone()])).for_each(|(out, power)| *out = power);
    }

    /// Calls `see` with each row of multipliers, its place, and its constraint; without a row where the multiplier is
    /// zero.
    fn each_row(&self, mut see: impl FnMut(Option<DaeRow>, usize, usize)) {
        let both = [self.dae, self.dae.nonholonomic()];
        let of: [(&Range<usize>, RowOf); 3] = [
            (&self.places.lambda, |dae| Some(dae.lambda)),
            (&self.places.eta, |dae| dae.eta),
            (&self.places.mu, |dae| dae.mu),
        ];
        for (range, row_of) in of {
            for (constraint, place) in range.clone().enumerate() {
                let row = row_of(both[usize::from(constraint >= self.n.holonomic())]);
                see(row.filter(|_| !self.dropped.contains(&constraint)), place, constraint);
            }
        }
    }

    /// Places of the entries of dF/dx, in the order of [`Self::jacobian`]; a place may occur more than once.
    pub fn pattern(&self, dynamics: &Dynamics) -> Vec<(usize, usize)> {
        let structure = &dynamics.structure;
        let zeros = |pattern: &Pattern| vec![0.0; pattern.entries.len()];
        let mass = zeros(&structure.mass);
        let g = zeros(&structure.g);
        // The values do not count.
        let q = vec![1.0; self.n.q];
        let at = Matrices {
            mass: &mass,
            g: &g,
            l: &g,
            gradient: &g,
            tangent: &self.tangent,
            q: &q,
            velocity: &self.velocity,
        };
        let mut entries = Vec::new();
        self.visit(structure, &at, |row, col, _| entries.push((row, col)));
        entries
    }

    /// Passes the values of the entries of dF/dx to `add`. One evaluation of K and C.
    ///
    /// # Errors
    /// Equations without K and C.
    pub fn jacobian(
        &mut self,
        dynamics: &mut Dynamics,
        t: f64,
        x: &[f64],
        mut add_value: impl FnMut(f64),
    ) -> Result<(), StepError> {
        let part = |range: &Range<usize>| &x[range.clone()];
        let UnknownRanges { q, v, a, lambda, u, .. } = &self.places;
        let at = OperatingPoint { t, q: part(q), v: part(v), vdot: part(a), lambda: part(lambda) };
        dynamics.evaluate(t, at.q, at.v, Need::DYNAMICS | Need::L);
        if !dynamics.system.tangent(at, &mut self.tangent, &mut dynamics.scratch) {
            return Err(NO_TANGENT);
        }
        let has_gradient =
            self.dae.holds(2) && dynamics.system.acceleration_gradient(at, &mut self.gradient, &mut dynamics.scratch);
        if !has_gradient {
            self.gradient.fill(0.0);
        }
        dynamics.statistics.jacobian_evaluations += 1;
        self.velocity.copy_from_slice(at.v);
        add(&mut self.velocity, part(u));
        self.directions.update(dynamics.system, at.q);
        let terms = &dynamics.terms;
        let at = Matrices {
            mass: &terms.mass,
            g: &terms.g,
            l: &terms.l,
            gradient: &self.gradient,
            tangent: &self.tangent,
            q: at.q,
            velocity: &self.velocity,
        };
        self.visit(&dynamics.structure, &at, |_, _, value| add_value(value));
        Ok(())
    }

    /// Passes all entries of dF/dx to `put`: row, column, value. M u + G^T mu and M w + G^T eta are differentiated at
    /// u = w = 0.
    fn visit(&self, structure: &Structure, at: &Matrices, mut put: impl FnMut(usize, usize, f64)) {
        let UnknownRanges { q, v, a, lambda, w, eta, u, mu, .. } = &self.places;
        for shift in [v, u].into_iter().filter(|part| !part.is_empty()) {
            self.directions.rate(at.q, |row, direction, value| put(q.start + row, shift.start + direction, value));
        }
        self.directions.rate_gradient(at.velocity, |row, col, value| put(q.start + row, q.start + col, value));
        for part in [a, w] {
            part.clone().enumerate().for_each(|(i, col)| put(v.start + i, col, 1.0));
        }
        for ((&(i, j), k), c) in structure.tangent.entries.iter().zip(&at.tangent.k).zip(&at.tangent.c) {
            self.directions.along(at.q, j, -k, |col, value| put(a.start + i, q.start + col, value));
            put(a.start + i, v.start + j, -c);
        }
        for (part, multipliers) in [(a, lambda), (w, eta), (u, mu)].into_iter().filter(|(part, _)| !part.is_empty()) {
            for (&(i, j), mass) in structure.mass.entries.iter().zip(at.mass) {
                put(part.start + i, part.start + j, -mass);
                if i != j {
                    put(part.start + j, part.start + i, -mass);
                }
            }
            for (&(row, j), g) in structure.g.entries.iter().zip(at.g) {
                put(part.start + j, multipliers.start + row, -g);
            }
        }
        self.visit_rows(structure, at, put);
    }

    /// The entries of the rows of multipliers: with 0 = c_0 phi + c_1 phi' + c_2 phi'',
    ///
    /// ```text
    /// d/dq = c_0 G + c_1 L + c_2 d(phi'')/dq,   d/dv = c_1 G + 2 c_2 L,   d/da = c_2 G
    /// ```
    fn visit_rows(&self, structure: &Structure, at: &Matrices, mut put: impl FnMut(usize, usize, f64)) {
        let UnknownRanges { q, v, a, .. } = &self.places;
        self.each_row(|row, place, constraint| {
            let Some(DaeRow { position, velocity, acceleration }) = row else { return put(place, place, -1.0) };
            for &entry in &self.by_constraint[constraint] {
                let j = structure.g.entries[entry].1;
                let g = at.g[entry];
                let l = at.l[entry];
                let gradient = at.gradient[entry];
                let of_q = position * g + velocity * l + acceleration * gradient;
                self.directions.along(at.q, j, -of_q, |col, value| put(place, q.start + col, value));
                if row.is_some_and(|row| row.level() > 0) {
                    put(place, v.start + j, -(velocity * g + 2.0 * acceleration * l));
                }
                if acceleration != 0.0 {
                    put(place, a.start + j, -acceleration * g);
                }
            }
        });
    }
}
