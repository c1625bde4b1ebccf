//! The course of a quantity over the rows of a run.

use super::measure::Reduction;
use crate::analysis::Extremes;
use crate::math::expression::{Expression, ExpressionError, Parameters, Scope};
use crate::system::Column;
use crate::tolerances;

/// An expression over the columns of a trajectory, with all that its values gave so far.
pub struct Course {
    quantity: CourseQuantity,
    reduction: Reduction,
    /// The level or the time of the reduction; not a number without one.
    argument: f64,
    output_step: f64,
    extremes: Extremes,
    /// The last row.
    last: Option<(f64, f64)>,
    /// Integral over time, and the time it covers, s.
    integral: (f64, f64),
    /// Time above the level, s.
    above: f64,
    /// The first time at the level, s.
    reached: Option<f64>,
    /// The value at the time that the reduction names.
    at: Option<f64>,
}

enum CourseQuantity {
    /// The column at this index.
    Column(usize),
    Expression(Box<Expression>),
}

impl Course {
    /// # Errors
    /// An expression that cannot be read, or names what the trajectory does not have.
    pub fn new(
        reduction: &Reduction,
        text: &str,
        headings: &[&str],
        parameters: &Parameters,
        output_step: f64,
    ) -> Result<Self, ExpressionError> {
        let quantity = match headings.iter().position(|heading| *heading == text) {
            Some(column) => CourseQuantity::Column(column),
            None => {
                let scope = Scope { parameters, variables: headings };
                CourseQuantity::Expression(Box::new(Expression::parse(text, &scope)?))
            }
        };
        let argument = reduction.argument().map_or(Ok(f64::NAN), |number| number.evaluate(parameters))?;
        Ok(Course {
            quantity,
            reduction: reduction.clone(),
            argument,
            output_step,
            extremes: Extremes::of(&Column { name: String::new(), unit: String::new() }),
            last: None,
            integral: (0.0, 0.0),
            above: 0.0,
            reached: None,
            at: None,
        })
    }

    /// Returns the time at which a value is asked for, if one is.
    pub fn asked_time(&self) -> Option<f64> {
        matches!(self.reduction, Reduction::At(_)).then_some(self.argument)
    }

    /// True if it reads the column at this index.
    pub fn reads(&self, column: usize) -> bool {
        match &self.quantity {
            CourseQuantity::Column(own) => *own == column,
            CourseQuantity::Expression(expression) => expression.depends_on(column),
        }
    }

    /// Adds a row, whose first column is time.
    pub fn add(&mut self, row: &[f64]) {
        let t = row[0];
        let x = match &self.quantity {
            CourseQuantity::Column(column) => row[*column],
            CourseQuantity::Expression(expression) => expression.eval(row),
        };
        self.extremes.add(t, x);
        if let Some((before, from)) = self.last.filter(|(_, from)| from.is_finite() && x.is_finite()) {
            let h = t - before;
            self.integral.0 += 0.5 * h * (from + x);
            self.integral.1 += h;
            self.pass_level(before, h, from - self.argument, x - self.argument);
        }
        if self.at.is_none() && (t - self.argument).abs() <= tolerances::SIX_DIGITS * self.output_step {
            self.at = Some(x);
        }
        self.last = Some((t, x));
    }

    /// Adds an interval from `t` on, of duration `h`, where the quantity exceeds the level by `from` and `to` at the
    /// ends. It is linear between rows.
    fn pass_level(&mut self, t: f64, h: f64, from: f64, to: f64) {
        let passage = if from == to { 0.0 } else { h * from / (from - to) };
        if self.reached.is_none() && from * to <= 0.0 {
            self.reached = Some(t + passage);
        }
        self.above += match (from > 0.0, to > 0.0) {
            (true, true) => h,
            (true, false) => passage,
            (false, true) => h - passage,
            (false, false) => 0.0,
        };
    }

    /// Returns the number asked for; not a number where there is none.
    pub fn value(&self) -> f64 {
        let Extremes { min, max, t_min, t_max, rms, .. } = &self.extremes;
        let value = match self.reduction {
            Reduction::Final => self.last.map(|(_, x)| x),
            Reduction::Max => *max,
            Reduction::Min => *min,
            Reduction::TimeOfMax => *t_max,
            Reduction::TimeOfMin => *t_min,
            Reduction::Rms => *rms,
            Reduction::Mean => (self.integral.1 > 0.0).then(|| self.integral.0 / self.integral.1),
            Reduction::TimeOf(_) => self.reached,
            Reduction::Above(_) => Some(self.above),
            Reduction::At(_) => self.at,
        };
        value.unwrap_or(f64::NAN)
    }
}
