//! Judges Section 7, the discontinuity of the most likely number.

use super::shared::*;
use impact_circuits::jump;

pub fn rules() -> Vec<Rule> {
    vec![
        cases("sec7_eq11").reads("Φ(k + 1) − Φ(k) ∝ f(k)"),
        equality("sec7_eq13", 1e-13).reads("k±"),
        Rule::new("sec7_eq14_15", ends_of_f).on(FiniteCases).reads("−1 and −(N + 1)"),
        cases("sec7_eq16_17").reads("−(k + 1) < 0; k (N − k) > 0"),
        Rule::new("sec7_through_zero", through_zero),
        Rule::new("sec7_start", start),
        equality("sec7_maximum", 1e-13).reads("(Np − 1)/2p"),
        Rule::new("sec7_p_crit", p_crit).on(Rounding).reads("((1 + √(N + 1))/N)²"),
        cases("sec7_other_root").reads("k < 0"),
        Rule::new("sec7_inflexion", inflexion).on(FiniteCases),
        Rule::new("sec7_extrema", extrema).on(FiniteCases),
        Rule::new("sec7_still_one", still_one),
        Rule::new("sec7_jump", leaps).on(OurMeasure).reads("much larger than 1"),
        cases("sec7_monotone"),
        Rule::new("sec7_limit", limit).reads("N − 1"),
    ]
}

fn start(e: &Evidence<'_>) -> Judged {
    let first = e.number("theory.jump.k_at_zero")?;
    e.check(first == e.statement.number()?, numbers![first])
}

fn ends_of_f(e: &Evidence<'_>) -> Judged {
    let n = VERTICES as f64;
    let values = |k: f64| [0.0, 0.5, 1.0].map(|p| jump::f(VERTICES, p, k));
    let agrees = values(0.0) == [-1.0; 3] && values(n) == [-(n + 1.0); 3];
    e.check(agrees, numbers![start = values(0.0)[0], end = values(n)[0]])
}

fn through_zero(e: &Evidence<'_>) -> Judged {
    let [all, failed] = compared_cases(e)?;
    let last = jump::f(VERTICES, 1.0, VERTICES as f64 - 1.0);
    let check = e.check(failed == 0, numbers![passes = all - failed, all, last])?;
    Ok(check.explained_if(failed == 1 && last < 0.0))
}

/// A forward difference is zero half a step before the derivative.
fn inflexion(e: &Evidence<'_>) -> Judged {
    let (off, [steps, failed]) = (largest_difference(e)?, compared_cases(e)?);
    let columns = ["p_crit", "k_touch", "p_flat", "k_flat"];
    let [crit, touch, p, k] = e.numbers("theory.jump", columns)?;
    let (allowed, falls) = (1e-13, steps - failed);
    let numbers = numbers![p, k, crit, allowed, touch, falls, steps];
    let is_half_a_step_on = (k - touch - 0.5).abs() < 0.05;
    let check = e.check((p / crit - 1.0).abs() <= allowed, numbers)?;
    Ok(check.explained_if(off <= allowed && failed == 0 && steps > 0 && is_half_a_step_on))
}

fn extrema(e: &Evidence<'_>) -> Judged {
    let [all, failed] = compared_cases(e)?;
    let [first, crit] = ["theory.first_maximum.p", "theory.jump.p_crit"].map(|cell| e.number(cell));
    let (first, crit) = (first?, crit?);
    let check = e.check(first <= crit, numbers![first, crit, all])?;
    Ok(check.explained_if(failed == 0 && first > crit))
}

fn p_crit(e: &Evidence<'_>) -> Judged {
    let [formula, found, k] = e.numbers("theory.jump", ["p_crit", "p_crit_found", "k_touch"])?;
    let allowed = 1e-13;
    e.check((found / formula - 1.0).abs() <= allowed, numbers![found, k, allowed])
}

fn still_one(e: &Evidence<'_>) -> Judged {
    let [at_crit, before] = e.numbers("theory.jump", ["k_at_crit", "k_before"])?;
    e.check([at_crit, before] == [e.statement.number()?; 2], numbers![at_crit, before])
}

fn leaps(e: &Evidence<'_>) -> Judged {
    let [crit, leap, k_after] = e.numbers("theory.jump", ["p_crit", "p_jump", "k_after"])?;
    let later = 100.0 * (leap / crit - 1.0);
    e.check(k_after >= 10.0 && leap > crit, numbers![k_after, leap, later])
}

fn limit(e: &Evidence<'_>) -> Judged {
    let [last, ratio] = e.numbers("theory.jump", ["k_at_one", "last_ratio"])?;
    e.check(last == e.statement.number()?, numbers![last, ratio])
}
