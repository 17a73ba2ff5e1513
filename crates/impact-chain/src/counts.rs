//! Counts the impacts of an ensemble at one σ: different gaps with an impact in each window, close
//! and slow impacts. All counts are whole numbers that add. This code runs at every impact, so it
//! is compiled for speed with the engine.

use crate::ensemble::{Ensemble, Protocol};
use crate::search::outcome::{Counters, Graze};
use crate::topology::Topology;
use crate::{Boundary, Engine, Error, Impact};
use serde::{Deserialize, Serialize};

/// The δ below which two impacts of adjacent gaps are counted as close, in units of 1/ω.
pub const NEAR_DECADES: [f64; 9] = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9];

/// The v below which a closing speed is counted as slow, in units of d ω.
pub const SLOW_DECADES: [f64; 8] = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8];

/// Impacts after which a run checks again whether to stop.
const CHECK_EVERY: u64 = 4096;

/// The counts of realisations in their order, for each window of the ensemble. Counts of
/// realisations that follow one another are joined by collecting them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Counts {
    /// Different gaps with an impact in each window, of each piece of each realisation; none if it
    /// did not run to the end of the window, or the engine ended it early.
    pub distinct: Vec<Vec<Option<u32>>>,
    /// Impacts in each window, of each realisation.
    pub impacts: Vec<Vec<u64>>,
    /// Masses that are hit in each window, of each realisation.
    pub masses: Vec<Vec<u32>>,
    /// Realisations with an overlapping start.
    pub rejected: usize,
    /// Realisations that the engine ended early.
    pub failed: usize,
    /// Impacts of whole runs, failed realisations included.
    pub total: Total,
}

/// Impacts of whole runs, transients included.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Total {
    pub impacts: u64,
    /// Impacts that follow one of an adjacent gap within each of [`NEAR_DECADES`].
    pub near: [u64; NEAR_DECADES.len()],
    /// Impacts with a closing speed below each of [`SLOW_DECADES`].
    pub slow: [u64; SLOW_DECADES.len()],
    /// Contact phases begun.
    pub contact_phases: u64,
    /// Impacts at exactly the same instant as one of a neighbouring gap.
    pub simultaneous: u64,
    /// Dips of gaps of which rounding cannot tell whether they reach zero.
    pub undecided: u64,
    /// The first of these, with the number of its realisation.
    pub first_graze: Option<(u64, Graze)>,
}

impl Total {
    pub fn add(&mut self, other: &Total) {
        self.impacts += other.impacts;
        self.contact_phases += other.contact_phases;
        self.simultaneous += other.simultaneous;
        self.undecided += other.undecided;
        self.first_graze = self.first_graze.or(other.first_graze);
        for (sum, n) in self.near.iter_mut().zip(other.near) {
            *sum += n;
        }
        for (sum, n) in self.slow.iter_mut().zip(other.slow) {
            *sum += n;
        }
    }
}

impl Counts {
    /// Returns the counts of a realisation that has none.
    fn empty(ensemble: &Ensemble) -> Counts {
        let windows = ensemble.protocols.len();
        Counts {
            distinct: vec![vec![None; ensemble.pieces]; windows],
            impacts: vec![vec![0]; windows],
            masses: vec![vec![0]; windows],
            ..Counts::default()
        }
    }

    pub(crate) fn rejected(ensemble: &Ensemble) -> Counts {
        Counts { rejected: 1, ..Counts::empty(ensemble) }
    }

    pub(crate) fn failed(ensemble: &Ensemble) -> Counts {
        Counts { failed: 1, ..Counts::empty(ensemble) }
    }
}

/// Appends each row of `next` to the row of the same window.
fn extend<T>(rows: &mut Vec<Vec<T>>, next: Vec<Vec<T>>) {
    if rows.is_empty() {
        *rows = next;
        return;
    }
    for (row, next) in rows.iter_mut().zip(next) {
        row.extend(next);
    }
}

