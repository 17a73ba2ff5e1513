//! Chooses the vectors of the processor.

use fearless_simd::Level;
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether only such vectors are used as every processor of the kind has.
static GENERIC: AtomicBool = AtomicBool::new(false);

/// Does from now on without the vectors that not every processor of the kind has, as a measurement
/// may want: nothing but times depends on it.
pub fn without_wide_vectors() {
    GENERIC.store(true, Ordering::Relaxed);
}

/// Returns the vectors to compute with.
pub fn vector_level() -> Level {
    if GENERIC.load(Ordering::Relaxed) { Level::baseline() } else { Level::new() }
}
