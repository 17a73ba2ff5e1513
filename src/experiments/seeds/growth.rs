//! Predicts the mean count by nucleation and growth: from the derived chances of single gaps and
//! the measured spreading from one of them alone.
//!
//! A gap at the place x has no impact in the window (T, T + W] if no seed y sends one there. If
//! seeds are independent and each spreads as if alone, the probability is
//!
//! ∏_y (1 − ∫_0^T B(|x − y|, T − s) dp_y(s) − ∫_T^{T+W} R(|x − y|, T + W − s) dp_y(s)),
//!
//! with p_y(s) the probability that the gap y closes by itself by the time s, B(l, t) the share of
//! gaps at distance l that are hit in a window W which begins a time t after the first impact of a
//! seed, and R(l, t) the share that is hit within t.

use super::counting::{ByDistance, Part};
use crate::experiments::prelude::*;
use impact_circuits::nucleation::{ANGLES, Chances, PAIR_ANGLES, Reach};

/// Groups of runs, each of which is left out in turn for the error of their sum.
pub(super) const GROUPS: usize = 8;

/// Counts by distance at each σ, without each group of runs in turn, and last of all of them.
pub(super) fn sums(parameters: &SeedsParams, rows: &[Part]) -> Vec<Vec<ByDistance>> {
    let group = |part: &Part| {
        let begin = |group: usize| group * part.len() / GROUPS;
        let group = |group| ByDistance::count(parameters, &part[begin(group)..begin(group + 1)]);
        ByDistance::sums(&(0..GROUPS).map(group).collect::<Vec<_>>())
    };
    rows.par_iter().map(group).collect()
}

/// Mean counts after one transient.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Prediction {
    pub transient: usize,
    /// Without each group in turn, and last with all of them, for each σ: if all gaps that close by
    /// themselves are seeds, and if only the first of each clump is.
    means: Vec<Vec<[f64; 2]>>,
}

impl Prediction {
    /// Estimates the mean count at the σ with this index.
    pub fn mean(&self, sigma: usize) -> Option<Estimate> {
        jackknife(GROUPS, |left_out| Some(self.means[left_out.unwrap_or(GROUPS)][sigma][0]))
    }

    /// Estimates the σ at which one of the two means (`which`: 0 or 1) passes half of all gaps.
    pub fn half_height(&self, parameters: &SeedsParams, which: usize) -> Option<Estimate> {
        let half = 0.5 * parameters.chain.gaps() as f64;
        jackknife(GROUPS, |left_out| {
            let means = self.means[left_out.unwrap_or(GROUPS)].iter().map(|both| Some(both[which]));
            last_rise(&parameters.sigmas, &means.collect::<Vec<_>>(), half)
        })
    }
}

/// Returns for each σ the chances that a gap closes by itself in each bin of time: a gap at a wall,
/// any other, and the first gap of a clump.
fn closing(parameters: &SeedsParams) -> Vec<[Vec<f64>; 3]> {
    let chain = &parameters.chain;
    let edges: Vec<f64> = (1..=parameters.bins).map(|bin| bin as f64 * parameters.bin).collect();
    let reaches = Reach::within_times(chain, &edges, ANGLES);
    let ever = Reach::in_unlimited_time(chain, PAIR_ANGLES);
    let in_each_bin = |variance: f64, share: f64| -> Vec<f64> {
        let mut by_then = vec![0.0];
        by_then
            .extend(reaches.iter().map(|reach| share * reach.probability(chain.spacing, variance)));
        by_then.windows(2).map(|w| w[1] - w[0]).collect()
    };
    let at_sigma = |sigma: &f64| {
        let chances = Chances::new(chain, &ever, *sigma);
        // The share of closing gaps whose left neighbour stays open.
        let share = 1.0 - chances.pair / chances.p;
        let variance = sigma * sigma;
        [(1.0, 1.0), (2.0, 1.0), (2.0, share)]
            .map(|(times, share)| in_each_bin(times * variance, share))
    };
    parameters.sigmas.par_iter().map(at_sigma).collect()
}