impl FromIterator<Counts> for Counts {
    fn from_iter<I: IntoIterator<Item = Counts>>(all: I) -> Self {
        let mut whole = Counts::default();
        for one in all {
            extend(&mut whole.distinct, one.distinct);
            extend(&mut whole.impacts, one.impacts);
            extend(&mut whole.masses, one.masses);
            whole.rejected += one.rejected;
            whole.failed += one.failed;
            whole.total.add(&one.total);
        }
        whole
    }
}

/// Whether the caller wants a run to end early.
pub(crate) type Stopped<'a> = &'a dyn Fn() -> bool;

/// Counts the impacts of one realisation while it runs.
pub(crate) struct Watch {
    topology: Topology,
    total: Total,
    /// Time of the last impact of each gap.
    last: Vec<f64>,
    /// Transients, rising.
    transients: Vec<f64>,
    /// `firsts[transient][gap]`: time of the first impact of the gap after the transient, infinite
    /// until known. All windows follow from these.
    firsts: Vec<Vec<f64>>,
    /// For each gap the number of transients whose first impact is known.
    known: Vec<usize>,
    /// Times at which windows begin or end, rising.
    edges: Vec<f64>,
    /// The counters of the engine at each edge so far.
    at_edges: Vec<Counters>,
}

/// Sorts times and drops repetitions.
fn rising(times: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut times: Vec<f64> = times.collect();
    times.sort_by(f64::total_cmp);
    times.dedup();
    times
}

impl Watch {
    pub fn new(ensemble: &Ensemble) -> Self {
        let (gaps, all) = (ensemble.chain.gaps(), &ensemble.protocols);
        let transients = rising(all.iter().map(|window| window.transient));
        Watch {
            topology: Topology::new(ensemble.chain.masses, ensemble.chain.boundary),
            total: Total::default(),
            last: vec![f64::NEG_INFINITY; gaps],
            firsts: vec![vec![f64::INFINITY; gaps]; transients.len()],
            known: vec![0; gaps],
            edges: rising(transients.iter().copied().chain(all.iter().map(Protocol::end))),
            at_edges: Vec::new(),
            transients,
        }
    }

    fn count(&mut self, impact: Impact) {
        let gaps = self.last.len();
        // On a ring gap n lies between masses n and 1: modulo n it is the neighbour of gap 1.
        let gap = impact.gap % gaps;
        let known = &mut self.known[gap];
        while self.transients.get(*known).is_some_and(|&transient| impact.time > transient) {
            self.firsts[*known][gap] = impact.time;
            *known += 1;
        }
        let [left, right] = self.topology.adjacent(gap);
        let last = |near: Option<usize>| near.map_or(f64::NEG_INFINITY, |near| self.last[near]);
        let since = impact.time - last(left).max(last(right));
        for (count, &within) in self.total.near.iter_mut().zip(&NEAR_DECADES) {
            if since > within {
                break;
            }
            *count += 1;
        }
        for (count, &below) in self.total.slow.iter_mut().zip(&SLOW_DECADES) {
            if impact.closing_speed >= below {
                break;
            }
            *count += 1;
        }
        self.last[gap] = impact.time;
        self.total.impacts += 1;
    }

    /// Runs an engine to a time and counts its impacts; ends early when `stopped` returns true.
    pub fn follow(
        &mut self,
        engine: &mut Engine,
        until: f64,
        stopped: Stopped,
    ) -> Result<(), Error> {
        while let Some(&edge) = self.edges.get(self.at_edges.len()).filter(|edge| **edge <= until) {
            engine.run(edge, |impact| {
                self.count(impact);
                !self.total.impacts.is_multiple_of(CHECK_EVERY) || !stopped()
            })?;
            self.at_edges.push(engine.counters());
        }
        Ok(())
    }

