//! Values of a parameter at which eigenvalues meet or cross the imaginary axis, and their derivatives: as text, in files
//! and in figures.

use crate::error::{significant, two_digits};
use crate::linearize::{Sensitivity, Slope, Threshold, ThresholdKind};
use crate::plot::Figure;
use crate::report::sweep_figure::marked;
use crate::tolerances;
use serde::Serialize;

/// Derivatives of the eigenvalues at a value of the parameter.
#[derive(Clone, Debug, Serialize)]
pub struct SensitivityFile {
    pub at: f64,
    pub eigenvalues: Vec<SlopeFile>,
}

/// An eigenvalue with its derivative; none where it is defective or zero.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct SlopeFile {
    pub re: f64,
    pub im: f64,
    pub d_re: Option<f64>,
    pub d_im: Option<f64>,
    /// |error| of the derivative.
    pub error: Option<f64>,
}

impl SensitivityFile {
    pub fn new(found: &Sensitivity) -> Self {
        let slopes = found.slopes.iter().map(|Slope { value, derivative, error }| SlopeFile {
            re: value.re,
            im: value.im,
            d_re: derivative.map(|slope| slope.re),
            d_im: derivative.map(|slope| slope.im),
            error: derivative.map(|_| *error),
        });
        SensitivityFile { at: found.at, eigenvalues: slopes.collect() }
    }
}

/// Returns a line for each threshold.
pub fn threshold_lines(name: &str, thresholds: &[Threshold]) -> String {
    let line = |threshold: &Threshold| {
        let what = match threshold.kind {
            ThresholdKind::Coalescence => "two eigenvalues meet at",
            ThresholdKind::Crossing => "an eigenvalue crosses the imaginary axis at",
        };
        let [below, above] = threshold.growing;
        let growth = match above.cmp(&below) {
            std::cmp::Ordering::Greater => ", growth above",
            std::cmp::Ordering::Less => ", growth below",
            std::cmp::Ordering::Equal => "",
        };
        let value = complex(threshold.re, threshold.im);
        format!("  {} = {}: {what} {value} 1/s{growth}\n", name, significant(threshold.at, 11))
    };
    thresholds.iter().map(line).collect()
}

/// Returns the derivatives of the slowest eigenvalues.
pub fn sensitivity_lines(name: &str, found: Option<&SensitivityFile>) -> String {
    let Some(found) = found else { return String::new() };
    let one = |slope: &SlopeFile| {
        let value = complex(slope.re, slope.im);
        match (slope.d_re, slope.d_im, slope.error) {
            (Some(re), Some(im), Some(error)) if re.hypot(im) <= error => {
                format!("    {value}: 0, to {}\n", two_digits(error))
            }
            (Some(re), Some(im), Some(error)) => {
                let is_doubtful = error > tolerances::SIX_DIGITS * re.hypot(im);
                let doubt = if is_doubtful { format!(", right to {}", two_digits(error)) } else { String::new() };
                format!("    {value}: {}{doubt}\n", complex(re, im))
            }
            _ => format!("    {value}: none, the eigenvalue is defective or zero\n"),
        }
    };
    let lines: String = found.eigenvalues.iter().take(MOST_SLOPES).map(one).collect();
    format!("  change of each eigenvalue per unit of {name} at {}, 1/s:\n{lines}", significant(found.at, 9))
}

/// Largest number of derivatives in the text; the file has all.
const MOST_SLOPES: usize = 6;

/// Rounding of one part of a number beside the other is none.
fn cleaned(x: f64, other: f64) -> f64 {
    if x.abs() <= crate::tolerances::SAME * other.abs() { 0.0 } else { x }
}

/// A pair of numbers re +- im i.
fn complex(re: f64, im: f64) -> String {
    let im = cleaned(im, re);
    let re = cleaned(re, im);
    let sign = if im < 0.0 { "-+" } else { "+-" };
    let imaginary = || format!("{sign}{}i", significant(im.abs(), 6));
    match (re == 0.0, im == 0.0) {
        (_, true) => significant(re, 6),
        (true, false) => imaginary(),
        (false, false) => format!("{} {}", significant(re, 6), imaginary()),
    }
}

/// Significant digits of a threshold in figures; text and files have more.
const DRAWN_DIGITS: usize = 6;

/// Adds a vertical line at each threshold to all panels.
pub fn with_thresholds(figure: Option<Figure>, thresholds: &[Threshold]) -> Option<Figure> {
    let mut figure = figure?;
    for panel in &mut figure.panels {
        for threshold in thresholds {
            *panel = marked(std::mem::take(panel), threshold.at, &significant(threshold.at, DRAWN_DIGITS));
        }
    }
    Some(figure)
}
