//! Values of a parameter at which eigenvalues meet or cross the imaginary axis, and their derivatives: as text, in files
//! and in figures.

use crate::error::significant;
use crate::linearize::{Sensitivity, Threshold, ThresholdKind};
use crate::plot::Figure;
use crate::report::sweep_figure::marked;
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
}

impl SensitivityFile {
    pub fn new(found: &Sensitivity) -> Self {
        let slopes = found.slopes.iter().map(|(value, slope)| SlopeFile {
            re: value.re,
            im: value.im,
            d_re: slope.map(|slope| slope.re),
            d_im: slope.map(|slope| slope.im),
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
        let value = complex(threshold.re, threshold.im, "+-");
        format!("  {} = {}: {what} {value} 1/s{growth}\n", name, significant(threshold.at, 11))
    };
    thresholds.iter().map(line).collect()
}

/// Returns the derivatives of the slowest eigenvalues.
pub fn sensitivity_lines(name: &str, found: Option<&SensitivityFile>) -> String {
    let Some(found) = found else { return String::new() };
    let one = |slope: &SlopeFile| {
        let value = complex(slope.re, slope.im, "+-");
        match (slope.d_re, slope.d_im) {
            (Some(re), Some(im)) => format!("    {value}: {}\n", complex(cleaned(re, im), cleaned(im, re), "+-")),
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

fn complex(re: f64, im: f64, sign: &str) -> String {
    let re = cleaned(re, im);
    let imaginary = || format!("{sign}{}i", significant(im, 6));
    match (re == 0.0, im == 0.0) {
        (_, true) => significant(re, 6),
        (true, false) => imaginary(),
        (false, false) => format!("{} {}", significant(re, 6), imaginary()),
    }
}

/// Adds a vertical line at each threshold to all panels.
pub fn with_thresholds(figure: Option<Figure>, thresholds: &[Threshold]) -> Option<Figure> {
    let mut figure = figure?;
    for panel in &mut figure.panels {
        for threshold in thresholds {
            *panel = marked(std::mem::take(panel), threshold.at, &significant(threshold.at, 11));
        }
    }
    Some(figure)
}
