//! The symbolic analysis of a saddle-point matrix, shared by all who factor it.

use super::Pattern;
use super::parts::Plan;
use super::redundant_rows::Alike;
use std::fmt;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// Structures of the factors of [M G^T; G 0] for one pair of patterns, each found when it is needed first: they depend on
/// nothing but the patterns and which coordinates are late. [`SaddlePoint::sharing`](super::SaddlePoint::sharing) takes
/// them.
#[derive(Default)]
pub struct Analysis {
    /// Blocks of G that are levers.
    levers: Vec<Lever>,
    is_crowded: OnceLock<bool>,
    found: Mutex<Vec<(Vec<bool>, Arc<Plan>)>>,
}

/// A block of G in the rows of a point that all translations of its body move, and that turns about the body's origin:
/// [s I | a], with s = 1 or -1 and its entries row by row.
#[derive(Clone, Copy, Debug)]
pub struct Lever {
    /// Index of its first entry in G.
    pub first_entry: usize,
    /// The sign s.
    pub sign: f64,
}

impl Analysis {
    /// For patterns with these levers.
    pub fn with(levers: Vec<Lever>) -> Self {
        Analysis { levers, ..Analysis::default() }
    }

    /// True if there are more rows of G over the same coordinates than these, so that some always depend on others.
    pub(super) fn is_crowded(&self, g: &Pattern) -> bool {
        *self.is_crowded.get_or_init(|| Alike::new(g).is_crowded())
    }

    /// The structure with the coordinates for which `late` is true behind their multipliers.
    pub(super) fn plan(&self, mass: &Pattern, g: &Pattern, late: &[bool]) -> Arc<Plan> {
        let mut found = self.found.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, plan)) = found.iter().find(|(of, _)| of == late) {
            return plan.clone();
        }
        let plan = Arc::new(Plan::new(mass, g, late, &self.levers));
        found.push((late.to_vec(), plan.clone()));
        plan
    }
}

impl fmt::Debug for Analysis {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.debug_struct("Analysis").finish_non_exhaustive()
    }
}
