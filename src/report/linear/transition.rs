//! `transition-T.json`: growth of small changes along the motion, its text and its figure.

use super::files::matrix;
use crate::error::{Result, significant, two_digits};
use crate::linearize::{Complex, Defect, Floquet, Lyapunov};
use crate::plot::{Figure, Panel, Series};
use crate::report::{Answer, Folder, TextTable, table};
use crate::tolerances;
use serde::Serialize;
use serde_json::{Value, json};

/// Growth of small changes from a state on.
pub struct Transition<'a> {
    pub scene: &'a str,
    pub t: f64,
    /// Over a period, with the multipliers of size 1 that have too few vectors.
    pub floquet: Option<(Floquet, Vec<Defect>)>,
    pub lyapunov: Option<Lyapunov>,
}

impl Answer for Transition<'_> {
    fn json(&self) -> impl Serialize {
        let mut result = json!({ "scene": self.scene, "t": self.t });
        if let Some((found, defects)) = &self.floquet {
            result["floquet"] = floquet_json(found, defects);
        }
        if let Some(found) = &self.lyapunov {
            result["lyapunov"] = json!({ "times": found.times, "exponents": found.exponents });
        }
        result
    }

    fn text(&self) -> String {
        let floquet = self.floquet.iter().map(|(found, defects)| floquet_text(self.scene, self.t, found, defects));
        floquet.chain(self.lyapunov.iter().map(|found| lyapunov_text(self.scene, self.t, found))).collect()
    }

    fn write(&self, folder: &mut Folder, stem: &str) -> Result<()> {
        let figure = self.lyapunov.as_ref().and_then(|found| figure(self.scene, found));
        folder.figure(&stem.replace("transition", "lyapunov"), figure)
    }
}

fn floquet_json(found: &Floquet, defects: &[Defect]) -> Value {
    let pairs =
        |values: &[Complex<f64>]| -> Vec<[f64; 2]> { values.iter().map(|value| [value.re, value.im]).collect() };
    json!({
        "period": found.period,
        "gap": found.gap,
        "chart": found.chart,
        "states": found.states,
        "monodromy": matrix(&found.monodromy),
        "multipliers": pairs(&found.multipliers),
        "exponents": pairs(&found.exponents()),
        "multiplier_errors": found.errors,
        "multiplier_conditions": found.conditions.iter().map(|x| x.is_finite().then_some(*x)).collect::<Vec<_>>(),
        "stable": found.is_stable(tolerances::MULTIPLIER_OUTSIDE) && defects.is_empty(),
        "grows_like_t": !defects.is_empty(),
    })
}

fn floquet_text(scene: &str, t: f64, found: &Floquet, defects: &[Defect]) -> String {
    let mut table = TextTable::new(&["multiplier re", "im", "size", "error", "condition", "grows by (1/s)"]);
    let sure = found.errors.iter().zip(&found.conditions);
    for ((value, exponent), (error, condition)) in found.multipliers.iter().zip(found.exponents()).zip(sure) {
        let [re, im, size, growth] = [value.re, value.im, value.norm(), exponent.re].map(|x| significant(x, 7));
        table.row([re, im, size, two_digits(*error), two_digits(*condition), growth]);
    }
    let verdict = match (found.is_stable(tolerances::MULTIPLIER_OUTSIDE), defects.first()) {
        (false, _) => "small changes grow".to_string(),
        (true, None) => "no small change grows".to_string(),
        (true, Some(Defect { count, vectors, .. })) => format!(
            "small changes grow like t, no faster: a multiplier of size 1 counts {count} and has {}",
            table::count(*vectors, "vector")
        ),
    };
    format!(
        "{scene} from t = {} s over the period {} s (returns to {:.1e}): {verdict}\n\n{table}",
        significant(t, 6),
        significant(found.period, 9),
        found.gap
    )
}

fn lyapunov_text(scene: &str, t: f64, found: &Lyapunov) -> String {
    let list = |values: &[f64]| values.iter().map(|x| significant(*x, 4)).collect::<Vec<String>>().join(", ");
    let half = found.exponents.get(found.exponents.len() / 2).map_or(&[][..], Vec::as_slice);
    let duration = found.times.last().copied().unwrap_or(0.0);
    format!(
        "{scene} from t = {} s: Lyapunov exponents over {} s, 1/s\n  {}\n  over half of it: {}\n",
        significant(t, 6),
        significant(duration, 6),
        list(found.last()),
        list(half)
    )
}

fn figure(scene: &str, found: &Lyapunov) -> Option<Figure> {
    let count = found.last().len();
    let line = |i: usize| {
        let points = found.times.iter().zip(&found.exponents).map(|(t, now)| (*t, now[i])).collect();
        Series::line(format!("exponent {}", i + 1), points)
    };
    let panel = (0..count).map(line).fold(Panel::new("time (s)", "average growth (1/s)"), Panel::series);
    (count > 0).then(|| Figure::new().title(format!("{scene}: Lyapunov exponents")).panel(panel))
}
