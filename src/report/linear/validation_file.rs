//! `validation-T.json`, its text and its figure.

use super::{Deviation, ErrorOrder, validation_figure};
use crate::error::significant;
use crate::plot::Figure;
use crate::report::Table;
use crate::system::Names;
use crate::validate::{Decay, InputCheck, Ladder, Validation, Verdict};
use serde::Serialize;
use serde_json::{Map, Value, json};

/// A validation as it stands in the file: the first direction at the top, all of them below.
#[derive(Clone, Debug, Serialize)]
pub struct ValidationFile {
    pub scene: String,
    pub t: f64,
    pub chart: String,
    /// How long perturbed motions were followed, s.
    pub followed: f64,
    /// Sizes of (dq, dv / rate), m or rad.
    pub epsilons: Vec<f64>,
    pub rate: f64,
    pub errors_ltv: Vec<f64>,
    pub order_ltv: Option<f64>,
    pub errors_lti: Vec<f64>,
    /// Times at which the frozen model is off by a share, s; null: not within what was followed.
    pub horizons: Map<String, Value>,
    pub verdict: Verdict,
    pub directions: Vec<Value>,
    /// exp(A h) against the state-transition matrix.
    pub frozen: Value,
    pub inputs: Vec<InputCheck>,
}

/// What the shares of [`Ladder::horizons`] are called.
const SHARES: [&str; 2] = ["1%", "10%"];

impl ValidationFile {
    pub fn new(scene: &str, names: &Names, found: &Validation) -> Self {
        let first = found.ladders.first();
        ValidationFile {
            scene: scene.to_string(),
            t: found.t,
            chart: found.chart.clone(),
            followed: found.followed,
            epsilons: first.map_or(Vec::new(), |ladder| ladder.epsilons.clone()),
            rate: found.rate,
            errors_ltv: first.map_or(Vec::new(), |ladder| ladder.errors_ltv.clone()),
            order_ltv: first.and_then(|ladder| ladder.order_ltv.order),
            errors_lti: first.map_or(Vec::new(), |ladder| ladder.errors_lti.clone()),
            horizons: first.map_or(Map::new(), horizons),
            verdict: found.verdict.clone(),
            directions: found.ladders.iter().map(|ladder| direction(names, ladder)).collect(),
            frozen: json!({ "steps": found.frozen.steps, "errors": found.frozen.errors, "decay": found.frozen.decay }),
            inputs: found.inputs.clone(),
        }
    }

    /// Whether perturbed motions follow the model.
    pub fn is_right(&self) -> bool {
        self.verdict.ltv && self.verdict.lti
    }

    /// What a negative verdict says, and what may help.
    pub fn complaint(&self) -> String {
        let ValidationFile { scene, chart, verdict, .. } = self;
        let t = significant(self.t, 9);
        let help = match verdict.ltv {
            true => "take --chart intrinsic, mass_orthogonal or names of independent coordinates",
            false => "try another --horizon or --along; equations of one's own may have wrong derivatives",
        };
        format!("{scene} at t = {t} s, chart {chart}: {}\n  help: {help}", verdict.text)
    }

    /// Orders, horizons and the verdict.
    pub fn text(&self, found: &Validation) -> String {
        let mut table = Table::new(&["perturbation", "order in eps", "decades", "1 % after (s)", "10 % after (s)"]);
        for ladder in &found.ladders {
            let [one, ten] = ladder
                .horizons
                .map(|time| time.map_or(format!("> {}", significant(found.followed, 3)), |time| significant(time, 4)));
            table.row([ladder.direction.clone(), order(&ladder.order_ltv), decades(&ladder.order_ltv), one, ten]);
        }
        for input in &found.inputs {
            let lti = format!("{:.1e} (frozen)", input.error_lti);
            let name = format!("pulse of {}, {} s", input.input, significant(input.width, 3));
            table.row([name, order(&input.order_ltv), decades(&input.order_ltv), lti, String::new()]);
        }
        format!(
            "{} at t = {} s: the linear model (chart {}) against simulations over {} s\n\n{table}\n  exp(A h) against the state-transition matrix: order {} in h\n  verdict: {}\n",
            self.scene,
            significant(self.t, 9),
            self.chart,
            significant(found.followed, 3),
            order(&found.frozen.decay),
            self.verdict.text
        )
    }
}

fn order(decay: &Decay) -> String {
    match (decay.order, decay.is_exact) {
        (_, true) => "exact".to_string(),
        (Some(order), _) => format!("{order:.2}"),
        (None, _) => "-".to_string(),
    }
}

fn decades(decay: &Decay) -> String {
    if decay.order.is_some() { format!("{:.1}", decay.decades) } else { "-".to_string() }
}

fn horizons(ladder: &Ladder) -> Map<String, Value> {
    SHARES.iter().zip(ladder.horizons).map(|(share, time)| (share.to_string(), json!(time))).collect()
}

fn direction(names: &Names, ladder: &Ladder) -> Value {
    let curves = ladder.curves.iter().map(|curve| {
        json!({ "velocity": names.v[curve.direction], "simulated": curve.simulated, "ltv": curve.ltv, "lti": curve.lti })
    });
    json!({
        "direction": ladder.direction,
        "epsilons": ladder.epsilons,
        "errors_ltv": ladder.errors_ltv,
        "order_ltv": ladder.order_ltv,
        "errors_lti": ladder.errors_lti,
        "times": ladder.times,
        "relative_error_lti": ladder.drift_lti,
        "horizons": horizons(ladder),
        "curve_epsilon": ladder.curve_epsilon,
        "curves": curves.collect::<Vec<Value>>(),
    })
}

/// Errors against eps, and what moves most, of one direction.
pub fn ladder_figure(title: &str, names: &Names, ladder: &Ladder) -> Option<Figure> {
    let order = ErrorOrder {
        epsilons: ladder.epsilons.clone(),
        ltv: ladder.errors_ltv.clone(),
        lti: ladder.errors_lti.clone(),
        what: "error of the change at the end".to_string(),
    };
    let deviation = |curve: &crate::validate::Curve| {
        let name = names.v[curve.direction].trim_end_matches('\'').to_string();
        let is_turn = ["angle", "wx", "wy", "wz", "rx", "ry", "rz"].iter().any(|end| name.ends_with(end));
        let is_place = ["x", "y", "z"].iter().any(|end| name.ends_with(&format!(".{end}")));
        let unit = if is_turn {
            "rad"
        } else if is_place {
            "m"
        } else {
            ""
        };
        Deviation {
            name,
            unit: unit.to_string(),
            simulated: curve.simulated.clone(),
            ltv: curve.ltv.clone(),
            lti: curve.lti.clone(),
        }
    };
    let deviations: Vec<Deviation> = ladder.curves.iter().map(deviation).collect();
    validation_figure(title, &order, &ladder.times, &deviations)
}
