//! `linear-T.json`, and the arrays of `linear-T.npz` and `linear-T.mat`.

use super::NamedModel;
use crate::error::Result;
use crate::files::{Array, mat};
use crate::linearize::{
    Complex, Coordinates, Kind, LinearModel, LinearizationPoint, Matrix, Mode, ModelFrame, Units, damping, frequency,
};
use crate::math::largest;
use crate::prepared::Model;
use crate::report::mechanism::{Look, mode_figure};
use crate::report::table::named;
use crate::report::{Answer, Folder, cell, object};
use crate::system::Names;
use crate::tolerances;
use serde::{Serialize, Serializer};
use serde_json::{Map, Value, json};

pub(super) type Arrays = Vec<(&'static str, Array)>;

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
    /// Writes the arrays for NumPy and for MATLAB.
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
        let basis = model.frame.as_ref().map(|frame| &frame.coordinates);
        object!(serializer,
            "scene" => self.scene,
            "t" => model.point.t,
            "method" => model.method,
            "chart" => model.chart,
            "states" => model.states,
            "inputs" => model.inputs,
            "outputs" => model.outputs,
            "A" => matrix(&model.a),
            "B" => matrix(&model.b),
            "C" => matrix(&model.c),
            "D" => matrix(&model.d),
            "E" if model.e.is_some() => model.e.as_ref().map(matrix),
            "R" if basis.is_some() => basis.map(|basis| matrix(&basis.r)),
            "T" if basis.is_some() => basis.map(|basis| matrix(&basis.tilt)),
            "R_left" if basis.is_some() => basis.map(|basis| matrix(&basis.b)),
            "units" if basis.is_some() => model.frame.as_ref().map(units),
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
pub(super) fn units(ModelFrame { units: Units { states, inputs, outputs }, .. }: &ModelFrame) -> Value {
    json!({ "states": states, "inputs": inputs, "outputs": outputs })
}

/// Returns an eigenvalue, whose numbers are null where it is infinite, with the participation of each state, from the
/// largest.
fn eigenvalue(model: &LinearModel, mode: &Mode) -> Value {
    let is_finite = mode.kind != Kind::Infinite && mode.value.re.is_finite() && mode.value.im.is_finite();
    let finite = |value: f64| is_finite.then_some(value);
    let value = shown(mode);
    let mut parts: Vec<(&String, f64)> = model.states.iter().zip(mode.participation.iter().copied()).collect();
    parts.retain(|(_, part)| *part >= tolerances::UNSEEN);
    parts.sort_by(|a, b| b.1.total_cmp(&a.1));
    let parts = parts.into_iter().map(|(name, part)| (name.clone(), Value::from(part)));
    json!({
        "re": finite(value.re),
        "im": finite(value.im),
        "frequency_hz": finite(frequency(value)),
        "damping_ratio": finite(mode.clean_damping()).filter(|_| !mode.is_zero()),
        "kind": mode.kind,
        "error": finite(if mode.is_zero() { mode.rounding } else { mode.error }),
        "condition": finite(mode.condition).filter(|condition| condition.is_finite()),
        "participation": parts.collect::<Map<String, Value>>(),
    })
}

impl NamedModel<'_> {
    /// Returns all arrays, with names that Python and MATLAB both allow. Columns of `mode_shapes` (along `v`) and
    /// `participation` (along `states`) belong to the `eigenvalues`; they are zero where nothing is known.
    pub fn arrays(&self) -> Arrays {
        let model = self.model;
        let mut arrays = self.labels();
        arrays.insert(1, ("t", Array::number(model.point.t)));
        arrays.extend(self.matrices());
        arrays.extend(model.e.iter().map(|e| ("E", matrix(e))));
        arrays.extend(self.mode_arrays());
        arrays.push(("equilibrium", Array::Flag(model.point.is_equilibrium)));
        arrays.extend(self.state());
        arrays.extend(self.coordinate_names());
        let Norms { phi, phi_dot, v, vdot } = self.norms();
        let norms = [("norm_phi", phi), ("norm_phi_dot", phi_dot), ("norm_v", v), ("norm_vdot", vdot)];
        arrays.extend(norms.map(|(name, value)| (name, Array::number(value))));
        arrays.extend(self.frame_arrays());
        arrays.extend(model.frame.iter().flat_map(unit_arrays));
        arrays
    }

    /// Returns the arrays that change along a motion.
    pub(super) fn moment(&self) -> Arrays {
        let LinearModel { point, reduction, .. } = self.model;
        let mut arrays = vec![("t", Array::number(point.t))];
        arrays.extend(self.matrices());
        arrays.extend(self.state());
        arrays.push(("condition", Array::number(reduction.condition)));
        arrays.push(("error_reduction", Array::number(reduction.error)));
        arrays.extend(self.frame_arrays());
        arrays
    }

    /// Returns scene, method, chart and the names of states, inputs and outputs.
    pub(super) fn labels(&self) -> Arrays {
        let LinearModel { method, chart, states, inputs, outputs, .. } = self.model;
        let texts = [("scene", self.scene), ("method", method), ("chart", chart)];
        let texts = texts.map(|(name, text)| (name, Array::Text(text.to_string()))).into_iter();
        let lists = [("states", states), ("inputs", inputs), ("outputs", outputs)];
        texts.chain(lists.map(|(name, list)| (name, Array::Texts(list.clone())))).collect()
    }

    pub(super) fn coordinate_names(&self) -> [(&'static str, Array); 3] {
        let Names { q, v, lambda, .. } = self.names;
        [("q_names", q), ("v_names", v), ("lambda_names", lambda)]
            .map(|(name, list)| (name, Array::Texts(list.clone())))
    }

    fn matrices(&self) -> [(&'static str, Array); 4] {
        let LinearModel { a, b, c, d, .. } = self.model;
        [("A", a), ("B", b), ("C", c), ("D", d)].map(|(name, values)| (name, matrix(values)))
    }

    fn state(&self) -> [(&'static str, Array); 5] {
        let LinearizationPoint { q, v, vdot, lambda, u, .. } = &self.model.point;
        [("q", q), ("v", v), ("vdot", vdot), ("lambda", lambda), ("u", u)].map(|(name, x)| (name, Array::vector(x)))
    }

    /// Returns the basis, and what the outputs and rates are at the state: nothing without minimal coordinates.
    fn frame_arrays(&self) -> Arrays {
        let Some(ModelFrame { coordinates, qdot, outputs, .. }) = &self.model.frame else { return Vec::new() };
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

pub(super) fn unit_arrays(frame: &ModelFrame) -> [(&'static str, Array); 3] {
    let Units { states, inputs, outputs } = &frame.units;
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
