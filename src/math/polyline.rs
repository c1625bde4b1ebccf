//! Lines through points of the plane: cut off at a rectangle, and with fewer points without visible change.

type Pt = (f64, f64);

/// Returns the parts of a line inside a rectangle, given by two opposite corners with the smallest coordinates first.
pub(crate) fn clipped(points: &[Pt], inside: [Pt; 2]) -> Vec<Vec<Pt>> {
    let mut parts: Vec<Vec<Pt>> = Vec::new();
    for pair in points.windows(2) {
        let Some((from, to)) = segment(pair[0], pair[1], inside[0], inside[1]) else { continue };
        match parts.last_mut() {
            Some(part) if part.last() == Some(&from) => part.push(to),
            _ => parts.push(vec![from, to]),
        }
    }
    parts
}

/// Returns the part of a segment inside a rectangle (Liang and Barsky).
fn segment(from: Pt, to: Pt, low: Pt, high: Pt) -> Option<(Pt, Pt)> {
    let dx = to.0 - from.0;
    let dy = to.1 - from.1;
    let across = [(-dx, from.0 - low.0), (dx, high.0 - from.0)];
    let down = [(-dy, from.1 - low.1), (dy, high.1 - from.1)];
    let mut enter = 0.0f64;
    let mut leave = 1.0f64;
    for (slope, room) in across.into_iter().chain(down) {
        if slope < 0.0 {
            enter = enter.max(room / slope);
        } else {
            // Without a slope infinite: before the start if there is no room.
            leave = leave.min(room / slope.abs());
        }
    }
    let at = |t: f64| (from.0 + t * dx, from.1 + t * dy);
    // The ends themselves, not from + 1 * d, so that parts join exactly.
    let start = if enter == 0.0 { from } else { at(enter) };
    let end = if leave == 1.0 { to } else { at(leave) };
    (enter <= leave).then_some((start, end))
}

/// Returns a line in pixels without visible difference, with at most `most` points if possible.
///
/// Of consecutive points within one pixel column the first, lowest, highest and last are kept, so no extreme is lost;
/// then points on straight stretches are dropped.
pub(crate) fn thinned(points: &[Pt], most: usize) -> Vec<Pt> {
    let mut kept = points.to_vec();
    let mut width = 0.5;
    // Each round doubles the column; eight of them reach 64 pixels, beyond which no detail is visible.
    for _ in 0..8 {
        kept = straighten(&columns(&kept, width), 0.15 * width);
        if kept.len() <= most {
            break;
        }
        width *= 2.0;
    }
    kept
}

/// Returns first, lowest, highest and last of each group of consecutive points in the same column.
fn columns(points: &[Pt], width: f64) -> Vec<Pt> {
    let column = |point: &Pt| (point.0 / width).floor();
    let mut kept = Vec::new();
    for group in points.chunk_by(|a, b| column(a) == column(b)) {
        let by_height = |a: &usize, b: &usize| group[*a].1.total_cmp(&group[*b].1);
        let extremes = [(0..group.len()).max_by(by_height), (0..group.len()).min_by(by_height)];
        let mut places = vec![0, extremes[0].unwrap_or(0), extremes[1].unwrap_or(0), group.len() - 1];
        places.sort_unstable();
        places.dedup();
        kept.extend(places.into_iter().map(|k| group[k]));
    }
    kept
}

/// Drops points that lie within `tolerance` of the line between two kept ones (Ramer; Douglas and Peucker).
fn straighten(points: &[Pt], tolerance: f64) -> Vec<Pt> {
    let mut is_kept = vec![false; points.len()];
    let mut open: Vec<(usize, usize)> = points.len().checked_sub(1).map(|last| (0, last)).into_iter().collect();
    while let Some((first, last)) = open.pop() {
        (is_kept[first], is_kept[last]) = (true, true);
        let far = |i: usize| (distance(points[i], points[first], points[last]), i);
        match (first + 1..last).map(far).max_by(|a, b| a.0.total_cmp(&b.0)) {
            Some((distance, i)) if distance > tolerance * tolerance => open.extend([(first, i), (i, last)]),
            _ => {}
        }
    }
    points.iter().zip(is_kept).filter(|(_, is_kept)| *is_kept).map(|(point, _)| *point).collect()
}

