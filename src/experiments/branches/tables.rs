//! Half heights and shares on both branches, and their differences chain by chain.
//!
//! Chains are independent of each other, and nothing else is: the same chain at another σ, after
//! another transient or on the other branch has the same forces. So every error is that of leaving
//! out whole chains in turn (the jackknife, which gives the usual standard error of a mean), and a
//! difference is taken before its error is. Intervals have the quantiles of Student's t for the
//! number of chains.

use super::run::Chains;
use crate::experiments::half_height::HALF_HEIGHT;
use crate::experiments::prelude::*;
use impact_numerics::estimates::{LEVEL, jackknife};
use impact_numerics::statistics::{last_rise, mean, slope, student_quantile};

/// Shares of active gaps on one branch after one transient.
#[derive(Clone, Debug, Default)]
struct Branch {
    /// The σ that were run so long, rising.
    sigmas: Vec<f64>,
    /// For each of them the share in each chain; none if its run was not complete.
    shares: Vec<Vec<Option<f64>>>,
}

impl Branch {
    /// Collects the shares of chains of one length, with or without heating.
    fn new(found: &[Chains], masses: usize, heated: bool, transient: f64) -> Branch {
        let mut rows = Vec::new();
        for Chains { ensemble, counts } in found {
            let window = ensemble.protocols.iter().position(|one| one.transient == transient);
            let same = ensemble.chain.masses == masses && ensemble.heating.is_some() == heated;
            let Some(window) = window.filter(|_| same) else { continue };
            let gaps = ensemble.chain.gaps() as f64;
            for (sigma, counts) in ensemble.sigmas.iter().zip(counts) {
                let share = |count: &Option<u32>| count.map(|count| f64::from(count) / gaps);
                rows.push((*sigma, counts[window].iter().map(share).collect()));
            }
        }
        rows.sort_by(|a: &(f64, Vec<_>), b| a.0.total_cmp(&b.0));
        let (sigmas, shares) = rows.into_iter().unzip();
        Branch { sigmas, shares }
    }

    fn chains(&self) -> usize {
        self.shares.iter().map(Vec::len).min().unwrap_or(0)
    }

    /// Mean share at a σ over all chains but one; none where no chain was run.
    fn share(&self, sigma: f64, without: Option<usize>) -> Option<f64> {
        let place = self.sigmas.iter().position(|at| *at == sigma)?;
        let chains = self.shares[place].iter().enumerate();
        let used = chains.filter(|(chain, _)| Some(*chain) != without);
        mean(&used.filter_map(|(_, share)| *share).collect::<Vec<_>>())
    }

    /// Half height of the mean over all chains but one.
    fn half_height(&self, without: Option<usize>) -> Option<f64> {
        let shares: Vec<Option<f64>> =
            self.sigmas.iter().map(|sigma| self.share(*sigma, without)).collect();
        last_rise(&self.sigmas, &shares, 0.5)
    }
}

/// Both branches of chains of one length after one transient.
struct Pair {
    masses: usize,
    transient: f64,
    rest: Branch,
    above: Branch,
}

impl Pair {
    /// Number of chains on each branch.
    fn chains(&self) -> usize {
        self.rest.chains().min(self.above.chains())
    }

    /// By how much the half height from rest lies above that from above, over all chains but one.
    fn distance(&self, without: Option<usize>) -> Option<f64> {
        Some(self.rest.half_height(without)? - self.above.half_height(without)?)
    }

    /// By how much the share from above exceeds that from rest at a σ, over all chains but one.
    fn excess(&self, sigma: f64, without: Option<usize>) -> Option<f64> {
        Some(self.above.share(sigma, without)? - self.rest.share(sigma, without)?)
    }
}

/// A pair with the pair of the same chains after the transient before it, if there is one.
type Step<'a> = (&'a Pair, Option<&'a Pair>);

