//! What becomes of one seed as time goes on.

use super::counting::{bits, ran};
use super::run::Trace;
use super::{ByDistance, growth};
use crate::experiments::estimates::average_count;
use crate::numerics::statistics::Estimate;
use crate::params::SeedsParams;
use serde::{Deserialize, Serialize};

/// How things stand when a window ends.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Moment {
    /// That time, since the first impact.
    pub until: f64,
    /// Mean number of gaps that were hit by then.
    pub reached: Option<Estimate>,
    /// Mean number of gaps that were hit in the window.
    pub active: Option<Estimate>,
    /// Runs with an impact in the window.
    pub alive: u64,
    /// The root mean square distance of the gaps that were reached from the seed.
    pub radius: f64,
}

/// The ends of the windows after each transient.
pub(crate) fn course(
    parameters: &SeedsParams,
    traces: &[Option<Trace>],
    seen: &ByDistance,
) -> Vec<Moment> {
    let moment = |&transient: &usize| {
        let end = transient + parameters.window;
        let hit = |mask: u64| {
            let of = |(_, trace): (usize, &Trace)| {
                trace.hits.iter().filter(|own| **own & mask != 0).count() as u64
            };
            average_count(&ran(traces).map(of).collect::<Vec<_>>())
        };
        Moment {
            until: end as f64 * parameters.bin,
            reached: hit(bits(0, end)),
            active: hit(bits(transient, parameters.window)),
            alive: seen.alive[transient],
            radius: radius(seen, end),
        }
    };
    parameters.transients.iter().map(moment).collect()
}

/// The root mean square distance of what was reached by the end of a bin, were all places far from walls.
pub(super) fn radius(seen: &ByDistance, end: usize) -> f64 {
    let shares: Vec<f64> = growth::shares(&seen.reached[end], &seen.places).collect();
    let squares = |power: i32| -> f64 {
        let weight = |l: usize| if power == 0 { 1.0 } else { (l * l) as f64 };
        shares.iter().enumerate().skip(1).map(|(l, share)| weight(l) * share).sum()
    };
    (squares(2) / squares(0).max(f64::MIN_POSITIVE)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Profile;

    #[test]
    fn moments_of_two_runs_by_hand() {
        let mut parameters = SeedsParams::new(Profile::Quick);
        parameters.chain.masses = 2;
        (parameters.bins, parameters.window, parameters.transients) = (4, 2, vec![0, 2]);
        // The seed is hit in the first bin, a neighbour of it in the second and the fourth.
        let run = |hits: [u64; 3]| Trace { seed: Some(1), hits: hits.to_vec(), ..Trace::default() };
        let traces = [Some(run([0, 0b0001, 0b1010])), None, Some(run([0b0010, 0b0001, 0b0010]))];
        let seen = ByDistance {
            places: vec![2, 4, 0],
            reached: vec![vec![0; 3], vec![2, 0, 0], vec![2, 3, 0], vec![2, 3, 0], vec![2, 3, 0]],
            active: Vec::new(),
            alive: vec![2, 2, 1],
        };
        let found = course(&parameters, &traces, &seen);
        let values = found.iter().map(|own| {
            (own.until, own.reached.unwrap().value, own.active.unwrap().value, own.alive)
        });
        assert_eq!(values.collect::<Vec<_>>(), [(50.0, 2.5, 2.5, 2), (100.0, 2.5, 0.5, 1)]);
        assert_eq!(found[1].radius, 1.0);
        // As many at twice the distance: the mean of one and four.
        let far = ByDistance { places: vec![1, 2, 2], reached: vec![vec![1, 1, 1]], ..seen };
        assert_eq!(radius(&far, 0), 2.5_f64.sqrt());
    }
}
