//! Adams methods of variable order and step.

mod coefficients;
mod rows;

use super::memory::{read, written};
use super::{
    Accepted, Control, Dense, Integrator, IntegratorEntry, Problem, Stability, Step, StepStart, Steps, Tightening,
    Tolerance,
};
use crate::formulation::StepError;
use crate::math::array::{Each, from_fn};
use crate::method_spec::OptionDoc;
use crate::tolerances;
use coefficients::{Coefficients, MOST, ROOM, error_constants};
use rows::{QUAD, Rows, plus, quad, store};
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// Error that a step of adams aims at. Unit: `[tolerated errors]`. Why: with 0.5 a third more steps are refused, with
/// 0.1 there are more of them.
const ADAMS_AIM: f64 = 0.25;

/// ```text
/// y~ = y + h sum_{i=1..k} g_i Phi*_i,   y_1 = y~ + h g_{k+1} (F(t_1, y~) - Phi~_1)
/// ```
///
/// with differences Phi*_i of y' at the last points, and Phi~_1 = sum Phi*_i the y' that they predict: the
/// Adams-Bashforth prediction of order k = 1 to 12, evaluated, corrected by the Adams-Moulton formula of order k + 1,
/// projected and evaluated again (PECE). k and h are chosen by the error of order k. Source: Shampine, Gordon, Computer
/// Solution of Ordinary Differential Equations, Freeman 1975, codes ODE and DEABM; Hairer, Norsett, Wanner, Solving
/// Ordinary Differential Equations I, III.5 and III.7; projected as in Eich, SIAM J. Numer. Anal. 30 (1993) 1467-1482,
/// which keeps the order.
///
/// Order k + 1 in q, v and lambda. Two evaluations a step, whatever the order: at equal errors as many as `dop853` at
/// four digits, little more than half at ten. A projection takes the factors of the prediction, which is off by the
/// error of the step. A start, and every change of the form of the equations, begins at order 1. Stiff modes limit the
/// step to |h lambda| of two, the limit of Heun's method, at order 1 and to less at higher orders. Interpolation by the
/// polynomial of the step, of order k + 1, which meets both ends.
pub const ENTRY: IntegratorEntry = IntegratorEntry {
    steps: Steps::Own,
    // At the order of least error that of the corrected solution is as large as that of the prediction, which is
    // tested, and errors of steps add up. Over motions that amplify none they were 50 times those of dop853.
    tightening: Tightening { factor: 0.003, power: 1.0, least: tolerances::TIGHTEST },
    options: &[OptionDoc { name: "order", about: "the highest order, 2 to 13 (default 13)" }],
    // That of the lowest orders, Heun's; it shrinks as the order rises.
    stability: Some(|| Stability::Polynomial(vec![1.0, 1.0, 0.5])),
    ends_near: true,
    begins_anew: true,
    ..IntegratorEntry::new(
        "adams",
        "Adams-Bashforth-Moulton, order up to 13 by itself, 2 evaluations a step; smooth motions, few events",
        MOST + 1,
        |setup| {
            let highest = setup.integrator.whole("order", MOST + 1, 2..=MOST + 1)?;
            Ok(Box::new(Adams::new(setup.len(), highest - 1)))
        },
    )
};

/// The method between two steps.
struct Adams {
    /// Order k of the next step, and the highest.
    order: usize,
    most: usize,
    /// Phi_i of the start of the step, i = 1 to `known`; none before the first step.
    differences: Rows,
    known: usize,
    /// Sums Phi~_i of Phi*_j over j = i to k, and then Phi*_{k+1}.
    predicted: Rows,
    /// Sizes of the steps before, the last one first.
    past: [f64; ROOM],
    /// The last attempt.
    tried: Tried,
    is_accepted: bool,
    /// True from a start on, as long as order and step can rise with every step.
    is_rising: bool,
    coefficients: Coefficients,
    constants: [f64; ROOM],
    control: Control,
    /// Size of the next step over that of the last attempt.
    ratio: f64,
    /// Inverses of the tolerated errors, zero where there are none.
    weights: Vec<f64>,
    /// y' at the prediction, then its difference to the predicted one.
    defect: Vec<f64>,
    /// State at the end of the step, and what the polynomial is off at its start.
    end: Vec<f64>,
    open: Vec<f64>,
}

