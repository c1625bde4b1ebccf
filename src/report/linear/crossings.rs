//! Values of a parameter at which eigenvalues meet or cross the imaginary axis, and their derivatives: as text, in files
//! and in figures.

use crate::error::{significant, two_digits};
use crate::linearize::{Sensitivity, Slope, Threshold, ThresholdKind};
use crate::plot::Figure;
use crate::report::sweep_figure::marked;
use crate::tolerances;

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
pub fn sensitivity_lines(name: &str, found: Option<&Sensitivity>) -> String {
    let Some(found) = found else { return String::new() };
    let one = |Slope { value, derivative, error }: &Slope| {
        let value = complex(value.re, value.im);
        match derivative {
            Some(slope) if slope.norm() <= *error => format!("    {value}: 0, to {}\n", two_digits(*error)),
            Some(slope) => {
                let is_doubtful = *error > tolerances::SIX_DIGITS * slope.norm();
                let doubt = if is_doubtful { format!(", right to {}", two_digits(*error)) } else { String::new() };
                format!("    {value}: {}{doubt}\n", complex(slope.re, slope.im))
            }
            None => format!("    {value}: none, the eigenvalue is defective or zero\n"),
        }
    };
    let lines: String = found.slopes.iter().take(6).map(one).collect();
    format!("  change of each eigenvalue per unit of {name} at {}, 1/s:\n{lines}", significant(found.at, 9))
}

/// A pair of numbers re +- im i; rounding of one part beside the other is none.
fn complex(re: f64, im: f64) -> String {
    let cleaned = |x: f64, other: f64| if x.abs() <= tolerances::SAME * other.abs() { 0.0 } else { x };
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

/// Adds a vertical line at each threshold to all panels.
pub fn with_thresholds(figure: Option<Figure>, thresholds: &[Threshold]) -> Option<Figure> {
    let mut figure = figure?;
    for panel in &mut figure.panels {
        for threshold in thresholds {
            *panel = marked(std::mem::take(panel), threshold.at, &significant(threshold.at, 6));
        }
    }
    Some(figure)
}
