//! Convex outlines.

type PlanePoint = (f64, f64);

/// Returns the corners of the convex hull, counter-clockwise; two where all points lie on a line, one where they
/// coincide.
pub fn hull(points: &[PlanePoint]) -> Vec<PlanePoint> {
    let mut sorted: Vec<PlanePoint> = points.to_vec();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let size = sorted.iter().flat_map(|p| [p.0.abs(), p.1.abs()]).fold(0.0, f64::max);
    let tiny = 1e-9 * size;
    sorted.dedup_by(|a, b| (a.0 - b.0).abs() <= tiny && (a.1 - b.1).abs() <= tiny);
    if sorted.len() < 3 {
        return sorted;
    }
    let lower = chain(sorted.iter().copied(), tiny * size);
    let upper = chain(sorted.iter().rev().copied(), tiny * size);
    let ends = |half: &[PlanePoint]| half[..half.len() - 1].to_vec();
    [ends(&lower), ends(&upper)].concat()
}

/// Returns the points at which a line around the others turns left.
fn chain(points: impl Iterator<Item = PlanePoint>, tiny: f64) -> Vec<PlanePoint> {
    let mut kept: Vec<PlanePoint> = Vec::new();
    for point in points {
        while kept.len() > 1 && turn(kept[kept.len() - 2], kept[kept.len() - 1], point) <= tiny {
            kept.pop();
        }
        kept.push(point);
    }
    kept
}

/// Returns twice the area of a triangle, positive where it turns left.
fn turn(a: PlanePoint, b: PlanePoint, c: PlanePoint) -> f64 {
    (b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0)
}

/// Returns an outline around the corners of a hull at distance one: each corner with directions to step from it.
pub fn rounded(corners: &[PlanePoint]) -> Vec<(PlanePoint, PlanePoint)> {
    let count = corners.len();
    let heading = |k: usize| {
        let a = corners[k % count];
        let b = corners[(k + 1) % count];
        (b.1 - a.1).atan2(b.0 - a.0)
    };
    let mut outline = Vec::new();
    for (k, corner) in corners.iter().enumerate() {
        // The outside is right of the direction of travel.
        let (from, turn) = match count {
            1 => (0.0, std::f64::consts::TAU),
            _ => {
                let before = heading(k + count - 1);
                let after = heading(k);
                (before - std::f64::consts::FRAC_PI_2, (after - before).rem_euclid(std::f64::consts::TAU))
            }
        };
        let steps = (turn / 0.45).ceil().max(1.0) as usize;
        let directions = (0..=steps).map(|i| from + turn * i as f64 / steps as f64);
        outline.extend(directions.map(|angle| (*corner, (angle.cos(), angle.sin()))));
    }
    outline
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inner_points_are_left_out() {
        let points = [(0.0, 0.0), (2.0, 0.0), (1.0, 1.0), (2.0, 2.0), (0.0, 2.0), (1.0, 0.0)];
        assert_eq!(hull(&points), [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]);
    }

    #[test]
    fn points_on_a_line_have_two_ends() {
        let line: Vec<PlanePoint> = (0..7).map(|k| (0.1 * f64::from(k), 0.3 - 0.2 * f64::from(k))).collect();
        assert_eq!(hull(&line), [line[0], line[6]]);
        assert_eq!(hull(&[(1.0, 1.0); 4]), [(1.0, 1.0)]);
        assert!(hull(&[]).is_empty());
    }

    #[test]
    fn outlines_turn_once_around_all_corners() {
        for corners in [vec![(0.0, 0.0)], vec![(0.0, 0.0), (3.0, 0.0)], vec![(0.0, 0.0), (3.0, 0.0), (0.0, 4.0)]] {
            let outline: Vec<PlanePoint> =
                rounded(&corners).iter().map(|(at, step)| (at.0 + step.0, at.1 + step.1)).collect();
            let pairs = outline.iter().zip(outline.iter().skip(1).chain(&outline[..1]));
            let area: f64 = pairs.map(|(a, b)| 0.5 * (a.0 * b.1 - a.1 * b.0)).sum();
            let (edges, inner) = match corners.len() {
                1 => (0.0, 0.0),
                2 => (6.0, 0.0),
                _ => (12.0, 6.0),
            };
            let exact = inner + edges + std::f64::consts::PI;
            assert!((area - exact).abs() < 0.12, "{area} {exact}");
        }
    }
}
