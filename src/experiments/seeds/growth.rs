//! The mean count that nucleation and growth let expect, from the derived chances of single gaps and the
//! measured spreading from one of them, and from nothing else.
//!
//! A gap at the place x has no impact in the window (T, T + W] if no seed y sends one there. Were
//! seeds independent, and what each sets off the same as alone, the probability would be
//!
//! ∏_y (1 − ∫_0^T B(|x − y|, T − s) dp_y(s) − ∫_T^{T+W} R(|x − y|, T + W − s) dp_y(s)),
//!
//! with p_y(s) the probability that the gap y closes by itself by the time s, B(l, t) the share of gaps at
//! distance l that are hit in a window W which begins a time t after the first impact of a seed, and
//! R(l, t) the share that is hit within t.

use super::ByDistance;
use crate::circuits;
use crate::circuits::distribution::{Law, SampleSpace};
use crate::circuits::nucleation::reach::Reach;
use crate::experiments::estimates::{jackknife, left_out};
use crate::numerics::statistics::{Estimate, last_rise};
use crate::params::{Chain, SeedsParams};
use serde::{Deserialize, Serialize};

/// Mean counts after one transient.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Prediction {
    /// Transient T.
    pub transient: f64,
    /// Window W.
    pub window: f64,
    /// The mean count, for each σ.
    pub means: Vec<Estimate>,
    /// The mean count by the graph theory, for each σ, with p the chance of a gap between masses to have
    /// closed by itself when the window ends.
    pub graph: Vec<f64>,
    /// The σ at which it passes half of all gaps, if it does.
    pub half_height: Option<Estimate>,
}

/// Angles at which the reach of a gap is computed.
const ANGLES: usize = 256;

/// Shares by distance; a distance that no gap has counts for nothing.
pub fn shares<'a>(own: &'a [u64], of: &'a [u64]) -> impl Iterator<Item = f64> + 'a {
    own.iter().zip(of).map(|(own, all)| if *all > 0 { *own as f64 / *all as f64 } else { 0.0 })
}

/// For each σ the chances that a gap at a wall, and any other, closes by itself in each bin.
pub fn closing(parameters: &SeedsParams) -> Vec<[Vec<f64>; 2]> {
    let edges: Vec<f64> = (1..=parameters.bins).map(|bin| bin as f64 * parameters.bin).collect();
    let reaches = Reach::within(&parameters.chain, &edges, ANGLES);
    let by = |variance: f64| {
        let by = reaches.iter().map(|own| own.probability(parameters.chain.spacing, variance));
        let by: Vec<f64> = std::iter::once(0.0).chain(by).collect();
        by.windows(2).map(|pair| pair[1] - pair[0]).collect()
    };
    let of = |sigma: &f64| [1.0, 2.0].map(|forces| by(forces * sigma * sigma));
    parameters.sigmas.iter().map(of).collect()
}

/// The mean count of a chain by the graph theory.
pub fn circuits(chain: &Chain, p: f64) -> Result<f64, circuits::Error> {
    Ok(Law::new(SampleSpace::Simple, chain.gaps(), p)?.mean())
}

/// The predictions of all transients, from what was seen at each σ by some groups of runs.
pub fn predictions(
    parameters: &SeedsParams,
    closing: &[[Vec<f64>; 2]],
    seen: &[Vec<ByDistance>],
) -> Result<Vec<Prediction>, circuits::Error> {
    let groups = seen.first().map_or(0, Vec::len);
    let all: Vec<ByDistance> = seen.iter().map(|own| ByDistance::sum(own, groups)).collect();
    let without: Vec<Vec<ByDistance>> = (0..groups)
        .map(|left| seen.iter().map(|own| ByDistance::sum(own, left)).collect())
        .collect();
    let half = 0.5 * parameters.chain.gaps() as f64;
    let of = |transient: &usize| {
        let means = |seen: &Vec<ByDistance>| -> Vec<f64> {
            let both = closing.iter().zip(seen);
            both.map(|(own, seen)| expected(parameters, own, seen, *transient)).collect()
        };
        let value = means(&all);
        let others: Vec<Vec<f64>> = without.iter().map(means).collect();
        let at = |i: usize| {
            let others: Vec<f64> = others.iter().map(|means| means[i]).collect();
            left_out(value[i], &others)
        };
        let crossing = |means: &Vec<f64>| {
            let means: Vec<Option<f64>> = means.iter().copied().map(Some).collect();
            last_rise(&parameters.sigmas, &means, half)
        };
        let crossings =
            |out: Option<usize>| out.map_or_else(|| crossing(&value), |i| crossing(&others[i]));
        let graph = |[_, inner]: &[Vec<f64>; 2]| {
            let by_then = inner.iter().take(transient + parameters.window);
            circuits(&parameters.chain, by_then.sum())
        };
        Ok(Prediction {
            transient: *transient as f64 * parameters.bin,
            window: parameters.window as f64 * parameters.bin,
            half_height: jackknife(groups, crossings),
            means: (0..value.len()).filter_map(at).collect(),
            graph: closing.iter().map(graph).collect::<Result<_, _>>()?,
        })
    };
    parameters.transients.iter().map(of).collect()
}

