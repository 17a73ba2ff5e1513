//! Are impacts independent?

use super::model;
use super::{Guard, Look, far, unless};
use crate::experiments::independence::{Dependence, Distinct, Independence};
use crate::params::IndependenceParams;
use crate::report::values::line;
use pxfm::{f_exp, f_log};

pub const GUARDS: &[Guard] = &[
    Guard { name: "impacts_add_up", ids: &["independence.*", "independence_*"], find: sums },
    Guard { name: "dependence_of_counts", ids: &["independence.*"], find: information },
    Guard { name: "successions_of_counts", ids: &["independence_*"], find: near },
    Guard { name: "circuits_of_equal_gaps", ids: &["independence.*"], find: circuits },
    Guard { name: "different_of_frequencies", ids: &["independence.*"], find: different },
    Guard { name: "independence_as_tabled", ids: &["independence_*"], find: tabled },
    Guard { name: "orders_enumerated", ids: &["orders_circuits", "orders_classes"], find: orders },
];

fn found(look: Look<'_>) -> Option<&Independence> {
    look.results.independence().ok()
}

fn sum(counts: &[u64]) -> f64 {
    counts.iter().sum::<u64>() as f64
}

fn impacts(row: &Dependence) -> f64 {
    row.hits.iter().map(|hits| sum(hits)).sum()
}

/// Σ h ln h.
fn logs(counts: impl Iterator<Item = f64>) -> f64 {
    counts.filter(|&h| h > 0.0).map(|h| h * f_log(h)).sum()
}

/// An estimate beside what it is by another way; none is as good as anything.
fn is(
    what: &str,
    own: Option<crate::numerics::statistics::Estimate>,
    expected: f64,
) -> Option<String> {
    far(what, own?.value, expected)
}

/// Every impact is of one gap and is followed by one other; the ensembles are those asked for.
fn sums(look: Look<'_>) -> Option<String> {
    let found = found(look)?;
    let asked: Vec<_> = found.rows.iter().map(|row| row.row).collect();
    let uneven = unless(asked == found.parameters.rows, || "other ensembles than asked for".into());
    uneven.or_else(|| {
        found.rows.iter().find_map(|row| {
            let all = impacts(row);
            let followed: u64 = row.histogram.iter().map(|[count, cells]| count * cells).sum();
            let realisations = (row.hits.len() + row.without.iter().sum::<usize>()) as f64;
            let coincide = |hits: &Vec<u64>| -> f64 {
                hits.iter().map(|&h| h as f64 * (h as f64 - 1.0)).sum()
            };
            let pairs = |hits: &Vec<u64>| sum(hits) * (sum(hits) - 1.0);
            let effective = row.hits.iter().map(pairs).sum::<f64>()
                / row.hits.iter().map(coincide).sum::<f64>();
            far("impacts by distance", sum(&row.distances), all)
                .or_else(|| far("impacts by their successor", followed as f64, all))
                .or_else(|| far("gaps of the chain", row.gaps as f64, row.row.masses as f64 + 1.0))
                .or_else(|| look.is("independence_realisations", realisations))
                .or_else(|| is("effective gaps", row.effective, effective))
        })
    })
}

/// Entropy is ln M less the mean of ln h, information twice that less the same of pairs.
fn information(look: Look<'_>) -> Option<String> {
    found(look)?.rows.iter().find_map(|row| {
        let all = impacts(row);
        let whole = logs(row.hits.iter().map(|hits| sum(hits)));
        let single = logs(row.hits.iter().flatten().map(|&h| h as f64));
        let cells = row.histogram.iter();
        let pairs: f64 = cells.map(|&[n, cells]| cells as f64 * n as f64 * f_log(n as f64)).sum();
        let entropy = (whole - single) / all;
        let information = (whole - 2.0 * single + pairs) / all;
        let shuffled = row.shuffled?.value;
        is("an entropy", row.entropy, entropy)
            .or_else(|| is("an information", row.information, information))
            .or_else(|| is("a dependence", row.dependence, (information - shuffled) / entropy))
            // A cell where λ impacts are expected by chance adds at most λ ln(1 + 1/λ), by Jensen's inequality,
            // and all cells together most where they are alike.
            .or_else(|| {
                let cells = (row.gaps * row.gaps * row.hits.len()) as f64;
                let most = f_log(1.0 + cells / all);
                unless((0.0..=most).contains(&shuffled), || {
                    format!("shuffled impacts keep {shuffled} nats")
                })
            })
    })
}

