//! Judges Section 7, the discontinuity of the most likely number.

use super::shared::*;
use crate::params::VERTICES;
use impact_circuits::jump;

pub fn rules() -> Vec<Rule> {
    vec![
        cases("sec7_eq11", "Every k at ten values of p.").reads("Φ(k + 1) − Φ(k) ∝ f(k)"),
        equality("sec7_eq13", 1e-13, "f at its zeros, over its largest term.").reads("k±"),
        defined("sec7_eq14_15").reads("−1 and −(N + 1)"),
        cases("sec7_eq16_17", "Sign and slope at every k.").reads("−(k + 1) < 0; k (N − k) > 0"),
        Rule::new("sec7_through_zero", through_zero),
        Rule::new("sec7_start", start),
        equality("sec7_maximum", 1e-13, "f is even about that place.").reads("(Np − 1)/2p"),
        Rule::new("sec7_p_crit", p_crit).on(Rounding).reads("((1 + √(N + 1))/N)²"),
        cases("sec7_other_root", "Every N up to the number of cases.").reads("k < 0"),
        Rule::new("sec7_inflexion", inflexion).on(Rounding),
        Rule::new("sec7_extrema", extrema),
        Rule::new("sec7_still_one", still_one),
        Rule::new("sec7_jump", leaps).on(OurMeasure).reads("much larger than 1"),
        cases("sec7_monotone", "On a grid of p from the jump to one."),
        Rule::new("sec7_limit", limit).reads("N − 1"),
    ]
}

const INTEGER: &str = "an integer is exact";

fn start(e: &Evidence<'_>) -> Judged {
    let first = e.number("theory.jump.k_at_zero")?;
    let found = Text::of("k* = {} as p → 0+", [integer(first as usize)]);
    let note = "At p = 0 itself Eq. (9) is 0/0; the mean there is read in the same way.";
    Ok(e.found(found, first == e.statement.number()?).within("none", INTEGER).note(note))
}

fn through_zero(e: &Evidence<'_>) -> Judged {
    let [all, failed] = compared(e)?;
    let found = Text::of(
        "f passes zero at some p ≤ 1 for {} of {} k",
        [integer(all - failed), integer(all)],
    );
    let last = jump::f(VERTICES, 1.0, VERTICES as f64 - 1.0);
    Ok(e.found(found, failed == 0).within("none", INTEGER).explained(
        Text::of(
            "At k = N − 1 f is p (N − 1) − N, which is {} at p = 1 and less before; so k* ends at N − 1.",
            [significant(last, 1)],
        ),
        failed == 1 && last < 0.0,
    ))
}

/// A forward difference is zero half a step before the derivative.
fn inflexion(e: &Evidence<'_>) -> Judged {
    let (off, [steps, failed]) = (largest_difference(e)?, compared(e)?);
    let columns = ["p_crit", "k_touch", "p_flat", "k_flat"];
    let [crit, touch, p, k] = e.numbers("theory.jump", columns)?;
    let allowed = 1e-13;
    let found = Text::of(
        "with Γ functions for the factorials at p = {}, k = {}; p_crit = {}",
        [significant(p, 6), significant(k, 3), significant(crit, 6)],
    );
    Ok(e.found(found, (p / crit - 1.0).abs() <= allowed)
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

fn extrema(e: &Evidence<'_>) -> Judged {
    let [all, failed] = compared(e)?;
    Ok(e.all_cases(all, failed).note(Text::of(
        "Neighbours of ⌈k₋⌉ and ⌈k₊⌉, since f is a forward difference. The first local maximum on the integers appears \
         at p = {}, a little above p_crit.",
        [significant(e.number("theory.first_maximum.p")?, 8)],
    )))
}

fn p_crit(e: &Evidence<'_>) -> Judged {
    let [formula, found, k] = e.numbers("theory.jump", ["p_crit", "p_crit_found", "k_touch"])?;
    let allowed = 1e-13;
    let text = Text::of("the zeros appear at p = {}", [significant(found, 15)]);
    Ok(e.found(text, (found / formula - 1.0).abs() <= allowed)
        .within(
            Text::of("{} relative", [significant(allowed, 1)]),
            "rounding: the largest value of f is known to a few units in the last place",
        )
        .note(Text::of("They appear at k = {}, not at an integer.", [significant(k, 4)])))
}

fn still_one(e: &Evidence<'_>) -> Judged {
    let both = e.numbers("theory.jump", ["k_at_crit", "k_before"])?;
    let printed = e.statement.number()?;
    let found = Text::of(
        "k* = {} at p_crit and {} half way to the jump",
        both.map(|k| integer(k as usize)),
    );
    Ok(e.found(found, both == [printed; 2]).within("none", INTEGER))
}

fn leaps(e: &Evidence<'_>) -> Judged {
    let [crit, leap, k_after] = e.numbers("theory.jump", ["p_crit", "p_jump", "k_after"])?;
    let found =
        Text::of("from 1 to {} at p = {}", [integer(k_after as usize), significant(leap, 15)]);
    Ok(e.found(found, k_after >= 10.0 && leap > crit)
        .within("ten or more, above p_crit", "ours: “much larger” as at least ten times")
        .note(Text::of(
            "The paper prints p_crit only; the jump comes {} % later.",
            [significant(100.0 * (leap / crit - 1.0), 3)],
        )))
}

fn limit(e: &Evidence<'_>) -> Judged {
    let [last, ratio] = e.numbers("theory.jump", ["k_at_one", "last_ratio"])?;
    Ok(e.found(
        Text::of("k* = {} at p = 1", [integer(last as usize)]),
        last == e.statement.number()?,
    )
    .within("none", INTEGER)
    .note(Text::of("There Φ(N)/Φ(N − 1) is {}.", [significant(ratio, 2)])))
}
