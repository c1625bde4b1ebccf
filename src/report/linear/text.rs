//! Text on a linear model, and on several.

use super::NamedModel;
use super::notes::notes;
use crate::error::{short, significant};
use crate::linearize::{Comparison, Kind, LinearModel, LinearizationPoint, ModePair, pairs};
use crate::report::table::count;
use crate::report::tables::TableColumn;
use crate::report::{Answer, TextTable};
use serde::Serialize;
use serde_json::json;

/// Bodies with at least a twentieth of a mode's energy are named, at most so many.
const MOST_NAMED: usize = 3;

/// Names the states of inputs, where there are some.
fn input_states(model: &LinearModel) -> String {
    let count: usize = model.orders.iter().sum();
    let names = &model.states[model.states.len() - count.min(model.states.len())..];
    match names {
        [] => String::new(),
        names => format!("  the last states belong to inputs, and have no eigenvalue here: {}\n", names.join(", ")),
    }
}

impl NamedModel<'_> {
    /// Returns method, chart and state, then the modes.
    pub fn text(&self) -> String {
        let model = self.model;
        let sizes = [(&model.states, "state"), (&model.inputs, "input"), (&model.outputs, "output")];
        let sizes = sizes.map(|(all, noun)| count(all.len(), noun)).join(", ");
        let form = if model.e.is_some() { "E x' = A x + B u" } else { "x' = A x + B u" };
        format!(
            "{} at t = {} s: linear model by {}, {form}, {sizes}\n  {}\n{}{}\n{}",
            self.scene,
            significant(model.point.t, 9),
            model.method,
            chart(&model.chart, &model.point),
            self.state_text(),
            input_states(model),
            modes_text(model, &self.bodies(), &self.names.v)
        )
    }

    /// Returns the body of each velocity direction.
    fn bodies(&self) -> Vec<&str> {
        self.names.v.iter().map(|name| name.rsplit_once('.').map_or(name.as_str(), |(body, _)| body)).collect()
    }

    fn state_text(&self) -> String {
        let norms = self.norms();
        let residual = format!("|phi| {:.1e}, |phi'| {:.1e}", norms.phi, norms.phi_dot);
        let point = &self.model.point;
        match (point.is_equilibrium, &point.axes, &point.driven) {
            (true, Some(spin), _) => format!(
                "  a steady rotation at {} rad/s about ({}) through ({}) m; {residual}\n",
                short(spin.speed()),
                joined(&spin.velocity.map(|w| w / spin.speed())),
                joined(&spin.point)
            ),
            (true, None, _) => format!("  an equilibrium: v = 0, v' = 0; {residual}\n"),
            (false, _, driven) => {
                let moving = format!("|v| {}, |v'| {}; {residual}", short(norms.v), short(norms.vdot));
                let hint = driven.map_or(String::new(), |spin| {
                    let speed = short(spin.speed());
                    format!("  a drive turns at {speed} rad/s: --equilibrium looks at it in axes that turn along\n")
                });
                format!("  not an equilibrium: {moving}\n{hint}")
            }
        }
    }
}

fn joined(numbers: &[f64]) -> String {
    numbers.iter().map(|x| short(*x)).collect::<Vec<_>>().join(", ")
}

/// Returns the meaning of the chart for the eigenvalues.
fn chart(name: &str, point: &LinearizationPoint) -> String {
    if point.is_equilibrium && point.axes.is_some() {
        return format!(
            "chart {name}, in axes that turn along, in which this is an equilibrium: all charts have the same \
             eigenvalues, and the world sees the frequencies more or less by the speed"
        );
    }
    if point.is_equilibrium {
        return format!("chart {name}; at an equilibrium all charts have the same eigenvalues");
    }
    match name {
        "intrinsic" => {
            "chart intrinsic: axes carried along with the motion without turning, so the frozen eigenvalues \
                        depend on no choice of coordinates; they are frozen at this instant, and say of a motion \
                        that is steady in other axes nothing"
                .to_string()
        }
        "mass_orthogonal" => "chart mass_orthogonal: fixed axes, in the mass metric square to what the constraints \
                              hold; off equilibrium the frozen eigenvalues belong to this choice"
            .to_string(),
        "frozen" => {
            "chart frozen: all matrices held as they are at this instant; off equilibrium these eigenvalues are \
                     one answer among many, not a property of the motion"
                .to_string()
        }
        "modal" => "chart modal: some modes of all matrices held as they are at this instant (the frozen pencil); off \
                    equilibrium they belong to these coordinates and equations: compare --method mcs"
            .to_string(),
        "redundant" => "all coordinates, matrices held as they are at this instant; off equilibrium the eigenvalues \
                        belong to these coordinates and equations: compare --method mcs"
            .to_string(),
        names => format!(
            "chart {names}: perturbations counted in {}; off equilibrium other coordinates give other eigenvalues",
            if names.contains(',') { "these independent coordinates" } else { "this independent coordinate" }
        ),
    }
}

