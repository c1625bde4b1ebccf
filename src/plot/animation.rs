//! Pictures one after another, as an animated SVG or GIF.

use super::figure::Figure;
use super::shape::{Drawing, Shape};
use super::{draw, raster, svg};
use rayon::prelude::*;

/// Pictures of which only the items of one panel differ. Their axes have fixed ranges, so that nothing else moves.
pub struct Animation<F: Fn(usize) -> Figure + Sync> {
    /// The picture of a frame.
    pub frame: F,
    /// How many there are.
    pub count: usize,
    /// So many are shown in a second.
    pub per_second: f64,
}

impl<F: Fn(usize) -> Figure + Sync> Animation<F> {
    /// As SVG text.
    pub fn to_svg(&self) -> String {
        let frames: Vec<Vec<Shape>> = (0..self.count).into_par_iter().map(|k| self.parts(k).1).collect();
        svg::animate(&self.parts(0).0, &frames, 1.0 / self.per_second)
    }

    /// As the bytes of a GIF file; calls `done` with the number of frames that are drawn.
    ///
    /// # Errors
    /// When the frames are larger than a GIF can be, and without the feature `figures`.
    pub fn to_gif(&self, done: impl FnMut(usize)) -> Result<Vec<u8>, String> {
        raster::gif(&self.parts(0).0, self.count, self.per_second, &|k| self.parts(k).1, done)
    }

    /// What stays, and what moves, of a frame.
    fn parts(&self, k: usize) -> (Drawing, Vec<Shape>) {
        let mut still = draw::figure(&(self.frame)(k));
        let moving = still.shapes.drain(still.items.clone()).collect();
        (still, moving)
    }
}
