//! Section 6: probability.

use super::Basis::{OurMeasure, Rounding};
use super::row::{Error, Evidence, Row, measured, theory};
use super::sec2;
use super::{Finding, open, rounding};
use super::{Judgement, Statement, Text};
use crate::experiments::{SWEEP, sweep};
use crate::params::{DISTRIBUTION_P, VERTICES};

pub const ROWS: &[Row] = &[
    theory("sec6_normalised", Rounding, |e, s| {
        let found = e.number("theory.differences[statement=sec6_normalised].largest")?;
        let off = found.max((s.number()? - 1.0).abs());
        Ok(rounding(off, 1e-13, "Over ten values of p up to one."))
    }),
    theory("sec6_fig8_few", OurMeasure, few),
    theory("sec6_fig8_rise", OurMeasure, rise),
    theory("sec6_fig9_step", OurMeasure, step),
    measured("sec6_like_simulation", OurMeasure, &[&SWEEP], like_simulation),
];

fn few(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let p = DISTRIBUTION_P[0];
    let of = |column| e.number(&format!("theory.distribution[p={p}].{column}"));
    let (mean, k_star) = (of("mean")?, of("k_star")?);
    let limit = VERTICES as f64 / sec2::VERY_FEW;
    Ok(Finding {
        ours: Text::words("μ = ")
            .significant(mean, 4)
            .say(", k* = ")
            .integer(k_star as usize)
            .say(" at p = ")
            .chosen(p),
        tolerance: Text::words("at most ").significant(limit, 2),
        reason: "ours: “very few” as a twentieth of all vertices",
        judgement: Judgement::Plain { agrees: mean <= limit && k_star == 1.0 },
        note: Text::default(),
    })
}

fn rise(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let [a, _, c, _] = DISTRIBUTION_P;
    let mean = |p: f64| e.number(&format!("theory.distribution[p={p}].mean"));
    let (few, many, n) = (mean(a)?, mean(c)?, VERTICES as f64);
    Ok(Finding {
        ours: Text::words("μ from ")
            .significant(few, 3)
            .say(" to ")
            .significant(many, 3)
            .say(" while p goes from ")
            .chosen(a)
            .say(" to ")
            .chosen(c),
        tolerance: Text::words("from below a tenth to above three quarters of N"),
        reason: "ours: what “rapidly towards the size of the whole system” asks at least",
        judgement: Judgement::Plain { agrees: few < 0.1 * n && many > 0.75 * n },
        note: Text::default(),
    })
}

fn step(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let [largest, second] =
        [e.number("theory.mean.largest_step")?, e.number("theory.mean.other_steps")?]
            .map(|step| step as usize);
    Ok(Finding {
        ours: Text::words("one step of height ")
            .integer(largest)
            .say(", all others ")
            .integer(second),
        tolerance: Text::words("one step of ten or more, all others of one"),
        reason: "ours: “large” as at least a tenth of N; a step function of integers has ones",
        judgement: Judgement::Plain { agrees: largest * 10 >= VERTICES && second == 1 },
        note: Text::default(),
    })
}

fn like_simulation(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let sweep = sweep::main(e.results)?;
    let simulated: Vec<f64> = sweep
        .first()
        .rows
        .iter()
        .filter_map(|row| Some(row.mean?.value / sec2::gaps(sweep)))
        .collect();
    let n = VERTICES as f64;
    let (c, d) = (e.number("theory.mean.at_zero")? / n, e.number("theory.mean.at_one")? / n);
    let (Some(&a), Some(&b)) = (simulated.first(), simulated.last()) else {
        return Ok(open(Text::words("no curves"), "One of the two curves is empty."));
    };
    let rises = |[low, high]: [f64; 2]| low < 0.25 && high > 0.9;
    Ok(Finding {
        ours: Text::words("simulated from ")
            .significant(a, 2)
            .say(" to ")
            .significant(b, 2)
            .say(" of N, theory from ")
            .significant(c, 2)
            .say(" to ")
            .significant(d, 2)
            .say("; k* jumps"),
        tolerance: Text::words("both from below a quarter to above nine tenths"),
        reason: "ours: the least that a common rise must do",
        judgement: Judgement::Plain {
            agrees: rises([a, b])
                && rises([c, d])
                && e.number("theory.cases[statement=sec6_like_simulation].failed")? == 0.0
                && e.number("theory.jump.k_after")? > 1.0,
        },
        note: Text::words(
            "Simulated is the mean of the kept. What agrees beyond this is judged in Section 8.",
        ),
    })
}
