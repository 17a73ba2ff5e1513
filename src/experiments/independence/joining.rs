//! From realisations to ensembles.

use super::{Dependence, Distinct, Independence, Orders, Outcome, Part, Run, blocks, chain};
use crate::circuits::distribution::SampleSpace;
use crate::circuits::{self, commuting, jump};
use crate::experiments::estimates::{jackknife, ratio, sums};
use crate::experiments::{Error, Progress};
use crate::numerics::statistics::Estimate;
use crate::params::{IndependenceParams, IndependenceRow, VERTICES};

/// Gaps of the graph whose circuits are enumerated.
const ENUMERATED: usize = 7;

/// Distances up to which successions are compared one by one.
const FAR: usize = 20;

/// Lengths of circuits between which the change with length is measured, and their distance.
const LOW: [usize; 3] = [2, 3, 4];
const HIGH: [usize; 3] = [8, 9, 10];
const APART: f64 = 6.0;

pub fn join(
    parameters: &IndependenceParams,
    parts: Vec<Vec<Part>>,
    progress: &Progress,
) -> Result<Independence, Error> {
    progress.check()?;
    let rows = parameters.rows.iter().zip(parts);
    let p = jump::p_jump(SampleSpace::Simple, VERTICES).map_err(refused)?.p;
    let [circuits, classes] = commuting::simple_classes(ENUMERATED);
    let mean = commuting::mean_without_orders(VERTICES, p);
    Ok(Independence {
        rows: rows.map(|(row, parts)| dependence(parameters, row, &parts.concat())).collect(),
        orders: Orders { vertices: ENUMERATED, circuits, classes, p, mean },
        parameters: parameters.clone(),
    })
}

fn refused(error: circuits::Error) -> Error {
    Error::input("parameters", error.to_string(), "see src/params/independence.rs")
}

/// Probability that an impact begins a simple circuit of length k, at index k − 1, if each of N gaps
/// comes with probability 1/N whatever came before: k φ_N(k)/N^(k+1).
fn uniform(big_n: usize) -> Vec<f64> {
    let n = big_n as f64;
    let mut now = 1.0 / n;
    let step = |k: usize| {
        let own = now;
        now *= (big_n - k) as f64 / n;
        own
    };
    (1..=big_n).map(step).collect()
}

/// Share of short circuits, 2 ≤ k ≤ `short`, with a neighbour of the first gap in them, if all gaps
/// are alike and independent.
fn passing(big_n: usize, short: usize, uniform: &[f64]) -> f64 {
    let n = big_n as f64;
    let [mut with, mut all] = [0.0; 2];
    for (k, own) in (2..=short.min(big_n)).zip(&uniform[1..]) {
        let k = k as f64;
        // k − 1 different gaps of N − 1 miss one of them, or two; the gaps at the ends have one neighbour.
        let one = (n - k) / (n - 1.0);
        let two = if big_n > 2 { one * (n - k - 1.0) / (n - 2.0) } else { one };
        with += own * (1.0 - (2.0 * one + (n - 2.0) * two) / n);
        all += own;
    }
    with / all
}

fn total(lists: impl Iterator<Item = Vec<u64>>, length: usize) -> Vec<u64> {
    lists.fold(vec![0; length], |mut sum, list| {
        sum.iter_mut().zip(list).for_each(|(sum, own)| *sum += own);
        sum
    })
}

fn float(counts: &[u64]) -> Vec<f64> {
    counts.iter().map(|&n| n as f64).collect()
}

/// Σ h_i h_j over the pairs of gaps at each distance, over the number of impacts: successions at that
/// distance, if impacts are independent.
fn independent_distances(hits: &[u64]) -> Vec<f64> {
    let hits = float(hits);
    let all: f64 = hits.iter().sum();
    let at = |distance: usize| {
        let both: f64 = hits.iter().zip(&hits[distance..]).map(|(a, b)| a * b).sum();
        if distance == 0 { both / all } else { 2.0 * both / all }
    };
    (0..hits.len()).map(at).collect()
}

