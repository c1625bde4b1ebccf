//! What outputs see of modes.

use super::{Complex, Mode};

/// The change of each output by a mode that has a unit of kinetic energy, up to the same factor for all modes:
/// 1/sqrt(x^H M x) in velocity, that over |lambda| in position. One that is slower than 1/`time` goes on in that time
/// by no more than its velocity carries it. Empty for a mode without mass, which is one of states alone.
pub fn visible(mode: &Mode, time: f64) -> Vec<Complex<f64>> {
    let size = amplitude(mode, time);
    if size.is_finite() { mode.outputs.iter().map(|output| output * size).collect() } else { Vec::new() }
}

/// Size of the shape at a unit of twice the kinetic energy; infinite without mass.
pub fn amplitude(mode: &Mode, time: f64) -> f64 {
    1.0 / (mode.mass.sqrt() * mode.value.norm().max(1.0 / time))
}

/// The part that each mode has in the output that sees most of it, of the mode of which that output sees most; 1 for
/// modes without mass.
pub fn seen(modes: &[&Mode], time: f64) -> Vec<f64> {
    let changes: Vec<Vec<Complex<f64>>> = modes.iter().map(|mode| visible(mode, time)).collect();
    let outputs = changes.iter().map(Vec::len).max().unwrap_or(0);
    let most: Vec<f64> = (0..outputs)
        .map(|k| changes.iter().filter_map(|own| own.get(k)).fold(0.0, |most: f64, y| most.max(y.norm())))
        .collect();
    let part = |own: &Vec<Complex<f64>>| {
        let parts = own.iter().zip(&most).filter(|(_, most)| **most > 0.0).map(|(y, most)| y.norm() / most);
        if own.is_empty() && outputs > 0 { 1.0 } else { parts.fold(0.0, f64::max) }
    };
    changes.iter().map(part).collect()
}
