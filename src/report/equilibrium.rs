//! The report of `check --static`.

use super::table::{OutputValues, named};
use crate::analysis::Range;
use crate::error::{Warning, clock, significant};
use crate::initial::{Equilibrium, Stability, Way};
use crate::prepared::PreparedScene;
use crate::system::{Column, OperatingPoint, Scratch};
use crate::tolerances::report as tolerances;
use serde::Serialize;
use serde_json::{Map, Value};

/// The static equilibrium, or the fact that none was found.
#[derive(Clone, Debug, Default, Serialize)]
pub struct EquilibriumFile {
    /// True if an equilibrium was found.
    pub converged: bool,
    /// Time for expressions of t, s.
    pub t: f64,
    /// Method that found it; none without an equilibrium.
    pub method: Option<Way>,
    /// Linear systems solved, over all methods tried.
    pub iterations: usize,
    /// Steps of the load or of the descent, over all methods tried.
    pub steps: usize,
    /// max |f - G^T lambda|, N or N m.
    pub residual: Option<f64>,
    /// max |phi| over the scene's scale.
    pub gap: Option<f64>,
    /// Coordinates by name.
    pub q: Map<String, Value>,
    /// States by name.
    #[serde(skip_serializing_if = "Map::is_empty")]
    pub states: Map<String, Value>,
    /// Multipliers by name.
    pub lambda: OutputValues,
    /// Outputs by name.
    pub outputs: OutputValues,
    /// True if stable. None where that is not known, or where no force acts on the coordinates in `free`.
    pub stable: Option<bool>,
    /// Class of the stability.
    pub stability: Option<Stability>,
    /// Coordinates that can move without a restoring force.
    pub free: Vec<String>,
    /// Warnings of the search.
    pub warnings: Vec<Warning>,
    /// Coordinates that differ from the start: name, from, to.
    #[serde(skip)]
    moves: Vec<(String, f64, f64)>,
}

const MOST_MOVES: usize = 10;
/// Largest number of multipliers, and of outputs, in the text.
const MOST: usize = 40;

impl EquilibriumFile {
    /// The report that none was found.
    pub fn none(t: f64) -> EquilibriumFile {
        EquilibriumFile { t, ..EquilibriumFile::default() }
    }

    /// The report of an equilibrium.
    pub fn of(prepared: &PreparedScene, found: Equilibrium) -> EquilibriumFile {
        let system = prepared.system();
        let names = prepared.system().names();
        let columns = system.columns();
        let mut outputs = vec![0.0; columns.len()];
        let vdot = vec![0.0; names.v.len()];
        let at = OperatingPoint { t: found.t, q: &found.q, v: &found.v, vdot: &vdot, lambda: &found.lambda };
        system.outputs(at, &mut outputs, &mut Scratch::default());
        let n = system.dimensions();
        let start = prepared.start();
        let states = names.v[n.moving()..].iter().zip(start.1.iter().zip(&found.v).skip(n.moving()));
        let pairs = names.q.iter().zip(start.0.iter().zip(&found.q)).chain(states.clone());
        let moved = pairs.filter(|(_, (from, to))| (*to - *from).abs() > tolerances::SAME * (1.0 + from.abs()));
        let mut moves: Vec<_> = moved.map(|(name, (&from, &to))| (name.clone(), from, to)).collect();
        moves.sort_by(|a, b| (b.2 - b.1).abs().total_cmp(&(a.2 - a.1).abs()));
        EquilibriumFile {
            converged: true,
            t: found.t,
            method: Some(found.way),
            iterations: found.iterations,
            steps: found.steps,
            residual: Some(found.residual),
            gap: Some(found.gap),
            states: named(&names.v[n.moving()..], &found.v[n.moving()..]),
            q: named(&names.q, &found.q),
            lambda: OutputValues::new(without_units(names.lambda), found.lambda),
            outputs: OutputValues::new(columns, outputs),
            stable: match found.stability {
                Stability::Stable => Some(true),
                Stability::Unstable => Some(false),
                _ => None,
            },
            stability: Some(found.stability),
            free: found.free,
            moves,
            warnings: Range::warnings_at(system, found.t, &found.q),
        }
    }

    /// Returns the report as text.
    pub fn text(&self) -> String {
        let (Some(way), Some(stability)) = (self.method, self.stability) else {
            return format!("\nno static equilibrium at t = {} s\n", clock(self.t));
        };
        let mut text = format!(
            "\nstatic equilibrium at t = {} s, {}\n  by {}: {} linear systems{}, force left {:.1e} (N, N m), |phi| {:.1e}\n",
            self.t,
            self.stability_text(stability),
            match way {
                Way::Newton => "Newton's method",
                Way::DampedNewton => "Newton's method, damped",
                Way::Homotopy => "taking the missing force away in steps",
                Way::Descent => "descent along the forces",
            },
            self.iterations,
            if self.steps > 0 { format!(" in {} steps", self.steps) } else { String::new() },
            self.residual.unwrap_or_default(),
            self.gap.unwrap_or_default()
        );
        for (name, from, to) in self.moves.iter().take(MOST_MOVES) {
            let from = significant(*from, 8);
            let to = significant(*to, 8);
            text += &format!("  moved {name}: {from} -> {to}\n");
        }
        if self.moves.len() > MOST_MOVES {
            text += &format!("  and {} smaller moves\n", self.moves.len() - MOST_MOVES);
        }
        text + &self.lambda.text("multiplier there", 8, MOST) + &self.outputs.text("output there", 8, MOST)
    }

    fn stability_text(&self, stability: Stability) -> String {
        match stability {
            Stability::Stable => "stable".to_string(),
            Stability::Unstable => "UNSTABLE: a start nearer to another one finds that".to_string(),
            Stability::Neutral => format!("neutral: nothing holds {}", self.free.join(", ")),
            Stability::Unknown => {
                "of unknown stability: too many coordinates, or forces or states without a potential".to_string()
            }
        }
    }
}

fn without_units(names: Vec<String>) -> Vec<Column> {
    names.into_iter().map(|name| Column { name, unit: String::new() }).collect()
}
