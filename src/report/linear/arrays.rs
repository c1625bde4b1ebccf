//! The arrays of `linear-T.npz` and `linear-T.mat`.

use super::Linear;
use crate::files::Array;
use crate::linearize::{Complex, Kind, Matrix, Mode};

impl Linear<'_> {
    /// Everything with names that Python and MATLAB both allow. Columns of `mode_shapes` (along `v`) and `participation`
    /// (along `states`) belong to the `eigenvalues`; they are zero where nothing is known.
    pub fn arrays(&self) -> Vec<(&'static str, Array)> {
        let (model, point) = (self.model, &self.model.point);
        let mut arrays = vec![
            ("scene", Array::Text(self.scene.to_string())),
            ("t", Array::number(point.t)),
            ("method", Array::Text(model.method.clone())),
            ("chart", Array::Text(model.chart.clone())),
            ("states", Array::Texts(model.states.clone())),
            ("inputs", Array::Texts(model.inputs.clone())),
            ("outputs", Array::Texts(model.outputs.clone())),
            ("A", matrix(&model.a)),
            ("B", matrix(&model.b)),
            ("C", matrix(&model.c)),
            ("D", matrix(&model.d)),
        ];
        arrays.extend(model.e.iter().map(|e| ("E", matrix(e))));
        arrays.extend(self.mode_arrays());
        arrays.extend([
            ("equilibrium", Array::Flag(point.is_equilibrium)),
            ("q", Array::vector(&point.q)),
            ("v", Array::vector(&point.v)),
            ("vdot", Array::vector(&point.vdot)),
            ("lambda", Array::vector(&point.lambda)),
            ("q_names", Array::Texts(self.names.q.clone())),
            ("v_names", Array::Texts(self.names.v.clone())),
            ("lambda_names", Array::Texts(self.names.lambda.clone())),
        ]);
        let norms = self.norms();
        arrays.extend(
            [("norm_phi", norms.phi), ("norm_phi_dot", norms.phi_dot), ("norm_v", norms.v), ("norm_vdot", norms.vdot)]
                .map(|(name, value)| (name, Array::number(value))),
        );
        arrays
    }

    fn mode_arrays(&self) -> [(&'static str, Array); 6] {
        let model = self.model;
        let each = |value: fn(&Mode) -> f64| Array::vector(&model.modes.iter().map(value).collect::<Vec<f64>>());
        let shapes = table(&model.modes, model.point.v.len(), |mode, i| mode.shape.get(i).copied().unwrap_or_default());
        let parts =
            table(&model.modes, model.states.len(), |mode, i| mode.participation.get(i).copied().unwrap_or(0.0));
        let [rows, columns] = [model.point.v.len(), model.modes.len()];
        [
            ("eigenvalues", Array::complex(model.modes.iter().map(value).collect())),
            ("kinds", Array::Texts(model.modes.iter().map(|mode| kind(mode.kind).to_string()).collect())),
            ("frequency_hz", each(|mode| if is_infinite(mode) { f64::INFINITY } else { mode.frequency() })),
            ("damping_ratio", each(Mode::damping)),
            ("mode_shapes", Array::Complex { shape: vec![rows, columns], values: shapes }),
            ("participation", Array::Real { shape: vec![model.states.len(), columns], values: parts }),
        ]
    }
}

fn is_infinite(mode: &Mode) -> bool {
    mode.kind == Kind::Infinite
}

fn value(mode: &Mode) -> Complex<f64> {
    if is_infinite(mode) { Complex::new(f64::INFINITY, 0.0) } else { mode.value }
}

/// The word for a kind in files and text.
pub(super) fn kind(kind: Kind) -> &'static str {
    match kind {
        Kind::Physical => "physical",
        Kind::Uncertain => "uncertain",
        Kind::Spurious => "spurious",
        Kind::Infinite => "infinite",
    }
}

fn matrix(matrix: &Matrix) -> Array {
    let values = matrix.row_iter().flat_map(|row| row.iter().copied().collect::<Vec<f64>>()).collect();
    Array::Real { shape: vec![matrix.nrows(), matrix.ncols()], values }
}

/// One row a component, one column a mode.
fn table<T>(modes: &[Mode], rows: usize, value: impl Fn(&Mode, usize) -> T) -> Vec<T> {
    let value = &value;
    (0..rows).flat_map(|i| modes.iter().map(move |mode| value(mode, i))).collect()
}
