//! The linear model against perturbed simulations: `validation-T.json`, its text and its figure.

use crate::error::{Result, significant};
use crate::math::largest;
use crate::plot::{AxisSpec, Figure, Panel, Series, Style};
use crate::report::figures::{Floor, grouped, label, quantity};
use crate::report::{Answer, Folder, TextTable};
use crate::system::Names;
use crate::tolerances;
use crate::validate::{ChangeCurve, Decay, EventPassage, PerturbationSequence, Reason, Validation};
use serde::Serialize;
use serde_json::{Value, json};

pub struct ValidationAnswer<'a> {
    pub scene: &'a str,
    pub names: &'a Names,
    pub found: Validation,
}

impl ValidationAnswer<'_> {
    /// True if perturbed motions agree with the model.
    pub fn is_right(&self) -> bool {
        self.found.verdict.ltv && self.found.verdict.lti
    }

    /// Returns the meaning of a negative verdict, with advice.
    pub fn complaint(&self) -> String {
        let Validation { t, chart, verdict, .. } = &self.found;
        let t = significant(*t, 9);
        let help = if verdict.ltv && chart == "frozen" {
            "take --chart intrinsic, mass_orthogonal or names of independent coordinates"
        } else {
            "try another --horizon or --along; equations of one's own may have wrong derivatives"
        };
        format!("{} at t = {t} s, chart {chart}: {}\n  help: {help}", self.scene, verdict.text)
    }
}

impl Answer for ValidationAnswer<'_> {
    /// Returns the first direction at the top level, and all of them in `directions`.
    fn json(&self) -> impl Serialize {
        let Validation { frozen, sequences, measured, .. } = &self.found;
        let first = sequences.first();
        json!({
            "scene": self.scene,
            "t": self.found.t,
            "chart": self.found.chart,
            "followed": self.found.followed,
            "singular": self.found.singular,
            "event": self.found.event,
            "epsilons": first.map_or(&[][..], |sequence| &sequence.epsilons),
            "rate": self.found.rate,
            "errors_ltv": first.map_or(&[][..], |sequence| &sequence.errors_ltv),
            "order_ltv": first.and_then(|sequence| sequence.order_ltv.order),
            "errors_lti": first.map_or(&[][..], |sequence| &sequence.errors_lti),
            "horizons": first.map_or(json!({}), horizons),
            "verdict": self.found.verdict,
            "a": measured.a,
            "b": measured.b,
            "c": measured.c,
            "d": measured.d,
            "unjudged": measured.unjudged,
            "directions": sequences.iter().map(|sequence| direction(self.names, sequence)).collect::<Vec<Value>>(),
            "frozen": { "steps": frozen.steps, "errors": frozen.errors, "decay": frozen.decay, "limit": frozen.limit },
            "inputs": self.found.inputs,
            "unchecked_inputs": self.found.unchecked,
        })
    }

    fn text(&self) -> String {
        let found = &self.found;
        let mut table = TextTable::new(&["perturbation", "order in eps", "decades", "1 % after (s)", "10 % after (s)"]);
        for sequence in &found.sequences {
            let end = sequence.times.last().map_or(found.followed, |t| t.min(found.followed));
            let [one, ten] = sequence
                .horizons
                .map(|time| time.map_or(format!("> {}", significant(end, 3)), |time| significant(time, 4)));
            table.row([sequence.direction.clone(), order(&sequence.order_ltv), decades(&sequence.order_ltv), one, ten]);
            if let Some(EventPassage { t, order: decay, .. }) = &sequence.passage {
                let name = format!("{} up to t = {} s", sequence.direction, significant(*t, 6));
                table.row([name, order(decay), decades(decay), String::new(), String::new()]);
            }
        }
        for input in &found.inputs {
            let lti = format!("{:.1e} (frozen)", input.error_lti);
            let name = format!("pulse of {}, {} s", input.input, significant(input.width, 3));
            table.row([name, order(&input.order_ltv), decades(&input.order_ltv), lti, String::new()]);
        }
        let unchecked = match found.unchecked.as_slice() {
            [] => String::new(),
            names => format!("  not checked, since they move no degree of freedom: {}\n", names.join(", ")),
        };
        let kinks = unjudged(found, Reason::Kink, "not measured, since they have a kink at this state");
        let hidden = unjudged(found, Reason::Hidden, "not judged, since an entry is not known to 3 %");
        let singular = found.singular.map_or(String::new(), |t| {
            let t = significant(t, 6);
            format!(" (half of the way to t = {t} s, where the mechanism is singular: linear models end there)")
        });
        let event = found.event.as_ref().map_or(String::new(), |event| {
            let t = significant(event.t, 6);
            format!(" (before t = {t} s, where {} changes its form)", event.owner)
        });
        format!(
            "{} at t = {} s: the linear model (chart {}) against simulations over {} s{singular}{event}\n\n{table}{unchecked}{kinks}{hidden}\n  exp(A h) against the state-transition matrix: order {} in h\n  verdict: {}\n",
            self.scene,
            significant(found.t, 9),
            found.chart,
            significant(found.followed, 3),
            order(&found.frozen.decay),
            found.verdict.text.replace("; ", ";\n           ")
        )
    }

    fn write(&self, folder: &mut Folder, stem: &str) -> Result<()> {
        for (i, sequence) in self.found.sequences.iter().enumerate() {
            let t = significant(self.found.t, 6);
            let title = format!("{}, perturbed at t = {t} s ({})", self.scene, sequence.direction);
            let name = if i == 0 { stem.to_string() } else { format!("{stem}-{}", i + 1) };
            folder.figure(&name, validation_figure(&title, self.names, sequence))?;
        }
        Ok(())
    }
}

