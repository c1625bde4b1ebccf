//! Mode shapes of a linear model as motions.

use super::clip::Clip;
use super::parts::PageParts;
use crate::linearize::LinearModel;
use crate::prepared::Model;
use crate::report::mechanism::{Swing, at_rest, mode_title, shaped};
use serde::Serialize;
use std::f64::consts::TAU;

/// A mode shape that swings about the operating point.
#[derive(Clone, Debug, Serialize)]
pub struct ModePart {
    /// Its number, frequency, damping ratio and kind.
    pub label: String,
    /// Frequency, Hz; zero where it does not oscillate.
    pub frequency: f64,
    /// One period; its times are phases from 0 to 1.
    pub clip: Clip,
}

/// Phases of a period: linear interpolation between them is within 1.3 % of the amplitude.
const PHASES: usize = 20;
/// Largest number of modes.
const MOST: usize = 20;

/// Returns the slowest physical modes with a shape that fit into this many numbers, and their number without a limit.
pub fn modes(prepared: &Model, model: &LinearModel, parts: &PageParts, numbers: usize) -> (Vec<ModePart>, usize) {
    let rest = at_rest(prepared, model);
    let found = shaped(model);
    let mut shown: Vec<ModePart> = Vec::new();
    let mut taken = 0;
    for (number, pair) in found.iter().take(MOST) {
        if taken > numbers {
            break;
        }
        let swing = Swing::new(prepared, model, pair.mode, &rest);
        let mut clip = Clip::default();
        for phase in (0..=PHASES).map(|k| k as f64 / PHASES as f64) {
            clip.add(parts, phase, &swing.snapshot(TAU * phase), &[]);
        }
        taken += clip.len();
        let oscillates = pair.mode.value.im != 0.0 && !pair.mode.is_zero();
        let frequency = if oscillates { pair.mode.frequency() } else { 0.0 };
        let label = format!("mode {number}: {}, {}", mode_title(pair), pair.mode.kind.name());
        shown.push(ModePart { label, frequency, clip });
    }
    (shown, found.len())
}
