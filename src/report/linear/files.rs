//! `linear-T.json`, and the arrays of `linear-T.npz` and `linear-T.mat`.

use super::Linear;
use crate::error::Result;
use crate::files::{Array, mat};
use crate::linearize::{Complex, Cost, Kind, LinearModel, Matrix, Mode, Reduction, damping, frequency};
use crate::math::largest;
use crate::report::table::named;
use crate::report::{Folder, cell};
use crate::tolerances::report as tolerances;
use serde::Serialize;
use serde_json::{Map, Value};

/// A linear model as in the file; matrices by rows.
#[derive(Clone, Debug, Serialize)]
pub struct LinearFile {
    /// Name of the scene.
    pub scene: String,
    /// Time of the state, s.
    pub t: f64,
    /// Method with its options.
    pub method: String,
    /// Chart of the coordinates.
    pub chart: String,
    /// Names of the states x.
    pub states: Vec<String>,
    /// Names of the inputs u.
    pub inputs: Vec<String>,
    /// Names of the outputs y.
    pub outputs: Vec<String>,
    /// A, n_x x n_x.
    #[serde(rename = "A")]
    pub a: Vec<Vec<f64>>,
    /// B, n_x x n_u.
    #[serde(rename = "B")]
    pub b: Vec<Vec<f64>>,
    /// C, n_y x n_x.
    #[serde(rename = "C")]
    pub c: Vec<Vec<f64>>,
    /// D, n_y x n_u.
    #[serde(rename = "D")]
    pub d: Vec<Vec<f64>>,
    /// E of descriptor forms, n_x x n_x.
    #[serde(rename = "E", skip_serializing_if = "Option::is_none")]
    pub e: Option<Vec<Vec<f64>>>,
    /// Condition of the reduction to the directions that the constraints allow, and the relative error that follows.
    pub reduction: Reduction,
    /// False where the method stays off the constraints and the state moves: its eigenvalues belong to no motion.
    pub comparable: bool,
    /// Eigenvalues in the order of [`LinearModel::modes`].
    pub eigenvalues: Vec<Eigenvalue>,
    /// True if the state is an equilibrium.
    pub equilibrium: bool,
    /// The state that is perturbed.
    pub operating_point: OperatingPointFile,
    /// Time, size and conditioning.
    pub cost: Cost,
}

/// An eigenvalue; its numbers are none where it is infinite.
#[derive(Clone, Debug, Serialize)]
pub struct Eigenvalue {
    pub re: Option<f64>,
    pub im: Option<f64>,
    pub frequency_hz: Option<f64>,
    pub damping_ratio: Option<f64>,
    pub kind: Kind,
    /// Error of the eigenvalue, 1/s.
    pub error: Option<f64>,
    /// 1/|y^H x| of its vectors; none where it is defective, or not known.
    pub condition: Option<f64>,
    /// Participation of each state, from the largest.
    pub participation: Map<String, Value>,
}

/// The state that is perturbed, by names.
#[derive(Clone, Debug, Serialize)]
pub struct OperatingPointFile {
    /// Coordinates.
    pub q: Map<String, Value>,
    /// Velocities.
    pub v: Map<String, Value>,
    /// Accelerations.
    pub vdot: Map<String, Value>,
    /// Multipliers.
    pub lambda: Map<String, Value>,
    /// Values of the inputs of the scene.
    #[serde(skip_serializing_if = "Map::is_empty")]
    pub u: Map<String, Value>,
    /// Largest components.
    pub norms: Norms,
    /// The axes of a steady rotation, in which q and v are expressed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steady_rotation: Option<Turn>,
}

/// Axes that rotate at a constant speed.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Turn {
    /// Angular velocity, rad/s.
    pub speed: f64,
    /// Direction of the axis of rotation.
    pub axis: [f64; 3],
    /// A point on the axis, m.
    pub point: [f64; 3],
}

/// Largest components; those of phi and phi' over their scales.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Norms {
    pub phi: f64,
    pub phi_dot: f64,
    pub v: f64,
    pub vdot: f64,
}

/// Returns the name of a model's files without extension, such as `linear-0.01`.
pub fn linear_stem(t: f64) -> String {
    format!("linear-{}", cell(t))
}

