//! Linear models of the references, and what is asked of them.

use crate::linearize::reference::Reference;
use crate::linearize::systems::system;
use holonom::linearize::{Chart, Complex, Kind, Linear, LinearModel, Variation};
use holonom::method_spec::MethodSpec;

/// A method as on the command line, in a chart.
pub fn request(method: &str, chart: Option<Chart>) -> Linear {
    Linear { method: MethodSpec::parse(method).unwrap(), chart }
}

pub fn model(variation: &mut Variation, method: &str, chart: Option<Chart>) -> LinearModel {
    variation.linearize(&request(method, chart)).unwrap_or_else(|error| panic!("{method}: {error}"))
}

/// Eigenvalues of a kind.
pub fn values(model: &LinearModel, kind: Kind) -> Vec<Complex<f64>> {
    model.modes.iter().filter(|mode| mode.kind == kind).map(|mode| mode.value).collect()
}

/// How many physical, spurious and infinite eigenvalues there are.
pub fn counts(model: &LinearModel) -> [usize; 3] {
    [Kind::Physical, Kind::Spurious, Kind::Infinite].map(|kind| values(model, kind).len())
}

/// With the variational equations at the state of a reference.
pub fn at<T>(label: &str, check: impl FnOnce(&mut Variation, &Reference) -> T) -> T {
    let reference = Reference::read(label);
    let system = system(label);
    let q = reference.vector("q");
    let v = reference.vector("v");
    check(&mut Variation::new(system.as_ref(), 0.0, &q, &v).unwrap(), &reference)
}

/// Roots of s^2 + c1 s + c0, `m` times each.
pub fn held_roots(c1: f64, c0: f64, m: usize) -> Vec<Complex<f64>> {
    let root = Complex::new(c1 * c1 / 4.0 - c0, 0.0).sqrt();
    (0..m).flat_map(|_| [root - c1 / 2.0, -root - c1 / 2.0]).collect()
}
