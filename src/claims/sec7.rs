//! Section 7: the discontinuity of the most likely number.

use super::Basis::{Exact, OurMeasure, Rounding};
use super::Finding;
use super::row::{Error, Evidence, Row, cases, difference, theory};
use super::{Judgement, Statement, Text};

pub const ROWS: &[Row] = &[
    theory("sec7_eq11", Exact, |e, s| cases(e, s, "Every k at ten values of p."))
        .of("Φ(k + 1) − Φ(k) ∝ f(k)"),
    theory("sec7_eq13", Rounding, |e, s| {
        difference(e, s, 1e-13, "f at its zeros, over its largest term.")
    })
    .of("k±"),
    theory("sec7_eq14_15", Rounding, |e, s| difference(e, s, 1e-13, "At ten values of p."))
        .of("−1 and −(N + 1)"),
    theory("sec7_eq16_17", Exact, |e, s| cases(e, s, "Sign and slope at every k."))
        .of("−(k + 1) < 0; k (N − k) > 0"),
    theory("sec7_start", Exact, start),
    theory("sec7_maximum", Rounding, |e, s| difference(e, s, 1e-13, "f is even about that place."))
        .of("(Np − 1)/2p"),
    theory("sec7_p_crit", Rounding, p_crit).of("((1 + √(N + 1))/N)²"),
    theory("sec7_other_root", Exact, |e, s| cases(e, s, "Every N up to the number of cases."))
        .of("k < 0"),
    theory("sec7_inflexion", Rounding, inflexion),
    theory("sec7_extrema", Exact, extrema),
    theory("sec7_still_one", Exact, still_one),
    theory("sec7_jump", OurMeasure, jump).of("much larger than 1"),
    theory("sec7_monotone", Exact, |e, s| cases(e, s, "On a grid of p from the jump to one.")),
    theory("sec7_limit", Exact, limit).of("N − 1"),
];

const INTEGER: &str = "an integer is exact";

fn start(e: &Evidence, s: &Statement) -> Result<Finding, Error> {
    let first = e.number("theory.jump.k_at_zero")?;
    Ok(Finding {
        ours: Text::words("k* = ").integer(first as usize).say(" as p → 0+"),
        tolerance: Text::words("none"),
        reason: INTEGER,
        judgement: Judgement::Plain { agrees: first == s.number()? },
        note: Text::default(),
    })
}

/// As differences have it: Φ(k + 1) − Φ(k), continued to all k, touches zero and does not change sign.
fn inflexion(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let off = e.number("theory.differences[statement=sec7_inflexion].largest")?;
    let steps = e.number("theory.cases[statement=sec7_inflexion].compared")?;
    let failed = e.number("theory.cases[statement=sec7_inflexion].failed")?;
    let allowed = 1e-13;
    Ok(Finding {
        ours: Text::words("f is −p (k − k₀)² with k₀ = ")
            .significant(e.number("theory.jump.k_touch")?, 4)
            .say(", within ")
            .significant(off, 1)
            .say("; Φ falls at ")
            .integer((steps - failed) as usize)
            .say(" of ")
            .integer(steps as usize)
            .say(" steps up to p_crit"),
        tolerance: Text::default().significant(allowed, 1).say(" relative, and all steps"),
        reason: "rounding; integers are exact",
        judgement: Judgement::Plain { agrees: off <= allowed && failed == 0.0 && steps > 0.0 },
        note: Text::words(
            "The flat place lies between two integers, so on the integers Φ is not stationary.",
        ),
    })
}

fn extrema(e: &Evidence, s: &Statement) -> Result<Finding, Error> {
    Ok(Finding {
        note: Text::words(
            "Neighbours of ⌈k₋⌉ and ⌈k₊⌉, since f is a forward difference. The first local maximum on the \
             integers appears at p = ",
        )
        .significant(e.number("theory.first_maximum.p")?, 8)
        .say(", a little above p_crit."),
        ..cases(e, s, "")?
    })
}

fn p_crit(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let (formula, found) = (e.number("theory.jump.p_crit")?, e.number("theory.jump.p_crit_found")?);
    let k = e.number("theory.jump.k_touch")?;
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
    let (at, between) = (e.number("theory.jump.k_at_crit")?, e.number("theory.jump.k_before")?);
    let printed = s.number()?;
    Ok(Finding {
        ours: Text::words("k* = ")
            .integer(at as usize)
            .say(" at p_crit and ")
            .integer(between as usize)
            .say(" half way to the jump"),
        tolerance: Text::words("none"),
        reason: INTEGER,
        judgement: Judgement::Plain { agrees: at == printed && between == printed },
        note: Text::default(),
    })
}

fn jump(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let (crit, leap) = (e.number("theory.jump.p_crit")?, e.number("theory.jump.p_jump")?);
    let k_after = e.number("theory.jump.k_after")? as usize;
    Ok(Finding {
        ours: Text::words("from 1 to ").integer(k_after).say(" at p = ").significant(leap, 15),
        tolerance: Text::words("ten or more, above p_crit"),
        reason: "ours: “much larger” as at least ten times",
        judgement: Judgement::Plain { agrees: k_after >= 10 && leap > crit },
        note: Text::words("The paper prints p_crit only; the jump comes ")
            .significant(100.0 * (leap / crit - 1.0), 3)
            .say(" % later."),
    })
}

fn limit(e: &Evidence, s: &Statement) -> Result<Finding, Error> {
    let last = e.number("theory.jump.k_at_one")?;
    Ok(Finding {
        ours: Text::words("k* = ").integer(last as usize).say(" at p = 1"),
        tolerance: Text::words("none"),
        reason: INTEGER,
        judgement: Judgement::Plain { agrees: last == s.number()? },
        note: Text::words("There Φ(N)/Φ(N − 1) is ")
            .significant(e.number("theory.jump.last_ratio")?, 2)
            .say("."),
    })
}
