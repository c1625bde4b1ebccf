//! Builds a program operand by operand, with constant folding.

use super::operation::{One, Two};
use super::program::{Op, Program};
use crate::math::signal::Signal;
use std::sync::Arc;

/// The program so far. Operands are named by the index of their first operation.
#[derive(Default)]
pub(super) struct Builder {
    ops: Vec<Op>,
    signals: Vec<Arc<Signal>>,
}

impl Builder {
    /// Index at which the next operand will begin.
    pub fn here(&self) -> usize {
        self.ops.len()
    }

    pub fn push(&mut self, op: Op) {
        self.ops.push(op);
    }

    /// The value of the operand in `start..end` if it is constant.
    pub fn constant(&self, start: usize, end: usize) -> Option<f64> {
        match self.ops.get(start..end)? {
            [Op::Constant(value)] => Some(*value),
            _ => None,
        }
    }

    /// Applies `function` to the last operand, which begins at `start`.
    pub fn one(&mut self, function: One, start: usize) {
        match self.constant(start, self.here()) {
            Some(value) => self.replace(start, Op::Constant(function.apply(value))),
            None => self.push(Op::One(function)),
        }
    }

    /// Applies `function` to the last two operands, which begin at `left` and `right`.
    pub fn two(&mut self, function: Two, left: usize, right: usize) {
        match (self.constant(left, right), self.constant(right, self.here())) {
            (Some(a), Some(b)) => {
                // Constants take the path of whole exponents too, so that (-2)^3 is -8.
                let value = by_constant(function, b).map_or_else(|| function.apply(a, b), |one| one.apply(a));
                self.replace(left, Op::Constant(value));
            }
            (None, Some(b)) => match by_constant(function, b) {
                Some(one) => self.replace(right, Op::One(one)),
                None => self.push(Op::Two(function)),
            },
            (Some(a), None) => self.of_constant(function, a, left),
            (None, None) => self.push(Op::Two(function)),
        }
    }

    /// Applies `function` to the constant `a` at `left` and the operand after it.
    fn of_constant(&mut self, function: Two, a: f64, left: usize) {
        let ones: &[One] = match function {
            Two::Add => &[One::Plus(a)],
            Two::Mul => &[One::Times(a)],
            Two::Sub => &[One::Neg, One::Plus(a)],
            _ => return self.push(Op::Two(function)),
        };
        self.ops.remove(left);
        self.ops.extend(ones.iter().map(|one| Op::One(*one)));
    }

    /// Selects one of the last two operands, which begin at `yes` and `no`, by the one before them.
    pub fn select(&mut self, condition: usize, yes: usize, no: usize) {
        match self.constant(condition, yes) {
            Some(value) if !value.is_nan() => {
                let chosen = if value != 0.0 { yes..no } else { no..self.here() };
                self.ops.truncate(chosen.end);
                self.ops.drain(condition..chosen.start);
            }
            _ => self.push(Op::Select),
        }
    }

    /// Evaluates `signal` at the operand at `start`, and removes the operands from `end` on.
    pub fn signal(&mut self, signal: Arc<Signal>, start: usize, end: usize) {
        self.ops.truncate(end);
        match self.constant(start, end) {
            Some(x) => self.replace(start, Op::Constant(signal.apply(x))),
            None => {
                self.ops.push(Op::Signal(self.signals.len()));
                self.signals.push(signal);
            }
        }
    }

    /// The program; `None` if it needs too deep a stack.
    pub fn finish(self) -> Option<Program> {
        Program::new(self.ops, self.signals)
    }

    fn replace(&mut self, start: usize, op: Op) {
        self.ops.truncate(start);
        self.ops.push(op);
    }
}

/// `function` with the constant `b` as its right operand, if that is cheaper or more exact.
fn by_constant(function: Two, b: f64) -> Option<One> {
    match function {
        Two::Add => Some(One::Plus(b)),
        Two::Sub => Some(One::Plus(-b)),
        Two::Mul => Some(One::Times(b)),
        Two::Div => Some(One::Over(b)),
        Two::Pow if b == 0.5 => Some(One::Sqrt),
        Two::Pow if b.fract() == 0.0 && b.abs() <= f64::from(i32::MAX) => Some(One::Power(b as i32)),
        _ => None,
    }
}
