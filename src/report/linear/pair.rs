//! The frequency response of one output to one input.

use crate::linearize::Complex;

/// Response of an output to an input, at each frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct Response {
    /// Name of the input.
    pub input: String,
    /// Name of the output.
    pub output: String,
    /// Unit of the input.
    pub input_unit: String,
    /// Unit of the output.
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
}
