//! Ranges of axes: of most values where few are far off, and long enough that round-off does not fill them.

use crate::math::bounds;
use crate::plot::{Item, ItemForm, Panel, Spot, Tint};
use crate::tolerances;

/// Colour of growth, as an index in the palette.
pub(super) const VERMILION: usize = 1;
/// Opacity of the area in which modes grow.
const PALE: f64 = 0.1;
/// Margin of an axis at both ends, as a part of its length.
pub(super) const FREE: f64 = 0.06;
/// Length of an axis whose values differ by round-off only, as a part of the largest eigenvalue.
const LEAST: f64 = 0.04;
/// Part of the values at each end that is outside the core of a range.
const TAIL: f64 = 0.1;
/// Values within this many lengths of the core beyond it still belong to the range.
const REACH: f64 = 2.0;

/// Returns the range of all values, or of most where the others are far off. A core that is round-off beside `size`
/// leaves none out. None without values.
pub(super) fn robust(values: impl Iterator<Item = f64>, size: f64) -> Option<(f64, f64)> {
    let mut sorted: Vec<f64> = values.filter(|value| value.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let last = sorted.len().checked_sub(1)?;
    let at = |part: f64| sorted[(part * last as f64).round() as usize];
    let low = at(TAIL);
    let high = at(1.0 - TAIL);
    let is_one = high - low <= tolerances::EIGENVALUES_AGREE * size.max(low.abs()).max(high.abs());
    let reach = if is_one { f64::INFINITY } else { REACH * (high - low) };
    Some((at(0.0).max(low - reach), at(1.0).min(high + reach)))
}

/// Returns the axis for most of the parts of eigenvalues up to `size`, with zero where that is near.
pub(super) fn fitted(values: impl Iterator<Item = f64>, size: f64) -> Option<(f64, f64)> {
    let noise = tolerances::EIGENVALUES_AGREE * size;
    let range = with_zero(robust(values, size)?, noise);
    let least = match range.1 - range.0 {
        span if span > noise => 0.0,
        _ if size > 0.0 => LEAST * size,
        _ => 1.0,
    };
    Some(padded(range, FREE, least))
}

/// Extends a range to zero, unless that more than doubles it. Values that differ by noise are one value.
fn with_zero((low, high): (f64, f64), noise: f64) -> (f64, f64) {
    let near = if high - low > noise { high - low } else { f64::INFINITY };
    match () {
        _ if low > 0.0 && low <= near => (0.0, high),
        _ if high < 0.0 && -high <= near => (low, 0.0),
        _ => (low, high),
    }
}

/// Returns a range with margins at both ends, of at least the length `least`.
pub(super) fn padded((low, high): (f64, f64), part: f64, least: f64) -> (f64, f64) {
    let missing = (0.5 * (least - (high - low))).max(0.0);
    let pad = part * (high - low).max(least) + missing;
    (low - pad, high + pad)
}

/// Returns the range of the finite values; none without one.
pub(super) fn whole(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    let range = bounds(values.filter(|value| value.is_finite()));
    (range.0 <= range.1).then_some(range)
}

/// Shades the part of a panel in which modes grow.
pub(super) fn shaded(panel: Panel, x: (f64, f64), y: (f64, f64)) -> Panel {
    if x.0 >= x.1 || y.0 >= y.1 {
        return panel;
    }
    let corners = [(x.0, y.0), (x.1, y.0), (x.1, y.1), (x.0, y.1)];
    let spots = corners.map(|(x, y)| Spot::data(x, y)).to_vec();
    panel.items([Item { spots, tint: Tint::Body(VERMILION, 0.0), form: ItemForm::Area(PALE) }])
}

/// Returns both notes on a panel as one.
pub(super) fn notes(both: [String; 2]) -> String {
    both.iter().filter(|note| !note.is_empty()).map(String::as_str).collect::<Vec<_>>().join("; ")
}

/// Returns a note on the number of points outside an axis.
pub(super) fn outside(count: usize) -> String {
    match count {
        0 => String::new(),
        1 => "1 point lies outside".to_string(),
        _ => format!("{count} points lie outside"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_far_values_are_left_outside() {
        let near = (0..100).map(|k| f64::from(k) * 0.01);
        assert_eq!(robust(near.clone(), 0.0), Some((0.0, 0.99)));
        let (low, high) = robust(near.chain([1e6, -1e9, f64::NAN]), 0.0).unwrap();
        assert!(low > -3.0 && high < 4.0, "{low} {high}");
        assert_eq!(robust([2.0; 9].into_iter(), 0.0), Some((2.0, 2.0)));
        assert_eq!(robust([0.0, 1e6].into_iter(), 0.0), Some((0.0, 1e6)));
        assert_eq!(robust(std::iter::empty(), 0.0), None);
    }

    #[test]
    fn round_off_leaves_no_value_outside() {
        let axis = (0..40).map(|k| 1e-14 * f64::from(k % 3));
        assert_eq!(robust(axis.chain([3.0, -3.0]), 10.0), Some((-3.0, 3.0)));
    }

    #[test]
    fn an_axis_fits_its_values() {
        let near = |range: Option<(f64, f64)>, low: f64, high: f64| {
            let (from, to) = range.unwrap();
            assert!((from - low).abs() < 1e-9 && (to - high).abs() < 1e-9, "{from} {to}");
        };
        // Small real parts of fast modes have the axis for themselves, with zero.
        near(fitted([-5.0, -1.0].into_iter(), 1e3), -5.3, 0.3);
        near(fitted([-500.0, -490.0].into_iter(), 1e3), -500.6, -489.4);
        // Round-off alone does not.
        near(fitted([1e-12, -1e-12].into_iter(), 100.0), -2.24, 2.24);
        near(fitted([0.0].into_iter(), 0.0), -0.56, 0.56);
    }

    #[test]
    fn ranges_have_a_length() {
        assert_eq!(padded((1.0, 1.0), 0.0, 2.0), (0.0, 2.0));
        assert_eq!(padded((0.0, 10.0), 0.1, 2.0), (-1.0, 11.0));
    }
}
