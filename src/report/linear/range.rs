//! Ranges of axes that a few far values do not spoil.

use crate::linearize::{Branch, Kind};

/// Part of the values at each end that the core of a range leaves out.
const TAIL: f64 = 0.1;
/// So many lengths of the core beyond it still belong to the range.
const REACH: f64 = 2.0;

/// The range of all values, or of most where the others lie far off. None without values.
pub fn robust(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    let mut sorted: Vec<f64> = values.filter(|value| value.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let last = sorted.len().checked_sub(1)?;
    let at = |part: f64| sorted[(part * last as f64).round() as usize];
    let (low, high) = (at(TAIL), at(1.0 - TAIL));
    let reach = if high > low { REACH * (high - low) } else { f64::INFINITY };
    Some((at(0.0).max(low - reach), at(1.0).min(high + reach)))
}

/// A range with free parts at both ends, at least so long.
pub fn padded((low, high): (f64, f64), part: f64, least: f64) -> (f64, f64) {
    let missing = (0.5 * (least - (high - low))).max(0.0);
    let pad = part * (high - low).max(least) + missing;
    (low - pad, high + pad)
}

/// More physical branches than this, of pairs one, hide one another.
const MOST_DRAWN: usize = 12;

/// The branches that a figure shows, the slowest of the physical ones and all others, and what is said of those left out.
pub fn drawn(branches: &[Branch]) -> (Vec<Branch>, String) {
    let slowest = |branch: &Branch| {
        let sizes = branch.points.iter().map(|(_, value)| value.norm()).filter(|size| size.is_finite());
        sizes.fold(f64::INFINITY, f64::min)
    };
    let is_counted =
        |branch: &&Branch| branch.kind == Kind::Physical && branch.points.iter().any(|(_, value)| value.im >= 0.0);
    let mut sizes: Vec<f64> = branches.iter().filter(is_counted).map(slowest).collect();
    if sizes.len() <= MOST_DRAWN {
        return (branches.to_vec(), String::new());
    }
    sizes.sort_by(f64::total_cmp);
    // Both of a pair are as slow but for rounding.
    let bound = sizes[MOST_DRAWN - 1] * (1.0 + 1e-9);
    let is_drawn = |branch: &&Branch| branch.kind != Kind::Physical || slowest(branch) <= bound;
    let note = format!("the {MOST_DRAWN} slowest of {} modes; all are in the files", sizes.len());
    (branches.iter().filter(is_drawn).cloned().collect(), note)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_far_values_are_left_outside() {
        let near = (0..100).map(|k| f64::from(k) * 0.01);
        assert_eq!(robust(near.clone()), Some((0.0, 0.99)));
        let (low, high) = robust(near.chain([1e6, -1e9, f64::NAN])).unwrap();
        assert!(low > -3.0 && high < 4.0, "{low} {high}");
        assert_eq!(robust([2.0; 9].into_iter()), Some((2.0, 2.0)));
        assert_eq!(robust([0.0, 1e6].into_iter()), Some((0.0, 1e6)));
        assert_eq!(robust(std::iter::empty()), None);
    }

    #[test]
    fn ranges_have_a_length() {
        assert_eq!(padded((1.0, 1.0), 0.0, 2.0), (0.0, 2.0));
        assert_eq!(padded((0.0, 10.0), 0.1, 2.0), (-1.0, 11.0));
    }
}
