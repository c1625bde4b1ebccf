//! The linear time-varying model along a motion.

mod carried;
mod course;
mod measure;
mod within;

pub(crate) use carried::Carried;
pub use measure::{Deviation, MeasuredA};
pub use within::within;

use super::flow::{Snapshot, flow_through};
use super::minimal::restrict;
use super::spectrum::spectrum;
use super::{
    Branch, Chart, Coordinates, Cost, LinearModel, LociPoint, Matrix, Request, Response, State, Variation,
    refuse_large, track,
};
use crate::error::{Error, Result};
use crate::method_spec::MethodSpec;
use crate::system::MechanicalSystem;
use course::Course;
use measure::{Middle, measure};

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
    pub measured: Vec<MeasuredA>,
    /// Deviations of linear interpolation half-way between the times, for each kind of matrix.
    pub deviations: Vec<Deviation>,
    /// Of a transported basis, where the motion returns to its start: C with R(end) = R(start) C, in the intrinsic chart a
    /// rotation.
    /// In the chart of the start, Phi over the whole is diag(C, C) Phi.
    pub closure: Option<Matrix>,
    /// The eigenvalues as branches.
    pub branches: Vec<Branch>,
    /// The largest deviation in each interval, as a part of the largest entry.
    intervals: Vec<f64>,
}

impl Along {
    /// Returns the transition matrix from the first to the last time.
    pub fn whole(&self) -> Option<Matrix> {
        self.transitions.iter().cloned().reduce(|product, next| next * product)
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
    let request = Request { method: MethodSpec::named("mcs"), chart: Some(chart) };
    let mut pass = Pass {
        variation,
        course,
        request,
        models: Vec::new(),
        middles: Vec::new(),
        masses: Vec::new(),
        transitions: Vec::new(),
    };
    pass.add(first)?;
    let instants: Vec<f64> = times.windows(2).flat_map(|pair| [0.5 * (pair[0] + pair[1]), pair[1]]).collect();
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
    request: Request,
    models: Vec<LinearModel>,
    /// Half-way between two times.
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
        if self.middles.len() < self.models.len() {
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
        let built = built(&mut self.variation, chart)?;
        let modes = spectrum(&mut self.variation, &built, &self.request).map_or_else(|_| Vec::new(), |all| all.modes);
        self.masses.push(self.variation.mass());
        let cost = Cost { size: built.a.nrows(), ..Cost::default() };
        self.models.push(built.finish(&mut self.variation, self.request.method.to_string(), modes, cost));
        Ok(())
    }

    fn finish(self, system: &dyn MechanicalSystem) -> Result<Along> {
        let Pass { course, models, middles, masses, transitions, .. } = self;
        let sample =
            |(model, mass): (&LinearModel, Matrix)| LociPoint { at: model.point.t, modes: model.modes.clone(), mass };
        let samples: Vec<LociPoint> = models.iter().zip(masses).map(sample).collect();
        let (deviations, intervals) = measure::deviations(&models, &middles);
        let measured = measure(system, &course, &models);
        let closure = course.closure(&models);
        Ok(Along { transitions, closure, measured, deviations, branches: track(&samples), intervals, models })
    }
}

fn built(variation: &mut Variation, chart: Coordinates) -> Result<super::entry::Built> {
    if variation.has_drivers() {
        variation.prescribed()?;
    }
    Ok(restrict(variation, chart, Response::exact)?.built)
}

fn model(variation: &mut Variation, chart: Coordinates) -> Result<LinearModel> {
    Ok(built(variation, chart)?.finish(variation, "mcs".to_string(), Vec::new(), Cost::default()))
}
