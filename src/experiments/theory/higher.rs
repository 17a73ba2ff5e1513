//! Computes what circuits that repeat vertices change: Sec. 9, Figs. 13 and 14.

use super::basics::*;
use super::census::counted;
use super::comparison::interpolate;
use super::law::{law, means, simple};
use impact_circuits::higher_order::{CLASSES, SHARED, doubled_as_printed, multiplicity};
use impact_numerics::double_double::DoubleDouble;

/// Returns P(X = k) of five classes, k = 1..=N.
pub fn five(p: f64) -> Vec<f64> {
    law(FiveClasses, p).probabilities()
}

/// Returns the parts of the five classes in P(X = k), in the order of Eq. (38).
pub fn contributions(p: f64) -> [Vec<f64>; 5] {
    CLASSES.map(|class| law(FiveClasses, p).contribution(&class))
}

/// Returns half the sum of the absolute differences of two distributions.
fn total_variation(a: &[f64], b: &[f64]) -> f64 {
    0.5 * sum(a.iter().zip(b).map(|(a, b)| (a - b).abs()))
}

/// Returns the least total variation between two distributions if the first is moved down by up to
/// ten k in steps of a hundredth; between whole k its values lie on straight lines.
fn apart_in_shape(a: &[f64], b: &[f64]) -> f64 {
    let value = |k: usize| a.get(k).copied().unwrap_or(0.0);
    let moved = |hundredths: usize| {
        let (by, share) = (hundredths / 100, (hundredths % 100) as f64 / 100.0);
        // Before the first and beyond the last k as well.
        let lost = (0..=by).map(|k| if k < by { value(k) } else { share * value(k) });
        let shifted = |k: usize| (1.0 - share) * value(k + by) + share * value(k + by + 1);
        let overlap = b.iter().enumerate().map(|(k, b)| (shifted(k) - b).abs());
        0.5 * (sum(lost) + sum(overlap))
    };
    (0..=1000).map(moved).fold(f64::INFINITY, f64::min)
}

/// Returns the weight of circuits with one doubled vertex over simple ones, to first order.
fn first_order(p: &f64) -> f64 {
    let higher = (1_u32..).zip(simple(*p)).skip(1);
    sum(higher.map(|(k, q)| q * p * f64::from(k) * f64::from(k) / 2.0))
}

pub(super) fn classes() -> Table {
    const VARIATION: &str = "distance from the distribution of simple circuits";
    const SHAPE: &str = "the same with one moved onto the other";
    const FIRST_ORDER: &str = "weight of one doubled vertex, to first order in p";
    let share = |p: &f64| sum(law(FiveClasses, *p).contribution(&CLASSES[0]));
    let difference = |p: &f64| law(FiveClasses, *p).mean() - law(Simple, *p).mean();
    Table::builder("theory.classes", &REMARK_P, |_| 0)
        .key("p", "1", |p| *p)
        .real("simple", "1", 2, "share of simple circuits", share)
        .computed_by(origin(contributions), &["simple"])
        .real("variation", "1", 2, VARIATION, |p| total_variation(&five(*p), &simple(*p)))
        .computed_by(origin(total_variation), &["variation"])
        .real("shape", "1", 2, SHAPE, |p| apart_in_shape(&five(*p), &simple(*p)))
        .computed_by(origin(apart_in_shape), &["shape"])
        .real("mean_difference", "1", 2, "μ less that of simple circuits", difference)
        .computed_by(origin(Law::mean), &["mean_difference"])
        .real("first_order", "1", 2, FIRST_ORDER, first_order)
        .done()
}

/// Returns the p at which the two means differ most in proportion, and both there.
fn means_apart() -> [f64; 3] {
    let rows = means().into_iter().map(|(p, mean)| [p, mean, law(FiveClasses, p).mean()]);
    let share = |[_, mean, higher]: [f64; 3]| (higher / mean - 1.0).abs();
    rows.fold([0.0, 1.0, 1.0], |most, row| if share(row) > share(most) { row } else { most })
}

/// Returns the largest change of μ(p(σ)) by higher orders, and the σ where it is.
fn largest_change(curve: &Table) -> [f64; 2] {
    let column = |name| curve.curve(&[], "sigma", name).unwrap_or_default();
    let [simple, higher] = ["simple", "higher"].map(column);
    simple.iter().zip(higher).fold([0.0, 0.0], |most, ((sigma, simple), (_, higher))| {
        let change = (higher - simple).abs();
        if change > most[0] { [change, *sigma] } else { most }
    })
}

/// Returns the weight of circuits with one doubled vertex over that of simple ones, at k = ⌊μ⌋.
fn doubling(p: f64) -> f64 {
    let law = law(FiveClasses, p);
    let weight = |class| law.contribution(class)[law.mean() as usize - 1];
    weight(&CLASSES[1]) / weight(&CLASSES[0])
}

/// Circuits of five classes for each simple one, if one weighs p^k by its k different vertices.
fn multiplicities() -> Vec<f64> {
    (1..=VERTICES).map(|k| multiplicity(FiveClasses, DoubleDouble::ONE, k).to_f64()).collect()
}

/// Weights of k = 1..=N in proportion to P(X = k) of five classes, with such a p.
fn by_different(p: f64, more: &[f64]) -> Vec<f64> {
    simple(p).iter().zip(more).map(|(q, more)| q * more).collect()
}

