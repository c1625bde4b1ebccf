//! A bound of the rates of modes.

use crate::math::kkt::Pattern;
use crate::math::largest;

/// A rate that no mode of M x'' + C x' + K x = 0 exceeds, 1/s. M is given by its lower triangle, all with their places.
/// `None` where M has no dominant diagonal, or something is not finite.
///
/// With M >= D, diagonal, a mode of velocity x has abs(s)^2 <= c abs(s) + k for the norms k and c of D^-1/2 K D^-1/2 and
/// D^-1/2 C D^-1/2, which are at most the roots of their largest sums over rows times columns; constraints only take
/// directions away.
pub fn rate_bound(mass_places: &Pattern, mass: &[f64], places: &Pattern, k: &[f64], c: &[f64]) -> Option<f64> {
    let mut least = vec![0.0; mass_places.rows];
    for (&(i, j), &mass) in mass_places.entries.iter().zip(mass) {
        if i == j { least[i] += mass } else { [i, j].iter().for_each(|&i| least[i] -= mass.abs()) }
    }
    let roots: Vec<f64> = least.iter().map(|mass| mass.sqrt()).collect();
    let norm = |values: &[f64]| {
        let mut rows = vec![0.0; roots.len()];
        let mut columns = vec![0.0; roots.len()];
        for (&(i, j), value) in places.entries.iter().zip(values).filter(|(_, value)| **value != 0.0) {
            let size = value.abs() / (roots[i] * roots[j]);
            rows[i] += size;
            columns[j] += size;
        }
        (largest(&rows) * largest(&columns)).sqrt()
    };
    let k = norm(k);
    let c = norm(c);
    let bound = 0.5 * (c + (c * c + 4.0 * k).sqrt());
    (least.iter().all(|mass| *mass > 0.0) && bound.is_finite()).then_some(bound)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two masses, 1 and 3 kg, that a joint holds together, on a spring and a damper: 4 x'' + c x' + k x = 0.
    #[test]
    fn no_mode_is_faster() {
        for (stiffness, damping, mode) in [
            (100.0, 0.0, [0.0, 5.0]),
            (100.0, 2.0, [0.25, (25.0f64 - 1.0 / 16.0).sqrt()]),
            (100.0, 50.0, [10.0, 0.0]),
            (-100.0, 0.0, [5.0, 0.0]),
        ] {
            let tangent = [stiffness, damping].map(|value| vec![value, 0.0, 0.0, 0.0]);
            let mass = [1.0, 0.0, 3.0];
            let bound =
                rate_bound(&Pattern::lower(2), &mass, &Pattern::dense(2, 2), &tangent[0], &tangent[1]).unwrap_or(0.0);
            assert!(bound >= mode[0].hypot(mode[1]), "{stiffness} {damping}: {bound}");
        }
    }
}
