//! Natural frequencies of a tapered cantilever.

use crate::frequencies::frequencies;
use crate::scenes::{Ready, parse};
use holonom::body::flexible::{gauss_legendre, on_interval};
use nalgebra::{Cholesky, DMatrix, SymmetricEigen};

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

/// omega L^2 sqrt(rho A_0/EI_0) of the first three modes by Ritz with x^2 (2 x - 1)^k, k < 10.
fn exact() -> Vec<f64> {
    const N: usize = 10;
    let shape = |k: usize, x: f64| {
        let (y, n) = (2.0 * x - 1.0, k as f64);
        let power = |less: usize| if k >= less { y.powi((k - less) as i32) } else { 0.0 };
        let bent = 2.0 * power(0) + 8.0 * x * n * power(1) + 4.0 * x * x * n * (n - 1.0) * power(2);
        (x * x * power(0), bent)
    };
    let (mut k, mut m) = (DMatrix::<f64>::zeros(N, N), DMatrix::<f64>::zeros(N, N));
    for (x, weight) in on_interval(&gauss_legendre(16), [0.0, 1.0]) {
        let height = 1.0 - x / 2.0;
        for (i, j) in (0..N).flat_map(|i| (0..N).map(move |j| (i, j))) {
            let (a, b) = (shape(i, x), shape(j, x));
            k[(i, j)] += weight * height.powi(3) * a.1 * b.1;
            m[(i, j)] += weight * height * a.0 * b.0;
        }
    }
    let inverse = Cholesky::new(k).unwrap().l().try_inverse().unwrap();
    let mut periods: Vec<f64> =
        SymmetricEigen::new(&inverse * m * inverse.transpose()).eigenvalues.iter().copied().collect();
    periods.sort_by(|a, b| b.total_cmp(a));
    periods.iter().take(3).map(|square| 1.0 / square.sqrt()).collect()
}

/// Of the first three modes (Mabie and Rogers, J. Acoust. Soc. Am. 51 (1972) 1771-1774; Naguleswaran, J. Sound Vib. 172
/// (1994) 289-304).
const PUBLISHED: [f64; 3] = [3.8238, 18.3173, 47.2648];

#[test]
fn a_tapered_cantilever_converges_to_published_frequencies() {
    let all = exact();
    println!("exact {all:?}");
    assert!(all.iter().zip(PUBLISHED).all(|(exact, published)| (exact / published - 1.0).abs() < 1e-5), "{all:?}");
    for (frame, order, last, finer) in [("floating", 4.0, 5e-5, 1), ("absolute", 2.0, 2e-4, 4)] {
        for (mode, exact) in all.iter().enumerate() {
            let errors = [2, 4, 8, 16].map(|n| n * finer).map(|n| {
                let found = frequencies(&cantilever(frame, &format!("\"elements\": {n}")));
                (found[mode] / exact - 1.0).abs()
            });
            let orders = [0, 1, 2].map(|i| (errors[i] / errors[i + 1]).log2());
            println!("{frame}, mode {mode}: {errors:?} {orders:.2?}");
            assert!(errors[3] < last, "{frame} {errors:?}");
            // Rotary inertia, 1e-7 a mode and more of higher ones, shows below 1e-6.
            let fine = if errors[3] > 2e-6 { orders[2] } else { orders[1] };
            assert!((fine - order).abs() < 0.4, "{frame} {errors:?} {orders:?}");
        }
    }
}

/// Displacement functions of choice, here powers of x.
#[test]
fn functions_see_the_taper() {
    let keys = r#""ritz": { "bending": ["x^2", "x^3", "x^4", "x^5", "x^6", "x^7", "x^8", "x^9"] }"#;
    let found = frequencies(&cantilever("floating", keys));
    for (found, exact) in found.iter().zip(exact()) {
        assert!((found / exact - 1.0).abs() < 1e-4, "{found} {exact}");
    }
    let modes = frequencies(&cantilever("floating", r#""elements": 16, "modes": 4"#));
    for (found, exact) in modes.iter().zip(exact()) {
        assert!((found / exact - 1.0).abs() < 5e-5, "{found} {exact}");
    }
}
