//! Natural frequencies of a tapered cantilever.

use crate::frequencies::frequencies;
use crate::scenes::{Ready, parse};

/// A cantilever of length and width one whose height falls to half of it, in units of EI and rho A at its root; so thin
/// that the rotary inertia of its sections counts 1e-7.
fn cantilever(frame: &str, keys: &str) -> Ready {
    parse(&format!(
        r#"{{ "name": "beam", "dimension": 2, "ground": {{ "markers": {{ "a": [0, 0] }} }},
        "parameters": {{ "h": 1e-3 }},
        "bodies": [ {{ "name": "rod", "type": "flexible_beam", "frame": "{frame}", "length": 1, {keys},
            "material": {{ "E": "12/h^3", "rho": "1/h" }},
            "section": {{ "rectangle": {{ "height": "h*(1 - s/2)", "width": 1 }} }}, "markers": {{ "a": [0, 0] }} }} ],
        "joints": [ {{ "name": "a", "type": "weld", "between": ["ground.a", "rod.a"] }} ] }}"#
    ))
}

/// omega L^2 sqrt(rho A_0/EI_0) of the first three modes (Mabie and Rogers, J. Acoust. Soc. Am. 51 (1972) 1771-1774;
/// Naguleswaran, J. Sound Vib. 172 (1994) 289-304).
const EXACT: [f64; 3] = [3.82378, 18.3173, 47.2648];

#[test]
fn a_tapered_cantilever_converges_to_published_frequencies() {
    for (frame, order, last) in [("floating", 4.0, 1e-5), ("absolute", 2.0, 3e-3)] {
        for (mode, exact) in EXACT.into_iter().enumerate() {
            let errors = [2, 4, 8, 16].map(|n| {
                let found = frequencies(&cantilever(frame, &format!("\"elements\": {n}")));
                (found[mode] / exact - 1.0).abs()
            });
            let orders = [0, 1, 2].map(|i| (errors[i] / errors[i + 1]).log2());
            println!("{frame}, mode {mode}: {errors:.1e?} {orders:.2?}");
            assert!(errors[3] < last, "{frame} {errors:?}");
            // Six digits are published.
            assert!(errors[2] < 1e-5 || orders[1] > order - 0.4, "{frame} {errors:?} {orders:?}");
        }
    }
}

/// Displacement functions of choice, here powers of x.
#[test]
fn functions_see_the_taper() {
    let keys = r#""ritz": { "bending": ["x^2", "x^3", "x^4", "x^5", "x^6", "x^7"] }"#;
    let found = frequencies(&cantilever("floating", keys));
    for (found, exact) in found.iter().zip(EXACT) {
        assert!((found / exact - 1.0).abs() < 1e-4, "{found} {exact}");
    }
    let modes = frequencies(&cantilever("floating", r#""elements": 16, "modes": 4"#));
    for (found, exact) in modes.iter().zip(EXACT) {
        assert!((found / exact - 1.0).abs() < 1e-5, "{found} {exact}");
    }
}
