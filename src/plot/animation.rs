//! Animations as SVG or GIF.

use super::figure::Figure;
use super::shape::{Drawing, Shape};
use super::{draw, raster, svg};
use rayon::prelude::*;

/// Pictures that differ in the items of one panel only. Their axes have fixed ranges, so that nothing else changes.
pub struct Animation<F: Fn(usize) -> Figure + Sync> {
    /// Returns the picture of a frame by its index.
    pub frame: F,
    /// Number of frames.
    pub count: usize,
    /// Frames per second.
    pub per_second: f64,
}

impl<F: Fn(usize) -> Figure + Sync> Animation<F> {
    /// Returns the animation as SVG text.
    pub fn to_svg(&self) -> String {
        let frames: Vec<Vec<Shape>> = (0..self.count).into_par_iter().map(|k| self.parts(k).1).collect();
        svg::animate(&self.parts(0).0, &frames, 1.0 / self.per_second)
    }

    /// Returns the bytes of a GIF file; calls `done` with the number of frames drawn.
    ///
    /// # Errors
    /// The frames are larger than a GIF can be; the feature `figures` is off.
    pub fn to_gif(&self, done: impl FnMut(usize)) -> Result<Vec<u8>, String> {
        raster::gif(&self.parts(0).0, self.count, self.per_second, &|k| self.parts(k).1, done)
    }

    /// Returns the constant part and the items of a frame.
    fn parts(&self, k: usize) -> (Drawing, Vec<Shape>) {
        let mut still = draw::figure(&(self.frame)(k));
        let moving = still.shapes.drain(still.items.clone()).collect();
        (still, moving)
    }
}
