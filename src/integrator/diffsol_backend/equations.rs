//! The equations of a formulation as diffsol needs them.

use super::kinematics::Dense;
use super::rows::FirstOrderRows;
use crate::formulation::{Statistics, StepError};
use diffsol::{
    ConstantOp, LinearOp, Matrix, NalgebraContext, NalgebraMat, NalgebraVec, NonLinearOp, NonLinearOpJacobian,
    OdeEquations, OdeEquationsRef, Op, UnitCallable, Vector, VectorCommon,
};
use std::cell::RefCell;
use std::rc::Rc;

pub type Values = NalgebraVec<f64>;
type Entries = NalgebraMat<f64>;

/// diffsol calls with shared references and takes numbers only: the rows are behind a cell, and their error is kept
/// here, while the numbers are NaN, which makes diffsol try a smaller step. Clones share both.
#[derive(Clone)]
pub struct Equations<'s> {
    rows: Rc<RefCell<FirstOrderRows<'s>>>,
    halt: Rc<RefCell<Option<StepError>>>,
    /// Number of unknowns, and how many of them have a rate.
    pub len: usize,
    pub rates: usize,
    pub context: NalgebraContext,
}

impl<'s> Equations<'s> {
    pub fn new(rows: FirstOrderRows<'s>, rates: usize) -> Self {
        let len = rows.len();
        Equations {
            rows: Rc::new(RefCell::new(rows)),
            halt: Rc::default(),
            len,
            rates,
            context: NalgebraContext::default(),
        }
    }

    /// Calls `see` with the rows.
    pub fn with<R>(&self, see: impl FnOnce(&mut FirstOrderRows<'s>) -> R) -> R {
        see(&mut self.rows.borrow_mut())
    }

    /// The first error of the rows since the last call.
    pub fn take_halt(&self) -> Option<StepError> {
        self.halt.take()
    }

    /// The work done since the last call.
    pub fn take_statistics(&self) -> Statistics {
        self.with(|rows| std::mem::take(rows.statistics()))
    }

    fn fill(&self, values: &mut [f64], see: impl FnOnce(&mut FirstOrderRows<'s>, &mut [f64]) -> Result<(), StepError>) {
        if let Err(halt) = self.with(|rows| see(rows, values)) {
            values.fill(f64::NAN);
            // The first error is the cause: its NaN leads to others.
            self.halt.borrow_mut().get_or_insert(halt);
        }
    }
}

/// The right-hand side, the mass matrix and the initial values of the equations, in the form of diffsol's operators.
pub struct View<'r, 's>(&'r Equations<'s>);

impl NonLinearOp for View<'_, '_> {
    fn call_inplace(&self, x: &Values, t: f64, y: &mut Values) {
        let x = x.inner().as_slice();
        self.0.fill(y.inner_mut().as_mut_slice(), |rows, y| rows.evaluate(t, x, y));
    }
}

impl NonLinearOpJacobian for View<'_, '_> {
    fn jac_mul_inplace(&self, x: &Values, t: f64, v: &Values, y: &mut Values) {
        self.jacobian(x, t).gemv(1.0, v, 0.0, y);
    }

    fn jacobian_inplace(&self, x: &Values, t: f64, y: &mut Entries) {
        let (n, x) = (self.0.len, x.inner().as_slice());
        self.0.fill(y.inner_mut().as_mut_slice(), |rows, values| {
            values.fill(0.0);
            rows.jacobian(t, x, &mut Dense { n, values })
        });
    }
}

/// The mass matrix: ones for the unknowns that have a rate.
impl LinearOp for View<'_, '_> {
    fn gemv_inplace(&self, x: &Values, _t: f64, beta: f64, y: &mut Values) {
        let x = x.inner().as_slice();
        for (i, y) in y.inner_mut().as_mut_slice().iter_mut().enumerate() {
            *y = beta * *y + if i < self.0.rates { x[i] } else { 0.0 };
        }
    }
}

/// Not called: runs start from states of their own.
impl ConstantOp for View<'_, '_> {
    fn call_inplace(&self, _t: f64, y: &mut Values) {
        y.inner_mut().fill(0.0);
    }
}

impl<'r, 's> OdeEquationsRef<'r> for Equations<'s> {
    type Rhs = View<'r, 's>;
    type Mass = View<'r, 's>;
    type Init = View<'r, 's>;
    type Root = UnitCallable<Entries>;
    type Out = UnitCallable<Entries>;
    type Reset = UnitCallable<Entries>;
}

impl<'s> OdeEquations for Equations<'s> {
    fn rhs(&self) -> View<'_, 's> {
        View(self)
    }

    fn mass(&self) -> Option<View<'_, 's>> {
        (self.rates < self.len).then_some(View(self))
    }

    fn init(&self) -> View<'_, 's> {
        View(self)
    }

    fn set_params(&mut self, _: &Values) {}

    fn get_params(&self, _: &mut Values) {}
}

/// Sizes and types that diffsol requires of every operator.
macro_rules! operator {
    ($type:ty, $of:ident => $equations:expr) => {
        impl Op for $type {
            type T = f64;
            type V = Values;
            type M = Entries;
            type C = NalgebraContext;

            fn context(&self) -> &NalgebraContext {
                let $of = self;
                &$equations.context
            }

            fn nstates(&self) -> usize {
                let $of = self;
                $equations.len
            }

            fn nout(&self) -> usize {
                self.nstates()
            }

            fn nparams(&self) -> usize {
                0
            }
        }
    };
}

operator!(Equations<'_>, equations => equations);
operator!(View<'_, '_>, view => view.0);
