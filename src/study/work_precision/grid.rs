//! The methods that are measured.

use crate::error::Result;
use crate::formulation;
use crate::integrator::{self, IntegratorEntry};
use crate::method_spec::MethodSpec;
use crate::projection;
use crate::simulate::Method;

/// Formulation, integrator and projection, without an accuracy.
#[derive(Clone, Debug, PartialEq)]
pub struct Triple {
    /// Formulation with its options.
    pub formulation: MethodSpec,
    /// Integrator with its options.
    pub integrator: MethodSpec,
    /// Projection with its options.
    pub projection: MethodSpec,
}

/// Methods chosen by a user; an empty list means the default.
#[derive(Clone, Debug, Default)]
pub struct Filter {
    /// Formulations; empty: all.
    pub formulations: Vec<MethodSpec>,
    /// Integrators; empty: all.
    pub integrators: Vec<MethodSpec>,
    /// Projections; empty: those that suit each formulation.
    pub projections: Vec<MethodSpec>,
}

impl Triple {
    /// Returns the method at an accuracy: `step` for integrators without an error estimate.
    pub fn at(&self, rtol: f64, atol: f64, step: Option<f64>) -> Method {
        let Triple { formulation, integrator, projection } = self.clone();
        Method { formulation, integrator, projection, rtol, atol, step }
    }

    /// True if a method has these three.
    pub(super) fn is_of(&self, method: &Method) -> bool {
        let Method { formulation, integrator, projection, .. } = method;
        (formulation, integrator, projection) == (&self.formulation, &self.integrator, &self.projection)
    }
}

/// Returns all methods of the registries that can be combined and pass `filter`. Where no projection is named: those
/// that drift without one (index 1, half-explicit methods) have one sweep as well, and index 1 the exact projection
/// too.
///
/// # Errors
/// Unknown names and options; a filter that no method passes.
pub fn grid(filter: &Filter) -> Result<Vec<Triple>> {
    let Filter { formulations, integrators, .. } = filter;
    let integrators = named(integrators, integrator::registry().iter().map(|entry| entry.name));
    let formulations = named(formulations, formulation::registry().iter().map(|entry| entry.name));
    let mut triples = Vec::new();
    for integrator in &integrators {
        let entry = integrator::find(integrator).map_err(|error| error.under("--integrator"))?;
        for formulation in formulations.iter().filter(|spec| entry.takes(&spec.name)) {
            let with =
                |projection| Triple { formulation: formulation.clone(), integrator: integrator.clone(), projection };
            triples.extend(projections(entry, formulation, filter).into_iter().map(with));
        }
    }
    match triples.first() {
        Some(_) => Ok(triples),
        None => refused(&integrators, &formulations, filter),
    }
}

/// Returns the error of the first named combination where none is possible.
fn refused(integrators: &[MethodSpec], formulations: &[MethodSpec], filter: &Filter) -> Result<Vec<Triple>> {
    let none = [MethodSpec::named("none")];
    let projections = if filter.projections.is_empty() { &none[..] } else { &filter.projections };
    for ((formulation, integrator), projection) in formulations.iter().zip(integrators).zip(projections) {
        let formulation = formulation.clone();
        let integrator = integrator.clone();
        let triple = Triple { formulation, integrator, projection: projection.clone() };
        // A step that any method may have where it needs one.
        triple.at(1e-6, 1e-6, None).check()?;
    }
    Ok(Vec::new())
}

fn named<'n>(given: &[MethodSpec], known: impl Iterator<Item = &'n str>) -> Vec<MethodSpec> {
    if given.is_empty() { known.map(MethodSpec::named).collect() } else { given.to_vec() }
}

fn projections(entry: &IntegratorEntry, formulation: &MethodSpec, filter: &Filter) -> Vec<MethodSpec> {
    let usual: &[&str] = match formulation.name.as_str() {
        "index1" => &["none", "manifold", "exact"],
        "index2" if entry.accepts().eq(["index2"]) => &["none", "manifold"],
        _ => &["none"],
    };
    let wanted = named(&filter.projections, usual.iter().copied());
    let goes = |projection: &MethodSpec| {
        let is_known = projection::registry().iter().any(|entry| entry.name == projection.name);
        is_known && !entry.refuses(&formulation.name, &projection.name)
    };
    wanted.into_iter().filter(goes).collect()
}
