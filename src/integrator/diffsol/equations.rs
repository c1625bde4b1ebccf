//! The equations of a run as diffsol takes them.

use super::rows::EquationRows;
use crate::formulation::{Statistics, StepError};
use crate::integrator::{Problem, StepStart};
use diffsol::{
    ConstantOp, FaerContext, FaerSparseMat, FaerVec, LinearOp, Matrix, NonLinearOp, NonLinearOpJacobian, OdeEquations,
    OdeEquationsRef, Op, UnitCallable, Vector, VectorCommon,
};
use faer::sparse::{Pair, SymbolicSparseColMat};
use std::cell::RefCell;

/// A rate so large that no step is accepted, and its square is a number.
const REFUSED_RATE: f64 = 1e100;

type Sparsity = SymbolicSparseColMat<usize>;

/// ```text
/// [I 0; 0 0] x' = F(t, x)
/// ```
///
/// with I of the differential variables, which come first: the rows of a formulation, whose works are integrals beside
/// x, or its vector field, where all variables are differential and the works are among them.
pub struct Equations<'s> {
    context: FaerContext,
    len: usize,
    differential: usize,
    /// Number of works beside x.
    works: usize,
    /// Pattern of dF/dx, and the place of each entry among its values; empty for a vector field.
    pattern: Sparsity,
    places: Vec<usize>,
    state: RefCell<EvaluationState<'s>>,
}

/// What an evaluation changes.
struct EvaluationState<'s> {
    problem: Problem<'s>,
    rows: Option<EquationRows>,
    /// The reason why the last evaluation failed.
    failure: Option<StepError>,
}

fn pattern(len: usize, entries: &[(usize, usize)]) -> Option<(Sparsity, Vec<usize>)> {
    let pairs: Vec<Pair<usize, usize>> = entries.iter().map(|&(row, col)| Pair::new(row, col)).collect();
    let (pattern, _) = Sparsity::try_new_from_indices(len, len, &pairs).ok()?;
    let place = |&(row, col): &(usize, usize)| {
        let range = pattern.col_range(col);
        pattern.row_idx()[range.clone()].binary_search(&row).ok().map(|at| range.start + at)
    };
    let places = entries.iter().map(place).collect::<Option<_>>()?;
    Some((pattern, places))
}

impl<'s> Equations<'s> {
    /// The rows `rows` of a formulation, or without them its vector field; `None` if there is not enough memory for the
    /// matrix.
    pub fn new(problem: Problem<'s>, rows: Option<EquationRows>) -> Option<Self> {
        let all = problem.len();
        let len = rows.as_ref().map_or(all, EquationRows::len);
        let differential = rows.as_ref().map_or(all, EquationRows::differential);
        let entries = rows.as_ref().map_or_else(Vec::new, |rows| rows.pattern(&problem.dynamics));
        let (pattern, places) = pattern(len, &entries)?;
        let state = RefCell::new(EvaluationState { problem, rows, failure: None });
        Some(Equations {
            context: FaerContext::new(),
            len,
            differential,
            works: all - differential,
            pattern,
            places,
            state,
        })
    }

    /// A vector of x.
    pub fn vector(&self, values: impl Fn(usize) -> f64) -> FaerVec<f64> {
        self.of_length(self.len, values)
    }

    /// A vector of the works beside x.
    pub fn works(&self, values: impl Fn(usize) -> f64) -> FaerVec<f64> {
        self.of_length(self.works, values)
    }

    fn of_length(&self, len: usize, values: impl Fn(usize) -> f64) -> FaerVec<f64> {
        FaerVec::from_vec((0..len).map(values).collect(), self.context)
    }

    /// Number of differential variables, after which the works beside x follow in y.
    pub fn differential(&self) -> usize {
        self.differential
    }

    /// x at the start of a step.
    pub fn start(&self, from: StepStart, lambda: &[f64]) -> Vec<f64> {
        let state = self.state.borrow();
        state.rows.as_ref().map_or_else(|| from.y.to_vec(), |rows| rows.start(from.y, from.slope, lambda))
    }

