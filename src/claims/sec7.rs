//! Judges Section 7, the discontinuity of the most likely number.

use super::shared::*;
use crate::params::VERTICES;
use impact_circuits::jump;

pub fn rules() -> Vec<Rule> {
    vec![
        cases("sec7_eq11", "Every k at ten values of p.").reads("Φ(k + 1) − Φ(k) ∝ f(k)"),
        equality("sec7_eq13", 1e-13, "f at its zeros, over its largest term.").reads("k±"),
        Rule::new("sec7_eq14_15", ends_of_f).on(FiniteCases).reads("−1 and −(N + 1)"),
        cases("sec7_eq16_17", "Sign and slope at every k.").reads("−(k + 1) < 0; k (N − k) > 0"),
        Rule::new("sec7_through_zero", through_zero),
        Rule::new("sec7_start", start),
        equality("sec7_maximum", 1e-13, "f is symmetric about that place.").reads("(Np − 1)/2p"),
        Rule::new("sec7_p_crit", p_crit).on(Rounding).reads("((1 + √(N + 1))/N)²"),
        cases("sec7_other_root", "Every N up to the number of cases.").reads("k < 0"),
        Rule::new("sec7_inflexion", inflexion).on(FiniteCases),
        Rule::new("sec7_extrema", extrema).on(FiniteCases),
        Rule::new("sec7_still_one", still_one),
        Rule::new("sec7_jump", leaps).on(OurMeasure).reads("much larger than 1"),
        cases("sec7_monotone", "On a grid of p from the jump to one."),
        Rule::new("sec7_limit", limit).reads("N − 1"),
    ]
}

const INTEGER: &str = "an integer is exact";

fn start(e: &Evidence<'_>) -> Judged {
    let first = e.number("theory.jump.k_at_zero")?;
    let found = text!("k* = {} as p → 0+", first);
    let note = "At p = 0 itself Eq. (9) is 0/0.";
    Ok(e.found(found, first == e.statement.number()?).within("none", INTEGER).note(note))
}

fn ends_of_f(e: &Evidence<'_>) -> Judged {
    let n = VERTICES as f64;
    let at = |k: f64| [0.0, 0.5, 1.0].map(|p| jump::f(VERTICES, p, k));
    let agrees = at(0.0) == [-1.0; 3] && at(n) == [-(n + 1.0); 3];
    let found = text!("{} and {}", at(0.0)[0], at(n)[0]);
    Ok(e.found(found, agrees).within("none", INTEGER).note("At three values of p."))
}

fn through_zero(e: &Evidence<'_>) -> Judged {
    let [all, failed] = compared(e)?;
    let found = text!("f passes zero at some p ≤ 1 for {} of {} k", all - failed, all);
    let last = jump::f(VERTICES, 1.0, VERTICES as f64 - 1.0);
    let why = "At k = N − 1, f is p (N − 1) − N, which is {:1} at p = 1 and less before; so k* ends at N − 1.";
    Ok(e.found(found, failed == 0)
        .within("none", INTEGER)
        .explained(text!(why, last), failed == 1 && last < 0.0))
}

/// A forward difference is zero half a step before the derivative.
fn inflexion(e: &Evidence<'_>) -> Judged {
    let (off, [steps, failed]) = (largest_difference(e)?, compared(e)?);
    let columns = ["p_crit", "k_touch", "p_flat", "k_flat"];
    let [crit, touch, p, k] = e.numbers("theory.jump", columns)?;
    let allowed = 1e-13;
    let found = "with Γ functions for the factorials at p = {:6}, k = {:3}; p_crit = {:6}";
    let found = text!(found, p, k, crit);
    let why = "f has a double zero there, at k = {:4}, but f is the forward difference of Φ and not its derivative, \
         whose double zero comes at a smaller p, half a step further on. On the integers Φ is not stationary. It \
         falls at {} of {} steps up to p_crit, as the paper says.";
    Ok(e.found(found, (p / crit - 1.0).abs() <= allowed)
        .within(text!("{:1} relative", allowed), "rounding")
        .explained(
            text!(why, touch, steps - failed, steps),
            off <= allowed && failed == 0 && steps > 0 && (k - touch - 0.5).abs() < 0.05,
        ))
}

fn extrema(e: &Evidence<'_>) -> Judged {
    let [all, failed] = compared(e)?;
    let [first, crit] = ["theory.first_maximum.p", "theory.jump.p_crit"].map(|at| e.number(at));
    let (first, crit) = (first?, crit?);
    let found = text!("from p = {:8} on; p_crit = {:8}", first, crit);
    let why = "From there on the statement holds in all {} cases that were tried, with local extrema at ⌈k₋⌉ and ⌈k₊⌉, since f is a \
         forward difference. Between p_crit and there both zeros of f lie between two integers.";
    Ok(e.found(found, first <= crit)
        .within("none", "exact: the first p at which integers have a local maximum")
        .explained(text!(why, all), failed == 0 && first > crit))
}

fn p_crit(e: &Evidence<'_>) -> Judged {
    let [formula, found, k] = e.numbers("theory.jump", ["p_crit", "p_crit_found", "k_touch"])?;
    let allowed = 1e-13;
    let text = text!("the zeros appear at p = {:15}", found);
    let reason = "rounding: the largest value of f is known to a few units in the last place";
    Ok(e.found(text, (found / formula - 1.0).abs() <= allowed)
        .within(text!("{:1} relative", allowed), reason)
        .note(text!("They appear at k = {:4}, not at an integer.", k)))
}

fn still_one(e: &Evidence<'_>) -> Judged {
    let [at_crit, before] = e.numbers("theory.jump", ["k_at_crit", "k_before"])?;
    let printed = e.statement.number()?;
    let found = text!("k* = {} at p_crit and {} half way to the jump", at_crit, before);
    Ok(e.found(found, [at_crit, before] == [printed; 2]).within("none", INTEGER))
}

fn leaps(e: &Evidence<'_>) -> Judged {
    let [crit, leap, k_after] = e.numbers("theory.jump", ["p_crit", "p_jump", "k_after"])?;
    let found = text!("from 1 to {} at p = {:15}", k_after, leap);
    let note = "The paper prints p_crit only; the jump comes {:3} % later.";
    Ok(e.found(found, k_after >= 10.0 && leap > crit)
        .within("ten or more, above p_crit", "ours: “much larger” as at least ten times")
        .note(text!(note, 100.0 * (leap / crit - 1.0))))
}

fn limit(e: &Evidence<'_>) -> Judged {
    let [last, ratio] = e.numbers("theory.jump", ["k_at_one", "last_ratio"])?;
    Ok(e.found(text!("k* = {} at p = 1", last), last == e.statement.number()?)
        .within("none", INTEGER)
        .note(text!("There Φ(N)/Φ(N − 1) is {:2}.", ratio)))
}
