//! The frequency response of one output to one input.

use crate::linearize::Complex;
use crate::tolerances::report as tolerances;
use serde::Serialize;

/// Response of an output to an input, at each frequency.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
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
    #[serde(skip)]
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
    pub(super) fn parts(&self) -> [Vec<Option<f64>>; 4] {
        let each = |part: fn(&Complex<f64>) -> f64| -> Vec<Option<f64>> {
            self.values.iter().map(|x| Some(x).filter(|x| is_finite(x)).map(part)).collect()
        };
        let phases = self.phases().into_iter().map(|phase| Some(phase).filter(|phase| phase.is_finite())).collect();
        [each(|x| x.re), each(|x| x.im), each(|x| x.norm()), phases]
    }

    /// The columns of `bode-T.csv` with their names.
    pub(super) fn columns(&self) -> impl Iterator<Item = (String, Vec<Option<f64>>)> {
        let names = ["re", "im", "magnitude", "phase_deg"].map(|part| format!("{}/{}.{part}", self.output, self.input));
        names.into_iter().zip(self.parts())
    }

    /// Phases in degrees without jumps of 360, the first one above -180 and up to 180; NaN where there is none.
    pub(super) fn phases(&self) -> Vec<f64> {
        let mut before: Option<f64> = None;
        let phase = |value: &Complex<f64>| {
            if value.norm() == 0.0 || value.norm().is_nan() {
                return f64::NAN;
            }
            let angle = Some(value.arg().to_degrees()).filter(|angle| angle.abs() > tolerances::SAME).unwrap_or(0.0);
            let near = before.map_or(angle, |before| angle + 360.0 * ((before - angle) / 360.0).round());
            before = Some(near);
            near
        };
        self.values.iter().map(phase).collect()
    }
}

pub(super) fn is_finite(value: &Complex<f64>) -> bool {
    value.re.is_finite() && value.im.is_finite()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn phases_do_not_jump() {
        // Three lags in a row: from 0 down to -270 degrees.
        let lag = |w: f64| Complex::new(1.0, w).powi(-3);
        let values: Vec<Complex<f64>> = (0..200).map(|k| lag(10f64.powf(-2.0 + 0.03 * f64::from(k)))).collect();
        let response = |values| Response { values, ..Response::default() };
        let phases = response(values).phases();
        assert!(phases.windows(2).all(|pair| pair[1] < pair[0] && pair[0] - pair[1] < 10.0));
        assert!((phases[199] + 270.0).abs() < 1.0, "{}", phases[199]);
        assert!(response(vec![Complex::new(0.0, 0.0)]).phases()[0].is_nan());
    }
}