/// What steps pass on, as it is saved.
#[derive(Serialize, Deserialize)]
struct AdamsMemory {
    order: usize,
    known: usize,
    past: [f64; ROOM],
    tried: Tried,
    is_accepted: bool,
    is_rising: bool,
    /// The sums of the last step; before its end, after a refusal, the differences at its start.
    rows: Vec<Vec<f64>>,
}

#[derive(Clone, Copy, Serialize, Deserialize)]
struct Tried {
    h: f64,
    order: usize,
    /// Order of the step after it.
    next: usize,
}

impl Adams {
    fn new(len: usize, most: usize) -> Self {
        let zeros = || vec![0.0; len];
        let mut control = Control::new(1.0, 0.2, 2.0);
        control.order = 2;
        Adams {
            order: 1,
            most,
            differences: Rows::new(len),
            known: 0,
            predicted: Rows::new(len),
            past: [0.0; ROOM],
            tried: Tried { h: 0.0, order: 1, next: 1 },
            is_accepted: false,
            is_rising: true,
            coefficients: Coefficients::NONE,
            constants: error_constants(),
            control,
            ratio: 1.0,
            weights: zeros(),
            defect: zeros(),
            end: zeros(),
            open: zeros(),
        }
    }

    /// Adds y' at the start of the step to the differences, if that is the end of the last one.
    fn extend(&mut self, slope: &[f64]) {
        if self.known == 0 {
            self.differences.set(0, slope);
            (self.known, self.order, self.is_rising) = (1, 1, true);
        }
        if !std::mem::take(&mut self.is_accepted) {
            return;
        }
        let Tried { h, order, next } = self.tried;
        std::mem::swap(&mut self.differences, &mut self.predicted);
        for (b, rows) in self.differences.blocks.iter_mut().enumerate() {
            let d = plus(quad(slope, b), -1.0, rows[0]);
            let (lower, higher) = rows.split_at_mut(order);
            lower.iter_mut().for_each(|row| *row = plus(*row, 1.0, d));
            if let [first, second, ..] = higher {
                (*first, *second) = (d, plus(d, -1.0, *first));
            }
        }
        self.known = if self.known > order { (order + 2).min(ROOM) } else { order + 1 };
        self.past.copy_within(..ROOM - 1, 1);
        self.past[0] = h;
        self.order = next;
    }

    /// y~, and the sums of the differences.
    fn predict(&mut self, from: StepStart, to: &mut [f64]) {
        let Adams { order, differences, known, predicted, coefficients, .. } = self;
        let k = *order;
        let beta = &coefficients.beta;
        let weights: [f64; ROOM] = from_fn(|i| from.h * coefficients.g[i]);
        for (b, (rows, sums)) in differences.blocks.iter().zip(&mut predicted.blocks).enumerate() {
            let mut y = quad(from.y, b);
            let mut sum = [0.0; QUAD];
            if *known > k {
                sums[k] = rows[k].each(|x| beta[k] * x);
            }
            for i in (0..k).rev() {
                let row = rows[i].each(|x| beta[i] * x);
                sum = plus(sum, 1.0, row);
                y = plus(y, weights[i], row);
                sums[i] = sum;
            }
            store(to, b, y);
        }
    }

    /// Corrects y~ by the difference of y' there, `defect`, to the predicted one, which is then in its place.
    fn correct(&mut self, h: f64, to: &mut [f64]) {
        let weight = h * self.coefficients.g[self.order];
        for (b, sums) in self.predicted.blocks.iter().enumerate() {
            let d = plus(quad(&self.defect, b), -1.0, sums[0]);
            store(&mut self.defect, b, d);
            store(to, b, plus(quad(to, b), weight, d));
        }
    }

    /// Inverses of the tolerated errors of a step, times those of the root of their number.
    fn weigh(&mut self, tolerance: &Tolerance, from: &[f64], to: &[f64]) {
        let n = tolerance.motion();
        let untested = tolerance.untested();
        let per = (tolerance.tested(n) as f64).sqrt().recip();
        for range in [0..untested.start, untested.end..n] {
            let from = &from[range.clone()];
            let to = &to[range.clone()];
            let weights = &mut self.weights[range];
            for (i, weight) in weights.iter_mut().enumerate() {
                *weight = per / tolerance.weight(from[i], to[i]);
            }
        }
    }

