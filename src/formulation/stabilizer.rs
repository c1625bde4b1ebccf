//! F(z) h(z): the ways to move a state back towards the manifold h = (phi, G v + phi_t) = 0.
//!
//! Used after a step (post-stabilization, z -= F h) and as a vector field (z' = fhat - gamma F h). H = dh/dz =
//! [G 0; L G] and B = M^-1 G^T. Source: Ascher, Chin, Reich, Numer. Math. 67 (1994) 131-149; Ascher, Chin, Petzold,
//! Reich, Mech. Struct. Mach. 23 (1995) 135-157.

use super::{Dynamics, StepError};
use crate::error::{Error, Result, suggest};
use crate::math::kkt::{Pattern, SaddlePoint};
use crate::method_spec::MethodSpec;
use crate::system::{MechanicalSystem, Need};

/// Choices of F.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StabilizingField {
    /// Position rows only: dq = B (G B)^-1 phi.
    Position,
    /// Velocity rows only: dv = B (G B)^-1 (G v + phi_t).
    Velocity,
    /// S-both: both of the above with one factorization. H F = [I 0; * I], so two sweeps converge quadratically.
    Both,
    /// S-full: F = H^T (H H^T)^-1, H F = I, least change of (q, v). Needs L.
    Full,
    /// W H^T (H W H^T)^-1 with W = diag(M^-1, M^-1): least change in the mass metric, H F = I. Needs L.
    MassWeighted,
    /// dq as in S-both, then dv = B (G B)^-1 (G v + phi_t - L dq): H F = I for two back-substitutions. Needs L.
    Triangular,
    /// F = H^T: no solution of a linear system, but H F = H H^T, whose size depends on units. Needs L.
    Gradient,
}

const FIELDS: [(&str, StabilizingField); 7] = [
    ("both", StabilizingField::Both),
    ("full", StabilizingField::Full),
    ("mass_weighted", StabilizingField::MassWeighted),
    ("triangular", StabilizingField::Triangular),
    ("position", StabilizingField::Position),
    ("velocity", StabilizingField::Velocity),
    ("gradient", StabilizingField::Gradient),
];

impl StabilizingField {
    /// The option `field` of a method; S-both where it is not given.
    pub fn from_spec(spec: &MethodSpec) -> Result<StabilizingField> {
        let Some(text) = spec.text("field") else { return Ok(StabilizingField::Both) };
        let found = FIELDS.iter().find(|(name, _)| *name == text.replace('-', "_")).map(|(_, field)| *field);
        found.ok_or_else(|| {
            Error::input(format!("{}: there is no field `{text}`", spec.name))
                .hint(suggest(text, FIELDS.iter().map(|(name, _)| *name)))
        })
    }

    /// Terms that F h needs.
    pub fn needs(self) -> Need {
        let first = Need::MASS | Need::CONSTRAINTS | Need::G;
        match self {
            StabilizingField::Position | StabilizingField::Velocity | StabilizingField::Both => first,
            _ => first | Need::L,
        }
    }
}

/// One F with the memory to apply it.
pub struct Stabilizer {
    /// The choice of F.
    pub field: StabilizingField,
    /// F h, position part, along the directions of v.
    pub dq: Vec<f64>,
    /// F h, velocity part.
    pub dv: Vec<f64>,
    full: Option<Full>,
    row: Vec<f64>,
}

/// The system for dq and dv together: [W^-1 H^T; H 0] [dz; .] = [0; h].
struct Full {
    kkt: SaddlePoint,
    dropped: Vec<usize>,
    mass: Vec<f64>,
    h: Vec<f64>,
    dz: Vec<f64>,
}

impl Stabilizer {
    /// Memory for `field` on a system.
    pub fn new(field: StabilizingField, system: &dyn MechanicalSystem) -> Self {
        let n = system.dimensions();
        let full =
            matches!(field, StabilizingField::Full | StabilizingField::MassWeighted).then(|| Full::new(field, system));
        Stabilizer { field, dq: vec![0.0; n.v], dv: vec![0.0; n.v], full, row: vec![0.0; n.lambda] }
    }

