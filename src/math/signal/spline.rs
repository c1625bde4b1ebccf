//! Slopes of cubic splines at their points: C2, either not-a-knot or periodic.
//!
//! In terms of the slopes s_i, with the widths h_i and the secants m_i of the intervals, the second derivative is
//! continuous where h_i s_{i-1} + 2 (h_{i-1} + h_i) s_i + h_{i-1} s_{i+1} = 3 (h_i m_{i-1} + h_{i-1} m_i). Source: de
//! Boor, A Practical Guide to Splines, IV.

/// A row of a tridiagonal system: left, diagonal and right entry, right side.
type SplineRow = [f64; 4];

fn widths_and_secants(points: &[[f64; 2]]) -> (Vec<f64>, Vec<f64>) {
    let pairs = || points.windows(2).map(|pair| (pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]));
    (pairs().map(|(h, _)| h).collect(), pairs().map(|(h, rise)| rise / h).collect())
}

/// The condition at a point between the intervals `a` and `b`.
fn inner(h: &[f64], m: &[f64], a: usize, b: usize) -> SplineRow {
    [h[b], 2.0 * (h[a] + h[b]), h[a], 3.0 * (h[b] * m[a] + h[a] * m[b])]
}

/// The first condition of not-a-knot from the two intervals at an end, and the last one mirrored: the third derivative
/// is continuous at the point between them.
fn end(h0: f64, h1: f64, m0: f64, m1: f64) -> SplineRow {
    let sum = h0 + h1;
    [0.0, h1, sum, ((h0 + 2.0 * sum) * h1 * m0 + h0 * h0 * m1) / sum]
}

/// Slopes of the spline whose third derivative is continuous at the second and the last but one point: it reproduces
/// cubics; through two points the line, through three the parabola.
pub fn not_a_knot(points: &[[f64; 2]]) -> Vec<f64> {
    let (h, m) = widths_and_secants(points);
    let last = h.len() - 1;
    match last {
        0 => vec![m[0]; 2],
        1 => {
            let bend = (m[1] - m[0]) / (h[0] + h[1]);
            vec![m[0] - bend * h[0], m[0] + bend * h[0], m[1] + bend * h[1]]
        }
        _ => {
            let [_, diagonal, beside, right] = end(h[last], h[last - 1], m[last], m[last - 1]);
            let rows = (1..=last).map(|i| inner(&h, &m, i - 1, i));
            let rows = [end(h[0], h[1], m[0], m[1])].into_iter().chain(rows);
            solve(&rows.chain([[beside, diagonal, 0.0, right]]).collect::<Vec<_>>())
        }
    }
}

/// Slopes of the spline that goes on at its first point as it ends at its last one, which has the same y.
pub fn periodic(points: &[[f64; 2]]) -> Vec<f64> {
    let (h, m) = widths_and_secants(points);
    let n = h.len();
    if n < 3 {
        // By symmetry both points of a period have the same slope.
        let weights: f64 = h.iter().map(|h| 1.0 / h).sum();
        let slope = h.iter().zip(&m).map(|(h, m)| m / h).sum::<f64>() / weights;
        return vec![slope; n + 1];
    }
    // The slope at the last point of the period, which the first and the last of the other rows use, is found last.
    let mut rows: Vec<SplineRow> = (0..n - 1).map(|i| inner(&h, &m, (i + n - 1) % n, i)).collect();
    let first = std::mem::take(&mut rows[0][0]);
    let last = std::mem::take(&mut rows[n - 2][2]);
    let own = solve(&rows);
    let mut coupling = rows;
    coupling.iter_mut().for_each(|row| row[3] = 0.0);
    coupling[0][3] -= first;
    coupling[n - 2][3] -= last;
    let by_last = solve(&coupling);
    let [left, diagonal, right, value] = inner(&h, &m, n - 2, n - 1);
    let rest = value - left * own[n - 2] - right * own[0];
    let slope = rest / (diagonal + left * by_last[n - 2] + right * by_last[0]);
    let mut slopes: Vec<f64> = own.iter().zip(&by_last).map(|(own, by)| own + by * slope).collect();
    slopes.push(slope);
    slopes.push(slopes[0]);
    slopes
}

/// Thomas' algorithm. The rows of a spline need no pivots: the second row of not-a-knot is diagonally dominant after
/// the first is eliminated, all others are at once.
fn solve(rows: &[SplineRow]) -> Vec<f64> {
    let mut upper: Vec<[f64; 2]> = Vec::with_capacity(rows.len());
    for &[left, diagonal, right, value] in rows {
        let [above, sum] = upper.last().copied().unwrap_or_default();
        let pivot = diagonal - left * above;
        upper.push([right / pivot, (value - left * sum) / pivot]);
    }
    let mut next = 0.0;
    let mut solution: Vec<f64> = upper
        .iter()
        .rev()
        .map(|[right, value]| {
            next = value - right * next;
            next
        })
        .collect();
    solution.reverse();
    solution
}
