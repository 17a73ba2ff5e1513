//! Chooses the vector registers of the processor.

use fearless_simd::Level;
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether only those registers are used that every processor of the same architecture has.
static GENERIC: AtomicBool = AtomicBool::new(false);

/// Uses only those vector registers from now on that every processor of the same architecture has,
/// for measurements. Only times depend on it, no result does.
pub fn without_wide_vectors() {
    GENERIC.store(true, Ordering::Relaxed);
}

/// Returns the vector registers to compute with.
pub fn vector_level() -> Level {
    if GENERIC.load(Ordering::Relaxed) { Level::baseline() } else { Level::new() }
}
