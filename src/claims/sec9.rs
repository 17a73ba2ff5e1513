//! Judges Sections 9 and 10, circuits that repeat impacts and the conclusions.

use super::sec8::{VISIBLE, means_in_windows};
use super::shared::*;
use crate::experiments::theory::higher::overtaken_in_order;

pub fn rules() -> Vec<Rule> {
    let ([a, c, d], [first, last]) = (HIGHER_P, CONVERGENCE_P);
    let converging = [("fig14_p_a", first), ("fig14_p_b", last)];
    vec![
        Rule::new("sec9_fig6_repeats", fig6_repeats),
        cases("sec9_eq29").reads("(N − 1)!/(N − (k − 1))!"),
        Rule::new("sec9_eq30", eq30).on(FiniteCases).reads("γ(k, 2)/2 · (N − 1)!/(N − (k − 1))!"),
        cases("sec9_eq32").reads("(n − 1)!/((j − 1)! (n − j)!)"),
        Rule::new("sec9_eq33", class_range).on(FiniteCases).reads("(k − 1)/2 · N!/(N − (k − 1))!"),
        Rule::new("sec9_eq35", class_range).on(FiniteCases).reads("valid for k > {}"),
        Rule::new("sec9_eq36", class_range).on(FiniteCases).reads("valid for k > {}"),
        Rule::new("sec9_eq37", class_range).on(FiniteCases).reads("valid for k > {}"),
        Rule::new("sec9_eq38", eq38).on(FiniteCases).reads("Eq. (38)"),
        Rule::new("sec9_even_small_p", even_small_p)
            .on(OurMeasure)
            .reads("significant at p = {}")
            .uses(&[("fig13_p_a", a), ("fig13_p_c", c), ("fig13_p_d", d)]),
        Rule::new("sec9_even_small_p_different", even_small_p_different)
            .on(OurMeasure)
            .reads("significant at p = {}"),
        Rule::new("sec9_dominate", dominate).on(OurMeasure),
        Rule::new("sec9_convergence", convergence).on(OurMeasure).uses(&converging),
        Rule::new("sec9_shape", shape).on(OurMeasure),
        Rule::new("sec9_mean_large_p", mean_large_p).on(OurMeasure),
        Rule::new("sec9_explains_agreement", explains_agreement).on(OurMeasure),
        Rule::new("sec9_mean_small_p", mean_small_p).on(OurMeasure),
        Rule::new("sec9_higher_jump", higher_jump).on(OurMeasure),
        Rule::new("sec9_higher_jump_different", higher_jump_different).on(OurMeasure),
        Rule::new("sec9_fig15_modest", fig15_modest).on(OurMeasure),
        Rule::new("sec9_relation_matters", relation_matters).on(OurMeasure),
        Rule::new("sec10_improves", improves).on(OurMeasure),
    ]
}

fn fig6_repeats(e: &Evidence<'_>) -> Judged {
    let repeats = e.results.of(&SEGMENTS)?.fig06.repeats();
    let each = Vec::from_iter(repeats.iter().map(|(name, times)| format!("{name}: {times}")));
    let times: Vec<String> = repeats.iter().map(|(_, times)| times.to_string()).collect();
    let reads =
        e.statement.printed == format!("{} impacts; {} times", repeats.len(), times.join(", "));
    let first = repeats.first().is_some_and(|(name, _)| name == "L-1");
    let agrees = repeats.len() as f64 == e.statement.number()? && reads && first;
    e.check(agrees, numbers![repeats = each.join(", ")])
}

fn eq30(e: &Evidence<'_>) -> Judged {
    let [printed, counted] = e.numbers("theory.higher", ["eq30_printed", "eq30_counted"])?;
    let [all, failed] = compared_cases(e)?;
    let check = e.check(printed == counted, numbers![printed, counted, all])?;
    Ok(check.explained_if(failed == 0 && all > 0))
}

