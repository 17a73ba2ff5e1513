//! Judges Section 6, the probability of circuits.

use super::sec2;
use super::shared::*;
use crate::params::{DISTRIBUTION_P, VERTICES};

pub fn rules() -> Vec<Rule> {
    vec![
        defined("sec6_normalised").reads("{}"),
        Rule::new("sec6_fig8_few", few).on(OurMeasure),
        Rule::new("sec6_fig8_rise", rise).on(OurMeasure),
        Rule::new("sec6_fig9_step", step).on(OurMeasure),
        Rule::new("sec6_mean_zero", mean_zero).reads("μ(0) = {}"),
        Rule::new("sec6_like_simulation", like_simulation).on(OurMeasure),
    ]
}

fn few(e: &Evidence<'_>) -> Judged {
    let p = DISTRIBUTION_P[0];
    let [mean, k_star] = e.numbers(&format!("theory.distribution[p={p}]"), ["mean", "k_star"])?;
    let limit = VERTICES as f64 / sec2::VERY_FEW;
    let found = text!("μ = {:4}, k* = {} at p = {}", mean, k_star, p);
    Ok(e.found(found, mean <= limit && k_star == 1.0)
        .within(text!("at most {:2}", limit), "ours: “very few” as a twentieth of all vertices"))
}

fn rise(e: &Evidence<'_>) -> Judged {
    let [a, _, c, _] = DISTRIBUTION_P;
    let mean = |p: f64| e.number(&format!("theory.distribution[p={p}].mean"));
    let (few, many, n) = (mean(a)?, mean(c)?, VERTICES as f64);
    let found = text!("μ from {:3} to {:3} while p goes from {} to {}", few, many, a, c);
    let reason = "ours: what “rapidly towards the size of the whole system” asks at least";
    let note = "The increase of p is {:2} of its whole range, from no edge to every edge.";
    Ok(e.found(found, few < 0.1 * n && many > 0.75 * n)
        .within("from below a tenth to above three quarters of N", reason)
        .note(text!(note, c - a)))
}

fn step(e: &Evidence<'_>) -> Judged {
    let [largest, second] = e.numbers("theory.mean", ["largest_step", "other_steps"])?;
    let found = text!("one step of height {}, all others {}", largest, second);
    let reason = "ours: “large” as at least a tenth of N; steps of integers are at least one";
    Ok(e.found(found, largest * 10.0 >= VERTICES as f64 && second == 1.0)
        .within("one step of ten or more, all others of one", reason))
}

fn mean_zero(e: &Evidence<'_>) -> Judged {
    let least = e.number("theory.mean.at_zero")?;
    let why = "At p = 0 itself Eq. (9) is 0/0. The paper gives the limit of the mode, one, as its value there; read \
         in the same way the mean is one too, since the circuits of one edge then hold all the weight. Zero is the \
         number of a graph without edges.";
    Ok(e.found(text!("μ → {:1} as p → 0+", least), least == e.statement.number()?)
        .within("none", "a limit is exact")
        .explained(why, least == e.number("theory.jump.k_at_zero")?))
}

fn like_simulation(e: &Evidence<'_>) -> Judged {
    let theory = e.numbers("theory.mean", ["at_zero", "at_one"])?;
    let [least, most] = theory.map(|mean| mean / VERTICES as f64);
    let found = text!("of the theory from {:2} to {:2} of N as p grows", least, most);
    let note = "The paper names a likeness of curves over different axes, but no quantity. Any two curves that rise \
         from few to all would have it. With the relation between σ and p they can be compared, in Section 8.";
    Ok(e.open(found).note(note))
}