    /// Norms over the tolerated errors: of the defect, which is a difference of order k, and of those of the orders
    /// k - 1, k - 2 and k + 1.
    fn norms(&self) -> [f64; 4] {
        let k = self.order;
        let mut squares = [[0.0; QUAD]; 4];
        for (b, sums) in self.predicted.blocks.iter().enumerate() {
            let weight = quad(&self.weights, b);
            let d = quad(&self.defect, b);
            let one = plus(d, 1.0, sums[k - 1]);
            let two = plus(d, 1.0, sums[k.max(2) - 2]);
            for (squares, of_order) in squares.iter_mut().zip([d, one, two, plus(d, -1.0, sums[k])]) {
                *squares = from_fn(|i| squares[i] + (weight[i] * of_order[i]).powi(2));
            }
        }
        squares.each(|squares| squares.iter().sum::<f64>().sqrt())
    }

    /// Error of a formula of order `order` over the tolerated one, by a difference of that order and this norm.
    fn error_of(&self, order: usize, norm: f64) -> f64 {
        self.tried.h * self.coefficients.sigma[order] * self.constants[order] * norm
    }

    /// Chooses the order of the next step by the [norms](Self::norms), and returns the error of a step of that order:
    /// as long as it rises, each step raises it; then it falls where a lower order would have no larger error, and
    /// rises where the next one would have a smaller one.
    fn choose(&mut self, norms: [f64; 4]) -> f64 {
        let [own, one, two, raised] = norms;
        let k = self.order;
        let own = self.error_of(k, own);
        let one = if k > 1 { self.error_of(k - 1, one) } else { f64::INFINITY };
        let two = if k > 2 { self.error_of(k - 2, two) } else { 0.0 };
        let falls = if k == 2 { one <= 0.5 * own } else { one.max(two) <= own };
        self.is_rising &= !falls && k < self.most;
        let rises = self.known > k && k < self.most;
        let raised = if rises { self.error_of(k + 1, raised) } else { f64::INFINITY };
        let (next, error) = match () {
            _ if self.is_rising => (k + 1, 0.0),
            _ if falls || one <= own.min(raised) => (k - 1, one),
            _ if raised < if k == 1 { 0.5 * own } else { own } => (k + 1, raised),
            _ => (k, own),
        };
        self.tried.next = next;
        error
    }

    /// The polynomial of degree k + 1 through the end of the step, with y' there and at k points before it, `ahead`
    /// seconds after the end.
    fn follow(&self, ahead: f64, out: &mut [f64]) {
        let k = self.tried.order;
        let g = self.coefficients.interpolation(ahead, k + 1);
        let sum = ahead * g[..=k].iter().sum::<f64>();
        for (b, sums) in self.predicted.blocks.iter().enumerate() {
            let start = plus(quad(&self.end, b), sum, quad(&self.defect, b));
            let rows = g[..k].iter().zip(sums);
            store(out, b, rows.fold(start, |out, (weight, row)| plus(out, ahead * weight, *row)));
        }
    }

    /// Chooses the size of the next step over that of this one, so that its error `next` becomes a part of the
    /// tolerated one; it is as long as the last one unless it can be clearly longer.
    fn steer(&mut self, next: f64) {
        let power = |order: usize| 1.0 / (order as f64 + 1.0);
        self.control.exponent = power(self.order);
        self.control.safety = ADAMS_AIM.powf(self.control.exponent);
        let ratio = (ADAMS_AIM / next.max(1e-30)).powf(power(self.tried.next));
        // With 1.05 to 1.2 evaluations are the fewest, with 2, as in the code ODE, 5 % more.
        self.ratio = if (1.0..1.1).contains(&ratio) { 1.0 } else { ratio };
    }
}

impl Integrator for Adams {
    fn control(&mut self) -> &mut Control {
        &mut self.control
    }

