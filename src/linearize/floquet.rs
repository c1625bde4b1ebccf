//! Stability of periodic motions.

use super::{Chart, Complex, Coordinates, Matrix, State, Variation, recurrence, transition};
use crate::error::{Error, Result};
use crate::math::eigen::{Eigen, eigen, singular_values};
use crate::system::MechanicalSystem;
use crate::tolerances;

/// Growth of small changes over a period of a motion.
#[derive(Clone, Debug)]
pub struct Floquet {
    /// Period, s.
    pub period: f64,
    /// The chart of the monodromy matrix, at the start.
    pub chart: String,
    /// Names of its states.
    pub states: Vec<String>,
    /// The state-transition matrix over the period in the states of the chart at the start, 2 k x 2 k.
    pub monodromy: Matrix,
    /// Its eigenvalues, largest first. A change along the motion has the multiplier 1 and, without damping, so has one
    /// of its energy.
    pub multipliers: Vec<Complex<f64>>,
    /// Condition of each, 1/|y^H x| of its left and right vectors of norm 1.
    pub conditions: Vec<f64>,
    /// Error of each, to first order: of the integration and of rounding.
    pub errors: Vec<f64>,
    /// Largest difference of (q, v) between the end and the start, without whole turns and what the equations do not
    /// depend on.
    pub gap: f64,
}

/// A defective multiplier on the unit circle, with fewer eigenvectors than its multiplicity: small changes grow like t.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Defect {
    /// The multiplier.
    pub multiplier: Complex<f64>,
    /// Algebraic multiplicity.
    pub count: usize,
    /// Number of independent eigenvectors.
    pub vectors: usize,
}

impl Floquet {
    /// log(multiplier) / period, 1/s: growth rate and frequency, the latter up to multiples of that of the motion.
    pub fn exponents(&self) -> Vec<Complex<f64>> {
        self.multipliers.iter().map(|multiplier| multiplier.ln() / self.period).collect()
    }

    /// True if no multiplier is outside the unit circle by more than `slack`, and none on it is defective.
    ///
    /// # Errors
    /// Those of [`defects`](Self::defects).
    pub fn is_bounded(&self, slack: f64) -> Result<bool> {
        Ok(self.is_stable(slack) && self.defects(slack)?.is_empty())
    }

    /// True if no multiplier is outside the unit circle by more than `slack`. A double multiplier 1 is computed with an
    /// error of the square root of rounding.
    pub fn is_stable(&self, slack: f64) -> bool {
        self.multipliers.iter().all(|multiplier| multiplier.norm() <= 1.0 + slack)
    }

    /// Returns the multipliers on the unit circle, up to `slack`, that are defective, each once. Multipliers that
    /// rounding has parted by the root of `slack` or less count as one.
    ///
    /// # Errors
    /// Singular values that do not converge.
    #[doc(hidden)]
    pub fn defects(&self, slack: f64) -> Result<Vec<Defect>> {
        let mut left: Vec<Complex<f64>> = self.multipliers.clone();
        left.retain(|multiplier| (multiplier.norm() - 1.0).abs() <= slack);
        let mut found = Vec::new();
        while let Some(first) = left.first().copied() {
            let (near, far): (Vec<_>, Vec<_>) =
                left.into_iter().partition(|other| (other - first).norm() <= slack.sqrt());
            left = far;
            let count = near.len();
            let sum = near.iter().sum::<Complex<f64>>();
            let multiplier = sum / count as f64;
            let vectors = if count > 1 { self.vectors_of(multiplier)? } else { 1 };
            if vectors < count {
                found.push(Defect { multiplier, count, vectors });
            }
        }
        Ok(found)
    }

    fn vectors_of(&self, multiplier: Complex<f64>) -> Result<usize> {
        let mut shifted = self.monodromy.map(Complex::from);
        (0..shifted.nrows()).for_each(|i| shifted[(i, i)] -= multiplier);
        let sizes = singular_values(&shifted)?;
        Ok(sizes.iter().filter(|size| **size <= tolerances::SIX_DIGITS * sizes[0]).count())
    }
}

/// Returns the monodromy matrix of the motion from `start`, which returns after `period`: to the same state, up to whole
/// turns and to displacements on which the equations do not depend, such as those of a vehicle. It is the same in every chart
/// but for a change of basis, so its multipliers are a property of the motion.
///
/// # Errors
/// A period that is not above zero; a motion that is not back after it, or that cannot go on.
pub fn floquet(system: &dyn MechanicalSystem, start: &State, period: f64) -> Result<Floquet> {
    let refused = || Error::input("a period must be above zero").under("--period");
    if !(period > 0.0 && period.is_finite()) {
        return Err(refused());
    }
    let found = transition(system, start, &Chart::MassOrthogonal, &[start.t + period])?;
    let found = found.into_iter().next().ok_or_else(refused)?;
    let mut variation = Variation::new(system, start.t, &start.q, &start.v)?;
    let gap = recurrence::gap(&mut variation, start, &found.state)?;
    let size = |x: &[f64]| x.iter().fold(1.0f64, |most, x| most.max(x.abs()));
    if gap > tolerances::PERIODIC * size(&start.q).max(size(&start.v)) {
        let message =
            format!("after {period} s the motion is {gap:.1e} away from its start, so this is not its period");
        return Err(Error::input(message)
            .under("--period")
            .hint("give the period to more digits, or start on the cycle"));
    }
    let monodromy = Chart::MassOrthogonal.at(&mut variation)?.states_of(&found.changes);
    let Eigen { values, conditions, errors, .. } = eigen(&monodromy)?;
    // Errors of steps add up over a period.
    let of_flow = 10.0 * tolerances::FLOW_RTOL * monodromy.amax().max(1.0);
    // A defective multiplier is moved by the root of the error.
    let error = |(error, condition): (f64, &f64)| error + (of_flow * condition).min(of_flow.sqrt());
    let Coordinates { name: chart, states, .. } = found.start.clone();
    Ok(Floquet {
        period,
        chart,
        states,
        multipliers: values.into_iter().rev().collect(),
        errors: errors.into_iter().zip(&conditions).map(error).rev().collect(),
        conditions: conditions.into_iter().rev().collect(),
        monodromy,
        gap,
    })
}
