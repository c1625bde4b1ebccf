//! `linear-T.json`, and the arrays of `linear-T.npz` and `linear-T.mat`.

use super::NamedModel;
use crate::error::Result;
use crate::files::{Array, mat};
use crate::linearize::{Complex, Coordinates, Frame, Kind, LinearModel, Matrix, Mode, Units, damping, frequency};
use crate::math::largest;
use crate::prepared::Model;
use crate::report::mechanism::{Look, mode_figure};
use crate::report::table::named;
use crate::report::{Answer, Folder, cell, object};
use crate::tolerances;
use serde::{Serialize, Serializer};
use serde_json::{Map, Value, json};

/// Largest components; those of phi and phi' over their scales.
#[derive(Serialize)]
pub(super) struct Norms {
    pub phi: f64,
    pub phi_dot: f64,
    pub v: f64,
    pub vdot: f64,
}

/// Returns the name of the files of a result at a time without extension, such as `linear-0.01`.
pub fn stem_at(what: &str, t: f64) -> String {
    format!("{what}-{}", cell(t))
}

/// A linear model with the figure of its modes.
pub struct LinearAnswer<'a> {
    pub prepared: &'a Model,
    pub linear: NamedModel<'a>,
}

impl Answer for LinearAnswer<'_> {
    fn json(&self) -> impl Serialize {
        self.linear
    }

    fn text(&self) -> String {
        self.linear.text()
    }

    fn write(&self, folder: &mut Folder, stem: &str) -> Result<()> {
        let LinearAnswer { prepared, linear } = self;
        linear.write(folder, stem)?;
        let figure = mode_figure(prepared, &Look::plain(&prepared.mechanism), linear.model);
        folder.figure(&stem.replace("linear", "modes"), figure)
    }
}

impl NamedModel<'_> {
    /// Writes the arrays for NumPy and for MATLAB; `stem` is the name of the files without extension.
    pub fn write(&self, folder: &mut Folder, stem: &str) -> Result<()> {
        let arrays = self.arrays();
        #[cfg(feature = "npz")]
        folder.write(&format!("{stem}.npz"), &crate::files::npz::write(&arrays)?)?;
        folder.write(&format!("{stem}.mat"), &mat::write(&arrays)?)
    }

    /// Returns the state that is perturbed, by names. Of a steady rotation q and v are expressed in its axes.
    fn point(&self) -> Value {
        let point = &self.model.point;
        let mut found = json!({
            "q": named(&self.names.q, &point.q),
            "v": named(&self.names.v, &point.v),
            "vdot": named(&self.names.v, &point.vdot),
            "lambda": named(&self.names.lambda, &point.lambda),
        });
        let inputs = named(&self.model.input_names(), &point.u);
        if !inputs.is_empty() {
            found["u"] = inputs.into();
        }
        if let Some(frame) = &self.model.frame {
            let moving = point.v.len() - point.states;
            found["xi"] = named(&self.names.v[moving..], &point.v[moving..]).into();
            found["qdot"] = named(&self.names.q, &frame.qdot).into();
            found["y0"] = named(&self.model.outputs, &frame.outputs).into();
        }
        found["norms"] = json!(self.norms());
        if let Some(spin) = point.axes {
            let axis = spin.velocity.map(|w| w / spin.speed());
            found["steady_rotation"] = json!({ "speed": spin.speed(), "axis": axis, "point": spin.point });
        }
        found
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

impl Serialize for NamedModel<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let model = self.model;
        object!(serializer,
            "scene" => self.scene,
            "t" => model.point.t,
            "method" => model.method,
            "chart" => model.chart,
            "states" => model.states,
            "inputs" => model.inputs,
            "outputs" => model.outputs,
            "A" => rows(&model.a),
            "B" => rows(&model.b),
            "C" => rows(&model.c),
            "D" => rows(&model.d),
            "E" if model.e.is_some() => model.e.as_ref().map(rows),
            "R" if model.frame.is_some() => model.frame.as_ref().map(|frame| rows(&frame.coordinates.r)),
            "T" if model.frame.is_some() => model.frame.as_ref().map(|frame| rows(&frame.coordinates.tilt)),
            "R_left" if model.frame.is_some() => model.frame.as_ref().map(|frame| rows(&frame.coordinates.b)),
            "units" if model.frame.is_some() => model.frame.as_ref().map(units),
            "reduction" => model.reduction,
            "comparable" => model.is_comparable(),
            "eigenvalues" => model.modes.iter().map(|mode| eigenvalue(model, mode)).collect::<Vec<Value>>(),
            "equilibrium" => model.point.is_equilibrium,
            "operating_point" => self.point(),
            "cost" => model.cost,
        )
    }
}

