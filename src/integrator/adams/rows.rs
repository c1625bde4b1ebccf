//! Rows of differences of y', by components.

use super::coefficients::ROOM;
use crate::math::array::from_fn;

/// Components that stand together: sums over the rows stay in registers for them.
pub const QUAD: usize = 4;

/// Neighbouring components of one row.
pub type Quad = [f64; QUAD];

/// [`ROOM`] rows of equal length. The numbers of all rows for a few components stand together.
#[derive(Clone)]
pub struct Rows {
    len: usize,
    pub blocks: Vec<[Quad; ROOM]>,
}

impl Rows {
    /// Rows of zeros.
    pub fn new(len: usize) -> Self {
        Rows { len, blocks: vec![[[0.0; QUAD]; ROOM]; len.div_ceil(QUAD)] }
    }

    /// The numbers of row `i`.
    pub fn row(&self, i: usize) -> impl Iterator<Item = f64> + '_ {
        self.blocks.iter().flat_map(move |block| block[i]).take(self.len)
    }

    /// Sets the numbers of row `i`.
    pub fn set(&mut self, i: usize, numbers: &[f64]) {
        for (block, numbers) in self.blocks.iter_mut().zip(numbers.chunks(QUAD)) {
            block[i] = padded(numbers);
        }
    }
}

/// The components of the block with this number, with zeros behind the last.
#[inline(always)]
pub fn quad(x: &[f64], block: usize) -> Quad {
    let x = &x[block * QUAD..];
    x.first_chunk().copied().unwrap_or_else(|| padded(x))
}

fn padded(x: &[f64]) -> Quad {
    let mut quad = [0.0; QUAD];
    let count = x.len().min(QUAD);
    quad[..count].copy_from_slice(&x[..count]);
    quad
}

/// Sets the components of the block with this number.
#[inline(always)]
pub fn store(x: &mut [f64], block: usize, quad: Quad) {
    let x = &mut x[block * QUAD..];
    match x.first_chunk_mut() {
        Some(place) => *place = quad,
        None => x.iter_mut().zip(quad).for_each(|(x, component)| *x = component),
    }
}

/// x + factor y
#[inline(always)]
pub fn plus(x: Quad, factor: f64, y: Quad) -> Quad {
    from_fn(|i| x[i] + factor * y[i])
}