    /// Takes over the pieces of functions, the inputs, and the constants of the formulation, of a run.
    pub fn follow(&self, run: &Problem) {
        let Problem { dynamics, formulation, .. } = &mut self.state.borrow_mut().problem;
        dynamics.scratch.pieces.clone_from(&run.dynamics.scratch.pieces);
        dynamics.scratch.inputs.clone_from(&run.dynamics.scratch.inputs);
        dynamics.law.clone_from(&run.dynamics.law);
        formulation.recall(&run.formulation.settled());
    }

    /// Announces a step, with the reference values of a run.
    pub fn begin_step(&self, run: &Problem, from: StepStart) -> Result<(), StepError> {
        let problem = &mut self.state.borrow_mut().problem;
        problem.dynamics.refer_to(run.dynamics.kkt.rank_reference, run.dynamics.dense_reference);
        problem.begin_step(from.t, from.y)
    }

    /// Moves the work of the evaluations to `statistics`.
    pub fn count(&self, statistics: &mut Statistics) {
        let own = std::mem::take(&mut self.state.borrow_mut().problem.dynamics.statistics);
        *statistics = *statistics + own;
    }

    /// The failure of an evaluation since the last call.
    pub fn take_failure(&self) -> Option<StepError> {
        self.state.borrow_mut().failure.take()
    }

    fn evaluate(&self, t: f64, x: &[f64], out: &mut [f64]) {
        let EvaluationState { problem, rows, failure } = &mut *self.state.borrow_mut();
        let evaluated = match rows {
            Some(rows) => rows.evaluate(&mut problem.dynamics, t, x, out),
            None => problem.derivative(t, x, out),
        };
        // Newton's method does not converge to what is not a number, and the error of an explicit step is too large: diffsol
        // takes a smaller step. An error that is not a number would leave it without a step.
        if let Err(error) = evaluated {
            out.fill(if rows.is_some() { f64::NAN } else { REFUSED_RATE });
            *failure = Some(error);
        }
    }

    fn powers(&self, t: f64, x: &[f64], out: &mut [f64]) {
        let EvaluationState { problem, rows, .. } = &mut *self.state.borrow_mut();
        if let Some(rows) = rows {
            rows.powers(&mut problem.dynamics, t, x, out);
        }
    }

    fn operator(&self, value: Value) -> Operator<'_, 's> {
        Operator { equations: self, value }
    }

    fn jacobian(&self, t: f64, x: &[f64], values: &mut [f64]) {
        let EvaluationState { problem, rows, failure } = &mut *self.state.borrow_mut();
        values.fill(0.0);
        let mut places = self.places.iter();
        let add = |value: f64| {
            if let Some(&place) = places.next() {
                values[place] += value;
            }
        };
        let Some(rows) = rows else { return };
        if let Err(error) = rows.jacobian(&mut problem.dynamics, t, x, add) {
            values.fill(f64::NAN);
            *failure = Some(error);
        }
    }
}

/// The equations as any of the operators that diffsol asks for.
pub struct Operator<'e, 's> {
    equations: &'e Equations<'s>,
    value: Value,
}

/// The value of an operator.
enum Value {
    /// F.
    Rates,
    /// The powers whose integrals are the works beside x.
    Powers,
}

fn values(vector: &FaerVec<f64>) -> &[f64] {
    vector.inner().col_as_slice(0)
}

fn values_mut(vector: &mut FaerVec<f64>) -> &mut [f64] {
    vector.inner_mut().col_as_slice_mut(0)
}

impl Op for Equations<'_> {
    type T = f64;
    type V = FaerVec<f64>;
    type M = FaerSparseMat<f64>;
    type C = FaerContext;

    fn context(&self) -> &FaerContext {
        &self.context
    }

    fn nstates(&self) -> usize {
        self.len
    }

    /// Length of the integrals beside x, where there are any.
    fn nout(&self) -> usize {
        if self.works > 0 { self.works } else { self.len }
    }

    fn nparams(&self) -> usize {
        0
    }
}

