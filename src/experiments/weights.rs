//! How much work a run will be, from its parameters alone: to share units of work evenly, and to
//! say how far they are. No result depends on it.
//!
//! The currency is one impact in the engine (about half a microsecond on the machine of
//! `benches/measured.json`).

use crate::params::Chain;

/// Impacts per unit of time and mass against σ, of the paper's chain, as the main sweep counts them.
const RATES: [(f64, f64); 8] = [
    (0.07, 0.0),
    (0.09, 0.0019),
    (0.10, 0.009),
    (0.12, 0.046),
    (0.15, 0.122),
    (0.18, 0.16),
    (0.25, 0.208),
    (0.40, 0.282),
];

/// A run of a chain for a time.
pub fn run(chain: &Chain, sigma: f64, time: f64) -> u64 {
    let masses = chain.masses as f64;
    // Each gap is searched once even if nothing happens.
    (masses * (1.0 + time * rate(sigma))) as u64
}

/// Linear between the rows of [`RATES`], and level outside.
fn rate(sigma: f64) -> f64 {
    let after = RATES.partition_point(|(at, _)| *at <= sigma);
    match (after.checked_sub(1).and_then(|i| RATES.get(i)), RATES.get(after)) {
        (Some((from, low)), Some((to, high))) => low + (high - low) * (sigma - from) / (to - from),
        (Some((_, last)), None) => *last,
        (None, _) => 0.0,
    }
}
