//! Work-precision measurements as text, tables and figures.

mod auto;
mod figure;
mod models;
mod table;
mod text;

pub use auto::{MeasuredModel, ModelsAndMethods};
pub use models::ModelsAnswer;

use crate::error::Result;
use crate::report::tables::by_columns;
use crate::report::{Answer, Folder};
use crate::simulate::Method;
use crate::study::work_precision::{Cell, Held, Recommendation, WorkPrecision};
use figure::tradeoff_figure;
use serde::Serialize;

#[derive(Serialize)]
pub struct MethodsAnswer<'a> {
    #[serde(flatten)]
    measured: &'a WorkPrecision,
    /// Pareto front: indices in `cells` of runs than which none is both cheaper and more accurate.
    front: Vec<usize>,
    recommendations: Vec<Advice>,
    /// Digits that text and figure are for.
    #[serde(skip)]
    digits: u32,
}

/// A recommendation as a sentence, with the command to run it.
#[derive(Serialize)]
struct Advice {
    #[serde(flatten)]
    places: Recommendation,
    /// Sentence; of a range of digits it follows `for 3 to 5 digits: `.
    sentence: String,
    command: String,
}

impl<'a> MethodsAnswer<'a> {
    /// The answer for this many digits; `scene` is the scene with its settings as on the command line.
    pub fn new(measured: &'a WorkPrecision, scene: &str, digits: u32) -> MethodsAnswer<'a> {
        let all = measured.recommendations().into_iter();
        let recommendations = all.map(|places| advice(measured, places, scene)).collect();
        MethodsAnswer { measured, front: measured.front(), recommendations, digits }
    }
}

impl Answer for MethodsAnswer<'_> {
    fn json(&self) -> impl Serialize {
        self
    }

    fn text(&self) -> String {
        text::text(self)
    }

    fn write(&self, folder: &mut Folder, stem: &str) -> Result<()> {
        folder.table(stem, &by_columns(&table::COLUMNS, self.measured.cells.iter())?)?;
        folder.figure(stem, tradeoff_figure(self.measured, self.digits))
    }
}

fn advice(measured: &WorkPrecision, places: Recommendation, scene: &str) -> Advice {
    let cell = |place: usize| &measured.cells[place];
    let run = |place: usize| {
        let Cell { method, .. } = cell(place);
        let time = cell(place).cost.map_or(String::new(), milliseconds);
        format!("{} at {}, {time}", method.triple(), accuracy(method))
    };
    let best = cell(places.best);
    let next = places.next.map_or(String::new(), |next| format!("; next best {}", run(next)));
    let ties: Vec<String> = places.ties.iter().map(|place| cell(*place).method.triple()).collect();
    let tie = match &ties[..] {
        [] => String::new(),
        [one] => format!("; a tie with {one}"),
        [first, rest @ ..] => format!("; a tie with {first} and {} more", rest.len()),
    };
    let drift = best.drift().map_or(0.0, Held::largest);
    let is_tied = places.next.is_some_and(|next| places.ties.contains(&next));
    let next = if is_tied { String::new() } else { next };
    let sentence = format!("{}{tie}{next}; drift {drift:.0e}", run(places.best));
    Advice { places, sentence, command: command(&best.method, scene) }
}

fn accuracy(method: &Method) -> String {
    match method.step {
        Some(step) => format!("step {} s", crate::error::short(step)),
        None => format!("rtol {:e}", method.rtol),
    }
}

fn command(method: &Method, scene: &str) -> String {
    let Method { formulation, integrator, projection, rtol, atol, step } = method;
    let accuracy = match step {
        Some(step) => format!("--step {step:e}"),
        None => format!("--rtol {rtol:e} --atol {atol:e}"),
    };
    format!(
        "holonom simulate {scene} --formulation {formulation} --integrator {integrator} --projection {projection} {accuracy}"
    )
}

pub(super) fn milliseconds(seconds: f64) -> String {
    let ms = 1e3 * seconds;
    match ms {
        ms if ms < 1e3 => format!("{} ms", crate::error::significant(format!("{ms:.2e}").parse().unwrap_or(ms), 3)),
        ms => format!("{:.1} s", 1e-3 * ms),
    }
}
