//! Counts the impacts of runs: different gaps with an impact in each window, close and slow
//! impacts. All counts are whole numbers that add. This code runs at every impact, so it is
//! compiled for speed with the engine.

use crate::search::outcome::Graze;
use crate::topology::Topology;
use crate::{Chain, End, Engine, Error, Event, Impact, LATEST, check_range};
#[cfg(feature = "serde")]
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow::{Break, Continue};

/// The δ below which impacts of adjacent gaps are counted as close, whatever ω is.
pub const NEAR_DECADES: [f64; 9] = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9];

/// The v below which a closing speed is counted as slow, whatever d and ω are.
pub const SLOW_DECADES: [f64; 8] = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8];

/// Impacts after which a run checks again whether to stop.
const CHECK_EVERY: u64 = 4096;

/// The window (T, T + W] in which gaps with an impact are counted (ours: Sec. 2 has none).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
pub struct Protocol {
    /// Transient T that is dropped, in the scenario's unit of time.
    pub transient: f64,
    /// Window W, in the same unit.
    pub window: f64,
}

impl Default for Protocol {
    fn default() -> Self {
        Protocol { transient: 500.0, window: 200.0 }
    }
}

impl Protocol {
    /// Returns the end of the window, T + W.
    #[must_use]
    pub fn end(&self) -> f64 {
        self.transient + self.window
    }
}

/// Counts of realisations in order, for each window; those that follow one another can be joined.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
pub struct Counts {
    /// Different gaps with an impact, by window and realisation, or `None` if the run ended before
    /// the window.
    pub distinct: Vec<Vec<Option<u32>>>,
    /// Impacts in each window, of each realisation.
    pub impacts: Vec<Vec<u64>>,
    /// Masses that are hit in each window, of each realisation.
    pub masses: Vec<Vec<u32>>,
    /// Realisations with an overlapping start.
    pub rejected: usize,
    /// Realisations that the engine ended early.
    pub failed: usize,
    /// Realisations that were simulated by the engine, one by one.
    pub by_engine: usize,
    /// Counts of all runs together.
    pub total: Total,
}

/// Impacts of whole runs, transients included.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize))]
pub struct Total {
    /// Their number.
    pub impacts: u64,
    /// Impacts that follow one of an adjacent gap within each of [`NEAR_DECADES`].
    pub near: [u64; NEAR_DECADES.len()],
    /// Impacts with a closing speed below each of [`SLOW_DECADES`].
    pub slow: [u64; SLOW_DECADES.len()],
    /// Contact phases begun, one per gap.
    pub contact_phases: u64,
    /// Impacts at exactly the same instant as one of a neighbouring gap.
    pub simultaneous: u64,
    /// Dips of gaps of which rounding cannot tell whether they reach zero.
    pub undecided: u64,
    /// The first of these with the index of its realisation, or `None` if there is no such dip.
    pub first_graze: Option<(u64, Graze)>,
}

impl Total {
    /// Adds the counts of later realisations.
    pub fn add(&mut self, other: &Total) {
        self.impacts += other.impacts;
        self.contact_phases += other.contact_phases;
        self.simultaneous += other.simultaneous;
        self.undecided += other.undecided;
        self.first_graze = self.first_graze.or(other.first_graze);
        let near = self.near.iter_mut().zip(other.near);
        for (sum, n) in near.chain(self.slow.iter_mut().zip(other.slow)) {
            *sum += n;
        }
    }
}

/// Appends the values of later realisations to the row of each window.
fn append<T>(rows: &mut [Vec<T>], later_rows: Vec<Vec<T>>) {
    for (row, later) in rows.iter_mut().zip(later_rows) {
        row.extend(later);
    }
}

impl FromIterator<Counts> for Counts {
    fn from_iter<I: IntoIterator<Item = Counts>>(parts: I) -> Self {
        let mut parts = parts.into_iter();
        let mut joined = parts.next().unwrap_or_default();
        for part in parts {
            append(&mut joined.distinct, part.distinct);
            append(&mut joined.impacts, part.impacts);
            append(&mut joined.masses, part.masses);
            joined.rejected += part.rejected;
            joined.failed += part.failed;
            joined.by_engine += part.by_engine;
            joined.total.add(&part.total);
        }
        joined
    }
}

