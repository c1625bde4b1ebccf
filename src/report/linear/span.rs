//! `validation-along.json`: models along a motion against perturbed simulations.

use crate::error::{short_list, significant};
use crate::linearize::Along;
use crate::report::{Answer, TextTable};
use crate::validate::SpanCheck;
use serde::Serialize;
use serde_json::json;

/// Models along a motion with their checks, one for each direction.
pub struct SpanAnswer<'a> {
    pub scene: &'a str,
    pub along: &'a Along,
    pub checks: &'a [SpanCheck],
}

impl SpanAnswer<'_> {
    pub fn is_right(&self) -> bool {
        self.checks.iter().all(SpanCheck::is_right)
    }

    /// Returns the conclusion as a sentence.
    pub fn verdict(&self) -> String {
        let wrong = self.checks.iter().filter(|check| !check.is_right());
        let wrong: Vec<String> = wrong.map(|check| check.direction.clone()).collect();
        let order = self.checks.iter().filter_map(|check| check.lowest()?.1.order).fold(f64::INFINITY, f64::min);
        let order =
            if order.is_finite() { format!("order {order:.2} in eps") } else { "exact to rounding".to_string() };
        if wrong.is_empty() {
            format!("right: perturbed simulations follow the models over the whole span ({order})")
        } else {
            format!("wrong along {}, or too near to rounding to tell: {order}, where 2 is expected", short_list(&wrong))
        }
    }
}

impl Answer for SpanAnswer<'_> {
    fn json(&self) -> impl Serialize {
        json!({
            "scene": self.scene,
            "chart": self.along.models[0].chart,
            "error": { "A": self.along.measured, "interpolation": self.along.deviations },
            "sequences": self.checks,
            "verdict": { "ltv": self.is_right(), "text": self.verdict() },
        })
    }

    fn text(&self) -> String {
        let models = &self.along.models;
        let end = models.last().map_or(0.0, |last| last.point.t);
        let mut table = TextTable::new(&["perturbation", "least order in eps", "at t (s)", "decades"]);
        for check in self.checks {
            let cells = match check.lowest() {
                Some((t, decay)) => {
                    let order = decay.order.map_or(String::new(), |order| format!("{order:.2}"));
                    [order, significant(t, 6), format!("{:.1}", decay.decades)]
                }
                None => ["exact", "-", "-"].map(str::to_string),
            };
            let [order, t, decades] = cells;
            table.row([check.direction.clone(), order, t, decades]);
        }
        format!(
            "{} from t = {} s to {} s: {} models along the motion against perturbed simulations, chart {}\n\n{table}\n  \
             verdict: {}\n",
            self.scene,
            significant(models[0].point.t, 9),
            significant(end, 9),
            models.len(),
            models[0].chart,
            self.verdict()
        )
    }
}
