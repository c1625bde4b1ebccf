//! The phase of a frequency response, without jumps.

use crate::linearize::Complex;
use crate::tolerances;

/// Returns phases in degrees without jumps of 360; NaN where the response is zero or has a pole.
///
/// The first phase is 90 n plus the angle of H / i^n, about 0 or -180 by its sign, where H grows as w^n: a rate leads its
/// quantity by 90 everywhere. Of two steps of 180, which an undamped response makes, a pole has the one down and a zero
/// the one up.
pub(super) fn phases(frequencies: &[f64], values: &[Complex<f64>]) -> Vec<f64> {
    let mut phases = vec![f64::NAN; values.len()];
    let known: Vec<usize> =
        (0..values.len()).filter(|&i| values[i].norm() > 0.0 && values[i].norm().is_finite()).collect();
    for (k, &i) in known.iter().enumerate() {
        let angle = degrees(values[i]);
        let near = match k.checked_sub(1).map(|before| phases[known[before]]) {
            None => first(frequencies, values, &known),
            Some(before) => before + step(values, &known, k, angle - before),
        };
        phases[i] = angle + 360.0 * ((near - angle) / 360.0).round();
    }
    phases
}

/// Largest power of the frequency that a response is taken to begin with.
const STEEPEST: f64 = 4.0;

/// Returns the phase at the first known value, by the power of the frequency with which the response begins.
fn first(frequencies: &[f64], values: &[Complex<f64>], known: &[usize]) -> f64 {
    let Some(&first) = known.first() else { return 0.0 };
    let log = |place: usize| (frequencies[place].ln(), values[place].norm().ln());
    let slope = match known.get(1).map(|&second| (log(first), log(second))) {
        Some((a, b)) => (b.1 - a.1) / (b.0 - a.0),
        None => 0.0,
    };
    let power = if slope.abs() <= STEEPEST { slope.round() } else { 0.0 };
    let rest = degrees(values[first] / Complex::I.powi(power as i32));
    90.0 * power + if rest > 90.0 { rest - 360.0 } else { rest }
}

/// Returns the step of the phase to the known value `k`, in degrees from -180 to 180; `turn` is the step but for whole
/// turns.
fn step(values: &[Complex<f64>], known: &[usize], k: usize, turn: f64) -> f64 {
    let step = turn - 360.0 * (turn / 360.0).round();
    // In degrees: ten digits of a damped response are farther away.
    if step.abs() < 180.0 - 1e-3 {
        return step;
    }
    // Between the two values the response is infinite or zero: towards a pole it grows, from it it falls.
    let size = |k: usize| values[known[k]].norm();
    let before = if k > 1 { size(k - 1) / size(k - 2) } else { 1.0 };
    let after = if k + 1 < known.len() { size(k) / size(k + 1) } else { 1.0 };
    if before * after >= 1.0 { -180.0 } else { 180.0 }
}

/// Angle in degrees; what is zero to round-off is zero.
fn degrees(value: Complex<f64>) -> f64 {
    Some(value.arg().to_degrees()).filter(|angle| angle.abs() > tolerances::SAME).unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid() -> Vec<f64> {
        (0..200).map(|k| 10f64.powf(-2.0 + 0.02 * f64::from(k))).collect()
    }

    fn of(response: impl Fn(Complex<f64>) -> Complex<f64>) -> Vec<f64> {
        let values: Vec<Complex<f64>> = grid().into_iter().map(|f| response(Complex::new(0.0, f))).collect();
        phases(&grid(), &values)
    }

    fn c(re: f64) -> Complex<f64> {
        Complex::new(re, 0.0)
    }

    #[test]
    fn phases_do_not_jump() {
        // Three lags in a row: from 0 down to -270 degrees.
        let found = of(|s| (s + 1.0).powi(-3));
        assert!(found.windows(2).all(|pair| pair[1] < pair[0] && pair[0] - pair[1] < 10.0));
        assert!((found[199] + 270.0).abs() < 4.0, "{}", found[199]);
        assert!(of(|_| c(0.0))[0].is_nan());
    }

    #[test]
    fn a_rate_leads_its_quantity_by_a_right_angle() {
        let responses: [fn(Complex<f64>) -> Complex<f64>; 5] = [
            |s| (s * s + 1.0).inv(),
            |s| -(s * s + 1.0).inv(),
            |s| (s * s + s * 0.1 + 1.0).inv(),
            |s| (s * s).inv(),
            |s| (s * s + 0.25) / ((s * s + 0.01) * (s * s + 1.0)),
        ];
        for response in responses {
            let quantity = of(response);
            let rates = [of(|s| s * response(s)), of(|s| s * s * response(s))];
            for (rate, lead) in rates.iter().zip([90.0, 180.0]) {
                let off = quantity.iter().zip(rate).map(|(a, b)| (b - a - lead).abs());
                assert!(off.fold(0.0, f64::max) < 1e-6, "{quantity:?} {rate:?}");
            }
        }
        assert_eq!(of(|s| s / (s * s + 1.0))[0], 90.0);
        // A negative gain with a lag begins below -180.
        assert!((-181.0..-180.0).contains(&of(|s| -(s + 1.0).inv())[0]));
    }

    #[test]
    fn undamped_poles_lag_and_undamped_zeros_lead() {
        let found = of(|s| (s * s + 0.25) / ((s * s + 0.01) * (s * s + 1.0)));
        let at = |f: f64| found[grid().iter().position(|x| *x > f).unwrap()].round();
        assert_eq!([0.05, 0.3, 0.7, 2.0].map(at), [0.0, -180.0, 0.0, -180.0]);
    }
}
