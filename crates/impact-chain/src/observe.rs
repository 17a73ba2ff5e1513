//! Counts of one run for ensembles: different gaps in a window, close and slow impacts, first impacts after several
//! transients. No list of impacts is kept. The code sees every impact, so it is compiled for speed with the engine.

use crate::{Boundary, Engine, Error, Impact, Scenario};
use serde::{Deserialize, Serialize};

/// The δ below which two impacts of adjacent gaps are counted as close, in units of 1/ω.
pub const NEAR_DECADES: [f64; 9] = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9];

/// The v below which a closing speed is counted as slow, in units of d ω.
pub const SLOW_DECADES: [f64; 8] = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8];

/// Impacts between two questions whether to stop.
const LOOK_EVERY: u64 = 4096;

/// What one realisation showed.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Observed {
    /// Distinct gaps that impact in the window (T, T + W].
    pub distinct: u32,
    /// Masses that are hit in the window.
    pub masses: u32,
    /// Impacts in the window.
    pub window_impacts: u64,
    /// All impacts, transient included.
    pub impacts: u64,
    /// Impacts that follow one of an adjacent gap, however long after.
    pub adjacent_pairs: u64,
    /// Of these, the ones that follow within each of [`NEAR_DECADES`].
    pub near: [u64; NEAR_DECADES.len()],
    /// Impacts with a closing speed below each of [`SLOW_DECADES`].
    pub slow: [u64; SLOW_DECADES.len()],
    /// Contact phases begun.
    pub contact_phases: u64,
}

/// The running observation of one realisation.
struct Watch {
    from: f64,
    observed: Observed,
    hit: Vec<bool>,
    /// Time of the last impact of each gap.
    last: Vec<f64>,
    ring: bool,
}

impl Watch {
    fn new(gaps: usize, ring: bool, from: f64) -> Self {
        Watch {
            from,
            observed: Observed::default(),
            hit: vec![false; gaps],
            last: vec![f64::NEG_INFINITY; gaps],
            ring,
        }
    }

    fn see(&mut self, impact: Impact) {
        let seen = &mut self.observed;
        seen.impacts += 1;
        let gaps = self.last.len();
        // On a ring gap n lies between masses n and 1: modulo n it is the neighbour of gap 1.
        let gap = impact.gap % gaps;
        if impact.time > self.from {
            seen.window_impacts += 1;
            self.hit[gap] = true;
        }
        let left = match gap {
            0 if self.ring && gaps > 1 => self.last[gaps - 1],
            0 => f64::NEG_INFINITY,
            _ => self.last[gap - 1],
        };
        let right = match gap + 1 {
            next if next < gaps => self.last[next],
            _ if self.ring && gaps > 1 => self.last[0],
            _ => f64::NEG_INFINITY,
        };
        let since = impact.time - left.max(right);
        if since.is_finite() {
            seen.adjacent_pairs += 1;
            for (count, &within) in seen.near.iter_mut().zip(&NEAR_DECADES) {
                if since > within {
                    break;
                }
                *count += 1;
            }
        }
        for (count, &below) in seen.slow.iter_mut().zip(&SLOW_DECADES) {
            if impact.closing_speed >= below {
                break;
            }
            *count += 1;
        }
        self.last[gap] = impact.time;
    }

    fn end(mut self, engine: &Engine) -> Observed {
        self.observed.distinct = self.hit.iter().map(|&hit| u32::from(hit)).sum();
        self.observed.masses = masses_hit(&self.hit, self.ring);
        self.observed.contact_phases = engine.counters().contact_phases;
        self.observed
    }
}

/// Masses with an impact on one side or both: mass j lies between gaps j − 1 and j, and on a ring the
/// last one between the last gap and the first.
fn masses_hit(hit: &[bool], ring: bool) -> u32 {
    let last = ring && hit.first().zip(hit.last()).is_some_and(|(first, last)| *first || *last);
    let inner = hit.windows(2).map(|sides| u32::from(sides[0] || sides[1])).sum::<u32>();
    inner + u32::from(last)
}

/// Follows an engine of a scenario through a transient and a window that ends at `until`, and counts; stops where `stopped`
/// says so. Returns what was counted, and the error of an engine that gave up.
pub fn observe(
    scenario: &Scenario,
    engine: &mut Engine,
    transient: f64,
    until: f64,
    stopped: impl Fn() -> bool,
) -> (Observed, Result<(), Error>) {
    let ring = scenario.boundary == Boundary::Ring;
    let mut watch = Watch::new(scenario.gaps(), ring, transient);
    let ended = engine.run(until, |impact| {
        watch.see(impact);
        !watch.observed.impacts.is_multiple_of(LOOK_EVERY) || !stopped()
    });
    (watch.end(engine), ended)
}

