//! The chart of a linear model along the motion that it is compared with.

use crate::error::{Error, Result};
use crate::linearize::flow::{Bundle, Snapshot, flow_until};
use crate::linearize::{Chart, Coordinates, Matrix, State, Variation, parallel};
use crate::system::MechanicalSystem;
use crate::tolerances::linearize as tolerances;

/// A chart at the start and its continuation along the motion: constant charts stay, as all do at an equilibrium; the
/// basis of the intrinsic one is transported parallel, N' = f(N) (classical Runge-Kutta method).
pub struct Carried<'a> {
    system: &'a dyn MechanicalSystem,
    pub start: Coordinates,
    from: State,
    /// Rate of rotation of the basis, 1/s; none: the chart is constant.
    rate: Option<f64>,
    /// True when motions are followed no further.
    is_over: &'a dyn Fn() -> bool,
}

impl<'a> Carried<'a> {
    /// The chart at a state.
    ///
    /// # Errors
    /// A chart that does not exist at the state.
    pub fn new(
        variation: &mut Variation<'a>,
        chart: &Chart,
        from: &State,
        is_over: &'a dyn Fn() -> bool,
    ) -> Result<Self> {
        let start = chart.at(variation)?;
        let moves = *chart == Chart::Intrinsic && start.r.ncols() > 0 && !variation.point.is_equilibrium;
        let rate = moves.then(|| {
            let moving = moving(variation, &start);
            (moving.transpose() * variation.mass() * &moving).amax().sqrt()
        });
        Ok(Carried { system: variation.system(), start, from: from.clone(), rate, is_over })
    }

    /// Returns the motions of a bundle at these times (increasing, after the start), with the chart at each: at the
    /// first ones alone where the time is over.
    ///
    /// # Errors
    /// A basis that rotates too fast, a motion that cannot go on, a state at which the chart does not exist.
    pub fn flow(&self, bundle: &Bundle, times: &[f64]) -> Result<(Vec<Snapshot>, Vec<Coordinates>)> {
        let all = self.times(times)?;
        let mut snapshots = Vec::new();
        let mut states = Vec::new();
        let times: Vec<f64> = all.iter().map(|(t, _)| *t).collect();
        flow_until(self.system, bundle, &times, self.is_over, |snapshot| {
            let is_asked = all[states.len()].1;
            snapshots.extend(is_asked.then(|| snapshot.clone()));
            states.push((snapshot.motion.clone(), is_asked));
            true
        })?;
        let charts = self.along(&states)?;
        snapshots.truncate(charts.len());
        Ok((snapshots, charts))
    }

    /// Returns the times (increasing, after the start) with the intermediate ones that the transport of the chart
    /// needs; true marks the requested times.
    ///
    /// # Errors
    /// A basis that rotates too fast.
    fn times(&self, times: &[f64]) -> Result<Vec<(f64, bool)>> {
        let Some(rate) = self.rate else { return Ok(times.iter().map(|t| (*t, true)).collect()) };
        let before = [self.from.t].into_iter().chain(times.iter().copied());
        let pairs = |from: f64, to: f64| {
            (0.5 * rate * (to - from) / tolerances::CARRIED_TURN).ceil().max(tolerances::CARRIED_STATES)
        };
        if before.clone().zip(times).map(|(from, to)| pairs(from, *to)).sum::<f64>() > tolerances::CARRIED_MOST {
            let error = Error::input("the intrinsic chart turns too fast to be followed for so long");
            return Err(error.under("--horizon").hint("give a shorter one, or --chart mass_orthogonal"));
        }
        let between = before.zip(times).flat_map(|(from, &to)| {
            let count = 2 * pairs(from, to) as usize;
            (1..=count).map(
                move |i| if i == count { (to, true) } else { (from + (to - from) * i as f64 / count as f64, false) },
            )
        });
        Ok(between.collect())
    }

    /// Returns the chart at all requested times, from the states at the [`times`](Self::times).
    ///
    /// # Errors
    /// A state at which the chart does not exist.
    fn along(&self, states: &[(State, bool)]) -> Result<Vec<Coordinates>> {
        if self.rate.is_none() {
            return Ok(states.iter().map(|_| self.start.clone()).collect());
        }
        let mut charts = Vec::new();
        let mut last = Basis::at(self.system, &self.from, &self.start.r)?;
        for pair in states.chunks_exact(2) {
            last = last.step(self.system, [&pair[0].0, &pair[1].0])?;
            if pair[1].1 {
                charts.push(last.chart.clone());
            }
        }
        Ok(charts)
    }
}

/// A basis at a state, with its rate.
struct Basis {
    t: f64,
    chart: Coordinates,
    rate: Matrix,
}

impl Basis {
    /// Returns the basis nearest to `n`, with its rate.
    fn at(system: &dyn MechanicalSystem, state: &State, n: &Matrix) -> Result<Basis> {
        Basis::of(&mut Variation::new(system, state.t, &state.q, &state.v)?, n)
    }

    fn of(variation: &mut Variation, n: &Matrix) -> Result<Basis> {
        let off = variation.correct(&(variation.g() * n))?;
        let chart = parallel(variation, orthonormal(n - off, &variation.mass()))?;
        Ok(Basis { t: variation.point.t, rate: moving(variation, &chart), chart })
    }

    /// Integrates the basis to the last of two states, the first half-way.
    fn step(&self, system: &dyn MechanicalSystem, [middle, end]: [&State; 2]) -> Result<Basis> {
        let h = end.t - self.t;
        let n = &self.chart.r;
        let mut half = Variation::new(system, middle.t, &middle.q, &middle.v)?;
        let second = Basis::of(&mut half, &(n + &self.rate * (0.5 * h)))?.rate;
        let third = Basis::of(&mut half, &(n + &second * (0.5 * h)))?.rate;
        let mut last = Variation::new(system, end.t, &end.q, &end.v)?;
        let fourth = Basis::of(&mut last, &(n + &third * h))?.rate;
        let mean = (&self.rate + (second + third) * 2.0 + fourth) / 6.0;
        Basis::of(&mut last, &(n + mean * h))
    }
}

/// Returns N' of an intrinsic chart, whose tilt is N' + [v, N].
fn moving(variation: &Variation, chart: &Coordinates) -> Matrix {
    let tilt = chart.tilt.clone().resize_horizontally(chart.r.ncols(), 0.0);
    tilt - variation.bracket(&variation.point.v) * &chart.r
}

/// Returns X (X^T M X)^(-1/2), the orthonormal basis nearest to X.
fn orthonormal(x: Matrix, mass: &Matrix) -> Matrix {
    let square = (x.transpose() * mass * &x).symmetric_eigen();
    let scaled = &square.eigenvectors
        * Matrix::from_diagonal(&square.eigenvalues.map(|value| value.max(f64::MIN_POSITIVE).sqrt().recip()));
    x * scaled * square.eigenvectors.transpose()
}