/// All pairs, by length and transient.
fn pairs(found: &[Chains]) -> Vec<Pair> {
    let mut keys: Vec<(usize, f64)> = Vec::new();
    for Chains { ensemble, .. } in found {
        let masses = ensemble.chain.masses;
        keys.extend(ensemble.protocols.iter().map(|window| (masses, window.transient)));
    }
    keys.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    keys.dedup();
    let pair = |(masses, transient): (usize, f64)| Pair {
        masses,
        transient,
        rest: Branch::new(found, masses, false, transient),
        above: Branch::new(found, masses, true, transient),
    };
    keys.into_iter().map(pair).collect()
}

/// Makes the tables of both branches.
pub fn tables(found: &Vec<Chains>) -> Vec<Table> {
    let pairs = pairs(found);
    let before = |place: usize| place.checked_sub(1).map(|place| &pairs[place]);
    let steps: Vec<Step<'_>> = (0..pairs.len())
        .map(|place| {
            let pair = &pairs[place];
            (pair, before(place).filter(|before| before.masses == pair.masses))
        })
        .collect();
    vec![
        half_heights(&steps),
        laws(&pairs),
        lengths(&pairs),
        late(&pairs),
        fixed(&pairs),
        shares(&pairs),
        all(found, &pairs),
    ]
}

/// The change of a quantity of the same chains from one transient to another.
fn change(
    before: &Pair,
    after: &Pair,
    quantity: impl Fn(&Pair, Option<usize>) -> Option<f64>,
) -> Option<Estimate> {
    jackknife(after.chains(), |without| {
        Some(quantity(after, without)? - quantity(before, without)?)
    })
}

