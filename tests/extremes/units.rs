//! The same chain in other units of length and mass: the same steps and the same digits.

use crate::common::{adaptive, distance, fixed, run, until};
use crate::extremes::chain::{Chain, Link};
use Link::{Rod, Spring};
use holonom::simulate::Method;

fn scaled(chain: &Chain, [length, mass]: [f64; 2]) -> Chain {
    let links = chain.links.iter().map(|link| match link {
        Spring(k) => Spring(k * mass),
        Rod => Rod,
    });
    Chain {
        dimension: chain.dimension,
        masses: chain.masses.iter().map(|m| m * mass).collect(),
        links: links.collect(),
        length: chain.length * length,
        gravity: chain.gravity * length,
        is_straight: chain.is_straight,
        speed: chain.speed * length,
    }
}

/// q, v and lambda in the first units, and the number of steps.
fn end(chain: &Chain, method: &Method, units: [f64; 2]) -> ([Vec<f64>; 3], [u64; 2]) {
    let [length, mass] = units;
    let ready = scaled(chain, units).scene();
    let method = Method { atol: method.atol * length, ..method.clone() };
    let run = run(ready.system(), &method, until(0.3), ready.0.start()).completed();
    let (q, v, lambda) = run.last();
    let back = |x: &[f64], unit: f64| x.iter().map(|x| x / unit).collect::<Vec<f64>>();
    let statistics = run.outcome.statistics;
    ([back(q, length), back(v, length), back(lambda, length * mass)], [statistics.steps, statistics.rejected])
}

/// Micrometres, megametres, and masses of 1e-12 and 1e12 kg, by powers of four, which no rounding of roots sees.
const UNITS: [[f64; 2]; 4] = [
    [1.0 / (1 << 20) as f64, 1.0],
    [(1 << 20) as f64, 1.0],
    [1.0, 1.0 / (1_u64 << 40) as f64],
    [1.0, (1_u64 << 40) as f64],
];

/// `most`: relative error of q, v and lambda.
fn compare(method: &Method, most: f64) {
    let chain = Chain { speed: 1.0, ..Chain::new(2, &[1.0, 0.5, 2.0], &[Rod, Spring(100.0), Rod]) };
    let (ours, steps) = end(&chain, method, [1.0, 1.0]);
    for units in UNITS {
        let (theirs, their_steps) = end(&chain, method, units);
        let relative = |(x, y): (&Vec<f64>, &Vec<f64>)| distance(x, y) / distance(x, &vec![0.0; x.len()]);
        let error = ours.iter().zip(&theirs).map(relative).fold(0.0, f64::max);
        let what = format!("{} {} {units:?}", method.formulation.name, method.integrator.name);
        println!("{what}: {error:e}");
        assert_eq!(steps, their_steps, "{what}");
        assert!(error < most, "{what}: {error:e}");
    }
}

/// Round-off only.
#[test]
fn adaptive_methods_do_not_see_units() {
    let methods = [
        ["index1", "dop853", "manifold"],
        ["index1", "dop853", "exact"],
        ["index1", "dop853", "full"],
        ["null_space", "dop853", "none"],
        ["index1", "dopri5", "manifold"],
        ["index2", "phem56", "none"],
        ["ggl", "radau_iia", "none"],
        ["index2", "radau_iia", "none"],
        ["index1", "radau_iia", "none"],
    ];
    methods.iter().for_each(|[f, i, p]| compare(&adaptive(f, i, p, 1e-8), 1e-12));
    // Of bdf round-off of six states is extrapolated at every step; v of index3 is phi over the step.
    ["ggl", "index1"].iter().for_each(|f| compare(&adaptive(f, "bdf", "none", 1e-8), 1e-11));
    compare(&adaptive("index3", "radau_iia", "none", 1e-8), 1e-11);
}

/// The equations of a fixed step are solved to round-off, in all units.
#[test]
fn fixed_steps_do_not_see_units() {
    compare(&fixed("index3", "rattle", "none", 1e-3), 1e-12);
    compare(&fixed("ggl", "radau_iia", "none", 1e-3), 1e-12);
    compare(&fixed("index3", "generalized_alpha", "none", 1e-3), 1e-12);
    // Shifts are told from round-off by its size in one number for all of q, which may end iterations elsewhere in megametres: 2.7e-10
    // was found.
    compare(&fixed("ggl", "generalized_alpha", "none", 1e-3), 1e-9);
    compare(&fixed("index3", "ali3p", "none", 1e-3), 1e-12);
}