/// Judges one of Eqs. (33) to (37), by the number in the id.
fn class_range(e: &Evidence<'_>) -> Judged {
    let equation = e.statement.id.trim_start_matches("sec9_eq");
    let row = format!("theory.class_ranges[equation={equation}]");
    let columns = ["right_from", "counted_below", "formula_below", "failed", "compared"];
    let [right_from, counted, formula, failed, compared] = e.numbers(&row, columns)?;
    // A printed "k > 3" means from 4 on; without a printed range every length is meant.
    let printed_from = e.statement.value.map_or(1.0, |k| k + 1.0);
    let agrees = right_from == printed_from && failed == 0.0 && compared > 3.0;
    let check = e.check(agrees, numbers![right_from, formula, counted])?;
    Ok(match e.statement.value {
        Some(_) => check,
        // Without a range: wrong only where both loops are alike and so counted as half.
        None => check.explained_if(compared > 3.0 && right_from == 3.0 && counted == 0.0),
    })
}

/// Counts the cases of all k, and those from which on each formula is in its range.
fn eq38(e: &Evidence<'_>) -> Judged {
    let [all, wrong] = compared_cases(e)?;
    let row = "theory.cases[statement=sec9_eq38_in_range]";
    let [in_range, failed] = e.numbers(row, ["compared", "failed"])?.map(|count| count as usize);
    let why = e.sentence("note", numbers![in_range])?;
    Ok(e.all_cases(all, wrong).explained(why, failed == 0 && in_range > 0))
}

/// Returns a number of the distribution with five classes at one p.
fn of_five(e: &Evidence<'_>, p: f64, column: &str) -> Result<f64, Error> {
    e.number(&format!("theory.classes[p={p}].{column}"))
}

fn even_small_p(e: &Evidence<'_>) -> Judged {
    let p = e.statement.number()?;
    let (simple, first_order) = (of_five(e, p, "simple")?, of_five(e, p, "first_order")?);
    let higher = (1.0 - simple) / simple;
    let (share, predicted) = (100.0 * (1.0 - simple), 100.0 * first_order / (1.0 + first_order));
    let least = 100.0 * VISIBLE;
    let check = e.check(1.0 - simple >= VISIBLE, numbers![share, predicted, least])?;
    Ok(check.explained_if(higher > first_order && higher < 2.0 * first_order))
}

fn even_small_p_different(e: &Evidence<'_>) -> Judged {
    let higher = 1.0 - e.number("theory.higher.simple_by_different")?;
    // The share is computed at the smallest p of Fig. 13.
    let agrees = higher >= VISIBLE && e.statement.number()? == HIGHER_P[0];
    e.check(agrees, numbers![share = 100.0 * higher, least = 100.0 * VISIBLE])
}

fn dominate(e: &Evidence<'_>) -> Judged {
    let shares = REMARK_P.into_iter().map(|p| of_five(e, p, "simple"));
    let falls = shares.collect::<Result<Vec<_>, _>>()?.windows(2).all(|w| w[1] < w[0]);
    let p = HIGHER_P[2];
    let share = of_five(e, p, "simple")?;
    let limit = 0.01;
    e.check(share <= limit && falls, numbers![share, p, limit])
}

fn convergence(e: &Evidence<'_>) -> Judged {
    let (distance, [p_a, p_b]) = (|p| of_five(e, p, "variation"), CONVERGENCE_P);
    let (a, b) = (distance(p_a)?, distance(p_b)?);
    let later = REMARK_P.into_iter().filter(|p| *p >= p_a);
    let later = later.map(|p| Ok((p, distance(p)?))).collect::<Result<Vec<_>, Error>>()?;
    let falls = later.windows(2).all(|w| w[1].1 < w[0].1);
    let (p_last, last) = later.last().copied().unwrap_or((f64::NAN, f64::NAN));
    e.check(falls && later.len() > 2 && b < 0.5 * a, numbers![a, p_a, b, p_b, last, p_last])
}

/// Compares the distributions after one is moved onto the other.
fn shape(e: &Evidence<'_>) -> Judged {
    let [a, b] = CONVERGENCE_P.map(|p| of_five(e, p, "shape"));
    let (a, b, [p_a, p_b]) = (a?, b?, CONVERGENCE_P);
    let later = REMARK_P.into_iter().filter(|p| *p >= p_a).map(|p| of_five(e, p, "shape"));
    let later = later.collect::<Result<Vec<_>, Error>>()?;
    let falls = later.windows(2).all(|w| w[1] < w[0]);
    let last = later.last().copied().ok_or(Undecided)?;
    e.check(falls && b <= VISIBLE, numbers![a, p_a, b, p_b, visible = VISIBLE, last])
}