fn half_heights(steps: &[Step<'_>]) -> Table {
    const LATER: &str = "the same less that after the transient before";
    Table::of("branches.half_heights", steps, |(pair, _)| pair.chains())
        .key("masses", "1", |(pair, _)| pair.masses as f64)
        .key("transient", TIME, |(pair, _)| pair.transient)
        .computed_by(origin(Branch::half_height))
        .estimate("from_rest", SIGMA, HALF_HEIGHT, |(pair, _)| {
            jackknife(pair.chains(), |without| pair.rest.half_height(without))
        })
        .estimate("from_above", SIGMA, HALF_HEIGHT, |(pair, _)| {
            jackknife(pair.chains(), |without| pair.above.half_height(without))
        })
        .computed_by(origin(Pair::distance))
        .estimate("distance", SIGMA, "half height from rest less that from above", |(pair, _)| {
            jackknife(pair.chains(), |without| pair.distance(without))
        })
        .estimate("change_of_distance", SIGMA, LATER, |(pair, before)| {
            change((*before)?, pair, Pair::distance)
        })
        .done()
}

/// The exponent of a power law of T through the distances of some pairs, over all chains but one,
/// by least squares in logarithms. None if a distance is not positive.
fn exponent(pairs: &[Pair], without: Option<usize>) -> Option<f64> {
    let mut points = Vec::new();
    for pair in pairs {
        let distance = pair.distance(without).filter(|distance| *distance > 0.0)?;
        points.push((pxfm::f_log(pair.transient), pxfm::f_log(distance)));
    }
    slope(&points)
}

/// The interval of an estimate from independent chains, with Student's t.
fn interval(estimate: Option<Estimate>, chains: usize) -> Option<[f64; 2]> {
    let quantile = student_quantile(LEVEL, chains.saturating_sub(1))?;
    let Estimate { value, error, .. } = estimate?;
    Some([value - quantile * error, value + quantile * error])
}

/// How the distance falls with T, as a power law over the first two transients and over the last
/// three.
fn laws(pairs: &[Pair]) -> Table {
    let lengths: Vec<&[Pair]> = pairs.chunk_by(|a, b| a.masses == b.masses).collect();
    let early = |pairs: &[Pair], without| exponent(&pairs[..pairs.len().min(2)], without);
    let late = |pairs: &[Pair], without| exponent(&pairs[pairs.len().saturating_sub(3)..], without);
    let end = |pairs: &[Pair], end: usize| {
        let chains = pairs[0].chains();
        Some(interval(jackknife(chains, |without| late(pairs, without)), chains)?[end])
    };
    const LAW: &str = "d ln(distance)/d ln T by least squares over the last three transients";
    Table::of("branches.laws", &lengths, |pairs| pairs[0].chains())
        .key("masses", "1", |pairs| pairs[0].masses as f64)
        .chosen("until", TIME, "the second transient", |pairs| Some(pairs.get(1)?.transient))
        .chosen("since", TIME, "the third last transient", |pairs| {
            Some(pairs[pairs.len().saturating_sub(3)].transient)
        })
        .computed_by(origin(exponent))
        .estimate("exponent", "1", LAW, |pairs| {
            jackknife(pairs[0].chains(), |without| late(pairs, without))
        })
        .real("exponent_from", "1", 2, "lower end of its interval", |pairs| end(pairs, 0))
        .real("exponent_to", "1", 2, "upper end of its interval", |pairs| end(pairs, 1))
        .estimate("early", "1", "the same over the first two transients", |pairs| {
            jackknife(pairs[0].chains(), |without| early(pairs, without))
        })
        .estimate("change", "1", "the exponent less the early one", |pairs| {
            jackknife(pairs[0].chains(), |without| {
                Some(late(pairs, without)? - early(pairs, without)?)
            })
        })
        .done()
}

/// Half heights and distances of the shorter chains less those of the longer ones, which begin with
/// the same forces.
fn lengths(pairs: &[Pair]) -> Table {
    let lengths: Vec<&[Pair]> = pairs.chunk_by(|a, b| a.masses == b.masses).collect();
    let rows: Vec<(&Pair, &Pair)> = match lengths[..] {
        [short, long] => short.iter().zip(long).collect(),
        _ => Vec::new(),
    };
    let less = |(short, long): &(&Pair, &Pair), of: fn(&Pair, Option<usize>) -> Option<f64>| {
        let chains = short.chains().min(long.chains());
        jackknife(chains, |without| Some(of(short, without)? - of(long, without)?))
    };
    const LESS: &str = "that of the shorter chains less that of the longer ones";
    Table::of("branches.lengths", &rows, |(short, long)| short.chains().min(long.chains()))
        .key("transient", TIME, |(short, _)| short.transient)
        .computed_by(origin(Branch::half_height))
        .estimate("from_rest", SIGMA, LESS, |row| less(row, |pair, o| pair.rest.half_height(o)))
        .estimate("from_above", SIGMA, LESS, |row| less(row, |pair, o| pair.above.half_height(o)))
        .estimate("distance", SIGMA, LESS, |row| less(row, Pair::distance))
        .done()
}

/// Changes of half heights from the third last transient to the last.
fn late(pairs: &[Pair]) -> Table {
    let lengths: Vec<&[Pair]> = pairs.chunk_by(|a, b| a.masses == b.masses).collect();
    let ends = |pairs: &'_ [Pair]| [pairs.len().saturating_sub(3), pairs.len() - 1];
    let since = |pairs: &[Pair], of: fn(&Pair, Option<usize>) -> Option<f64>| {
        let [before, after] = ends(pairs);
        change(&pairs[before], &pairs[after], of)
    };
    const SINCE: &str = "half height at last less that at the earlier time";
    Table::of("branches.late", &lengths, |pairs| pairs[0].chains())
        .key("masses", "1", |pairs| pairs[0].masses as f64)
        .chosen("since", TIME, "the earlier time", |pairs| Some(pairs[ends(pairs)[0]].transient))
        .computed_by(origin(Branch::half_height))
        .estimate("from_rest", SIGMA, SINCE, |pairs| {
            since(pairs, |pair, o| pair.rest.half_height(o))
        })
        .estimate("from_above", SIGMA, SINCE, |pairs| {
            since(pairs, |pair, o| pair.above.half_height(o))
        })
        .done()
}

/// Shares at the largest σ that both branches have after every transient.
fn fixed(pairs: &[Pair]) -> Table {
    let mut rows: Vec<(&[Pair], f64)> = Vec::new();
    for pairs in pairs.chunk_by(|a, b| a.masses == b.masses) {
        let everywhere = |sigma: &f64| {
            pairs.iter().all(|at| at.rest.sigmas.contains(sigma) && at.above.sigmas.contains(sigma))
        };
        let sigmas = pairs[0].rest.sigmas.iter().copied();
        rows.extend(sigmas.rev().find(everywhere).map(|sigma| (pairs, sigma)));
    }
    let above = |sigma: f64| move |pair: &Pair, o: Option<usize>| pair.above.share(sigma, o);
    let excess = |at: &Pair, sigma: f64| jackknife(at.chains(), |o| at.excess(sigma, o));
    let changed = |pairs: &[Pair], from: usize, sigma: f64| {
        change(&pairs[from], &pairs[pairs.len() - 1], above(sigma))
    };
    const ABOVE: &str = "share from above at last less that at the first time";
    const LATE: &str = "the same since the third last time";
    Table::of("branches.fixed", &rows, |(pairs, _)| pairs[0].chains())
        .key("masses", "1", |(pairs, _)| pairs[0].masses as f64)
        .chosen("sigma", SIGMA, "standard deviation σ", |(_, sigma)| Some(*sigma))
        .computed_by(origin(Branch::share))
        .estimate("fall", "1", ABOVE, |(pairs, sigma)| changed(pairs, 0, *sigma))
        .estimate("late_fall", "1", LATE, |(pairs, sigma)| {
            changed(pairs, pairs.len().saturating_sub(3), *sigma)
        })
        .computed_by(origin(Pair::excess))
        .estimate("excess", "1", "share from above less that from rest, at first", |row| {
            excess(&row.0[0], row.1)
        })
        .estimate("late_excess", "1", "the same at last", |row| {
            excess(&row.0[row.0.len() - 1], row.1)
        })
        .done()
}

/// At every σ that was run on a branch.
fn shares(pairs: &[Pair]) -> Table {
    let mut rows: Vec<(&Pair, f64)> = Vec::new();
    for pair in pairs {
        let (rest, above) = (&pair.rest.sigmas, &pair.above.sigmas);
        let mut sigmas = [rest.as_slice(), above.as_slice()].concat();
        sigmas.sort_by(f64::total_cmp);
        sigmas.dedup();
        rows.extend(sigmas.into_iter().map(|sigma| (pair, sigma)));
    }
    const SHARE: &str = "share of all gaps with an impact";
    Table::of("branches.shares", &rows, |(pair, _)| pair.chains())
        .key("masses", "1", |(pair, _)| pair.masses as f64)
        .key("transient", TIME, |(pair, _)| pair.transient)
        .key("sigma", SIGMA, |(_, sigma)| *sigma)
        .computed_by(origin(Branch::share))
        .estimate("from_rest", "1", SHARE, |(pair, sigma)| {
            jackknife(pair.chains(), |without| pair.rest.share(*sigma, without))
        })
        .estimate("from_above", "1", SHARE, |(pair, sigma)| {
            jackknife(pair.chains(), |without| pair.above.share(*sigma, without))
        })
        .computed_by(origin(Pair::excess))
        .estimate("excess", "1", "share from above less that from rest", |(pair, sigma)| {
            jackknife(pair.chains(), |without| pair.excess(*sigma, without))
        })
        .done()
}

fn all(found: &[Chains], pairs: &[Pair]) -> Table {
    let heated = found.iter().find_map(|one| one.ensemble.heating);
    Table::of("branches.all", &[()], |()| 0)
        .count("chains", "chains of each length on each branch", |()| {
            pairs.iter().map(Pair::chains).min().unwrap_or(0) as u64
        })
        .chosen("hot", SIGMA, "σ of the force at first", |()| heated.map(|hot| hot.sigma))
        .chosen("heating", TIME, "time under that force", |()| heated.map(|hot| hot.time))
        .done()
}

#[cfg(test)]
mod tests {
    use super::*;

    const CHAINS: usize = 12;

    /// Chains whose share rises from 0 to 1 over an interval of σ around a place of each chain.
    fn made_up(places: &[f64]) -> Branch {
        let sigmas = vec![0.0, 1.0];
        let at = |sigma: f64| places.iter().map(|place| Some(0.5 + sigma - place)).collect();
        Branch { shares: sigmas.iter().map(|sigma| at(*sigma)).collect(), sigmas }
    }

    fn pair(transient: f64, rest: &[f64], above: &[f64]) -> Pair {
        Pair { masses: 1, transient, rest: made_up(rest), above: made_up(above) }
    }

    /// Places of chains on both branches: a part that both share, with a standard deviation of
    /// 0.06, and parts of each branch, with 0.03 and 0.04. The distance of the half heights then
    /// has the error 0.05/√12.
    fn drawn(index: u64) -> [Vec<f64>; 2] {
        let mut normals = NormalPairs::new("test of branches", 1, index);
        let mut places = [Vec::new(), Vec::new()];
        for _ in 0..CHAINS {
            let ([both, _], [rest, above]) = (normals.pair(), normals.pair());
            places[0].push(0.6 + 0.06 * both + 0.03 * rest);
            places[1].push(0.4 + 0.06 * both + 0.04 * above);
        }
        places
    }

    #[test]
    fn the_error_of_a_distance_is_the_known_one() {
        let (mut squares, mut inside) = (0.0, 0);
        const SAMPLES: u64 = 4000;
        for index in 0..SAMPLES {
            let [rest, above] = drawn(index);
            let pair = pair(500.0, &rest, &above);
            let found = jackknife(pair.chains(), |without| pair.distance(without)).unwrap();
            squares += found.error * found.error / SAMPLES as f64;
            let [from, to] = interval(Some(found), CHAINS).unwrap();
            inside += u64::from((from..to).contains(&0.2));
        }
        // 4000 mean squares with 11 degrees of freedom: known to √(2/11/4000) = 0.7 %. Resampling
        // with replacement would give 11/12 of it, errors combined as if branches were independent
        // nearly four times as much.
        let known = 0.05 * 0.05 / CHAINS as f64;
        assert!((squares / known - 1.0).abs() < 0.03, "{}", squares / known);
        // 95 % to √(0.95 · 0.05/4000) = 0.34 %.
        let share = inside as f64 / SAMPLES as f64;
        assert!((share - LEVEL).abs() < 0.014, "{share}");
    }

    #[test]
    fn a_power_law_by_hand() {
        let distance = |time: f64| 0.4 / time.sqrt();
        let times = [1.0, 4.0, 25.0];
        let at = |time: &f64| pair(*time, &[0.5 + distance(*time); 3], &[0.5; 3]);
        let pairs: Vec<Pair> = times.iter().map(at).collect();
        assert!((exponent(&pairs, None).unwrap() + 0.5).abs() < 1e-12);
        assert_eq!(exponent(&[at(&1.0), pair(9.0, &[0.4; 3], &[0.5; 3])], None), None);
    }

    #[test]
    fn changes_are_taken_chain_by_chain() {
        // Chains differ much, and all change by the same.
        let (first, later) = ([0.1, 0.5, 0.9], [0.2, 0.6, 1.0]);
        let (first, later) = (pair(1.0, &first, &first), pair(2.0, &later, &first));
        let found = change(&first, &later, |pair, without| pair.rest.half_height(without)).unwrap();
        assert!((found.value - 0.1).abs() < 1e-12 && found.error < 1e-12, "{found:?}");
    }
}
