//! What follows from the counts. Estimates are ratios of sums over realisations, with errors by the jackknife.

use super::{Independence, Outcome, Run, blocks};
use crate::circuits::distribution::SampleSpace;
use crate::circuits::{commuting, jump};
use crate::numerics::estimates::{jackknife, ratio, sums, with_error};
use crate::numerics::statistics::Estimate;
use crate::params::{IndependenceParams, set};
use crate::table::Table;

/// Gaps of the graph whose circuits are enumerated.
const ENUMERATED: usize = 7;

/// Distances up to which successions are compared one by one.
const FAR: usize = 20;

/// Lengths of circuits between which the change with length is measured, and their distance.
const LOW: [usize; 3] = [2, 3, 4];
const HIGH: [usize; 3] = [8, 9, 10];
const APART: f64 = 6.0;

const SIGMA: &str = "d omega^2";

/// One ensemble.
pub(super) struct Row<'a> {
    sigma: f64,
    /// Number of gaps N.
    gaps: usize,
    runs: Vec<&'a Run>,
    /// Impacts of each run.
    impacts: Vec<f64>,
    /// Probability that an impact begins a simple circuit of length k, at index k − 1, if all gaps are alike and
    /// independent.
    equal: Vec<f64>,
    /// Numbers of successive impacts of which the different gaps are counted.
    blocks: Vec<usize>,
}

/// All tables.
pub fn tables(found: &Independence) -> Vec<Table> {
    let parameters = &found.parameters;
    let gaps = parameters.chain.gaps();
    let mut rows = Vec::new();
    for (&sigma, part) in parameters.sigmas.iter().zip(&found.rows) {
        let mut runs: Vec<&Run> = Vec::new();
        for outcome in part {
            if let Outcome::Ran(run) = outcome {
                runs.push(run);
            }
        }
        let impacts = runs.iter().map(|run| total(&run.hits)).collect();
        let blocks = blocks(parameters, gaps).collect();
        rows.push(Row { sigma, gaps, runs, impacts, equal: equal(gaps), blocks });
    }
    vec![rising(&rows), near(&rows), circuits(&rows), different(&rows), orders(), all(parameters)]
}

