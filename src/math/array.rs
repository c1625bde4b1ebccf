//! Arrays of plain values.
//!
//! `std::array::from_fn` and `map` can stop half-way and drop the values made so far, which is compiled for every
//! closure. Numbers need none of it, and thousands of closures here make vectors of numbers.

/// `[f(0), f(1), ...]`
#[inline(always)]
pub fn from_fn<T: Copy, const N: usize>(mut f: impl FnMut(usize) -> T) -> [T; N] {
    const { assert!(N > 0, "an array without values has no first one") };
    let mut values = [f(0); N];
    #[expect(clippy::needless_range_loop, reason = "an iterator would be compiled for every type")]
    for i in 1..N {
        values[i] = f(i);
    }
    values
}

/// Functions of each value.
pub trait Each<T, const N: usize> {
    /// `[f(self[0]), f(self[1]), ...]`
    fn each<U: Copy>(&self, f: impl FnMut(T) -> U) -> [U; N];
}

impl<T: Copy, const N: usize> Each<T, N> for [T; N] {
    #[inline(always)]
    fn each<U: Copy>(&self, mut f: impl FnMut(T) -> U) -> [U; N] {
        from_fn(|i| f(self[i]))
    }
}
