//! States at which constraints that are independent nearby depend on each other.

use super::{LinearizationPoint, Matrix};
use crate::error::{Error, Result, short};
use crate::formulation::Dynamics;
use crate::initial::assemble;
use crate::math::largest;
use crate::system::{MechanicalSystem, Need};

/// The rank indicator at which a state is looked at before it is linearized. Unit: `[1]`. Why: the square of its
/// inverse times rounding, of the state as well, is a part of the accelerations: 1e-4 beside a fold, whatever the
/// chart. Test: `singular_states`.
const SINGULAR_MODEL: f64 = 1e-5;

/// True if rows of G are dependent, or nearly so: at a singular state, and where constraints are redundant.
pub(super) fn is_suspect(dynamics: &Dynamics) -> bool {
    let here = Rank::of(dynamics);
    here.rank < dynamics.lambda.len() || here.rank_indicator < SINGULAR_MODEL
}

/// Refuses a singular state, and states so near to one that their accelerations are uncertain: with fewer independent
/// constraints than a nearby state, or rows that are much closer to being dependent. There the motions that the
/// constraints allow cross, and the spectrum along all directions of both belongs to no motion. Redundant constraints
/// are dependent at the nearby state as well, and pass.
///
/// # Errors
/// The state is singular.
pub(super) fn refuse(dynamics: &Dynamics, point: &LinearizationPoint, directions: &Matrix) -> Result<()> {
    let here = Rank::of(dynamics);
    let Some(beside) = rank_nearby(dynamics.system, point, directions) else { return Ok(()) };
    let t = short(point.t);
    // Beside others it is about the same.
    let is_near = here.rank_indicator < SINGULAR_MODEL && beside.rank_indicator > 1e2 * here.rank_indicator;
    let problem = if beside.rank > here.rank {
        format!("only {} constraints are independent, {} beside it", here.rank, beside.rank)
    } else if is_near {
        "constraints are nearly dependent, and less so beside it".to_string()
    } else {
        return Ok(());
    };
    Err(Error::input(format!(
        "singular state: at t = {t} s {problem}, so motions cross here and have no common linear model"
    ))
    .hint("choose another time, a little before or after, or change the state"))
}

/// Rank of G.
struct Rank {
    rank: usize,
    /// See [`SaddlePoint::kept_indicator`](crate::math::kkt::SaddlePoint::kept_indicator): redundant rows hide no others.
    rank_indicator: f64,
}

impl Rank {
    fn of(dynamics: &Dynamics) -> Self {
        Rank { rank: dynamics.kkt.rank(), rank_indicator: dynamics.kkt.kept_indicator() }
    }
}

/// Returns the rank of G at a nearby state, along all free directions at a time; none where there is no such state.
fn rank_nearby(system: &dyn MechanicalSystem, point: &LinearizationPoint, directions: &Matrix) -> Option<Rank> {
    let mut direction = vec![0.0; directions.nrows()];
    for (k, column) in directions.column_iter().enumerate() {
        // Weights differ, so that no symmetry of a mechanism keeps it singular.
        let part = 1.0 + (1.0 + k as f64).sin() / 2.0;
        direction.iter_mut().zip(column.iter()).for_each(|(sum, x)| *sum += part * x);
    }
    let mut dynamics = Dynamics::new(system);
    dynamics.solve(point.t, &point.q, &direction, |_, _| 0.0).ok()?;
    dynamics.evaluate(point.t, &point.q, &direction, Need::L);
    // Gd = d(G v + phi_t)/dq is the rate of G along v.
    let slope = largest(&dynamics.terms.l);
    let size = largest(&dynamics.terms.g);
    if slope <= 0.0 {
        return None;
    }
    let mut rate = vec![0.0; point.q.len()];
    system.rate(&point.q, &direction, &mut rate);
    // Far beyond TRUNCATED_RANK, and near enough to be the same assembly.
    let step = 0.02 * size / slope;
    let mut moved: Vec<f64> = point.q.iter().zip(&rate).map(|(q, rate)| q + step * rate).collect();
    system.normalize(&mut moved);
    let beside = assemble(system, point.t, (&moved, &point.v), &[]).ok()?;
    dynamics.solve(point.t, &beside.q, &beside.v, |_, _| 0.0).ok()?;
    Some(Rank::of(&dynamics))
}
