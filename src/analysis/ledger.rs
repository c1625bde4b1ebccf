//! Energies of a motion.

/// Energies at one state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ledger {
    /// Kinetic energy, J.
    pub kinetic: f64,
    /// Potential energy, J.
    pub potential: f64,
    /// Work of non-conservative forces and moving constraints since the start, J.
    pub work: f64,
    /// kinetic + potential - initial - work, J.
    pub error: f64,
}
