//! How much of each pixel a shape covers, in pixels from the upper left corner of the picture.
//!
//! That part is taken from the distance of the pixel's centre to the edge: exact for edges along the pixels, and within
//! a tenth for others. Of what overlaps in one shape the larger part counts, so that joints do not show.

use crate::plot::shape::Pt;

/// Parts of the pixels that the shape at hand covers.
#[derive(Clone)]
pub(super) struct Coverage {
    /// Width and height in pixels.
    size: (usize, usize),
    /// Covered part of each pixel, 0 to 1, row by row; all zero between shapes.
    parts: Vec<f32>,
    /// Indices of the pixels that are covered at all.
    covered: Vec<usize>,
}

impl Coverage {
    pub fn new(size: (usize, usize)) -> Self {
        Self { size, parts: vec![0.0; size.0 * size.1], covered: Vec::new() }
    }

    /// Calls `ink` with index and covered part of each pixel, and forgets them.
    pub fn take(&mut self, mut ink: impl FnMut(usize, f32)) {
        self.covered.drain(..).for_each(|i| ink(i, std::mem::take(&mut self.parts[i])));
    }

    /// Covers a part of a pixel, unless more of it is covered; pixels outside the picture are left out.
    pub fn pixel(&mut self, x: i64, y: i64, part: f64) {
        let (width, height) = (self.size.0 as i64, self.size.1 as i64);
        if part <= 0.0 || !(0..width).contains(&x) || !(0..height).contains(&y) {
            return;
        }
        let i = (y * width + x) as usize;
        if self.parts[i] == 0.0 {
            self.covered.push(i);
        }
        self.parts[i] = self.parts[i].max(part as f32);
    }

    /// Covers pixels by `part` of their centres: of the rows within `rows` those within `columns` of the row.
    fn rows(&mut self, rows: Range, columns: impl Fn(f64) -> Range, part: impl Fn(f64, f64) -> f64) {
        for y in pixels(rows, self.size.1) {
            let down = y as f64 + 0.5;
            for x in pixels(columns(down), self.size.0) {
                self.pixel(x, y, part(x as f64 + 0.5, down));
            }
        }
    }

    /// Covers a convex polygon.
    pub fn polygon(&mut self, corners: &[Pt]) {
        let next = corners.iter().cycle().skip(1);
        let area: f64 = corners.iter().zip(next.clone()).map(|(a, b)| a.0 * b.1 - a.1 * b.0).sum();
        // Of each edge a point and the unit normal to the inside.
        let normal = |(a, b): (&Pt, &Pt)| {
            let length = (b.0 - a.0).hypot(b.1 - a.1) * area.signum();
            (length != 0.0).then(|| (*a, ((a.1 - b.1) / length, (b.0 - a.0) / length)))
        };
        let edges: Vec<(Pt, Pt)> = corners.iter().zip(next).filter_map(normal).collect();
        if edges.is_empty() {
            return;
        }
        let part = |x: f64, y: f64| {
            let depths = edges.iter().map(|((x0, y0), (nx, ny))| (x - x0) * nx + (y - y0) * ny);
            (depths.fold(f64::INFINITY, f64::min) + 0.5).clamp(0.0, 1.0)
        };
        let columns = extent(corners.iter().map(|corner| corner.0));
        self.rows(extent(corners.iter().map(|corner| corner.1)), |_| columns, part);
    }

    pub fn disc(&mut self, (x, y): Pt, radius: f64) {
        let around = |center: f64| (center - radius - 1.0, center + radius + 1.0);
        self.rows(around(y), |_| around(x), |px, py| band((px - x).hypot(py - y), radius));
    }

