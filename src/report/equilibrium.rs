//! The report of `check --static`.

use super::object;
use super::table::{OutputValues, moves_text, named};
use crate::analysis::ValidityRange;
use crate::error::{Warning, clock};
use crate::initial::{Equilibrium, Move, Stability, Way};
use crate::prepared::Model;
use crate::system::{Column, Names, OperatingPoint};
use crate::tolerances;
use serde::{Serialize, Serializer};

/// The static equilibrium, or the fact that none was found.
#[derive(Clone, Debug, Default)]
pub struct EquilibriumReport {
    /// Time for expressions of t, s.
    t: f64,
    found: Option<Equilibrium>,
    names: Names,
    /// Number of velocities before the states.
    moving: usize,
    lambda: OutputValues,
    outputs: OutputValues,
    moves: Vec<Move>,
    pub warnings: Vec<Warning>,
}

/// Largest number of multipliers, and of outputs, in the text.
const MOST: usize = 40;

impl Serialize for EquilibriumReport {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let found = self.found.as_ref();
        let stability = found.map(|found| found.stability);
        object!(serializer,
            "converged" => found.is_some(),
            "t" => self.t,
            "method" => found.map(|found| found.way),
            "iterations" => found.map_or(0, |found| found.iterations),
            "steps" => found.map_or(0, |found| found.steps),
            "residual" => found.map(|found| found.residual),
            "gap" => found.map(|found| found.gap),
            "q" => named(&self.names.q, found.map_or(&[], |found| &found.q)),
            "states" if self.names.v.len() > self.moving => {
                named(&self.names.v[self.moving..], found.map_or(&[], |found| &found.v[self.moving..]))
            },
            "lambda" => self.lambda,
            "outputs" => self.outputs,
            "stable" => match stability {
                Some(Stability::Stable) => Some(true),
                Some(Stability::Unstable) => Some(false),
                _ => None,
            },
            "stability" => stability,
            "free" => found.map_or(&[][..], |found| &found.free),
            "warnings" => self.warnings,
        )
    }
}

impl EquilibriumReport {
    pub fn none(t: f64) -> EquilibriumReport {
        EquilibriumReport { t, ..EquilibriumReport::default() }
    }

    pub fn of(prepared: &Model, found: Equilibrium) -> EquilibriumReport {
        let system = prepared.system();
        let names = system.facts().names.clone();
        let vdot = vec![0.0; names.v.len()];
        let at = OperatingPoint { t: found.t, q: &found.q, v: &found.v, vdot: &vdot, lambda: &found.lambda };
        let outputs = OutputValues::at(system, at);
        let moving = system.dimensions().moving();
        let (q, v) = prepared.start();
        let states = names.v.iter().zip(v.iter().zip(&found.v)).skip(moving);
        let pairs = names.q.iter().zip(q.iter().zip(&found.q)).chain(states);
        let moved = pairs.filter(|(_, (from, to))| (*to - *from).abs() > tolerances::SAME * (1.0 + from.abs()));
        let change = |(name, (&from, &to)): (&String, (&f64, &f64))| Move { name: name.clone(), from, to };
        let mut moves: Vec<Move> = moved.map(change).collect();
        moves.sort_by(|a, b| (b.to - b.from).abs().total_cmp(&(a.to - a.from).abs()));
        let without_unit = |name: &String| Column { name: name.clone(), unit: String::new() };
        EquilibriumReport {
            t: found.t,
            lambda: OutputValues::new(names.lambda.iter().map(without_unit).collect(), found.lambda.clone()),
            outputs,
            warnings: ValidityRange::warnings_at(system, found.t, &found.q),
            found: Some(found),
            names,
            moving,
            moves,
        }
    }

    pub fn text(&self) -> String {
        let Some(found) = &self.found else {
            return format!("\nno static equilibrium at t = {} s\n", clock(self.t));
        };
        let way = match found.way {
            Way::Newton => "Newton's method",
            Way::DampedNewton => "Newton's method, damped",
            Way::Homotopy => "taking the missing force away in steps",
            Way::Descent => "descent along the forces",
        };
        let Equilibrium { t, iterations, residual, gap, .. } = found;
        let steps = if found.steps > 0 { format!(" in {} steps", found.steps) } else { String::new() };
        let text = format!(
            "\nstatic equilibrium at t = {t} s, {}\n  by {way}: {iterations} linear systems{steps}, force left {residual:.1e} (N, N m), |phi| {gap:.1e}\n",
            stability_text(found)
        );
        let lambda = self.lambda.text("multiplier there", 8, MOST);
        text + &moves_text(&self.moves) + &lambda + &self.outputs.text("output there", 8, MOST)
    }
}

fn stability_text(found: &Equilibrium) -> String {
    match found.stability {
        Stability::Stable => "stable".to_string(),
        Stability::Unstable => "UNSTABLE: a start nearer to another one finds that".to_string(),
        Stability::Neutral => format!("neutral: nothing holds {}", found.free.join(", ")),
        Stability::Unknown => {
            "of unknown stability: too many coordinates, or forces or states without a potential".to_string()
        }
    }
}
