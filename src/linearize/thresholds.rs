//! Values of a parameter at which eigenvalues meet or cross the imaginary axis.

use super::found::StateResult;
use super::{Complex, Kind, Mode};
use crate::error::Result;
use crate::tolerances;

/// Part of a step of the parameter up to which a threshold is bracketed before its root is sought. Unit: `[1]`. Why:
/// the function whose root it is is straight there. Test: `thresholds_are_located`.
const BRACKET: f64 = 1e-5;

/// Errors of an eigenvalue within which it is on the imaginary axis. Unit: `[1]`. Why: errors are known to first order.
/// Test: `thresholds_are_located`.
const AXIS_ERRORS: f64 = 10.0;

/// A value of the parameter at which eigenvalues meet or cross the imaginary axis.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Threshold {
    /// Value of the parameter.
    pub at: f64,
    /// What happens there.
    pub kind: ThresholdKind,
    /// Real part of the eigenvalue there, 1/s.
    pub re: f64,
    /// Imaginary part, rad/s, at least 0.
    pub im: f64,
    /// Number of growing modes below the value and above it.
    pub growing: [usize; 2],
}

/// What happens at a threshold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ThresholdKind {
    /// Two eigenvalues meet, and a pair becomes real or two imaginary ones leave the axis.
    Coalescence,
    /// An eigenvalue, or a pair, crosses the imaginary axis.
    Crossing,
}

/// Numbers that change only at a threshold.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Signature {
    /// Real eigenvalues.
    real: usize,
    /// Eigenvalues with a real part above zero.
    growing: usize,
}

/// Returns the thresholds between two values of the parameter at which the numbers of real and of growing eigenvalues
/// differ; `model` gives the eigenvalues at another value, near a known state.
pub(super) fn between(
    low: &StateResult,
    high: &StateResult,
    model: &impl Fn(&StateResult, f64) -> Result<StateResult>,
) -> Vec<Threshold> {
    let mut found = Vec::new();
    let mut start = low.clone();
    // Each costs some 30 models.
    while signature(&start) != signature(high) && found.len() < 8 {
        let Some((below, above)) = bracket(&start, high, model) else { break };
        found.extend(locate(&below, &above, model));
        start = above;
    }
    found
}

/// Bisects up to a small part of the step: where a pair leaves the axis its real part is the root of the distance.
fn bracket(
    low: &StateResult,
    high: &StateResult,
    model: &impl Fn(&StateResult, f64) -> Result<StateResult>,
) -> Option<(StateResult, StateResult)> {
    let goal = BRACKET * (high.sample.at - low.sample.at).abs();
    let mut below = low.clone();
    let mut above = high.clone();
    while (above.sample.at - below.sample.at).abs() > goal {
        let middle = model(&below, 0.5 * (below.sample.at + above.sample.at)).ok()?;
        if signature(&middle) == signature(&below) { below = middle } else { above = middle }
    }
    Some((below, above))
}

/// Finds the root of what vanishes at the threshold: the real part of an eigenvalue that crosses, or the square of the
/// difference of two that meet, which is analytic there.
fn locate(
    below: &StateResult,
    above: &StateResult,
    model: &impl Fn(&StateResult, f64) -> Result<StateResult>,
) -> Option<Threshold> {
    let counts = [signature(below), signature(above)];
    let rank = counts[0].growing.min(counts[1].growing);
    let stable = if counts[0].growing <= counts[1].growing { below } else { above };
    let unstable = if counts[0].growing <= counts[1].growing { above } else { below };
    let last = by_growth(stable).into_iter().nth(rank)?;
    let is_crossing = counts[0].real == counts[1].real && !is_on_axis(last);
    let complex = if counts[0].real < counts[1].real { below } else { above };
    let center = if counts[0].real == counts[1].real {
        by_growth(unstable).into_iter().nth(rank).map(|mode| Complex::new(0.0, mode.value.im.abs()))
    } else {
        let pairs = moving(complex).filter(|mode| mode.value.im > 0.0);
        pairs.min_by(|a, b| a.value.im.total_cmp(&b.value.im)).map(|mode| Complex::new(mode.value.re, 0.0))
    }?;
    let value = |found: &StateResult| -> Option<(f64, Complex<f64>)> {
        if is_crossing {
            by_growth(found).into_iter().nth(rank).map(|mode| (mode.value.re, mode.value))
        } else {
            let [a, b] = nearest(found, center)?;
            Some((((a - b) * (a - b)).re, (a + b) * 0.5))
        }
    };
    let (at, value) = root(below, above, value, model)?;
    let kind = if is_crossing { ThresholdKind::Crossing } else { ThresholdKind::Coalescence };
    let clean = |x: f64| if x.abs() <= tolerances::EIGENVALUES_AGREE * value.norm() { 0.0 } else { x };
    let growing = [growing_modes(below), growing_modes(above)];
    let re = if is_crossing { 0.0 } else { clean(value.re) };
    Some(Threshold { at, kind, re, im: clean(value.im).abs(), growing })
}

