//! The units of work of all experiments, shared out to machines that save what they give in one store.

use super::cutting::Unit;
use super::{Error, Need, Session};
use std::cmp::Reverse;

/// Into so many shards a profile may be divided; more would have nothing to do.
pub const MOST: usize = 100_000;

/// The shard of each unit, from 1: the heaviest unit first, always to the shard with the least
/// work so far, of several to the first.
fn shared_out(weights: &[u64], of: usize) -> Vec<usize> {
    let mut order: Vec<usize> = (0..weights.len()).collect();
    order.sort_by_key(|&unit| Reverse(weights[unit]));
    let (mut loads, mut shards) = (vec![0_u64; of], vec![1; weights.len()]);
    for unit in order {
        let shard = (0..of).min_by_key(|&shard| loads[shard]).unwrap_or(0);
        // A unit without weight takes its turn too.
        loads[shard] = loads[shard].saturating_add(weights[unit].max(1));
        shards[unit] = shard + 1;
    }
    shards
}

/// Runs the units of one shard that are not in the store. Returns how many were run, and how many were there.
pub fn run(
    experiments: &[Need],
    (shard, of): (usize, usize),
    session: &Session<'_>,
) -> Result<[usize; 2], Error> {
    let units = experiments.iter().map(|experiment| experiment.units(session.profile));
    let units: Vec<Vec<Unit>> = units.collect();
    let weights: Vec<u64> = units.iter().flatten().map(|unit| unit.weight).collect();
    let mut shards = shared_out(&weights, of).into_iter();
    let [mut run, mut all] = [0, 0];
    for (experiment, units) in experiments.iter().zip(units) {
        session.progress.check()?;
        let own: Vec<Unit> = units.into_iter().filter(|_| shards.next() == Some(shard)).collect();
        if !own.is_empty() {
            all += own.len();
            run += experiment.run_units(&own, session)?;
        }
    }
    Ok([run, all - run])
}

#[cfg(test)]
mod tests {
    use super::shared_out;

    #[test]
    fn work_is_shared_evenly() {
        let weights: Vec<u64> = (0..200).map(|i| 1_000_000 / (1 + i * i % 37)).collect();
        let (whole, heaviest) = (weights.iter().sum::<u64>(), 1_000_000);
        for of in [1, 3, 7] {
            let mut loads = vec![0; of];
            for (weight, shard) in weights.iter().zip(shared_out(&weights, of)) {
                loads[shard - 1] += weight;
            }
            let even = whole / of as u64;
            assert!(loads.iter().all(|load| load.abs_diff(even) <= heaviest), "{loads:?}");
        }
        // So many shards have one unit each.
        let mut alone = shared_out(&[0; 50], 50);
        alone.sort_unstable();
        assert_eq!(alone, (1..=50).collect::<Vec<_>>());
    }
}
