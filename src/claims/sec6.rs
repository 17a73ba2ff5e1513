//! Section 6: probability.

use super::judge::*;
use super::sec2;
use crate::params::{DISTRIBUTION_P, VERTICES};

pub const ROWS: &[Judge] = &[
    defined("sec6_normalised").of("{}"),
    by("sec6_fig8_few", OurMeasure, few),
    by("sec6_fig8_rise", OurMeasure, rise),
    by("sec6_fig9_step", OurMeasure, step),
    by("sec6_mean_zero", Exact, mean_zero).of("μ(0) = {}"),
    by("sec6_like_simulation", OurMeasure, like_simulation),
];

fn few(e: &Evidence, s: &Statement) -> Judged {
    let p = DISTRIBUTION_P[0];
    let row = format!("theory.distribution[p={p}]");
    let [mean, k_star] = e.numbers(&row, ["mean", "k_star"])?;
    let limit = VERTICES as f64 / sec2::VERY_FEW;
    let found = Text::of(
        "μ = {}, k* = {} at p = {}",
        [significant(mean, 4), integer(k_star as usize), chosen(p)],
    );
    Ok(s.found(found, mean <= limit && k_star == 1.0).within(
        Text::of("at most {}", [significant(limit, 2)]),
        "ours: “very few” as a twentieth of all vertices",
    ))
}

fn rise(e: &Evidence, s: &Statement) -> Judged {
    let [a, _, c, _] = DISTRIBUTION_P;
    let mean = |p: f64| e.number(&format!("theory.distribution[p={p}].mean"));
    let (few, many, n) = (mean(a)?, mean(c)?, VERTICES as f64);
    let found = Text::of(
        "μ from {} to {} while p goes from {} to {}",
        [significant(few, 3), significant(many, 3), chosen(a), chosen(c)],
    );
    Ok(s.found(found, few < 0.1 * n && many > 0.75 * n).within(
        "from below a tenth to above three quarters of N",
        "ours: what “rapidly towards the size of the whole system” asks at least",
    ))
}

fn step(e: &Evidence, s: &Statement) -> Judged {
    let [largest, second] = e.numbers("theory.mean", ["largest_step", "other_steps"])?;
    let found = Text::of(
        "one step of height {}, all others {}",
        [largest, second].map(|step| integer(step as usize)),
    );
    Ok(s.found(found, largest * 10.0 >= VERTICES as f64 && second == 1.0).within(
        "one step of ten or more, all others of one",
        "ours: “large” as at least a tenth of N; a step function of integers has ones",
    ))
}

fn mean_zero(e: &Evidence, s: &Statement) -> Judged {
    let least = e.number("theory.mean.at_zero")?;
    let found = Text::of("μ = {} as p → 0+", [significant(least, 1)]);
    Ok(s.found(found, least == s.number()?).within("none", "an integer is exact").explained(
        "At p = 0 Eq. (9) is 0/0. As p goes to zero the circuits of one edge hold all the weight, and μ goes to one; zero \
         is the number of a graph without edges.",
        least == 1.0,
    ))
}

/// From below a quarter of all gaps to above nine tenths.
pub(super) fn rises([low, high]: [f64; 2]) -> bool {
    low < 0.25 && high > 0.9
}

/// The least and the largest mean of the simulation that have an error, over all gaps, and those of the theory, over N.
pub(super) fn ends(e: &Evidence) -> Result<[[f64; 2]; 2], Error> {
    let means = e.sweep()?.first().rows.iter().filter_map(|row| row.mean?.estimate());
    let means: Vec<f64> = means.map(|mean| mean.value).collect();
    let gaps = e.gaps()?;
    let first = some(means.iter().copied().reduce(f64::min))? / gaps;
    let last = means.iter().copied().fold(0.0, f64::max) / gaps;
    let theory = e.numbers("theory.mean", ["at_zero", "at_one"])?;
    Ok([[first, last], theory.map(|mean| mean / VERTICES as f64)])
}

pub(super) const RISES: &str = "both from below a quarter to above nine tenths";

fn like_simulation(e: &Evidence, s: &Statement) -> Judged {
    let both = ends(e)?;
    let shares = both.iter().flatten().map(|share| significant(*share, 2));
    let text = "simulated from {} to {} of N, theory from {} to {}; k* jumps";
    let jumps = e.cases(s)?[1] == 0 && e.number("theory.jump.k_after")? > 1.0;
    Ok(s.found(Text::of(text, shares), both.into_iter().all(rises) && jumps)
        .within(RISES, "ours: the least that a common rise must do")
        .note(
            "Simulated is the mean of the realisations with at least one impact. What agrees beyond this is judged in \
             Section 8.",
        ))
}
