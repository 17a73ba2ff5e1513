//! Sec. 9: circuits of higher order, by sequences and by listing.

use super::model::{Law, variation};
use super::{Guard, Look, far, unless};
use std::collections::BTreeSet;

pub const GUARDS: &[Guard] = &[
    Guard { name: "circuits_listed", ids: &["eq30_*", "eq33_*"], find: listed },
    Guard { name: "shares_of_simple", ids: &["simple_share_*"], find: shares },
    Guard {
        name: "distributions_apart",
        ids: &["tv_a", "tv_b", "tail_weight", "tail_from", "doubling"],
        find: apart,
    },
    Guard { name: "means_apart", ids: &["mean_difference_*"], find: means },
    Guard {
        name: "equal_weights_at_higher_jump",
        ids: &["higher_p_jump", "higher_k_after_jump", "printed_jump_shift"],
        find: jump,
    },
];

/// How many primitive cyclic sequences of a length over so many letters have these numbers of visits
/// beyond the first, largest first: all sequences are listed.
fn count(letters: usize, length: usize, repeats: &[usize]) -> usize {
    let all = letters.pow(length as u32);
    let mut found = BTreeSet::new();
    for code in 0..all {
        let sequence: Vec<usize> = (0..length)
            .scan(code, |rest, _| Some(std::mem::replace(rest, *rest / letters) % letters))
            .collect();
        let turned = |by: usize| -> Vec<usize> {
            (0..length).map(|i| sequence[(i + by) % length]).collect()
        };
        if (1..length).any(|by| turned(by) == sequence) {
            continue;
        }
        let mut visits: Vec<usize> = (0..letters)
            .map(|letter| sequence.iter().filter(|&&own| own == letter).count())
            .filter(|&n| n > 1)
            .map(|n| n - 1)
            .collect();
        visits.sort_unstable_by(|a, b| b.cmp(a));
        if visits == repeats {
            found.extend((0..length).map(turned).min());
        }
    }
    found.len()
}

/// Circuits on three vertices with one of them twice, by listing all sequences: those of length three,
/// of which Eq. (30) as printed has one part in N, and those one shorter than Eq. (33) is right for.
fn listed(look: Look<'_>) -> Option<String> {
    let (big_n, length) = (3, 3);
    let three = count(big_n, length, &[1]) as f64;
    // (k − 1)/2 N!/(N − (k − 1))! at k = 2.
    let formula = 0.5 * big_n as f64;
    look.are([
        ("eq30_counted", three),
        ("eq30_printed", three / big_n as f64),
        ("eq33_counted", count(big_n, 2, &[1]) as f64),
        ("eq33_printed", formula),
    ])
}

/// The panels of Figs. 13 and 14 that the text quotes, by the letters of their values.
fn panels(look: Look<'_>) -> Option<[(&'static str, f64); 4]> {
    let theory = &look.results.theory;
    Some([
        ("simple_share_a", theory.higher.first()?.p),
        ("simple_share_b", theory.higher.get(1)?.p),
        ("simple_share_c", theory.convergence.first()?.p),
        ("simple_share_d", theory.higher.last()?.p),
    ])
}

/// Weights of the five classes by counting sequences: the share of those without a repeat.
fn shares(look: Look<'_>) -> Option<String> {
    let big_n = look.results.theory.vertices;
    let share = |p: f64| Law::new(big_n, p, true).share(0);
    panels(look)?.into_iter().find_map(|(id, p)| look.is(id, share(p)))
}

/// Distances of the distributions with and without higher orders, what remains where p k²/2 is one or
/// more, and how much more weight circuits with one vertex doubled have than simple ones.
fn apart(look: Look<'_>) -> Option<String> {
    let theory = &look.results.theory;
    let big_n = theory.vertices;
    let both = |p: f64| [true, false].map(|five| Law::new(big_n, p, five));
    let distance = |p: f64| {
        let [five, simple] = both(p);
        variation(&five, &simple)
    };
    let first = theory.higher.first()?.p;
    let from = look.number("tail_from")?;
    let tail: f64 = Law::new(big_n, first, true).whole().iter().skip(from as usize - 1).sum();
    let last = Law::new(big_n, theory.higher.last()?.p, true);
    let k = last.mean() as usize;
    let [simple, doubled, ..] = last.classes[k - 1];
    look.are([
        ("tv_a", distance(theory.convergence.first()?.p)),
        ("tv_b", distance(theory.convergence.last()?.p)),
        ("tail_weight", tail),
        ("doubling", doubled / simple),
    ])
    .or_else(|| {
        let one = |k: f64| first * k * k / 2.0;
        unless(one(from) >= 1.0 && one(from - 1.0) < 1.0, || {
            format!("p k²/2 does not pass one at k = {from}")
        })
    })
}

/// The means with and without higher orders, at a large p and where they differ most in proportion.
fn means(look: Look<'_>) -> Option<String> {
    let theory = &look.results.theory;
    let means = |p: f64| [true, false].map(|five| Law::new(theory.vertices, p, five).mean());
    let difference = |p: f64| {
        let [five, simple] = means(p);
        five - simple
    };
    let ratio = |p: f64| {
        let [five, simple] = means(p);
        five / simple
    };
    let at = look.number("mean_difference_at")?;
    let grid = &theory.most_likely.mean_inset;
    let place = grid.iter().position(|row| row.p == at);
    let Some(place) = place.filter(|&i| i > 0 && i + 1 < grid.len()) else {
        return Some(format!("mean_difference_at is {at}, which is no inner point of the inset"));
    };
    let beside = [grid[place - 1].p, grid[place + 1].p].map(ratio);
    look.are([
        ("mean_difference_large", difference(theory.higher.last()?.p)),
        ("mean_difference_small", difference(at)),
    ])
    .or_else(|| {
        let top = ratio(at);
        unless(beside.iter().all(|b| *b <= top), || format!("the means differ more beside {at}"))
    })
}

/// At the jump with higher orders the peak weighs as much as k = 1; with the printed formulas at every
/// length, which give the loops at one vertex N/2 p, N/3 p² and N/4 p³ too many, it comes earlier or later by the
/// share that is given.
fn jump(look: Look<'_>) -> Option<String> {
    let big_n = look.results.theory.vertices;
    let p = look.number("higher_p_jump")?;
    let law = Law::new(big_n, p, true);
    let (weights, peak) = (law.whole(), law.peak(2));
    far("the weight of the peak at higher_p_jump", weights[peak - 1], weights[0])
        .or_else(|| look.is("higher_k_after_jump", peak as f64))
        .or_else(|| {
            let p = p * (1.0 + look.number("printed_jump_shift")?);
            let weights = Law::new(big_n, p, true).whole();
            let loops = 1.0 + p / 2.0 + p * p / 3.0 + p * p * p / 4.0;
            far(
                "the weight of the peak by the printed formulas",
                weights[peak - 1],
                loops * weights[0],
            )
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Necklaces over two letters: of length 3 aab and abb, of length 4 aaab, abbb and aabb.
    #[test]
    fn listing_finds_necklaces() {
        assert_eq!(count(2, 3, &[1]), 2);
        assert_eq!(count(2, 4, &[2]), 2);
        assert_eq!(count(2, 4, &[1, 1]), 1);
        assert_eq!(count(3, 3, &[]), 2);
    }
}