/// The expected number of gaps with an impact in the window.
fn expected(
    parameters: &SeedsParams,
    [wall, inner]: &[Vec<f64>; 2],
    seen: &ByDistance,
    transient: usize,
) -> f64 {
    let (gaps, window) = (parameters.chain.gaps(), parameters.window);
    // The chance that a gap y sends an impact over a distance into the window.
    let sends = |closing: &[f64]| -> Vec<f64> {
        let mut all = vec![0.0; gaps];
        let mut add = |chance: f64, own: &[u64]| {
            for (sum, share) in all.iter_mut().zip(shares(own, &seen.places)) {
                *sum += 0.5 * chance * share;
            }
        };
        for (bin, chance) in closing.iter().enumerate().take(transient + window) {
            // Somewhere in the bin: half at its beginning, half at its end.
            for since in [bin, bin + 1] {
                if since <= transient {
                    add(*chance, &seen.active[transient - since]);
                } else {
                    add(*chance, &seen.reached[transient + window - since]);
                }
            }
        }
        all
    };
    let (wall, inner) = (sends(wall), sends(inner));
    let silent = |x: usize| {
        let from = |y: usize| {
            let at_wall = y == 0 || y + 1 == gaps;
            1.0 - if at_wall { wall[x.abs_diff(y)] } else { inner[x.abs_diff(y)] }
        };
        (0..gaps).map(from).fold(1.0, |product, factor| product * factor)
    };
    (0..gaps).map(|x| 1.0 - silent(x)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Profile;

    /// Three gaps and three bins, of which a window has one.
    fn parameters() -> SeedsParams {
        let mut parameters = SeedsParams::new(Profile::Quick);
        parameters.chain.masses = 2;
        (parameters.bins, parameters.window) = (3, 1);
        parameters
    }

    #[test]
    fn seeds_that_reach_nothing_else_are_counted_alone() {
        // Whoever closes is hit once in its bin and in the next, and so is nobody else.
        let seen = ByDistance {
            places: vec![4, 8, 4],
            reached: vec![vec![0, 0, 0], vec![4, 0, 0], vec![4, 0, 0], vec![4, 0, 0]],
            active: vec![vec![4, 0, 0], vec![4, 0, 0], vec![0, 0, 0]],
            alive: vec![4, 4, 0],
        };
        // Walls close in the first bin, the gap between in the second.
        let closing = [vec![0.5, 0.0, 0.0], vec![0.0, 0.25, 0.0]];
        // After one bin: those of the first bin, half of which start at its end; those of the
        // second, half of which start at the end of the window and are not yet seen.
        let found = expected(&parameters(), &closing, &seen, 1);
        assert!((found - (2.0 * 0.5 + 0.5 * 0.25)).abs() < 1e-15, "{found}");
    }

    #[test]
    fn a_seed_that_reaches_everything_fills_the_chain() {
        let full = |n: u64| vec![n; 3];
        let seen = ByDistance {
            places: full(5),
            reached: vec![full(5); 4],
            active: vec![full(5); 3],
            alive: full(5),
        };
        let closing = [vec![0.1, 0.0, 0.0], vec![0.2, 0.0, 0.0]];
        let found = expected(&parameters(), &closing, &seen, 2);
        assert!((found - 3.0 * (1.0 - 0.9 * 0.9 * 0.8)).abs() < 1e-12, "{found}");
    }
}