/// Successions at a distance, if gaps are independent.
fn expected(row: &Dependence, distance: usize) -> f64 {
    // Either of two gaps may be the first.
    let orders = if distance == 0 { 1.0 } else { 2.0 };
    let of = |hits: &Vec<u64>| {
        let pairs = hits.iter().zip(hits.iter().skip(distance));
        orders * pairs.map(|(&a, &b)| a as f64 * b as f64).sum::<f64>() / sum(hits)
    };
    row.hits.iter().map(of).sum()
}

/// Successions at a distance over those of independent gaps, and impacts of which the next
/// of their masses is at the same gap.
fn near(look: Look<'_>) -> Option<String> {
    found(look)?.rows.iter().find_map(|row| {
        let at = |(distance, own): (usize, &Option<_>)| {
            let ratio = row.distances[distance] as f64 / expected(row, distance);
            is("successions at a distance", *own, ratio)
        };
        let share = |hits: &Vec<u64>, gap: usize| {
            let at = |gap: Option<usize>| gap.and_then(|gap| hits.get(gap)).map_or(0, |&h| h);
            let own = at(Some(gap));
            let around = at(gap.checked_sub(1)) + own + at(Some(gap + 1));
            own as f64 * own as f64 / around.max(1) as f64
        };
        let same: f64 = row
            .hits
            .iter()
            .map(|hits| (0..row.gaps).map(|gap| share(hits, gap)).sum::<f64>())
            .sum();
        is("returns to the gap", row.same, row.next[1] as f64 / sum(&row.next))
            .or_else(|| is("free returns", row.same_independent, same / impacts(row)))
            .or_else(|| row.near.iter().enumerate().find_map(at))
    })
}

/// Probability that an impact begins a simple circuit of length k if all gaps are alike, by logarithms.
fn equal(big_n: usize, k: usize) -> f64 {
    let log_n = f_log(big_n as f64);
    f_exp(model::log_simple(big_n, k) + f_log(k as f64) - (k + 1) as f64 * log_n)
}

/// Ways to take k things of n, none if there are too few.
fn choose(n: usize, k: usize) -> f64 {
    if k > n {
        return 0.0;
    }
    let log = model::log_factorial;
    f_exp(log(n) - log(k) - log(n - k))
}

/// Circuits beside those of equal gaps, whose number has a closed form.
fn circuits(look: Look<'_>) -> Option<String> {
    let most = look.number("independence_short")? as usize;
    found(look)?.rows.iter().find_map(|row| {
        let (big_n, all) = (row.gaps, impacts(row));
        let lengths = || 1..=big_n;
        let short = 2..=most.min(big_n);
        let over = |list: &[u64], lengths: std::ops::RangeInclusive<usize>| {
            let own: u64 = lengths.clone().map(|k| list[k - 1]).sum();
            own as f64 / lengths.map(|k| equal(big_n, k)).sum::<f64>()
        };
        let mean = |list: &[u64]| {
            lengths().map(|k| k as f64 * list[k - 1] as f64).sum::<f64>() / sum(list)
        };
        let weight = lengths().map(|k| equal(big_n, k)).sum::<f64>();
        let length = lengths().map(|k| k as f64 * equal(big_n, k)).sum::<f64>() / weight;
        // Of the gaps but the first, none of those beside it: one at the ends of the chain, two elsewhere.
        let avoid = |k: usize| {
            let inner = (big_n - 2) as f64 * choose(big_n.saturating_sub(3), k - 1);
            (inner + 2.0 * choose(big_n - 2, k - 1)) / (big_n as f64 * choose(big_n - 1, k - 1))
        };
        let avoiding: f64 = short.clone().map(|k| equal(big_n, k) * avoid(k)).sum();
        let passing = 1.0 - avoiding / short.clone().map(|k| equal(big_n, k)).sum::<f64>();
        let passed = row.passing as f64 / sum(&row.circuits[1..most.min(big_n)]);
        let ways = choose(big_n, 2);
        let [pairs, same] = row.returns.map(|n| n as f64);
        is("loops", row.loops, over(&row.circuits, 1..=1) / all)
            .or_else(|| is("short circuits", row.short, over(&row.circuits, short.clone()) / all))
            .or_else(|| is("short ones", row.short_markov, over(&row.markov, short.clone()) / all))
            .or_else(|| is("a mean length", row.length, mean(&row.circuits)))
            .or_else(|| is("a mean length", row.length_markov, mean(&row.markov)))
            .or_else(|| far("the length of equal gaps", row.length_uniform, length))
            .or_else(|| far("passing by chance", row.passing_independent, passing))
            .or_else(|| is("passing", row.passing_share, passed))
            .or_else(|| is("collisions", row.collisions, ways * same / pairs))
            .or_else(|| {
                row.step?;
                let ratio = over(&row.circuits, 8..=10) / over(&row.circuits, 2..=4);
                is("a step", row.step, f_exp(f_log(ratio) / 6.0))
            })
    })
}

