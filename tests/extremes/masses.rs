//! Masses that differ by eight orders of magnitude, beside each other in a chain.

use crate::common::{Run, adaptive, distance, run, until};
use crate::extremes::chain::{Chain, Exact, Link::Rod};

/// Largest errors of q over the length of a link, of v over the largest, and of tensions over the largest.
pub fn errors(chain: &Chain, methods: &[[&str; 3]], tolerance: f64, end: f64) -> Vec<[f64; 3]> {
    let ready = chain.scene();
    let (exact, forces) = Exact::new(chain).run(ready.0.start(), end);
    let compare = |[formulation, integrator, projection]: &[&str; 3]| {
        let method = adaptive(formulation, integrator, projection, tolerance);
        let run: Run = run(ready.system(), &method, until(end), ready.0.start()).completed();
        let (q, v, lambda) = run.last();
        let (positions, velocities) = exact.split_at(q.len());
        let size = |x: &[f64]| x.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
        let errors = [
            distance(q, positions) / chain.length,
            distance(v, velocities) / size(velocities),
            distance(lambda, &forces) / size(&forces),
        ];
        println!("{formulation} {integrator}: {errors:?} {:?}", run.outcome.statistics);
        errors
    };
    methods.iter().map(compare).collect()
}

pub const METHODS: [[&str; 3]; 5] = [
    ["index1", "dop853", "manifold"],
    ["index1", "dopri5", "manifold"],
    ["index2", "phem56", "none"],
    ["index2", "radau_iia", "none"],
    ["ggl", "radau_iia", "none"],
];

/// Light masses follow the heavy ones, and are as accurate as they.
#[test]
fn light_masses_behind_heavy_ones() {
    for dimension in [2, 3] {
        let chain = Chain::new(dimension, &[1.0, 1e-8, 1.0, 1e-8], &[Rod; 4]);
        for [q, v, tension] in errors(&chain, &METHODS, 1e-10, 0.3) {
            assert!(q < 1e-9 && v < 1e-8 && tension < 3e-8, "{q:e} {v:e} {tension:e}");
        }
    }
}

/// Heavy masses fall freely until a light one between them snaps into line, in 1e-8 s, at 4 km/s, where the sine of its
/// rods' rows is 1e-4: what it does then depends 1e4 times on what it did before. Methods that hold phi = 0 itself by
/// Newton's method (ggl, index3) may end there, since round-off of phi over that sine and a step of 1e-8 s is too much.
#[test]
fn a_light_mass_between_heavy_ones_snaps_into_line() {
    for dimension in [2, 3] {
        let chain = Chain::new(dimension, &[1.0, 1e8, 1.0, 1e8], &[Rod; 4]);
        for [q, v, tension] in errors(&chain, &METHODS[..4], 1e-10, 0.45) {
            assert!(q < 1e-6 && v < 1e-6 && tension < 1e-5, "{q:e} {v:e} {tension:e}");
        }
    }
}

/// Under a tension of 1e9 N masses of 1 kg swing at 3e4 rad/s, by 1e-5 m: positions keep their digits, velocities those of
/// positions times that frequency, and round-off of a direction, 1e-16, is 1e-7 m/s^2.
#[test]
fn light_masses_on_a_string_with_a_heavy_end() {
    let hanging = Chain { is_straight: true, ..Chain::new(2, &[1.0, 1.0, 1.0, 1e8], &[Rod; 4]) };
    let plucked = Chain { is_straight: true, speed: 1.0, ..Chain::new(2, &[1.0, 1e8, 1.0, 1e8], &[Rod; 4]) };
    for chain in [hanging, plucked] {
        for [q, v, tension] in errors(&chain, &METHODS, 1e-10, 0.02) {
            assert!(q < 1e-8 && v < 2e-4 && tension < 1e-5, "{q:e} {v:e} {tension:e}");
        }
    }
}
