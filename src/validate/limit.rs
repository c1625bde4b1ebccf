//! Limits of measured values, with their uncertainty.

/// The limit of values as their sizes go to zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    /// The limit.
    pub value: f64,
    /// Its uncertainty; infinite where fewer than three values are known.
    pub uncertainty: f64,
}

/// Returns the limit of `values`, a series in size^power, at decreasing `sizes`. `rounding` is that of value times size.
///
/// Richardson's extrapolation in Neville's scheme. The limit is the entry T_ij of the table with the least uncertainty:
/// its largest difference from the neighbours of lower order, and the rounding of its values times the sum of their
/// weights. As the least of many may be so by chance, it is not told better than the next ones agree with it.
pub fn limit(sizes: &[f64], values: &[f64], power: i32, rounding: f64) -> Limit {
    let mut found: Vec<Limit> = Vec::new();
    let mut previous: Vec<f64> = Vec::new();
    for (i, value) in values.iter().enumerate() {
        let mut row = vec![*value];
        let mut weights = 1.0;
        for j in 1..=i {
            let ratio = (sizes[i - j] / sizes[i]).powi(power);
            weights *= (ratio + 1.0) / (ratio - 1.0);
            let next = row[j - 1] + (row[j - 1] - previous[j - 1]) / (ratio - 1.0);
            let neighbours = [row[j - 1], previous[j - 1]].into_iter().chain(previous.get(j).copied());
            let spread = neighbours.map(|other| (next - other).abs()).fold(0.0, f64::max);
            let uncertainty = spread + weights * rounding / sizes[i];
            if i > 1 && uncertainty.is_finite() {
                found.push(Limit { value: next, uncertainty });
            }
            row.push(next);
        }
        previous = row;
    }
    found.sort_by(|a, b| a.uncertainty.total_cmp(&b.uncertainty));
    let Some((best, others)) = found.split_first() else {
        return Limit { value: f64::NAN, uncertainty: f64::INFINITY };
    };
    let agreed = others.iter().take(COMPARED).map(|other| (other.value - best.value).abs());
    Limit { uncertainty: agreed.fold(best.uncertainty, f64::max), ..*best }
}

/// Entries of the table that are compared with the best one.
const COMPARED: usize = 4;

#[cfg(test)]
mod tests {
    use super::limit;

    #[test]
    fn a_derivative_by_central_differences_is_within_its_uncertainty() {
        let sizes: Vec<f64> = (0..8).map(|i| 0.1 * 0.25f64.powi(i)).collect();
        for x in [0.3, 1.0, 2.0f64] {
            let values: Vec<f64> = sizes.iter().map(|h| ((x + h).sin() - (x - h).sin()) / (2.0 * h)).collect();
            let found = limit(&sizes, &values, 2, f64::EPSILON);
            let error = (found.value - x.cos()).abs();
            assert!(error <= found.uncertainty && found.uncertainty < 1e-11, "{x}: {error:e} {found:?}");
        }
    }

    #[test]
    fn a_limit_from_one_side() {
        let sizes: Vec<f64> = (0..14).map(|i| 0.5f64.powi(i)).collect();
        let values: Vec<f64> = sizes.iter().map(|h| (h.exp() - 1.0) / h).collect();
        let found = limit(&sizes, &values, 1, f64::EPSILON);
        assert!((found.value - 1.0).abs() <= found.uncertainty && found.uncertainty < 1e-11, "{found:?}");
        assert!(limit(&sizes[..2], &values[..2], 1, 0.0).uncertainty.is_infinite());
    }
}
