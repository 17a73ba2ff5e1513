//! How fronts advance: how long they stand before a gap, and which gaps hold them.
//!
//! Ahead of a front no mass was ever hit, and no gap closes by itself there. So a front takes one gap after the
//! other, and between two first impacts it waits for the gap ahead, its obstacle. A wait ends with a
//! step or is cut off by the end of the run; a front at a wall has no wait any more.
//!
//! An obstacle *holds* a front if this stands before it for longer than a window W. Only obstacles count that are met
//! more than W before the end, so that for each it is known whether it holds.

use super::run::Trace;
use crate::experiments::survival::kaplan_meier;
use crate::numerics::estimates::{jackknife, ratio};
use crate::numerics::statistics::Estimate;
use crate::params::{Chain, SeedsParams};
use std::f64::consts::TAU;

/// Parts of its width into which a gap is told by how much of it its own motion crosses.
pub const PARTS: usize = 4;

/// What the fronts of one run did.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Waits {
    /// Fronts: sides of a seed that is not at the wall there.
    pub fronts: u64,
    /// Waits that ended with a step, in ticks.
    pub ended: Vec<usize>,
    /// Waits that the end of the run cut off.
    pub cut: Vec<usize>,
    /// Obstacles that were met in time, by what the front did before: none (the first), one that
    /// let it pass, one that held it.
    pub met: [u64; 3],
    /// Those of them that held.
    pub held: [u64; 3],
    /// [met, held] by the whole parts of its width that a gap crosses by itself.
    pub crossed: [[u64; 2]; PARTS],
}

/// The fronts of all runs at one σ; errors are by the jackknife over runs.
pub(super) struct Fronts<'a> {
    pub parameters: &'a SeedsParams,
    pub runs: Vec<Waits>,
    /// How many waits ended and how many were cut off after so many ticks.
    pub waits: [Vec<u64>; 2],
}

/// The time 2π/|Ω − ω| after which a free and a forced motion meet again in any relation that they had: what can
/// be passed at all with the motions at hand is passed by then, as a rule.
pub fn beat(chain: &Chain) -> f64 {
    TAU / (chain.forcing_frequency - chain.natural_frequency).abs()
}

impl Waits {
    /// Of a run and its seed.
    pub(super) fn of(parameters: &SeedsParams, (seed, trace): (usize, &Trace)) -> Self {
        let ahead = |gap: usize| (trace.firsts[gap], usize::from(trace.crossed[gap]));
        let mut waits = Waits::default();
        waits.follow(parameters, (0..seed).rev().map(ahead));
        waits.follow(parameters, (seed + 1..trace.firsts.len()).map(ahead));
        waits
    }

    /// Counts one front, from the gaps ahead of it: the tick of the first impact of each, if it had one, and
    /// the parts that it crosses by itself.
    fn follow(
        &mut self,
        parameters: &SeedsParams,
        ahead: impl ExactSizeIterator<Item = (Option<u32>, usize)>,
    ) {
        let (end, window) = (parameters.ticks(), parameters.window_ticks());
        self.fronts += u64::from(ahead.len() > 0);
        let (mut at, mut before) = (0, 0);
        for (first, crossed) in ahead {
            let next = first.map_or(end, |tick| tick as usize);
            let wait = next - at;
            if at + window < end {
                let holds = wait > window;
                self.met[before] += 1;
                self.held[before] += u64::from(holds);
                self.crossed[crossed][0] += 1;
                self.crossed[crossed][1] += u64::from(holds);
                before = if holds { 2 } else { 1 };
            }
            if first.is_none() {
                self.cut.push(wait);
                break;
            }
            self.ended.push(wait);
            at = next;
        }
    }

    pub(super) fn steps(&self) -> u64 {
        self.ended.len() as u64
    }
}

impl<'a> Fronts<'a> {
    /// Of all runs at one σ.
    pub fn new(parameters: &'a SeedsParams, runs: Vec<Waits>) -> Self {
        let mut waits = [0, 1].map(|_| vec![0; parameters.ticks() + 1]);
        for run in &runs {
            run.ended.iter().for_each(|wait| waits[0][*wait] += 1);
            run.cut.iter().for_each(|wait| waits[1][*wait] += 1);
        }
        Fronts { parameters, runs, waits }
    }

