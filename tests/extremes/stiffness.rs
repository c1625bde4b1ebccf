//! Springs of any stiffness in a chain.

use crate::extremes::chain::{Chain, Link};
use crate::extremes::masses::{METHODS, errors};
use Link::{Rod, Spring};

/// From springs that hardly pull to springs that are as good as rods and swing at 2e5 rad/s: by 1e-9 m, so that velocities
/// keep digits of positions times that, and tensions those times 1e10 N/m.
#[test]
fn springs_of_any_stiffness() {
    for (k, end) in [(1e-3, 0.1), (1e4, 0.1), (1e8, 0.02), (1e10, 0.01)] {
        let chain = Chain { speed: 1.0, ..Chain::new(2, &[1.0; 4], &[Rod, Spring(k), Rod, Spring(k)]) };
        for [q, v, _] in errors(&chain, &METHODS, 1e-10, end) {
            assert!(q < 1e-9 && v < 1e-5, "{k:e}: {q:e} {v:e}");
        }
    }
}
