//! How fronts advance: how long they stand before a gap, and which gaps hold them.
//!
//! Ahead of a front no mass was ever hit, and no gap closes by itself there. So a front takes one gap after the
//! other, and between two first impacts it waits for the gap ahead, its obstacle. A wait ends with a
//! step or is cut off by the end of the run; a front at a wall has no wait any more.
//!
//! An obstacle *holds* a front if this stands before it for longer than a window W. Were obstacles
//! independent, each holding with the same chance s, the steps between two holds would be geometric with mean
//! (1 − s)/s. Walls and the end of the run cut off such series; what they cannot change is that of every front the
//! number of obstacles that hold, less s times the number m that it meets, is a martingale when it is stopped, with the variance
//! s (1 − s) ⟨m⟩. Only obstacles count that are met more than W before the end, so that for each it is known
//! whether it holds.

use super::counting::ran;
use super::run::Trace;
use crate::experiments::estimates::jackknife;
use crate::experiments::survival::kaplan_meier;
use crate::numerics::statistics::Estimate;
use crate::params::{Chain, SeedsParams};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Parts of its width into which a gap is told by how much of it its own motion crosses.
pub const PARTS: usize = 4;

/// Counts of waits and obstacles, in some runs.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Waits {
    /// Fronts: sides of a seed that is not at the wall there.
    pub fronts: u64,
    /// Waits that ended with a step, by their length in ticks.
    pub ended: Vec<u64>,
    /// Waits that the end of the run cut off, by their length.
    pub cut: Vec<u64>,
    /// Obstacles that were met in time, by what the front did before: none (the first), one that
    /// let it pass, one that held it.
    pub met: [u64; 3],
    /// Those of them that held.
    pub held: [u64; 3],
    /// [met, held] by the whole parts of its width that a gap crosses by itself.
    pub crossed: [[u64; 2]; PARTS],
    /// Sums over fronts: held², held · met, met².
    pub products: [u64; 3],
}

/// What the fronts at one σ do; errors are by the jackknife over runs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fronts {
    /// Standard deviation σ.
    pub sigma: f64,
    /// Gaps in a unit of time, as long as there is a gap ahead: steps over the time of all waits.
    pub speed: Option<Estimate>,
    /// Share of the steps after a wait of at most one beat.
    pub bursts: Option<Estimate>,
    /// What it would be for waits with a constant hazard and the same speed.
    pub even: f64,
    /// The chance to stand for one more W, having stood for none, W, and 2W.
    pub stands: [Option<Estimate>; 3],
    /// Share of the fronts that have stood for the second half of the run when it ends.
    pub standing: Option<Estimate>,
    /// Mean number of steps between two holds, (1 − s)/s.
    pub between: Option<Estimate>,
    /// The chance that an obstacle holds after one that held, over the same after one that did not.
    pub memory: Option<Estimate>,
    /// The variance over fronts of the obstacles that hold, over that of independent obstacles.
    pub dispersion: Option<Estimate>,
    /// What this would be at most if nothing but the parts of its width that a gap crosses decided, and gaps after one
    /// that held crossed as many: the mean chance of those that held to hold, over that of all.
    pub alike: f64,
    /// The chance that an obstacle holds, by the parts of its width that it crosses by itself.
    pub holds: [Option<Estimate>; PARTS],
}

/// The time 2π/|Ω − ω| after which a free and a forced motion meet again in any relation that they had: what can
/// be passed at all with the motions at hand is passed by then, as a rule.
pub fn beat(chain: &Chain) -> f64 {
    TAU / (chain.forcing_frequency - chain.natural_frequency).abs()
}

/// The tallies of each run.
pub(super) fn tallies(parameters: &SeedsParams, traces: &[Option<Trace>]) -> Vec<Waits> {
    let of = |(seed, trace): (usize, &Trace)| {
        let ahead = |gap: usize| (trace.firsts[gap], usize::from(trace.crossed[gap]));
        let mut tally = Waits::new(parameters.ticks());
        tally.follow(parameters, (0..seed).rev().map(ahead));
        tally.follow(parameters, (seed + 1..trace.firsts.len()).map(ahead));
        tally
    };
    ran(traces).map(of).collect()
}

impl Waits {
    /// Of no run, with room for waits up to some length.
    fn new(ticks: usize) -> Self {
        Waits { ended: vec![0; ticks + 1], cut: vec![0; ticks + 1], ..Waits::default() }
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
        let [mut met, mut held] = [0, 0];
        for (first, crossed) in ahead {
            let next = first.map_or(end, |tick| tick as usize);
            let wait = next - at;
            if at + window < end {
                let holds = wait > window;
                met += 1;
                held += u64::from(holds);
                self.met[before] += 1;
                self.held[before] += u64::from(holds);
                self.crossed[crossed][0] += 1;
                self.crossed[crossed][1] += u64::from(holds);
                before = if holds { 2 } else { 1 };
            }
            if first.is_none() {
                self.cut[wait] += 1;
                break;
            }
            self.ended[wait] += 1;
            at = next;
        }
        let products = [held * held, held * met, met * met];
        self.products.iter_mut().zip(products).for_each(|(sum, own)| *sum += own);
    }

