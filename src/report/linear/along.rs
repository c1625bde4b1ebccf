//! `ltv.npz`, `ltv.mat` and `ltv.json`: linear models along a motion.

use super::NamedModel;
use super::files::{Arrays, matrix, unit_arrays, units};
use super::mode_figures::motion_figure;
use crate::error::{Error, Result, significant, two_digits};
use crate::files::{Array, mat};
use crate::linearize::{Along, Deviation, LinearModel, MeasuredA};
use crate::prepared::Model;
use crate::report::table::count;
use crate::report::{Answer, Folder, TextTable};
use crate::system::Names;
use serde::Serialize;
use serde_json::{Map, Value, json};

/// Formats of the models along a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum ArrayFormat {
    /// NumPy.
    Npz,
    /// MATLAB.
    Mat,
    /// All arrays in `ltv.json`, which otherwise has names, units, times and errors.
    Json,
}

pub struct AlongAnswer<'a> {
    pub prepared: &'a Model,
    pub along: &'a Along,
    pub formats: &'a [ArrayFormat],
}

impl AlongAnswer<'_> {
    fn first(&self) -> &LinearModel {
        &self.along.models[0]
    }

    fn named<'m>(&'m self, names: &'m Names, model: &'m LinearModel) -> NamedModel<'m> {
        NamedModel { scene: &self.prepared.name, names, model }
    }

    /// Returns the arrays along the motion, the time first, and the transition matrices.
    fn arrays(&self) -> Result<Arrays> {
        let names = self.prepared.system().facts().names.clone();
        let mut moments = self.along.models.iter().map(|model| self.named(&names, model).moment());
        let mut stacks: Vec<(&'static str, Vec<Array>)> = Vec::new();
        for (key, array) in moments.next().into_iter().flatten() {
            stacks.push((key, vec![array]));
        }
        for arrays in moments {
            stacks.iter_mut().zip(arrays).for_each(|((_, stack), (_, array))| stack.push(array));
        }
        let transitions = self.along.transitions.iter().map(matrix).collect();
        stacks.push(("Phi", transitions));
        if let Some(closure) = &self.along.closure {
            stacks.push(("closure", vec![matrix(closure)]));
        }
        let stacked = |(key, stack)| Ok((key, stacked(key, stack)?));
        stacks.into_iter().map(stacked).collect()
    }

    /// Returns names, units and errors, for NumPy and MATLAB.
    fn words(&self) -> Arrays {
        let model = self.first();
        let names = self.prepared.system().facts().names.clone();
        let named = self.named(&names, model);
        let mut words = named.labels();
        words.extend(named.coordinate_names());
        words.extend(model.frame.iter().flat_map(unit_arrays));
        let Along { measured, deviations, .. } = self.along;
        let each = |value: fn(&MeasuredA) -> f64| Array::vector(&measured.iter().map(value).collect::<Vec<f64>>());
        words.extend([
            ("error_t", each(|measured| measured.t)),
            ("error_A", each(|measured| measured.error)),
            ("error_A_uncertainty", each(|measured| measured.uncertainty)),
            ("interpolated", Array::Texts(deviations.iter().map(|deviation| deviation.of.to_string()).collect())),
            ("error_interpolation", Array::vector(&deviations.iter().map(|found| found.error).collect::<Vec<f64>>())),
        ]);
        words
    }

    /// Returns the measurement of A with the largest error.
    fn worst(&self) -> Option<&MeasuredA> {
        self.along.measured.iter().max_by(|a, b| a.error.total_cmp(&b.error))
    }
}