/// Units of x, u and y.
pub(super) fn units(Frame { units: Units { states, inputs, outputs }, .. }: &Frame) -> Value {
    json!({ "states": states, "inputs": inputs, "outputs": outputs })
}

fn rows(matrix: &Matrix) -> Vec<Vec<f64>> {
    matrix.row_iter().map(|row| row.iter().copied().collect()).collect()
}

/// Returns an eigenvalue, whose numbers are null where it is infinite, with the participation of each state, from the
/// largest.
fn eigenvalue(model: &LinearModel, mode: &Mode) -> Value {
    let is_finite = mode.kind != Kind::Infinite && mode.value.re.is_finite() && mode.value.im.is_finite();
    let finite = |value: f64| is_finite.then_some(value);
    let value = shown(mode);
    let parts = largest_parts(&model.states, &mode.participation).into_iter();
    let parts = parts.filter(|(_, part)| *part >= tolerances::UNSEEN);
    json!({
        "re": finite(value.re),
        "im": finite(value.im),
        "frequency_hz": finite(frequency(value)),
        "damping_ratio": finite(mode.clean_damping()).filter(|_| !mode.is_zero()),
        "kind": mode.kind,
        "error": finite(if mode.is_zero() { mode.rounding } else { mode.error }),
        "condition": finite(mode.condition).filter(|condition| condition.is_finite()),
        "participation": parts.map(|(name, part)| (name.to_string(), Value::from(part))).collect::<Map<String, Value>>(),
    })
}

/// Returns states with their participation, from the largest; equal ones in their order.
fn largest_parts<'a>(states: &'a [String], parts: &[f64]) -> Vec<(&'a str, f64)> {
    let mut named: Vec<(&str, f64)> = states.iter().map(String::as_str).zip(parts.iter().copied()).collect();
    named.sort_by(|a, b| b.1.total_cmp(&a.1));
    named
}

impl NamedModel<'_> {
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
        arrays.extend(self.frame_arrays());
        if let Some(frame) = &model.frame {
            arrays.extend(unit_arrays(frame));
        }
        arrays
    }

    /// Returns the arrays that change along a motion.
    pub(super) fn moment(&self) -> Vec<(&'static str, Array)> {
        let model = self.model;
        let point = &model.point;
        let mut arrays = vec![
            ("t", Array::number(point.t)),
            ("A", matrix(&model.a)),
            ("B", matrix(&model.b)),
            ("C", matrix(&model.c)),
            ("D", matrix(&model.d)),
            ("q", Array::vector(&point.q)),
            ("v", Array::vector(&point.v)),
            ("vdot", Array::vector(&point.vdot)),
            ("lambda", Array::vector(&point.lambda)),
            ("u", Array::vector(&point.u)),
            ("condition", Array::number(model.reduction.condition)),
            ("error_reduction", Array::number(model.reduction.error)),
        ];
        arrays.extend(self.frame_arrays());
        arrays
    }

    /// Returns the basis, and what the outputs and rates are at the state: nothing without minimal coordinates.
    fn frame_arrays(&self) -> Vec<(&'static str, Array)> {
        let Some(Frame { coordinates, qdot, outputs, .. }) = &self.model.frame else { return Vec::new() };
        let Coordinates { r, tilt, b, lift, .. } = coordinates;
        let point = &self.model.point;
        let mut arrays = vec![
            ("xi", Array::vector(&point.v[point.v.len() - point.states..])),
            ("qdot", Array::vector(qdot)),
            ("y0", Array::vector(outputs)),
            ("R", matrix(r)),
            ("T", matrix(tilt)),
            ("R_left", matrix(b)),
        ];
        if lift.p.iter().any(|x| *x != 0.0) {
            arrays.extend([("P", matrix(&lift.p)), ("S", matrix(&lift.s))]);
        }
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

/// Returns the units of x, u and y.
pub(super) fn unit_arrays(
    Frame { units: Units { states, inputs, outputs }, .. }: &Frame,
) -> [(&'static str, Array); 3] {
    [("state_units", states), ("input_units", inputs), ("output_units", outputs)]
        .map(|(name, units)| (name, Array::Texts(units.clone())))
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

pub(super) fn matrix(matrix: &Matrix) -> Array {
    let values = matrix.row_iter().flat_map(|row| row.iter().copied().collect::<Vec<f64>>()).collect();
    Array::Real { shape: vec![matrix.nrows(), matrix.ncols()], values }
}

/// Returns a table with one row per component, one column per mode.
fn table<T>(modes: &[Mode], rows: usize, value: impl Fn(&Mode, usize) -> T) -> Vec<T> {
    let value = &value;
    (0..rows).flat_map(|i| modes.iter().map(move |mode| value(mode, i))).collect()
}
