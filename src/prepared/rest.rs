//! A start from rest.

use crate::error::{Result, Warning};
use crate::initial::{Assembly, Stability, assemble, equilibrium};
use crate::math::largest;
use crate::system::MechanicalSystem;

/// The static equilibrium that belongs to an assembled start, with the least velocities that drives prescribe, and
/// warnings where it may not be the one that is meant.
///
/// # Errors
/// No equilibrium is found: see [`equilibrium`].
pub fn at_rest(system: &dyn MechanicalSystem, t: f64, start: &Assembly) -> Result<(Assembly, Vec<Warning>)> {
    let found = equilibrium(system, t, (&start.q, &start.v)).map_err(|error| error.under("--equilibrium"))?;
    let rest = assemble(system, t, (&found.q, &found.v), &[])?;
    let unstable = (found.stability == Stability::Unstable).then(|| {
        Warning::new(
            "the static equilibrium that belongs to the start is unstable",
            "`holonom check --static` shows it; a start nearer to another one finds that",
        )
    });
    let driven = (largest(&rest.v[..system.dimensions().moving()]) > 0.0).then(|| {
        Warning::new(
            "drives move at the start: the equilibrium is that with the drives held where they are",
            "a motion from rest needs a drive that begins slowly, such as by smoothstep",
        )
    });
    let warnings = unstable.into_iter().chain(driven).collect();
    Ok((Assembly { before: start.before, moves: start.moves.clone(), ..rest }, warnings))
}
