//! Units as they are written in figures.

/// Returns a unit with its powers raised and its factors joined: `m/s²` for `m/s^2`, `N·m` for `N m`.
pub(super) fn written(unit: &str) -> String {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let unit = unit.trim().replace(' ', "·");
    let mut parts = unit.split('^');
    let mut text = parts.next().unwrap_or_default().to_string();
    for part in parts {
        let digits = part.len() - part.trim_start_matches(|c: char| c.is_ascii_digit()).len();
        if digits == 0 {
            text.push('^');
        }
        text.extend(part[..digits].bytes().map(|digit| RAISED[usize::from(digit - b'0')]));
        text += &part[digits..];
    }
    text
}

#[cfg(test)]
mod tests {
    use super::written;

    #[test]
    fn powers_are_raised_and_factors_joined() {
        let found = ["m/s^2", "rad/s^2/(N m)", "kg m^2/s^12", "%", "a^b", "x^"].map(written);
        assert_eq!(found, ["m/s²", "rad/s²/(N·m)", "kg·m²/s¹²", "%", "a^b", "x^"]);
    }
}