fn modes_text(model: &LinearModel, bodies: &[&str], names: &[String]) -> String {
    let headings =
        ["mode", "re (1/s)", "im (1/s)", "frequency (Hz)", "damping ratio", "kind", "moves (% of kinetic energy)"];
    let mut table = TextTable::new(&headings).words(5).words(6);
    let mut number = 0;
    let mut left_out = Vec::new();
    let mut listed = Vec::new();
    for (kind, most) in [(Kind::Physical, 30), (Kind::Uncertain, 30), (Kind::Spurious, 10)] {
        let found = pairs(model, kind);
        for pair in &found[..found.len().min(most)] {
            number += 1;
            table.row(cells(model, bodies, number, pair));
            listed.push((number, *pair));
        }
        number += found.len().saturating_sub(most);
        if found.len() > most {
            left_out.push(format!("  {} more {} in the files\n", found.len() - most, kind.name()));
        }
    }
    let infinite = model.modes.iter().filter(|mode| mode.kind == Kind::Infinite).count();
    if infinite > 0 {
        left_out.push(format!("  {infinite} infinite: algebraic equations of the descriptor form\n"));
    }
    match number {
        0 => format!("  no finite eigenvalues\n{}", left_out.concat()),
        _ => format!("{table}{}{}", left_out.concat(), notes(model, &listed, names)),
    }
}

fn cells(model: &LinearModel, bodies: &[&str], number: usize, pair: &ModePair) -> [String; 7] {
    let mode = pair.mode;
    let value = pair.mode.value;
    let imaginary =
        if pair.is_pair { format!("+-{}", significant(value.im.abs(), 6)) } else { significant(value.im, 6) };
    let numbers =
        [significant(value.re, 6), imaginary, significant(mode.frequency(), 5), significant(mode.clean_damping(), 4)];
    // Digits of rounding are none.
    let numbers = if mode.is_zero() { ["0", "0", "0", "-"].map(str::to_string) } else { numbers };
    let [re, im, frequency, damping] = numbers;
    let kind = match mode.kind {
        Kind::Physical if !model.is_comparable() => "frozen, not comparable",
        _ if mode.is_rigid_body() => "physical, rigid body",
        kind => kind.name(),
    };
    let kind = kind.to_string();
    let moves = movers(bodies, &mode.energy);
    [number.to_string(), re, im, frequency, damping, kind, moves]
}

/// Returns the bodies with the largest parts of the energy, in percent: `crank 62, rocker 38`.
fn movers(bodies: &[&str], energy: &[f64]) -> String {
    let mut sums: Vec<(&str, f64)> = Vec::new();
    for (&body, part) in bodies.iter().zip(energy) {
        match sums.iter_mut().find(|(known, _)| *known == body) {
            Some((_, sum)) => *sum += part,
            None => sums.push((body, *part)),
        }
    }
    sums.sort_by(|a, b| b.1.total_cmp(&a.1));
    let large = sums.iter().filter(|(_, sum)| *sum >= 0.05);
    let words: Vec<String> =
        large.clone().take(MOST_NAMED).map(|(name, sum)| format!("{name} {:.0}", 100.0 * sum)).collect();
    let more = if large.count() > MOST_NAMED { ", ..." } else { "" };
    words.join(", ") + more
}

pub struct MethodsAnswer {
    pub t: f64,
    pub is_equilibrium: bool,
    pub methods: Vec<Comparison>,
}

impl Answer for MethodsAnswer {
    fn json(&self) -> impl Serialize {
        json!({ "t": self.t, "methods": self.methods })
    }

    fn text(&self) -> String {
        format!("\n{}", comparison_text(&self.methods, self.is_equilibrium))
    }
}

/// Returns one line for each method, the reference first.
pub fn comparison_text(rows: &[Comparison], is_equilibrium: bool) -> String {
    let columns: [TableColumn<Comparison>; 11] = [
        ("method", |row| row.method.clone()),
        ("chart", |row| row.chart.clone()),
        ("against first", |row| row.error.map_or("-".to_string(), |error| format!("{error:.1e}"))),
        ("physical", |row| row.physical.to_string()),
        ("spurious", |row| row.spurious.to_string()),
        ("infinite", |row| row.infinite.to_string()),
        ("off constraints", |row| row.off_constraints.map_or("-".to_string(), |[a, b]| format!("{a:.0e} / {b:.0e}"))),
        ("conditioning", |row| row.conditioning.map_or("-".to_string(), |condition| significant(condition, 2))),
        ("size", |row| row.size.to_string()),
        ("matrices (us)", |row| significant(row.assembly_microseconds, 3)),
        ("eigenvalues (us)", |row| significant(row.eigen_microseconds, 3)),
    ];
    let table = TextTable::of(&columns, rows).words(1);
    let note = if is_equilibrium {
        ""
    } else {
        "  off equilibrium only models in the same chart have the same eigenvalues: those of redundant coordinates and the \
             plain projection (frozen) belong to no chart\n"
    };
    format!(
        "{table}  off constraints: largest part of a physical mode / smallest part of a spurious one that the constraints \
         do not allow\n{note}"
    )
}
