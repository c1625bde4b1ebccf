//! The backend on which plotters draws: it records shapes. Its pixels are hundredths of a nominal one.

use super::shape::sharp;
use super::*;
use plotters::style::text_anchor::VPos;
use plotters_backend::{BackendColor, BackendCoord, BackendStyle, BackendTextStyle, FontTransform};
use plotters_backend::{DrawingBackend, DrawingErrorKind};
use std::{cell::RefCell, convert::Infallible, rc::Rc};

/// Units of the backend in a nominal pixel.
const UNITS: f64 = 100.0;
/// Sides of the paper in units: the picture ends where the drawing does.
const PAPER: u32 = 100_000_000;

/// The end of an operation; a sketch refuses nothing.
type Done<T = ()> = Result<T, DrawingErrorKind<Infallible>>;

pub(super) fn units(pixels: f64) -> i32 {
    (UNITS * pixels).round() as i32
}

fn pixels((x, y): BackendCoord) -> Pt {
    (f64::from(x) / UNITS, f64::from(y) / UNITS)
}

/// Shapes to which others are added, their lines with one stroke.
#[derive(Clone)]
pub(super) struct Sketch {
    pub shapes: Rc<RefCell<Shapes>>,
    stroke: Stroke,
}

impl Sketch {
    pub fn new(shapes: Shapes, stroke: Stroke) -> Self {
        Self { shapes: Rc::new(RefCell::new(shapes)), stroke }
    }
}

impl DrawingBackend for Sketch {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        (PAPER, PAPER)
    }

    fn ensure_prepared(&mut self) -> Done {
        Ok(())
    }

    fn present(&mut self) -> Done {
        Ok(())
    }

    /// Charts have no single pixels.
    fn draw_pixel(&mut self, _: BackendCoord, _: BackendColor) -> Done {
        Ok(())
    }

    /// Draws a line of a grid or a mark, which is sharp where it is parallel to an axis.
    fn draw_line<S: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, _: &S) -> Done {
        let (a, b) = pixels(from);
        let (c, d) = pixels(to);
        let [a, c] = if a == c { [sharp(a); 2] } else { [a, c] };
        let [b, d] = if b == d { [sharp(b); 2] } else { [b, d] };
        self.shapes.borrow_mut().draw(Paint::Line(self.stroke), [(a, b), (c, d)]);
        Ok(())
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(&mut self, path: I, style: &S) -> Done {
        let path: Vec<BackendCoord> = path.into_iter().collect();
        path.windows(2).try_for_each(|ends| self.draw_line(ends[0], ends[1], style))
    }

    fn draw_text<S: BackendTextStyle>(&mut self, text: &str, style: &S, at: BackendCoord) -> Done {
        let align = [Align::Start, Align::End, Align::Middle][style.anchor().h_pos as usize];
        // All turned texts read upwards, also those of right axes, which plotters turns the other way.
        let (turned, anchor) = match (style.transform(), style.anchor().v_pos) {
            (FontTransform::None, anchor) => (false, anchor),
            (FontTransform::Rotate90, VPos::Top) => (true, VPos::Bottom),
            (_, anchor) => (true, anchor),
        };
        self.shapes.borrow_mut().lines(text, pixels(at), Font(style.size() / UNITS, INK, align), anchor, turned);
        Ok(())
    }

    fn estimate_text_size<S: BackendTextStyle>(&self, text: &str, style: &S) -> Done<(u32, u32)> {
        Ok((text::width(text, style.size()) as u32, style.size() as u32))
    }
}
