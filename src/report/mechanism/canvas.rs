//! A canvas in space, seen from a view: collects items with their depths.

use super::view::{View, along, square_to};
use crate::plot::{Align, Item, ItemForm, Spot, Tint};

/// Order of items of equal depth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Layer {
    Ground,
    Rod,
    Body,
    Mark,
    Joint,
    Arrow,
}

/// A point of an outline: a point in space, m, and an offset in pixels along directions in space.
pub type Step = ([f64; 3], [f64; 3]);

pub struct Canvas<'a> {
    pub view: &'a View,
    /// 0 draws in full colours, 1 in those of paper.
    pub paleness: f64,
    /// Depth of the next items, larger is nearer to the viewer.
    pub depth: f64,
    pub layer: Layer,
    items: Vec<(f64, Layer, Item)>,
}

pub const THIN: f64 = 1.4;
pub const BOLD: f64 = 2.2;

impl<'a> Canvas<'a> {
    pub fn new(view: &'a View, paleness: f64) -> Self {
        Canvas { view, paleness, depth: 0.0, layer: Layer::Ground, items: Vec::new() }
    }

    /// Returns all items, far ones first.
    pub fn finish(mut self) -> impl Iterator<Item = Item> {
        self.items.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        self.items.into_iter().map(|(_, _, item)| item)
    }

    /// Returns the colour of lines that belong to no body; `paleness` is that of full pictures.
    pub fn ink(&self, paleness: f64) -> Tint {
        Tint::Ink(paleness + (1.0 - paleness) * self.paleness)
    }

    pub fn color(&self, body: usize, paleness: f64) -> Tint {
        Tint::Body(body, paleness + (1.0 - paleness) * self.paleness)
    }

    pub fn spot(&self, r: [f64; 3]) -> Spot {
        let (x, y) = self.view.flat(r);
        Spot::data(x, y)
    }

    /// Returns a point with an offset of some pixels along a direction in space.
    pub fn beside(&self, (r, step): Step) -> Spot {
        let (right, up) = self.view.flat(step);
        self.spot(r).moved(right, up)
    }

    fn push(&mut self, spots: Vec<Spot>, tint: Tint, form: ItemForm) {
        self.items.push((self.depth, self.layer, Item { spots, tint, form }));
    }

    pub fn line(&mut self, spots: Vec<Spot>, tint: Tint, width: f64) {
        self.push(spots, tint, ItemForm::Line(width, false));
    }

    pub fn dashes(&mut self, spots: Vec<Spot>, tint: Tint, width: f64) {
        self.push(spots, tint, ItemForm::Line(width, true));
    }

    pub fn area(&mut self, spots: Vec<Spot>, tint: Tint, opacity: f64) {
        self.push(spots, tint, ItemForm::Area(opacity));
    }

    pub fn disc(&mut self, spot: Spot, radius: f64, tint: Tint) {
        self.push(vec![spot], tint, ItemForm::Disc(radius));
    }

    /// Draws a small text centred at a point.
    pub fn text(&mut self, spot: Spot, text: &str) {
        self.push(vec![spot], Tint::Ink(0.0), ItemForm::Text(text.to_string(), Align::Middle));
    }

    pub fn ring(&mut self, spot: Spot, radius: f64, tint: Tint) {
        self.disc(spot, radius + 0.5 * THIN, tint);
        self.disc(spot, radius - 0.5 * THIN, Tint::Ink(1.0));
    }

    /// Draws a filled outline.
    pub fn shape(&mut self, spots: Vec<Spot>, edge: Tint, width: f64, fill: (Tint, f64)) {
        let closed = spots.iter().chain(spots.first()).copied().collect();
        self.area(spots, fill.0, fill.1);
        self.line(closed, edge, width);
    }

    /// Draws a line with a head at its end; the head follows the last piece, both of whose ends belong to one point.
    pub fn arrow(&mut self, spots: Vec<Spot>, tint: Tint, width: f64) {
        if let [.., before, tip] = spots.as_slice() {
            let dx = tip.step.0 - before.step.0;
            let dy = tip.step.1 - before.step.1;
            let size = dx.hypot(dy);
            if size > 1e-6 {
                let x = dx / size;
                let y = dy / size;
                let corner = |back: f64, side: f64| tip.moved(-back * x - side * y, -back * y + side * x);
                let head = vec![corner(-3.0, 0.0), corner(6.5, 4.2), corner(6.5, -4.2)];
                self.area(head, tint, 1.0);
            }
        }
        self.line(spots, tint, width);
    }

    /// Returns points around `r` in the plane perpendicular to `axis`, from the angle `from` to `to`, rad, counted from
    /// `hint`; at a distance of `metres` and `pixels` more.
    pub fn arc(
        &self,
        r: [f64; 3],
        [axis, hint]: [[f64; 3]; 2],
        (from, to): (f64, f64),
        (metres, pixels): (f64, f64),
    ) -> Vec<Spot> {
        let [first, second] = square_to(axis, hint);
        let step = if metres > 0.0 { 0.1 } else { 0.25 };
        let count = ((to - from).abs() / step).ceil().max(2.0) as usize;
        let way = |i: usize| {
            let angle = from + (to - from) * i as f64 / count as f64;
            along(first.map(|x| x * angle.cos()), second, angle.sin())
        };
        let spot = |way: [f64; 3]| self.beside((along(r, way, metres), way.map(|x| x * pixels)));
        (0..=count).map(|i| spot(way(i))).collect()
    }

    /// Draws a pair of lines on both sides of a line in space, at a distance of `gap` pixels, extended at the ends.
    pub fn rails(
        &mut self,
        a: [f64; 3],
        b: [f64; 3],
        way: [f64; 3],
        gap: f64,
        reach: f64,
        tint: Tint,
    ) -> Option<(f64, f64)> {
        let (x, y) = self.view.flat(way);
        let size = x.hypot(y);
        if size < 1e-6 {
            return None;
        }
        let x = x / size;
        let y = y / size;
        for side in [gap, -gap] {
            let end = |r: [f64; 3], out: f64| self.spot(r).moved(out * x - side * y, out * y + side * x);
            let spots = vec![end(a, -reach), end(b, reach)];
            self.line(spots, tint, THIN);
        }
        Some((x, y))
    }
}
