//! Section 6: probability.

use super::Basis::{OurMeasure, Rounding};
use super::row::{Error, Evidence, Row, measured, theory};
use super::sec2;
use super::{Finding, open, rounding};
use super::{Judgement, Statement, Text};
use crate::experiments::SWEEP;
use crate::experiments::theory::tables::two_largest_steps;

pub const ROWS: &[Row] = &[
    theory("sec6_normalised", Rounding, |e, s| {
        let off = e.results.identities.normalisation.max((s.number()? - 1.0).abs());
        Ok(rounding(off, 1e-13, "Over ten values of p up to one."))
    }),
    theory("sec6_fig8_few", OurMeasure, few),
    theory("sec6_fig8_rise", OurMeasure, rise),
    theory("sec6_fig9_step", OurMeasure, step),
    measured("sec6_like_simulation", OurMeasure, &[&SWEEP], like_simulation),
];

fn few(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let theory = &e.results.theory;
    let Some(panel) = theory.distributions.first() else {
        return Ok(open(Text::words("nothing"), "Fig. 8 was not computed."));
    };
    let limit = theory.vertices as f64 / sec2::VERY_FEW;
    Ok(Finding {
        ours: Text::words("μ = ")
            .significant(panel.mean, 4)
            .say(", k* = ")
            .integer(panel.k_star)
            .say(" at p = ")
            .chosen(panel.p),
        tolerance: Text::words("at most ").significant(limit, 2),
        reason: "ours: “very few” as a twentieth of all vertices",
        judgement: Judgement::Plain { agrees: panel.mean <= limit && panel.k_star == 1 },
        note: Text::default(),
    })
}

fn rise(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let theory = &e.results.theory;
    let (Some(a), Some(c)) = (theory.distributions.first(), theory.distributions.get(2)) else {
        return Ok(open(Text::words("nothing"), "Fig. 8 was not computed."));
    };
    let n = theory.vertices as f64;
    Ok(Finding {
        ours: Text::words("μ from ")
            .significant(a.mean, 3)
            .say(" to ")
            .significant(c.mean, 3)
            .say(" while p goes from ")
            .chosen(a.p)
            .say(" to ")
            .chosen(c.p),
        tolerance: Text::words("from below a tenth to above three quarters of N"),
        reason: "ours: what “rapidly towards the size of the whole system” asks at least",
        judgement: Judgement::Plain { agrees: a.mean < 0.1 * n && c.mean > 0.75 * n },
        note: Text::default(),
    })
}

fn step(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let theory = &e.results.theory;
    let [largest, second] = two_largest_steps(&theory.most_likely.steps);
    Ok(Finding {
        ours: Text::words("one step of height ")
            .integer(largest)
            .say(", all others ")
            .integer(second),
        tolerance: Text::words("one step of ten or more, all others of one"),
        reason: "ours: “large” as at least a tenth of N; a step function of integers has ones",
        judgement: Judgement::Plain { agrees: largest * 10 >= theory.vertices && second == 1 },
        note: Text::default(),
    })
}

fn like_simulation(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let sweep = e.results.of(&SWEEP)?;
    let theory = &e.results.theory;
    let simulated: Vec<f64> =
        sweep.rows.iter().filter_map(|row| Some(row.mean_distinct? / sec2::gaps(sweep))).collect();
    let n = theory.vertices as f64;
    let mean: Vec<f64> = theory.most_likely.mean.iter().map(|row| row.mean / n).collect();
    let ends = |curve: &[f64]| Some([*curve.first()?, *curve.last()?]);
    let (Some([a, b]), Some([c, d])) = (ends(&simulated), ends(&mean)) else {
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
                && mean.windows(2).all(|w| w[1] >= w[0])
                && theory.scalars.k_after_jump > 1,
        },
        note: Text::words(
            "Simulated is the mean of the kept. What agrees beyond this is judged in Section 8.",
        ),
    })
}
