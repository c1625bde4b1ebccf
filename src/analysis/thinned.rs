//! Rows of a long run, thinned without losing extremes.

use super::Ledger;

/// Numbers that are kept at most, if each window may keep the extremes of all columns.
const NUMBERS: usize = 1_000_000;

/// Thins the rows of a run, with their drift and energies where there are any, that have become too many: of the rows
/// of each of many equal parts of its time those stay that are first or last, or the smallest or the largest in some
/// column, so that no extreme of the run is lost, and a curve keeps its shape, however often it is thinned.
pub fn thin(rows: &mut Vec<Vec<f64>>, drift_rows: &mut Vec<[f64; DRIFT]>, ledger_rows: &mut Vec<Ledger>) {
    let columns = rows.first().map_or(1, Vec::len) + DRIFT + ENERGY;
    let of_window = 2 * columns + 2;
    let most = (NUMBERS / columns).max(4 * of_window);
    if rows.len() < most {
        return;
    }
    let value = |row: usize, column: usize| match column {
        drift if drift < DRIFT => drift_rows.get(row).map_or(0.0, |levels| levels[drift]),
        energy if energy < DRIFT + ENERGY => {
            ledger_rows.get(row).map_or(0.0, |ledger| energies(ledger)[energy - DRIFT])
        }
        other => rows[row][other - DRIFT - ENERGY],
    };
    let start = rows[0][0];
    let end = rows[rows.len() - 1][0];
    let windows = (most / 2 / of_window) as f64;
    let window_of = |row: usize| ((rows[row][0] - start) / (end - start) * windows) as usize;
    let mut is_kept = vec![false; rows.len()];
    let mut next = 0;
    while next < rows.len() {
        let own = window_of(next);
        let window = next..(next..rows.len()).find(|row| window_of(*row) != own).unwrap_or(rows.len());
        next = window.end;
        (is_kept[window.start], is_kept[window.end - 1]) = (true, true);
        for column in 0..columns {
            let order = |a: &usize, b: &usize| value(*a, column).total_cmp(&value(*b, column));
            let extremes = [window.clone().min_by(order), window.clone().max_by(order)];
            extremes.into_iter().flatten().for_each(|row| is_kept[row] = true);
        }
    }
    retain(rows, &is_kept);
    retain(drift_rows, &is_kept);
    retain(ledger_rows, &is_kept);
}

const DRIFT: usize = 3;
const ENERGY: usize = 4;

fn energies(ledger: &Ledger) -> [f64; ENERGY] {
    [ledger.kinetic, ledger.potential, ledger.work, ledger.error]
}

fn retain<T>(rows: &mut Vec<T>, is_kept: &[bool]) {
    let mut kept = is_kept.iter();
    rows.retain(|_| kept.next().is_some_and(|kept| *kept));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_extreme_is_lost_and_memory_is_bounded() {
        let mut rows = Vec::new();
        let mut drift = Vec::new();
        let mut energy = Vec::new();
        let count = 700_000;
        let spikes = [(123_456, 9.0), (400_001, -8.0)];
        for i in 0..count {
            let t = f64::from(i);
            let spike = spikes.iter().find(|(place, _)| *place == i).map_or(0.0, |(_, size)| *size);
            rows.push(vec![t, (7.3 * t).sin() + spike]);
            drift.push([0.0, 0.0, if i == 300_000 { 1.0 } else { 0.0 }]);
            energy.push(Ledger { kinetic: t, potential: 0.0, work: if i == 500_000 { -3.0 } else { 0.0 }, error: 0.0 });
            thin(&mut rows, &mut drift, &mut energy);
        }
        let times: Vec<f64> = rows.iter().map(|row| row[0]).collect();
        assert!(times.len() < NUMBERS / 9 && drift.len() == times.len() && energy.len() == times.len());
        // Parts of equal time, twice as long as at the last thinning at most.
        let gaps = times.windows(2).map(|pair| pair[1] - pair[0]);
        assert!(gaps.fold(0.0, f64::max) < 2.0 * f64::from(count) / 2500.0);
        for kept in [0, 123_456, 300_000, 400_001, 500_000, count - 1] {
            let place = times.iter().position(|t| *t == f64::from(kept)).unwrap();
            assert_eq!(energy[place].kinetic, times[place]);
        }
    }
}
