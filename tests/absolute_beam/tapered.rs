//! Natural frequencies of a tapered cantilever.

use crate::absolute_beam::frequencies::frequencies;
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

/// Shapes with (h^3 w'')'' = w^2 h w, h = 1 - x/2, as power series: they converge where h > 0, at the tip as 2^-n. Of the
/// two with w = w' = 0 at the clamp, the second and third derivatives at the tip make a determinant, which is zero where
/// some of both carries neither moment nor force there: at the frequencies.
fn determinant(frequency: f64) -> f64 {
    const N: usize = 80;
    let cube = [1.0, -1.5, 0.75, -0.125];
    let ends = [2, 3].map(|start| {
        let mut a = [0.0; N + 4];
        a[start] = 1.0;
        let second = |a: &[f64], n: usize| ((n + 2) * (n + 1)) as f64 * a[n + 2];
        for n in 0..N {
            let load = frequency * frequency * (a[n] - if n > 0 { 0.5 * a[n - 1] } else { 0.0 });
            let known: f64 = (1..4.min(n + 3)).map(|k| cube[k] * second(&a, n + 2 - k)).sum();
            a[n + 4] = (load / ((n + 2) * (n + 1)) as f64 - known) / ((n + 4) * (n + 3)) as f64;
        }
        [0, 1].map(|power| (0..N).map(|n| (n as f64).powi(power) * second(&a, n)).sum::<f64>())
    });
    ends[0][0] * ends[1][1] - ends[0][1] * ends[1][0]
}

/// omega L^2 sqrt(rho A_0/EI_0) of the first three modes: 3.82379, 18.3173, 47.2648.
fn exact() -> Vec<f64> {
    let range = |k: i32| [f64::from(k), f64::from(k + 1)];
    let changes = (1..50).map(range).filter(|range| determinant(range[0]) * determinant(range[1]) < 0.0);
    let bisected = |mut range: [f64; 2]| {
        let before = determinant(range[0]).is_sign_positive();
        for _ in 0..50 {
            let middle = 0.5 * (range[0] + range[1]);
            range[usize::from(determinant(middle).is_sign_positive() != before)] = middle;
        }
        range[0]
    };
    changes.map(bisected).collect()
}

#[test]
fn a_tapered_cantilever_converges_to_its_frequencies() {
    let all = exact();
    println!("exact {all:?}");
    assert_eq!(all.len(), 3);
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
