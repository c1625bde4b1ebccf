//! Sums, norms and comparisons of plain vectors.

/// True if no entry is infinite or NaN, of which 0 x is NaN; in four sums so that it vectorizes.
pub fn all_finite(x: &[f64]) -> bool {
    let (chunks, rest) = x.as_chunks::<4>();
    let mut sums = [0.0; 4];
    for chunk in chunks {
        (0..4).for_each(|i| sums[i] += 0.0 * chunk[i]);
    }
    sums.iter().sum::<f64>() + rest.iter().map(|x| 0.0 * x).sum::<f64>() == 0.0
}

/// x^T y of equal lengths, in four sums so that it vectorizes.
#[inline]
pub fn dot(x: &[f64], y: &[f64]) -> f64 {
    let (xs, x_rest) = x.as_chunks::<4>();
    let (ys, y_rest) = y.as_chunks::<4>();
    let rest: f64 = x_rest.iter().zip(y_rest).map(|(x, y)| x * y).sum();
    let mut sums = [0.0; 4];
    for (x, y) in xs.iter().zip(ys) {
        for k in 0..4 {
            sums[k] += x[k] * y[k];
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

/// Euclidean norm of x.
pub fn norm(x: &[f64]) -> f64 {
    dot(x, x).sqrt()
}

/// y += x.
pub fn add(x: &[f64], y: &mut [f64]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += x;
    }
}

/// y += factor x.
pub fn add_scaled(factor: f64, x: &[f64], y: &mut [f64]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += factor * x;
    }
}

/// max |x_i|; zero for an empty slice; NaN is ignored.
pub fn largest(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |largest, x| f64::max(largest, x.abs()))
}

/// max |x_i / units_i|, as [`largest`].
pub fn largest_in(units: &[f64], x: &[f64]) -> f64 {
    x.iter().zip(units).fold(0.0, |largest, (x, unit)| f64::max(largest, (x / unit).abs()))
}

/// The index of the entry of largest magnitude.
pub fn index_of_largest(x: &[f64]) -> usize {
    (0..x.len()).fold(0, |best, i| if x[i].abs() > x[best].abs() { i } else { best })
}

/// The least and the largest of some values, NaN ignored; infinity and minus infinity without any.
pub fn bounds(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
    values.into_iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
}
