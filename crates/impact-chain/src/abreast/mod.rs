//! Simulates many chains side by side.
//!
//! All chains go through the same steps of time. A gap is two sines between impacts, kept by its
//! four amplitudes, so nothing is integrated: at the end of each step every gap is evaluated, and
//! bounds of its derivatives prove for nearly all of them that they did not close. The first roots
//! of all others are located together, and each chain then goes from impact to impact within the
//! step. What these proofs do not cover is left to the engine, chain by chain and whole: slow
//! impacts and contact, adjacent impacts whose order rounding cannot tell, dips near zero.

mod columns;
mod lanes;
mod plan;
mod proof;
mod roots;
mod slot;

use crate::vectors::vector_level;
use crate::{Boundary, Chain, Counts, Engine, Error, HitGaps, Protocol, Scenario, Watch};
use columns::Columns;
use fearless_simd::{Level, dispatch};
use lanes::Lanes;
use plan::{Grid, Plan};
use proof::SLOW;
use slot::Slot;

/// Runs of more steps than this are left to the engine, which waits at no cost.
const MOST_STEPS: f64 = 1e7;

/// Gaps at a start are this wide at least, in units of d; the engine decides about others.
const OPEN: f64 = 1e-6;

/// Masses side by side that fill the registers.
const MASSES: usize = 1600;

/// Simulates many realisations of a chain side by side, with the same impacts as the engine until
/// rounding parts them: chains that impacts make unstable differ then in every method.
///
/// Each realisation has the same bits whatever else is simulated, with any vectors of a processor.
#[derive(Clone, Debug)]
pub struct Abreast {
    chain: Chain,
    windows: Vec<Protocol>,
    until: f64,
    end: f64,
    plan: Plan,
    grid: Grid,
}

/// A realisation that was simulated to its end.
pub struct Realisation {
    slot: Slot,
    /// Amplitudes of cos ωt and sin ωt of each gap, in units of d.
    free: Vec<[f64; 2]>,
}

/// Counts the impacts of many realisations of a chain: side by side, or by the engine where that
/// cannot be.
#[derive(Clone, Debug)]
pub struct Counting {
    chain: Chain,
    windows: Vec<Protocol>,
    until: f64,
    abreast: Option<Abreast>,
}

impl Counting {
    /// Prepares runs of a chain through the windows that end by `until`.
    #[must_use]
    pub fn new(chain: &Chain, windows: &[Protocol], until: f64) -> Counting {
        let abreast = Abreast::new(chain, windows, until);
        Counting { chain: chain.clone(), windows: windows.to_vec(), until, abreast }
    }

    /// Counts realisations, in their order; incomplete when `stopped` returns true. Each has its
    /// index and its scenario, or `None` if the engine has to do it, which `engine` creates for an
    /// index.
    ///
    /// # Errors
    /// Those of [`Watch::run`].
    pub fn run(
        &self,
        starts: Vec<(u64, Option<Scenario>)>,
        engine: impl Fn(u64) -> Result<Engine, Error>,
        stopped: &dyn Fn() -> bool,
    ) -> Result<Vec<(Counts, Watch)>, Error> {
        let (indices, scenarios): (Vec<u64>, Vec<Option<Scenario>>) = starts.into_iter().unzip();
        let has_scenario: Vec<bool> = scenarios.iter().map(Option::is_some).collect();
        let scenarios: Vec<Scenario> = scenarios.into_iter().flatten().collect();
        let abreast = self.abreast.as_ref();
        let mut runs = abreast.map_or(Vec::new(), |many| many.run(&scenarios, stopped)).into_iter();
        let count = |(index, has_scenario)| {
            let run = if has_scenario { runs.next().flatten() } else { None };
            if let Some(mut run) = run {
                return Ok((run.counts(), run.slot.watch));
            }
            let mut watch = Watch::new(&self.chain, &self.windows);
            let counts = watch.run(engine(index), index, self.until, stopped)?;
            Ok((counts, watch))
        };
        indices.into_iter().zip(has_scenario).map(count).collect()
    }
}

