//! The flat form of an expression: operations on a stack whose depth is known before the program runs.

use super::operation::{One, Two};
use crate::math::Scalar;

/// Numbers that a program may have to hold at once.
pub(super) const MAX_STACK: usize = 64;

/// Programs this shallow, which are nearly all, run on a stack that costs less to lay out.
const SHALLOW: usize = 6;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Op {
    Constant(f64),
    Variable(usize),
    One(One),
    Two(Two),
    /// Of condition, a and b leaves a where the condition is not zero, and b otherwise.
    Select,
    /// Looks the top of the stack up in the table of this number.
    Table(usize),
}

/// A piecewise linear function, constant before its first and after its last point.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Table {
    /// x and y of a point, and the slope to the next one.
    rows: Vec<[f64; 3]>,
}

/// Operations in postfix order with the tables they use; made by a [`Builder`](super::builder::Builder).
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Program {
    pub ops: Vec<Op>,
    pub tables: Vec<Table>,
    depth: usize,
}

impl Op {
    /// How many numbers more the stack holds afterwards.
    fn growth(self) -> isize {
        match self {
            Op::Constant(_) | Op::Variable(_) => 1,
            Op::One(_) | Op::Table(_) => 0,
            Op::Two(_) => -1,
            Op::Select => -2,
        }
    }
}

impl Table {
    /// `None` unless x increases strictly and all slopes are finite.
    pub fn new(points: &[[f64; 2]]) -> Option<Self> {
        let slopes = points.windows(2).map(|pair| (pair[1][1] - pair[0][1]) / (pair[1][0] - pair[0][0]));
        let rows: Vec<[f64; 3]> =
            points.iter().zip(slopes.chain([0.0])).map(|(p, slope)| [p[0], p[1], slope]).collect();
        let sound = rows.windows(2).all(|pair| pair[0][0] < pair[1][0]) && rows.iter().flatten().all(|v| v.is_finite());
        (rows.len() >= 2 && sound).then_some(Table { rows })
    }

    /// At a point itself the slope is that of the piece which begins there.
    #[inline]
    pub fn apply<S: Scalar>(&self, x: S) -> S {
        let after = self.rows.partition_point(|row| row[0] <= x.value());
        match (after, &self.rows[after.saturating_sub(1)]) {
            _ if x.value().is_nan() => x,
            (0, [_, y, _]) => S::constant(*y),
            (n, [_, y, _]) if n == self.rows.len() => S::constant(*y),
            (_, [x0, y0, slope]) => (x - *x0) * *slope + *y0,
        }
    }
}

impl Program {
    /// `None` if the operations would need more than [`MAX_STACK`] numbers.
    pub fn new(ops: Vec<Op>, tables: Vec<Table>) -> Option<Self> {
        let heights = ops.iter().scan(0, |height: &mut isize, op| {
            *height += op.growth();
            Some(*height)
        });
        let depth = heights.max().unwrap_or(0).unsigned_abs();
        (depth <= MAX_STACK).then_some(Program { ops, tables, depth })
    }

    pub fn constant(value: f64) -> Self {
        Program { ops: vec![Op::Constant(value)], tables: Vec::new(), depth: 1 }
    }

    #[inline]
    pub fn eval<S: Scalar>(&self, variables: &[S]) -> S {
        if self.depth <= SHALLOW { self.run::<S, SHALLOW>(variables) } else { self.run::<S, MAX_STACK>(variables) }
    }

    fn run<S: Scalar, const N: usize>(&self, variables: &[S]) -> S {
        let mut stack = [S::zero(); N];
        // Index of the top of the stack plus one.
        let mut height = 0_usize;
        for op in &self.ops {
            height = height.wrapping_add_signed(op.growth());
            let top = height - 1;
            match *op {
                Op::Constant(value) => stack[top] = S::constant(value),
                Op::Variable(index) => stack[top] = variables[index],
                Op::One(function) => stack[top] = function.apply(stack[top]),
                Op::Two(function) => stack[top] = function.apply(stack[top], stack[height]),
                Op::Table(index) => stack[top] = self.tables[index].apply(stack[top]),
                Op::Select => stack[top] = select(stack[top], stack[height], stack[height + 1]),
            }
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
    use crate::math::Taylor;

    #[test]
    fn a_table_is_linear_between_its_points_and_constant_outside() {
        let table = Table::new(&[[0.0, 1.0], [2.0, 5.0], [3.0, 4.0]]).unwrap();
        let expected =
            [(-1.0, 1.0, 0.0), (0.0, 1.0, 2.0), (1.0, 3.0, 2.0), (2.0, 5.0, -1.0), (3.0, 4.0, 0.0), (9.0, 4.0, 0.0)];
        for (t, x, d) in expected {
            assert_eq!(table.apply(Taylor::time(t)), Taylor::new(x, d, 0.0), "at {t}");
        }
        assert!(table.apply(f64::NAN).is_nan());
    }

    #[test]
    fn a_table_needs_increasing_points_and_finite_slopes() {
        assert!(Table::new(&[]).is_none() && Table::new(&[[0.0, 1.0]]).is_none());
        assert!(Table::new(&[[0.0, 1.0], [0.0, 2.0]]).is_none());
        assert!(Table::new(&[[0.0, -1e308], [1.0, 1e308]]).is_none());
        assert!(Table::new(&[[f64::NAN, 1.0], [0.0, 2.0]]).is_none());
    }

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
