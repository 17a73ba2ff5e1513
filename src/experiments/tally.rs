//! What realisations of one σ showed together: whole numbers only, so that tallies of parts join to
//! that of the whole, wherever the cuts are.

use super::{Error, Progress};
use crate::params::{Chain, Protocol};
use impact_chain::observe::{Observed, observe};
use impact_chain::{self, Engine, Scenario};
use impact_numerics::random::NormalPairs;
use serde::{Deserialize, Serialize};

/// How one realisation ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// It ran to T + W.
    Counted(Observed),
    /// It started with an overlapping gap.
    Rejected,
    /// The engine gave up, after what was observed.
    Failed(Observed, impact_chain::Error),
}

/// Runs realisation `index` of a chain at σ = `sigma` and observes it.
///
/// # Errors
/// [`Error::Interrupted`], or [`Error::Failed`] if the chain itself is not allowed. A start that
/// overlaps and an engine that gives up are outcomes, not errors.
pub fn realisation(
    chain: &Chain,
    protocol: Protocol,
    sigma: f64,
    key: (&str, u64, u64),
    progress: &Progress,
) -> Result<Outcome, Error> {
    progress.check()?;
    let (stream, seed, index) = key;
    let scenario = Scenario::draw(chain, sigma, &mut NormalPairs::new(stream, seed, index));
    let mut engine = match Engine::new(&scenario) {
        Ok(engine) => engine,
        Err(impact_chain::Error::Overlap { .. }) => return Ok(Outcome::Rejected),
        Err(source) => return Err(Error::failed("sweep", source)),
    };
    let Protocol { transient, window } = protocol;
    let stopped = || progress.stopped();
    let (observed, ended) = observe(&scenario, &mut engine, transient, transient + window, stopped);
    progress.check()?;
    Ok(match ended {
        Ok(()) => Outcome::Counted(observed),
        Err(error) => Outcome::Failed(observed, error),
    })
}

/// Realisations in their order.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Tally {
    /// Distinct gaps of each realisation; none if it did not run to the end.
    pub distinct: Vec<Option<u32>>,
    /// Impacts in the window of those that ran to the end: sum, and sum of squares.
    pub kept_impacts: [u64; 2],
    /// Masses hit in the window, likewise.
    pub kept_masses: [u64; 2],
    /// With an overlapping start.
    pub rejected: usize,
    /// Ended by the engine before T + W.
    pub failed: usize,
    /// What the engine said of the first of these.
    pub first_failure: Option<String>,
    /// All counts, of failed realisations too. Its `distinct`, `masses` and `window_impacts` stay 0.
    pub total: Observed,
}

impl Tally {
    /// Tallies that follow each other as one.
    pub fn joined(tallies: Vec<Tally>) -> Tally {
        let mut whole = Tally::default();
        for tally in tallies {
            whole.distinct.extend(tally.distinct);
            for i in 0..2 {
                whole.kept_impacts[i] += tally.kept_impacts[i];
                whole.kept_masses[i] += tally.kept_masses[i];
            }
            whole.rejected += tally.rejected;
            whole.failed += tally.failed;
            whole.first_failure = whole.first_failure.or(tally.first_failure);
            add(&mut whole.total, &tally.total);
        }
        whole
    }

    /// Whether it can be that of so many realisations of a chain with so many gaps.
    pub fn can_be(&self, realisations: usize, gaps: usize) -> bool {
        let ran = self.distinct.iter().flatten();
        let lost = self.rejected.checked_add(self.failed);
        self.distinct.len() == realisations
            && self.distinct.iter().flatten().all(|&k| k as usize <= gaps)
            && lost == Some(realisations - ran.count())
    }
}

impl<'a> FromIterator<&'a Outcome> for Tally {
    fn from_iter<I: IntoIterator<Item = &'a Outcome>>(outcomes: I) -> Self {
        let mut tally = Tally::default();
        for outcome in outcomes {
            tally.distinct.push(match outcome {
                Outcome::Counted(seen) => {
                    add(&mut tally.total, seen);
                    let powers = |x: u64| [x, x * x];
                    let (impacts, masses) =
                        (powers(seen.window_impacts), powers(seen.masses.into()));
                    for i in 0..2 {
                        tally.kept_impacts[i] += impacts[i];
                        tally.kept_masses[i] += masses[i];
                    }
                    Some(seen.distinct)
                }
                Outcome::Rejected => {
                    tally.rejected += 1;
                    None
                }
                Outcome::Failed(seen, error) => {
                    add(&mut tally.total, seen);
                    tally.failed += 1;
                    tally.first_failure.get_or_insert_with(|| error.to_string());
                    None
                }
            });
        }
        tally
    }
}

fn add(total: &mut Observed, seen: &Observed) {
    total.impacts += seen.impacts;
    total.adjacent_pairs += seen.adjacent_pairs;
    total.contact_phases += seen.contact_phases;
    total.near.iter_mut().zip(seen.near).for_each(|(sum, n)| *sum += n);
    total.slow.iter_mut().zip(seen.slow).for_each(|(sum, n)| *sum += n);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cut_anywhere_the_tally_is_the_same() {
        let seen = |distinct, impacts| Observed {
            distinct,
            masses: distinct + 1,
            impacts,
            window_impacts: impacts / 2,
            near: [impacts; 9],
            slow: [impacts / 3; 8],
            adjacent_pairs: impacts / 5,
            contact_phases: 1,
        };
        let error = |gap| impact_chain::Error::Work { gap, time: 1.5, bound: 7 };
        let outcomes = [
            Outcome::Counted(seen(4, 40)),
            Outcome::Rejected,
            Outcome::Failed(seen(2, 9), error(3)),
            Outcome::Counted(seen(0, 0)),
            Outcome::Failed(seen(1, 5), error(8)),
            Outcome::Counted(seen(7, 70)),
        ];
        let whole: Tally = outcomes.iter().collect();
        assert_eq!(whole.distinct, [Some(4), None, None, Some(0), None, Some(7)]);
        assert_eq!((whole.kept_impacts, whole.total.impacts), ([55, 20 * 20 + 35 * 35], 124));
        assert_eq!(whole.kept_masses, [5 + 1 + 8, 25 + 1 + 64]);
        assert_eq!((whole.rejected, whole.failed), (1, 2));
        assert_eq!(whole.first_failure, Some(error(3).to_string()));
        for first in 0..=outcomes.len() {
            for second in first..=outcomes.len() {
                let pieces = [&outcomes[..first], &outcomes[first..second], &outcomes[second..]];
                let tallies = pieces.map(|piece| piece.iter().collect::<Tally>());
                assert!(tallies.iter().zip(pieces).all(|(t, piece)| t.can_be(piece.len(), 7)));
                assert_eq!(Tally::joined(tallies.to_vec()), whole, "{first} {second}");
            }
        }
        assert!(!whole.can_be(5, 7) && !whole.can_be(6, 6));
        assert!(!Tally { rejected: usize::MAX, ..whole }.can_be(6, 7));
    }
}
