//! Section 9: circuits that repeat impacts.

use super::Basis::{Exact, OurMeasure};
use super::Finding;
use super::row::{Error, Evidence, Row, cases, measured, theory};
use super::{Judgement, Statement, Text};
use crate::experiments::SEGMENTS;
use crate::experiments::theory::beside::LARGE_SIGMA;
use crate::params::{CONVERGENCE_P, HIGHER_P, REMARK_P};

pub const ROWS: &[Row] = &[
    measured("sec9_fig6_repeats", Exact, &[&SEGMENTS], fig6_repeats),
    theory("sec9_eq29", Exact, |e, s| {
        cases(
            e,
            s,
            "Circuits through one vertex twice, by the lengths of their loops, on graphs of one to six vertices.",
        )
    })
    .of("(N − 1)!/(N − (k − 1))!"),
    theory("sec9_eq30", Exact, eq30).of("γ(k, 2)/2 · (N − 1)!/(N − (k − 1))!"),
    theory("sec9_eq32", Exact, |e, s| cases(e, s, "Every n up to ten, one sum at a time.")).of("(n − 1)!/((j − 1)! (n − j)!)"),
    theory("sec9_eq33", Exact, |e, s| class_range(e, s, 33)).of("(k − 1)/2 · N!/(N − (k − 1))!"),
    theory("sec9_eq35", Exact, |e, s| class_range(e, s, 35)).of("valid for k > {}"),
    theory("sec9_eq36", Exact, |e, s| class_range(e, s, 36)).of("valid for k > {}"),
    theory("sec9_eq37", Exact, |e, s| class_range(e, s, 37)).of("valid for k > {}"),
    theory("sec9_eq38", Exact, |e, s| {
        cases(
            e,
            s,
            "From k = 3 on, where each formula is used in the range that is printed with it. For k = 1 and \
             2, which the distribution needs too, it is not.",
        )
    })
    .of("Eq. (38)"),
    theory("sec9_even_small_p", OurMeasure, even_small_p).of("significant at p = {}"),
    theory("sec9_dominate", OurMeasure, dominate),
    theory("sec9_convergence", OurMeasure, convergence),
    theory("sec9_mean_large_p", OurMeasure, mean_large_p),
    theory("sec9_mean_small_p", OurMeasure, mean_small_p),
    theory("sec9_higher_jump", OurMeasure, higher_jump),
    theory("sec9_fig15_modest", OurMeasure, fig15_modest),
    theory("sec9_relation_matters", Exact, relation_matters),
];

const INTEGER: &str = "integers are exact";

fn fig6_repeats(e: &Evidence, s: &Statement) -> Result<Finding, Error> {
    let found = e.results.of(&SEGMENTS)?.fig06.repeats();
    let text = found.iter().enumerate().fold(Text::default(), |text, (i, (name, times))| {
        text.say(if i == 0 { "" } else { ", " }).say(format!("{name}: ")).integer(*times)
    });
    let times: Vec<String> = found.iter().map(|(_, times)| times.to_string()).collect();
    let reads = s.printed == format!("{} impacts; {} times", found.len(), times.join(", "));
    let first = found.first().map(|(name, _)| name.as_str());
    Ok(Finding {
        ours: text,
        tolerance: Text::words("none"),
        reason: INTEGER,
        judgement: Judgement::Plain {
            agrees: found.len() as f64 == s.number()? && reads && first == Some("L-1"),
        },
        note: Text::words("This class, δ₂ = 1 and δ₁ = 2, is none of the five of Eq. (38)."),
    })
}

fn eq30(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let (printed, counted) =
        (e.number("theory.higher.eq30_printed")?, e.number("theory.higher.eq30_counted")?);
    let compared = e.number("theory.cases[statement=sec9_eq30].compared")?;
    let failed = e.number("theory.cases[statement=sec9_eq30].failed")?;
    Ok(Finding {
        ours: Text::words("Eq. (30) gives ")
            .significant(printed, 1)
            .say(", enumeration ")
            .integer(counted as usize),
        tolerance: Text::words("none"),
        reason: INTEGER,
        judgement: Judgement::Explained {
            agrees: printed == counted,
            holds: failed == 0.0 && compared > 0.0,
        },
        note: Text::words(
            "A factor N is missing, the choice of the vertex that is visited twice; \
             Eq. (33) has it. With it the formula agrees in ",
        )
        .integer(compared as usize)
        .say(" of ")
        .integer(compared as usize)
        .say(" cases."),
    })
}

