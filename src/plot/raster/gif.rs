//! GIF files: one palette for all frames, and of each frame only the difference from the one before.

use super::super::palette::{COLORS, INK, PAPER, mix};
use super::super::shape::Color;
use super::super::shape::{Drawing, Shape};
use super::canvas::RasterCanvas;
use gif::{DisposalMethod, Encoder, Frame, Repeat};
use rayon::prelude::*;

/// Index of an unchanged pixel.
const SAME: u8 = 255;
/// Number of frames drawn at once.
const BATCH: usize = 8;

/// Output pixels per nominal one.
const DENSITY: usize = 1;

/// Returns the file of `count` frames; `moving` gives the items of a frame, drawn on the constant `still`, and `done`
/// is called with the number of frames drawn.
pub(in super::super) fn gif(
    still: &Drawing,
    count: usize,
    per_second: f64,
    moving: &(impl Fn(usize) -> Vec<Shape> + Sync),
    mut done: impl FnMut(usize),
) -> Result<Vec<u8>, String> {
    let mut paper = RasterCanvas::new(still, DENSITY).ok_or("a figure without pixels")?;
    let (width, height) = paper.size();
    paper.draw(&still.shapes);
    let draw = |k: usize| {
        let mut frame = paper.clone();
        frame.draw(&moving(k));
        frame.rgb()
    };
    let side = |pixels: u32| u16::try_from(pixels).map_err(|_| format!("{pixels} pixels are too many for a GIF"));
    let palette = palette();
    let nearest = nearest(&palette);
    let mut bytes: Vec<u8> = palette.iter().flat_map(|color| [color.0, color.1, color.2]).collect();
    bytes.resize(768, 0);
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, side(width)?, side(height)?, &bytes).map_err(text)?;
    encoder.set_repeat(Repeat::Infinite).map_err(text)?;
    let mut before: Vec<u8> = Vec::new();
    for first in (0..count).step_by(BATCH) {
        let batch: Vec<usize> = (first..count.min(first + BATCH)).collect();
        let drawn = batch
            .into_par_iter()
            .map(|k| draw(k).chunks_exact(3).map(|color| nearest[bin(color)]).collect::<Vec<u8>>());
        for (k, indices) in drawn.collect::<Vec<_>>().into_iter().enumerate() {
            let mut frame = difference(&before, &indices, width as usize);
            frame.delay = delay(first + k, per_second);
            encoder.write_frame(&frame).map_err(text)?;
            before = indices;
        }
        done(count.min(first + BATCH));
    }
    drop(encoder);
    Ok(file)
}

fn text(error: impl ToString) -> String {
    error.to_string()
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
    let changed: Vec<usize> = (0..now.len()).filter(|i| !is_same(*i)).collect();
    let columns = || changed.iter().map(|i| i % width);
    let left = columns().min().unwrap_or(0);
    let right = columns().max().unwrap_or(0);
    let row = |i: Option<&usize>| i.map_or(0, |i| i / width);
    let top = row(changed.first());
    let bottom = row(changed.last());
    let places = (top..=bottom).flat_map(|y| (left..=right).map(move |x| y * width + x));
    Frame {
        left: left as u16,
        top: top as u16,
        width: (right - left + 1) as u16,
        height: (bottom - top + 1) as u16,
        dispose: DisposalMethod::Keep,
        transparent: Some(SAME),
        buffer: places.map(|i| if is_same(i) { SAME } else { now[i] }).collect(),
        ..Frame::default()
    }
}

/// Shades of each colour of figures: those towards paper, and those towards ink.
const PALE: usize = 24;
const DARK: usize = 11;
/// Colours of five bits per channel.
const BINS: usize = 1 << 15;

/// Returns the colours of figures, mixed with paper and with ink as at soft edges.
fn palette() -> Vec<Color> {
    let pale = |color: &Color, k: usize| mix(*color, PAPER, k as f64 / PALE as f64);
    let dark = |color: &Color, k: usize| mix(*color, INK, k as f64 / DARK as f64);
    let shades = |color| (0..PALE).map(move |k| pale(color, k)).chain((1..DARK).map(move |k| dark(color, k)));
    [PAPER].into_iter().chain(COLORS.iter().flat_map(shades)).collect()
}

/// Returns the index of the nearest colour for each colour of five bits per channel.
fn nearest(palette: &[Color]) -> Vec<u8> {
    let near = |bin: usize| {
        let part = |shift: usize| (bin >> shift & 31) as i32 * 33 / 4;
        let distance = |Color(red, green, blue): Color| {
            [(red, part(10)), (green, part(5)), (blue, part(0))]
                .map(|(a, b)| (i32::from(a) - b).pow(2))
                .iter()
                .sum::<i32>()
        };
        (0..palette.len()).min_by_key(|k| distance(palette[*k])).unwrap_or(0) as u8
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
