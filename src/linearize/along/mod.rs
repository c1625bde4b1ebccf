//! The linear time-varying model along a motion.

mod carried;
mod course;
mod measure;
mod within;

pub(crate) use carried::CarriedChart;
pub use measure::{Deviation, MeasuredA};
pub use within::within;

use super::flow::{Snapshot, flow_through};
use super::minimal::restrict;
use super::spectrum::spectrum;
use super::{
    Branch, Chart, Coordinates, Cost, Linear, LinearModel, LociPoint, Matrix, Response, State, Variation, reduction,
    refuse_large, track,
};
use crate::error::{Error, Result, Warning};
use crate::method_spec::MethodSpec;
use crate::system::MechanicalSystem;
use course::Course;
use measure::{Middle, measure};

/// Intervals in which interpolation is measured, about: all up to this number. Unit: `[intervals]`. Why: a step of the
/// motion ends half-way, which takes as long as the model at the next time. Test: `a_long_motion_is_measured_in_parts`.
const MEASURED_INTERVALS: usize = 200;

/// Linear models along a motion in one continuous chart,
///
/// ```text
/// x' = A(t) x + B(t) u,   y = C(t) x + D(t) u,   x(t_k+1) = Phi_k x(t_k) for u = 0
/// ```
///
/// with x, u and y small changes from the nominal motion.
#[derive(Clone, Debug)]
pub struct Along {
    /// The model at each time; each has its chart in [`LinearModel::frame`].
    pub models: Vec<LinearModel>,
    /// Phi_k from each time to the next, without the states of inputs.
    pub transitions: Vec<Matrix>,
    /// A against the limit of (Phi(t + h, t) - I)/h, at some of the times.
    #[doc(hidden)]
    pub measured: Vec<MeasuredA>,
    /// Deviations of linear interpolation half-way between the times, for each kind of matrix: in all intervals, or in
    /// some that are spread evenly where there are many.
    #[doc(hidden)]
    pub deviations: Vec<Deviation>,
    /// Of a transported basis, where the motion returns to its start: C with R(end) = R(start) C, in the intrinsic chart a
    /// rotation.
    /// In the chart of the start, Phi over the whole is diag(C, C) Phi.
    pub closure: Option<Matrix>,
    /// The eigenvalues as branches.
    pub branches: Vec<Branch>,
    /// The largest deviation in each of those intervals, as a part of the largest entry.
    intervals: Vec<f64>,
}

impl Along {
    /// Returns the transition matrix from the first to the last time.
    pub fn whole(&self) -> Option<Matrix> {
        self.transitions.iter().cloned().reduce(|product, next| next * product)
    }

    /// Warning of the state that is nearest to a singular one, where rounding changes its model.
    pub fn doubt(&self) -> Option<Warning> {
        let worst = self.models.iter().max_by(|a, b| a.reduction.error.total_cmp(&b.reduction.error));
        worst.and_then(LinearModel::doubt)
    }
}

/// Returns the models at `times` (increasing) of the motion from `start`, the state at the first one; `progress` is
/// called with the times. The motion, the chart and small changes are integrated together at a tolerance of 1e-12.
///
/// # Errors
/// A chart that does not exist at a state, or that is none between two of them; a motion that cannot go on.
pub fn along(
    system: &dyn MechanicalSystem,
    start: &State,
    chart: Option<&Chart>,
    times: &[f64],
    progress: impl FnMut(f64),
) -> Result<Along> {
    let stride = times.len().saturating_sub(1).div_ceil(MEASURED_INTERVALS).max(1);
    along_by(system, start, chart, times, stride, progress)
}

