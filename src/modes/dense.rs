//! All modes of dense matrices, without constraints and with M = I.

use crate::error::two_digits;
use crate::math::eigen::{Complex, Matrix};
use serde::Serialize;
use std::fmt;

/// The mode exp(-decay t) cos(swing t) of an eigenvalue -decay + i swing and its conjugate.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SpectralMode {
    /// Damping rate, 1/s; negative for a growing mode.
    pub decay: f64,
    /// Oscillation frequency, rad/s.
    pub swing: f64,
}

impl SpectralMode {
    /// |lambda|, 1/s.
    pub fn rate(&self) -> f64 {
        self.decay.hypot(self.swing)
    }
}

impl fmt::Display for SpectralMode {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.decay, self.swing) {
            // Slower ones are rounding, or as good as none.
            _ if self.rate() < 1e-6 => write!(out, "neither swings nor decays"),
            (decay, swing) if swing > decay.abs() => write!(out, "swings at {} rad/s", two_digits(swing)),
            (decay, _) if decay < 0.0 => write!(out, "grows at {} 1/s", two_digits(-decay)),
            (decay, _) => write!(out, "decays at {} 1/s", two_digits(decay)),
        }
    }
}

/// The modes of z'' + C z' + K z = 0, from the slowest to the fastest.
pub fn all(k: &Matrix, c: &Matrix) -> Option<Vec<SpectralMode>> {
    let values = eigenvalues(k, c, k.nrows())?;
    let upper = values.iter().filter(|value| value.im >= 0.0);
    let mut modes: Vec<SpectralMode> = upper.map(|value| SpectralMode { decay: -value.re, swing: value.im }).collect();
    modes.sort_by(|a, b| a.rate().total_cmp(&b.rate()));
    Some(modes)
}

/// Eigenvalues of [0 s; -K/s -C], with s the size of the frequencies, so that all entries have one unit. The `moving`
/// coordinates come first. The others are states xi with xi' + C z' + K z = 0, of which only the rates enter.
pub fn eigenvalues(k: &Matrix, c: &Matrix, moving: usize) -> Option<Vec<Complex<f64>>> {
    let size = moving + k.nrows();
    let s = k.amax().sqrt();
    let s = if s > 0.0 { s } else { 1.0 };
    let companion = faer::Mat::from_fn(size, size, |i, j| match (i < moving, j < moving) {
        (true, true) => 0.0,
        (true, false) => s * f64::from(u8::from(i == j - moving)),
        (false, true) => -k[(i - moving, j)] / s,
        (false, false) => -c[(i - moving, j - moving)],
    });
    faer::set_global_parallelism(faer::Par::Seq);
    if size == 0 { Some(Vec::new()) } else { companion.eigenvalues().ok() }
}
