//! A motion together with its small perturbations, linear and full, integrated in the same steps.

mod bundle;
mod field;
mod projection;
mod pushed;
mod switches;

pub use bundle::{Bundle, Pulse, Snapshot};
pub use switches::flow_through;

use crate::error::{Error, Failure, Result};
use crate::formulation::Dynamics;
use crate::integrator::{self, Problem, Setup, Tolerance};
use crate::method_spec::MethodSpec;
use crate::projection::Projection;
use crate::simulate::{Observation, RunParts, Segments, Sink, Stop};
use crate::system::MechanicalSystem;
use crate::tolerances;
use bundle::FlowSizes;
use field::VariationalField;
use projection::Straightening;
use pushed::Pushed;

const SHORTER: &str = "choose a shorter time";

/// Integrates a bundle and passes it to `see` at `times` (increasing, after the start), by dop853 on the equations of
/// index 1 at a tolerance of 1e-12. After each step every state is projected onto the constraints and every column onto
/// their tangent space. Since all take the same steps, differences between members are more accurate than the members.
///
/// `see` returns true to continue, and may change the columns (to renew a chart, for example).
///
/// # Errors
/// A motion that cannot go on, with its last time; members that pass a singular state at different times are such a
/// case.
pub fn flow(
    system: &dyn MechanicalSystem,
    bundle: &Bundle,
    times: &[f64],
    see: impl FnMut(&mut Snapshot) -> bool,
) -> Result<()> {
    flow_until(system, bundle, times, &|| false, see)
}

/// The same until `is_over`, which is asked before each step; what was passed to `see` until then is the result.
///
/// # Errors
/// As of [`flow`].
pub fn flow_until(
    system: &dyn MechanicalSystem,
    bundle: &Bundle,
    times: &[f64],
    is_over: &dyn Fn() -> bool,
    mut see: impl FnMut(&mut Snapshot) -> bool,
) -> Result<()> {
    let shape = FlowSizes::of(system, bundle);
    let carrier = shape.carrier(system);
    let push = |amplitude: &f64| Pushed::new(system, bundle.pulse?, *amplitude);
    let pushed: Vec<Pushed> = bundle.pushes.iter().filter_map(push).collect();
    // Without a pulse one system serves all members.
    let members: Vec<&dyn MechanicalSystem> = if pushed.is_empty() {
        vec![system]
    } else {
        pushed.iter().map(|pushed| pushed as &dyn MechanicalSystem).collect()
    };
    let start = &bundle.start;
    // Rows that depend on others everywhere need not be found again at each state.
    let (dependent, _) = Dynamics::new(system).dependent_rows(start.t, &start.q, &start.v);
    let problem = || -> Result<Problem> {
        let field = VariationalField::new(system, &members, &shape, bundle, &dependent)?;
        Ok(Problem::new(Dynamics::new(&carrier), Box::new(field)))
    };
    let projection = || -> Result<Option<Box<dyn Projection>>> {
        Ok(Some(Box::new(Straightening::new(system, &members, &shape, bundle, &dependent)?)))
    };
    let integrator = MethodSpec::named("dop853");
    let formulation = MethodSpec::named("index1");
    let setup = Setup { integrator: &integrator, formulation: &formulation, system: &carrier, is_fixed: false };
    let entry = integrator::find(&integrator)?;
    let parts = RunParts {
        problem: problem()?,
        entry,
        integrator: (entry.make)(&setup)?,
        projection: projection()?,
        rows: (problem()?, projection()?),
        tests_velocities: true,
        // Perturbed starts are on the constraints with smaller residuals.
        limits_projection: false,
    };
    let horizon = times.last().map_or(start.t, |last| last.max(start.t));
    let tolerance = Tolerance::new(tolerances::FLOW_RTOL, tolerances::TIGHTEST, &carrier);
    let mut run = Segments::new(parts, tolerance, start.t, horizon, shape.pack(bundle));
    let mut counter = Counter { steps: 0, is_over };
    for &end in times {
        match run.advance(end, &mut counter) {
            Err(_) if is_over() => break,
            advanced => advanced.map_err(stopped)?,
        }
        let mut snapshot = shape.unpack(end, run.state());
        let goes_on = see(&mut snapshot);
        if !goes_on {
            break;
        }
        run.change(|y| shape.repack(&snapshot, y)).map_err(stopped)?;
    }
    Ok(())
}

/// Counts steps, and ends a run that needs too many or whose time is over.
struct Counter<'a> {
    steps: usize,
    is_over: &'a dyn Fn() -> bool,
}

impl Sink for Counter<'_> {
    fn accepted(&mut self, _: &Observation) {
        self.steps += 1;
    }

    fn stops(&self) -> Option<Stop> {
        if (self.is_over)() {
            return Some(Stop { reason: "its time is over".to_string(), hint: SHORTER.to_string() });
        }
        (self.steps > 2_000_000).then(|| Stop {
            reason: "the explicit method that carries perturbations needs more than two million steps".to_string(),
            hint: "choose a shorter time, or a model without its fastest modes".to_string(),
        })
    }
}

/// The tolerance is not the user's, so the other hints of a failure do not apply.
fn stopped(failure: Failure) -> Error {
    Failure { hint: SHORTER.to_string(), ..failure }.into()
}
