//! A frequency response: `bode-T.csv`, `bode-T.json`, its text and its figure.

use super::bode_figure::{Magnitude, bode_figure, not_drawn};
use super::pair::{Response, is_finite};
use crate::error::{Result, short, significant};
use crate::linearize::LinearModel;
use crate::report::tables::optional;
use crate::report::{Answer, Folder, TextTable, cell, table};
use serde::Serialize;
use serde_json::{Value, json};

pub struct FrequencyResponse<'a> {
    pub scene: &'a str,
    pub model: LinearModel,
    pub frequencies: Vec<f64>,
    /// Responses of each output to each input; NaN at a pole.
    pub responses: Vec<Response>,
    pub magnitude: Magnitude,
}

impl FrequencyResponse<'_> {
    /// Returns `frequency_hz`, then real and imaginary part, magnitude and phase from each input to each output.
    fn table(&self) -> Result<Vec<u8>> {
        let parts = ["re", "im", "magnitude", "phase_deg"];
        let name = |response: &Response| parts.map(|part| format!("{}/{}.{part}", response.output, response.input));
        let names = self.responses.iter().flat_map(name);
        let columns: Vec<_> = self.responses.iter().flat_map(|response| response.parts(&self.frequencies)).collect();
        let rows = self.frequencies.iter().enumerate().map(|(i, frequency)| {
            let cells = columns.iter().map(|values| optional(values[i]));
            [cell(*frequency)].into_iter().chain(cells).collect()
        });
        table(["frequency_hz".to_string()].into_iter().chain(names), rows)
    }

    /// Frequencies of poles, at which there is no response, Hz.
    fn poles(&self) -> Vec<f64> {
        let is_pole = |i: &usize| self.responses.iter().any(|x| x.values.get(*i).is_some_and(|x| !is_finite(x)));
        (0..self.frequencies.len()).filter(is_pole).map(|i| self.frequencies[i]).collect()
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

impl Answer for FrequencyResponse<'_> {
    fn json(&self) -> impl Serialize {
        let LinearModel { method, chart, point, .. } = &self.model;
        let pair = |response: &Response| {
            let Response { input, output, input_unit, output_unit, .. } = response;
            let [re, im, magnitude, phase_deg] = response.parts(&self.frequencies);
            json!({
                "input": input,
                "output": output,
                "input_unit": input_unit,
                "output_unit": output_unit,
                "re": re,
                "im": im,
                "magnitude": magnitude,
                "phase_deg": phase_deg,
            })
        };
        json!({
            "scene": self.scene,
            "t": point.t,
            "equilibrium": point.is_equilibrium,
            "method": method,
            "chart": chart,
            "frequency_hz": self.frequencies,
            "poles_hz": self.poles(),
            "responses": self.responses.iter().map(pair).collect::<Vec<Value>>(),
        })
    }

    /// Returns each pair with its response at the lowest frequency and at its largest.
    fn text(&self) -> String {
        let model = &self.model;
        let ends = [self.frequencies.first(), self.frequencies.last()];
        let [from, to] = ends.map(|end| significant(end.copied().unwrap_or(0.0), 4));
        let state = if model.point.is_equilibrium { "an equilibrium" } else { "not an equilibrium" };
        let mut text = format!(
            "{} at t = {} s ({state}): frequency response from {from} to {to} Hz, by {}, chart {}\n",
            self.scene,
            significant(model.point.t, 9),
            model.method,
            model.chart
        );
        for pole in self.poles() {
            text += &format!("  NO RESPONSE at {} Hz: the model has a pole there\n", significant(pole, 6));
        }
        let at = format!("at {from} Hz");
        let mut lines = TextTable::new(&["output / input", "unit", &at, "largest", "at (Hz)"]).words(1);
        self.responses.iter().filter(|x| !x.is_zero()).for_each(|response| lines.row(self.cells(response)));
        format!("{text}\n{lines}{}", self.left_out())
    }

    fn write(&self, folder: &mut Folder, stem: &str) -> Result<()> {
        folder.table(stem, &self.table()?)?;
        let title = format!("{} at t = {} s", self.scene, short(self.model.point.t));
        folder.figure(stem, bode_figure(&title, &self.frequencies, &self.responses, self.magnitude))
    }
}