    /// Computes F h from the terms in `dynamics`, whose saddle-point matrix must be factored.
    pub fn correction(&mut self, dynamics: &mut Dynamics) -> Result<(), StepError> {
        self.dq.fill(0.0);
        self.dv.fill(0.0);
        match self.field {
            StabilizingField::Position => dynamics.kkt.solve_projection(&dynamics.terms.phi, &mut self.dq)?,
            StabilizingField::Velocity => dynamics.kkt.solve_projection(&dynamics.terms.phi_dot, &mut self.dv)?,
            StabilizingField::Both => {
                let levels = [&dynamics.terms.phi[..], &dynamics.terms.phi_dot];
                dynamics.kkt.solve_projections(levels, [&mut self.dq, &mut self.dv])?;
            }
            StabilizingField::Triangular => self.triangular(dynamics)?,
            StabilizingField::Gradient => self.gradient(dynamics),
            StabilizingField::Full | StabilizingField::MassWeighted => self.full(dynamics)?,
        }
        Ok(())
    }

    fn triangular(&mut self, dynamics: &mut Dynamics) -> Result<(), StepError> {
        dynamics.kkt.solve_projection(&dynamics.terms.phi, &mut self.dq)?;
        self.row.fill(0.0);
        dynamics.structure.g.multiply(&dynamics.terms.l, &self.dq, &mut self.row);
        self.row.iter_mut().zip(&dynamics.terms.phi_dot).for_each(|(row, rate)| *row = rate - *row);
        Ok(dynamics.kkt.solve_projection(&self.row, &mut self.dv)?)
    }

    fn gradient(&mut self, dynamics: &Dynamics) {
        let g = &dynamics.structure.g;
        let terms = &dynamics.terms;
        g.multiply_transposed(&terms.g, &terms.phi, &mut self.dq);
        g.multiply_transposed(&terms.l, &terms.phi_dot, &mut self.dq);
        g.multiply_transposed(&terms.g, &terms.phi_dot, &mut self.dv);
    }

    fn full(&mut self, dynamics: &mut Dynamics) -> Result<(), StepError> {
        let Some(full) = &mut self.full else { return Ok(()) };
        let n = self.dq.len();
        let m = self.row.len();
        let terms = &dynamics.terms;
        if self.field == StabilizingField::MassWeighted {
            let (first, second) = full.mass.split_at_mut(terms.mass.len());
            first.copy_from_slice(&terms.mass);
            second.copy_from_slice(&terms.mass);
        }
        let entries = terms.g.len();
        full.h[..entries].copy_from_slice(&terms.g);
        full.h[entries..2 * entries].copy_from_slice(&terms.g);
        full.h[2 * entries..].copy_from_slice(&terms.l);
        full.drop_rows(&dynamics.dropped, m);
        dynamics.statistics.factorizations += 1;
        full.kkt.factor(&full.mass, &full.h)?;
        let bottom = &mut full.dz[2 * n..];
        bottom[..m].copy_from_slice(&terms.phi);
        bottom[m..].copy_from_slice(&terms.phi_dot);
        let (top, bottom) = full.dz.split_at_mut(2 * n);
        full.kkt.solve_projection(bottom, top)?;
        self.dq.copy_from_slice(&top[..n]);
        self.dv.copy_from_slice(&top[n..]);
        Ok(())
    }
}

impl Full {
    fn new(field: StabilizingField, system: &dyn MechanicalSystem) -> Self {
        let dimensions = system.dimensions();
        let structure = system.structure();
        let n = dimensions.v;
        let m = dimensions.lambda;
        let shifted = |pattern: &Pattern, i0: usize, j0: usize| -> Vec<(usize, usize)> {
            pattern.entries.iter().map(|&(i, j)| (i + i0, j + j0)).collect()
        };
        let mass = match field {
            StabilizingField::Full => {
                Pattern { rows: 2 * n, cols: 2 * n, entries: (0..2 * n).map(|i| (i, i)).collect() }
            }
            _ => {
                let entries = [shifted(&structure.mass, 0, 0), shifted(&structure.mass, n, n)].concat();
                Pattern { rows: 2 * n, cols: 2 * n, entries }
            }
        };
        let g = &structure.g;
        let entries = [shifted(g, 0, 0), shifted(g, m, n), shifted(g, m, 0)].concat();
        let h = Pattern { rows: 2 * m, cols: 2 * n, entries };
        Full {
            kkt: SaddlePoint::new(&mass, &h),
            dropped: Vec::new(),
            mass: vec![1.0; mass.entries.len()],
            h: vec![0.0; h.entries.len()],
            dz: vec![0.0; 2 * (n + m)],
        }
    }

    /// Drops the rows `rows` of both levels, of `m` rows per level.
    fn drop_rows(&mut self, rows: &[usize], m: usize) {
        let both = || rows.iter().copied().chain(rows.iter().map(|row| row + m));
        if !self.dropped.iter().copied().eq(both()) {
            self.dropped = both().collect();
            self.kkt.drop_rows(&self.dropped);
        }
    }
}