/// Counts the impacts of one run.
pub struct Watch {
    topology: Topology,
    windows: Vec<Protocol>,
    total: Total,
    /// Time of the last impact of each gap.
    last: Vec<f64>,
    transients: Vec<f64>,
    /// `firsts[transient][gap]`: time of the gap's first impact after the transient, or infinite.
    firsts: Vec<Vec<f64>>,
    /// For each gap the number of transients whose first impact is known.
    firsts_known: Vec<usize>,
    /// Times at which windows begin or end, up to the end of the run.
    edges: Vec<f64>,
    /// Impacts until each edge that has passed.
    passed: Vec<u64>,
}

fn rising(times: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut times: Vec<f64> = times.collect();
    times.sort_by(f64::total_cmp);
    times.dedup();
    times
}

impl Watch {
    /// Creates the counts of a run of this chain, all of them zero.
    #[must_use]
    pub fn new(chain: &Chain, windows: &[Protocol]) -> Self {
        let gaps = chain.gaps();
        let transients = rising(windows.iter().map(|window| window.transient));
        Watch {
            topology: Topology::new(chain.masses, chain.boundary),
            windows: windows.to_vec(),
            total: Total::default(),
            last: vec![f64::NEG_INFINITY; gaps],
            firsts: vec![vec![f64::INFINITY; gaps]; transients.len()],
            firsts_known: vec![0; gaps],
            transients,
            edges: Vec::new(),
            passed: Vec::new(),
        }
    }

    /// Forgets what an earlier run has left, and begins one that ends with the last edge of a
    /// window up to `until`; returns that end, or `None` if there is no such edge.
    ///
    /// # Errors
    /// [`Error::Input`] for windows that end after [`LATEST`], and for an end that is no number.
    pub(crate) fn begin(&mut self, until: f64) -> Result<Option<f64>, Error> {
        check_range("until", until, f64::NEG_INFINITY, f64::INFINITY)?;
        let ends = self.windows.iter().map(Protocol::end);
        self.edges = rising(self.transients.iter().copied().chain(ends));
        self.edges.iter().try_for_each(|&edge| check_range("windows", edge, -LATEST, LATEST))?;
        self.edges.retain(|edge| *edge <= until);
        self.passed.clear();
        self.total = Total::default();
        self.last.fill(f64::NEG_INFINITY);
        self.firsts_known.fill(0);
        self.firsts.iter_mut().for_each(|firsts| firsts.fill(f64::INFINITY));
        Ok(self.edges.last().copied())
    }

    /// Counts an impact that is not earlier than those before, nor later than the end of the run.
    #[inline(always)]
    pub(crate) fn count(&mut self, impact: Impact) {
        while self.edges.get(self.passed.len()).is_some_and(|&edge| impact.time > edge) {
            self.passed.push(self.total.impacts);
        }
        let gaps = self.last.len();
        // On a ring gap n lies between masses n and 1: modulo n it is the neighbour of gap 1.
        let gap = if impact.gap < gaps { impact.gap } else { impact.gap - gaps };
        let known = &mut self.firsts_known[gap];
        while self.transients.get(*known).is_some_and(|&transient| impact.time > transient) {
            self.firsts[*known][gap] = impact.time;
            *known += 1;
        }
        let [left, right] = self.topology.adjacent(gap);
        let last = |near: Option<usize>| near.map_or(f64::NEG_INFINITY, |near| self.last[near]);
        let since = impact.time - last(left).max(last(right));
        let near = self.total.near.iter_mut().zip(&NEAR_DECADES);
        for (count, _) in near.take_while(|(_, within)| since <= **within) {
            *count += 1;
        }
        let slow = self.total.slow.iter_mut().zip(&SLOW_DECADES);
        for (count, _) in slow.take_while(|(_, below)| impact.closing_speed < **below) {
            *count += 1;
        }
        self.last[gap] = impact.time;
        self.total.impacts += 1;
    }

