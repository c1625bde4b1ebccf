//! Memory of dense matrices, compared with what there is before it is asked for.

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

/// Bytes for a person.
pub fn size(bytes: f64) -> String {
    match bytes {
        giga if giga >= 0.95e9 => format!("{:.1} GB", giga / 1e9),
        mega => format!("{:.0} MB", mega / 1e6),
    }
}

/// Bytes that dense matrices may take now. Where the system does not tell what there is, only the fixed limit counts.
fn limit() -> f64 {
    [available(), address_space()].into_iter().flatten().fold(MOST, f64::min)
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
