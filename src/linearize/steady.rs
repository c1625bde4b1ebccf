//! Static equilibrium, in the inertial frame or in axes that rotate with the mechanism.

use super::point::rounding;
use super::{Changes, Linear, LinearModel, Matrix, State, Variation};
use crate::error::{Error, Result, Warning, short};
use crate::initial::{assemble, equilibrium};
use crate::math::largest;
use crate::system::{MechanicalSystem, Rotating};
use crate::tolerances;

/// An angle, rad, that is no rational part of a turn: no arrangement of parts around an axis repeats after it.
const ODD_ANGLE: f64 = 1.0;

/// An operating state with the equations it satisfies.
pub struct Operating<'a> {
    /// The state.
    pub state: State,
    inertial: &'a dyn MechanicalSystem,
    /// Rotating axes in which v is expressed; only for a steady rotation.
    axes: Option<Rotating<'a>>,
    /// Warning where the state may not be the requested one.
    pub doubt: Option<Warning>,
}

impl<'a> Operating<'a> {
    /// A state of the motion.
    pub fn moving(system: &'a dyn MechanicalSystem, state: State) -> Self {
        Operating { state, inertial: system, axes: None, doubt: None }
    }

    /// Returns the system, in rotating axes for a steady rotation.
    pub fn system(&self) -> &dyn MechanicalSystem {
        match &self.axes {
            Some(axes) => axes,
            None => self.inertial,
        }
    }

    /// Returns the variational equations at the state.
    ///
    /// # Errors
    /// See [`Variation::new`].
    pub fn variation(&self) -> Result<Variation<'_>> {
        self.state.variation(self.system())
    }

    /// Returns the linear model at the state.
    ///
    /// # Errors
    /// See [`linearize`](super::linearize).
    pub fn linearize(&self, request: &Linear) -> Result<LinearModel> {
        self.variation()?.linearize(request)
    }
}

/// Returns the equilibrium near a state, with all functions of time constant. If drives rotate the mechanism about a
/// fixed axis at constant speed and it is rotationally symmetric, the equilibrium is in axes that rotate with it.
///
/// # Errors
/// No equilibrium is found: the state moves, or force remains. Drives that accelerate.
pub fn at_rest<'a>(system: &'a dyn MechanicalSystem, state: &State) -> Result<Operating<'a>> {
    let Some(spin) = system.prescribed_spin(state.t) else { return still(system, state) };
    match Rotating::new(system, state.t, spin) {
        Some(axes) if is_same_all_around(&axes, system, state)? => {
            let found = equilibrium(&axes, state.t, (&state.q, &state.v))?;
            let rest = State { t: state.t, v: found.v, q: found.q };
            Ok(Operating { state: rest, inertial: system, axes: Some(axes), doubt: None })
        }
        _ => {
            let text = format!(
                "a drive turns at {} rad/s, but the mechanism is not the same all around its axis: this is the rest of the \
                 mechanism with the drive held where it is at t = {} s",
                short(spin.speed()),
                short(state.t)
            );
            let hint =
                "leave --equilibrium out to linearize the motion; `holonom transition` says whether it is stable";
            Ok(Operating { doubt: Some(Warning::new(text, hint)), ..still(system, state)? })
        }
    }
}

fn still<'a>(system: &'a dyn MechanicalSystem, state: &State) -> Result<Operating<'a>> {
    let found = equilibrium(system, state.t, (&state.q, &state.v))?;
    let rest = State { t: state.t, v: found.v, q: found.q };
    let operating = Operating::moving(system, rest);
    if operating.variation()?.point.is_equilibrium {
        Ok(operating)
    } else {
        Err(Error::input(format!("at t = {} s moving constraints accelerate the mechanism", short(state.t)))
            .under("--equilibrium")
            .hint("choose a time at which drives stand still or move steadily, or linearize the motion itself"))
    }
}

/// True if a rotation of everything that moves, at the time when drives have turned it so far, changes nothing: the
/// inertia forces, the directions that constraints allow, and M, K and C along these.
fn is_same_all_around(axes: &Rotating, system: &dyn MechanicalSystem, state: &State) -> Result<bool> {
    let still = vec![0.0; state.v.len()];
    let closed = assemble(system, state.t, (&state.q, &state.v), &[])?;
    let other = axes.turned(ODD_ANGLE);
    let mut turned = closed.q.clone();
    other.turn(ODD_ANGLE, &mut turned);
    let mut here = Variation::new(axes, state.t, &closed.q, &still)?;
    let Ok(mut there) = Variation::new(&other, state.t, &turned, &still) else { return Ok(false) };
    let x = directions(&mut here)?;
    let mut y = x.clone();
    y.column_iter_mut().for_each(|mut column| other.turn_directions(ODD_ANGLE, column.as_mut_slice()));
    let leaves = there.correct(&(there.g_times(&y)))?;
    let mut carried = inertia(&here);
    let pushed = inertia(&there);
    other.turn_directions(ODD_ANGLE, &mut carried);
    let rounding = rounding(&here.dynamics, &here.tangent.k, &here.point.q);
    let is_closed =
        there.point.phi <= tolerances::ROOT_OF_ROUND_OFF && leaves.norm() <= tolerances::ROOT_OF_ROUND_OFF * y.norm();
    Ok(is_closed
        && agree(&carried, &pushed, rounding.into_iter())
        && agree(&products(&here, &x), &products(&there, &y), std::iter::repeat(0.0)))
}

/// Returns M v'.
fn inertia(variation: &Variation) -> Vec<f64> {
    let structure = &variation.dynamics.structure;
    let terms = &variation.dynamics.terms;
    let mut inertia = vec![0.0; variation.velocities()];
    structure.mass.multiply_symmetric(&terms.mass, &variation.point.vdot, &mut inertia);
    inertia
}

/// Returns some directions that the constraints allow, each with components along all of them.
fn directions(variation: &mut Variation) -> Result<Matrix> {
    // Multiples of the golden ratio and of similar numbers are evenly spread (Weyl).
    let spread = |i: usize, j: usize| ((i + 1) as f64 * (0.618_033_988_75 + 0.1 * j as f64)).fract() - 0.5;
    let any = Matrix::from_fn(variation.velocities(), 3, spread);
    let correction = variation.correct(&variation.g_times(&any))?;
    Ok(any - correction)
}

/// Returns x.K x and x.C x for each two columns.
fn products(variation: &Variation, x: &Matrix) -> Vec<f64> {
    let none = Matrix::zeros(x.nrows(), x.ncols());
    let stiff = variation.force(&Changes { q: x.clone(), v: none.clone() });
    let damped = variation.force(&Changes { q: none, v: x.clone() });
    [x.transpose() * stiff, x.transpose() * damped].iter().flat_map(|m| m.iter().copied().collect::<Vec<_>>()).collect()
}

fn agree(a: &[f64], b: &[f64], rounding: impl Iterator<Item = f64>) -> bool {
    let size = largest(a).max(largest(b));
    a.iter()
        .zip(b)
        .zip(rounding)
        .all(|((a, b), rounding)| (a - b).abs() <= tolerances::ROOT_OF_ROUND_OFF * size + rounding)
}
