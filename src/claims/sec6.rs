//! Judges Section 6, the probability of circuits.

use super::sec2;
use super::shared::*;

pub fn rules() -> Vec<Rule> {
    let fig8 = ["fig8_p_a", "fig8_p_b", "fig8_p_c", "fig8_p_d"];
    let fig8: Vec<(&str, f64)> = fig8.into_iter().zip(DISTRIBUTION_P).collect();
    vec![
        defined("sec6_normalised").reads("{}"),
        Rule::new("sec6_fig8_few", few).on(OurMeasure),
        Rule::new("sec6_fig8_rise", rise).on(OurMeasure).uses(&fig8),
        Rule::new("sec6_fig9_step", step).on(OurMeasure),
        Rule::new("sec6_mean_zero", mean_zero).on(OurMeasure).reads("μ(0) = {}"),
        Rule::new("sec6_like_simulation", like_simulation).on(OurMeasure),
    ]
}

fn few(e: &Evidence<'_>) -> Judged {
    let p = DISTRIBUTION_P[0];
    let [mean, k_star] = e.numbers(&format!("theory.distribution[p={p}]"), ["mean", "k_star"])?;
    let limit = VERTICES as f64 / sec2::VERY_FEW;
    e.check(mean <= limit && k_star == 1.0, numbers![mean, k_star, p, limit])
}

fn rise(e: &Evidence<'_>) -> Judged {
    let [from, _, to, _] = DISTRIBUTION_P;
    let mean = |p: f64| e.number(&format!("theory.distribution[p={p}].mean"));
    let (few, many, n) = (mean(from)?, mean(to)?, VERTICES as f64);
    e.check(few < 0.1 * n && many > 0.75 * n, numbers![few, many, from, to, increase = to - from])
}

fn step(e: &Evidence<'_>) -> Judged {
    let [largest, second] = e.numbers("theory.mean", ["largest_step", "other_steps"])?;
    e.check(largest * 10.0 >= VERTICES as f64 && second == 1.0, numbers![largest, second])
}

/// At p = 0 itself the weights are 0/0: a value there is a convention, which is neither right nor
/// wrong.
fn mean_zero(e: &Evidence<'_>) -> Judged {
    let least = e.number("theory.mean.at_zero")?;
    e.check((least == e.statement.number()?).then_some(true), numbers![least])
}

fn like_simulation(e: &Evidence<'_>) -> Judged {
    let theory = e.numbers("theory.mean", ["at_zero", "at_one"])?;
    let [least, most] = theory.map(|mean| mean / VERTICES as f64);
    e.check(None, numbers![least, most])
}
