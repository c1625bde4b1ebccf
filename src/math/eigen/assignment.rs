//! The assignment problem.

use super::Matrix;

/// The column of each row, all different, with the least sum of costs: shortest augmenting paths (Jonker and Volgenant,
/// Computing 38, 1987), rows^2 cols operations. Deterministic among solutions of equal cost.
///
/// With more rows than columns some rows get a number from `cost.ncols()` on, which is no column. Costs that are not
/// finite are avoided if possible.
pub fn assign(cost: &Matrix) -> Vec<usize> {
    let rows = cost.nrows();
    let cols = cost.ncols().max(cost.nrows());
    let finite = cost.iter().filter(|x| x.is_finite()).fold(0.0, |largest: f64, x| largest.max(x.abs()));
    let avoided = finite * 4.0 * (rows as f64 + 1.0) + 1.0;
    let price = |i: usize, j: usize| match cost.get((i, j)) {
        Some(x) if x.is_finite() => *x,
        Some(_) => avoided.min(f64::MAX),
        None => 0.0,
    };
    let mut paths = Paths { row_of: vec![None; cols], row: vec![0.0; rows], col: vec![0.0; cols] };
    for i in 0..rows {
        paths.augment(i, &price);
    }
    let mut assigned = vec![cols; rows];
    for (j, row) in paths.row_of.iter().enumerate() {
        if let Some(i) = row {
            assigned[*i] = j;
        }
    }
    assigned
}

/// An optimal assignment of the rows so far, with the dual variables that prove it.
struct Paths {
    row_of: Vec<Option<usize>>,
    row: Vec<f64>,
    col: Vec<f64>,
}

impl Paths {
    /// Assigns one more row along the cheapest alternating path (Dijkstra with reduced costs).
    fn augment(&mut self, start: usize, price: &impl Fn(usize, usize) -> f64) {
        let cols = self.col.len();
        let mut distance = vec![f64::INFINITY; cols];
        let mut before = vec![None; cols];
        let mut done = vec![false; cols];
        let mut i = start;
        let mut from = None;
        let mut reached = 0.0;
        let end = loop {
            for j in (0..cols).filter(|&j| !done[j]) {
                let through = reached + price(i, j) - self.row[i] - self.col[j];
                if through < distance[j] {
                    (distance[j], before[j]) = (through, from);
                }
            }
            let Some(next) = (0..cols).filter(|&j| !done[j]).min_by(|&a, &b| distance[a].total_cmp(&distance[b]))
            else {
                return;
            };
            reached = distance[next];
            let Some(row) = self.row_of[next] else { break next };
            done[next] = true;
            (i, from) = (row, Some(next));
        };
        self.update(start, &done, &distance, reached);
        self.shift(start, &before, end);
    }

    fn update(&mut self, start: usize, done: &[bool], distance: &[f64], reached: f64) {
        self.row[start] += reached;
        for j in (0..done.len()).filter(|&j| done[j]) {
            self.col[j] -= reached - distance[j];
            if let Some(i) = self.row_of[j] {
                self.row[i] += reached - distance[j];
            }
        }
    }

    /// Each row of the path moves on to the next column.
    fn shift(&mut self, start: usize, before: &[Option<usize>], end: usize) {
        let mut j = end;
        while let Some(previous) = before[j] {
            self.row_of[j] = self.row_of[previous];
            j = previous;
        }
        self.row_of[j] = Some(start);
    }
}
