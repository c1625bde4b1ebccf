//! The pencils.

use super::Built;
use super::rounding::Parts;
use crate::error::Result;
use crate::linearize::{Changes, Matrix, Variation, names};

/// Which constraints stand beside the equations of motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    Index3,
    Index2,
    Index1,
    Ggl,
}

impl Form {
    pub fn named(name: &str) -> Self {
        match name {
            "index2" => Form::Index2,
            "index1" => Form::Index1,
            "ggl" => Form::Ggl,
            _ => Form::Index3,
        }
    }

    /// Infinite eigenvalues with `m` independent constraints.
    fn infinite(self, m: usize) -> usize {
        match self {
            Form::Index3 => 3 * m,
            Form::Index2 => 2 * m,
            Form::Index1 => m,
            Form::Ggl => 4 * m,
        }
    }

    /// (E, A), B, C and D in x = (dq, dv, dlambda), with dmu behind for GGL.
    pub fn build(self, variation: &mut Variation) -> Result<Built> {
        let kept = variation.independent_rows();
        let (n, m) = (variation.len(), kept.len());
        let kept_rows = |rows: Matrix| rows.select_rows(&kept);
        let mut parts = Parts {
            k: variation.k(),
            c: variation.c(),
            g: kept_rows(variation.g()),
            gd: kept_rows(variation.gd()),
            rows: kept_rows(variation.rows(&Changes::all(n), [0.0; 2])),
        };
        parts.clean(variation);
        let Parts { k, c, g, gd, rows } = parts;
        let size = 2 * n + if self == Form::Ggl { 2 * m } else { m };
        let (mut e, mut a) = (Matrix::zeros(size, size), Matrix::zeros(size, size));
        put(&mut e, (0, 0), &Matrix::identity(n, n));
        put(&mut e, (n, n), &variation.mass());
        put(&mut a, (0, 0), &-variation.bracket(&variation.point.v));
        put(&mut a, (0, n), &Matrix::identity(n, n));
        put(&mut a, (n, 0), &-k);
        put(&mut a, (n, n), &-c);
        put(&mut a, (n, 2 * n), &-g.transpose());
        match self {
            Form::Index3 => put(&mut a, (2 * n, 0), &g),
            Form::Index2 => put(&mut a, (2 * n, 0), &beside(&gd, &g)),
            Form::Index1 => {
                put(&mut e, (2 * n, n), &g);
                put(&mut a, (2 * n, 0), &rows);
            }
            Form::Ggl => {
                put(&mut a, (0, 2 * n + m), &-g.transpose());
                put(&mut a, (2 * n, 0), &beside(&gd, &g));
                put(&mut a, (2 * n + m, 0), &g);
            }
        }
        self.observe(variation, &kept, (e, a))
    }

    /// With the inputs and outputs.
    fn observe(self, variation: &mut Variation, kept: &[usize], (e, a): (Matrix, Matrix)) -> Result<Built> {
        let (n, size) = (variation.len(), a.nrows());
        let (inputs, outputs) = (variation.inputs(), variation.outputs()?);
        let (mut b, mut c) = (Matrix::zeros(size, inputs.ncols()), Matrix::zeros(outputs.q.nrows(), size));
        put(&mut b, (n, 0), &inputs);
        put(&mut c, (0, 0), &outputs.q);
        put(&mut c, (0, n), &outputs.v);
        put(&mut c, (0, 2 * n), &outputs.lambda.select_columns(kept));
        let unit = Matrix::identity(size, size);
        let changes = Changes { q: unit.rows(0, n).clone_owned(), v: unit.rows(n, n).clone_owned() };
        let mut d = outputs.u;
        if let Some(of_force) = over_mass(outputs.vdot, variation.mass()) {
            c += &of_force * a.rows(n, n);
            d += &of_force * inputs;
        }
        let states = self.states(variation, kept);
        let (chart, infinite) = ("redundant".to_string(), self.infinite(kept.len()));
        Ok(Built { chart, states, a, b, c, d, e: Some(e), changes, infinite })
    }

    fn states(self, variation: &Variation, kept: &[usize]) -> Vec<String> {
        let system = variation.system();
        let mut states = names::directions(system, &variation.point.q).states();
        let multipliers = system.names().lambda;
        states.extend(kept.iter().map(|&row| multipliers[row].clone()));
        if self == Form::Ggl {
            states.extend(kept.iter().map(|&row| format!("{} mu", multipliers[row])));
        }
        states
    }
}

/// W M^-1: what outputs W dv' are of M dv', which a pencil's second rows say. Outputs feel no directions without mass.
fn over_mass(outputs: Matrix, mut mass: Matrix) -> Option<Matrix> {
    if outputs.iter().all(|slope| *slope == 0.0) {
        return None;
    }
    for i in 0..mass.nrows() {
        if mass[(i, i)] == 0.0 {
            mass[(i, i)] = 1.0;
        }
    }
    Some(mass.lu().solve(&outputs.transpose())?.transpose())
}

fn put(target: &mut Matrix, at: (usize, usize), block: &Matrix) {
    target.view_mut(at, block.shape()).copy_from(block);
}

fn beside(left: &Matrix, right: &Matrix) -> Matrix {
    crate::linearize::response::beside([left, right])
}
