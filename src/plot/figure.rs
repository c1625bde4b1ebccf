//! A whole figure or animation, and its file formats.

use super::*;
use rayon::prelude::*;

/// One or several panels, stacked. Panels with the same x axis share it: the limits are common and only the
/// last one is labelled. A legend that is the same in all panels is drawn once.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    pub title: String,
    pub panels: Vec<Panel>,
    /// Number of panels side by side.
    pub columns: usize,
    /// Width in nominal pixels; 640 is one journal column (85 mm). The height follows from the panels.
    pub width: f64,
}

impl Default for Figure {
    fn default() -> Self {
        Self { title: String::new(), panels: Vec::new(), columns: 1, width: 640.0 }
    }
}

impl Figure {
    pub fn new() -> Self {
        Self::default()
    }

    pub fn title(self, title: impl Into<String>) -> Self {
        Self { title: title.into(), ..self }
    }

    pub fn panel(mut self, panel: Panel) -> Self {
        self.panels.push(panel);
        self
    }

    pub fn to_svg(&self) -> String {
        svg::render(&draw::figure(self))
    }

    /// Returns the bytes of a PNG file.
    ///
    /// # Errors
    /// It has more pixels than the limit; the feature `figures` is off.
    pub fn to_png(&self) -> Result<Vec<u8>, String> {
        #[cfg(feature = "figures")]
        return raster::png(&draw::figure(self));
        #[cfg(not(feature = "figures"))]
        Err("holonom is built without PNG: the feature `figures`".into())
    }
}

/// Pictures that differ in the items of one panel only. Their axes have fixed ranges, so that nothing else changes.
pub struct Animation<F: Fn(usize) -> Figure + Sync> {
    /// Returns the picture of a frame by its index.
    pub frame: F,
    pub count: usize,
    pub per_second: f64,
}

impl<F: Fn(usize) -> Figure + Sync> Animation<F> {
    pub fn to_svg(&self) -> String {
        let frames: Vec<Vec<Shape>> = (0..self.count).into_par_iter().map(|k| self.parts(k).1).collect();
        svg::animate(&self.parts(0).0, &frames, 1.0 / self.per_second)
    }

    /// Returns the bytes of a GIF file; calls `done` with the number of frames drawn.
    ///
    /// # Errors
    /// The frames are larger than a GIF can be; the feature `figures` is off.
    #[cfg_attr(not(feature = "figures"), expect(unused_variables))]
    pub fn to_gif(&self, done: impl FnMut(usize)) -> Result<Vec<u8>, String> {
        #[cfg(feature = "figures")]
        return raster::gif(&self.parts(0).0, self.count, self.per_second, |k| self.parts(k).1, done);
        #[cfg(not(feature = "figures"))]
        Err("holonom is built without GIF: the feature `figures`".into())
    }

    /// Returns the constant part and the items of a frame.
    fn parts(&self, k: usize) -> (Drawing, Vec<Shape>) {
        let mut still = draw::figure(&(self.frame)(k));
        let moving = still.shapes.drain(still.items.clone()).collect();
        (still, moving)
    }
}
