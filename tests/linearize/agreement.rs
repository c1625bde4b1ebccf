//! Exact methods agree with each other, on random mechanisms.

use crate::linearize::models::{model, values};
use crate::linearize::reference::distance;
use crate::scenes::random::{Numbers, Recipe};
use holonom::initial::{assemble, equilibrium};
use holonom::linearize::{Chart, Kind, Matrix, Variation};

/// Planar loops need a rod more than spatial ones to move.
fn recipe(seed: u64) -> Recipe {
    let mut random = fastrand::Rng::with_seed(seed);
    let dimension = random.usize(2..=3);
    let rods = if random.u8(0..4) < 3 { random.usize(1..=3) } else { random.usize(4..=5) };
    let is_loop = random.bool() && rods + dimension > 4;
    let is_chain = random.bool() || is_loop;
    let is_redundant = random.bool();
    Recipe { dimension, rods, is_loop, is_chain, is_redundant, seed }
}

/// A state beside the start, with velocities of about 1; none where assembly does not close it.
fn moving(system: &dyn holonom::system::MechanicalSystem, q: &[f64], seed: u64) -> Option<(Vec<f64>, Vec<f64>)> {
    let n = system.dimensions();
    let mut numbers = Numbers(seed ^ 1);
    let q: Vec<f64> = q.iter().map(|q| q + 0.1 * numbers.next()).collect();
    let v: Vec<f64> = (0..n.v).map(|_| 2.0 * numbers.next()).collect();
    assemble(system, 0.0, (&q, &v), &[]).ok().map(|found| (found.q, found.v))
}

fn difference(a: &Matrix, b: &Matrix) -> f64 {
    (a - b).amax() / b.amax().max(f64::MIN_POSITIVE)
}

/// With the largest difference of A. Redundant rows agree with the others as well as assembly closes them, to 1e-10:
/// penalties weigh both, by the mean of what mechanisms have, so that theirs is what is left of 1e5 of it.
const PROJECTED: [(&str, f64); 4] = [
    ("baumgarte:projected=yes", 1e-8),
    ("force_projection:projected=yes", 1e-8),
    ("force_projection:alpha=20,projected=yes", 1e-8),
    ("augmented_lagrangian:penalty=1e5,iterations=4,projected=yes", 1e-5),
];

/// No root of theirs is real or near the values of the springs.
const RAW: [&str; 6] = [
    "rcs",
    "rcs:form=index2",
    "rcs:form=index1,solver=gsvd",
    "rcs:form=ggl",
    "baumgarte:alpha=7,beta=100",
    "force_projection:alpha=7,beta=100",
];

#[test]
fn at_moving_states() {
    for recipe in (0..64).map(recipe) {
        let scene = recipe.scene();
        let system = scene.system();
        let Some((q, v)) = moving(system, scene.0.start().0, recipe.seed) else { continue };
        let mut variation = Variation::new(system, 0.0, &q, &v).unwrap();
        for chart in [Chart::Intrinsic, Chart::MassOrthogonal, Chart::Frozen] {
            let exact = model(&mut variation, "mcs", Some(chart.clone()));
            for (method, most) in PROJECTED {
                let found = model(&mut variation, method, Some(chart.clone()));
                let off = difference(&found.a, &exact.a);
                assert!(off < most, "{recipe:?} {chart:?} {method}: {off:e}");
            }
        }
    }
}

#[test]
fn at_equilibria() {
    (64..128).map(recipe).for_each(check_equilibrium);
}

/// The spectra at the state where the mechanism rests; none where it does not find one.
fn check_equilibrium(recipe: Recipe) {
    let scene = recipe.scene();
    let system = scene.system();
    let Ok(found) = equilibrium(system, 0.0, scene.0.start()) else { return };
    let mut variation = Variation::new(system, 0.0, &found.q, &vec![0.0; system.dimensions().v]).unwrap();
    let exact = model(&mut variation, "mcs", Some(Chart::MassOrthogonal));
    let known = values(&exact, Kind::Physical);
    // An eigenvalue moves by the error of the matrix times its condition, which is at most that of the vectors.
    let most = (1e-13 * exact.cost.conditioning).max(1e-9);
    for chart in [Chart::Intrinsic, Chart::Frozen] {
        let off = distance(&values(&model(&mut variation, "mcs", Some(chart.clone())), Kind::Physical), &known);
        assert!(off < most, "{recipe:?} {chart:?}: {off:e} of {most:e}");
    }
    for method in RAW {
        let found = model(&mut variation, method, None);
        let conditioning = found.cost.conditioning;
        let most = most.max(if conditioning.is_finite() { 1e-13 * conditioning } else { 0.0 });
        let off = distance(&values(&found, Kind::Physical), &known);
        assert!(off < most, "{recipe:?} {method}: {off:e} of {most:e}");
    }
}

/// G has equal singular values on a single spherical joint, at which a decomposition once lost ten digits.
#[test]
fn at_equal_singular_values() {
    let seed = 16314324776247573605;
    let recipe = Recipe { dimension: 3, rods: 1, is_loop: false, is_chain: false, is_redundant: false, seed };
    check_equilibrium(recipe);
}
