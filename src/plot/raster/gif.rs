//! GIF files: one palette for all frames, and of each frame only the difference from the one before.

use super::super::shape::{Drawing, Shape};
use super::canvas::RasterCanvas;
use gif::{DisposalMethod, Encoder, Frame, Repeat};
use rayon::prelude::*;

/// Number of frames from which the palette is taken.
const SAMPLES: usize = 6;
/// Number of colours, and the index of an unchanged pixel.
const COLORS: usize = 255;
const SAME: u8 = 255;
/// Number of the most frequent colours that are always in the palette, such as those of areas.
const FREQUENT: usize = 64;
/// Colours nearer than this to a more frequent one are added only after all others.
const NEAR: i32 = 14;
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
    let samples: Vec<usize> = (0..SAMPLES.min(count)).map(|k| k * (count - 1) / (SAMPLES - 1).max(1)).collect();
    let palette = Palette::new(&samples.into_par_iter().map(&draw).collect::<Vec<_>>());
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, side(width)?, side(height)?, &palette.bytes()).map_err(text)?;
    encoder.set_repeat(Repeat::Infinite).map_err(text)?;
    let mut before: Vec<u8> = Vec::new();
    for first in (0..count).step_by(BATCH) {
        let batch: Vec<usize> = (first..count.min(first + BATCH)).collect();
        let drawn = batch.into_par_iter().map(|k| palette.indices(&draw(k)));
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
    let (left, right) = (columns().min().unwrap_or(0), columns().max().unwrap_or(0));
    let row = |i: Option<&usize>| i.map_or(0, |i| i / width);
    let (top, bottom) = (row(changed.first()), row(changed.last()));
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

type Rgb = [u8; 3];

/// At most [`COLORS`] colours, with the index of the nearest for each colour of five bits per channel.
struct Palette {
    colors: Vec<Rgb>,
    nearest: Vec<u8>,
}

const BINS: usize = 1 << 15;

fn bin(color: &[u8]) -> usize {
    usize::from(color[0] >> 3) << 10 | usize::from(color[1] >> 3) << 5 | usize::from(color[2] >> 3)
}

impl Palette {
    /// The most frequent colours, those far from each other first.
    fn new(pictures: &[Vec<u8>]) -> Self {
        let mut sums = vec![[0u64; 4]; BINS];
        for color in pictures.iter().flat_map(|pixels| pixels.chunks_exact(3)) {
            let sum = &mut sums[bin(color)];
            sum[0] += 1;
            (0..3).for_each(|k| sum[k + 1] += u64::from(color[k]));
        }
        let mut found: Vec<[u64; 4]> = sums.iter().copied().filter(|sum| sum[0] > 0).collect();
        found.sort_by_key(|sum| std::cmp::Reverse(sum[0]));
        let mean = |sum: &[u64; 4]| [1, 2, 3].map(|k| ((sum[k] + sum[0] / 2) / sum[0]) as u8);
        let (mut colors, mut near): (Vec<Rgb>, Vec<Rgb>) = (vec![[255; 3]], Vec::new());
        for (k, color) in found.iter().map(mean).enumerate() {
            let is_near = colors.iter().any(|known| distance(*known, color) < NEAR * NEAR);
            if is_near && k >= FREQUENT { near.push(color) } else { colors.push(color) }
        }
        colors.extend(near);
        colors.truncate(COLORS);
        let center = |bin: usize| [bin >> 10, bin >> 5 & 31, bin & 31].map(|part| (8 * part + 4) as u8);
        let own = |bin: usize| if sums[bin][0] > 0 { mean(&sums[bin]) } else { center(bin) };
        let nearest = (0..BINS).into_par_iter().map(|bin| closest(&colors, own(bin))).collect();
        Self { colors, nearest }
    }

    fn indices(&self, pixels: &[u8]) -> Vec<u8> {
        pixels.chunks_exact(3).map(|color| self.nearest[bin(color)]).collect()
    }

    /// Returns the palette padded with black, with an entry for [`SAME`].
    fn bytes(&self) -> Vec<u8> {
        let mut bytes = self.colors.concat();
        bytes.resize(3 * (COLORS + 1), 0);
        bytes
    }
}

fn closest(colors: &[Rgb], color: Rgb) -> u8 {
    let place = (0..colors.len()).min_by_key(|k| distance(colors[*k], color));
    place.unwrap_or(0) as u8
}

fn distance(a: Rgb, b: Rgb) -> i32 {
    (0..3).map(|k| (i32::from(a[k]) - i32::from(b[k])).pow(2)).sum()
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

    #[test]
    fn rare_colors_have_a_place() {
        let mut picture = [255; 3].repeat(10_000);
        (0..200u8).for_each(|k| picture.extend([200, k, k].repeat(20)));
        picture.extend([0, 114, 178]);
        let palette = Palette::new(&[picture]);
        assert_eq!(palette.colors[usize::from(palette.indices(&[0, 114, 178])[0])], [0, 114, 178]);
        assert_eq!(palette.colors[usize::from(palette.indices(&[255, 255, 255])[0])], [255; 3]);
    }
}
