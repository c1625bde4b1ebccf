//! The modes that a figure has room for, with the names that they have in the files.

use crate::linearize::{Branch, Complex, Kind};

/// Largest number of modes drawn, of a conjugate pair one.
pub(super) const MOST_DRAWN: usize = 12;
/// Orders of excitation by a rotation: the number of times a turn.
pub(super) const ORDERS: [f64; 2] = [1.0, 2.0];

/// A physical mode that a figure shows.
pub(super) struct DrawnMode<'a> {
    /// `mode 3` of `mode3` in the files.
    pub name: String,
    pub branch: &'a Branch,
}

/// Returns the slowest physical modes, and a note on those that are left out.
pub(super) fn modes(branches: &[Branch], most: usize) -> (Vec<DrawnMode<'_>>, String) {
    let mut all = physical(branches);
    let count = all.len();
    let bound = bound(&all, most);
    all.retain(|mode| slowest(mode.branch) <= bound);
    (all, note(most, count))
}

/// Returns the branches of the slowest physical modes and of all other kinds, and a note on those that are left out.
pub(super) fn branches(all: &[Branch], most: usize) -> (Vec<&Branch>, String) {
    let physical = physical(all);
    let bound = bound(&physical, most);
    let is_drawn = |branch: &&Branch| branch.kind != Kind::Physical || slowest(branch) <= bound;
    (all.iter().filter(is_drawn).collect(), note(most, physical.len()))
}

/// Returns the number of modes of a figure; where the mechanism turns at `speeds`, values of a parameter and rad/s, of
/// those that its excitation may meet.
pub(super) fn count(branches: &[Branch], speeds: &[(f64, f64)]) -> usize {
    if speeds.is_empty() {
        return MOST_DRAWN;
    }
    let fastest = speeds.iter().map(|(_, speed)| ORDERS[ORDERS.len() - 1] * speed.abs()).fold(0.0, f64::max);
    let met = |mode: &&DrawnMode| slowest(mode.branch) <= 1.5 * fastest;
    physical(branches).iter().filter(met).count().clamp(4, MOST_DRAWN)
}

/// Returns the physical modes, numbered as in the files.
fn physical(branches: &[Branch]) -> Vec<DrawnMode<'_>> {
    let named = branches.iter().filter(|branch| branch.points.iter().any(|(_, value)| value.im >= 0.0));
    let mode = |(i, branch): (usize, _)| DrawnMode { name: format!("mode {}", i + 1), branch };
    let is_seen = |branch: &Branch| branch.points.iter().any(|point| is_shown(point.1));
    named.enumerate().map(mode).filter(|mode| mode.branch.kind == Kind::Physical && is_seen(mode.branch)).collect()
}

/// True if finite, and not the lower one of a pair.
pub(super) fn is_shown(value: Complex<f64>) -> bool {
    value.re.is_finite() && value.im.is_finite() && value.im >= 0.0
}

/// Returns the least modulus of a branch, 1/s.
fn slowest(branch: &Branch) -> f64 {
    let sizes = branch.points.iter().map(|(_, value)| value.norm()).filter(|size| size.is_finite());
    sizes.fold(f64::INFINITY, f64::min)
}

/// Returns the least modulus up to which modes are drawn, 1/s.
fn bound(modes: &[DrawnMode], most: usize) -> f64 {
    let mut sizes: Vec<f64> = modes.iter().map(|mode| slowest(mode.branch)).collect();
    sizes.sort_by(f64::total_cmp);
    // Both of a pair are equally slow but for rounding.
    if sizes.len() <= most { f64::INFINITY } else { sizes[most - 1] * (1.0 + 1e-9) }
}

fn note(most: usize, count: usize) -> String {
    if count <= most { String::new() } else { format!("the {most} slowest of {count} modes; all are in the files") }
}
