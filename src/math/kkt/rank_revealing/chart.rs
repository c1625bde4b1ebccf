//! Corrections along the normal directions of a base state: its tangent space is a chart of the manifold around it.

use super::super::Pattern;
use super::pivoted::PivotedQr;
use super::{coordinate_scale, scaled_rows, truncated};
use crate::math::{add_scaled, dot};
use crate::tolerances;

/// Corrections d = Y c with G d = r at a nearby state, where S = diag(M)^-1/2 and Y = S Q_1 from the pivoted QR of (G
/// S)^T at the base state: G Y c = r, by a pivoted QR of (G Y)^T. Such a d has no part along the base's null space in
/// the metric of diag(M). Rows that are dependent at the base are dropped. Costs 3 n m^2 for a base, 3 m^3 for a state
/// and 2 (n + m) m for a solution.
pub struct CorrectionChart {
    mass: Pattern,
    g: Pattern,
    scale: Vec<f64>,
    /// Sizes of the rows of G S at the base.
    norms: Vec<f64>,
    base: PivotedQr,
    /// Y by rows.
    normal: Vec<f64>,
    /// QR factors of (G Y)^T at the current state. Rows that were dependent at the base are barred: a choice that changed
    /// from state to state would follow now one, now another of contradicting rows.
    place: PivotedQr,
    x: Vec<f64>,
    c: Vec<f64>,
}

impl CorrectionChart {
    /// The patterns must fit each other.
    pub fn new(mass: &Pattern, g: &Pattern) -> Self {
        let n = g.cols;
        let m = g.rows;
        let most = n.min(m);
        CorrectionChart {
            mass: mass.clone(),
            g: g.clone(),
            scale: vec![1.0; n],
            norms: vec![1.0; m],
            base: PivotedQr::new(n, m),
            normal: vec![0.0; n * most],
            place: PivotedQr::new(most, m),
            x: vec![0.0; n],
            c: vec![0.0; m],
        }
    }

    /// Makes the state with these values the base.
    pub fn rebase(&mut self, mass: &[f64], g: &[f64]) {
        coordinate_scale(&self.mass, mass, &mut self.scale);
        scaled_rows(&self.g, g, &self.scale, &mut self.norms, &mut self.base.values);
        self.base.factor(tolerances::RANK);
        let rank = self.base.rank;
        self.place.bars.fill(true);
        self.base.permutation[..rank].iter().for_each(|row| self.place.bars[*row] = false);
        for k in 0..rank {
            self.x.fill(0.0);
            self.x[k] = 1.0;
            self.base.apply(&mut self.x);
            for (i, (x, scale)) in self.x.iter().zip(&self.scale).enumerate() {
                self.normal[i * rank + k] = x * scale;
            }
        }
    }

    /// Factors (G Y)^T with these values of G; `reference`: see [`Reduced::factor`](super::Reduced::factor).
    pub fn factor(&mut self, g: &[f64], reference: f64) {
        let rank = self.base.rank;
        self.place.rows = rank;
        self.place.values.fill(0.0);
        for (&(i, j), value) in self.g.entries.iter().zip(g) {
            let row = &mut self.place.values[i * rank..(i + 1) * rank];
            add_scaled(value / self.norms[i], &self.normal[j * rank..(j + 1) * rank], row);
        }
        // Near a singular state, components below round-off are left to the next step.
        self.place.factor(truncated(tolerances::RANK, reference));
    }

    /// d = Y c with G d = r.
    pub fn solve(&mut self, r: &[f64], d: &mut [f64]) {
        let rank = self.base.rank;
        for (c, &p) in self.c.iter_mut().zip(&self.place.permutation) {
            *c = r[p] / self.norms[p];
        }
        self.place.solve_transposed(&mut self.c);
        self.c[self.place.rank..].fill(0.0);
        let c = &mut self.c[..rank];
        self.place.apply(c);
        for (i, d) in d.iter_mut().enumerate() {
            *d = dot(&self.normal[i * rank..(i + 1) * rank], c);
        }
    }
}
