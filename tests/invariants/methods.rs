//! Every method that goes together, and what it promises.

use holonom::integrator::{self, IntegratorEntry, Steps};
use holonom::method_spec::MethodSpec;
use holonom::projection;
use holonom::simulate::Method;

/// Of methods that choose their steps.
const TOLERANCE: f64 = 1e-7;
/// Of the others, s: springs and rods of the random mechanisms swing in some tenths of a second.
const STEP: f64 = 5e-4;

/// A method with its entry in the registry.
pub struct Tried {
    pub entry: &'static IntegratorEntry,
    pub method: Method,
}

/// All triples of the registries that are accepted.
pub fn all() -> Vec<Tried> {
    let entries = integrator::registry().iter();
    let pairs = entries.flat_map(|entry| entry.accepts().map(move |formulation| (entry, formulation)));
    let triples = pairs.flat_map(|(entry, formulation)| {
        let accepted = projection::registry().iter().filter(move |other| !entry.refuses(formulation, other.name));
        accepted.map(move |projection| tried(entry, formulation, projection.name))
    });
    triples.collect()
}

fn tried(entry: &'static IntegratorEntry, formulation: &str, projection: &str) -> Tried {
    let [formulation, projection] = [formulation, projection].map(MethodSpec::named);
    let step = (entry.steps == Steps::Fixed).then_some(STEP);
    let integrator = MethodSpec::named(entry.name);
    Tried { entry, method: Method { formulation, integrator, projection, rtol: TOLERANCE, atol: TOLERANCE, step } }
}

impl Tried {
    pub fn name(&self) -> String {
        let Method { formulation, integrator, projection, .. } = &self.method;
        format!("{formulation} + {integrator} + {projection}")
    }
}
