//! The symbolic analysis of a saddle-point matrix, shared by all who factor it.

use super::Pattern;
use super::blocks::Layout;
use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

/// Layouts of the factors of [M G^T; G 0] for one pair of patterns, each found when it is needed first: they depend on
/// nothing but the patterns and which coordinates are late. [`SaddlePoint::sharing`](super::SaddlePoint::sharing) takes
/// them.
#[derive(Default)]
pub struct Analysis {
    found: Mutex<Vec<(Vec<bool>, Arc<Layout>)>>,
}

impl Analysis {
    /// The layout with the coordinates for which `late` is true behind their multipliers.
    pub(super) fn layout(&self, mass: &Pattern, g: &Pattern, late: &[bool]) -> Arc<Layout> {
        let mut found = self.found.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, layout)) = found.iter().find(|(of, _)| of == late) {
            return layout.clone();
        }
        let layout = Arc::new(Layout::new(mass, g, late));
        found.push((late.to_vec(), layout.clone()));
        layout
    }
}

impl fmt::Debug for Analysis {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.debug_struct("Analysis").finish_non_exhaustive()
    }
}
