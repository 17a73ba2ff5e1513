//! Section 7: the discontinuity of the most likely number.

use super::Basis::{Exact, OurMeasure, Rounding};
use super::row::{Error, Evidence, Row, cases, theory};
use super::{Finding, all_cases, rounding};
use super::{Judgement, Statement, Text};

pub const ROWS: &[Row] = &[
    theory("sec7_eq11", Exact, |e, _| {
        cases(e.results.identities.eq11, "Every k at ten values of p.")
    })
    .of("Φ(k + 1) − Φ(k) ∝ f(k)"),
    theory("sec7_eq13", Rounding, |e, _| {
        Ok(rounding(e.results.identities.eq13, 1e-13, "f at its zeros, over its largest term."))
    })
    .of("k±"),
    theory("sec7_eq14_15", Rounding, |e, _| {
        Ok(rounding(e.results.identities.eq14_15, 1e-13, "At ten values of p."))
    })
    .of("−1 and −(N + 1)"),
    theory("sec7_eq16_17", Exact, |e, _| {
        cases(e.results.identities.eq16_17, "Sign and slope at every k.")
    })
    .of("−(k + 1) < 0; k (N − k) > 0"),
    theory("sec7_start", Exact, start),
    theory("sec7_maximum", Rounding, |e, _| {
        Ok(rounding(e.results.identities.f_maximum, 1e-13, "f is even about that place."))
    })
    .of("(Np − 1)/2p"),
    theory("sec7_p_crit", Rounding, p_crit).of("((1 + √(N + 1))/N)²"),
    theory("sec7_other_root", Exact, |e, _| {
        cases(e.results.identities.other_root, "Every N up to the number of cases.")
    })
    .of("k < 0"),
    theory("sec7_inflexion", Rounding, inflexion),
    theory("sec7_extrema", Exact, extrema),
    theory("sec7_still_one", Exact, still_one),
    theory("sec7_jump", OurMeasure, jump).of("much larger than 1"),
    theory("sec7_monotone", Exact, |e, _| {
        cases(e.results.identities.monotone, "On a grid of p from the jump to one.")
    }),
    theory("sec7_limit", Exact, limit).of("N − 1"),
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

/// As differences have it: Φ(k + 1) − Φ(k), continued to all k, touches zero and does not change sign.
fn inflexion(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let id = &e.results.identities;
    let falling = id.falling_below_crit;
    let allowed = 1e-13;
    Ok(Finding {
        ours: Text::words("f is −p (k − k₀)² with k₀ = ")
            .significant(id.k_touch, 4)
            .say(", within ")
            .significant(id.inflexion, 1)
            .say("; Φ falls at ")
            .integer((falling.compared - falling.failed) as usize)
            .say(" of ")
            .integer(falling.compared as usize)
            .say(" steps up to p_crit"),
        tolerance: Text::default().significant(allowed, 1).say(" relative, and all steps"),
        reason: "rounding; integers are exact",
        judgement: Judgement::Plain {
            agrees: id.inflexion <= allowed && falling.failed == 0 && falling.compared > 0,
        },
        note: Text::words(
            "The flat place lies between two integers, so on the integers Φ is not stationary.",
        ),
    })
}

fn extrema(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let cases = e.results.identities.extrema;
    let first = e.results.theory.slips.first_local_maximum.p;
    Ok(Finding {
        note: Text::words(
            "Neighbours of ⌈k₋⌉ and ⌈k₊⌉, since f is a forward difference. The first local maximum on the \
             integers appears at p = ",
        )
        .significant(first, 8)
        .say(", a little above p_crit."),
        ..all_cases(cases.compared, cases.failed, "")
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