fn class_range(e: &Evidence, s: &Statement, equation: u32) -> Result<Finding, Error> {
    let of = |column| e.number(&format!("theory.class_ranges[equation={equation}].{column}"));
    let (right_from, counted) = (of("right_from")?, of("counted_below")?);
    // A printed "k > 3" means from 4 on; without a printed range every length is meant.
    let printed_from = s.value.map_or(1.0, |k| k + 1.0);
    let agrees = right_from == printed_from && of("failed")? == 0.0;
    let ours = Text::words("right from k = ").integer(right_from as usize).say(" on");
    let note = Text::words("One length below, on three vertices, the formula gives ")
        .chosen(of("formula_below")?)
        .say(" and enumeration finds ")
        .integer(counted as usize)
        .say(": sequences that repeat a shorter one.");
    let compared = of("compared")? > 3.0;
    Ok(Finding {
        ours,
        tolerance: Text::words("none"),
        reason: INTEGER,
        judgement: match s.value {
            Some(_) => Judgement::Plain { agrees: agrees && compared },
            // Without a range: wrong only where both loops are alike and so counted as half.
            None => Judgement::Explained {
                agrees: agrees && compared,
                holds: compared && right_from == 3.0 && counted == 0.0,
            },
        },
        note,
    })
}

/// A number of the distribution with five classes at one p.
fn of_five(e: &Evidence, p: f64, column: &str) -> Result<f64, Error> {
    e.number(&format!("theory.classes[p={p}].{column}"))
}

fn even_small_p(e: &Evidence, s: &Statement) -> Result<Finding, Error> {
    let p = s.number()?;
    let (share, first_order) = (of_five(e, p, "simple")?, of_five(e, p, "first_order")?);
    let higher = (1.0 - share) / share;
    Ok(Finding {
        ours: Text::words("higher orders hold ").significant(100.0 * (1.0 - share), 2).say(" %"),
        tolerance: Text::words("at least 5 %"),
        reason: "ours: the least that can be seen in a figure",
        judgement: Judgement::Explained {
            agrees: 1.0 - share >= 0.05,
            holds: higher > first_order && higher < 2.0 * first_order,
        },
        note: Text::words(
            "A doubled vertex has relative weight p k²/2, which is below one for the small k that \
             hold nearly everything; this first order alone predicts ",
        )
        .significant(100.0 * first_order / (1.0 + first_order), 2)
        .say(" %, and further orders less than as much again. They dominate only in the tail."),
    })
}

fn dominate(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let shares =
        REMARK_P.into_iter().map(|p| of_five(e, p, "simple")).collect::<Result<Vec<_>, _>>()?;
    let falls = shares.windows(2).all(|w| w[1] < w[0]);
    let p = HIGHER_P[2];
    let share = of_five(e, p, "simple")?;
    Ok(Finding {
        ours: Text::words("simple circuits hold ").significant(share, 2).say(" at p = ").chosen(p),
        tolerance: Text::words("at most ").significant(0.01, 1),
        reason: "ours: “insignificant” as at most one in a hundred, and falling with p",
        judgement: Judgement::Plain { agrees: share <= 0.01 && falls },
        note: Text::default(),
    })
}

fn convergence(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let (distance, [p_a, p_b]) = (|p| of_five(e, p, "variation"), CONVERGENCE_P);
    let (a, b) = (distance(p_a)?, distance(p_b)?);
    let later = REMARK_P.into_iter().filter(|p| *p >= p_a);
    let later = later.map(|p| Ok((p, distance(p)?))).collect::<Result<Vec<_>, Error>>()?;
    let falls = later.windows(2).all(|w| w[1].1 < w[0].1);
    let (p_last, last) = later.last().copied().unwrap_or((f64::NAN, f64::NAN));
    Ok(Finding {
        ours: Text::words("total variation distance ")
            .significant(a, 3)
            .say(" at p = ")
            .chosen(p_a)
            .say(", ")
            .significant(b, 3)
            .say(" at ")
            .chosen(p_b),
        tolerance: Text::words("falling, and at most half from panel (a) to (b)"),
        reason: "ours: convergence asks for a decrease at every p that was computed",
        judgement: Judgement::Plain { agrees: falls && later.len() > 2 && b < 0.5 * a },
        note: Text::words(
            "“Essentially identical” holds in the limit: where the paper shows it a tenth of the weight \
             still differs; at p = ",
        )
        .chosen(p_last)
        .say(" it is ")
        .significant(last, 2)
        .say("."),
    })
}

