//! Texts as figures have them.

/// Returns a text with its exponents raised: `m/s^2` becomes `m/s²`, `10^-17` becomes `10⁻¹⁷`.
pub(in crate::report) fn typeset(text: &str) -> String {
    let mut parts = text.split('^');
    let mut all = parts.next().unwrap_or_default().to_string();
    for part in parts {
        let count = exponent_length(part);
        if count == 0 {
            all.push('^');
        }
        all.extend(part[..count].chars().map(raised));
        all += &part[count..];
    }
    all
}

/// Returns the number of bytes of the whole number that a text begins with.
fn exponent_length(text: &str) -> usize {
    let unsigned = text.strip_prefix('-').unwrap_or(text);
    let digits = unsigned.bytes().take_while(u8::is_ascii_digit).count();
    if digits == 0 { 0 } else { text.len() - unsigned.len() + digits }
}

fn raised(c: char) -> char {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    c.to_digit(10).map_or('⁻', |digit| DIGITS[digit as usize])
}

#[cfg(test)]
mod tests {
    use super::typeset;

    #[test]
    fn exponents_are_raised() {
        for (text, shown) in [
            ("m/s^2", "m/s²"),
            ("rad/s^2/(N m)", "rad/s²/(N m)"),
            ("kg m^2", "kg m²"),
            ("10^-17", "10⁻¹⁷"),
            ("s^-1 m^3", "s⁻¹ m³"),
            ("x^y, a^-b, c^", "x^y, a^-b, c^"),
            ("µm", "µm"),
        ] {
            assert_eq!(typeset(text), shown);
        }
    }
}
