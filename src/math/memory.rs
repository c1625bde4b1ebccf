//! Memory of dense matrices and long tables, compared with what there is before it is asked for.

use crate::error::{Error, Result};
use std::fs::read_to_string;

/// Most that the dense matrices of one computation may take, bytes.
const MOST: f64 = 4e9;
/// Up to this, bytes, nobody is asked what there is.
const SMALL: f64 = 64e6;

/// Refuses `copies` dense matrices of `rows` x `columns` that take more than 4 GB, or than the machine and the limits
/// of the process leave.
///
/// # Errors
/// Bad input with the size and the limit; the caller adds what to use instead.
pub fn refuse_dense(what: &str, [rows, columns]: [usize; 2], copies: f64) -> Result<()> {
    let wanted = 8.0 * copies * rows as f64 * columns as f64;
    let limit = if wanted > SMALL { limit() } else { MOST };
    if wanted <= limit {
        return Ok(());
    }
    let [wanted, limit] = [wanted, limit].map(size);
    Err(Error::input(format!(
        "{what} takes dense matrices of {rows} x {columns}, {wanted} in all: the limit is {limit}"
    )))
}

/// Memory of a number that is kept to the end and written as text, bytes.
const WRITTEN: f64 = 48.0;

/// Refuses so many rows of numbers, kept in memory until they are written, that take more than the machine and the limits
/// of the process leave.
///
/// # Errors
/// Bad input with the size and the limit; the caller adds what to do.
pub fn refuse_rows(rows: f64, columns: usize) -> Result<()> {
    let wanted = WRITTEN * rows * columns as f64;
    let limit = if wanted > SMALL { free() } else { f64::INFINITY };
    if wanted <= limit {
        return Ok(());
    }
    let [wanted, limit] = [wanted, limit].map(size);
    Err(Error::input(format!("{rows:.0} rows of {columns} numbers take {wanted} to write: the limit is {limit}")))
}

/// How many computations fit at once, at least one, of which each takes `part` of what the process took at most until now.
pub fn at_once(part: f64) -> usize {
    let each = part * kilobytes("/proc/self/status", "VmHWM:").unwrap_or(0.0);
    if each > SMALL { (free() / each).max(1.0) as usize } else { usize::MAX }
}

/// Bytes for a person.
pub fn size(bytes: f64) -> String {
    match bytes {
        giga if giga >= 0.95e9 => format!("{:.1} GB", giga / 1e9),
        mega => format!("{:.0} MB", mega / 1e6),
    }
}

/// Bytes that dense matrices may take now. Where the system does not tell what there is, only the fixed limit counts.
fn limit() -> f64 {
    free().min(MOST)
}

/// Bytes that nobody uses; infinite where the system does not tell.
fn free() -> f64 {
    [available(), address_space()].into_iter().flatten().fold(f64::INFINITY, f64::min)
}

/// Memory of the machine that nobody uses.
fn available() -> Option<f64> {
    kilobytes("/proc/meminfo", "MemAvailable:")
}

/// What is left of the address space that `ulimit -v` grants.
fn address_space() -> Option<f64> {
    let limits = read_to_string("/proc/self/limits").ok()?;
    let line = limits.lines().find_map(|line| line.strip_prefix("Max address space"))?;
    let granted: f64 = line.split_whitespace().next()?.parse().ok()?;
    Some((granted - kilobytes("/proc/self/status", "VmSize:")?).max(0.0))
}

/// A line such as `MemAvailable:   22961080 kB`, in bytes.
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
        assert!(refuse_dense("a", [1000, 1000], 8.0).is_ok());
        let error = refuse_dense("null_space", [200_000, 200_000], 2.0).unwrap_err().to_string();
        assert!(
            error.starts_with("null_space takes dense matrices of 200000 x 200000, 640.0 GB in all: the limit is ")
        );
        // No product overflows.
        assert!(refuse_dense("a", [usize::MAX; 2], 1.0).is_err());
    }

    #[test]
    fn rows_that_do_not_fit_are_refused() {
        assert!(refuse_rows(1000.0, 1000).is_ok());
        let error = refuse_rows(1e9, 1_000_000).unwrap_err().to_string();
        let whole = "1000000000 rows of 1000000 numbers take 48000000.0 GB to write: the limit is ";
        assert!(error.starts_with(whole), "{error}");
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