    /// Runs an engine through all windows that end by `until`, and returns the counts of this run
    /// alone, realisation `index` of many; ends early, with incomplete counts, when `stopped`
    /// returns true. A start that overlaps, and a run that the engine ended early, are counted.
    ///
    /// # Errors
    /// [`Error::Input`] for an engine of another chain, and for windows that end after [`LATEST`].
    pub fn run(
        &mut self,
        engine: Result<Engine, Error>,
        index: u64,
        until: f64,
        stopped: &dyn Fn() -> bool,
    ) -> Result<Counts, Error> {
        let end = self.begin(until)?;
        let mut engine = match engine {
            Ok(engine) => engine,
            Err(Error::Overlap { .. }) => return Ok(Counts { rejected: 1, ..self.incomplete() }),
            Err(Error::Work { .. }) => return Ok(Counts { failed: 1, ..self.incomplete() }),
            Err(error) => return Err(error),
        };
        if engine.topology() != self.topology {
            let problem = "its masses or ends are not those of the chain of the counts";
            return Err(Error::input("engine", problem, "create a Watch of its own chain"));
        }
        let ended = end.map_or(Ok(End::Reached), |end| {
            engine.run(end, |event, _| {
                if let Event::Impact(impact) = event {
                    self.count(*impact);
                }
                let stops = self.total.impacts.is_multiple_of(CHECK_EVERY) && stopped();
                if stops { Break(()) } else { Continue(()) }
            })
        });
        let counters = engine.counters();
        self.total.contact_phases = counters.contact_phases;
        self.total.simultaneous = counters.simultaneous;
        self.total.undecided = counters.undecided;
        self.total.first_graze = engine.first_graze().map(|graze| (index, graze));
        match ended {
            Ok(_) => Ok(self.complete()),
            Err(Error::Work { .. }) => {
                Ok(Counts { failed: 1, total: self.total.clone(), ..self.incomplete() })
            }
            Err(error) => Err(error),
        }
    }

    /// Returns the counts of a realisation that has none.
    fn incomplete(&self) -> Counts {
        let windows = self.windows.len();
        Counts {
            distinct: vec![vec![None]; windows],
            impacts: vec![vec![0]; windows],
            masses: vec![vec![0]; windows],
            by_engine: 1,
            ..Counts::default()
        }
    }

    /// Returns the counts of a realisation whose impacts up to the end of the run are counted.
    pub(crate) fn complete(&mut self) -> Counts {
        self.passed.resize(self.edges.len(), self.total.impacts);
        let mut counts = Counts { total: self.total.clone(), ..self.incomplete() };
        for (place, window) in self.windows.iter().enumerate() {
            let edge = |time: f64| self.passed.get(self.edges.partition_point(|edge| *edge < time));
            let Some((begin, end)) = edge(window.transient).zip(edge(window.end())) else {
                continue;
            };
            let hit = self.gaps_hit(window).unwrap_or_default();
            counts.distinct[place] = vec![Some(hit.iter().map(|&hit| u32::from(hit)).sum())];
            counts.impacts[place] = vec![end - begin];
            counts.masses[place] = vec![masses_hit(&self.topology, &hit)];
        }
        counts
    }

    /// Returns which gaps had an impact in one of the windows, or `None` for another window.
    #[must_use]
    pub fn gaps_hit(&self, window: &Protocol) -> Option<Vec<bool>> {
        self.windows.iter().find(|one| *one == window)?;
        let transient = self.transients.partition_point(|time| *time < window.transient);
        Some(self.firsts[transient].iter().map(|&time| time <= window.end()).collect())
    }
}

/// Counts the masses with an impact on one side or both: those between a gap and the next.
fn masses_hit(topology: &Topology, hit: &[bool]) -> u32 {
    let next = |k: usize| topology.adjacent(k)[1];
    (0..hit.len()).map(|k| u32::from(next(k).is_some_and(|next| hit[k] || hit[next]))).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Boundary;

    /// Gaps 0 and 4 of four masses are at walls; on a ring of five, gap 0 joins the last and first.
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
            let both = [Topology::new(4, Boundary::Walls), Topology::new(5, Boundary::Ring)];
            assert_eq!(both.map(|topology| masses_hit(&topology, &hit)), [row, ring], "{hit:?}");
        }
    }

    #[test]
    fn adjacent_impacts_by_hand() {
        // Gap 1 follows gap 0 by 0.5; gap 2 follows gap 1 by 0.05; gap 0 has gap 1 as its only
        // neighbour, 0.054 ago; gap 3 follows gap 2 by 0.004.
        let chain = Chain { masses: 3, ..Chain::default() };
        let mut watch = Watch::new(&chain, &[Protocol::default()]);
        for (time, gap, closing_speed) in
            [(1.0, 0, 1.0), (1.5, 1, 0.05), (1.55, 2, 0.0005), (1.554, 0, 1.0), (1.554, 3, 1e-9)]
        {
            watch.count(Impact { time, gap, closing_speed });
        }
        assert_eq!(watch.total.near, [3, 1, 0, 0, 0, 0, 0, 0, 0]);
        assert_eq!(watch.total.slow, [3, 2, 2, 1, 1, 1, 1, 1]);
    }
}