/// The first impact of each gap after each transient: all that the windows need.
#[derive(Clone, Debug)]
pub struct FirstPassages<'a> {
    transients: &'a [f64],
    /// `times[transient][gap]`, infinite until known.
    times: Vec<Vec<f64>>,
    /// For each gap the number of transients whose first impact is known.
    known: Vec<usize>,
}

impl<'a> FirstPassages<'a> {
    /// For transients, rising, and so many gaps.
    pub fn new(transients: &'a [f64], gaps: usize) -> Self {
        FirstPassages {
            transients,
            times: vec![vec![f64::INFINITY; gaps]; transients.len()],
            known: vec![0; gaps],
        }
    }

    fn see(&mut self, time: f64, gap: usize) {
        let gap = gap % self.known.len();
        let known = &mut self.known[gap];
        while self.transients.get(*known).is_some_and(|&transient| time > transient) {
            self.times[*known][gap] = time;
            *known += 1;
        }
    }

    /// Follows an engine to a time; stops where `stopped` says so.
    ///
    /// # Errors
    /// As [`Engine::run`].
    pub fn follow(
        &mut self,
        engine: &mut Engine,
        until: f64,
        stopped: impl Fn() -> bool,
    ) -> Result<(), Error> {
        let mut seen = 0_u64;
        engine.run(until, |impact| {
            self.see(impact.time, impact.gap);
            seen += 1;
            !seen.is_multiple_of(LOOK_EVERY) || !stopped()
        })
    }

    /// Which gaps impact in the window (T, T + W] of the transient of this index.
    pub fn hit(&self, transient: usize, window: f64) -> Vec<bool> {
        let end = self.transients[transient] + window;
        self.times[transient].iter().map(|&time| time <= end).collect()
    }

    /// Distinct gaps in every window (T, T + W] that ends by `until`, transients outer; none for the others.
    pub fn counts(&self, windows: &[f64], until: f64) -> Vec<Option<u32>> {
        let mut counts = Vec::with_capacity(self.transients.len() * windows.len());
        for (times, transient) in self.times.iter().zip(self.transients) {
            for window in windows {
                let end = transient + window;
                let hit = times.iter().filter(|&&time| time <= end).count();
                counts.push((end <= until).then_some(hit as u32));
            }
        }
        counts
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn impact(time: f64, gap: usize, closing_speed: f64) -> Impact {
        Impact { time, gap, closing_speed }
    }

    fn watch_all(gaps: usize, ring: bool, from: f64, impacts: &[Impact]) -> Watch {
        let mut watch = Watch::new(gaps, ring, from);
        impacts.iter().for_each(|&i| watch.see(i));
        watch
    }

    #[test]
    fn the_window_is_open_at_its_start() {
        let impacts = [impact(1.0, 0, 1.0), impact(2.0, 1, 1.0), impact(3.0, 1, 1.0)];
        let watch = watch_all(4, false, 1.0, &impacts);
        assert_eq!(watch.hit, [false, true, false, false]);
        assert_eq!((watch.observed.impacts, watch.observed.window_impacts), (3, 2));
    }

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
        // neighbour, 0.054 ago; gap 3 follows gap 2 by 0.004 + 0.0 = 0.004.
        let impacts = [
            impact(1.0, 0, 1.0),
            impact(1.5, 1, 0.05),
            impact(1.55, 2, 0.0005),
            impact(1.554, 0, 1.0),
            impact(1.554, 3, 1e-9),
        ];
        let seen = watch_all(4, false, 0.0, &impacts).observed;
        assert_eq!(seen.adjacent_pairs, 4);
        assert_eq!(seen.near, [3, 1, 0, 0, 0, 0, 0, 0, 0]);
        assert_eq!(seen.slow, [3, 2, 2, 1, 1, 1, 1, 1]);
    }

    #[test]
    fn the_ends_of_a_ring_are_neighbours() {
        // Gaps of a ring of 5 masses are 1..=5.
        let impacts = [impact(1.0, 5, 1.0), impact(1.01, 1, 1.0)];
        assert_eq!(watch_all(5, true, 0.0, &impacts).observed.adjacent_pairs, 1);
        // Between walls the first and the last gap (0 and 4) are none.
        let impacts = [impact(1.0, 4, 1.0), impact(1.01, 0, 1.0)];
        assert_eq!(watch_all(5, false, 0.0, &impacts).observed.adjacent_pairs, 0);
    }

    #[test]
    fn windows_by_hand() {
        let mut passages = FirstPassages::new(&[1.0, 5.0], 3);
        for (time, gap) in [(0.5, 0), (1.0, 1), (2.0, 0), (3.0, 0), (6.0, 1), (9.0, 0)] {
            passages.see(time, gap);
        }
        // After 1: gap 0 at 2, gap 1 at 6. After 5: gap 1 at 6, gap 0 at 9.
        let counts = passages.counts(&[1.0, 4.0, 5.0], 9.5);
        assert_eq!(counts, [Some(1), Some(1), Some(2), Some(1), Some(2), None]);
    }
}