fn mean_large_p(e: &Evidence<'_>) -> Judged {
    let p = HIGHER_P[2];
    let mean = e.number(&format!("theory.distribution[p={p}].mean"))?;
    let difference = of_five(e, p, "mean_difference")? / mean;
    let limit = 0.05;
    e.check(difference.abs() <= limit, numbers![difference, p, limit])
}

/// Leaves open an explanation by the orders that are counted: those left out weigh more.
fn explains_agreement(e: &Evidence<'_>) -> Judged {
    e.check(None, numbers![p = HIGHER_P[2], doubling = e.number("theory.higher.doubling")?])
}

fn mean_small_p(e: &Evidence<'_>) -> Judged {
    let [difference, p] = e.numbers("theory.higher", ["means_ratio", "means_apart_at"])?;
    let limit = 0.1;
    e.check(difference >= limit, numbers![difference, p, limit])
}

fn higher_jump(e: &Evidence<'_>) -> Judged {
    let [higher, k_after] = e.numbers("theory.higher", ["p_jump", "k_after"])?;
    let simple = e.number("theory.jump.p_jump")?;
    let shift = higher / simple - 1.0;
    let change = 100.0 * shift;
    e.check(shift.abs() > 1e-9 && k_after >= 10.0, numbers![higher, k_after, simple, change])
}

fn higher_jump_different(e: &Evidence<'_>) -> Judged {
    let step = e.number("theory.higher.step_by_different")?;
    Ok(e.check(step >= 10.0, numbers![step])?.explained_if(overtaken_in_order() && step == 1.0))
}

/// “Modest” may be meant in number or along σ: where these disagree, our choice would decide.
fn fig15_modest(e: &Evidence<'_>) -> Judged {
    let columns = ["change", "change_at", "half_shift", "shift_there"];
    let [change, sigma, half_shift, shift] = e.numbers("theory.higher", columns)?;
    let (limit, moved) = (VERTICES as f64 / 10.0, half_unit(e)?);
    let is_small = |shift: f64| shift.abs() <= moved;
    let is_modest_along = sigma < LARGE_SIGMA && is_small(shift) && is_small(half_shift);
    let is_modest = sigma < LARGE_SIGMA && change <= limit;
    let agrees = (is_modest == is_modest_along).then_some(is_modest);
    e.check(agrees, numbers![change, sigma, large = LARGE_SIGMA, limit, shift, half_shift])
}

fn relation_matters(e: &Evidence<'_>) -> Judged {
    let columns = ["sigma_jump", "sigma_jump_rest", "sigma_jump_higher"];
    let [simple, rest, higher] = e.numbers("theory.relation", columns)?;
    let (relation, higher) = ((rest - simple).abs(), (higher - simple).abs());
    e.check(relation > higher, numbers![relation, higher])
}

fn improves(e: &Evidence<'_>) -> Judged {
    let [simple, higher] = e.numbers("sweep.against_theory", ["simple", "higher"])?;
    let is_better = |[simple, higher]: [f64; 2]| higher < simple && higher >= 0.8 * simple;
    let table = e.results.table("theory.curve")?;
    let column = |name| table.curve(&[], "sigma", name);
    let curves = [column("simple")?, column("higher")?];
    let windows = means_in_windows(e)?;
    let mut better = 0;
    for means in &windows {
        let [simple, higher] = curves.each_ref().map(|curve| comparison::distance(means, curve));
        better += usize::from(simple.zip(higher).is_some_and(|(a, b)| is_better([a, b])));
    }
    let agrees = is_better([simple, higher]) && better == windows.len();
    let (large, windows, released) = (LARGE_SIGMA, windows.len(), RELEASED);
    e.check(agrees, numbers![large, simple, higher, better, windows, released])
}