    /// All numbers, in one order.
    fn numbers(&mut self) -> impl Iterator<Item = &mut u64> {
        let counts = self.met.iter_mut().chain(&mut self.held).chain(&mut self.products);
        let counts = counts.chain(self.crossed.iter_mut().flatten());
        std::iter::once(&mut self.fronts).chain(&mut self.ended).chain(&mut self.cut).chain(counts)
    }

    /// With the counts of other runs.
    fn and(mut self, mut other: Waits) -> Self {
        self.numbers().zip(other.numbers()).for_each(|(sum, own)| *sum += *own);
        self
    }

    /// Without the counts of a run that it has.
    fn without(mut self, mut run: Waits) -> Self {
        self.numbers().zip(run.numbers()).for_each(|(sum, own)| *sum -= *own);
        self
    }

    /// The sum over runs.
    pub(super) fn sum(parameters: &SeedsParams, runs: &[Waits]) -> Self {
        runs.iter().cloned().fold(Waits::new(parameters.ticks()), Waits::and)
    }

    fn steps(&self) -> u64 {
        self.ended.iter().sum()
    }

    /// The share of waits that last longer than so many ticks, for each number for which it is known.
    pub fn lasting(&self) -> Vec<f64> {
        kaplan_meier(&self.ended, &self.cut)
    }

    /// Steps over the ticks of all waits.
    fn speed(&self) -> Option<f64> {
        let waits = self.ended.iter().zip(&self.cut).enumerate();
        share(self.steps(), waits.map(|(k, (ended, cut))| k as u64 * (ended + cut)).sum())
    }

    /// The mean over obstacles that held of the chance of their like to hold, over that of all.
    fn alike(&self) -> Option<f64> {
        let [met, held] = [0, 1].map(|i| self.crossed.iter().map(|counts| counts[i]).sum());
        let of = |[met, held]: &[u64; 2]| *held as f64 * share(*held, *met).unwrap_or(0.0);
        let chance = share(held, met).filter(|chance| *chance > 0.0)?;
        Some(self.crossed.iter().map(of).sum::<f64>() / held as f64 / chance)
    }

    /// The variance of holds over that of independent obstacles.
    fn dispersion(&self) -> Option<f64> {
        let met: u64 = self.met.iter().sum();
        let s = share(self.held.iter().sum(), met)?;
        let [holds, both, all] = self.products.map(|sum| sum as f64);
        let expected = s * (1.0 - s) * met as f64;
        (expected > 0.0).then(|| (holds - 2.0 * s * both + s * s * all) / expected)
    }
}

/// A part of a whole, if there is one.
fn share(part: u64, whole: u64) -> Option<f64> {
    (whole > 0).then(|| part as f64 / whole as f64)
}

