//! Evaluation of the equations.

/// Bodies, or joints, that are evaluated by one thread at a time.
/// Unit: `[1]`. Why: measured: a portion takes some 30 us, twice what another thread takes to wake up; a mechanism with
/// fewer is evaluated by one. Test: none: results are the same to the bit.
pub const ELEMENTS_OF_A_PORTION: usize = 1024;

/// Numbers of a sum of vectors that are added by one thread at a time.
/// Unit: `[1]`. Why: a choice: some 20 us, what another thread takes to wake up. Test: none: results are the same to the
/// bit.
pub const NUMBERS_OF_A_PORTION: usize = 16_384;