/// Impacts of which the next of their masses would be at the same gap, if impacts were independent.
fn independent_same(hits: &[u64]) -> f64 {
    let share = |gap: usize| {
        let around = gap.saturating_sub(1)..(gap + 2).min(hits.len());
        let own = hits[gap] as f64;
        let all = hits[around].iter().sum::<u64>() as f64;
        if all > 0.0 { own * own / all } else { 0.0 }
    };
    (0..hits.len()).map(share).sum()
}

fn power(base: f64, exponent: usize) -> f64 {
    (0..exponent).fold(1.0, |power, _| power * base)
}

fn dependence(parameters: &IndependenceParams, row: &IndependenceRow, all: &Part) -> Dependence {
    let big_n = chain(parameters, row).gaps();
    let short = IndependenceParams::SHORT.min(big_n);
    let runs: Vec<&Run> = all
        .iter()
        .filter_map(|outcome| match outcome {
            Outcome::Ran(run) => Some(run.as_ref()),
            _ => None,
        })
        .collect();
    let uniform = uniform(big_n);
    let impacts: Vec<f64> = runs.iter().map(|run| float(&run.hits).iter().sum()).collect();
    let of = |pair: &dyn Fn(&Run, f64) -> [f64; 2]| {
        let pairs: Vec<_> = runs.iter().zip(&impacts).map(|(run, &m)| pair(run, m)).collect();
        ratio(&pairs)
    };
    let sum = |counts: &[u64]| counts.iter().sum::<u64>() as f64;
    let expected: Vec<Vec<f64>> = runs.iter().map(|run| independent_distances(&run.hits)).collect();
    let near = |distance: usize| {
        let pair = |(run, own): (&&Run, &Vec<f64>)| [run.distances[distance] as f64, own[distance]];
        ratio(&runs.iter().zip(&expected).map(pair).collect::<Vec<_>>())
    };
    let entropy = |run: &Run, m: f64| -> f64 {
        let term = |&h: &u64| if h > 0 { h as f64 * pxfm::f_log(m / h as f64) } else { 0.0 };
        run.hits.iter().map(term).sum()
    };
    let few = |counts: &[u64], m: f64| {
        [sum(&counts[1..short]), m * uniform[1..short].iter().sum::<f64>()]
    };
    let length = |counts: &[u64]| {
        let weighed = counts.iter().enumerate().map(|(i, &n)| (i + 1) as f64 * n as f64);
        [weighed.sum(), sum(counts)]
    };
    let ways = (big_n * (big_n - 1) / 2) as f64;
    let returns: Vec<[u64; 2]> = runs
        .iter()
        .map(|run| [run.returns[0] * run.returns[0].saturating_sub(1), run.returns[1]])
        .collect();
    let collisions: Vec<_> =
        returns.iter().map(|&[pairs, same]| [ways * same as f64, pairs as f64]).collect();
    let mut histogram = std::collections::BTreeMap::new();
    for [count, cells] in runs.iter().flat_map(|run| &run.histogram) {
        *histogram.entry(*count).or_insert(0) += cells;
    }
    let lists =
        |pick: fn(&Run) -> &Vec<u64>| total(runs.iter().map(|run| pick(run).clone()), big_n);
    Dependence {
        row: *row,
        gaps: big_n,
        hits: runs.iter().map(|run| run.hits.clone()).collect(),
        histogram: histogram.into_iter().map(|(count, cells)| [count, cells]).collect(),
        distances: lists(|run| &run.distances),
        next: [0, 1, 2].map(|side| runs.iter().map(|run| run.next[side]).sum()),
        circuits: lists(|run| &run.circuits),
        markov: lists(|run| &run.markov),
        passing: runs.iter().map(|run| run.passing).sum(),
        returns: [0, 1].map(|i| returns.iter().map(|own| own[i]).sum()),
        effective: of(&|run, m| {
            let same = float(&run.hits).iter().map(|h| h * (h - 1.0)).sum();
            [m * (m - 1.0), same]
        }),
        entropy: of(&|run, m| [entropy(run, m), m]),
        information: of(&|run, m| [m * run.information[0], m]),
        shuffled: of(&|run, m| [m * run.information[1], m]),
        dependence: of(&|run, m| [m * (run.information[0] - run.information[1]), entropy(run, m)]),
        near: (0..big_n.min(FAR + 1)).map(near).collect(),
        same: of(&|run, _| [run.next[1] as f64, sum(&run.next)]),
        same_independent: of(&|run, m| [independent_same(&run.hits), m]),
        loops: of(&|run, m| [run.circuits[0] as f64, m * uniform[0]]),
        short: of(&|run, m| few(&run.circuits, m)),
        short_markov: of(&|run, m| few(&run.markov, m)),
        step: step(&runs, &uniform),
        passing_share: of(&|run, _| [run.passing as f64, sum(&run.circuits[1..short])]),
        passing_independent: passing(big_n, short, &uniform),
        collisions: ratio(&collisions),
        length: of(&|run, _| length(&run.circuits)),
        length_markov: of(&|run, _| length(&run.markov)),
        length_uniform: {
            let weighed = uniform.iter().enumerate().map(|(i, u)| (i + 1) as f64 * u);
            weighed.sum::<f64>() / uniform.iter().sum::<f64>()
        },
        uniform,
        distinct: blocks(parameters, big_n)
            .enumerate()
            .map(|(place, m)| different(&runs, place, m, big_n))
            .collect(),
        without: [
            all.iter().filter(|outcome| **outcome == Outcome::Quiet).count(),
            all.iter().filter(|outcome| **outcome == Outcome::Failed).count(),
        ],
    }
}