/// Returns the predictions of all transients, from the sums of groups of runs at each σ.
pub(super) fn predictions(parameters: &SeedsParams, sums: &[Vec<ByDistance>]) -> Vec<Prediction> {
    let closing = closing(parameters);
    let prediction = |&transient: &usize| {
        let means = |left_out: usize| {
            let both = closing.iter().zip(sums);
            both.map(|(closing, seen)| expected(parameters, closing, &seen[left_out], transient))
                .collect()
        };
        Prediction { transient, means: (0..=GROUPS).into_par_iter().map(means).collect() }
    };
    parameters.transients.iter().map(prediction).collect()
}

/// Returns the expected number of gaps with an impact in the window, if all gaps that close are
/// seeds and if only the first of each clump is, from the chances that [`closing`] gives.
fn expected(
    parameters: &SeedsParams,
    closing: &[Vec<f64>; 3],
    seen: &ByDistance,
    transient: usize,
) -> [f64; 2] {
    let (gaps, window) = (parameters.chain.gaps(), parameters.window);
    // The chance that such a gap y sends an impact over a distance into the window.
    let mut sends = vec![[0.0; 3]; gaps];
    for bin in 0..parameters.bins.min(transient + window) {
        // Somewhere in the bin: half at its beginning, half at its end.
        let half = closing.each_ref().map(|chances| 0.5 * chances[bin]);
        for since in [bin, bin + 1] {
            let hit = match transient.checked_sub(since) {
                Some(start) => &seen.active[start],
                None => &seen.reached[transient + window - since],
            };
            for ([wall, inner, first], share) in sends.iter_mut().zip(seen.shares(hit)) {
                *wall += half[0] * share;
                *inner += half[1] * share;
                *first += half[2] * share;
            }
        }
    }
    [1, 2].map(|inner| {
        // To one side of a gap: no impact from so many gaps in a row, the last of them at a wall.
        let (mut side, mut all_inner) = (vec![1.0], 1.0);
        for sends in &sends[1..] {
            side.push(all_inner * (1.0 - sends[0]));
            all_inner *= 1.0 - sends[inner];
        }
        let silent = |x: usize| {
            let own = sends[0][if x == 0 || x + 1 == gaps { 0 } else { inner }];
            side[x] * (1.0 - own) * side[gaps - 1 - x]
        };
        (0..gaps).fold(0.0, |mean, x| mean + (1.0 - silent(x)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against the formula of this module evaluated by logarithms, with walls as corrections.
    #[test]
    fn the_mean_count_by_logarithms() {
        let mut parameters = SeedsParams::new(Profile::Quick);
        parameters.chain.masses = 8;
        (parameters.bins, parameters.window, parameters.sigmas) = (4, 2, vec![0.12]);
        let gaps = parameters.chain.gaps();
        let fall = |scale: u64| (0..9).map(|l| scale * (9 - l) / 9).collect::<Vec<u64>>();
        let seen = ByDistance {
            places: vec![40, 70, 60, 50, 40, 30, 20, 10, 5],
            reached: [0, 10, 9, 8, 9].map(fall).into(),
            active: [7, 6, 5].map(fall).into(),
        };
        let [wall, inner] = [vec![0.02, 0.01, 0.0, 0.01], vec![0.05, 0.02, 0.01, 0.03]];
        let closing = [wall, inner.clone(), inner];
        let (transient, window) = (1, 2);
        let logs = closing.each_ref().map(|closing| -> Vec<f64> {
            let sends = |l: usize| {
                let hit = |since: usize| {
                    if transient >= since {
                        seen.active[transient - since][l]
                    } else {
                        seen.reached[transient + window - since][l]
                    }
                };
                let bins = closing.iter().enumerate().take(transient + window);
                let hits: f64 = bins.map(|(bin, p)| p * (hit(bin) + hit(bin + 1)) as f64).sum();
                hits / (2.0 * seen.places[l] as f64)
            };
            (0..gaps).map(|l| pxfm::f_log1p(-sends(l))).collect()
        });
        let silent = |x: usize| {
            let inner: f64 = (0..gaps).map(|y| logs[1][x.abs_diff(y)]).sum();
            let wall = |l: usize| logs[0][l] - logs[1][l];
            pxfm::f_exp(inner + wall(x) + wall(gaps - 1 - x))
        };
        let mean = gaps as f64 - (0..gaps).map(silent).sum::<f64>();
        for count in expected(&parameters, &closing, &seen, transient) {
            assert!((count - mean).abs() < 1e-12 && mean > 0.5, "{count} {mean}");
        }
    }
}
