//! A method of linearization: its request, its result and its entry in the registry.

use super::input_states::{InputStates, primed};
use super::{
    Changes, Chart, Coordinates, Cost, LinearModel, Matrix, Mode, ModelFrame, Reduction, Reference, Variation,
};
use crate::error::Result;
use crate::method_spec::{MethodSpec, OptionDoc};
use crate::system::Dimensions;

/// The method and the chart of a linear model. Default: `mcs`, minimal coordinates, in the preferred chart.
#[derive(Clone, Debug, PartialEq)]
pub struct Linear {
    /// Method with its options.
    pub method: MethodSpec,
    /// Chart of minimal coordinates; none: `intrinsic` where the equations allow it, else `mass_orthogonal`.
    pub chart: Option<Chart>,
}

impl Default for Linear {
    fn default() -> Self {
        Linear { method: MethodSpec::named("mcs"), chart: None }
    }
}

impl Linear {
    /// A model in independent coordinates by name, such as `crank.angle`.
    pub fn in_coordinates<N: Into<String>>(names: impl IntoIterator<Item = N>) -> Self {
        let names = names.into_iter().map(Into::into).collect();
        Linear { chart: Some(Chart::Independent(names)), ..Linear::default() }
    }

    pub(super) fn chart(&self, variation: &mut Variation) -> Chart {
        self.chart.clone().unwrap_or_else(|| Chart::preferred(variation))
    }
}

/// The matrices of E x' = A x + B u, y = C x + D u, without the states of inputs, whose columns stand apart.
pub struct LinearMatrices {
    /// Name of the chart.
    pub chart: String,
    /// Names of the states x.
    pub states: Vec<String>,
    /// A, n_x x n_x.
    pub a: Matrix,
    /// B, n_x x n_u.
    pub b: Matrix,
    /// C, n_y x n_x.
    pub c: Matrix,
    /// D, n_y x n_u.
    pub d: Matrix,
    /// E, n_x x n_x; none: I.
    pub e: Option<Matrix>,
    /// Columns of the states of inputs.
    pub input_states: InputStates,
    /// (dq, dv) of a unit of each state.
    pub changes: Changes,
    /// The chart of minimal coordinates, if the states are such.
    pub coordinates: Option<Coordinates>,
    /// Number of infinite eigenvalues.
    pub infinite: usize,
}

impl LinearMatrices {
    /// A descriptor form in (dq, dv, ..) has a dq for each direction of v. Those of the states xi, their integrals, act
    /// on nothing and are left out.
    pub(super) fn without_integrals(mut self, n: Dimensions) -> Self {
        let first = n.moving();
        let count = n.states;
        let square = |matrix: Matrix| matrix.remove_rows(first, count).remove_columns(first, count);
        self.states.drain(first..first + count);
        let Changes { q, v } = self.changes;
        let changes = Changes { q: q.remove_columns(first, count), v: v.remove_columns(first, count) };
        let b = self.b.remove_rows(first, count);
        let c = self.c.remove_columns(first, count);
        let a = self.input_states.a.remove_rows(first, count);
        let input_states = InputStates { a, ..self.input_states };
        LinearMatrices { a: square(self.a), e: self.e.map(square), b, c, input_states, changes, ..self }
    }

    /// Adds the states of the inputs to the model, as its last states, and renames its inputs to the derivatives that they are.
    fn add_input_states(&mut self, inputs: &mut [String]) {
        let InputStates { orders, a, c } = &self.input_states;
        let own = self.a.nrows();
        let added = a.ncols();
        let n_u = orders.len();
        self.states.extend(self.input_states.states(inputs));
        inputs.iter_mut().zip(orders).for_each(|(name, &order)| *name = primed(name, order));
        if added == 0 {
            return;
        }
        let grow = |matrix: &Matrix, rows: usize, columns: usize| matrix.clone().resize(rows, columns, 0.0);
        let size = own + added;
        let mut whole = grow(&self.a, size, size);
        whole.view_mut((0, own), a.shape()).copy_from(a);
        let mut b = grow(&self.b, size, n_u);
        let mut place = own;
        for (j, &order) in orders.iter().enumerate().filter(|(_, order)| **order > 0) {
            (1..order).for_each(|i| whole[(place + i - 1, place + i)] = 1.0);
            place += order;
            b[(place - 1, j)] = 1.0;
        }
        let mut outputs = grow(&self.c, self.c.nrows(), size);
        outputs.view_mut((0, own), c.shape()).copy_from(c);
        if let Some(e) = &mut self.e {
            *e = grow(e, size, size);
            (own..size).for_each(|i| e[(i, i)] = 1.0);
        }
        (self.a, self.b, self.c) = (whole, b, outputs);
    }

    /// The model by this method, with its modes.
    pub(super) fn finish(
        mut self,
        variation: &mut Variation,
        method: String,
        modes: Vec<Mode>,
        cost: Cost,
    ) -> LinearModel {
        let (mut inputs, outputs) = variation.names();
        self.add_input_states(&mut inputs);
        let LinearMatrices {
            chart, states, a, b, c, d, e, input_states: InputStates { orders, .. }, coordinates, ..
        } = self;
        let state = Reference::new(variation.system(), &variation.point, coordinates.as_ref());
        let frame = coordinates.map(|coordinates| ModelFrame::new(variation, coordinates, &orders));
        let point = variation.point.clone();
        let reduction = Reduction::default();
        LinearModel {
            method,
            chart,
            states,
            inputs,
            orders,
            outputs,
            a,
            b,
            c,
            d,
            e,
            modes,
            frame,
            state,
            point,
            cost,
            reduction,
        }
    }

    /// The change of q along each velocity direction of a unit of each state; of a state xi, that of xi itself.
    pub(super) fn shapes(&self, n: Dimensions) -> Matrix {
        let mut shapes = self.changes.q.clone();
        shapes.rows_mut(n.moving(), n.states).copy_from(&self.changes.v.rows(n.moving(), n.states));
        shapes
    }
}

/// A method as the command line lists it.
pub struct LinearizationMethod {
    /// Name on the command line.
    pub name: &'static str,
    /// Options that it takes.
    pub options: &'static [OptionDoc],
    /// Builds the matrices at the state of a variation.
    pub build: fn(&mut Variation, &Linear) -> Result<LinearMatrices>,
}
