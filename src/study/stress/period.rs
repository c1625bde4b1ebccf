//! The period of a motion.

/// Returns the mean time between upward crossings of the mean; none with fewer than two.
pub fn period(times: &[f64], values: &[f64]) -> Option<f64> {
    let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
    let range = values.iter().fold(0.0, |range: f64, value| range.max((value - mean).abs()));
    let crossings: Vec<f64> = times
        .windows(2)
        .zip(values.windows(2))
        .filter(|(_, pair)| pair[0] < mean && pair[1] >= mean && range > 1e-9 * mean.abs())
        .map(|(times, _)| times[1])
        .collect();
    match crossings.as_slice() {
        [first, .., last] => Some((last - first) / (crossings.len() - 1) as f64),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn periods_are_counted() {
        let times: Vec<f64> = (0..1000).map(|k| 0.01 * f64::from(k)).collect();
        let wave: Vec<f64> = times.iter().map(|t| (std::f64::consts::PI * t).sin()).collect();
        assert!(period(&times, &wave).is_some_and(|found| (found - 2.0).abs() < 0.02));
        assert_eq!(period(&times, &times), None);
    }
}
