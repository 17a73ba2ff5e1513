//! Section 6: probability.

use super::judge::*;
use super::sec2;
use crate::params::{DISTRIBUTION_P, VERTICES};

pub const ROWS: &[Judge] = &[
    by("sec6_normalised", Rounding, |e, s| {
        let off = e.difference(s)?.max((s.number()? - 1.0).abs());
        Ok(s.rounding(off, 1e-13).note("Over ten values of p up to one."))
    }),
    by("sec6_fig8_few", OurMeasure, few),
    by("sec6_fig8_rise", OurMeasure, rise),
    by("sec6_fig9_step", OurMeasure, step),
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

fn like_simulation(e: &Evidence, s: &Statement) -> Judged {
    let rows = &e.sweep()?.first().rows;
    let mut simulated = rows.iter().filter_map(|row| row.mean).map(|mean| mean.value);
    let (gaps, n) = (e.gaps()?, VERTICES as f64);
    let a = some(simulated.next())? / gaps;
    let b = simulated.next_back().map_or(a, |last| last / gaps);
    let [c, d] = e.numbers("theory.mean", ["at_zero", "at_one"])?.map(|mean| mean / n);
    let rises = |[low, high]: [f64; 2]| low < 0.25 && high > 0.9;
    let found = Text::of(
        "simulated from {} to {} of N, theory from {} to {}; k* jumps",
        [a, b, c, d].map(|share| significant(share, 2)),
    );
    let jumps = e.cases(s)?[1] == 0 && e.number("theory.jump.k_after")? > 1.0;
    Ok(s.found(found, rises([a, b]) && rises([c, d]) && jumps)
        .within(
            "both from below a quarter to above nine tenths",
            "ours: the least that a common rise must do",
        )
        .note("Simulated is the mean of the kept. What agrees beyond this is judged in Section 8."))
}
