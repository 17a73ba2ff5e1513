//! Runs chains in which exactly one gap closes by itself.

use super::counting::{Part, Trace};
use super::growth::{Prediction, predictions, sums};
use crate::experiments::prelude::*;
use impact_chain::Event;
use impact_circuits::nucleation::{closing_pull, pulls};
use std::ops::ControlFlow::{Break, Continue};
use std::ops::Range;

/// A chain whose one gap has not closed by this time is left out.
const WAIT: f64 = 2000.0;

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Seeds {
    pub parameters: SeedsParams,
    pub rows: Vec<Part>,
    /// Predicted mean counts after each transient.
    pub predicted: Vec<Prediction>,
}

impl Seeds {
    pub fn new(parameters: SeedsParams, rows: Vec<Part>) -> Seeds {
        Seeds { predicted: predictions(&parameters, &sums(&parameters, &rows)), parameters, rows }
    }
}

pub fn run(parameters: &SeedsParams, progress: &Progress) -> Result<Seeds, Error> {
    let stage = progress.stage("seeds", (parameters.sigmas.len() * parameters.realisations) as u64);
    let rows = parameters.sigmas.iter().map(|&sigma| {
        let one = |index| trace(parameters, sigma, index, progress);
        run_each(&stage, progress, 0..parameters.realisations as u64, one)
    });
    Ok(Seeds::new(parameters.clone(), rows.collect::<Result<_, _>>()?))
}

/// The search for a chain in which exactly one gap closes by itself.
struct Search<'a> {
    chain: &'a Chain,
    sigma: f64,
    normals: &'a mut NormalPairs,
}

impl Search<'_> {
    /// Draws until such a chain is found, and returns its amplitudes and that gap.
    fn chain(&mut self) -> (Vec<[f64; 2]>, usize) {
        let n = self.chain.masses;
        loop {
            let mut bodies = Vec::with_capacity(n + 2);
            if let Some(seed) = self.part(0..n + 2, &mut bodies) {
                return (bodies[1..=n].to_vec(), seed);
            }
        }
    }

    /// Draws the amplitudes of these bodies, the walls being the first and the last, until at most
    /// one gap between them closes by itself, and returns that gap.
    ///
    /// Both halves are drawn in this way, until it holds for the whole. The result is distributed
    /// as if whole chains had been drawn and rejected, which would take a hundred thousand of them.
    fn part(&mut self, range: Range<usize>, bodies: &mut Vec<[f64; 2]>) -> Option<usize> {
        let (middle, begin) = (range.start.midpoint(range.end), bodies.len());
        if range.len() == 1 {
            bodies.push(self.body(range.start));
            return None;
        }
        loop {
            let left = self.part(range.start..middle, bodies);
            let right = self.part(middle..range.end, bodies);
            let last = begin + middle - range.start;
            let least = closing_pull(self.chain);
            let closes = pulls(self.chain, &bodies[last - 1..=last]).any(|pull| pull >= least);
            let between = closes.then_some(middle - 1);
            let mut seeds = [left, right, between].into_iter().flatten();
            let seed = seeds.next();
            if seeds.next().is_none() {
                return seed;
            }
            bodies.truncate(begin);
        }
    }

    /// Returns the amplitudes of the force on a body; those on a wall are zero.
    fn body(&mut self, body: usize) -> [f64; 2] {
        let is_wall = body == 0 || body > self.chain.masses;
        if is_wall { [0.0; 2] } else { self.normals.pair().map(|x| self.sigma * x) }
    }
}

fn trace(
    parameters: &SeedsParams,
    sigma: f64,
    index: u64,
    progress: &Progress,
) -> Result<Option<Trace>, Error> {
    progress.check()?;
    let chain = &parameters.chain;
    let mut normals = NormalPairs::new("seeds", Seed(SEED), index);
    let (forcing, seed) = Search { chain, sigma, normals: &mut normals }.chain();
    let fault = |source| Error::failed("seeds", source);
    let scenario = Scenario::given(chain, forcing).map_err(fault)?;
    let mut engine = Engine::new(&scenario).map_err(fault)?;
    let Some(Impact { time: first, gap, .. }) = engine.next_impact(WAIT).map_err(fault)? else {
        return Ok(Some(Trace::default()));
    };
    debug_assert_eq!(gap, seed);
    let mut hits = vec![0_u64; chain.gaps()];
    hits[seed] = 1;
    let mut firsts = vec![None; chain.gaps()];
    firsts[seed] = Some(0);
    let ended = engine.run(first + parameters.until(), |event, _| {
        let Event::Impact(impact) = event else { return Continue(()) };
        let bin = ((impact.time - first) / parameters.bin) as usize;
        hits[impact.gap] |= 1 << bin.min(parameters.bins - 1);
        firsts[impact.gap].get_or_insert((impact.time - first) as u32);
        if progress.stopped() { Break(()) } else { Continue(()) }
    });
    progress.check()?;
    match ended {
        Ok(_) => Ok(Some(Trace { seed: Some(seed), hits, firsts })),
        Err(impact_chain::Error::Work { .. }) => Ok(None),
        Err(source) => Err(fault(source)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The gaps between walls that close by themselves.
    fn closing(chain: &Chain, forcing: &[[f64; 2]]) -> Vec<usize> {
        let wall = &[[0.0; 2]];
        let bodies = [wall, forcing, wall].concat();
        let gaps = (0..).zip(pulls(chain, &bodies));
        gaps.filter(|(_, pull)| *pull >= closing_pull(chain)).map(|(gap, _)| gap).collect()
    }

    /// Against chains that are drawn until one is accepted: place of its gap, mean square force.
    #[test]
    fn a_drawn_chain_has_one_gap_that_closes_by_itself() {
        let (chain, sigma) = (Chain { masses: 5, ..Chain::default() }, 0.25);
        let mut normals = NormalPairs::new("test of seeds, whole chains", Seed(1), 0);
        let mut whole = || loop {
            let forcing = Vec::from_iter((0..5).map(|_| normals.pair().map(|x| sigma * x)));
            if let [seed] = closing(&chain, &forcing)[..] {
                return (forcing, seed);
            }
        };
        // For each gap the shares of chains that have it, and the mean square of the forces then.
        let mut sums = [[[0.0; 2]; 6]; 2];
        for index in 0..20_000 {
            let mut normals = NormalPairs::new("test of seeds", Seed(1), index);
            let drawn = Search { chain: &chain, sigma, normals: &mut normals }.chain();
            assert_eq!(closing(&chain, &drawn.0), [drawn.1]);
            for (sums, (forcing, seed)) in sums.iter_mut().zip([drawn, whole()]) {
                let square: f64 = forcing.as_flattened().iter().map(|x| x * x).sum();
                sums[seed][0] += 1.0;
                sums[seed][1] += square / (10.0 * sigma * sigma);
            }
        }
        for (drawn, whole) in sums[0].iter().zip(&sums[1]) {
            let [counts, squares] = [0, 1].map(|i| (drawn[i] - whole[i]) / whole[0].sqrt());
            let near = counts.abs() < 5.0 && squares.abs() < 5.0;
            assert!(whole[0] > 500.0 && near, "{drawn:?} {whole:?}");
        }
    }
}
