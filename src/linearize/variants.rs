//! A scene at many values of a parameter, each linearized at a state of its own.

use super::found::StateResult;
use super::method::build;
use super::slopes::Slope;
use super::{Kind, Linear, LociPoint, Mode, Operating, State, at_rest, method, tighten};
use crate::error::Result;
use crate::prepared::{Model, Overrides};
use crate::sweep::{Family, Range};

/// Step of the differences of the model from which eigenvalues have their derivatives in figures. Unit: `[1]` of the
/// distance of two values. Why: its square is far below what is seen. Test: `curves_follow_derivatives`.
pub(super) const SLOPE_STEP: f64 = 1e-3;

/// Largest step of the differences of the model for the sensitivity of eigenvalues. Unit: `[1]` of the parameter. Why: the
/// sixth power of it, and rounding over a fourth of it, are both about 1e-13. Test: `eigenvalues_have_their_sensitivity`.
const SENSITIVITY_STEP: f64 = 8e-3;

/// One scene for each value of a parameter.
pub struct Variants<'a> {
    /// The scene as a function of its parameters.
    pub family: &'a Family,
    /// Simulation options of each scene.
    pub overrides: &'a Overrides,
    /// The parameter and its values.
    pub range: &'a Range,
}

/// State of each scene at which the model is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum At {
    /// The consistent start.
    Start,
    /// The state of the motion at a time, s.
    Time(f64),
    /// The equilibrium at the scene's start time. Each search begins at the equilibrium of the neighbour, outwards from
    /// the value nearest to the scene's own, so that a branch of equilibria is followed.
    Equilibrium,
}

/// The derivatives of the eigenvalues at a value of a parameter.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
pub struct Sensitivity {
    /// The value of the parameter.
    pub at: f64,
    /// Those of the physical eigenvalues with im >= 0.
    #[doc(hidden)]
    #[serde(rename = "eigenvalues")]
    pub slopes: Vec<Slope>,
}

/// The linear models of the scenes, each at its state.
pub(super) struct VariantModels<'a> {
    pub variants: &'a Variants<'a>,
    pub at: At,
    pub request: &'a Linear,
}

impl VariantModels<'_> {
    /// Applies a function to the scene with a value of the parameter at its state; an equilibrium is sought near `guess`.
    fn operate<T>(&self, value: f64, guess: Option<&[f64]>, then: impl FnOnce(&Operating) -> Result<T>) -> Result<T> {
        let Variants { family, overrides, range } = self.variants;
        let mut prepared = Model::new(family.scene_at(&range.parameter, value)?, overrides)?;
        tighten(&mut prepared, overrides);
        let moving = |state| Operating::moving(&prepared, state);
        then(&match self.at {
            At::Start => moving(State::start(&prepared)),
            At::Time(t) => moving(prepared.states_at(&[t])?.swap_remove(0)),
            At::Equilibrium => rest(&prepared, guess)?,
        })
    }

    /// Returns the coordinates of the equilibrium at a value.
    pub fn equilibrium(&self, value: f64) -> Result<Vec<f64>> {
        self.operate(value, None, |operating| Ok(operating.state.q.clone()))
    }

    /// Returns the eigenvalues at a value, with their derivatives by differences of the model over these steps.
    pub fn found(&self, value: f64, guess: Option<&[f64]>, steps: &[f64]) -> Result<StateResult> {
        self.operate(value, guess, |operating| {
            let mut variation = operating.variation()?;
            let solved = method::solve(&mut variation, self.request)?;
            let near = Some(operating.state.q.as_slice());
            let slopes = solved.slopes(steps, |step| {
                self.operate(value + step, near, |beside| build(&mut beside.variation()?, self.request))
            });
            let model = solved.finish(&mut variation, self.request);
            Ok(StateResult::new(operating, &variation, value, model).with_slopes(slopes))
        })
    }

    /// The steps of the differences at a value of the range; none where each model takes a simulation.
    pub fn steps(&self, value: f64) -> Vec<f64> {
        let Range { from, to, count, is_log, .. } = self.variants.range;
        let whole = if *is_log { value * (to / from).ln() } else { to - from };
        let step = SLOPE_STEP * whole.abs() / (count - 1) as f64;
        if matches!(self.at, At::Time(_)) { Vec::new() } else { vec![step] }
    }

    /// Returns the derivatives of the eigenvalues at the scene's own value, or at the nearest of the range; none where a
    /// model beside it does not exist, or each takes a simulation.
    pub fn sensitivity(&self, own: f64, guess: Option<&[f64]>) -> Option<Sensitivity> {
        let Range { from, to, .. } = *self.variants.range;
        let at = own.clamp(from.min(to), from.max(to));
        let step = SENSITIVITY_STEP * if at == 0.0 { (to - from).abs() } else { at.abs() };
        if matches!(self.at, At::Time(_)) {
            return None;
        }
        let LociPoint { modes, slopes, .. } = self.found(at, guess, &[step, step / 2.0, step / 4.0]).ok()?.sample;
        let is_shown = |(mode, _): &(Mode, Slope)| mode.kind == Kind::Physical && mode.value.im >= 0.0;
        let slopes: Vec<Slope> = modes.into_iter().zip(slopes).filter(is_shown).map(|(_, slope)| slope).collect();
        (!slopes.is_empty()).then_some(Sensitivity { at, slopes })
    }
}

/// Returns the equilibrium near a guess; where there is none, that near the scene's own start.
fn rest<'a>(prepared: &'a Model, guess: Option<&[f64]>) -> Result<Operating<'a>> {
    let start = State::start(prepared);
    let near = guess.filter(|q| q.len() == start.q.len()).map(|q| State { q: q.to_vec(), ..start.clone() });
    match near.map(|near| at_rest(prepared, &near)) {
        Some(Ok(rest)) => Ok(rest),
        _ => at_rest(prepared, &start),
    }
}
