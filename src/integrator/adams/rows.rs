//! Rows of differences of y', by components.

use super::coefficients::ROOM;

/// Components that stand together: sums over the rows stay in registers for them.
pub const LANES: usize = 4;

/// Neighbouring components of one row.
pub type Lanes = [f64; LANES];

/// [`ROOM`] rows of equal length. The numbers of all rows for a few components stand together.
#[derive(Clone)]
pub struct Rows {
    len: usize,
    pub blocks: Vec<[Lanes; ROOM]>,
}

impl Rows {
    /// Rows of zeros.
    pub fn new(len: usize) -> Self {
        Rows { len, blocks: vec![[[0.0; LANES]; ROOM]; len.div_ceil(LANES)] }
    }

    /// The numbers of row `i`.
    pub fn row(&self, i: usize) -> impl Iterator<Item = f64> + '_ {
        self.blocks.iter().flat_map(move |block| block[i]).take(self.len)
    }

    /// Sets the numbers of row `i`.
    pub fn set(&mut self, i: usize, numbers: &[f64]) {
        for (block, numbers) in self.blocks.iter_mut().zip(numbers.chunks(LANES)) {
            block[i] = padded(numbers);
        }
    }
}

/// The components of the block with this number, with zeros behind the last.
#[inline(always)]
pub fn lanes(x: &[f64], block: usize) -> Lanes {
    let x = &x[block * LANES..];
    x.first_chunk().copied().unwrap_or_else(|| padded(x))
}

fn padded(x: &[f64]) -> Lanes {
    let mut lanes = [0.0; LANES];
    let count = x.len().min(LANES);
    lanes[..count].copy_from_slice(&x[..count]);
    lanes
}

/// Sets the components of the block with this number.
#[inline(always)]
pub fn store(x: &mut [f64], block: usize, lanes: Lanes) {
    let x = &mut x[block * LANES..];
    match x.first_chunk_mut() {
        Some(place) => *place = lanes,
        None => x.iter_mut().zip(lanes).for_each(|(x, lane)| *x = lane),
    }
}

/// x + factor y
#[inline(always)]
pub fn plus(x: Lanes, factor: f64, y: Lanes) -> Lanes {
    std::array::from_fn(|i| x[i] + factor * y[i])
}