impl Linear<'_> {
    /// Writes the arrays for NumPy and for MATLAB; `stem` is the name of the files without extension.
    ///
    /// # Errors
    /// Files that cannot be written.
    pub fn write(&self, folder: &mut Folder, stem: &str) -> Result<()> {
        let arrays = self.arrays();
        #[cfg(feature = "npz")]
        folder.write(&format!("{stem}.npz"), &crate::files::npz::write(&arrays)?)?;
        folder.write(&format!("{stem}.mat"), &mat::write(&arrays)?)
    }

    /// Returns the model as in `linear-T.json`.
    pub fn file(&self) -> LinearFile {
        let model = self.model;
        LinearFile {
            scene: self.scene.to_string(),
            t: model.point.t,
            method: model.method.clone(),
            chart: model.chart.clone(),
            states: model.states.clone(),
            inputs: model.inputs.clone(),
            outputs: model.outputs.clone(),
            a: rows(&model.a),
            b: rows(&model.b),
            c: rows(&model.c),
            d: rows(&model.d),
            e: model.e.as_ref().map(rows),
            reduction: model.reduction,
            comparable: model.is_comparable(),
            eigenvalues: model.modes.iter().map(|mode| eigenvalue(model, mode)).collect(),
            equilibrium: model.point.is_equilibrium,
            operating_point: self.point(),
            cost: model.cost,
        }
    }

    fn point(&self) -> OperatingPointFile {
        let model = self.model;
        let point = &self.model.point;
        OperatingPointFile {
            q: named(&self.names.q, &point.q),
            v: named(&self.names.v, &point.v),
            vdot: named(&self.names.v, &point.vdot),
            lambda: named(&self.names.lambda, &point.lambda),
            u: named(&model.input_names(), &point.u),
            norms: self.norms(),
            steady_rotation: point.axes.map(|spin| Turn {
                speed: spin.speed(),
                axis: spin.velocity.map(|w| w / spin.speed()),
                point: spin.point,
            }),
        }
    }

    pub(super) fn norms(&self) -> Norms {
        let point = &self.model.point;
        let moving = point.v.len() - point.states;
        Norms {
            phi: point.phi,
            phi_dot: point.phi_dot,
            v: largest(&point.v[..moving]),
            vdot: largest(&point.vdot[..moving]),
        }
    }
}

fn rows(matrix: &Matrix) -> Vec<Vec<f64>> {
    matrix.row_iter().map(|row| row.iter().copied().collect()).collect()
}

fn eigenvalue(model: &LinearModel, mode: &Mode) -> Eigenvalue {
    let is_finite = mode.kind != Kind::Infinite && mode.value.re.is_finite() && mode.value.im.is_finite();
    let finite = |value: f64| is_finite.then_some(value);
    let value = shown(mode);
    let parts = largest_parts(&model.states, &mode.participation).into_iter();
    let parts = parts.filter(|(_, part)| *part >= tolerances::PART_OF_MODE);
    Eigenvalue {
        re: finite(value.re),
        im: finite(value.im),
        frequency_hz: finite(frequency(value)),
        damping_ratio: finite(mode.clean_damping()).filter(|_| !mode.is_zero()),
        kind: mode.kind,
        error: finite(if mode.is_zero() { mode.rounding } else { mode.error }),
        condition: finite(mode.condition).filter(|condition| condition.is_finite()),
        participation: parts.map(|(name, part)| (name.to_string(), Value::from(part))).collect(),
    }
}

/// Returns states with their participation, from the largest; equal ones in their order.
fn largest_parts<'a>(states: &'a [String], parts: &[f64]) -> Vec<(&'a str, f64)> {
    let mut named: Vec<(&str, f64)> = states.iter().map(String::as_str).zip(parts.iter().copied()).collect();
    named.sort_by(|a, b| b.1.total_cmp(&a.1));
    named
}

impl Linear<'_> {
    /// Returns all arrays, with names that Python and MATLAB both allow. Columns of `mode_shapes` (along `v`) and
    /// `participation` (along `states`) belong to the `eigenvalues`; they are zero where nothing is known.
    pub fn arrays(&self) -> Vec<(&'static str, Array)> {
        let model = self.model;
        let point = &self.model.point;
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
            ("u", Array::vector(&point.u)),
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
            ("kinds", Array::Texts(model.modes.iter().map(|mode| mode.kind.name().to_string()).collect())),
            ("frequency_hz", each(|mode| if is_infinite(mode) { f64::INFINITY } else { frequency(shown(mode)) })),
            ("damping_ratio", each(|mode| damping(shown(mode)))),
            ("mode_shapes", Array::Complex { shape: vec![rows, columns], values: shapes }),
            ("participation", Array::Real { shape: vec![model.states.len(), columns], values: parts }),
        ]
    }
}

fn is_infinite(mode: &Mode) -> bool {
    mode.kind == Kind::Infinite
}

fn value(mode: &Mode) -> Complex<f64> {
    if is_infinite(mode) { Complex::new(f64::INFINITY, 0.0) } else { shown(mode) }
}

/// The eigenvalue, zero where it is rounding.
fn shown(mode: &Mode) -> Complex<f64> {
    if mode.is_zero() { Complex::ZERO } else { mode.value }
}

fn matrix(matrix: &Matrix) -> Array {
    let values = matrix.row_iter().flat_map(|row| row.iter().copied().collect::<Vec<f64>>()).collect();
    Array::Real { shape: vec![matrix.nrows(), matrix.ncols()], values }
}

/// Returns a table with one row per component, one column per mode.
fn table<T>(modes: &[Mode], rows: usize, value: impl Fn(&Mode, usize) -> T) -> Vec<T> {
    let value = &value;
    (0..rows).flat_map(|i| modes.iter().map(move |mode| value(mode, i))).collect()
}
