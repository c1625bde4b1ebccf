//! Exact decimal numbers for labels: n * 10^power, so that 0.1 + 0.2 reads 0.3.

/// Returns `digits * 10^power` in plain notation, with a true minus sign and `places` digits after the point.
pub(super) fn plain(digits: i64, power: i32, places: usize) -> String {
    format!("{:.places$}", value(digits, power)).replace('-', "−")
}

/// Returns the number of digits after the point that `digits * 10^power` needs.
pub(super) fn places(digits: i64, power: i32) -> usize {
    let (mut digits, mut power) = (digits, power);
    while digits != 0 && digits % 10 == 0 {
        digits /= 10;
        power += 1;
    }
    if digits == 0 || power >= 0 { 0 } else { power.unsigned_abs() as usize }
}

/// Returns "10" with a superscript exponent.
pub(in crate::plot) fn power_of_ten(exponent: i32) -> String {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digits = exponent.unsigned_abs().to_string();
    let raised: String = digits.bytes().map(|digit| RAISED[usize::from(digit - b'0') % 10]).collect();
    if exponent < 0 { format!("10⁻{raised}") } else { format!("10{raised}") }
}

/// Returns `digits * 10^power`, rounded once for the common powers.
pub(super) fn value(digits: i64, power: i32) -> f64 {
    if (-22..0).contains(&power) { digits as f64 / 10f64.powi(-power) } else { digits as f64 * 10f64.powi(power) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_as_written() {
        assert_eq!(plain(3, -1, 1), "0.3");
        assert_eq!(plain(-25, -3, 3), "−0.025");
        assert_eq!(plain(1000, -2, 0), "10");
        assert_eq!(plain(0, -3, 1), "0.0");
        assert_eq!(plain(7, 2, 0), "700");
        assert_eq!(plain(0, 3, 0), "0");
        assert_eq!(places(1500, -3), 1);
        assert_eq!(power_of_ten(-12), "10⁻¹²");
        assert_eq!(value(3, -1), 0.3);
    }
}