    /// A statistic of sums over runs.
    fn summed<const N: usize>(
        &self,
        of: impl Fn(&Waits) -> [u64; N],
        statistic: impl Fn([f64; N]) -> Option<f64>,
    ) -> Option<Estimate> {
        let numbers: Vec<[u64; N]> = self.runs.iter().map(of).collect();
        jackknife(numbers.len(), |out| {
            let mut sums = [0; N];
            for (_, own) in numbers.iter().enumerate().filter(|(run, _)| Some(*run) != out) {
                sums.iter_mut().zip(own).for_each(|(sum, own)| *sum += own);
            }
            statistic(sums.map(|sum| sum as f64))
        })
    }

    fn ratio(&self, of: impl Fn(&Waits) -> [u64; 2]) -> Option<Estimate> {
        let pairs = self.runs.iter().map(|run| of(run).map(|n| n as f64));
        ratio(&pairs.collect::<Vec<_>>())
    }

    /// Gaps in a unit of time, as long as there is a gap ahead: steps over the time of all waits.
    pub fn speed(&self) -> Option<Estimate> {
        let tick = self.parameters.tick;
        let time = |run: &Waits| run.ended.iter().chain(&run.cut).sum::<usize>() as f64 * tick;
        let pairs = self.runs.iter().map(|run| [run.steps() as f64, time(run)]);
        ratio(&pairs.collect::<Vec<_>>())
    }

    /// Share of the steps after a wait of at most one beat.
    pub fn bursts(&self) -> Option<Estimate> {
        let beat = (beat(&self.parameters.chain) / self.parameters.tick) as usize;
        let short = |run: &Waits| run.ended.iter().filter(|wait| **wait <= beat).count() as u64;
        self.ratio(|run| [short(run), run.steps()])
    }

    /// What it would be for waits with a constant hazard and the same speed.
    pub fn even(&self) -> f64 {
        let beat = beat(&self.parameters.chain);
        self.speed().map_or(0.0, |speed| -pxfm::f_expm1(-speed.value * beat))
    }

    /// The share of waits that last longer than so many ticks, in all runs but one.
    pub fn lasting(&self, out: Option<usize>) -> Vec<f64> {
        let [mut ended, mut cut] = self.waits.clone();
        if let Some(run) = out.map(|run| &self.runs[run]) {
            run.ended.iter().for_each(|wait| ended[*wait] -= 1);
            run.cut.iter().for_each(|wait| cut[*wait] -= 1);
        }
        kaplan_meier(&ended, &cut)
    }

    /// The chance to stand for one more W, having stood for so many of them.
    pub fn stands(&self, windows: usize) -> Option<Estimate> {
        let window = self.parameters.window_ticks();
        jackknife(self.runs.len(), |out| {
            let lasting = self.lasting(out);
            let past = |windows: usize| match windows {
                0 => Some(1.0),
                _ => lasting.get(windows * window).copied(),
            };
            Some(past(windows + 1)? / past(windows).filter(|share| *share > 0.0)?)
        })
    }

    /// Share of the fronts that have stood for the second half of the run when it ends.
    pub fn standing(&self) -> Option<Estimate> {
        let half = self.parameters.ticks() / 2;
        let long = |run: &Waits| run.cut.iter().filter(|wait| **wait > half).count() as u64;
        self.ratio(|run| [long(run), run.fronts])
    }

    /// The chance that an obstacle holds after one that held, over the same after one that did not.
    pub fn memory(&self) -> Option<Estimate> {
        let after = |run: &Waits| [run.held[2], run.met[2], run.held[1], run.met[1]];
        self.summed(after, |[again, held, first, passed]| {
            (again > 0.0 && first > 0.0).then(|| again / held / (first / passed))
        })
    }

    /// The chance that an obstacle holds that crosses so many parts of its width by itself.
    pub fn holds(&self, parts: usize) -> Option<Estimate> {
        self.ratio(|run| [run.crossed[parts][1], run.crossed[parts][0]])
    }

