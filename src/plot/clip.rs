//! Clipping of lines to a rectangle.

use super::shape::{Pt, Rect};

/// Returns the parts of a polyline inside a rectangle, each a polyline.
pub(super) fn polyline(points: &[Pt], inside: &Rect) -> Vec<Vec<Pt>> {
    let mut parts: Vec<Vec<Pt>> = Vec::new();
    for pair in points.windows(2) {
        let Some((from, to)) = segment(pair[0], pair[1], inside) else {
            continue;
        };
        match parts.last_mut() {
            Some(part) if part.last() == Some(&from) => part.push(to),
            _ => parts.push(vec![from, to]),
        }
    }
    parts
}

/// Returns the part of a segment inside a rectangle (Liang and Barsky).
fn segment(from: Pt, to: Pt, inside: &Rect) -> Option<(Pt, Pt)> {
    let dx = to.0 - from.0;
    let dy = to.1 - from.1;
    let sides = [
        (-dx, from.0 - inside.left),
        (dx, inside.right - from.0),
        (-dy, from.1 - inside.top),
        (dy, inside.bottom - from.1),
    ];
    let mut enter = 0.0f64;
    let mut leave = 1.0f64;
    for (slope, room) in sides {
        if slope == 0.0 && room < 0.0 {
            return None;
        } else if slope < 0.0 {
            enter = enter.max(room / slope);
        } else if slope > 0.0 {
            leave = leave.min(room / slope);
        }
    }
    let at = |t: f64| (from.0 + t * dx, from.1 + t * dy);
    // The ends themselves, not from + 1 * d, so that parts join exactly.
    let start = if enter == 0.0 { from } else { at(enter) };
    let end = if leave == 1.0 { to } else { at(leave) };
    (enter <= leave).then_some((start, end))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_cut_at_the_border() {
        let square = Rect::new((0.0, 0.0), (10.0, 10.0));
        let parts = polyline(&[(-5.0, 5.0), (5.0, 5.0), (5.0, 15.0), (8.0, 15.0), (8.0, 8.0)], &square);
        assert_eq!(parts, [vec![(0.0, 5.0), (5.0, 5.0), (5.0, 10.0)], vec![(8.0, 10.0), (8.0, 8.0)]]);
    }

    #[test]
    fn lines_outside_vanish() {
        let square = Rect::new((0.0, 0.0), (10.0, 10.0));
        assert!(polyline(&[(-5.0, 5.0), (-5.0, 15.0)], &square).is_empty());
        assert!(polyline(&[(-1.0, 5.0), (5.0, 11.0), (5.0, 1e300)], &square).len() == 1);
    }
}
