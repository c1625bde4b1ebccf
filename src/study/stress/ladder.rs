//! Values over many powers of ten.

/// Returns 1, 2, 5, 10, 20 ... from `low` to `high`.
pub fn sequence(low: f64, high: f64) -> Vec<f64> {
    let decades = low.log10().floor() as i32..=high.log10().ceil() as i32;
    let rungs = decades.flat_map(|exponent| [1, 2, 5].into_iter().map(move |digit| decimal(digit, exponent)));
    rungs.filter(|rung| (low * (1.0 - 1e-9)..=high * (1.0 + 1e-9)).contains(rung)).collect()
}

/// Returns every `stride`-th power of ten.
pub fn decades(from: i32, to: i32, stride: usize) -> Vec<f64> {
    (from..=to).step_by(stride).map(|exponent| decimal(1, exponent)).collect()
}

/// Returns the number nearest to digit 10^exponent.
fn decimal(digit: u32, exponent: i32) -> f64 {
    format!("{digit}e{exponent}").parse().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ladders_have_round_rungs() {
        assert_eq!(sequence(4e-3, 0.11), [5e-3, 0.01, 0.02, 0.05, 0.1]);
        assert_eq!(sequence(1.0, 1.0), [1.0]);
        assert_eq!(decades(-4, 4, 4), [1e-4, 1.0, 1e4]);
    }
}
