//! A, B, C and D measured by differences of perturbed states, without derivatives of the equations.
//!
//! ```text
//! dv' = (v'(+eps) - v'(-eps)) / 2 eps,   dy = (y(+eps) - y(-eps)) / 2 eps            eps -> 0
//! x'  = (x(dq + h (dv - [v, dq]), dv, chart at h) - x(dq, dv, chart)) / h + B dv'    h -> 0
//! ```
//!
//! The difference of two motions over h, divided by h, has as its limit the difference of their accelerations: no
//! motion needs to be integrated. States and inputs are perturbed one at a time. The chart at h is that carried along
//! the motion. Both limits are extrapolated.

use super::deviation::{Comparison, Deviation, MatrixLimits, Unjudged};
use super::limit::{Limit, limit};
use super::probe::{Probe, Shift};
use super::subject::Subject;
use crate::error::Result;
use crate::linearize::{Changes, Coordinates, Matrix, Minimal, State, Variation, beside};
use crate::math::bounds;
use crate::system::MechanicalSystem;
use crate::tolerances;
use crate::tolerances::SAME;
use serde::Serialize;
use std::ops::Range;

/// Perturbations whose differences are round-off but for the slope. Unit: `[1]`, m or rad. Why: the square root of
/// rounding. Test: `spoilt_terms_are_condemned_with_their_size`.
const TINY_SHIFTS: [f64; 2] = [1e-8, 3.7e-9];

/// Deviations of the matrices; none where a matrix has no entries or was not measured.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Measured {
    /// Of A, with its columns of the states of inputs.
    pub a: Option<Deviation>,
    /// Of B.
    pub b: Option<Deviation>,
    /// Of C, with its columns of the states of inputs.
    pub c: Option<Deviation>,
    /// Of D.
    pub d: Option<Deviation>,
    /// Rows of which entries are not judged.
    pub unjudged: Vec<Unjudged>,
}

impl Measured {
    /// Returns the matrices that were measured, with their names.
    pub fn all(&self) -> impl Iterator<Item = (char, &Deviation)> {
        let all = [('A', &self.a), ('B', &self.b), ('C', &self.c), ('D', &self.d)];
        all.into_iter().filter_map(|(name, deviation)| Some((name, deviation.as_ref()?)))
    }
}

/// The chart at times h after the start, in decreasing order.
pub struct Along<'c> {
    pub steps: &'c [f64],
    pub charts: &'c [Coordinates],
}

/// A perturbation of the state or of an input.
struct PerturbedVariable {
    name: String,
    /// Input and the derivative of it that is 1; none: a state.
    input: Option<(usize, usize)>,
    /// True if it is an input of the model and no state.
    is_input: bool,
}

/// True if the two sides of a state have different slopes: the even part of a change over its size, which falls with
/// the size where there is a derivative, does not fall and is not the `rounding` of the change.
fn has_kink(slopes: &[(f64, Matrix, Matrix)], row: usize, rounding: f64) -> bool {
    let [Some((_, _, far)), Some((eps, slope, near))] = [slopes.first(), slopes.last()] else { return false };
    let least = (SAME * slope[row].abs()).max(rounding / eps);
    near[row].abs() > 0.5 * far[row].abs() && near[row].abs() > least
}

/// The model at a state, and the memory to measure it.
struct Bench<'m, 'a> {
    variation: &'m mut Variation<'a>,
    model: &'m Minimal,
    rate: f64,
    columns: Vec<PerturbedVariable>,
    /// (dq, dv) of each column.
    changes: Changes,
}

/// Measures the model in the chart of its coordinates; none if the time is over before.
///
/// # Errors
/// Outputs without derivatives.
pub fn measure(
    subject: &Subject,
    variation: &mut Variation,
    along: &Along,
    has_inputs: bool,
) -> Result<Option<Measured>> {
    let Subject { system, start, model, norm, is_over, .. } = subject;
    if along.charts.len() < tolerances::FEWEST_CHARTS {
        return Ok(None);
    }
    let mut bench = Bench::new(variation, model, norm.rate, has_inputs);
    let Some(responses) = bench.responses(*system, start, *is_over) else { return Ok(None) };
    let motion = bench.motion(along);
    Ok(Some(bench.compare(responses, motion)?))
}

impl<'m, 'a> Bench<'m, 'a> {
    fn new(variation: &'m mut Variation<'a>, model: &'m Minimal, rate: f64, has_inputs: bool) -> Self {
        let Minimal { coordinates, built } = model;
        let state = |name: &String| PerturbedVariable { name: name.clone(), input: None, is_input: false };
        let mut columns: Vec<PerturbedVariable> = built.states.iter().map(state).collect();
        let names = variation.names().0;
        let inputs = || names.iter().zip(&built.input_states.orders).enumerate().filter(|_| has_inputs);
        let column = |name: &str, j: usize, i: usize, is_input: bool| PerturbedVariable {
            name: format!("{name}{}", "'".repeat(i)),
            input: Some((j, i)),
            is_input,
        };
        columns.extend(inputs().flat_map(|(j, (name, &order))| (0..order).map(move |i| column(name, j, i, false))));
        columns.extend(inputs().map(|(j, (name, &order))| column(name, j, order, true)));
        let mut changes = coordinates.changes();
        let states = changes.q.ncols();
        changes.q = changes.q.resize_horizontally(columns.len(), 0.0);
        changes.v = changes.v.resize_horizontally(columns.len(), 0.0);
        for (index, column) in columns.iter().enumerate().skip(states).filter(|(_, column)| !column.is_input) {
            let lifted = column.input.and_then(|(j, i)| coordinates.lift.along(i, j));
            if let Some([dq, dv]) = lifted {
                changes.q.column_mut(index).copy_from(&dq);
                changes.v.column_mut(index).copy_from(&dv);
            }
        }
        Bench { variation, model, rate, columns, changes }
    }