/// Different gaps: measured from their sums, independent ones by logarithms.
fn different(look: Look<'_>) -> Option<String> {
    let missed = |share: f64, m: f64| {
        if share < 1.0 { f_exp(m * f_log(1.0 - share)) } else { 0.0 }
    };
    let one = |row: &Dependence, own: &Distinct| {
        let (m, n, blocks) = (own.impacts as f64, row.gaps as f64, sum(&own.blocks));
        let free = |hits: &Vec<u64>| -> f64 {
            hits.iter().map(|&h| 1.0 - missed(h as f64 / sum(hits), m)).sum()
        };
        let free: f64 =
            row.hits.iter().zip(&own.blocks).map(|(hits, &b)| free(hits) * b as f64).sum();
        is("different gaps", own.mean, own.different as f64 / blocks)
            .or_else(|| is("those of the matrix", own.markov, own.different_markov as f64 / blocks))
            .or_else(|| is("those of frequencies", own.frequencies, free / blocks))
            .or_else(|| far("those of equal gaps", own.uniform, n * (1.0 - missed(1.0 / n, m))))
    };
    found(look)?.rows.iter().find_map(|row| row.distinct.iter().find_map(|own| one(row, own)))
}

/// The text speaks of rows of the table.
fn tabled(look: Look<'_>) -> Option<String> {
    let found = found(look)?;
    let letters = || ["a", "b", "c"].into_iter();
    let is = |letter: &str, row: &Dependence| {
        let cell = |name: &str| look.number(&format!("independence.{letter}_{name}"));
        cell("masses") == Some(row.row.masses as f64) && cell("sigma") == Some(row.row.sigma)
    };
    let missing = letters().find(|letter| !found.rows.iter().any(|row| is(letter, row)));
    let at = |row: &Dependence| match letters().find(|letter| is(letter, row)) {
        Some(letter) => cells(look, row, letter).or_else(|| told(look, row, letter)),
        None => {
            let line = line(row.row.sigma);
            cells(look, row, &format!("n{}_{line}", row.row.masses))
        }
    };
    missing
        .map(|letter| format!("no row is that of independence.{letter}_masses and its sigma"))
        .or_else(|| found.rows.iter().find_map(at))
}

/// Cells that are per cents, and those that say which row it is.
fn cells(look: Look<'_>, row: &Dependence, key: &str) -> Option<String> {
    let cell = |name: &str| format!("independence.{key}_{name}");
    let dependence = (row.information?.value - row.shuffled?.value) / row.entropy?.value;
    look.is(&cell("masses"), row.row.masses as f64)
        .or_else(|| look.is(&cell("sigma"), row.row.sigma))
        .or_else(|| look.is(&cell("dependence"), 100.0 * dependence))
        .or_else(|| look.is(&cell("same"), 100.0 * row.next[1] as f64 / sum(&row.next)))
}

/// What the text says of a row beside its cells.
fn told(look: Look<'_>, row: &Dependence, letter: &str) -> Option<String> {
    let named = |name: &str| format!("independence_{name}_{letter}");
    let departure =
        |distance: usize| (row.distances[distance] as f64 / expected(row, distance) - 1.0).abs();
    let far = || (IndependenceParams::FAR..row.near.len()).map(departure).fold(0.0, f64::max);
    let loops = row.loops?.value * impacts(row) / row.gaps as f64;
    look.is(&named("impacts"), impacts(row))
        .or_else(|| look.is(&named("loops"), loops))
        .or_else(|| look.is(&named("same_independent"), 100.0 * row.same_independent?.value))
        .or_else(|| match letter {
            "b" => look
                .are([("independence_gaps", row.gaps as f64), ("independence_far_b", far())])
                .or_else(|| look.is("independence_far_from", IndependenceParams::FAR as f64)),
            _ => None,
        })
}

/// Circuits by Eq. (7), classes as sets that are not empty, and the mean over sets.
fn orders(look: Look<'_>) -> Option<String> {
    let found = found(look)?;
    let n = found.orders.vertices;
    let circuits = (1..=n).map(|k| f_exp(model::log_simple(n, k))).sum();
    let classes = (1..=n).map(|k| choose(n, k)).sum();
    let scalars = &look.results.theory.scalars;
    let (big_n, log_p) = (look.results.theory.vertices, f_log(scalars.p_jump));
    let weight = |k: usize| choose(big_n, k) * f_exp(k as f64 * log_p);
    let all: f64 = (1..=big_n).map(weight).sum();
    let mean = (1..=big_n).map(|k| k as f64 * weight(k)).sum::<f64>() / all;
    look.are([
        ("orders_circuits", circuits),
        ("orders_classes", classes),
        ("mean_without_orders", mean),
    ])
}