impl Abreast {
    /// Prepares runs of a chain through the windows that end by `until`, or to `until` if there are
    /// no windows. Returns `None` if all of them are left to the engine: with r near 0, where
    /// masses stick, r = 1, where it keeps the energy, rings of one or two masses, and very long
    /// runs.
    #[must_use]
    pub fn new(chain: &Chain, windows: &[Protocol], until: f64) -> Option<Abreast> {
        let frequencies = [chain.natural_frequency, chain.forcing_frequency];
        let mut watch = Watch::new(chain, windows);
        let edge = watch.begin(until).ok()?;
        let end = if windows.is_empty() { until } else { edge? };
        let simple = frequencies.iter().all(|omega| (1e-3..=1e3).contains(omega))
            && (SLOW..1.0).contains(&chain.restitution)
            && (chain.masses > 2 || chain.boundary == Boundary::Walls)
            && chain.masses > 0
            && frequencies.iter().all(|omega| omega * end < MOST_STEPS / 8.0);
        if !simple {
            return None;
        }
        let grid = Grid::new(frequencies, end);
        let plan = Plan::new(chain, grid.length);
        let (chain, windows) = (chain.clone(), windows.to_vec());
        Some(Abreast { chain, windows, until, end, plan, grid })
    }

    /// Ends each realisation as soon as one gap, or all, were hit later than `time`. One that the
    /// engine has to do is not ended.
    #[must_use]
    pub fn until_hit(mut self, gaps: HitGaps, time: f64) -> Abreast {
        self.plan.end = (gaps, time);
        self
    }

    /// Returns how many realisations of a chain are best simulated together.
    #[must_use]
    pub fn batch_size(chain: &Chain) -> usize {
        (MASSES / chain.masses.max(1)).clamp(1, 16)
    }

    /// Simulates these realisations, in their order; `None` for each that the engine has to do, and
    /// for all when `stopped` returns true.
    pub fn run(
        &self,
        scenarios: &[Scenario],
        stopped: &dyn Fn() -> bool,
    ) -> Vec<Option<Realisation>> {
        self.run_at(vector_level(), scenarios, stopped)
    }

    fn run_at(
        &self,
        level: Level,
        scenarios: &[Scenario],
        stopped: &dyn Fn() -> bool,
    ) -> Vec<Option<Realisation>> {
        let gaps = self.chain.gaps();
        let mut columns = Columns::new(scenarios.len(), gaps);
        let set = |(place, scenario)| self.set(place, scenario, &mut columns);
        let slots = scenarios.iter().enumerate().map(set).collect();
        let mut lanes = Lanes::new(&self.plan, slots, columns);
        dispatch!(level, simd => lanes.run(simd, &self.grid, self.end, stopped));
        let (stopped, Lanes { slots, columns, .. }) = (stopped(), lanes);
        let free = |place| {
            let free = |gap| {
                let [a, b, ..] = columns.amplitudes(columns.before(place, gap) + 1);
                [a, b]
            };
            (0..gaps).map(free).collect()
        };
        let done = |(place, slot): (usize, Slot)| {
            (!slot.handed_over && !stopped).then(|| Realisation { slot, free: free(place) })
        };
        slots.into_iter().enumerate().map(done).collect()
    }

    fn set(&self, place: usize, scenario: &Scenario, columns: &mut Columns) -> Slot {
        let chain = &self.chain;
        let mut watch = Watch::new(chain, &self.windows);
        let alike = Chain { start: chain.start, ..scenario.chain() } == *chain
            && scenario.overtones.is_empty()
            && scenario.places.is_none();
        let ready = watch.begin(self.until).is_ok();
        let to_hit = match self.plan.end.0 {
            HitGaps::One => 1,
            HitGaps::All => chain.gaps(),
        };
        let mut slot = Slot::new(watch, chain.gaps(), to_hit);
        if !alike || !ready {
            slot.hand_over();
            return slot;
        }
        for (gap, amplitudes) in scenario.gap_amplitudes().into_iter().enumerate() {
            let width = 1.0 + amplitudes[0] + amplitudes[2];
            let is_bounded = columns.set(place, gap, amplitudes, &self.plan);
            if !is_bounded || width.is_nan() || width <= OPEN {
                slot.hand_over();
            }
        }
        slot
    }
}

impl Realisation {
    /// Returns its counts in the windows, and those of the whole run.
    pub fn counts(&mut self) -> Counts {
        Counts { by_engine: 0, ..self.slot.watch.complete() }
    }

