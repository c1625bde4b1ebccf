//! Frames of markers along the motion, and values of the markers of an element in one slice, without allocation.

use crate::body::{Frame, MOST_MARKERS};
use crate::math::Taylor;
use crate::math::array::from_fn;

/// Frames of markers with their velocities and accelerations.
pub(super) type MovingFrames<const D: usize> = [Frame<Taylor<f64>, D>];

/// Calls `see` with `item` of each entry in one slice; most elements have one or two markers.
#[inline]
pub(super) fn gathered<S, T: Copy, R>(all: &[S], item: impl Fn(&S) -> T, see: impl FnOnce(&[T]) -> R) -> R {
    match all {
        [a] => see(&[item(a)]),
        [a, b] => see(&[item(a), item(b)]),
        _ => {
            let many: [T; MOST_MARKERS] = from_fn(|i| item(&all[i.min(all.len() - 1)]));
            see(&many[..all.len()])
        }
    }
}
