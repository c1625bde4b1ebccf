//! Which methods are measured.

use crate::error::Result;
use crate::formulation;
use crate::integrator::{self, Entry};
use crate::method_spec::MethodSpec;
use crate::projection;
use crate::simulate::Method;

/// Formulation x integrator x projection, without an accuracy.
#[derive(Clone, Debug, PartialEq)]
pub struct Triple {
    pub formulation: MethodSpec,
    pub integrator: MethodSpec,
    pub projection: MethodSpec,
}

/// What a user wants of the grid; what is not named is taken as is usual.
#[derive(Clone, Debug, Default)]
pub struct Filter {
    pub formulations: Vec<MethodSpec>,
    pub integrators: Vec<MethodSpec>,
    pub projections: Vec<MethodSpec>,
}

impl Triple {
    /// At an accuracy: `step` for integrators that have no error estimate.
    pub fn at(&self, (rtol, atol): (f64, f64), step: Option<f64>) -> Method {
        let Triple { formulation, integrator, projection } = self.clone();
        Method { formulation, integrator, projection, rtol, atol, step }
    }
}

/// All methods of the registries that go together and through `filter`. Where no projection is named: what leaves the
/// constraints without one (index 1, half-explicit methods) has one sweep as well, and index 1 the exact one too.
///
/// # Errors
/// Unknown names and options; a filter that nothing goes through.
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

/// Why nothing goes together, said of the first that was named.
fn refused(integrators: &[MethodSpec], formulations: &[MethodSpec], filter: &Filter) -> Result<Vec<Triple>> {
    let none = [MethodSpec::named("none")];
    let projections = if filter.projections.is_empty() { &none[..] } else { &filter.projections };
    for ((formulation, integrator), projection) in formulations.iter().zip(integrators).zip(projections) {
        let (formulation, integrator) = (formulation.clone(), integrator.clone());
        let triple = Triple { formulation, integrator, projection: projection.clone() };
        // A step that any method may have where it needs one.
        triple.at((1e-6, 1e-6), None).check()?;
    }
    Ok(Vec::new())
}

fn named<'n>(given: &[MethodSpec], known: impl Iterator<Item = &'n str>) -> Vec<MethodSpec> {
    if given.is_empty() { known.map(MethodSpec::named).collect() } else { given.to_vec() }
}

fn projections(entry: &Entry, formulation: &MethodSpec, filter: &Filter) -> Vec<MethodSpec> {
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
