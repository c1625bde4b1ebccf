//! The symbolic analysis of a saddle-point matrix, shared by all who factor it.

use super::alike::Alike;
use super::parts::FactorPlan;
use super::{Lever, Pattern};
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
    found: Mutex<Vec<(Vec<bool>, Arc<FactorPlan>)>>,
    /// The analysis of G without the rows that were dropped last.
    without: Mutex<Option<(Vec<usize>, Arc<Analysis>)>>,
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
    pub(super) fn plan(&self, mass: &Pattern, g: &Pattern, late: &[bool]) -> Arc<FactorPlan> {
        let mut found = self.found.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, plan)) = found.iter().find(|(of, _)| of == late) {
            return plan.clone();
        }
        let plan = Arc::new(FactorPlan::new(mass, g, late, &self.levers));
        found.push((late.to_vec(), plan.clone()));
        plan
    }

    /// The analysis of G without these rows.
    pub(super) fn without(&self, dropped: &[usize]) -> Arc<Analysis> {
        let mut known = self.without.lock().unwrap_or_else(PoisonError::into_inner);
        match &*known {
            Some((of, analysis)) if of == dropped => analysis.clone(),
            _ => known.insert((dropped.to_vec(), Arc::default())).1.clone(),
        }
    }
}

impl fmt::Debug for Analysis {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.debug_struct("Analysis").finish_non_exhaustive()
    }
}