/// What the runs at one σ say of their fronts.
pub(crate) fn fronts(parameters: &SeedsParams, sigma: f64, runs: &[Waits]) -> Fronts {
    let all = Waits::sum(parameters, runs);
    let without: Vec<Waits> = runs.iter().map(|run| all.clone().without(run.clone())).collect();
    let estimate = |of: &dyn Fn(&Waits) -> Option<f64>| {
        jackknife(runs.len(), |out| of(out.map_or(&all, |run| &without[run])))
    };
    let window = parameters.window_ticks();
    let beat = beat(&parameters.chain);
    let within = (beat / parameters.tick) as usize;
    let half = parameters.ticks() / 2;
    let speed = |own: &Waits| Some(own.speed()? / parameters.tick);
    let holds = |own: &Waits, before: usize| {
        share(own.held[before], own.met[before]).filter(|share| *share > 0.0)
    };
    let stands = |windows: usize| {
        estimate(&|own| {
            let lasting = own.lasting();
            let past = |windows: usize| match windows {
                0 => Some(1.0),
                _ => lasting.get(windows * window).copied(),
            };
            Some(past(windows + 1)? / past(windows).filter(|share| *share > 0.0)?)
        })
    };
    Fronts {
        sigma,
        speed: estimate(&speed),
        bursts: estimate(&|own| share(own.ended.iter().take(within + 1).sum(), own.steps())),
        even: speed(&all).map_or(0.0, |speed| -pxfm::f_expm1(-speed * beat)),
        stands: [0, 1, 2].map(stands),
        standing: estimate(&|own| share(own.cut[half + 1..].iter().sum(), own.fronts)),
        between: estimate(&|own| {
            let [met, held] = [own.met, own.held].map(|own| own.iter().sum::<u64>());
            share(met - held, held)
        }),
        memory: estimate(&|own| Some(holds(own, 2)? / holds(own, 1)?)),
        dispersion: estimate(&Waits::dispersion),
        alike: all.alike().unwrap_or(1.0),
        holds: std::array::from_fn(|parts| {
            estimate(&|own| share(own.crossed[parts][1], own.crossed[parts][0]))
        }),
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
        let [found] = &tallies(&parameters(), &[Some(run()), None])[..] else { panic!() };
        assert_eq!(found.fronts, 2);
        // Waits of 3 and 1 to the left, of 1 and 5 to the right, where 6 more are cut off.
        assert_eq!(found.ended, [0, 2, 0, 1, 0, 1, 0, 0, 0, 0, 0, 0, 0]);
        assert_eq!(found.cut, [0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0]);
        assert_eq!((found.met, found.held), ([2, 2, 1], [0, 1, 1]));
        assert_eq!(found.crossed, [[2, 2], [1, 0], [1, 0], [1, 0]]);
        // Left 0 of 2, right 2 of 3.
        assert_eq!(found.products, [4, 6, 13]);
        assert!((found.speed().unwrap() - 4.0 / 16.0).abs() < 1e-15);
        // s = 2/5: 4 − 24/5 + 52/25 over 6/5.
        assert!((found.dispersion().unwrap() - 1.28 / 1.2).abs() < 1e-14);
    }

    #[test]
    fn what_fronts_do_by_hand() {
        let parameters = parameters();
        let runs = tallies(&parameters, &[Some(run()), Some(run()), Some(run())]);
        let found = fronts(&parameters, 0.1, &runs);
        let value = |own: Option<Estimate>| own.unwrap().value;
        assert_eq!(value(found.speed), 0.25);
        // Equal runs have no error.
        assert!(found.speed.unwrap().error < 1e-15);
        // Two of four steps after a wait of one; a beat is 1.5.
        assert_eq!(value(found.bursts), 0.5);
        assert!((found.even - (1.0 - pxfm::f_exp(-0.375))).abs() < 1e-14);
        // Of five waits two are longer than 3, and none is known to last longer than 6.
        assert!((value(found.stands[0]) - 0.4).abs() < 1e-15);
        assert!((value(found.stands[1]) - 0.5).abs() < 1e-15);
        assert_eq!(found.stands[2], None);
        // The wait that is cut has lasted for six ticks of twelve and not for more.
        assert_eq!(value(found.standing), 0.0);
        assert_eq!((value(found.between), value(found.memory)), (1.5, 2.0));
        assert_eq!(found.holds.map(value), [1.0, 0.0, 0.0, 0.0]);
        // Those that held cross nothing, as whose like all hold, of all two in five.
        assert!((found.alike - 2.5).abs() < 1e-15);
    }

    #[test]
    fn a_seed_at_the_wall_has_one_front_and_late_obstacles_are_not_judged() {
        let mut run = run();
        run.seed = Some(0);
        run.firsts = vec![Some(0), Some(9), None, None, None, None];
        let [found] = &tallies(&parameters(), &[Some(run)])[..] else { panic!() };
        assert_eq!((found.fronts, found.met, found.held), (1, [1, 0, 0], [1, 0, 0]));
        assert_eq!((found.ended[9], found.cut[3]), (1, 1));
    }

    #[test]
    fn tallies_add_and_take_away() {
        let [one] = &tallies(&parameters(), &[Some(run())])[..] else { panic!() };
        let three = Waits::sum(&parameters(), &[one.clone(), one.clone(), one.clone()]);
        let two = three.clone().without(one.clone());
        assert_eq!(two.products, one.products.map(|sum| 2 * sum));
        assert_eq!(two.crossed, one.crossed.map(|counts| counts.map(|count| 2 * count)));
        assert_eq!(two.without(one.clone()), *one);
    }

    #[test]
    fn the_like_of_those_that_held_by_hand() {
        // Four of ten and one of ten: a quarter of all, and (4 · 0.4 + 0.1)/5 of the like of those that held.
        let crossed = [[10, 4], [10, 1], [0, 0], [0, 0]];
        let alike = |crossed| Waits { crossed, ..Waits::default() }.alike();
        assert!((alike(crossed).unwrap() - 0.34 / 0.25).abs() < 1e-14);
        assert_eq!(alike([[3, 0]; PARTS]), None);
    }

    /// Obstacles that hold independently: both measures are one.
    #[test]
    fn independent_obstacles_have_no_memory() {
        use rand::RngExt;
        let mut parameters = parameters();
        (parameters.bins, parameters.window) = (60, 4);
        let mut random = crate::numerics::random::generator("test of fronts", 1, 0);
        let mut one = || {
            let (mut at, mut firsts) = (0, vec![Some(0)]);
            for _ in 0..30 {
                at += if random.random_bool(0.2) { 9 } else { 1 };
                firsts.push((at < 60).then_some(at));
            }
            let crossed = vec![0; firsts.len()];
            Some(Trace { seed: Some(0), firsts, crossed, ..Trace::default() })
        };
        let traces: Vec<_> = (0..400).map(|_| one()).collect();
        let found = fronts(&parameters, 0.1, &tallies(&parameters, &traces));
        for own in [found.memory, found.dispersion].map(Option::unwrap) {
            assert!((own.value - 1.0).abs() < 4.0 * own.error && own.error < 0.15, "{own:?}");
        }
        let between = found.between.unwrap();
        assert!((between.value - 4.0).abs() < 4.0 * between.error, "{between:?}");
    }
}