    fn attempt(&mut self, problem: &mut Problem, from: StepStart, to: &mut [f64]) -> Result<Option<f64>, StepError> {
        let h = from.h;
        self.extend(from.slope);
        let k = self.order;
        self.tried = Tried { h, order: k, next: k };
        self.coefficients = Coefficients::new(h, &self.past, k + 1);
        self.predict(from, to);
        problem.derivative(from.end, to, &mut self.defect)?;
        self.correct(h, to);
        self.weigh(from.tolerance, from.y, to);
        let norms = self.norms();
        let error = h * (self.coefficients.g[k - 1] - self.coefficients.g[k]) * norms[0];
        let next = self.choose(norms);
        self.steer(next);
        Ok(Some(error))
    }

    fn accepted(&mut self, Accepted { h, growing, .. }: &Accepted) -> f64 {
        self.is_accepted = true;
        h * self.ratio.clamp(self.control.shrink, if *growing { self.control.grow } else { 1.0 })
    }

    fn restart(&mut self) {
        (self.known, self.is_accepted) = (0, false);
        self.order = 1;
    }

    fn memory(&self) -> Option<Value> {
        let Adams { order, known, past, tried, is_accepted, is_rising, .. } = *self;
        let (rows, count) = if is_accepted { (&self.predicted, tried.order + 1) } else { (&self.differences, known) };
        let rows = (0..count).map(|i| rows.row(i).collect()).collect();
        written(AdamsMemory { order, known, past, tried, is_accepted, is_rising, rows })
    }

    fn recall(&mut self, memory: &Value) {
        let Some(AdamsMemory { order, known, past, tried, is_accepted, is_rising, rows }) = read(memory) else {
            return;
        };
        self.order = order.clamp(1, self.most);
        self.known = known.min(ROOM);
        self.past = past;
        self.tried = Tried { order: tried.order.clamp(1, MOST), next: tried.next.clamp(1, self.most), ..tried };
        (self.is_accepted, self.is_rising) = (is_accepted, is_rising);
        let own = if is_accepted { &mut self.predicted } else { &mut self.differences };
        rows.iter().take(ROOM).enumerate().for_each(|(i, row)| own.set(i, row));
    }

    fn lower_order(&self, from: StepStart, out: &mut [f64]) -> bool {
        let h = from.h;
        // Of order k: y~ with g_k in the place of g_{k+1}.
        let k = self.tried.order;
        let g = &self.coefficients.g;
        for (b, sums) in self.predicted.blocks.iter().enumerate() {
            let mut y = quad(from.y, b);
            for i in 0..k {
                // Phi*_i from the sums over i and over i + 1.
                let above = if i + 1 < k { sums[i + 1] } else { [0.0; QUAD] };
                y = plus(y, h * g[i], plus(sums[i], -1.0, above));
            }
            store(out, b, plus(y, h * g[k - 1], quad(&self.defect, b)));
        }
        true
    }

    fn dense(&mut self) -> Option<&mut dyn Dense> {
        Some(self)
    }
}

impl Dense for Adams {
    /// At the start of the step the polynomial is off by the error of the step and by the projection, which is spread
    /// over the step.
    fn prepare(&mut self, _: &mut Problem, Step { from, to, slope }: Step) -> Result<(), StepError> {
        let h = from.h;
        self.end.copy_from_slice(to);
        if h != self.tried.h {
            // The step was cut on its dense output since the attempt.
            self.tried.h = h;
            self.coefficients = Coefficients::new(h, &self.past, self.tried.order + 1);
            let mut open = std::mem::take(&mut self.open);
            self.predict(from, &mut open);
            self.open = open;
        }
        let Adams { defect, predicted, .. } = self;
        defect.iter_mut().zip(slope).zip(predicted.row(0)).for_each(|((d, slope), sum)| *d = slope - sum);
        let mut open = std::mem::take(&mut self.open);
        self.follow(-h, &mut open);
        open.iter_mut().zip(from.y).for_each(|(open, y)| *open = y - *open);
        self.open = open;
        Ok(())
    }

    fn interpolate(&mut self, _: &mut Problem, step: Step, theta: f64, out: &mut [f64]) -> Result<(), StepError> {
        self.follow((theta - 1.0) * step.from.h, out);
        let part = (1.0 - theta).powi(2) * (1.0 + 2.0 * theta);
        out.iter_mut().zip(&self.open).for_each(|(out, open)| *out += part * open);
        Ok(())
    }
}