/// Returns the square of the distance of a point from the segment between two others.
fn distance(point: Pt, from: Pt, to: Pt) -> f64 {
    let along = (to.0 - from.0, to.1 - from.1);
    let away = (point.0 - from.0, point.1 - from.1);
    let length = along.0 * along.0 + along.1 * along.1;
    let part = if length > 0.0 { ((along.0 * away.0 + along.1 * away.1) / length).clamp(0.0, 1.0) } else { 0.0 };
    (away.0 - part * along.0).powi(2) + (away.1 - part * along.1).powi(2)
}

/// Returns points without those hidden by another one, at most `most`: indices of the kept ones, in order. One is kept
/// of those in the same small cell.
pub(crate) fn apart(points: &[Pt], most: usize) -> Vec<usize> {
    let mut kept: Vec<usize> = (0..points.len()).collect();
    let mut cell = 0.7;
    for _ in 0..12 {
        let key = |i: &usize| ((points[*i].0 / cell).floor() as i64, (points[*i].1 / cell).floor() as i64);
        // By order of data the kept points would all be on one side of their cells and form stripes.
        kept.sort_by_key(|i| (key(i), scattered(*i)));
        kept.dedup_by_key(|i| key(i));
        if kept.len() <= most {
            break;
        }
        cell *= 1.5;
    }
    kept.sort_unstable();
    kept
}

/// Returns a pseudo-random number that depends on `i` only.
fn scattered(i: usize) -> u64 {
    let mixed = (i as u64).wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    (mixed ^ (mixed >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_cut_at_the_border() {
        let square = [(0.0, 0.0), (10.0, 10.0)];
        let parts = clipped(&[(-5.0, 5.0), (5.0, 5.0), (5.0, 15.0), (8.0, 15.0), (8.0, 8.0)], square);
        assert_eq!(parts, [vec![(0.0, 5.0), (5.0, 5.0), (5.0, 10.0)], vec![(8.0, 10.0), (8.0, 8.0)]]);
    }

    #[test]
    fn lines_outside_vanish() {
        let square = [(0.0, 0.0), (10.0, 10.0)];
        assert!(clipped(&[(-5.0, 5.0), (-5.0, 15.0)], square).is_empty());
        assert!(clipped(&[(-1.0, 5.0), (5.0, 11.0), (5.0, 1e300)], square).len() == 1);
    }

    #[test]
    fn extremes_survive() {
        let mut noise: Vec<Pt> = (0..50_000).map(|i| (f64::from(i) * 0.01, (f64::from(i) * 7.3).sin())).collect();
        noise[777].1 = 90.0;
        noise[31_234].1 = -80.0;
        let thin = thinned(&noise, 4000);
        assert!(thin.len() <= 4000, "{}", thin.len());
        assert!(thin.contains(&noise[777]) && thin.contains(&noise[31_234]));
        assert_eq!((thin.first(), thin.last()), (noise.first(), noise.last()));
    }

    #[test]
    fn smooth_curves_stay_in_place() {
        let curve: Vec<Pt> = (0..2000).map(|i| (f64::from(i) * 0.25, 100.0 * (f64::from(i) * 0.01).sin())).collect();
        let thin = thinned(&curve, 4000);
        assert!(thin.len() < 200, "{}", thin.len());
        for (x, y) in curve {
            let right = thin.partition_point(|point| point.0 < x).clamp(1, thin.len() - 1);
            let a = thin[right - 1];
            let b = thin[right];
            let on_line = a.1 + (b.1 - a.1) * (x - a.0) / (b.0 - a.0);
            assert!((on_line - y).abs() < 0.4, "{x} {y} {on_line}");
        }
    }

    #[test]
    fn a_line_that_turns_back_keeps_its_end() {
        let thin = thinned(&[(0.0, 0.0), (10.0, 0.0), (30.0, 0.0), (20.0, 0.0)], 10);
        assert!(thin.contains(&(30.0, 0.0)) && thin.contains(&(20.0, 0.0)));
    }

    #[test]
    fn hidden_dots_go() {
        let points: Vec<Pt> = (0..10_000).map(|i| (f64::from(i % 100), f64::from(i / 100 % 10))).collect();
        assert_eq!(apart(&points, 5000).len(), 1000);
        assert!(apart(&points, 300).len() <= 300);
    }
}