    /// Returns the counts of realisation `index`; `ended` is the outcome of its run.
    pub fn counts(
        mut self,
        ensemble: &Ensemble,
        index: u64,
        engine: &Engine,
        ended: Result<(), Error>,
    ) -> Result<Counts, Error> {
        let counters = engine.counters();
        self.total.contact_phases = counters.contact_phases;
        self.total.simultaneous = counters.simultaneous;
        self.total.undecided = counters.undecided;
        self.total.first_graze = engine.first_graze().map(|graze| (index, graze));
        let mut counts = match ended {
            Ok(()) => Counts::empty(ensemble),
            Err(Error::Work { .. }) => {
                return Ok(Counts { total: self.total, ..Counts::failed(ensemble) });
            }
            Err(error) => return Err(error),
        };
        for (place, protocol) in ensemble.protocols.iter().enumerate() {
            let edge = |time: f64| self.at_edges.get(self.edges.partition_point(|at| *at < time));
            let Some((begin, end)) = edge(protocol.transient).zip(edge(protocol.end())) else {
                continue;
            };
            let hit = self.hit(protocol);
            let ring = ensemble.chain.boundary == Boundary::Ring;
            let pieces = ensemble.pieces;
            for (piece, count) in counts.distinct[place].iter_mut().enumerate() {
                let (from, to) = (piece * hit.len() / pieces, (piece + 1) * hit.len() / pieces);
                let hit = &hit[from..to];
                *count = Some(hit.iter().map(|&hit| u32::from(hit)).sum());
            }
            counts.impacts[place] = vec![end.impacts - begin.impacts];
            counts.masses[place] = vec![masses_hit(&hit, ring)];
        }
        counts.total = self.total;
        Ok(counts)
    }

    /// Finds which gaps have an impact in a window (T, T + W].
    fn hit(&self, protocol: &Protocol) -> Vec<bool> {
        let transient = self.transients.partition_point(|at| *at < protocol.transient);
        self.firsts[transient].iter().map(|&time| time <= protocol.end()).collect()
    }
}

/// Counts the masses with an impact on one side or both: mass j lies between gaps j − 1 and j,
/// and on a ring the last one between the last gap and the first.
fn masses_hit(hit: &[bool], ring: bool) -> u32 {
    let last = ring && hit.first().zip(hit.last()).is_some_and(|(first, last)| *first || *last);
    let inner = hit.windows(2).map(|sides| u32::from(sides[0] || sides[1])).sum::<u32>();
    inner + u32::from(last)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Gaps 0 and 4 of a row of four masses are at its walls. On a ring of five the masses at both
    /// ends of gap 0 (or 5) are the last and the first.
    #[test]
    fn masses_between_gaps_by_hand() {
        for (hit, row, ring) in [
            ([true, false, false, false, false], 1, 2),
            ([true, true, false, false, false], 2, 3),
            ([true, false, false, false, true], 2, 3),
            ([false, true, false, true, false], 4, 4),
            ([true; 5], 4, 5),
            ([false; 5], 0, 0),
        ] {
            assert_eq!((masses_hit(&hit, false), masses_hit(&hit, true)), (row, ring), "{hit:?}");
        }
    }

    #[test]
    fn adjacent_impacts_by_hand() {
        // Gap 1 follows gap 0 by 0.5; gap 2 follows gap 1 by 0.05; gap 0 has gap 1 as its only
        // neighbour, 0.054 ago; gap 3 follows gap 2 by 0.004.
        let chain = crate::Chain { masses: 3, ..crate::Chain::default() };
        let mut watch = Watch::new(&Ensemble { chain, ..Ensemble::default() });
        for (time, gap, closing_speed) in
            [(1.0, 0, 1.0), (1.5, 1, 0.05), (1.55, 2, 0.0005), (1.554, 0, 1.0), (1.554, 3, 1e-9)]
        {
            watch.count(Impact { time, gap, closing_speed });
        }
        let seen = watch.total;
        assert_eq!(seen.near, [3, 1, 0, 0, 0, 0, 0, 0, 0]);
        assert_eq!(seen.slow, [3, 2, 2, 1, 1, 1, 1, 1]);
    }
}