    /// Covers a segment of a width with square ends.
    pub fn segment(&mut self, (x0, y0): Pt, (x1, y1): Pt, width: f64) {
        let (length, half) = ((x1 - x0).hypot(y1 - y0), 0.5 * width);
        if length < 1e-9 {
            return;
        }
        let ((ux, uy), reach) = (((x1 - x0) / length, (y1 - y0) / length), half + 1.0);
        let (left, right) = (x0.min(x1) - reach, x0.max(x1) + reach);
        // Of a row, the part within reach of the line on both sides.
        let columns = |y: f64| {
            let (middle, wide) = (x0 + (y - y0) * ux / uy, reach / uy.abs());
            if uy.abs() < 1e-6 { (left, right) } else { (left.max(middle - wide), right.min(middle + wide)) }
        };
        let part = |x: f64, y: f64| {
            let (along, away) = ((x - x0) * ux + (y - y0) * uy, (x - x0) * uy - (y - y0) * ux);
            band(away.abs(), half) * (along.min(length - along) + 0.5).clamp(0.0, 1.0)
        };
        self.rows((y0.min(y1) - reach, y0.max(y1) + reach), columns, part);
    }
}

/// Least and largest position.
type Range = (f64, f64);

/// Returns the range of positions, with a pixel on both sides.
fn extent(places: impl Iterator<Item = f64>) -> Range {
    let (least, most) = places.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
    (least - 1.0, most + 1.0)
}

/// Returns the pixels in a range, of `count` from zero on.
fn pixels((from, to): Range, count: usize) -> std::ops::Range<i64> {
    let place = |value: f64| value.clamp(0.0, count as f64) as i64;
    place(from.floor())..place(to.ceil())
}

/// Returns the part of a pixel, at a distance from the middle of a band of this half width, that the band covers.
fn band(distance: f64, half: f64) -> f64 {
    (half + 0.5 - distance).clamp(0.0, (2.0 * half).min(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The covered parts of a picture of 8 by 4 pixels.
    fn parts(draw: impl Fn(&mut Coverage)) -> Vec<f32> {
        let mut coverage = Coverage::new((8, 4));
        draw(&mut coverage);
        coverage.parts
    }

    #[test]
    fn edges_along_pixels_are_exact() {
        let line = parts(|coverage| coverage.segment((1.0, 1.75), (6.5, 1.75), 1.0));
        assert_eq!(line[8..16], [0.0, 0.75, 0.75, 0.75, 0.75, 0.75, 0.375, 0.0]);
        assert_eq!(line[16..24], [0.0, 0.25, 0.25, 0.25, 0.25, 0.25, 0.125, 0.0]);
        let thin = parts(|coverage| coverage.segment((1.0, 1.5), (6.5, 1.5), 0.25));
        assert_eq!((thin[9], thin[1]), (0.25, 0.0));
        let square = parts(|coverage| coverage.polygon(&[(1.0, 1.0), (1.0, 3.0), (2.5, 3.0), (2.5, 1.0)]));
        assert_eq!(square[8..12], [0.0, 1.0, 0.5, 0.0]);
    }

    #[test]
    fn areas_are_about_those_of_the_shapes() {
        let area = |draw: &dyn Fn(&mut Coverage)| parts(draw).iter().sum::<f32>();
        let disc = area(&|coverage| coverage.disc((4.2, 1.9), 1.5));
        assert!((disc - 2.25 * std::f32::consts::PI).abs() < 0.1, "{disc}");
        let line = area(&|coverage| coverage.segment((1.0, 0.5), (7.0, 3.5), 0.7));
        assert!((line - 0.7 * 45f32.sqrt()).abs() < 0.1, "{line}");
    }

    #[test]
    fn what_is_outside_is_left_out() {
        let far = parts(|coverage| {
            coverage.segment((-1e30, 9.0), (1e30, 9.0), 1.0);
            coverage.disc((1e300, -1e300), 3.0);
            coverage.polygon(&[(-9.0, -9.0), (-5.0, -9.0), (-5.0, -5.0)]);
        });
        assert!(far.iter().all(|part| *part == 0.0));
    }
}