    /// Returns B dv' of each column, and the outputs below.
    fn responses(
        &self,
        system: &dyn MechanicalSystem,
        start: &State,
        is_over: &dyn Fn() -> bool,
    ) -> Option<MatrixLimits> {
        let mut probe = Probe::new(system, start);
        let b = &self.model.coordinates.b;
        let rows = b.nrows() + self.model.built.c.nrows();
        let mut value = |shift: &Shift, size: f64| -> Option<Matrix> {
            let (vdot, outputs) = probe.at(shift, size).ok()?;
            let mut value = (b * Matrix::from_vec(b.ncols(), 1, vdot)).resize_vertically(rows, 0.0);
            value.rows_mut(b.nrows(), outputs.len()).copy_from_slice(&outputs);
            Some(value)
        };
        // Extrapolation needs the first powers only.
        let reach = 0.1 * system.facts().length.min(1.0);
        let mut tables = Vec::new();
        for index in 0..self.columns.len() {
            if is_over() {
                return None;
            }
            let shift = self.shift(index);
            let unit = self.size(index);
            let middle = value(&shift, 0.0)?;
            let mut slope = |eps: f64| {
                let above = value(&shift, eps)?;
                let below = value(&shift, -eps)?;
                let even = (&above + &below - &middle * 2.0) / (2.0 * eps);
                Some((eps, (above - below) / (2.0 * eps), even))
            };
            // Errors of second order fall by sixteen, and the last perturbation is 2e-5.
            let sizes = (0..7).map(|i| reach * 0.25f64.powi(i) / unit);
            let slopes: Vec<(f64, Matrix, Matrix)> = sizes.filter_map(&mut slope).collect();
            let tiny = TINY_SHIFTS.iter().filter_map(|eps| slope(eps / unit));
            tables.push((slopes, tiny.collect::<Vec<_>>()));
        }
        let mut limits = MatrixLimits::new(rows, self.columns.len());
        for row in 0..rows {
            let extrapolated = |slopes: &[(f64, Matrix, Matrix)], rounding: f64| {
                let (sizes, values): (Vec<f64>, Vec<f64>) =
                    slopes.iter().map(|(eps, slope, _)| (*eps, slope[row])).unzip();
                limit(&sizes, &values, 2, rounding)
            };
            // The round-off of the scene, from differences so small that they are nothing else.
            let noise = tables.iter().flat_map(|(slopes, tiny)| {
                let rough = extrapolated(slopes, 0.0).value;
                tiny.iter().map(move |(eps, slope, _)| (slope[row] - rough).abs() * eps)
            });
            // A few differences do not show the largest one.
            let rounding = 10.0 * bounds(noise.filter(|x| x.is_finite())).1.max(0.0);
            for (column, (slopes, _)) in tables.iter().enumerate() {
                let limit = extrapolated(slopes, rounding);
                // A change that is mostly even, as of a kinetic energy near rest, rounds by its even part.
                let even = slopes.iter().map(|(_, _, even)| even[row].abs()).fold(0.0, f64::max);
                let rounded = limit.uncertainty + f64::EPSILON * even;
                let uncertainty = if has_kink(slopes, row, rounding) { f64::INFINITY } else { rounded };
                limits.set((row, column), Limit { uncertainty, ..limit });
            }
        }
        Some(limits)
    }

