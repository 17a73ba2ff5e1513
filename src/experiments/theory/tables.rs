//! The numbers of Secs. 3 to 9 and of what goes beyond them, as tables.

use super::distributions::sum;
use super::{Curve, HigherDistribution, MeanRow, Step, Theory, large};
use crate::experiments::identities::{self, Identities, relation::sigma_kept};
use crate::experiments::{Results, theory};
use crate::params::Chain;
use impact_circuits::distribution::Law;
use impact_circuits::graph::Graph;
use impact_circuits::impact_probability::ImpactProbability;
use impact_circuits::{commuting, counting, jump};
use literate::table::{Building, Table};
use literate::value::{Origin, origin};

/// All tables of the theory.
pub fn tables(results: &Results, _: &[Table]) -> Option<Vec<Table>> {
    let (theory, identities) = (&*results.theory, &*results.identities);
    let mut tables = vec![
        graph(identities),
        lengths(theory, identities),
        distributions(theory),
        mean(theory),
        jumping(theory, identities),
        first_maximum(theory),
        relation(theory, identities),
        gaps(identities),
        classes(theory),
        higher(theory, identities),
    ];
    tables.extend(many_vertices(theory));
    tables.push(commuting_circuits(theory));
    Some(tables)
}

/// A table of one row.
fn one(name: &'static str, item: Origin) -> Building<'static, ()> {
    Table::of(name, &[()], |()| 0).computed_by(item)
}

/// Sec. 3.
fn graph(id: &Identities) -> Table {
    one("theory.graph", origin(Graph::of_chain))
        .count("vertices", "of the graph for three masses", |()| id.graph_vertices as u64)
        .count("edges", "of the same", |()| id.graph_edges as u64)
        .done()
}

/// Sec. 5.
fn lengths(theory: &Theory, id: &Identities) -> Table {
    let slips = &theory.slips;
    one("theory.lengths", origin(counting::ratio_to_longest))
        .real("before_last", "1", 4, "Eq. (8) at k = N − 1", |()| slips.ratio_before_last)
        .count(
            "exceptions",
            "lengths k < N with more than a tenth of the circuits of length N",
            |()| id.eq8_exceptions.len() as u64,
        )
        .computed_by(origin(counting::shares))
        .count("peak", "the most frequent length", |()| slips.longest_peak as u64)
        .count("from", "N − 3", |()| theory.vertices as u64 - 3)
        .real("share", "1", 2, "of simple circuits that are as long or longer", |()| {
            slips.share_near_end
        })
        .done()
}

/// Fig. 8.
fn distributions(theory: &Theory) -> Table {
    Table::of("theory.distribution", &theory.distributions, |_| 0)
        .computed_by(origin(Law::mean))
        .key("p", "1", |found| found.p)
        .real("mean", "1", 3, "μ", |found| found.mean)
        .done()
}

/// The p at which μ passes `level`, linear between rows.
fn crossing(rows: &[MeanRow], level: f64) -> Option<f64> {
    let w = rows.windows(2).find(|w| w[0].mean < level && level <= w[1].mean)?;
    Some(w[0].p + (w[1].p - w[0].p) * (level - w[0].mean) / (w[1].mean - w[0].mean))
}

/// The steps of k*(p) upwards: the largest, the second largest.
pub(crate) fn two_largest_steps(steps: &[Step]) -> [usize; 2] {
    let mut heights: Vec<usize> =
        steps.windows(2).map(|w| w[1].k_star.saturating_sub(w[0].k_star)).collect();
    heights.sort_unstable_by(|a, b| b.cmp(a));
    [heights.first().copied().unwrap_or(0), heights.get(1).copied().unwrap_or(0)]
}

/// Fig. 9.
fn mean(theory: &Theory) -> Table {
    let found = &theory.most_likely;
    let [largest, second] = two_largest_steps(&found.steps);
    let p_at = |share: f64| {
        let rows = [&found.mean_inset, &found.mean];
        let level = share * theory.vertices as f64;
        rows.into_iter().find_map(|rows| crossing(rows, level)).unwrap_or(1.0)
    };
    one("theory.mean", origin(two_largest_steps))
        .count("largest_step", "of k*", |()| largest as u64)
        .count("other_steps", "the second largest step of k*", |()| second as u64)
        .computed_by(origin(Law::mean))
        .real("at_zero", "1", 1, "μ for p → 0", |()| theory.slips.mean_at_zero)
        .computed_by(origin(crossing))
        .real("p_tenth", "1", 3, "p at which μ is N/10", |()| p_at(0.1))
        .real("p_nine_tenths", "1", 2, "p at which μ is 9 N/10", |()| p_at(0.9))
        .done()
}

/// Sec. 7.
fn jumping(theory: &Theory, id: &Identities) -> Table {
    let (scalars, walls) = (&theory.scalars, &theory.scalars_walls);
    one("theory.jump", origin(jump::p_crit))
        .real("p_crit", "1", 5, "Eq. (18)", |()| scalars.p_crit)
        .real("p_crit_walls", "1", 5, "the same for N + 1", |()| walls.p_crit)
        .real("k_touch", "1", 4, "double zero of f at p_crit", |()| id.k_touch)
        .computed_by(origin(jump::p_jump))
        .real("p_jump", "1", 5, "p at which k* leaves 1", |()| scalars.p_jump)
        .count("k_after", "k* after it", |()| scalars.k_after_jump as u64)
        .real("after_crit", "1", 2, "p_jump/p_crit − 1", |()| {
            scalars.p_jump / scalars.p_crit - 1.0
        })
        .computed_by(origin(Law::k_star))
        .count("k_before", "k* half way from p_crit to p_jump", |()| {
            id.k_star_before_jump[1] as u64
        })
        .count("k_at_one", "k* at p = 1", |()| theory.slips.k_star_at_one as u64)
        .done()
}

fn first_maximum(theory: &Theory) -> Table {
    let first = &theory.slips.first_local_maximum;
    one("theory.first_maximum", origin(jump::first_local_maximum))
        .count("numerator", "of p", |()| first.numerator)
        .count("denominator", "of p", |()| first.denominator)
        .real("p", "1", 5, "where Φ first has a local maximum beyond k = 1", |()| first.p)
        .count("k", "where it is", |()| first.k as u64)
        .count("k_next", "where it is as well", |()| first.k as u64 + 1)
        .done()
}

/// Sec. 8.
fn relation(theory: &Theory, id: &Identities) -> Table {
    let (own, walls) = (&theory.scalars, &theory.scalars_walls);
    let sigma = "d omega^2";
    one("theory.relation", origin(theory::jump::scalars))
        .real("sigma_jump", sigma, 4, "σ at which p is p_jump", |()| own.sigma_jump)
        .real("sigma_jump_walls", sigma, 4, "the same for N + 1", |()| walls.sigma_jump)
        .real("sigma_jump_rest", sigma, 4, "from rest", |()| own.sigma_jump_rest)
        .real("sigma_half", sigma, 4, "σ at which μ is (N + 1)/2", |()| own.sigma_half)
        .real("sigma_half_rest", sigma, 4, "from rest", |()| own.sigma_half_rest)
        .computed_by(origin(identities::relation::eq25))
        .real("difference", "1", 1, "Eq. (25) less its double integral, relative", |()| id.eq25)
        .computed_by(origin(sigma_kept))
        .real(
            "sigma_kept_half",
            sigma,
            3,
            "σ at which half of the chains have a gap that closes by itself",
            |()| id.sigma_kept_half,
        )
        .real("sigma_kept_onset", sigma, 3, "σ at which enough have one for the onset", |()| {
            id.sigma_kept_onset
        })
        .computed_by(origin(identities::relation::overlap))
        .chosen("overlap_sigma", sigma, "of random starts", |()| Some(id.overlap_sigma))
        .real("overlap_share", "1", 2, "starts that overlap, over p", |()| id.overlap_share)
        .done()
}

/// Gaps that close by themselves.
fn gaps(id: &Identities) -> Table {
    let all = Chain::default().gaps() as f64;
    Table::of("theory.gap", &id.nucleation, |_| 0)
        .key("sigma", "d omega^2", |own| own.sigma)
        .computed_by(origin(ImpactProbability::p))
        .real("p", "1", 3, "Eq. (25)", |own| own.p)
        .computed_by(origin(ImpactProbability::p_from_rest))
        .real("p_rest", "1", 3, "the same from rest", |own| own.p_rest)
        .real("ratio", "1", 2, "p_rest/p", |own| own.p_rest / own.p)
        .real("expected", "1", 2, "gaps that close by themselves, from rest", |own| {
            all * own.p_rest
        })
        .computed_by(origin(identities::relation::any))
        .real("any_rest", "1", 3, "probability that one does", |own| own.any_rest)
        .done()
}

/// Sec. 9, Figs. 13 and 14.
fn classes(theory: &Theory) -> Table {
    let panels: Vec<&HigherDistribution> =
        theory.higher.iter().chain(&theory.convergence).collect();
    Table::of("theory.classes", &panels, |_| 0)
        .computed_by(origin(theory::distributions::higher))
        .key("p", "1", |own| own.p)
        .real("simple", "1", 2, "share of simple circuits", |own| own.classes[0].share)
        .real("variation", "1", 2, "distance from the distribution of simple circuits", |own| {
            own.total_variation
        })
        .real("mean_difference", "1", 2, "μ less that of simple circuits", |own| {
            own.mean - own.mean_simple
        })
        .done()
}

/// The largest relative difference of the two means, and the p where it is.
pub(crate) fn largest_mean_difference(theory: &Theory) -> [f64; 2] {
    theory.most_likely.mean_inset.iter().fold([0.0, 0.0], |most, row| {
        let difference = (row.mean_higher / row.mean - 1.0).abs();
        if difference > most[0] { [difference, row.p] } else { most }
    })
}

/// Weight of circuits with one doubled vertex over that of simple ones, with k different vertices.
fn doubling(panel: &HigherDistribution, k: usize) -> f64 {
    let class = |i: usize| panel.classes[i].probability[k - 1];
    class(1) / class(0)
}

/// The largest change of the expected number by higher orders, and the σ where it is.
pub(crate) fn largest_change(curve: &Curve) -> [f64; 2] {
    curve.rows.iter().fold([0.0, 0.0], |most, row| {
        let change = (row.higher - row.simple).abs();
        if change > most[0] { [change, row.sigma] } else { most }
    })
}

/// How far the jump moves in σ: by the relation for a start from rest, and by higher orders.
pub(crate) fn moves(theory: &Theory) -> [f64; 2] {
    let scalars = &theory.scalars;
    [
        (scalars.sigma_jump_rest - scalars.sigma_jump).abs(),
        (scalars.higher_sigma_jump - scalars.sigma_jump).abs(),
    ]
}

fn higher(theory: &Theory, id: &Identities) -> Table {
    let scalars = &theory.scalars;
    let (first, last) = (&theory.higher[0], &theory.higher[theory.higher.len() - 1]);
    let eq33 = id.classes.iter().find(|class| class.equation == 33);
    // From this k on p k²/2 is at least one.
    let tail_from = (2.0 / first.p).sqrt().ceil() as usize;
    let [_, at] = largest_mean_difference(theory);
    let small = theory.most_likely.mean_inset.iter().find(|row| row.p == at);
    let [change, change_at] = largest_change(&theory.curve);
    let [relation, by_higher] = moves(theory);
    one("theory.higher", origin(identities::run))
        .real("eq30_printed", "1", 1, "Eq. (30) as printed, k = N = 3", |()| id.eq30_printed)
        .count("eq30_counted", "circuits that it should count", |()| id.eq30_counted)
        .real("eq33_printed", "1", 2, "Eq. (33), k = 2 and N = 3", |()| {
            eq33.map_or(f64::NAN, |class| class.formula_below)
        })
        .count("eq33_counted", "circuits that it should count", |()| {
            eq33.map_or(0, |class| class.counted_below)
        })
        .computed_by(origin(jump::p_jump))
        .real("p_jump", "1", 5, "p_jump with five classes", |()| scalars.higher_p_jump)
        .count("k_after", "k* after it", |()| scalars.higher_k_after_jump as u64)
        .real("printed_shift", "1", 1, "relative shift of it with the printed formulas", |()| {
            scalars.printed_p_jump / scalars.higher_p_jump - 1.0
        })
        .computed_by(origin(theory::distributions::higher))
        .count("tail_from", "k from which on p k²/2 is one or more, smallest p of Fig. 13", |()| {
            tail_from as u64
        })
        .real("tail_weight", "1", 1, "probability of these k", |()| {
            sum(first.total.iter().skip(tail_from - 1).copied())
        })
        .real(
            "doubling",
            "1",
            3,
            "weight of one doubled vertex, largest p of Fig. 13, k = μ",
            |()| doubling(last, last.mean as usize),
        )
        .computed_by(origin(largest_mean_difference))
        .chosen("means_apart_at", "1", "p at which the means differ most in proportion", |()| {
            Some(at)
        })
        .real("means_apart", "1", 2, "by so much", |()| {
            small.map_or(0.0, |row| row.mean_higher - row.mean)
        })
        .computed_by(origin(largest_change))
        .real("change", "1", 2, "largest change of μ over σ", |()| change)
        .chosen("change_at", "d omega^2", "σ of it", |()| Some(change_at))
        .real("half_shift", "d omega^2", 1, "shift of σ at which μ is (N + 1)/2", |()| {
            scalars.sigma_half - scalars.higher_sigma_half
        })
        .computed_by(origin(moves))
        .real(
            "relation_over",
            "1",
            2,
            "shift of the jump by the start from rest over that by higher orders",
            |()| relation / by_higher,
        )
        .done()
}

/// Many vertices.
fn many_vertices(theory: &Theory) -> [Table; 2] {
    let large = &theory.large;
    let item = || origin(large::large);
    let jumps = Table::of("theory.large", &large.jumps, |_| 0)
        .computed_by(item())
        .key("n", "1", |own| own.vertices as f64)
        .real("vertices", "1", 1, "N", |own| own.vertices as f64)
        .count("k_after", "k* after the jump", |own| own.k_after as u64)
        .real("share", "1", 2, "k*/N after the jump", |own| own.share)
        .real("rule", "1", 4, "root of k² = 2 N (ln k − 1)", |own| own.rule.unwrap_or(f64::NAN))
        .real("p_n", "1", 5, "N p_jump", |own| own.p_n)
        .done();
    let sigma = one("theory.large_relation", item())
        .real("sigma_jump", "d omega^2", 3, "σ of the jump at the largest N", |()| {
            large.sigma_jump
        })
        .done();
    [jumps, sigma]
}

/// Gaps of the chain whose simple circuits are enumerated.
const ENUMERATED: usize = 7;

/// Simple circuits that differ only by the order of impacts without a common mass.
fn commuting_circuits(theory: &Theory) -> Table {
    let [circuits, classes] = commuting::simple_classes(ENUMERATED);
    one("theory.commuting", origin(commuting::simple_classes))
        .count("gaps", "gaps of a chain", |()| ENUMERATED as u64)
        .count("circuits", "simple circuits", |()| circuits as u64)
        .count("classes", "of them that a mass tells apart", |()| classes as u64)
        .computed_by(origin(commuting::mean_without_orders))
        .real("mean", "1", 2, "mean number at the jump, each class with p^k once", |()| {
            commuting::mean_without_orders(theory.vertices, theory.scalars.p_jump)
        })
        .done()
}
