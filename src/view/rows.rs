//! Choice of the rows of a run that are shown.

/// Returns at most `most` rows of the first `count`, evenly chosen, with the first and the last.
pub fn even_rows(count: usize, most: usize) -> Vec<usize> {
    let chosen = count.min(most.max(2));
    (0..chosen).map(|k| (k * (count - 1) + (chosen - 1) / 2) / (chosen - 1).max(1)).collect()
}

#[cfg(test)]
mod tests {
    use super::even_rows;

    #[test]
    fn rows_are_even_and_have_both_ends() {
        assert_eq!(even_rows(5, 100), [0, 1, 2, 3, 4]);
        assert_eq!(even_rows(1, 100), [0]);
        assert_eq!(even_rows(0, 100), [0; 0]);
        assert_eq!(even_rows(101, 3), [0, 50, 100]);
        let rows = even_rows(10_001, 600);
        assert_eq!((rows[0], rows[599], rows.len()), (0, 10_000, 600));
        assert!(rows.windows(2).all(|pair| (16..=17).contains(&(pair[1] - pair[0]))));
    }
}