/// Whether, if a circuit weighs p^k by its k different vertices, each k + 1 overtakes k at a larger
/// p than k overtook k − 1.
pub(crate) fn overtaken_in_order() -> bool {
    by_different(1.0, &multiplicities()).windows(3).all(|w| w[0] / w[1] < w[1] / w[2])
}

/// Returns the share of simple circuits in the distribution of [`by_different`].
fn simple_by_different(p: f64) -> f64 {
    f64::from(SHARED as u32) * sum(simple(p)) / sum(by_different(p, &multiplicities()))
}

/// Returns the largest step of k* in the distribution of [`by_different`], on a grid of p in steps
/// of 1/100 000 up to 0.04.
fn largest_step() -> u64 {
    // Each k has the same p^k in all its weights.
    let logs = Vec::from_iter(by_different(1.0, &multiplicities()).into_iter().map(pxfm::f_log));
    let top = |i: u32| {
        let log_p = pxfm::f_log(f64::from(i) / 1e5);
        let weights = (1_u32..).zip(&logs).map(|(k, log)| (k, log + f64::from(k) * log_p));
        weights.fold((1, f64::NEG_INFINITY), |most, one| if one.1 > most.1 { one } else { most }).0
    };
    let ks: Vec<u32> = (0..=4000).map(top).collect();
    ks.windows(2).map(|w| u64::from(w[1].abs_diff(w[0]))).max().unwrap_or(0)
}

/// Makes the table of single numbers of Sec. 9, some by `theory.curve` and `theory.relation`.
pub(super) fn higher(curve: &Table, relation: &Table) -> Table {
    const SHIFT: &str = "relative shift of it with the printed formulas";
    const FROM: &str = "k from which on p k²/2 is one or more, smallest p of Fig. 13";
    const STEP: &str = "largest step of k* with a p for each different impact";
    const DOUBLING: &str = "weight of one doubled vertex, largest p of Fig. 13";
    const SIMPLE: &str = "simple ones there, a p a different impact";
    const APART: &str = "p at which the means differ most in proportion";
    let eq30 = doubled_as_printed(3, 3);
    let counted = counted(3, 3, &[1]) as u64;
    let jump = |space| expect_known(jump::p_jump(space, VERTICES));
    let (leap, shifted) = (jump(FiveClasses), jump(FiveClassesPrinted).p);
    let [first, _, last] = HIGHER_P;
    // From this k on p k²/2 is at least one.
    let tail = (2.0 / first).sqrt().ceil() as usize;
    let weight = sum(five(first).into_iter().skip(tail - 1));
    let ([at, mean, more], [change, change_at]) = (means_apart(), largest_change(curve));
    let sigma_of = |column| relation.number(&[], column).unwrap_or(f64::NAN);
    let half_shift = sigma_of("sigma_half") - sigma_of("sigma_half_higher");
    // Where simple circuits have the μ that higher orders have at the σ of the largest change.
    let curve = |name| curve.curve(&[], "sigma", name).unwrap_or_default();
    let inverse: Vec<_> = curve("simple").into_iter().map(|(sigma, mean)| (mean, sigma)).collect();
    let shifted_to = || interpolate(&inverse, interpolate(&curve("higher"), change_at)?);
    let shift_there = || Some((shifted_to()? - change_at).abs());
    let shift = |column| (sigma_of(column) - sigma_of("sigma_jump")).abs();
    let over = shift("sigma_jump_rest") / shift("sigma_jump_higher");
    Table::builder("theory.higher", &[()], |()| 0)
        .real("eq30_printed", "1", 1, "Eq. (30) as printed, k = N = 3", |()| eq30)
        .computed_by(origin(doubled_as_printed), &["eq30_printed"])
        .count("eq30_counted", "circuits that it should count", |()| counted)
        .computed_by(origin(counted), &["eq30_counted"])
        .real("p_jump", "1", 5, "p_jump with five classes", |()| leap.p)
        .count("k_after", "k* after it", |()| leap.k_after as u64)
        .real("printed_shift", "1", 1, SHIFT, |()| shifted / leap.p - 1.0)
        .computed_by(origin(jump::p_jump), &["p_jump", "k_after", "printed_shift"])
        .count("tail_from", FROM, |()| tail as u64)
        .real("simple_by_different", "1", 2, SIMPLE, |()| simple_by_different(first))
        .computed_by(origin(simple_by_different), &["simple_by_different"])
        .count("step_by_different", STEP, |()| largest_step())
        .computed_by(origin(largest_step), &["step_by_different"])
        .real("tail_weight", "1", 1, "probability of these k", |()| weight)
        .computed_by(origin(five), &["tail_weight"])
        .real("doubling", "1", 3, DOUBLING, |()| doubling(last))
        .computed_by(origin(doubling), &["doubling"])
        .chosen("means_apart_at", "1", APART, |()| Some(at))
        .real("means_apart", "1", 2, "by so much", |()| more - mean)
        .real("means_ratio", "1", 2, "in proportion", |()| more / mean - 1.0)
        .computed_by(origin(means_apart), &["means_apart_at", "means_apart", "means_ratio"])
        .real("change", "1", 2, "largest change of μ over σ", |()| change)
        .chosen("change_at", SIGMA, "σ of it", |()| Some(change_at))
        .computed_by(origin(largest_change), &["change", "change_at"])
        .real("half_shift", SIGMA, 1, "shift of σ at which μ is (N + 1)/2", |()| half_shift)
        .real("shift_there", SIGMA, 2, "shift of the curve there", |()| shift_there())
        .real("relation_over", "1", 2, "shift of the jump from rest over that by orders", |()| over)
        .done()
}