/// As [`along`], interpolation being measured in every interval of so many.
fn along_by(
    system: &dyn MechanicalSystem,
    start: &State,
    chart: Option<&Chart>,
    times: &[f64],
    stride: usize,
    mut progress: impl FnMut(f64),
) -> Result<Along> {
    refuse_large(system.dimensions().v)?;
    if times.len() < 2 || times[0] != start.t || times.windows(2).any(|pair| pair[0] >= pair[1]) {
        return Err(Error::input("the times along a motion must increase from that of its start, two or more"));
    }
    let mut variation = Variation::new(system, start.t, &start.q, &start.v)?;
    let chart = chart.cloned().unwrap_or_else(|| Chart::preferred(&mut variation));
    let course = Course::new(&mut variation, &chart)?;
    let first = course.start.clone();
    let bundle = course.bundle(start);
    let request = Linear { method: MethodSpec::named("mcs"), chart: Some(chart) };
    let mut pass = Pass {
        variation,
        course,
        request,
        stride,
        models: Vec::new(),
        middles: Vec::new(),
        masses: Vec::new(),
        transitions: Vec::new(),
    };
    pass.add(first)?;
    let mut instants = Vec::new();
    for (i, pair) in times.windows(2).enumerate() {
        instants.extend(i.is_multiple_of(stride).then_some(0.5 * (pair[0] + pair[1])));
        instants.push(pair[1]);
    }
    let mut outcome = Ok(());
    flow_through(system, &bundle, &instants, |snapshot| {
        outcome = pass.meet(snapshot);
        progress(snapshot.motion.t);
        outcome.is_ok()
    })?;
    outcome?;
    pass.finish(system)
}

/// The states of a motion, one after the other.
struct Pass<'a> {
    variation: Variation<'a>,
    course: Course,
    request: Linear,
    /// Interpolation is measured in every interval of so many.
    stride: usize,
    models: Vec<LinearModel>,
    /// Half-way between two times, in the intervals in which interpolation is measured.
    middles: Vec<Middle>,
    masses: Vec<Matrix>,
    transitions: Vec<Matrix>,
}

impl Pass<'_> {
    /// Adds the state half-way to the next time, or that at this time, from which new columns start.
    fn meet(&mut self, snapshot: &mut Snapshot) -> Result<()> {
        let State { t, q, v } = &snapshot.motion;
        self.variation.operate_at(*t, q, v)?;
        let chart = self.course.at(&mut self.variation, &snapshot.basis)?;
        let interval = self.models.len() - 1;
        if interval.is_multiple_of(self.stride) && self.middles.len() * self.stride <= interval {
            self.middles.push(Middle::new(&model(&mut self.variation, chart)?));
            return Ok(());
        }
        self.transitions.push(chart.states_of(&snapshot.columns));
        snapshot.columns = chart.changes();
        if snapshot.basis.ncols() > 0 {
            snapshot.basis.copy_from(&chart.r);
        }
        self.add(chart)
    }

    /// Adds the model at the state of the variation, with its modes; a state whose eigenvalues fail has none.
    fn add(&mut self, chart: Coordinates) -> Result<()> {
        let reduction = reduction::measure(&mut self.variation, &self.request)?;
        let built = built(&mut self.variation, chart)?;
        let modes = spectrum(&mut self.variation, &built, &self.request).map_or_else(|_| Vec::new(), |all| all.modes);
        self.masses.push(self.variation.mass());
        let cost = Cost { size: built.a.nrows(), ..Cost::default() };
        let model = built.finish(&mut self.variation, self.request.method.to_string(), modes, cost);
        self.models.push(LinearModel { reduction, ..model });
        Ok(())
    }

    fn finish(self, system: &dyn MechanicalSystem) -> Result<Along> {
        let Pass { course, models, middles, masses, transitions, stride, .. } = self;
        let sample = |(model, mass): (&LinearModel, Matrix)| LociPoint {
            at: model.point.t,
            modes: model.modes.clone(),
            mass,
            slopes: Vec::new(),
        };
        let samples: Vec<LociPoint> = models.iter().zip(masses).map(sample).collect();
        let (deviations, intervals) = measure::deviations(&models, &middles, stride);
        let measured = measure(system, &course, &models);
        let closure = course.closure(&models);
        Ok(Along { transitions, closure, measured, deviations, branches: track(&samples), intervals, models })
    }
}

fn built(variation: &mut Variation, chart: Coordinates) -> Result<super::entry::LinearMatrices> {
    if variation.has_drivers() {
        variation.prescribed()?;
    }
    Ok(restrict(variation, chart, Response::exact)?.built)
}

fn model(variation: &mut Variation, chart: Coordinates) -> Result<LinearModel> {
    Ok(built(variation, chart)?.finish(variation, "mcs".to_string(), Vec::new(), Cost::default()))
}
