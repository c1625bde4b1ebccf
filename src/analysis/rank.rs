//! Rank and redundancy of the constraints at a state.

use crate::formulation::Dynamics;
use crate::math::kkt::{Dependence, dependent_rows};
use crate::math::largest;
use crate::simulate::{SpectralMode, Spectrum};
use crate::system::{Group, MechanicalSystem, Need, OperatingPoint, Structure, Terms};
use crate::tolerances::{RANK, UNSEEN};
use serde::Serialize;

/// Rank of the constraints and conditioning at a state.
#[derive(Clone, Debug)]
pub struct Rank {
    /// Rank of G.
    pub rank: usize,
    /// Rank of G at a nearby state: higher where this one is singular.
    pub nearby: usize,
    /// Dependent rows of G, with their joints.
    pub redundant: Vec<Redundant>,
    /// Condition number of the equilibrated saddle-point matrix without the redundant rows.
    pub condition: f64,
    /// The smallest sine between a row of G and those before it, in the metric of M^-1, without the redundant rows: 1
    /// is far from losing rank, 0 a singular state.
    pub distance_to_singularity: f64,
    /// Largest and smallest entry on the diagonal of M, kg or kg m^2.
    pub mass_range: [f64; 2],
    /// The fastest mode, 1/s; none without degrees of freedom.
    pub fastest_mode: Option<SpectralMode>,
}

/// A redundant row of G.
#[derive(Clone, Debug, Serialize)]
pub struct Redundant {
    /// Name of its joint.
    pub joint: String,
    /// Name of the row.
    pub row: String,
    /// The joints on whose rows it depends.
    pub follows_from: Vec<String>,
}

impl Rank {
    /// Rank at a consistent state.
    pub fn at(system: &dyn MechanicalSystem, state: OperatingPoint) -> Self {
        let OperatingPoint { t, q, v, .. } = state;
        let mut dynamics = Dynamics::new(system);
        dynamics.evaluate(t, q, v, Need::DYNAMICS);
        let (rows, _) = dynamics.dependent_rows(t, q, v);
        dynamics.drop_rows(&rows);
        // A consistent state can be factored; the indicator is zero where it could not.
        let distance = dynamics.factor().map_or(0.0, |()| dynamics.kkt.rank_indicator());
        let terms = &dynamics.terms;
        let structure = &dynamics.structure;
        let all = system.dimensions().lambda;
        // The search for the rows that a row depends on is dense: it runs only where some are dependent.
        let (nearby, dependence) = if rows.is_empty() {
            (all, Dependence { rank: all, rows: Vec::new() })
        } else {
            (all - dependent_nearby(system, t, q).len(), dependent_rows(&structure.g, &terms.g, RANK))
        };
        let groups = system.facts().groups();
        let names = system.facts().names.lambda.clone();
        let redundant = dependence.rows.iter().map(|row| {
            let others = row.combination.iter().map(|(other, _)| owner(&groups, *other));
            redundant(&names[row.row], owner(&groups, row.row), others)
        });
        Rank {
            rank: dependence.rank,
            nearby,
            redundant: redundant.collect(),
            condition: dynamics.kkt.condition_number(&terms.mass, &terms.g),
            distance_to_singularity: distance,
            mass_range: mass_range(structure, terms),
            fastest_mode: Spectrum::at(system, state).and_then(|spectrum| spectrum.modes.last().copied()),
        }
    }
}

fn owner(groups: &[Group], row: usize) -> String {
    groups.iter().find(|group| group.rows.contains(&row)).map_or(String::new(), |group| group.name.clone())
}

fn redundant(name: &str, joint: String, others: impl Iterator<Item = String>) -> Redundant {
    let mut follows_from: Vec<String> = others.filter(|other| *other != joint).collect();
    follows_from.sort();
    follows_from.dedup();
    let row = name.rsplit('.').next().unwrap_or_default().to_string();
    Redundant { joint, row, follows_from }
}

fn mass_range(structure: &Structure, terms: &Terms) -> [f64; 2] {
    let entries = structure.mass.entries.iter().zip(&terms.mass);
    let diagonal = entries.filter(|((i, j), _)| i == j).map(|(_, mass)| *mass);
    let range = diagonal.fold([f64::INFINITY, 0.0], |[low, high], mass| [mass.min(low), mass.max(high)]);
    if range[0].is_finite() { range } else { [0.0, 0.0] }
}

/// Returns the rows of G that depend on others at a state near the given one, in a generic direction that the
/// constraints allow.
pub fn dependent_nearby(system: &dyn MechanicalSystem, t: f64, q: &[f64]) -> Vec<usize> {
    let mut dynamics = Dynamics::new(system);
    let n = system.dimensions();
    let rest = vec![0.0; n.v];
    let mut step = vec![0.0; n.v];
    let mut rate = vec![0.0; n.q];
    let mut aside = q.to_vec();
    step.iter_mut().enumerate().for_each(|(i, x)| *x = (1.0 + 0.7 * i as f64 * (i as f64 + 3.0)).sin());
    dynamics.evaluate(t, q, &rest, Need::MASS | Need::CONSTRAINTS | Need::G);
    // [M G^T; G 0] [d; .] = [r; 0]: an arbitrary force gives a displacement d that the constraints allow.
    if dynamics.factor().is_err() || dynamics.kkt.solve(&mut step, &mut vec![0.0; n.lambda]).is_err() {
        return Vec::new();
    }
    let size = largest(&step).max(f64::MIN_POSITIVE);
    step.iter_mut().for_each(|x| *x *= UNSEEN / size);
    // Newton's steps to the constraints of the nearby state.
    for sweep in 0..=8 {
        system.rate(&aside, &step, &mut rate);
        let sign = if sweep == 0 { 1.0 } else { -1.0 };
        aside.iter_mut().zip(&rate).for_each(|(q, rate)| *q += sign * rate);
        system.normalize(&mut aside);
        dynamics.evaluate(t, &aside, &rest, Need::MASS | Need::CONSTRAINTS | Need::G);
        if dynamics.factor().is_err() || dynamics.kkt.solve_projection(&dynamics.terms.phi, &mut step).is_err() {
            return Vec::new();
        }
    }
    dynamics.dependent_rows(t, &aside, &rest).0
}
