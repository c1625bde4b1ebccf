//! GIF files: one palette for all frames, and of each frame only the difference from the one before.

use gif::{Encoder, Frame, Repeat};
use rayon::prelude::*;

/// Index of an unchanged pixel.
const SAME: u8 = 255;
const BATCH: usize = 8;
/// Colours of five bits per channel.
const BINS: usize = 1 << 15;

/// Returns the file of `count` frames in colours of a palette of 255 at most; `frame` gives red, green and blue of the
/// pixels of one, row by row, and `done` is called with the number of those that are written.
///
/// # Errors
/// The frames are larger than a GIF can be.
pub fn encode(
    size: (u32, u32),
    palette: &[[u8; 3]],
    count: usize,
    per_second: f64,
    frame: impl Fn(usize) -> Vec<u8> + Sync,
    mut done: impl FnMut(usize),
) -> Result<Vec<u8>, String> {
    let side = |pixels: u32| u16::try_from(pixels).map_err(|_| format!("{pixels} pixels are too many for a GIF"));
    let text = |error: gif::EncodingError| error.to_string();
    let nearest = nearest(palette);
    let indexed = |k: usize| frame(k).chunks_exact(3).map(|color| nearest[bin(color)]).collect::<Vec<u8>>();
    let mut bytes = palette.concat();
    bytes.resize(768, 0);
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, side(size.0)?, side(size.1)?, &bytes).map_err(text)?;
    encoder.set_repeat(Repeat::Infinite).map_err(text)?;
    let mut before: Vec<u8> = Vec::new();
    for first in (0..count).step_by(BATCH) {
        let batch = first..count.min(first + BATCH);
        let drawn: Vec<Vec<u8>> = batch.clone().into_par_iter().map(indexed).collect();
        for (k, indices) in batch.clone().zip(drawn) {
            let delay = delay(k, per_second);
            let change = Frame { delay, ..difference(&before, &indices, size.0 as usize) };
            encoder.write_frame(&change).map_err(text)?;
            before = indices;
        }
        done(batch.end);
    }
    drop(encoder);
    Ok(file)
}

/// Returns the hundredths of a second that frame `k` is shown; rounded so that the sum stays right.
fn delay(k: usize, per_second: f64) -> u16 {
    let end = |k: usize| (100.0 * k as f64 / per_second).round();
    (end(k + 1) - end(k)).clamp(1.0, f64::from(u16::MAX)) as u16
}

/// Returns the least rectangle with all changes, in which unchanged pixels are transparent. Without a change, one
/// pixel.
fn difference(before: &[u8], now: &[u8], width: usize) -> Frame<'static> {
    let is_same = |i: usize| before.get(i) == Some(&now[i]);
    let changed = || (0..now.len()).filter(|i| !is_same(*i));
    let left = changed().map(|i| i % width).min().unwrap_or(0);
    let right = changed().map(|i| i % width).max().unwrap_or(0);
    let top = changed().next().unwrap_or(0) / width;
    let bottom = changed().next_back().unwrap_or(0) / width;
    let places = (top..=bottom).flat_map(|y| (left..=right).map(move |x| y * width + x));
    let buffer: Vec<u8> = places.map(|i| if is_same(i) { SAME } else { now[i] }).collect();
    let mut frame =
        Frame::from_indexed_pixels((right - left + 1) as u16, (bottom - top + 1) as u16, buffer, Some(SAME));
    (frame.left, frame.top) = (left as u16, top as u16);
    frame
}

/// Returns the index of the nearest colour for each colour of five bits per channel.
fn nearest(palette: &[[u8; 3]]) -> Vec<u8> {
    let near = |bin: usize| {
        let apart = |part: u8, shift: usize| (i32::from(part) - (bin >> shift & 31) as i32 * 33 / 4).pow(2);
        let distance = |color: &[u8; 3]| apart(color[0], 10) + apart(color[1], 5) + apart(color[2], 0);
        (0..palette.len()).min_by_key(|k| distance(&palette[*k])).unwrap_or(0) as u8
    };
    (0..BINS).into_par_iter().map(near).collect()
}

fn bin(color: &[u8]) -> usize {
    usize::from(color[0] >> 3) << 10 | usize::from(color[1] >> 3) << 5 | usize::from(color[2] >> 3)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_shown_as_long_as_asked_for() {
        let total: u32 = (0..30).map(|k| u32::from(delay(k, 30.0))).sum();
        assert_eq!((total, delay(0, 25.0)), (100, 4));
    }

    #[test]
    fn only_changes_are_stored() {
        let mut now = vec![0; 12];
        (now[5], now[6]) = (1, 2);
        let change = difference(&[0; 12], &now, 4);
        assert_eq!((change.left, change.top, change.width, change.height), (1, 1, 2, 1));
        assert_eq!(change.buffer[..], [1, 2]);
        assert_eq!(difference(&now, &now, 4).buffer[..], [SAME]);
    }
}
