//! Section 9: circuits that repeat impacts.

use super::Basis::{Exact, OurMeasure};
use super::row::{Error, Evidence, Row, cases, measured, theory};
use super::{Finding, open};
use super::{Judgement, Statement, Text};
use crate::experiments::SEGMENTS;
use crate::experiments::theory::Theory;
use crate::experiments::theory::beside::LARGE_SIGMA;
use crate::experiments::theory::tables::{largest_change, largest_mean_difference, moves};

pub const ROWS: &[Row] = &[
    measured("sec9_fig6_repeats", Exact, &[&SEGMENTS], fig6_repeats),
    theory("sec9_eq29", Exact, |e, _| {
        cases(
            e.results.identities.eq29,
            "Circuits through one vertex twice, by the lengths of their loops, on graphs of one to six vertices.",
        )
    })
    .of("(N − 1)!/(N − (k − 1))!"),
    theory("sec9_eq30", Exact, eq30).of("γ(k, 2)/2 · (N − 1)!/(N − (k − 1))!"),
    theory("sec9_eq32", Exact, |e, _| {
        cases(e.results.identities.eq32, "Every n up to ten, one sum at a time.")
    })
    .of("(n − 1)!/((j − 1)! (n − j)!)"),
    theory("sec9_eq33", Exact, |e, s| class_range(e, s, 33)).of("(k − 1)/2 · N!/(N − (k − 1))!"),
    theory("sec9_eq35", Exact, |e, s| class_range(e, s, 35)).of("valid for k > {}"),
    theory("sec9_eq36", Exact, |e, s| class_range(e, s, 36)).of("valid for k > {}"),
    theory("sec9_eq37", Exact, |e, s| class_range(e, s, 37)).of("valid for k > {}"),
    theory("sec9_eq38", Exact, |e, _| {
        cases(
            e.results.identities.eq38,
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
    let id = &e.results.identities;
    let counted = id.eq30_counted;
    Ok(Finding {
        ours: Text::words("Eq. (30) gives ")
            .significant(id.eq30_printed, 1)
            .say(", enumeration ")
            .integer(counted as usize),
        tolerance: Text::words("none"),
        reason: INTEGER,
        judgement: Judgement::Explained {
            agrees: id.eq30_printed == counted as f64,
            holds: id.eq30_times_n.failed == 0
                && id.eq30_times_n.compared > 0
                && (e.results.theory.slips.missing_factor / e.results.theory.vertices as f64 - 1.0)
                    .abs()
                    < 1e-13,
        },
        note: Text::words(
            "A factor N is missing, the choice of the vertex that is visited twice; \
             Eq. (33) has it. With it the formula agrees in ",
        )
        .integer(id.eq30_times_n.compared as usize)
        .say(" of ")
        .integer(id.eq30_times_n.compared as usize)
        .say(" cases."),
    })
}

fn class_range(e: &Evidence, s: &Statement, equation: u32) -> Result<Finding, Error> {
    let ranges = &e.results.identities.classes;
    let Some(range) = ranges.iter().find(|range| range.equation == equation) else {
        return Ok(open(Text::words("nothing"), "The formula was not compared."));
    };
    // A printed "k > 3" means from 4 on; without a printed range every length is meant.
    let printed_from = s.value.map_or(1, |k| k as usize + 1);
    let agrees = range.right_from == printed_from && range.cases.failed == 0;
    let ours = Text::words("right from k = ").integer(range.right_from).say(" on");
    let note = Text::words("One length below, on three vertices, the formula gives ")
        .chosen(range.formula_below)
        .say(" and enumeration finds ")
        .integer(range.counted_below as usize)
        .say(": sequences that repeat a shorter one.");
    let compared = range.cases.compared > 3;
    Ok(Finding {
        ours,
        tolerance: Text::words("none"),
        reason: INTEGER,
        judgement: match s.value {
            Some(_) => Judgement::Plain { agrees: agrees && compared },
            // Without a range: wrong only where both loops are alike and so counted as half.
            None => Judgement::Explained {
                agrees: agrees && compared,
                holds: compared && range.right_from == 3 && range.counted_below == 0,
            },
        },
        note,
    })
}

/// Share of simple circuits at one p.
pub(crate) fn simple_share(theory: &Theory, p: f64) -> Option<f64> {
    theory.slips.simple_shares.iter().find(|row| row.x == p).map(|row| row.y)
}

fn even_small_p(e: &Evidence, s: &Statement) -> Result<Finding, Error> {
    let p = s.number()?;
    let (Some(share), Some(panel)) =
        (simple_share(&e.results.theory, p), e.results.theory.higher.iter().find(|h| h.p == p))
    else {
        return Ok(open(Text::words("nothing"), "This p was not computed."));
    };
    // One doubled vertex costs p and can be placed in k²/2 ways, except on a single vertex.
    let first_order: f64 = (1_u32..)
        .zip(&panel.simple)
        .skip(1)
        .map(|(k, q)| q * p * f64::from(k) * f64::from(k) / 2.0)
        .sum();
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
    let theory = &e.results.theory;
    let shares: Vec<(f64, f64)> =
        theory.slips.simple_shares.iter().map(|row| (row.x, row.y)).collect();
    let falls = shares.windows(2).all(|w| w[1].0 <= w[0].0 || w[1].1 < w[0].1);
    let Some(last) = theory.higher.last() else {
        return Ok(open(Text::words("nothing"), "Fig. 13 was not computed."));
    };
    let Some(share) = last.classes.first().map(|class| class.share) else {
        return Ok(open(Text::words("nothing"), "Fig. 13 has no classes."));
    };
    Ok(Finding {
        ours: Text::words("simple circuits hold ")
            .significant(share, 2)
            .say(" at p = ")
            .chosen(last.p),
        tolerance: Text::words("at most ").significant(0.01, 1),
        reason: "ours: “insignificant” as at most one in a hundred, and falling with p",
        judgement: Judgement::Plain { agrees: share <= 0.01 && falls },
        note: Text::default(),
    })
}

fn convergence(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let theory = &e.results.theory;
    let (Some(a), Some(b)) = (theory.convergence.first(), theory.convergence.last()) else {
        return Ok(open(Text::words("nothing"), "Fig. 14 was not computed."));
    };
    let later: Vec<_> = theory.slips.total_variations.iter().filter(|v| v.x >= a.p).collect();
    let falls = later.windows(2).all(|w| w[1].y < w[0].y);
    let [p_last, last] = later.last().map_or([f64::NAN; 2], |v| [v.x, v.y]);
    Ok(Finding {
        ours: Text::words("total variation distance ")
            .significant(a.total_variation, 3)
            .say(" at p = ")
            .chosen(a.p)
            .say(", ")
            .significant(b.total_variation, 3)
            .say(" at ")
            .chosen(b.p),
        tolerance: Text::words("falling, and at most half from panel (a) to (b)"),
        reason: "ours: convergence asks for a decrease at every p that was computed",
        judgement: Judgement::Plain {
            agrees: falls && later.len() > 2 && b.total_variation < 0.5 * a.total_variation,
        },
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
    let Some(last) = e.results.theory.higher.last() else {
        return Ok(open(Text::words("nothing"), "Fig. 13 was not computed."));
    };
    let difference = last.mean / last.mean_simple - 1.0;
    Ok(Finding {
        ours: Text::words("relative difference ")
            .significant(difference, 2)
            .say(" at p = ")
            .chosen(last.p),
        tolerance: Text::words("at most ").significant(0.05, 1),
        reason: "ours: “very good” as within one in twenty",
        judgement: Judgement::Plain { agrees: difference.abs() <= 0.05 },
        note: Text::default(),
    })
}

fn mean_small_p(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let [difference, at] = largest_mean_difference(&e.results.theory);
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
    let scalars = &e.results.theory.scalars;
    let shift = scalars.higher_p_jump / scalars.p_jump - 1.0;
    Ok(Finding {
        ours: Text::words("p_jump = ")
            .significant(scalars.higher_p_jump, 6)
            .say(", to k* = ")
            .integer(scalars.higher_k_after_jump)
            .say("; for simple circuits ")
            .significant(scalars.p_jump, 6),
        tolerance: Text::words("another p, and a step of ten or more"),
        reason: "both are known to the last bit; “jump” as in Section 7",
        judgement: Judgement::Plain {
            agrees: shift.abs() > 1e-9 && scalars.higher_k_after_jump >= 10,
        },
        note: Text::words("A change by ").significant(100.0 * shift, 2).say(" %."),
    })
}

fn fig15_modest(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let theory = &e.results.theory;
    let [change, at] = largest_change(&theory.curve);
    let shift = theory.scalars.sigma_half - theory.scalars.higher_sigma_half;
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
    let [relation, higher] = moves(&e.results.theory);
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