impl Op for Operator<'_, '_> {
    type T = f64;
    type V = FaerVec<f64>;
    type M = FaerSparseMat<f64>;
    type C = FaerContext;

    fn context(&self) -> &FaerContext {
        &self.equations.context
    }

    fn nstates(&self) -> usize {
        self.equations.len
    }

    fn nout(&self) -> usize {
        match self.value {
            Value::Rates => self.equations.len,
            Value::Powers => self.equations.works,
        }
    }

    fn nparams(&self) -> usize {
        0
    }
}

impl NonLinearOp for Operator<'_, '_> {
    fn call_inplace(&self, x: &FaerVec<f64>, t: f64, out: &mut FaerVec<f64>) {
        match self.value {
            Value::Rates => self.equations.evaluate(t, values(x), values_mut(out)),
            Value::Powers => self.equations.powers(t, values(x), values_mut(out)),
        }
    }
}

/// dF/dx
impl NonLinearOpJacobian for Operator<'_, '_> {
    fn jac_mul_inplace(&self, x: &FaerVec<f64>, t: f64, v: &FaerVec<f64>, out: &mut FaerVec<f64>) {
        let mut jacobian = FaerSparseMat::new_from_sparsity(
            self.equations.len,
            self.equations.len,
            self.jacobian_sparsity(),
            *self.context(),
        );
        self.jacobian_inplace(x, t, &mut jacobian);
        jacobian.gemv(1.0, v, 0.0, out);
    }

    fn jacobian_inplace(&self, x: &FaerVec<f64>, t: f64, jacobian: &mut FaerSparseMat<f64>) {
        self.equations.jacobian(t, values(x), jacobian.inner_mut()[0].val_mut());
    }

    fn jacobian_sparsity(&self) -> Option<Sparsity> {
        Some(self.equations.pattern.clone())
    }
}

/// [I 0; 0 0]
impl LinearOp for Operator<'_, '_> {
    fn gemv_inplace(&self, x: &FaerVec<f64>, _: f64, beta: f64, out: &mut FaerVec<f64>) {
        let out = values_mut(out);
        out.iter_mut().for_each(|out| *out *= beta);
        out.iter_mut().zip(&values(x)[..self.equations.differential]).for_each(|(out, x)| *out += x);
    }

    fn matrix_inplace(&self, _: f64, matrix: &mut FaerSparseMat<f64>) {
        matrix.inner_mut()[0].val_mut().fill(1.0);
    }

    fn sparsity(&self) -> Option<Sparsity> {
        let diagonal: Vec<(usize, usize)> = (0..self.equations.differential).map(|i| (i, i)).collect();
        pattern(self.equations.len, &diagonal).map(|(pattern, _)| pattern)
    }
}

/// x at the start is part of the state that a solver is made from.
impl ConstantOp for Operator<'_, '_> {
    fn call_inplace(&self, _: f64, x: &mut FaerVec<f64>) {
        values_mut(x).fill(0.0);
    }
}

impl<'e, 's> OdeEquationsRef<'e> for Equations<'s> {
    type Rhs = Operator<'e, 's>;
    type Mass = Operator<'e, 's>;
    type Init = Operator<'e, 's>;
    type Root = UnitCallable<FaerSparseMat<f64>>;
    type Out = Operator<'e, 's>;
    type Reset = UnitCallable<FaerSparseMat<f64>>;
}

impl<'s> OdeEquations for Equations<'s> {
    fn rhs(&self) -> Operator<'_, 's> {
        self.operator(Value::Rates)
    }

    fn mass(&self) -> Option<Operator<'_, 's>> {
        (self.differential < self.len).then_some(self.operator(Value::Rates))
    }

    fn init(&self) -> Operator<'_, 's> {
        self.operator(Value::Rates)
    }

    fn out(&self) -> Option<Operator<'_, 's>> {
        (self.works > 0).then_some(self.operator(Value::Powers))
    }

    fn set_params(&mut self, _: &FaerVec<f64>) {}

    fn get_params(&self, _: &mut FaerVec<f64>) {}
}