    fn shift(&self, index: usize) -> Shift<'_> {
        let n = self.changes.q.nrows();
        let range = index * n..(index + 1) * n;
        let jet = |i: usize| std::array::from_fn(|derivative| f64::from(u8::from(derivative == i)));
        Shift {
            q: &self.changes.q.as_slice()[range.clone()],
            v: &self.changes.v.as_slice()[range],
            input: self.columns[index].input.map(|(j, i)| (j, jet(i))),
        }
    }

    /// Returns the size of a column: its largest change of q, of v in a unit of time, or of v' in the square of it.
    fn size(&self, index: usize) -> f64 {
        let Minimal { coordinates, built } = self.model;
        let largest = |matrix: &Matrix, column: usize| matrix.column(column).amax();
        let moved = largest(&self.changes.q, index).max(largest(&self.changes.v, index) / self.rate);
        let pushed = self.columns[index].input.map_or(0.0, |(j, i)| {
            let first = built.input_states.orders[..j].iter().sum::<usize>();
            let rates =
                if self.columns[index].is_input { built.b.column(j) } else { built.input_states.a.column(first + i) };
            (&coordinates.r * rates.rows(coordinates.freedom(), coordinates.r.ncols())).amax() / self.rate.powi(2)
        });
        Some(moved.max(pushed)).filter(|size| *size > 0.0 && size.is_finite()).unwrap_or(1.0)
    }

    /// Returns the part of x' of each column that is not B dv'.
    fn motion(&self, along: &Along) -> MatrixLimits {
        let Coordinates { b, tilt, .. } = &self.model.coordinates;
        let Changes { q, v } = &self.changes;
        let k = tilt.ncols();
        let mut rates = v - self.variation.bracket_of(&self.variation.point.v, q);
        let moving = self.variation.system().dimensions().moving();
        rates.rows_mut(moving, v.nrows() - moving).fill(0.0);
        let states = |chart: &Coordinates, h: f64| {
            let moved = chart.lift.s.clone() * self.inputs(h);
            chart.states_of(&Changes { q: q + &rates * h, v: v - moved })
        };
        let start = states(&self.model.coordinates, 0.0);
        let slope = |(chart, h): (&Coordinates, &f64)| (states(chart, *h) - &start) / *h;
        let slopes: Vec<Matrix> = along.charts.iter().zip(along.steps).map(slope).collect();
        let mut limits = MatrixLimits::new(start.nrows(), start.ncols());
        let absolute = b.abs();
        let sizes = absolute.rows(0, k) * q.abs();
        let speeds = &absolute * (v.abs() + tilt.abs() * &sizes);
        for row in 0..start.nrows() {
            for column in 0..start.ncols() {
                let size = if row < k { sizes[(row, column)] } else { speeds[(row - k, column)] };
                let values: Vec<f64> = slopes.iter().map(|slope| slope[(row, column)]).collect();
                limits.set((row, column), limit(along.steps, &values, 1, tolerances::FLOW_RTOL * size));
            }
        }
        limits
    }

    /// Returns u at h after the start for each column, n_u rows.
    fn inputs(&self, h: f64) -> Matrix {
        let mut u = Matrix::zeros(self.model.coordinates.lift.s.ncols(), self.columns.len());
        for (index, column) in self.columns.iter().enumerate() {
            match column.input {
                Some((j, 0)) => u[(j, index)] = 1.0,
                Some((j, 1)) => u[(j, index)] = h,
                _ => {}
            }
        }
        u
    }

    /// Adds what outputs have of the inputs directly, which is given and not measured.
    fn add_direct(&mut self, measured: &mut Matrix, first: usize) -> Result<()> {
        let direct = self.variation.outputs()?;
        for (index, column) in self.columns.iter().enumerate() {
            let slopes = match column.input {
                Some((j, 0)) => direct.u.column(j),
                Some((j, 1)) => direct.udot.column(j),
                _ => continue,
            };
            let mut sum = measured.view_mut((first, index), (slopes.nrows(), 1));
            sum += slopes;
        }
        Ok(())
    }

    /// Compares the model with the measured responses and motion.
    fn compare(&mut self, responses: MatrixLimits, motion: MatrixLimits) -> Result<Measured> {
        let Minimal { coordinates, built } = self.model;
        let k = coordinates.freedom();
        let n = motion.values.nrows();
        let outputs = built.c.nrows();
        let stack = |top: Matrix, bottom: &Matrix| {
            let mut whole = top.resize_vertically(n + outputs, 0.0);
            whole.rows_mut(n, outputs).copy_from(bottom);
            whole
        };
        let join = |motion: Matrix, responses: &Matrix| {
            let mut whole = stack(motion, &responses.rows(n - k, outputs).clone_owned());
            let mut accelerations = whole.rows_mut(k, n - k);
            accelerations += responses.rows(0, n - k);
            whole
        };
        let mut values = join(motion.values, &responses.values);
        self.add_direct(&mut values, n)?;
        let measured = MatrixLimits { values, uncertainties: join(motion.uncertainties, &responses.uncertainties) };
        let wide = |states: &Matrix, input_states: &Matrix, inputs: &Matrix| {
            let whole = beside(states, &beside(input_states, inputs));
            whole.columns(0, self.columns.len()).clone_owned()
        };
        let states = &built.input_states;
        let model = stack(wide(&built.a, &states.a, &built.b), &wide(&built.c, &states.c, &built.d));
        let comparison = Comparison::new(model, measured, k, n, self.rate);
        let rows = [built.states.clone(), self.variation.names().1].concat();
        let columns: Vec<String> = self.columns.iter().map(|column| column.name.clone()).collect();
        let state_count = self.columns.iter().filter(|column| !column.is_input).count();
        let block =
            |rows_of: Range<usize>, columns_of: Range<usize>| comparison.worst(rows_of, columns_of, [&rows, &columns]);
        let row_count = n + outputs;
        Ok(Measured {
            a: block(0..n, 0..state_count),
            b: block(0..n, state_count..columns.len()),
            c: block(n..row_count, 0..state_count),
            d: block(n..row_count, state_count..columns.len()),
            unjudged: comparison.unjudged([&rows, &columns]),
        })
    }
}