/// Each σ.
fn rising(rows: &[Row<'_>]) -> Table {
    let short = |row: &Row<'_>, counts: &[u64]| total(&counts[1..row.short()]);
    Table::of("independence.rising", rows, |row| row.runs.len())
        .key("sigma", SIGMA, |row| row.sigma)
        .count("gaps", "gaps N of a chain", |row| row.gaps as u64)
        .count("impacts", "impacts in the window, of all chains", |row| {
            row.impacts.iter().sum::<f64>() as u64
        })
        .estimate("effective", "1", "effective number of gaps, 1/Σ π²", |row| {
            row.ratio(|run, m| {
                [m * (m - 1.0), run.hits.iter().map(|&h| h as f64 * (h as f64 - 1.0)).sum()]
            })
        })
        .estimate("entropy", "1", "entropy of the frequencies, in nats", |row| {
            row.ratio(|run, m| [run.entropy(), m])
        })
        .estimate("information", "1", "information about the next impact, in nats", |row| {
            row.ratio(|run, m| [m * run.information[0], m])
        })
        .estimate("shuffled", "1", "the same after shuffling", |row| {
            row.ratio(|run, m| [m * run.information[1], m])
        })
        .estimate("dependence", "1", "their difference over the entropy, per cent", |row| {
            per_cent(
                row.ratio(|run, m| [m * (run.information[0] - run.information[1]), run.entropy()]),
            )
        })
        .real("far", "1", 2, "largest departure of far successions from 1", |row| {
            let far = (IndependenceParams::FAR..=row.farthest())
                .filter_map(|distance| row.near(distance));
            far.map(|own| (own.value - 1.0).abs()).fold(0.0, f64::max)
        })
        .estimate("same", "1", "next impact of either mass at the same gap, per cent", |row| {
            per_cent(row.ratio(|run, _| [run.next[1] as f64, total(&run.next)]))
        })
        .estimate("same_independent", "1", "the same of independent impacts", |row| {
            per_cent(row.ratio(|run, m| [independent_same(&run.hits), m]))
        })
        .estimate("short", "1", "short circuits, 2 ≤ k, over those of equal gaps", |row| {
            row.ratio(|run, m| [short(row, &run.circuits), m * row.equal_short()])
        })
        .estimate("step", "1", "N times the factor of a circuit for each gap more", Row::step)
        .estimate("passing", "1", "share of these that pass by a neighbour of their start", |row| {
            row.ratio(|run, _| [run.passing as f64, short(row, &run.circuits)])
        })
        .real("passing_equal", "1", 2, "the same of equal gaps", |row| {
            passing(row.gaps, row.short(), &row.equal)
        })
        .estimate("length", "1", "mean length of simple circuits", |row| {
            row.ratio(|run, _| length(&run.circuits))
        })
        .real("length_equal", "1", 2, "the same of equal gaps", |row| {
            let weighed = row.equal.iter().enumerate().map(|(i, own)| (i + 1) as f64 * own);
            weighed.sum::<f64>() / row.equal.iter().sum::<f64>()
        })
        .estimate("different", "1", "different gaps among N successive impacts", |row| {
            row.different(row.blocks.iter().position(|m| *m == row.gaps)?)
        })
        .done()
}

/// By distance from one impact to the next.
fn near(rows: &[Row<'_>]) -> Table {
    let rows: Vec<(&Row<'_>, usize)> = rows
        .iter()
        .flat_map(|row| (0..=row.farthest()).map(move |distance| (row, distance)))
        .collect();
    Table::of("independence.near", &rows, |(row, _)| row.runs.len())
        .key("sigma", SIGMA, |(row, _)| row.sigma)
        .key("distance", "1", |(_, distance)| *distance as f64)
        .estimate("over_independent", "1", "over independent ones", |(row, distance)| {
            row.near(*distance)
        })
        .done()
}

/// Shares of impacts that begin a simple circuit of length k.
fn circuits(rows: &[Row<'_>]) -> Table {
    let rows: Vec<(&Row<'_>, usize)> =
        rows.iter().flat_map(|row| (1..=row.gaps).map(move |k| (row, k))).collect();
    let share = |row: &Row<'_>, of: &dyn Fn(&Run) -> u64| {
        row.runs.iter().map(|run| of(run)).sum::<u64>() as f64 / row.impacts.iter().sum::<f64>()
    };
    Table::of("independence.circuits", &rows, |(row, _)| row.runs.len())
        .key("sigma", SIGMA, |(row, _)| row.sigma)
        .key("k", "1", |(_, k)| *k as f64)
        .real("measured", "1", 3, "", |(row, k)| share(row, &|run| run.circuits[k - 1]))
        .real("equal", "1", 3, "of equal gaps", |(row, k)| row.equal[k - 1])
        .done()
}

/// Different gaps among m successive impacts.
fn different(rows: &[Row<'_>]) -> Table {
    let rows: Vec<(&Row<'_>, usize)> =
        rows.iter().flat_map(|row| (0..row.blocks.len()).map(move |block| (row, block))).collect();
    Table::of("independence.different", &rows, |(row, _)| row.runs.len())
        .key("sigma", SIGMA, |(row, _)| row.sigma)
        .key("impacts", "1", |(row, block)| row.blocks[*block] as f64)
        .estimate("measured", "1", "", |(row, block)| row.different(*block))
        .real("equal", "1", 3, "of equal gaps", |(row, block)| {
            let n = row.gaps as f64;
            n * (1.0 - power(1.0 - 1.0 / n, row.blocks[*block]))
        })
        .done()
}

/// Circuits that differ only by the order of impacts without a common mass.
fn orders() -> Table {
    let [circuits, classes] = commuting::simple_classes(ENUMERATED);
    let p = jump::p_jump(SampleSpace::Simple, set::vertices()).map_or(f64::NAN, |jump| jump.p);
    Table::of("independence.orders", &[()], |()| 0)
        .count("gaps", "gaps of a chain", |()| ENUMERATED as u64)
        .count("circuits", "simple circuits", |()| circuits as u64)
        .count("classes", "of them that a mass tells apart", |()| classes as u64)
        .real("mean", "1", 2, "mean number at the jump, each class with p^k once", |()| {
            commuting::mean_without_orders(set::vertices(), p)
        })
        .done()
}

/// What was run.
fn all(parameters: &IndependenceParams) -> Table {
    Table::of("independence.all", &[parameters], |own| own.realisations)
        .count("realisations", "chains of each ensemble", |own| own.realisations as u64)
        .chosen("transient", "1/omega", "", |own| Some(own.protocol.transient))
        .chosen("window", "1/omega", "", |own| Some(own.protocol.window))
        .count("short", "longest length that is called short", |_| IndependenceParams::SHORT as u64)
        .count("far", "least distance that is called far", |_| IndependenceParams::FAR as u64)
        .done()
}

fn total(counts: &[u64]) -> f64 {
    counts.iter().sum::<u64>() as f64
}

fn per_cent(own: Option<Estimate>) -> Option<Estimate> {
    own.map(|own| with_error(100.0 * own.value, 100.0 * own.error))
}

/// Probability that an impact begins a simple circuit of length k, at index k − 1, if each of N gaps
/// comes with probability 1/N whatever came before: k φ_N(k)/N^(k+1).
pub(super) fn equal(big_n: usize) -> Vec<f64> {
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
pub(super) fn passing(big_n: usize, short: usize, equal: &[f64]) -> f64 {
    let n = big_n as f64;
    let [mut with, mut all] = [0.0; 2];
    for (k, own) in (2..=short.min(big_n)).zip(&equal[1..]) {
        let k = k as f64;
        // k − 1 different gaps of N − 1 miss one of them, or two; the gaps at the ends have one neighbour.
        let one = (n - k) / (n - 1.0);
        let two = if big_n > 2 { one * (n - k - 1.0) / (n - 2.0) } else { one };
        with += own * (1.0 - (2.0 * one + (n - 2.0) * two) / n);
        all += own;
    }
    with / all
}

/// Σ h_i h_j over the pairs of gaps at a distance, over the number of impacts: successions at that
/// distance, if impacts are independent.
fn independent(hits: &[u64], distance: usize) -> f64 {
    let both: f64 = hits.iter().zip(&hits[distance..]).map(|(&a, &b)| a as f64 * b as f64).sum();
    if distance == 0 { both / total(hits) } else { 2.0 * both / total(hits) }
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

fn length(counts: &[u64]) -> [f64; 2] {
    let weighed = counts.iter().enumerate().map(|(i, &n)| (i + 1) as f64 * n as f64);
    [weighed.sum(), total(counts)]
}

fn power(base: f64, exponent: usize) -> f64 {
    (0..exponent).fold(1.0, |power, _| power * base)
}

impl Run {
    /// Entropy of the frequencies times the number of impacts.
    fn entropy(&self) -> f64 {
        let m = total(&self.hits);
        let term = |&h: &u64| if h > 0 { h as f64 * pxfm::f_log(m / h as f64) } else { 0.0 };
        self.hits.iter().map(term).sum()
    }
}

impl Row<'_> {
    /// The ratio of two numbers of a run and its impacts.
    fn ratio(&self, of: impl Fn(&Run, f64) -> [f64; 2]) -> Option<Estimate> {
        let pairs = self.runs.iter().zip(&self.impacts).map(|(run, &m)| of(run, m));
        ratio(&pairs.collect::<Vec<_>>())
    }

    fn short(&self) -> usize {
        IndependenceParams::SHORT.min(self.gaps)
    }

    fn equal_short(&self) -> f64 {
        self.equal[1..self.short()].iter().sum()
    }

    fn farthest(&self) -> usize {
        FAR.min(self.gaps - 1)
    }

    /// Successions at a distance over those of independent impacts.
    fn near(&self, distance: usize) -> Option<Estimate> {
        self.ratio(|run, _| [run.distances[distance] as f64, independent(&run.hits, distance)])
    }

    /// N times the factor that a gap more brings to the frequency of a single circuit.
    fn step(&self) -> Option<Estimate> {
        let low = |list: &[f64]| LOW.iter().map(|k| list[k - 1]).sum::<f64>();
        let high = |list: &[f64]| HIGH.iter().map(|k| list[k - 1]).sum::<f64>();
        (self.gaps >= HIGH[2]).then_some(())?;
        let expected = high(&self.equal) / low(&self.equal);
        let pair = |run: &&Run| {
            let circuits: Vec<f64> = run.circuits.iter().map(|&n| n as f64).collect();
            [high(&circuits), low(&circuits)]
        };
        let pairs: Vec<[f64; 2]> = self.runs.iter().map(pair).collect();
        jackknife(pairs.len(), |out| {
            let [above, below] = sums(&pairs, out);
            let root = |x: f64| pxfm::f_exp(pxfm::f_log(x) / APART);
            (above > 0.0 && below > 0.0).then(|| root(above / below / expected))
        })
    }

    fn different(&self, block: usize) -> Option<Estimate> {
        self.ratio(|run, _| run.distinct[block].map(|n| n as f64))
    }
}
