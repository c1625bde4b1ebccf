//! A frequency response: `bode-T.csv`, `bode-T.json`, its text and its figure.

use super::bode_figure::not_drawn;
use super::pair::{Response, is_finite};
use crate::error::{Result, significant};
use crate::report::{Table, cell, table};
use serde::Serialize;
use std::mem::take;

/// Frequency responses of a model.
#[derive(Clone, Debug, Serialize)]
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
    #[serde(rename = "frequency_hz")]
    pub frequencies: Vec<f64>,
    /// Responses of each output to each input; NaN at a pole.
    #[serde(skip)]
    pub responses: Vec<Response>,
}

/// Contents of `bode-T.json`.
#[derive(Serialize)]
pub struct ResponseFile {
    #[serde(flatten)]
    of: FrequencyResponse,
    poles_hz: Vec<f64>,
    responses: Vec<PairFile>,
}

/// Response of an output to an input, at each frequency; none at a pole.
#[derive(Serialize)]
struct PairFile {
    #[serde(flatten)]
    of: Response,
    re: Vec<Option<f64>>,
    im: Vec<Option<f64>>,
    magnitude: Vec<Option<f64>>,
    phase_deg: Vec<Option<f64>>,
}

impl FrequencyResponse {
    /// Returns `frequency_hz`, then real and imaginary part, magnitude and phase from each input to each output.
    ///
    /// # Errors
    /// A table that cannot be written.
    pub fn table(&self) -> Result<Vec<u8>> {
        let columns: Vec<(String, Vec<Option<f64>>)> =
            self.responses.iter().flat_map(|response| response.columns(&self.frequencies)).collect();
        let names = columns.iter().map(|(name, _)| name.clone());
        let rows = self.frequencies.iter().enumerate().map(|(i, frequency)| {
            let cells = columns.iter().map(|(_, values)| values[i].map_or(String::new(), cell));
            [cell(*frequency)].into_iter().chain(cells).collect()
        });
        table(["frequency_hz".to_string()].into_iter().chain(names), rows)
    }

    /// Frequencies of poles, at which there is no response, Hz.
    fn poles(&self) -> Vec<f64> {
        let is_pole = |i: &usize| self.responses.iter().any(|x| x.values.get(*i).is_some_and(|x| !is_finite(x)));
        (0..self.frequencies.len()).filter(is_pole).map(|i| self.frequencies[i]).collect()
    }

    /// Returns the contents of `bode-T.json`.
    pub fn file(mut self) -> ResponseFile {
        let poles_hz = self.poles();
        let responses = take(&mut self.responses);
        let pair = |of: Response| {
            let [re, im, magnitude, phase_deg] = of.parts(&self.frequencies);
            PairFile { of, re, im, magnitude, phase_deg }
        };
        let responses = responses.into_iter().map(pair).collect();
        ResponseFile { of: self, poles_hz, responses }
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
        for pole in self.poles() {
            text += &format!("  NO RESPONSE at {} Hz: the model has a pole there\n", significant(pole, 6));
        }
        let at = format!("at {from} Hz");
        let mut lines = Table::new(&["output / input", "unit", &at, "largest", "at (Hz)"]).words(1);
        self.responses.iter().filter(|x| !x.is_zero()).for_each(|response| lines.row(self.cells(response)));
        format!("{text}\n{lines}{}", self.left_out())
    }

    /// Names the responses that are zero, and those for which the figure has no room.
    fn left_out(&self) -> String {
        let named = |what: &str, all: Vec<&Response>| match all.as_slice() {
            [] => String::new(),
            all => {
                let pairs: Vec<String> = all.iter().map(|response| response.pair()).collect();
                format!("\n  {what}: {}\n", pairs.join(", "))
            }
        };
        let zero = self.responses.iter().filter(|response| response.is_zero()).collect();
        let rest = not_drawn(&self.responses);
        named("zero to round-off", zero) + &named("not in the figure (choose by --input and --output)", rest)
    }

    fn cells(&self, response: &Response) -> [String; 5] {
        let sizes = self.frequencies.iter().zip(&response.values).filter(|(_, value)| is_finite(value));
        let sizes: Vec<(f64, f64)> = sizes.map(|(f, value)| (*f, value.norm())).collect();
        let first = sizes.first().copied().unwrap_or_default();
        let (at, largest) = sizes.iter().copied().fold(first, |most, next| if next.1 > most.1 { next } else { most });
        [response.pair(), response.unit(), significant(first.1, 5), significant(largest, 5), significant(at, 5)]
    }
}
