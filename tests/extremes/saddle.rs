//! The saddle-point solve of a straight chain of unlike masses, whose solution is known.

use holonom::math::kkt::{Pattern, SaddlePoint};

const PULL: f64 = 9.81;
const ACROSS: f64 = 1.7;

/// Relative errors of the accelerations and of the multipliers under forces m (PULL along the chain, ACROSS it): all masses
/// accelerate across, and a rod carries the pull of all masses behind it.
fn errors(masses: &[f64]) -> [f64; 2] {
    let n = masses.len();
    let (sin, cos) = 0.7_f64.sin_cos();
    let ends = (0..n).flat_map(|i| [(i, i, 1.0)].into_iter().chain((i > 0).then(|| (i, i - 1, -1.0))));
    let places = ends.flat_map(|(row, body, sign)| [((row, 2 * body), sign * cos), ((row, 2 * body + 1), sign * sin)]);
    let (entries, g): (Vec<_>, Vec<f64>) = places.unzip();
    let mass: Vec<f64> = masses.iter().flat_map(|m| [*m, *m]).collect();
    let mut kkt = SaddlePoint::new(&Pattern::diagonal(2 * n), &Pattern { rows: n, cols: 2 * n, entries });
    kkt.factor(&mass, &g).unwrap();
    let forces = masses.iter().flat_map(|m| [m * (PULL * cos - ACROSS * sin), m * (PULL * sin + ACROSS * cos)]);
    let (mut a, mut lambda): (Vec<f64>, _) = (forces.collect(), vec![0.0; n]);
    kkt.solve(&mut a, &mut lambda).unwrap();
    let off = a.chunks(2).map(|a| (a[0] + ACROSS * sin).hypot(a[1] - ACROSS * cos) / ACROSS).fold(0.0, f64::max);
    let behind = |i: usize| masses[i..].iter().sum::<f64>() * PULL;
    [off, (0..n).map(|i| (lambda[i] / behind(i) - 1.0).abs()).fold(0.0, f64::max)]
}

/// Tensions keep nine digits: round-off over the squared sine, which is the ratio of the masses, is refined away below
/// 1e-7. Accelerations of a light mass cannot be better than round-off of the tensions that pull it from both sides.
#[test]
fn tensions_keep_nine_digits_whatever_the_masses() {
    for exponent in -16..=16 {
        let r = 10f64.powi(exponent);
        for masses in [[1.0, r, 1.0, r, 1.0, r], [1.0, 1.0, 1.0, 1.0, 1.0, r]] {
            let [a, tension] = errors(&masses);
            let lightest = masses.iter().copied().fold(1.0, f64::min);
            let pull = masses.iter().sum::<f64>() * PULL / (lightest * ACROSS);
            println!("{masses:?}: {a:e} {tension:e} {:e}", f64::EPSILON * pull);
            assert!(tension < 1e-9, "{masses:?}: {tension:e}");
            // A few roundings, and the refinement that is not worth its time above a sine of 3e-4.
            assert!(a < 10.0 * f64::EPSILON * pull, "{masses:?}: {a:e}");
        }
    }
}
