//! Switching functions of an expression, and its parts that depend on time alone.

use super::Expression;
use super::operation::{One, Two};
use super::program::{Op, Program};
use crate::math::signal::Signal;
use crate::math::{Regime, Scalar, Thresholds};
use std::ops::Range;
use std::sync::Arc;

/// A part of an expression that depends on t alone.
#[derive(Clone, Debug, PartialEq)]
pub struct TimeFunction {
    program: Program,
    /// The number of its first switching function.
    first: usize,
}

impl TimeFunction {
    /// Value at time `t`, s, with the pieces of `regime`.
    pub fn at<S: Scalar>(&self, t: S, regime: Regime) -> S {
        self.program.eval_held(&[t], self.first, regime)
    }
}

/// A switching function of an expression or an element: its form changes where the argument passes one of
/// the thresholds.
#[derive(Clone, Debug, PartialEq)]
pub struct Switch {
    /// Arguments at which the form changes.
    pub thresholds: Thresholds,
    /// The argument, if it depends on t alone.
    pub of_time: Option<TimeFunction>,
    /// The signal that is evaluated at the argument, if it is one of an expression.
    pub signal: Option<Arc<Signal>>,
}

/// The operations of one intermediate result, and its dependence on time and state.
#[derive(Clone)]
struct Operand {
    range: Range<usize>,
    reads_time: bool,
    reads_state: bool,
}

impl Operand {
    fn is_of_time(&self) -> bool {
        self.reads_time && !self.reads_state
    }
}

impl Expression {
    /// Numbers its switching functions from `first` on, and returns them in the order of
    /// [`arguments`](Self::arguments). Variable 0 is t.
    pub fn number_switches(&mut self, first: usize) -> Vec<Switch> {
        self.first = first;
        let mut switches = Vec::new();
        self.walk(|program, op, operands, number| {
            if program.is_switch(op) {
                let of_time = operands.iter().any(|operand| operand.reads_time)
                    && operands.iter().all(|operand| !operand.reads_state);
                let of_time = of_time.then(|| program.argument(op, operands, first + number)).flatten();
                switches.push(Switch { thresholds: program.thresholds(op), of_time, signal: program.signal(op) });
            }
        });
        switches
    }

    /// The largest parts of it that depend on t alone, except t itself.
    pub fn time_functions(&self) -> Vec<TimeFunction> {
        let mut found = Vec::new();
        let mut keep = |program: &Program, operand: &Operand, is_divisor: bool| {
            let first = self.first + program.count_switches(operand.range.start);
            // A divisor is recorded by its inverse, which is small where the divisor is large.
            let inverse = is_divisor.then_some(Op::One(One::Power(-1)));
            let part = Program::new(
                program.ops[operand.range.clone()].iter().copied().chain(inverse).collect(),
                program.signals.clone(),
            );
            found.extend(part.map(|program| TimeFunction { program, first }));
        };
        let whole = self.walk(|program, op, operands, _| {
            if operands.iter().any(|operand| operand.reads_state) {
                for (place, operand) in operands.iter().enumerate().filter(|(_, operand)| operand.is_of_time()) {
                    keep(program, operand, op == Op::Two(Two::Div) && place == 1);
                }
            }
        });
        if let Some(whole) = whole.filter(Operand::is_of_time) {
            keep(&self.program, &whole, false);
        }
        found.retain(|function| function.program.ops.len() > 1);
        found
    }

    /// Calls `see` for every operation with its operands and the number of switching functions before it; returns the
    /// result's operand.
    fn walk(&self, mut see: impl FnMut(&Program, Op, &[Operand], usize)) -> Option<Operand> {
        let mut stack = Vec::<Operand>::new();
        let mut number = 0;
        for (place, &op) in self.program.ops.iter().enumerate() {
            let operands = stack.split_off(stack.len() - op.operands());
            see(&self.program, op, &operands, number);
            number += usize::from(self.program.is_switch(op));
            let start = operands.first().map_or(place, |operand| operand.range.start);
            let reads = |of: fn(&Operand) -> bool| operands.iter().any(of);
            stack.push(Operand {
                range: start..place + 1,
                reads_time: op == Op::Variable(0) || reads(|operand| operand.reads_time),
                reads_state: matches!(op, Op::Variable(1..)) || reads(|operand| operand.reads_state),
            });
        }
        stack.pop()
    }
}

impl Program {
    fn is_switch(&self, op: Op) -> bool {
        match op {
            Op::One(function) => function.is_piecewise(),
            Op::Two(function) => function.is_piecewise(),
            Op::Signal(_) => true,
            _ => false,
        }
    }

    fn thresholds(&self, op: Op) -> Thresholds {
        match op {
            Op::One(function) => function.thresholds(),
            Op::Two(function) => function.thresholds(),
            Op::Signal(index) => self.signals[index].thresholds().clone(),
            _ => Thresholds::At([].into()),
        }
    }

    fn signal(&self, op: Op) -> Option<Arc<Signal>> {
        if let Op::Signal(index) = op { self.signals.get(index).cloned() } else { None }
    }

    fn count_switches(&self, end: usize) -> usize {
        self.ops[..end].iter().filter(|op| self.is_switch(**op)).count()
    }

    /// The argument of a piecewise operation: its operand, or the difference or quotient of both.
    fn argument(&self, op: Op, operands: &[Operand], number: usize) -> Option<TimeFunction> {
        let range = operands.first()?.range.start..operands.last()?.range.end;
        let first = number - self.count_switches(range.end) + self.count_switches(range.start);
        let mut program = self.part(range)?;
        if let Op::Two(function) = op {
            let of_both = if function == Two::Mod { Two::Div } else { Two::Sub };
            program = Program::new([program.ops, vec![Op::Two(of_both)]].concat(), program.signals)?;
        }
        Some(TimeFunction { program, first })
    }

    /// A range of the operations as a separate program; it may leave several results on its stack.
    fn part(&self, range: Range<usize>) -> Option<Program> {
        Program::new(self.ops[range].to_vec(), self.signals.clone())
    }
}