/// Returns the number of growing modes. A mode is a pair or a real eigenvalue.
fn growing_modes(found: &StateResult) -> usize {
    let upper = moving(found).filter(|mode| mode.value.im >= 0.0);
    upper.filter(|mode| grows(mode)).count()
}

/// The root of a value between two states by the Illinois variant of the regula falsi (Dowell, Jarratt, BIT 11 (1971)
/// 168-174), with the eigenvalue there.
fn root(
    below: &StateResult,
    above: &StateResult,
    value: impl Fn(&StateResult) -> Option<(f64, Complex<f64>)>,
    model: &impl Fn(&StateResult, f64) -> Result<StateResult>,
) -> Option<(f64, Complex<f64>)> {
    let mut low = (below.sample.at, value(below)?.0);
    let mut high = (above.sample.at, value(above)?.0);
    let (_, mut eigenvalue) = value(above)?;
    let mut at = 0.5 * (low.0 + high.0);
    if low.1 * high.1 > 0.0 {
        return Some((at, eigenvalue));
    }
    // A straight function takes three.
    for _ in 0..30 {
        at = (low.0 * high.1 - high.0 * low.1) / (high.1 - low.1);
        let is_inside = (at - low.0) * (at - high.0) < 0.0;
        if !is_inside || (high.0 - low.0).abs() <= tolerances::ROUND_OFF_OF_SUMS * at.abs() {
            break;
        }
        let Some((here, there)) = model(below, at).ok().as_ref().and_then(&value) else { break };
        eigenvalue = there;
        if here == 0.0 {
            break;
        }
        if here * high.1 < 0.0 {
            low = high
        } else {
            low.1 *= 0.5
        }
        high = (at, here);
    }
    at.is_finite().then_some((at, eigenvalue))
}

/// The physical modes that are not zero.
fn moving(found: &StateResult) -> impl Iterator<Item = &Mode> {
    found.sample.modes.iter().filter(|mode| mode.kind == Kind::Physical && !mode.is_zero())
}

fn is_on_axis(mode: &Mode) -> bool {
    mode.value.re.abs() <= AXIS_ERRORS * mode.error + tolerances::SAME * mode.value.norm()
}

fn grows(mode: &Mode) -> bool {
    mode.value.re > 0.0 && !is_on_axis(mode)
}

fn signature(found: &StateResult) -> Signature {
    let real = moving(found).filter(|mode| mode.value.im == 0.0).count();
    Signature { real, growing: moving(found).filter(|mode| grows(mode)).count() }
}

/// The modes from the largest real part.
fn by_growth(found: &StateResult) -> Vec<&Mode> {
    let mut modes: Vec<&Mode> = moving(found).collect();
    modes.sort_by(|a, b| b.value.re.total_cmp(&a.value.re));
    modes
}

/// The two eigenvalues nearest to a value.
fn nearest(found: &StateResult, center: Complex<f64>) -> Option<[Complex<f64>; 2]> {
    let mut values: Vec<Complex<f64>> = moving(found).map(|mode| mode.value).collect();
    values.sort_by(|a, b| (a - center).norm().total_cmp(&(b - center).norm()));
    Some([*values.first()?, *values.get(1)?])
}