    /// The mean over obstacles that held of the chance of their like to hold, over that of all. The memory would be
    /// at most this if nothing but these parts decided, and gaps after one that held crossed as many.
    pub fn alike(&self) -> f64 {
        let sum = |parts: usize, of: usize| {
            self.runs.iter().map(|run| run.crossed[parts][of]).sum::<u64>() as f64
        };
        let [met, held] = [0, 1].map(|of| (0..PARTS).map(|parts| sum(parts, of)).sum::<f64>());
        let like = |parts: usize| {
            let [met, held] = [0, 1].map(|of| sum(parts, of));
            if met > 0.0 { held * (held / met) } else { 0.0 }
        };
        (0..PARTS).map(like).sum::<f64>() / held / (held / met)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Profile;

    /// Twelve ticks; a window has three, a beat is shorter than a tick times two.
    fn parameters() -> SeedsParams {
        let mut parameters = SeedsParams::new(Profile::Quick);
        parameters.chain.masses = 5;
        parameters.chain.forcing_frequency = 1.0 + TAU / 1.5;
        (parameters.bin, parameters.bins, parameters.window, parameters.tick) = (1.0, 12, 3, 1.0);
        parameters
    }

    /// Gap 2 of six is the seed. To the left the front comes to the wall; to the right it passes at once, is
    /// held, and stands.
    fn run() -> Trace {
        Trace {
            seed: Some(2),
            firsts: vec![Some(4), Some(3), Some(0), Some(1), Some(6), None],
            crossed: vec![3, 2, 0, 1, 0, 0],
            ..Trace::default()
        }
    }

    #[test]
    fn fronts_of_a_run_by_hand() {
        let found = Waits::of(&parameters(), (2, &run()));
        assert_eq!(found.fronts, 2);
        // Waits of 3 and 1 to the left, of 1 and 5 to the right, where 6 more are cut off.
        assert_eq!((found.ended, found.cut), (vec![3, 1, 1, 5], vec![6]));
        assert_eq!((found.met, found.held), ([2, 2, 1], [0, 1, 1]));
        assert_eq!(found.crossed, [[2, 2], [1, 0], [1, 0], [1, 0]]);
    }

    #[test]
    fn what_fronts_do_by_hand() {
        let parameters = parameters();
        let runs = vec![Waits::of(&parameters, (2, &run())); 3];
        let found = Fronts::new(&parameters, runs);
        let value = |own: Option<Estimate>| own.unwrap().value;
        assert_eq!(value(found.speed()), 0.25);
        // Equal runs have no error.
        assert!(found.speed().unwrap().error < 1e-15);
        // Two of four steps after a wait of one; a beat is 1.5.
        assert_eq!(value(found.bursts()), 0.5);
        assert!((found.even() - (1.0 - pxfm::f_exp(-0.375))).abs() < 1e-14);
        // Of five waits two are longer than 3, and none is known to last longer than 6.
        assert!((value(found.stands(0)) - 0.4).abs() < 1e-15);
        assert!((value(found.stands(1)) - 0.5).abs() < 1e-15);
        assert_eq!(found.stands(2), None);
        // The wait that is cut has lasted for six ticks of twelve and not for more.
        assert_eq!(value(found.standing()), 0.0);
        assert_eq!(value(found.memory()), 2.0);
        assert_eq!([0, 1, 2, 3].map(|parts| value(found.holds(parts))), [1.0, 0.0, 0.0, 0.0]);
        // Those that held cross nothing, as whose like all hold, of all two in five.
        assert!((found.alike() - 2.5).abs() < 1e-15);
    }

    #[test]
    fn a_seed_at_the_wall_has_one_front_and_late_obstacles_are_not_judged() {
        let mut run = run();
        run.firsts = vec![Some(0), Some(9), None, None, None, None];
        let found = Waits::of(&parameters(), (0, &run));
        assert_eq!((found.fronts, found.met, found.held), (1, [1, 0, 0], [1, 0, 0]));
        assert_eq!((found.ended, found.cut), (vec![9], vec![3]));
    }

    #[test]
    fn the_like_of_those_that_held_by_hand() {
        // Four of ten and one of ten: a quarter of all, and (4 · 0.4 + 0.1)/5 of the like of those that held.
        let runs = vec![Waits { crossed: [[10, 4], [10, 1], [0, 0], [0, 0]], ..Waits::default() }];
        let found = Fronts::new(&parameters(), runs).alike();
        assert!((found - 0.34 / 0.25).abs() < 1e-14, "{found}");
    }
}