/// Returns a line with the states and outputs that are not judged for a reason; empty where there are none.
fn unjudged(found: &Validation, reason: Reason, text: &str) -> String {
    let own = found.measured.unjudged.iter().filter(|row| row.reason == reason);
    let names: Vec<&str> = own.map(|row| row.row.as_str()).collect();
    if names.is_empty() { String::new() } else { format!("  {text}: {}\n", names.join(", ")) }
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

fn horizons(sequence: &PerturbationSequence) -> Value {
    let [one, ten] = sequence.horizons;
    json!({ "1%": one, "10%": ten })
}

fn direction(names: &Names, sequence: &PerturbationSequence) -> Value {
    let curves = sequence.curves.iter().map(|curve| {
        json!({ "velocity": names.v[curve.direction], "simulated": curve.simulated, "ltv": curve.ltv, "lti": curve.lti })
    });
    json!({
        "direction": sequence.direction,
        "epsilons": sequence.epsilons,
        "errors_ltv": sequence.errors_ltv,
        "order_ltv": sequence.order_ltv,
        "errors_lti": sequence.errors_lti,
        "times": sequence.times,
        "relative_error_lti": sequence.drift_lti,
        "horizons": horizons(sequence),
        "curve_epsilon": sequence.curve_epsilon,
        "curves": curves.collect::<Vec<Value>>(),
        "passage": sequence.passage,
    })
}

/// Draws the errors over epsilon with a line of slope 2; then, for each unit, the curves that move most over time with
/// both predictions, and how far these are off. `None` where there is neither.
pub fn validation_figure(title: &str, names: &Names, sequence: &PerturbationSequence) -> Option<Figure> {
    let name = |curve: &ChangeCurve| names.v[curve.direction].trim_end_matches('\'');
    let curves = sequence
        .curves
        .iter()
        .filter(|_| sequence.times.len() > 1)
        .map(|curve| (name(curve), unit(name(curve)), curve));
    let groups = grouped(curves, |(_, unit, _)| *unit);
    let deviations = groups.iter().flat_map(|members| deviation_panels(members, &sequence.times));
    let panels: Vec<Panel> = order_panel(sequence).into_iter().chain(deviations).collect();
    (!panels.is_empty()).then(|| Figure { panels, ..Figure::new().title(title) })
}

/// Returns the unit of a change along a velocity direction, from its name; empty where that does not tell.
fn unit(name: &str) -> &'static str {
    match () {
        _ if ["angle", "wx", "wy", "wz", "rx", "ry", "rz"].iter().any(|end| name.ends_with(end)) => "rad",
        _ if [".x", ".y", ".z"].iter().any(|end| name.ends_with(end)) => "m",
        _ => "",
    }
}