/// N times the factor that a gap more brings to the frequency of a single circuit.
fn step(runs: &[&Run], uniform: &[f64]) -> Option<Estimate> {
    let low = |list: &[f64]| LOW.iter().map(|k| list[k - 1]).sum::<f64>();
    let high = |list: &[f64]| HIGH.iter().map(|k| list[k - 1]).sum::<f64>();
    (uniform.len() >= HIGH[2]).then_some(())?;
    let expected = high(uniform) / low(uniform);
    let pair = |run: &&Run| {
        let circuits = float(&run.circuits);
        [high(&circuits), low(&circuits)]
    };
    let pairs: Vec<[f64; 2]> = runs.iter().map(pair).collect();
    jackknife(pairs.len(), |out| {
        let [above, below] = sums(&pairs, out);
        let root = |x: f64| pxfm::f_exp(pxfm::f_log(x) / APART);
        (above > 0.0 && below > 0.0).then(|| root(above / below / expected))
    })
}

fn different(runs: &[&Run], place: usize, m: usize, big_n: usize) -> Distinct {
    let blocks: Vec<u64> = runs.iter().map(|run| run.distinct[place][1]).collect();
    let of = |pick: &dyn Fn(&Run) -> f64| {
        let pair = |(run, &blocks): (&&Run, &u64)| [pick(run), blocks as f64];
        ratio(&runs.iter().zip(&blocks).map(pair).collect::<Vec<_>>())
    };
    let frequencies = |run: &Run| -> f64 {
        let hits = float(&run.hits);
        let all: f64 = hits.iter().sum();
        let seen: f64 = hits.iter().map(|h| 1.0 - power(1.0 - h / all, m)).sum();
        seen * run.distinct[place][1] as f64
    };
    let n = big_n as f64;
    Distinct {
        impacts: m,
        different: runs.iter().map(|run| run.distinct[place][0]).sum(),
        different_markov: runs.iter().map(|run| run.distinct_markov[place]).sum(),
        mean: of(&|run| run.distinct[place][0] as f64),
        markov: of(&|run| run.distinct_markov[place] as f64),
        frequencies: of(&frequencies),
        uniform: n * (1.0 - power(1.0 - 1.0 / n, m)),
        blocks,
    }
}
