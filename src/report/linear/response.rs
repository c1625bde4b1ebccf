//! A frequency response: `bode-T.csv`, `bode-T.json`, its text and its figure.

use crate::error::{Result, significant};
use crate::linearize::Complex;
use crate::plot::{AxisSpec, Figure, Panel, Series};
use crate::report::{Table, cell, table};
use serde::Serialize;

/// Frequency responses of a model.
#[derive(Clone, Debug)]
pub struct FrequencyResponse {
    /// Name of the scene.
    pub scene: String,
    /// Time of the state, s.
    pub t: f64,
    /// True if the state is an equilibrium.
    pub equilibrium: bool,
    /// Method with its options.
    pub method: String,
    /// Chart of the coordinates.
    pub chart: String,
    /// Frequencies, Hz.
    pub frequencies: Vec<f64>,
    /// Responses of each output to each input; NaN at a pole.
    pub responses: Vec<Response>,
}

/// Contents of `bode-T.json`.
#[derive(Clone, Debug, Serialize)]
pub struct ResponseFile {
    /// Name of the scene.
    pub scene: String,
    /// Time of the state, s.
    pub t: f64,
    /// True if the state is an equilibrium.
    pub equilibrium: bool,
    /// Method with its options.
    pub method: String,
    /// Chart of the coordinates.
    pub chart: String,
    /// Frequencies, Hz.
    pub frequency_hz: Vec<f64>,
    /// Frequencies of poles, at which there is no response, Hz.
    pub poles_hz: Vec<f64>,
    /// Responses of each output to each input.
    pub responses: Vec<PairFile>,
}

/// Response of an output to an input, at each frequency; none at a pole.
#[derive(Clone, Debug, Serialize)]
pub struct PairFile {
    pub input: String,
    pub output: String,
    pub input_unit: String,
    pub output_unit: String,
    pub re: Vec<Option<f64>>,
    pub im: Vec<Option<f64>>,
    pub magnitude: Vec<Option<f64>>,
    pub phase_deg: Vec<Option<f64>>,
}

type Part = fn(Complex<f64>) -> f64;

/// Columns of a response.
const PARTS: [(&str, Part); 4] = [
    ("re", |value| value.re),
    ("im", |value| value.im),
    ("magnitude", |value| value.norm()),
    ("phase_deg", |value| value.arg().to_degrees()),
];

impl FrequencyResponse {
    /// Returns `frequency_hz`, then real and imaginary part, magnitude and phase from each input to each output.
    ///
    /// # Errors
    /// A table that cannot be written.
    pub fn table(&self) -> Result<Vec<u8>> {
        let names = self
            .responses
            .iter()
            .flat_map(|response| PARTS.map(|(part, _)| format!("{}/{}.{part}", response.output, response.input)));
        let rows = self.frequencies.iter().enumerate().map(|(i, frequency)| {
            let values = self.responses.iter().map(|response| response.values.get(i).copied().filter(is_finite));
            let cells = values.flat_map(|value| PARTS.map(|(_, part)| value.map_or(String::new(), |x| cell(part(x)))));
            [cell(*frequency)].into_iter().chain(cells).collect()
        });
        table(["frequency_hz".to_string()].into_iter().chain(names), rows)
    }

    /// Returns the contents of `bode-T.json`.
    pub fn file(&self) -> ResponseFile {
        let is_pole = |i: &usize| self.responses.iter().any(|x| x.values.get(*i).is_some_and(|x| !is_finite(x)));
        let poles = (0..self.frequencies.len()).filter(is_pole).map(|i| self.frequencies[i]);
        ResponseFile {
            scene: self.scene.clone(),
            t: self.t,
            equilibrium: self.equilibrium,
            method: self.method.clone(),
            chart: self.chart.clone(),
            poles_hz: poles.collect(),
            frequency_hz: self.frequencies.clone(),
            responses: self.responses.iter().map(pair).collect(),
        }
    }

    /// Returns each pair with its response at the lowest frequency and at its largest.
    pub fn text(&self) -> String {
        let ends = [self.frequencies.first(), self.frequencies.last()];
        let [from, to] = ends.map(|end| significant(end.copied().unwrap_or(0.0), 4));
        let state = if self.equilibrium { "an equilibrium" } else { "not an equilibrium" };
        let mut text = format!(
            "{} at t = {} s ({state}): frequency response from {from} to {to} Hz, by {}, chart {}\n",
            self.scene,
            significant(self.t, 9),
            self.method,
            self.chart
        );
        for pole in self.file().poles_hz {
            text += &format!("  NO RESPONSE at {} Hz: the model has a pole there\n", significant(pole, 6));
        }
        let at = format!("at {from} Hz");
        let mut lines = Table::new(&["output / input", "unit", &at, "largest", "at (Hz)"]).words(1);
        self.responses.iter().for_each(|response| lines.row(self.cells(response)));
        format!("{text}\n{lines}")
    }

    fn cells(&self, response: &Response) -> [String; 5] {
        let sizes = self.frequencies.iter().zip(&response.values).filter(|(_, value)| is_finite(value));
        let sizes: Vec<(f64, f64)> = sizes.map(|(f, value)| (*f, value.norm())).collect();
        let first = sizes.first().copied().unwrap_or_default();
        let (at, largest) = sizes.iter().copied().fold(first, |most, next| if next.1 > most.1 { next } else { most });
        [
            format!("{} / {}", response.output, response.input),
            response.unit(),
            significant(first.1, 5),
            significant(largest, 5),
            significant(at, 5),
        ]
    }
}

fn is_finite(value: &Complex<f64>) -> bool {
    value.re.is_finite() && value.im.is_finite()
}

fn pair(response: &Response) -> PairFile {
    let each = |part: Part| response.values.iter().map(|x| Some(*x).filter(is_finite).map(part)).collect();
    let [re, im, magnitude, phase_deg] = PARTS.map(|(_, part)| each(part));
    PairFile {
        input: response.input.clone(),
        output: response.output.clone(),
        input_unit: response.input_unit.clone(),
        output_unit: response.output_unit.clone(),
        re,
        im,
        magnitude,
        phase_deg,
    }
}

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
    fn unit(&self) -> String {
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

/// Draws magnitude and phase over frequencies in Hz. `None` without a response.
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

/// Returns magnitudes; zero has no place on a logarithmic axis and becomes NaN.
fn sizes(values: &[Complex<f64>]) -> Vec<f64> {
    values.iter().map(|value| value.norm()).map(|size| if size > 0.0 { size } else { f64::NAN }).collect()
}

/// Returns phases in degrees without jumps of 360, the first one above -180 and up to 180.
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
