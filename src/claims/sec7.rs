//! Section 7: the discontinuity of the most likely number.

use super::judge::*;
use crate::params::VERTICES;
use impact_circuits::jump;

pub const ROWS: &[Judge] = &[
    cases("sec7_eq11", "Every k at ten values of p.").of("Φ(k + 1) − Φ(k) ∝ f(k)"),
    difference("sec7_eq13", "f at its zeros, over its largest term.").of("k±"),
    defined("sec7_eq14_15").of("−1 and −(N + 1)"),
    cases("sec7_eq16_17", "Sign and slope at every k.").of("−(k + 1) < 0; k (N − k) > 0"),
    by("sec7_through_zero", Exact, through_zero),
    by("sec7_start", Exact, start),
    difference("sec7_maximum", "f is even about that place.").of("(Np − 1)/2p"),
    by("sec7_p_crit", Rounding, p_crit).of("((1 + √(N + 1))/N)²"),
    cases("sec7_other_root", "Every N up to the number of cases.").of("k < 0"),
    by("sec7_inflexion", Rounding, inflexion),
    by("sec7_extrema", Exact, extrema),
    by("sec7_still_one", Exact, still_one),
    by("sec7_jump", OurMeasure, leaps).of("much larger than 1"),
    cases("sec7_monotone", "On a grid of p from the jump to one."),
    by("sec7_limit", Exact, limit).of("N − 1"),
];

const INTEGER: &str = "an integer is exact";

fn start(e: &Evidence, s: &Statement) -> Judged {
    let first = e.number("theory.jump.k_at_zero")?;
    let found = Text::of("k* = {} as p → 0+", [integer(first as usize)]);
    Ok(s.found(found, first == s.number()?).within("none", INTEGER))
}

fn through_zero(e: &Evidence, s: &Statement) -> Judged {
    let [all, failed] = e.cases(s)?;
    let found = Text::of(
        "f passes zero at some p ≤ 1 for {} of {} k",
        [integer(all - failed), integer(all)],
    );
    let last = jump::f(VERTICES, 1.0, VERTICES as f64 - 1.0);
    Ok(s.found(found, failed == 0).within("none", INTEGER).explained(
        Text::of(
            "At k = N − 1 f is p (N − 1) − N, which is {} at p = 1 and less before; so k* ends at N − 1.",
            [significant(last, 1)],
        ),
        failed == 1 && last < 0.0,
    ))
}

/// A forward difference is zero half a step before the derivative.
fn inflexion(e: &Evidence, s: &Statement) -> Judged {
    let (off, [steps, failed]) = (e.difference(s)?, e.cases(s)?);
    let columns = ["p_crit", "k_touch", "p_flat", "k_flat"];
    let [crit, touch, p, k] = e.numbers("theory.jump", columns)?;
    let allowed = 1e-13;
    let found = Text::of(
        "with Γ functions for the factorials at p = {}, k = {}; p_crit = {}",
        [significant(p, 6), significant(k, 3), significant(crit, 6)],
    );
    Ok(s.found(found, (p / crit - 1.0).abs() <= allowed)
        .within(Text::of("{} relative", [significant(allowed, 1)]), "rounding")
        .explained(
            Text::of(
                "f has a double zero there, at k = {}, but f is the forward difference of Φ and not its derivative, whose \
                 double zero comes at a smaller p, half a step further on. On the integers Φ is not stationary. It falls \
                 at {} of {} steps up to p_crit, as the paper says.",
                [significant(touch, 4), integer(steps - failed), integer(steps)],
            ),
            off <= allowed && failed == 0 && steps > 0 && (k - touch - 0.5).abs() < 0.05,
        ))
}

fn extrema(e: &Evidence, s: &Statement) -> Judged {
    let [all, failed] = e.cases(s)?;
    Ok(s.all_cases(all, failed).note(Text::of(
        "Neighbours of ⌈k₋⌉ and ⌈k₊⌉, since f is a forward difference. The first local maximum on the integers appears \
         at p = {}, a little above p_crit.",
        [significant(e.number("theory.first_maximum.p")?, 8)],
    )))
}

fn p_crit(e: &Evidence, s: &Statement) -> Judged {
    let [formula, found, k] = e.numbers("theory.jump", ["p_crit", "p_crit_found", "k_touch"])?;
    let allowed = 1e-13;
    let text = Text::of("the zeros appear at p = {}", [significant(found, 15)]);
    Ok(s.found(text, (found / formula - 1.0).abs() <= allowed)
        .within(
            Text::of("{} relative", [significant(allowed, 1)]),
            "rounding: the largest value of f is known to a few units in the last place",
        )
        .note(Text::of("They appear at k = {}, not at an integer.", [significant(k, 4)])))
}

fn still_one(e: &Evidence, s: &Statement) -> Judged {
    let both = e.numbers("theory.jump", ["k_at_crit", "k_before"])?;
    let printed = s.number()?;
    let found = Text::of(
        "k* = {} at p_crit and {} half way to the jump",
        both.map(|k| integer(k as usize)),
    );
    Ok(s.found(found, both == [printed; 2]).within("none", INTEGER))
}

fn leaps(e: &Evidence, s: &Statement) -> Judged {
    let [crit, leap, k_after] = e.numbers("theory.jump", ["p_crit", "p_jump", "k_after"])?;
    let found =
        Text::of("from 1 to {} at p = {}", [integer(k_after as usize), significant(leap, 15)]);
    Ok(s.found(found, k_after >= 10.0 && leap > crit)
        .within("ten or more, above p_crit", "ours: “much larger” as at least ten times")
        .note(Text::of(
            "The paper prints p_crit only; the jump comes {} % later.",
            [significant(100.0 * (leap / crit - 1.0), 3)],
        )))
}

fn limit(e: &Evidence, s: &Statement) -> Judged {
    let [last, ratio] = e.numbers("theory.jump", ["k_at_one", "last_ratio"])?;
    Ok(s.found(Text::of("k* = {} at p = 1", [integer(last as usize)]), last == s.number()?)
        .within("none", INTEGER)
        .note(Text::of("There Φ(N)/Φ(N − 1) is {}.", [significant(ratio, 2)])))
}