fn mean_large_p(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let p = HIGHER_P[2];
    let mean = e.number(&format!("theory.distribution[p={p}].mean"))?;
    let difference = of_five(e, p, "mean_difference")? / mean;
    Ok(Finding {
        ours: Text::words("relative difference ")
            .significant(difference, 2)
            .say(" at p = ")
            .chosen(p),
        tolerance: Text::words("at most ").significant(0.05, 1),
        reason: "ours: “very good” as within one in twenty",
        judgement: Judgement::Plain { agrees: difference.abs() <= 0.05 },
        note: Text::default(),
    })
}

fn mean_small_p(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let (difference, at) =
        (e.number("theory.higher.means_ratio")?, e.number("theory.higher.means_apart_at")?);
    Ok(Finding {
        ours: Text::words("relative difference up to ")
            .significant(difference, 2)
            .say(", at p = ")
            .chosen(at),
        tolerance: Text::words("at least ").significant(0.1, 1),
        reason: "ours: “measurable” as one in ten",
        judgement: Judgement::Plain { agrees: difference >= 0.1 },
        note: Text::default(),
    })
}

fn higher_jump(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let (higher, simple) = (e.number("theory.higher.p_jump")?, e.number("theory.jump.p_jump")?);
    let (k_after, shift) = (e.number("theory.higher.k_after")? as usize, higher / simple - 1.0);
    Ok(Finding {
        ours: Text::words("p_jump = ")
            .significant(higher, 6)
            .say(", to k* = ")
            .integer(k_after)
            .say("; for simple circuits ")
            .significant(simple, 6),
        tolerance: Text::words("another p, and a step of ten or more"),
        reason: "both are known to the last bit; “jump” as in Section 7",
        judgement: Judgement::Plain { agrees: shift.abs() > 1e-9 && k_after >= 10 },
        note: Text::words("A change by ").significant(100.0 * shift, 2).say(" %."),
    })
}

fn fig15_modest(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let (change, at) = (e.number("theory.higher.change")?, e.number("theory.higher.change_at")?);
    let shift = e.number("theory.higher.half_shift")?;
    let [low, high] = e.published.statement("sec2_half_height")?.rounding()?;
    Ok(Finding {
        ours: Text::words("largest change ")
            .significant(change, 3)
            .say(" at σ = ")
            .chosen(at)
            .say("; the half height moves by ")
            .significant(shift, 2),
        tolerance: Text::words("below σ = ")
            .significant(LARGE_SIGMA, 1)
            .say("; by at most ")
            .significant((high - low) / 2.0, 1),
        reason: "ours: “small σ” as what is not large in Section 8; “modest” as half a unit of the \
                 digit in which the paper prints the threshold",
        judgement: Judgement::Plain {
            agrees: at < LARGE_SIGMA && shift.abs() <= (high - low) / 2.0,
        },
        note: Text::default(),
    })
}

fn relation_matters(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let of = |column| e.number(&format!("theory.relation.{column}"));
    let simple = of("sigma_jump")?;
    let relation = (of("sigma_jump_rest")? - simple).abs();
    let higher = (of("sigma_jump_higher")? - simple).abs();
    Ok(Finding {
        ours: Text::words("another relation moves the jump by ")
            .significant(relation, 3)
            .say(" in σ, higher orders by ")
            .significant(higher, 2),
        tolerance: Text::words("the first is larger"),
        reason: "a comparison of two computed numbers",
        judgement: Judgement::Plain { agrees: relation > higher },
        note: Text::words("The other relation is that of a start from rest."),
    })
}
