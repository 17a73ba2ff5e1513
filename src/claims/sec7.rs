//! Section 7: the discontinuity of the most likely number.

use super::row::{Error, Evidence, Finding, Row, all_cases, exact, rounding};
use super::{Judgement, Statement, Text};

/// The rows of this section.
pub const ROWS: &[Row] = &[
    exact("sec7_eq11", |e, _| {
        let cases = e.results.identities.eq11;
        Ok(all_cases(cases.compared, cases.failed, "Every k at ten values of p."))
    }),
    exact("sec7_eq13", |e, _| {
        Ok(rounding(e.results.identities.eq13, 1e-13, "f at its zeros, over its largest term."))
    }),
    exact("sec7_eq14_15", |e, _| {
        Ok(rounding(e.results.identities.eq14_15, 1e-13, "At ten values of p."))
    }),
    exact("sec7_eq16_17", |e, _| {
        let cases = e.results.identities.eq16_17;
        Ok(all_cases(cases.compared, cases.failed, "Sign and slope at every k."))
    }),
    exact("sec7_start", start),
    exact("sec7_phi_at_zero", phi_at_zero),
    exact("sec7_p_crit", p_crit),
    exact("sec7_still_one", still_one),
    exact("sec7_jump", jump),
    exact("sec7_monotone", |e, _| {
        let cases = e.results.identities.monotone;
        Ok(all_cases(cases.compared, cases.failed, "On a grid of p from the jump to one."))
    }),
    exact("sec7_limit", limit),
];

const INTEGER: &str = "an integer is exact";

fn start(e: &Evidence, s: &Statement) -> Result<Finding, Error> {
    let first = e.results.theory.mechanism.first().map_or(0, |row| row.k_star);
    Ok(Finding {
        ours: Text::words("k* = ").integer(first).say(" as p → 0+"),
        tolerance: Text::words("none"),
        reason: INTEGER,
        judgement: Judgement::Plain { agrees: first as f64 == s.number()? },
        note: Text::default(),
    })
}

fn phi_at_zero(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let at_zero = e.results.identities.falling_at_zero;
    let above = e.results.identities.falling_below_crit;
    Ok(Finding {
        ours: Text::words("at ")
            .integer((at_zero.compared - at_zero.failed) as usize)
            .say(" of ")
            .integer(at_zero.compared as usize)
            .say(" steps"),
        tolerance: Text::words("none"),
        reason: INTEGER,
        judgement: Judgement::Explained {
            agrees: at_zero.failed == 0,
            holds: at_zero.failed == at_zero.compared && above.failed == 0 && above.compared > 0,
        },
        note: Text::words(
            "Each Φ has a factor p^k and vanishes at p = 0. The statement holds for every p \
             between 0 and p_crit: ",
        )
        .integer(above.compared as usize)
        .say(" steps on a grid all fall."),
    })
}

fn p_crit(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let formula = e.results.theory.scalars.p_crit;
    let found = e.results.identities.p_crit_by_bisection;
    let k = e.results.identities.k_touch;
    let allowed = 1e-13;
    Ok(Finding {
        ours: Text::words("the zeros appear at p = ").significant(found, 15),
        tolerance: Text::default().significant(allowed, 1).say(" relative"),
        reason: "rounding: the largest value of f is known to a few units in the last place",
        judgement: Judgement::Plain { agrees: (found / formula - 1.0).abs() <= allowed },
        note: Text::words("They appear at k = ").significant(k, 4).say(", not at an integer."),
    })
}

fn still_one(e: &Evidence, s: &Statement) -> Result<Finding, Error> {
    let [at, between] = e.results.identities.k_star_before_jump;
    let printed = s.number()?;
    Ok(Finding {
        ours: Text::words("k* = ")
            .integer(at)
            .say(" at p_crit and ")
            .integer(between)
            .say(" half way to the jump"),
        tolerance: Text::words("none"),
        reason: INTEGER,
        judgement: Judgement::Plain { agrees: at as f64 == printed && between as f64 == printed },
        note: Text::default(),
    })
}

fn jump(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let theory = &e.results.theory;
    let scalars = &theory.scalars;
    Ok(Finding {
        ours: Text::words("from 1 to ")
            .integer(scalars.k_after_jump)
            .say(" at p = ")
            .significant(scalars.p_jump, 15),
        tolerance: Text::words("ten or more, above p_crit"),
        reason: "ours: “much larger” as at least ten times",
        judgement: Judgement::Plain {
            agrees: scalars.k_after_jump >= 10 && scalars.p_jump > scalars.p_crit,
        },
        note: Text::words("The paper prints p_crit only; the jump comes ")
            .significant(100.0 * (scalars.p_jump / scalars.p_crit - 1.0), 3)
            .say(" % later."),
    })
}

fn limit(e: &Evidence, s: &Statement) -> Result<Finding, Error> {
    let slips = &e.results.theory.slips;
    Ok(Finding {
        ours: Text::words("k* = ").integer(slips.k_star_at_one).say(" at p = 1"),
        tolerance: Text::words("none"),
        reason: INTEGER,
        judgement: Judgement::Plain { agrees: slips.k_star_at_one as f64 == s.number()? },
        note: Text::words("There Φ(N)/Φ(N − 1) is ")
            .significant(slips.last_ratio_at_one, 2)
            .say("."),
    })
}
