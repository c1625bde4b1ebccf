//! Memory of dense matrices and long tables, compared with the free memory before allocation.

use crate::error::{Error, Result};
use std::fs::read_to_string;

/// Largest size of the dense matrices of one computation, bytes.
const MOST: f64 = 4e9;
/// Up to this size, bytes, the free memory is not queried.
const SMALL: f64 = 64e6;

/// Refuses `copies` dense matrices of `rows` x `columns` that take more than 4 GB, or more than the free memory of the
/// machine and of the process.
///
/// # Errors
/// Bad input with the size and the limit; the caller adds the remedy.
pub fn refuse_dense(what: &str, rows: usize, columns: usize, copies: f64) -> Result<()> {
    let wanted = 8.0 * copies * rows as f64 * columns as f64;
    let limit = if wanted > SMALL { limit() } else { MOST };
    if wanted <= limit {
        return Ok(());
    }
    let wanted = size(wanted);
    let limit = size(limit);
    Err(Error::input(format!(
        "{what} takes dense matrices of {rows} x {columns}, {wanted} in all: the limit is {limit}"
    )))
}

/// Memory of a number that is kept in memory until it is written as text, bytes.
const WRITTEN: f64 = 48.0;

/// Size of a number as text, and the largest file that is not taken for a mistake, bytes.
const TEXT: f64 = 20.0;
const LARGEST_FILE: f64 = 1e12;

/// Refuses a table, kept in memory until it is written, that takes more than the free memory of the machine and
/// of the process; and one that is written as it comes, if its file would be larger than any that is wanted.
///
/// # Errors
/// Bad input with the size and the limit; the caller adds the remedy.
pub fn refuse_rows(rows: f64, columns: usize, is_kept: bool) -> Result<()> {
    let wanted = if is_kept { WRITTEN } else { TEXT } * rows * columns as f64;
    let limit = if !is_kept {
        LARGEST_FILE
    } else if wanted > SMALL {
        free()
    } else {
        f64::INFINITY
    };
    if wanted <= limit {
        return Ok(());
    }
    let wanted = size(wanted);
    let limit = size(limit);
    Err(Error::input(format!("{rows:.0} rows of {columns} numbers take {wanted} to write: the limit is {limit}")))
}

/// Number of computations, at least one, that fit in memory at once if each takes `part` of the process's peak memory.
pub fn at_once(part: f64) -> usize {
    let each = part * kilobytes("/proc/self/status", "VmHWM:").unwrap_or(0.0);
    if each > SMALL { (free() / each).max(1.0) as usize } else { usize::MAX }
}

/// A size as text, such as `1.2 GB`.
pub fn size(bytes: f64) -> String {
    match bytes {
        giga if giga >= 0.95e9 => format!("{:.1} GB", giga / 1e9),
        mega => format!("{:.0} MB", mega / 1e6),
    }
}

/// Largest size of dense matrices now, bytes; the fixed limit alone if the free memory is not known.
fn limit() -> f64 {
    free().min(MOST)
}

/// Free memory of machine and process, bytes; infinite if it is not known.
fn free() -> f64 {
    [available(), address_space()].into_iter().flatten().fold(f64::INFINITY, f64::min)
}

/// Free memory of the machine, bytes.
fn available() -> Option<f64> {
    kilobytes("/proc/meminfo", "MemAvailable:")
}

/// Unused part of the address space that `ulimit -v` grants, bytes.
fn address_space() -> Option<f64> {
    let limits = read_to_string("/proc/self/limits").ok()?;
    let line = limits.lines().find_map(|line| line.strip_prefix("Max address space"))?;
    let granted: f64 = line.split_whitespace().next()?.parse().ok()?;
    Some((granted - kilobytes("/proc/self/status", "VmSize:")?).max(0.0))
}

/// Value of a line such as `MemAvailable:   22961080 kB`, in bytes.
fn kilobytes(path: &str, key: &str) -> Option<f64> {
    let text = read_to_string(path).ok()?;
    let value = text.lines().find_map(|line| line.strip_prefix(key))?;
    value.split_whitespace().next()?.parse::<f64>().ok().map(|kilobytes| 1024.0 * kilobytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_does_not_fit_is_refused() {
        assert!(refuse_dense("a", 1000, 1000, 8.0).is_ok());
        let error = refuse_dense("null_space", 200_000, 200_000, 2.0).unwrap_err().to_string();
        assert!(
            error.starts_with("null_space takes dense matrices of 200000 x 200000, 640.0 GB in all: the limit is ")
        );
        // No product overflows.
        assert!(refuse_dense("a", usize::MAX, usize::MAX, 1.0).is_err());
    }

    #[test]
    fn rows_that_do_not_fit_are_refused() {
        assert!(refuse_rows(1000.0, 1000, true).is_ok() && refuse_rows(1e9, 40, false).is_ok());
        let error = refuse_rows(1e9, 1_000_000, true).unwrap_err().to_string();
        let whole = "1000000000 rows of 1000000 numbers take 48000000.0 GB to write: the limit is ";
        assert!(error.starts_with(whole), "{error}");
        let error = refuse_rows(1e9, 1_000_000, false).unwrap_err().to_string();
        assert!(error.ends_with("take 20000000.0 GB to write: the limit is 1000.0 GB"), "{error}");
    }

    #[test]
    fn as_many_run_at_once_as_fit() {
        assert_eq!(at_once(0.0), usize::MAX);
        assert_eq!(at_once(1e9), 1);
    }

    #[test]
    fn sizes_are_short() {
        assert_eq!([3e6, 9.6e8, 3.2e11].map(size), ["3 MB", "1.0 GB", "320.0 GB"]);
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn the_machine_says_what_it_has() {
        assert!(available().is_some_and(|bytes| bytes > 1e6));
        assert!(limit() <= MOST);
    }
}