fn order_panel(sequence: &PerturbationSequence) -> Option<Panel> {
    let pairs = |errors: &[f64]| -> Vec<(f64, f64)> {
        let pairs = sequence.epsilons.iter().copied().zip(errors.iter().copied());
        pairs.filter(|(epsilon, error)| *epsilon > 0.0 && *error > 0.0).collect()
    };
    let ltv = pairs(&sequence.errors_ltv);
    let lti = pairs(&sequence.errors_lti);
    let errors = AxisSpec::from("error of the change at the end").log();
    let mut panel = Panel::new(AxisSpec::from("perturbation ε").log(), errors);
    // The line of slope 2 is below the errors, through the largest perturbation.
    let largest = ltv.iter().chain(&lti).map(|point| point.0).fold(0.0, f64::max);
    let smallest = ltv.iter().chain(&lti).map(|point| point.0).fold(largest, f64::min);
    let anchor = ltv.iter().chain(&lti).filter(|point| point.0 == largest).map(|point| point.1).reduce(f64::min)?;
    let guide = |epsilon: f64| (epsilon, 0.3 * anchor * (epsilon / largest).powi(2));
    for (label, points, color) in [("LTV (along the motion)", ltv, 0), ("LTI (frozen)", lti, 1)] {
        if !points.is_empty() {
            panel = panel.series(Series::line(label, points).style(Style::LineDots).color(color));
        }
    }
    Some(panel.series(Series::line("slope 2", vec![guide(smallest), guide(largest)]).style(Style::Guide)))
}

/// The change along one direction: its name, its unit and its curves.
type Member<'a> = (&'a str, &'static str, &'a ChangeCurve);

/// Draws the changes of one unit over time, and below how far the predictions are off.
fn deviation_panels(members: &[Member], times: &[f64]) -> [Panel; 2] {
    let (name, unit, _) = members[0];
    let what = if members.len() == 1 { name } else { quantity(unit) };
    let time = "time since the state (s)";
    let line = |name: String, values: &[f64]| Series::line(name, times.iter().copied().zip(values.to_vec()).collect());
    let mut changes = Panel::new(time, label(&format!("change of {what}"), unit));
    let mut errors = Panel::new(time, AxisSpec::from(label("difference", unit)).log());
    let drawn = drawn(members);
    for (i, (first, hidden)) in drawn.iter().enumerate() {
        let name = if members.len() == 1 { "simulated".to_string() } else { names(first, hidden) };
        changes = changes.series(line(name, &first.2.simulated).color(i));
    }
    for (i, ((name, _, curve), hidden)) in drawn.iter().enumerate() {
        // The styles mean the same for all members: one legend entry for each is enough.
        let once = |name: String| if i == 0 { name } else { String::new() };
        let colors = if drawn.len() == 1 { [1, 2] } else { [i, i] };
        let predictions =
            [("LTV", &curve.ltv, Style::Dashed, colors[0]), ("LTI", &curve.lti, Style::Dotted, colors[1])];
        for (method, values, style, color) in predictions {
            let off = line(once(format!("|{method} − simulated|")), &difference(values, &curve.simulated));
            changes = changes.series(line(once(format!("predicted, {method}")), values).style(style).color(color));
            errors = errors.series(off.style(style).color(color));
        }
        for (other, _, hidden) in hidden.iter().filter(|hidden| !are_equal(curve, hidden.2)) {
            let off = line(format!("|{other} − {name}|"), &difference(&hidden.simulated, &curve.simulated));
            errors = errors.series(off.style(Style::Thin).color(i));
        }
    }
    let size = members.iter().map(|member| largest(&member.2.simulated)).fold(0.0, f64::max);
    [changes, Floor::of(size).cut(errors)]
}

/// Returns the members that are drawn, each with those that it hides.
fn drawn<'m>(members: &'m [Member<'m>]) -> Vec<(&'m Member<'m>, Vec<&'m Member<'m>>)> {
    let mut drawn: Vec<(&Member, Vec<&Member>)> = Vec::new();
    for member in members {
        // The width of a line is about a hundredth of the height of its panel.
        match drawn.iter_mut().find(|(first, _)| are_within(0.01, first.2, member.2)) {
            Some((_, hidden)) => hidden.push(member),
            None => drawn.push((member, Vec::new())),
        }
    }
    drawn
}

/// Returns the names of a member and of those that it hides, as `a = b` if they are equal.
fn names(first: &Member, hidden: &[&Member]) -> String {
    let name = |member: &&Member| {
        let sign = if are_equal(first.2, member.2) { " = " } else { ", " };
        format!("{sign}{}", member.0)
    };
    first.0.to_string() + &hidden.iter().map(name).collect::<String>()
}

/// Returns |a - b| at each time.
fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).collect()
}

/// True if all lines of two directions differ by this part of their size at most.
fn are_within(part: f64, a: &ChangeCurve, b: &ChangeCurve) -> bool {
    let most = part * largest(&a.simulated);
    let pairs = [(&a.simulated, &b.simulated), (&a.ltv, &b.ltv), (&a.lti, &b.lti)];
    pairs.into_iter().all(|(a, b)| largest(&difference(a, b)) <= most)
}

fn are_equal(a: &ChangeCurve, b: &ChangeCurve) -> bool {
    are_within(tolerances::SAME, a, b)
}
