//! The frequency response of one output to one input.

use super::phase::phases;
use crate::linearize::Complex;

/// Response of an output to an input, at each frequency.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Response {
    pub input: String,
    pub output: String,
    pub input_unit: String,
    pub output_unit: String,
    /// Values, in output unit per input unit.
    pub values: Vec<Complex<f64>>,
}

impl Response {
    /// True if the output does not depend on the input, to round-off.
    pub(super) fn is_zero(&self) -> bool {
        self.values.iter().all(|value| *value == Complex::ZERO)
    }

    /// Both names, as in `theta / motor`.
    pub(super) fn pair(&self) -> String {
        format!("{} / {}", self.output, self.input)
    }

    /// Unit of the output per unit of the input.
    pub(super) fn unit(&self) -> String {
        let words = [&self.output_unit, &self.input_unit];
        match words.map(|unit| unit.trim()) {
            ["", ""] => String::new(),
            ["", input] if input.contains(' ') => format!("1/({input})"),
            ["", input] => format!("1/{input}"),
            [output, ""] => output.to_string(),
            [output, input] if input.contains(' ') => format!("{output}/({input})"),
            [output, input] => format!("{output}/{input}"),
        }
    }

    /// Real part, imaginary part, magnitude and phase in degrees at each frequency; none at a pole.
    pub(super) fn parts(&self, frequencies: &[f64]) -> [Vec<Option<f64>>; 4] {
        let each = |part: fn(&Complex<f64>) -> f64| -> Vec<Option<f64>> {
            self.values.iter().map(|x| Some(x).filter(|x| is_finite(x)).map(part)).collect()
        };
        let phases = phases(frequencies, &self.values);
        let phases = phases.into_iter().map(|phase| Some(phase).filter(|phase| phase.is_finite())).collect();
        [each(|x| x.re), each(|x| x.im), each(|x| x.norm()), phases]
    }
}

/// True if there is a response, not a pole.
pub(super) fn is_finite(value: &Complex<f64>) -> bool {
    value.re.is_finite() && value.im.is_finite()
}
