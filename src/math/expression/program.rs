//! The flat form of an expression: operations on a stack whose depth is known before the program runs.

use super::operation::{One, Two};
use crate::math::signal::Signal;
use crate::math::{Piece, Regime, Scalar};
use std::sync::Arc;

/// Largest depth of the stack.
pub(super) const MAX_STACK: usize = 64;

/// Programs up to this depth, which are nearly all, run on a smaller stack that costs less to initialize.
const SHALLOW: usize = 6;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Op {
    Constant(f64),
    Variable(usize),
    One(One),
    Two(Two),
    /// Replaces condition, a and b by a if the condition is not zero, and by b otherwise.
    Select,
    /// Evaluates the signal of this number at the top of the stack.
    Signal(usize),
}

/// Operations in postfix order with the signals they use; made by a [`Builder`](super::builder::Builder).
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Program {
    pub ops: Vec<Op>,
    pub signals: Vec<Arc<Signal>>,
    depth: usize,
}

impl Op {
    /// Number of operands that it takes off the stack; it pushes one result.
    #[inline]
    pub fn operands(self) -> usize {
        match self {
            Op::Constant(_) | Op::Variable(_) => 0,
            Op::One(_) | Op::Signal(_) => 1,
            Op::Two(_) => 2,
            Op::Select => 3,
        }
    }
}

impl Program {
    /// A program of these operations; `None` if they need more than [`MAX_STACK`] numbers at once.
    pub fn new(ops: Vec<Op>, signals: Vec<Arc<Signal>>) -> Option<Self> {
        let heights = ops.iter().scan(0, |height: &mut usize, op| {
            *height = *height + 1 - op.operands();
            Some(*height)
        });
        let depth = heights.max().unwrap_or(0);
        (depth <= MAX_STACK).then_some(Program { ops, signals, depth })
    }

    pub fn constant(value: f64) -> Self {
        Program { ops: vec![Op::Constant(value)], signals: Vec::new(), depth: 1 }
    }

    /// The value with every operation on the piece of its argument.
    #[inline]
    pub fn eval<S: Scalar>(&self, variables: &[S]) -> S {
        self.run::<S, true>(variables, &mut |_, own, _| own)
    }

    /// The value with every piecewise operation on its piece of `regime`, where the program's switching functions are
    /// numbered from `first` on. If the value is then not finite, as for a root extended to negative numbers, the
    /// pieces are those of the arguments.
    pub fn eval_held<S: Scalar>(&self, variables: &[S], first: usize, regime: Regime) -> S {
        let held = self.run::<S, false>(variables, &mut |number, own, _| regime.piece(first + number).unwrap_or(own));
        if held.value().is_finite() { held } else { self.eval(variables) }
    }

    /// Writes the arguments of its switching functions, evaluated with the pieces of `regime`.
    pub fn arguments<S: Scalar>(&self, variables: &[S], first: usize, regime: Regime, out: &mut [S]) {
        self.run::<S, false>(variables, &mut |number, own, argument| {
            out[number] = argument;
            regime.piece(first + number).unwrap_or(own)
        });
    }

    /// Runs the program. `choose` gives the piece of each piecewise operation from its number, the piece of its
    /// argument, and the argument; with `OWN` it is not called, and every piece is that of the argument.
    #[inline]
    fn run<S: Scalar, const OWN: bool>(&self, variables: &[S], choose: &mut impl FnMut(usize, Piece, S) -> Piece) -> S {
        if self.depth <= SHALLOW {
            self.run_on::<S, SHALLOW, OWN>(variables, choose)
        } else {
            self.run_on::<S, MAX_STACK, OWN>(variables, choose)
        }
    }

    #[inline]
    fn run_on<S: Scalar, const N: usize, const OWN: bool>(
        &self,
        variables: &[S],
        choose: &mut impl FnMut(usize, Piece, S) -> Piece,
    ) -> S {
        let mut stack = [S::zero(); N];
        // Index of the top of the stack plus one, and the number of the next switching function.
        let mut height = 0_usize;
        let mut number = 0_usize;
        let mut chosen = |own: Option<Piece>, argument: S| {
            number += 1;
            own.map(|own| choose(number - 1, own, argument))
        };
        for op in &self.ops {
            height = height + 1 - op.operands();
            let top = height - 1;
            stack[top] = match *op {
                Op::Constant(value) => S::constant(value),
                Op::Variable(index) => variables[index],
                Op::One(function) if OWN || !function.is_piecewise() => function.apply(stack[top]),
                Op::Two(function) if OWN || !function.is_piecewise() => function.apply(stack[top], stack[height]),
                Op::Signal(index) if OWN => self.signals[index].apply(stack[top]),
                Op::One(function) => {
                    let x = stack[top];
                    chosen(function.piece(x.value()), x).map_or(S::constant(f64::NAN), |piece| function.on(piece, x))
                }
                Op::Two(function) => {
                    let x = stack[top];
                    let y = stack[height];
                    let piece = chosen(function.piece(x, y), function.argument(x, y));
                    piece.map_or(S::constant(f64::NAN), |piece| function.on(piece, x, y))
                }
                Op::Signal(index) => {
                    let x = stack[top];
                    let signal = &self.signals[index];
                    chosen(signal.piece(x.value()), x).map_or(x, |piece| signal.on(piece, x))
                }
                Op::Select => select(stack[top], stack[height], stack[height + 1]),
            };
        }
        stack[0]
    }
}

#[inline]
fn select<S: Scalar>(condition: S, yes: S, no: S) -> S {
    match condition.value() {
        0.0 => no,
        v if v.is_nan() => S::constant(v),
        _ => yes,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn deep_and_shallow_programs_agree() {
        for depth in [1, SHALLOW, SHALLOW + 1, MAX_STACK] {
            let mut ops = vec![Op::Variable(0); depth];
            ops.resize(2 * depth - 1, Op::Two(Two::Add));
            let program = Program::new(ops, Vec::new()).unwrap();
            assert_eq!(program.eval(&[1.5]), 1.5 * depth as f64);
        }
        assert!(Program::new(vec![Op::Variable(0); MAX_STACK + 1], Vec::new()).is_none());
    }
}
