//! Judges Sections 9 and 10, circuits that repeat impacts and the conclusions.

use super::sec8::{VISIBLE, windows};
use super::shared::*;
use crate::experiments::SEGMENTS;
use crate::experiments::theory::comparison::{self, LARGE_SIGMA};
use crate::experiments::theory::higher::overtaken_in_order;
use crate::params::{CONVERGENCE_P, HIGHER_P, REMARK_P, VERTICES};

pub fn rules() -> Vec<Rule> {
    vec![
        Rule::new("sec9_fig6_repeats", fig6_repeats),
        cases("sec9_eq29", LOOPS).reads("(N − 1)!/(N − (k − 1))!"),
        Rule::new("sec9_eq30", eq30).on(FiniteCases).reads("γ(k, 2)/2 · (N − 1)!/(N − (k − 1))!"),
        cases("sec9_eq32", SUMS).reads("(n − 1)!/((j − 1)! (n − j)!)"),
        Rule::new("sec9_eq33", class_range).on(FiniteCases).reads("(k − 1)/2 · N!/(N − (k − 1))!"),
        Rule::new("sec9_eq35", class_range).on(FiniteCases).reads("valid for k > {}"),
        Rule::new("sec9_eq36", class_range).on(FiniteCases).reads("valid for k > {}"),
        Rule::new("sec9_eq37", class_range).on(FiniteCases).reads("valid for k > {}"),
        Rule::new("sec9_eq38", eq38).on(FiniteCases).reads("Eq. (38)"),
        Rule::new("sec9_even_small_p", even_small_p).on(OurMeasure).reads("significant at p = {}"),
        Rule::new("sec9_even_small_p_different", even_small_p_different)
            .on(OurMeasure)
            .reads("significant at p = {}"),
        Rule::new("sec9_dominate", dominate).on(OurMeasure),
        Rule::new("sec9_convergence", convergence).on(OurMeasure),
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

const LOOPS: &str = "Circuits through one vertex twice, by the lengths of their loops, on graphs of one to six \
         vertices.";
const SUMS: &str = "Every n up to ten; the sums are counted one by one.";
const INTEGER: &str = "integers are exact";

fn fig6_repeats(e: &Evidence<'_>) -> Judged {
    let found = e.results.of(&SEGMENTS)?.fig06.repeats();
    let each: Vec<String> = found.iter().map(|(name, times)| format!("{name}: {times}")).collect();
    let times: Vec<String> = found.iter().map(|(_, times)| times.to_string()).collect();
    let reads =
        e.statement.printed == format!("{} impacts; {} times", found.len(), times.join(", "));
    let first = found.first().is_some_and(|(name, _)| name == "L-1");
    Ok(e.found(each.join(", "), found.len() as f64 == e.statement.number()? && reads && first)
        .within("none", INTEGER)
        .note("This class, δ₂ = 1 and δ₁ = 2, is none of the five of Eq. (38)."))
}

fn eq30(e: &Evidence<'_>) -> Judged {
    let [printed, counted] = e.numbers("theory.higher", ["eq30_printed", "eq30_counted"])?;
    let [compared, failed] = compared(e)?;
    let found = text!("Eq. (30) gives {:1}, enumeration {}", printed, counted);
    let why = "A factor N is missing, the choice of the vertex that is visited twice; Eq. (33) has it. With it the \
         formula agrees in {} of {} cases.";
    Ok(e.found(found, printed == counted)
        .within("none", INTEGER)
        .explained(text!(why, compared, compared), failed == 0 && compared > 0))
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
    let why = "At one length below, on three vertices, the formula gives {} and enumeration finds {}: sequences that \
         repeat a shorter one.";
    let why = text!(why, formula, counted);
    let found = text!("right from k = {} on", right_from);
    let check = e.found(found, agrees).within("none", INTEGER);
    Ok(match e.statement.value {
        Some(_) => check.note(why),
        // Without a range: wrong only where both loops are alike and so counted as half.
        None => check.explained(why, compared > 3.0 && right_from == 3.0 && counted == 0.0),
    })
}

/// Counts the cases of all k, and those from which on each formula is in its range.
fn eq38(e: &Evidence<'_>) -> Judged {
    let [all, wrong] = compared(e)?;
    let row = "theory.cases[statement=sec9_eq38_in_range]";
    let [in_range, failed] = e.numbers(row, ["compared", "failed"])?.map(|count| count as usize);
    let why = "Each of {} cases from k = 3 on agrees. No smallest k is printed, and the distribution needs k = 1 and \
         2 as well; there the sum uses Eqs. (35) to (37) below their printed ranges.";
    Ok(e.all_cases(all, wrong).explained(text!(why, in_range), failed == 0 && in_range > 0))
}

/// Returns a number of the distribution with five classes at one p.
fn of_five(e: &Evidence<'_>, p: f64, column: &str) -> Result<f64, Error> {
    e.number(&format!("theory.classes[p={p}].{column}"))
}

fn even_small_p(e: &Evidence<'_>) -> Judged {
    let p = e.statement.number()?;
    let (share, first_order) = (of_five(e, p, "simple")?, of_five(e, p, "first_order")?);
    let higher = (1.0 - share) / share;
    let found = text!("higher orders hold {:2} %", 100.0 * (1.0 - share));
    let predicted = 100.0 * first_order / (1.0 + first_order);
    let why = "The weight that Section 4 prints. A doubled vertex has relative weight p k²/2, which is below one for \
         the small k that hold nearly everything; this first order alone predicts {:2} %, and further orders less than \
         as much again. They dominate only in the tail.";
    Ok(e.found(found, 1.0 - share >= VISIBLE)
        .within("at least 5 %", "ours: the least that can be seen in a figure")
        .explained(text!(why, predicted), higher > first_order && higher < 2.0 * first_order))
}

const BY_DIFFERENT: &str = "Eq. (38) counts circuits by their different impacts, but Section 4 prints a factor for each edge.";

fn even_small_p_different(e: &Evidence<'_>) -> Judged {
    let higher = 1.0 - e.number("theory.higher.simple_by_different")?;
    let found = text!("higher orders hold {:2} %", 100.0 * higher);
    // The share is computed at the smallest p of Fig. 13.
    Ok(e.found(found, higher >= VISIBLE && e.statement.number()? == HIGHER_P[0])
        .within("at least 5 %", "ours: the least that can be seen in a figure")
        .note(BY_DIFFERENT))
}

fn dominate(e: &Evidence<'_>) -> Judged {
    let shares = REMARK_P.into_iter().map(|p| of_five(e, p, "simple"));
    let shares = shares.collect::<Result<Vec<_>, _>>()?;
    let falls = shares.windows(2).all(|w| w[1] < w[0]);
    let p = HIGHER_P[2];
    let share = of_five(e, p, "simple")?;
    let found = text!("simple circuits hold {:2} at p = {}", share, p);
    let reason = "ours: “insignificant” as at most one in a hundred, and falling with p";
    Ok(e.found(found, share <= 0.01 && falls).within(text!("at most {:1}", 0.01), reason))
}

fn convergence(e: &Evidence<'_>) -> Judged {
    let (distance, [p_a, p_b]) = (|p| of_five(e, p, "variation"), CONVERGENCE_P);
    let (a, b) = (distance(p_a)?, distance(p_b)?);
    let later = REMARK_P.into_iter().filter(|p| *p >= p_a);
    let later = later.map(|p| Ok((p, distance(p)?))).collect::<Result<Vec<_>, Error>>()?;
    let falls = later.windows(2).all(|w| w[1].1 < w[0].1);
    let (p_last, last) = later.last().copied().unwrap_or((f64::NAN, f64::NAN));
    let found = text!("total variation distance {:3} at p = {}, {:3} at {}", a, p_a, b, p_b);
    let near = p_b <= p_last && b <= VISIBLE;
    let reason =
        "ours: the least that can be seen in a figure, as for higher orders at the smallest p";
    let why = "The distance falls at every p that was computed, to {:2} at p = {}; the two come together only beyond \
         the p of the figure. The difference is a shift of all k by about one: see the next statement.";
    Ok(e.found(found, falls && near)
        .within(text!("falling, and at most {:1} in panel (b)", VISIBLE), reason)
        .explained(text!(why, last, p_last), falls && later.len() > 2 && b < 0.5 * a))
}

/// Compares the distributions after one is moved onto the other.
fn shape(e: &Evidence<'_>) -> Judged {
    let [a, b] = CONVERGENCE_P.map(|p| of_five(e, p, "shape"));
    let (a, b, [p_a, p_b]) = (a?, b?, CONVERGENCE_P);
    let later = REMARK_P.into_iter().filter(|p| *p >= p_a).map(|p| of_five(e, p, "shape"));
    let later = later.collect::<Result<Vec<_>, Error>>()?;
    let falls = later.windows(2).all(|w| w[1] < w[0]);
    let last = later.last().copied().ok_or(Undecided)?;
    let found = text!("total variation distance {:2} at p = {}, {:2} at {}", a, p_a, b, p_b);
    let reason = "ours: the least that can be seen in a figure, as in the statement before";
    let note = "The least distance over shifts by up to ten. It falls at every p that was computed from there on, to {:2}.";
    Ok(e.found(found, falls && b <= VISIBLE)
        .within(text!("falling, and at most {:1} in panel (b)", VISIBLE), reason)
        .note(text!(note, last)))
}

fn mean_large_p(e: &Evidence<'_>) -> Judged {
    let p = HIGHER_P[2];
    let mean = e.number(&format!("theory.distribution[p={p}].mean"))?;
    let difference = of_five(e, p, "mean_difference")? / mean;
    let found = text!("relative difference {:2} at p = {}", difference, p);
    Ok(e.found(found, difference.abs() <= 0.05)
        .within(text!("at most {:1}", 0.05), "ours: “very good” as within one in twenty"))
}

/// Leaves open an explanation by the orders that are counted: those left out weigh more.
fn explains_agreement(e: &Evidence<'_>) -> Judged {
    let doubling = e.number("theory.higher.doubling")?;
    let found = "at p = {} one more doubled vertex multiplies the weight by {:3}";
    let found = text!(found, HIGHER_P[2], doubling);
    let note = "There is no number to compare. The orders that are left out outweigh those that are counted, and \
         theory and simulation both approach all gaps whatever the weights are.";
    Ok(e.open(found).note(note))
}

fn mean_small_p(e: &Evidence<'_>) -> Judged {
    let [difference, at] = e.numbers("theory.higher", ["means_ratio", "means_apart_at"])?;
    let found = text!("relative difference up to {:2}, at p = {}", difference, at);
    Ok(e.found(found, difference >= 0.1)
        .within(text!("at least {:1}", 0.1), "ours: “measurable” as one in ten"))
}

fn higher_jump(e: &Evidence<'_>) -> Judged {
    let [higher, k_after] = e.numbers("theory.higher", ["p_jump", "k_after"])?;
    let simple = e.number("theory.jump.p_jump")?;
    let shift = higher / simple - 1.0;
    let found =
        text!("p_jump = {:6}, to k* = {}; for simple circuits {:6}", higher, k_after, simple);
    let reason = "both are known to the last bit; “jump” as in Section 7";
    let note = "The weight that Section 4 prints. A change by {:2} %.";
    Ok(e.found(found, shift.abs() > 1e-9 && k_after >= 10.0)
        .within("another p, and a step of ten or more", reason)
        .note(text!(note, 100.0 * shift)))
}

fn higher_jump_different(e: &Evidence<'_>) -> Judged {
    let step = e.number("theory.higher.step_by_different")?;
    let why = Text::from(BY_DIFFERENT).then(
        " Each k + 1 then overtakes k at a larger p than k overtook the one before, so k* climbs by one at a time. With \
         neither weight do both this remark and that on small p hold.",
    );
    Ok(e.found(text!("largest step of k* {}", step), step >= 10.0)
        .within("a step of ten or more", "“jump” as in Section 7")
        .explained(why, overtaken_in_order() && step == 1.0))
}

fn fig15_modest(e: &Evidence<'_>) -> Judged {
    let columns = ["change", "change_at", "half_shift", "shift_there"];
    let [change, sigma, half_shift, shift] = e.numbers("theory.higher", columns)?;
    let (limit, moved) = (VERTICES as f64 / 10.0, half_unit(e)?);
    let found = text!("largest change {:3} gaps, at σ = {}", change, sigma);
    let reason = "ours: “small σ” as what is not large in Section 8; “modest” as a tenth of N, as in Section 6";
    let why = "The change is modest along σ, and large in number only because the curve is so steep there: it is moved by \
         {:2} in σ, and its half height by {:2}, less than half a unit of the digit in which the paper prints the \
         threshold.";
    let is_small = |shift: f64| shift.abs() <= moved;
    let is_modest_along = sigma < LARGE_SIGMA && is_small(shift) && is_small(half_shift);
    Ok(e.found(found, sigma < LARGE_SIGMA && change <= limit)
        .within(text!("below σ = {:1}; by at most {}", LARGE_SIGMA, limit), reason)
        .explained(text!(why, shift, half_shift), is_modest_along))
}

fn relation_matters(e: &Evidence<'_>) -> Judged {
    let columns = ["sigma_jump", "sigma_jump_rest", "sigma_jump_higher"];
    let [simple, rest, higher] = e.numbers("theory.relation", columns)?;
    let (relation, higher) = ((rest - simple).abs(), (higher - simple).abs());
    let found = "another relation moves the jump by {:3} in σ, higher orders by {:2}";
    let found = text!(found, relation, higher);
    Ok(e.found(found, relation > higher)
        .within("the first is larger", "a comparison of two computed numbers")
        .note("The other relation is that of a start from rest, our choice; the paper names none."))
}

fn improves(e: &Evidence<'_>) -> Judged {
    let [simple, higher] = e.numbers("sweep.against_theory", ["simple", "higher"])?;
    let found = "distance to the simulated means below σ = {:1}: {:3} gaps without, {:3} with higher orders";
    let found = text!(found, LARGE_SIGMA, simple, higher);
    let improved = |[simple, higher]: [f64; 2]| higher < simple && higher >= 0.8 * simple;
    let table = e.results.table("theory.curve")?;
    let column = |name| table.curve(&[], "sigma", name);
    let curves = [column("simple")?, column("higher")?];
    let windows = windows(e)?;
    let mut better = 0;
    for means in &windows {
        let [simple, higher] = curves.each_ref().map(|curve| comparison::distance(means, curve));
        better += usize::from(simple.zip(higher).is_some_and(|(a, b)| improved([a, b])));
    }
    let reason = "ours: “slightly”; the distance is the root of the mean square over all rows";
    let note = "It falls likewise in {} of the {} windows of the map of protocols with T ≥ {}.";
    Ok(e.found(found, improved([simple, higher]) && better == windows.len())
        .within("a decrease by at most a fifth", reason)
        .note(text!(note, better, windows.len(), RELEASED)))
}
