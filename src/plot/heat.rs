//! Maps of coloured cells.

use super::*;

/// A cell one unit wide and high, around whole numbers, which axes of names mark.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// x of its centre.
    pub column: usize,
    /// y of its centre.
    pub row: usize,
    /// Its value, which the colour bar explains.
    pub value: Option<f64>,
    /// Its colour without a value.
    pub tint: Tint,
    /// A short text on it, like "fail"; may be empty.
    pub word: String,
}

impl Cell {
    /// Returns the ends of its diagonal in data coordinates.
    pub(super) fn corners(&self) -> [(f64, f64); 2] {
        [-0.5, 0.5].map(|half| (self.column as f64 + half, self.row as f64 + half))
    }

    fn color(&self, placed: &Placed) -> Color {
        let step = self.value.and_then(|value| placed.step(value));
        step.map_or_else(|| tint(self.tint), scale_color)
    }
}

/// Draws the cells, those of a colour together, and the texts on them in a size that fits all.
pub(super) fn draw(page: &Page, placed: &Placed) -> Done {
    let corners = |cell: &Cell| cell.corners().map(|(x, y)| placed.at(x, y).unwrap_or_default());
    let place = |cell| (cell, corners(cell).map(|corner| placed.frame.nearest(corner)), cell.color(placed));
    let mut cells: Vec<(&Cell, [Pt; 2], Color)> = placed.panel.cells.iter().map(place).collect();
    cells.sort_by_key(|(.., Color(red, green, blue))| (*red, *green, *blue));
    cells.iter().try_for_each(|(_, corners, color)| page.draw(&Rectangle::new(corners.map(units), color.filled())))?;
    let widest = cells.iter().map(|(cell, ..)| text::width(&cell.word, 1.0)).fold(0.1, f64::max);
    for (cell, [(left, bottom), (right, top)], color) in &cells {
        let size = TICK_SIZE.min(0.88 * (right - left) / widest).min(0.8 * (bottom - top));
        let middle = units((0.5 * (left + right), 0.5 * (bottom + top)));
        page.draw_text(&cell.word, &font(size, ink_on(*color), Align::Middle), middle)?;
    }
    Ok(())
}
