//! The flat form of an expression: operations on a stack whose depth is known before the program runs.

use super::operation::{One, Two};
use crate::math::{Piece, Regime, Scalar, piece_of};

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
    /// Evaluates the table of this number at the top of the stack.
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
    /// Number of operands that it takes off the stack; it pushes one result.
    #[inline]
    pub fn operands(self) -> usize {
        match self {
            Op::Constant(_) | Op::Variable(_) => 0,
            Op::One(_) | Op::Table(_) => 1,
            Op::Two(_) => 2,
            Op::Select => 3,
        }
    }
}

impl Table {
    /// A table through these points; `None` unless x increases strictly and all slopes are finite.
    pub fn new(points: &[[f64; 2]]) -> Option<Self> {
        let slopes = points.windows(2).map(|pair| (pair[1][1] - pair[0][1]) / (pair[1][0] - pair[0][0]));
        let rows: Vec<[f64; 3]> =
            points.iter().zip(slopes.chain([0.0])).map(|(p, slope)| [p[0], p[1], slope]).collect();
        let sound = rows.windows(2).all(|pair| pair[0][0] < pair[1][0]) && rows.iter().flatten().all(|v| v.is_finite());
        (rows.len() >= 2 && sound).then_some(Table { rows })
    }

    /// The x of its points, where its slope changes.
    pub fn thresholds(&self) -> Vec<f64> {
        self.rows.iter().map(|row| row[0]).collect()
    }

    fn piece(&self, x: f64) -> Option<Piece> {
        piece_of(x, self.rows.len(), |k| self.rows[k][0])
    }

    /// Value on the line of a piece. At a point the slope is that of the line to its right.
    #[inline]
    fn on<S: Scalar>(&self, piece: Piece, x: S) -> S {
        let after = piece.div_ceil(2) as usize;
        match (after, &self.rows[after.saturating_sub(1)]) {
            (0, [_, y, _]) => S::constant(*y),
            (n, [_, y, _]) if n == self.rows.len() => S::constant(*y),
            (_, [x0, y0, slope]) => (x - *x0) * *slope + *y0,
        }
    }

    pub fn apply<S: Scalar>(&self, x: S) -> S {
        self.piece(x.value()).map_or(x, |piece| self.on(piece, x))
    }
}

impl Program {
    /// A program of these operations; `None` if they need more than [`MAX_STACK`] numbers at once.
    pub fn new(ops: Vec<Op>, tables: Vec<Table>) -> Option<Self> {
        let heights = ops.iter().scan(0, |height: &mut usize, op| {
            *height = *height + 1 - op.operands();
            Some(*height)
        });
        let depth = heights.max().unwrap_or(0);
        (depth <= MAX_STACK).then_some(Program { ops, tables, depth })
    }

    pub fn constant(value: f64) -> Self {
        Program { ops: vec![Op::Constant(value)], tables: Vec::new(), depth: 1 }
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
        match self.depth <= SHALLOW {
            true => self.run_on::<S, SHALLOW, OWN>(variables, choose),
            false => self.run_on::<S, MAX_STACK, OWN>(variables, choose),
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
        let (mut height, mut number) = (0_usize, 0_usize);
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
                Op::Table(index) if OWN => self.tables[index].apply(stack[top]),
                Op::One(function) => {
                    let x = stack[top];
                    chosen(function.piece(x.value()), x).map_or(S::constant(f64::NAN), |piece| function.on(piece, x))
                }
                Op::Two(function) => {
                    let (x, y) = (stack[top], stack[height]);
                    let piece = chosen(function.piece(x, y), function.argument(x, y));
                    piece.map_or(S::constant(f64::NAN), |piece| function.on(piece, x, y))
                }
                Op::Table(index) => {
                    let (x, table) = (stack[top], &self.tables[index]);
                    chosen(table.piece(x.value()), x).map_or(x, |piece| table.on(piece, x))
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
