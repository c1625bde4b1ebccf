//! Pictures one after another, as an animated SVG or GIF.

use super::bitmap::Sheet;
use super::figure::Figure;
use super::shape::{Drawing, Shape};
use super::{draw, gif, svg};
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
        let (still, _) = self.parts();
        let frames: Vec<Vec<Shape>> = (0..self.count).into_par_iter().map(|k| self.moving(k)).collect();
        svg::animate(&still, &frames, 1.0 / self.per_second)
    }

    /// As the bytes of a GIF file; calls `done` with the number of frames that are drawn.
    ///
    /// # Errors
    /// When the frames are larger than a GIF can be.
    pub fn to_gif(&self, done: impl FnMut(usize)) -> Result<Vec<u8>, String> {
        let (still, first) = self.parts();
        let sheet = Sheet::of_frames(&still);
        let paper = sheet.draw(sheet.blank(), &still.shapes)?;
        let picture = |moving: &[Shape]| sheet.draw(paper.clone(), moving).map(|pixels| sheet.output(&pixels));
        let draw = |k: usize| if k == 0 { picture(&first) } else { picture(&self.moving(k)) };
        gif::encode(sheet.size, self.count, self.per_second, &draw, done)
    }

    /// What stays, and what moves of the first frame.
    fn parts(&self) -> (Drawing, Vec<Shape>) {
        let mut still = draw::figure(&(self.frame)(0));
        let moving = still.shapes.drain(still.items.clone()).collect();
        (still, moving)
    }

    fn moving(&self, k: usize) -> Vec<Shape> {
        let mut drawing = draw::figure(&(self.frame)(k));
        drawing.shapes.drain(drawing.items.clone()).collect()
    }
}
