//! Frequency response.

use crate::linearize::Complex;
use crate::plot::{AxisSpec, Figure, Panel, Series};

/// How an output follows an input, at each frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct Response {
    pub input: String,
    pub output: String,
    pub input_unit: String,
    pub output_unit: String,
    /// In output unit per input unit.
    pub values: Vec<Complex<f64>>,
}

impl Response {
    pub(super) fn unit(&self) -> String {
        let words = [&self.output_unit, &self.input_unit];
        match words.map(|unit| unit.trim()) {
            ["", ""] => String::new(),
            ["", input] => format!("1/({input})"),
            [output, ""] => output.to_string(),
            [output, input] if input.contains(' ') => format!("{output}/({input})"),
            [output, input] => format!("{output}/{input}"),
        }
    }
}

/// Magnitude and phase over frequencies in Hz. `None` without a response.
pub fn bode_figure(title: &str, frequencies: &[f64], responses: &[Response]) -> Option<Figure> {
    let first = responses.first().filter(|_| !frequencies.is_empty())?;
    let has_one_unit = responses.iter().all(|response| response.unit() == first.unit());
    let x = AxisSpec::from("frequency (Hz)").log();
    let magnitude = match (has_one_unit, first.unit().as_str()) {
        (true, "") => "magnitude".to_string(),
        (true, unit) => format!("magnitude ({unit})"),
        (false, _) => "magnitude (output per input)".to_string(),
    };
    let is_alone = responses.len() == 1;
    let title = if is_alone { format!("{title}: {} over {}", first.output, first.input) } else { title.to_string() };
    let name = |response: &Response| match (is_alone, has_one_unit) {
        (true, _) => String::new(),
        (_, true) => format!("{} / {}", response.output, response.input),
        (_, false) => format!("{} / {} ({})", response.output, response.input, response.unit()),
    };
    let lines = |panel: Panel, values: fn(&[Complex<f64>]) -> Vec<f64>| {
        let line = |response: &Response| {
            let points = frequencies.iter().copied().zip(values(&response.values)).collect();
            Series::line(name(response), points)
        };
        responses.iter().map(line).fold(panel, Panel::series)
    };
    let sizes = lines(Panel::new(x.clone(), AxisSpec::from(magnitude).log()), sizes);
    let phases = lines(Panel::new(x, AxisSpec::from("phase (deg)").degrees()), phases);
    Some(Figure::new().title(title).panel(sizes).panel(phases))
}

/// A response of zero has no place on a logarithmic axis.
fn sizes(values: &[Complex<f64>]) -> Vec<f64> {
    values.iter().map(|value| value.norm()).map(|size| if size > 0.0 { size } else { f64::NAN }).collect()
}

/// Phases in degrees without jumps of full turns, the first one above -180 and up to 180.
fn phases(values: &[Complex<f64>]) -> Vec<f64> {
    let mut before: Option<f64> = None;
    let phase = |value: &Complex<f64>| {
        if value.norm() == 0.0 || value.norm().is_nan() {
            return f64::NAN;
        }
        let angle = value.arg().to_degrees();
        let near = before.map_or(angle, |before| angle + 360.0 * ((before - angle) / 360.0).round());
        before = Some(near);
        near
    };
    values.iter().map(phase).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn phases_do_not_jump() {
        // Three lags in a row: from 0 down to -270 degrees.
        let lag = |w: f64| Complex::new(1.0, w).powi(-3);
        let values: Vec<Complex<f64>> = (0..200).map(|k| lag(10f64.powf(-2.0 + 0.03 * f64::from(k)))).collect();
        let phases = phases(&values);
        assert!(phases.windows(2).all(|pair| pair[1] < pair[0] && pair[0] - pair[1] < 10.0));
        assert!((phases[199] + 270.0).abs() < 1.0, "{}", phases[199]);
        assert!(super::phases(&[Complex::new(0.0, 0.0)])[0].is_nan());
    }
}