    /// Returns free parts (a_j, b_j) of the masses at the end that give the same gaps; on a ring
    /// those of the first mass are zero.
    #[must_use]
    pub fn free_parts(&self, chain: &Chain) -> Vec<[f64; 2]> {
        let first = usize::from(chain.boundary == Boundary::Ring);
        let mut sum = [0.0; 2];
        (0..chain.masses)
            .map(|mass| {
                if mass >= first {
                    let [a, b] = self.free[mass - first];
                    sum = [sum[0] + chain.spacing * a, sum[1] + chain.spacing * b];
                }
                sum
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{NormalPairs, Seed};
    use fearless_simd::Simd;

    fn draw(chain: &Chain, sigma: f64, stream: &str) -> Vec<Scenario> {
        let normals = |i| NormalPairs::new(stream, Seed(1), i);
        (0..16).map(|i| Scenario::draw(chain, sigma, &mut normals(i))).collect()
    }

    /// It has the impacts of the whole one until one gap, or all, were hit after a time.
    #[test]
    fn realisations_end_with_the_gap_that_is_asked_for() {
        let chain = Chain { masses: 8, ..Chain::default() };
        let scenarios = draw(&chain, 0.5, "first");
        let many = Abreast::new(&chain, &[], 60.0).unwrap();
        for (gaps, number) in [(HitGaps::One, 1), (HitGaps::All, 9)] {
            let (early, mut ended) = (many.clone().until_hit(gaps, 30.0), 0);
            for (run, scenario) in early.run(&scenarios, &|| false).into_iter().zip(&scenarios) {
                let (mut expected, mut is_hit) = (0, [false; 9]);
                let mut engine = crate::Engine::new(scenario).unwrap();
                while let Some(impact) = engine.next_impact(60.0).unwrap() {
                    expected += 1;
                    is_hit[impact.gap] |= impact.time > 30.0;
                    if is_hit.iter().filter(|&&is_hit| is_hit).count() == number {
                        ended += 1;
                        break;
                    }
                }
                assert_eq!(run.unwrap().counts().total.impacts, expected);
            }
            assert!(ended > 4, "{gaps:?}: {ended}");
        }
        assert_eq!(Abreast::batch_size(&Chain { masses: 200, ..chain }), 8);
    }

    /// The tests side by side tell of nearly all gaps: few are decided by themselves.
    #[test]
    fn few_gaps_are_decided_by_themselves() {
        for (sigma, frequency, share) in
            [(0.3, 2.0_f64.sqrt(), 0.06), (0.3, 0.6, 0.05), (1.0, 2.3, 0.09)]
        {
            let chain = Chain { masses: 30, forcing_frequency: frequency, ..Chain::default() };
            let scenarios = draw(&chain, sigma, "decided");
            let runs = Abreast::new(&chain, &[], 100.0).unwrap().run(&scenarios, &|| false);
            let [mut impacts, mut decided] = [0; 2];
            for mut run in runs.into_iter().flatten() {
                impacts += run.counts().total.impacts;
                decided += run.slot.decided;
            }
            let is_small = (decided as f64) < share * impacts as f64;
            assert!(decided > 0 && is_small, "{decided} {impacts}");
        }
    }

    /// A realisation has the same bits with any vectors, alone or with others.
    #[test]
    fn bits_are_the_same_for_any_width() {
        let best = Level::new();
        #[allow(unused_mut)]
        let mut levels = vec![best, Level::baseline()];
        #[cfg(target_arch = "x86_64")]
        levels.extend(best.as_sse2().map(Simd::level));
        #[cfg(target_arch = "x86_64")]
        levels.extend(best.as_avx2().map(Simd::level));
        let chain = Chain { masses: 30, ..Chain::default() };
        let scenarios = draw(&chain, 0.3, "bits");
        let many = Abreast::new(&chain, &[], 300.0).unwrap();
        let bits = |run: Option<Realisation>| {
            let parts = run.map(|run| run.free_parts(&chain)).unwrap_or_default();
            parts.into_iter().flatten().map(f64::to_bits).collect::<Vec<u64>>()
        };
        let bits_at = |level, scenarios: &[Scenario]| -> Vec<Vec<u64>> {
            many.run_at(level, scenarios, &|| false).into_iter().map(bits).collect()
        };
        let expected = bits_at(best, &scenarios);
        assert!(expected.iter().flatten().count() > 800);
        for level in levels {
            let alone = scenarios.chunks(1).flat_map(|scenario| bits_at(level, scenario));
            assert!(alone.eq(expected.iter().cloned()) && bits_at(level, &scenarios) == expected);
        }
    }
}
