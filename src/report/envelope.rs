//! Restless curves made readable.

/// The largest value within each of `windows` windows: drift at round-off jumps between zero and 1e-16 from row to
/// row, and a curve through all of it hides the others. Windows without a positive value are left out.
pub fn envelope(points: impl Iterator<Item = (f64, f64)>, rows: usize, windows: usize) -> Vec<(f64, f64)> {
    let points: Vec<(f64, f64)> = points.collect();
    let width = rows.div_ceil(windows).max(1);
    let largest = |window: &[(f64, f64)]| {
        window.iter().copied().max_by(|a, b| a.1.total_cmp(&b.1)).map(|(_, value)| (window[window.len() / 2].0, value))
    };
    points.chunks(width).filter_map(largest).filter(|(_, value)| *value > 0.0).collect()
}