impl Answer for AlongAnswer<'_> {
    fn json(&self) -> impl Serialize {
        let model = self.first();
        let names = self.prepared.system().facts().names.clone();
        let Along { models, measured, deviations, .. } = self.along;
        let labels = self.named(&names, model).labels().into_iter();
        let mut found: Map<String, Value> = labels.map(|(key, label)| (key.to_string(), json!(label))).collect();
        found.insert("units".to_string(), json!(model.frame.as_ref().map(units)));
        found.insert("names".to_string(), json!({ "q": names.q, "v": names.v, "lambda": names.lambda }));
        found.insert("error".to_string(), json!({ "A": measured, "interpolation": deviations }));
        found.insert("t".to_string(), models.iter().map(|model| model.point.t).collect());
        if self.formats.contains(&ArrayFormat::Json) {
            let arrays = self.arrays().unwrap_or_default().into_iter().filter(|(key, _)| *key != "t");
            found.extend(arrays.map(|(key, array)| (key.to_string(), json!(array))));
        }
        found
    }

    fn text(&self) -> String {
        let model = self.first();
        let Along { models, .. } = self.along;
        let sizes = [(&model.states, "state"), (&model.inputs, "input"), (&model.outputs, "output")];
        let sizes = sizes.map(|(all, noun)| count(all.len(), noun)).join(", ");
        let end = models.last().map_or(0.0, |last| last.point.t);
        let mut text = format!(
            "{} from t = {} s to {} s: {} by {}, x' = A(t) x + B(t) u, {sizes}\n  {}\n",
            self.prepared.name,
            significant(model.point.t, 9),
            significant(end, 9),
            count(models.len(), "linear model"),
            model.method,
            chart(&model.chart)
        );
        if let Some(closure) = &self.along.closure {
            let angles = closure.complex_eigenvalues().iter().map(|value| value.arg().abs()).fold(0.0, f64::max);
            let turn = significant(if angles < 1e-9 { 0.0 } else { angles.to_degrees() }, 6);
            text += &format!("  the motion returns; the chart has turned by {turn} deg meanwhile\n");
        }
        if let Some(MeasuredA { t, error, uncertainty }) = self.worst() {
            text += &format!(
                "  A is right to {} of its largest entry, by transition matrices at {} (can be told to {}); worst at t = {} s\n",
                two_digits(*error),
                count(self.along.measured.len(), "state"),
                two_digits(*uncertainty),
                significant(*t, 6)
            );
        }
        let mut table = TextTable::new(&["matrix", "largest entry", "linear interpolation off by (%)", "at t (s)"]);
        for Deviation { of, largest, error, t } in self.along.deviations.iter().filter(|found| found.largest > 0.0) {
            let percent = significant(100.0 * error, 3);
            table.row([of.to_string(), significant(*largest, 6), percent, significant(*t, 6)]);
        }
        format!("{text}\n{table}")
    }

    fn write(&self, folder: &mut Folder, stem: &str) -> Result<()> {
        let is_array = |format: &&ArrayFormat| **format != ArrayFormat::Json;
        if self.formats.iter().any(|format| is_array(&format)) {
            let arrays = [self.words(), self.arrays()?].concat();
            if self.formats.contains(&ArrayFormat::Npz) {
                #[cfg(feature = "npz")]
                folder.write(&format!("{stem}.npz"), &crate::files::npz::write(&arrays)?)?;
            }
            if self.formats.contains(&ArrayFormat::Mat) {
                folder.write(&format!("{stem}.mat"), &mat::write(&arrays)?)?;
            }
        }
        let title = format!("{}: frozen eigenvalues along the motion", self.prepared.name);
        folder.figure(stem, motion_figure(&title, &self.along.branches, None))
    }
}

/// Returns the meaning of a chart along a motion.
fn chart(name: &str) -> String {
    match name {
        "intrinsic" => "chart intrinsic: axes carried along with the motion without turning".to_string(),
        "mass_orthogonal" => {
            "chart mass_orthogonal: axes that move as little as the constraints let them, in the mass metric"
                .to_string()
        }
        names => format!("chart {names}: changes counted in these coordinates"),
    }
}

/// Returns arrays of equal shape as one, with their number as its first length.
fn stacked(key: &str, arrays: Vec<Array>) -> Result<Array> {
    let mut shape = vec![arrays.len()];
    let mut all = Vec::new();
    for (i, array) in arrays.into_iter().enumerate() {
        let Array::Real { shape: own, values } = array else { continue };
        if i == 0 {
            shape.extend(&own);
        }
        if shape[1..] != own[..] {
            return Err(Error::input(format!("the size of {key} changes along the motion")).hint("end before it does"));
        }
        all.extend(values);
    }
    Ok(Array::Real { shape, values: all })
}
