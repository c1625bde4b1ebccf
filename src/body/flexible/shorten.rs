//! A line that does not stretch but shortens as it bends.
//!
//! Few modes or functions cannot represent the shortening of a bent line: the squares of its slopes would be axial
//! strain and lock it. If it keeps its length instead, points move along it at second order,
//!
//! ```text
//! u_x = -int_0^s (w_y'^2 + w_z'^2)/2 ds,   psi_ij = -int_0^s w_i'.w_j' ds along x,
//! ```
//!
//! and forces along the line do work at the shortening: centrifugal forces stiffen bending, thrust softens it (Wallrapp
//! and Schwertassek, Representation of Geometric Stiffening in Multibody System Simulation, Int. J. Numer. Meth. Engng.
//! 32, 1991).

use super::gauss::{gauss_legendre, on_interval};
use super::line::Shapes;
use super::shape::{Piece, Second};

/// Gauss points between two breaks of the shapes: squares of slopes of cubics are exact by 3.
const POINTS: usize = 6;

/// -int w_i'.w_j' ds from the left end to `s`, row by row for the coordinates there.
pub fn shortening(line: &impl Shapes, s: f64) -> Vec<f64> {
    let mut table = Vec::new();
    for [from, to] in spans(line).into_iter().filter(|[from, _]| *from < s) {
        add_shortening(line, &mut table, [from, to.min(s)]);
    }
    table
}

/// Adds m_ij and P_0ij of the shortening to the piece of all coordinates from `start` on.
pub fn shorten<const D: usize>(line: &impl Shapes, start: f64, piece: &mut Piece<D>) {
    let n = piece.dofs.len();
    let rule = gauss_legendre(POINTS);
    let mut table = vec![0.0; n * n];
    let mut sums = vec![[0.0; 2]; n * n];
    for [from, to] in spans(line) {
        for (s, weight) in on_interval(&rule, [from.max(start), to]).filter(|_| to > start) {
            let mut there = table.clone();
            add_shortening(line, &mut there, [from, s]);
            let mass = weight * line.profile().at(s).rho_a;
            let both = sums.iter_mut().zip(&there);
            both.for_each(|(sum, x)| *sum = [sum[0] + mass * x, sum[1] + mass * s * x]);
        }
        add_shortening(line, &mut table, [from, to]);
    }
    for (k, [moment, product]) in sums.into_iter().enumerate() {
        let mut second = Second { other: k % n, moment: [0.0; D], product: [[0.0; D]; D] };
        (second.moment[0], second.product[0][0]) = (moment, product);
        let row = &mut piece.second[k / n];
        match row.iter_mut().find(|known| known.other == second.other) {
            Some(known) => known.add(1.0, &second),
            None if second.counts() => row.push(second),
            None => {}
        }
    }
}

fn add_shortening(line: &impl Shapes, table: &mut Vec<f64>, ends: [f64; 2]) {
    for (s, weight) in on_interval(&gauss_legendre(POINTS), ends) {
        let shapes = line.at(s).shapes;
        table.resize(shapes.len() * shapes.len(), 0.0);
        let pairs = shapes.iter().flat_map(|left| shapes.iter().map(move |right| (left.slope, right.slope)));
        for (sum, (left, right)) in table.iter_mut().zip(pairs) {
            *sum -= weight * (left[0] * right[0] + left[1] * right[1]);
        }
    }
}

fn spans(line: &impl Shapes) -> Vec<[f64; 2]> {
    line.breaks().windows(2).map(|ends| [ends[0], ends[1]]).collect()
}
