//! Section 5: counting orbits.

use super::Basis::{Exact, OurMeasure};
use super::row::{Error, Evidence, Row, cases, measured, theory};
use super::{Finding, Judgement, Statement, Text};
use crate::experiments::SEGMENTS;
use crate::experiments::segments::Segment;
use crate::params::VERTICES;
use std::collections::BTreeSet;

pub const ROWS: &[Row] = &[
    measured("sec5_fig5", Exact, &[&SEGMENTS], |e, s| motion(&e.results.of(&SEGMENTS)?.fig05, s)),
    measured("sec5_fig6", Exact, &[&SEGMENTS], |e, s| motion(&e.results.of(&SEGMENTS)?.fig06, s)),
    measured("sec5_masses_of_circuit", Exact, &[&SEGMENTS], masses_of_circuit).of("k + 1"),
    theory("sec5_eq6", Exact, |e, s| cases(e, s, ENUMERATION)).of("(N − 1)!/(N − k)!"),
    theory("sec5_eq7", Exact, |e, s| cases(e, s, ENUMERATION)).of("N!/(k (N − k)!)"),
    theory("sec5_eq8", OurMeasure, eq8).of("≪ 1"),
    theory("sec5_majority", OurMeasure, majority).of("length ≈ N"),
];

const ENUMERATION: &str = "Formula against enumeration on graphs of one to six vertices.";

fn motion(segment: &Segment, s: &Statement) -> Result<Finding, Error> {
    let found = segment.names();
    // The statement names the sequence at its end, after "as".
    let asked = s.statement.rsplit_once(" as ").map_or("", |(_, names)| names);
    let asked: Vec<&str> = asked.trim_end_matches('.').split(", ").collect();
    let different = found.iter().collect::<BTreeSet<_>>().len();
    let reads =
        [found.join(", "), format!("{} impacts, {different} of them different", found.len())];
    let in_order = segment.impacts.windows(2).all(|w| w[0].time < w[1].time);
    Ok(Finding {
        ours: Text::words(found.join(", ")),
        tolerance: Text::words("none"),
        reason: "the same impacts in the same order",
        judgement: Judgement::Plain {
            agrees: in_order
                && found == asked
                && reads.contains(&s.printed)
                && found.len() as f64 == s.number()?,
        },
        note: Text::words("A segment of a solution of the equations of motion, from time ")
            .significant(segment.from, 4)
            .say(" to ")
            .significant(segment.until, 4)
            .say(", with the first impact again at its end; not a periodic orbit."),
    })
}

fn masses_of_circuit(e: &Evidence, s: &Statement) -> Result<Finding, Error> {
    let segment = &e.results.of(&SEGMENTS)?.fig05;
    let gaps: BTreeSet<usize> = segment.impacts.iter().map(|i| i.gap).collect();
    let found = segment.masses_hit();
    // Each run of neighbouring gaps has one body more than gaps; walls are bodies but no masses.
    let runs = gaps.iter().filter(|&&gap| gap == 0 || !gaps.contains(&(gap - 1))).count();
    let walls = gaps.iter().filter(|&&gap| gap == 0 || gap == segment.masses).count();
    let predicted = gaps.len() + runs - walls;
    let printed = s.number()?;
    Ok(Finding {
        ours: Text::default().integer(found),
        tolerance: Text::words("none"),
        reason: "an integer is exact",
        judgement: Judgement::Explained {
            agrees: found as f64 == printed,
            holds: found == predicted && printed == (gaps.len() + 1) as f64,
        },
        note: Text::words("k different gaps in ")
            .integer(runs)
            .say(" runs of neighbours touch k + ")
            .integer(runs)
            .say(" bodies, of which ")
            .integer(walls)
            .say(" are walls; k + 1 masses need one run without walls."),
    })
}

fn eq8(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let n = VERTICES as f64;
    let ratio = e.number("theory.lengths.before_last")?;
    let exceptions = e.number("theory.lengths.exceptions")? as usize;
    let holds = (ratio * (n - 1.0) / n - 1.0).abs() < 1e-13
        && e.number("theory.lengths.first_exception")? + 4.0 > n;
    Ok(Finding {
        ours: Text::words("at k = N − 1: ").significant(ratio, 4),
        tolerance: Text::words("at most ").significant(0.1, 1),
        reason: "ours: “far below one” as at most a tenth",
        judgement: Judgement::Explained { agrees: exceptions == 0, holds },
        note: Text::words("The ratio at k = N − 1 is N/(N − 1), above one. Above a tenth are the ")
            .integer(exceptions)
            .say(" lengths next to N, where most circuits are; below them Eq. (8) holds."),
    })
}

fn majority(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let share = e.number("theory.lengths.share")?;
    Ok(Finding {
        ours: Text::default()
            .significant(share, 4)
            .say(" of all within three of N; the peak at k = ")
            .integer(e.number("theory.lengths.peak")? as usize),
        tolerance: Text::words("more than half"),
        reason: "ours: “about N” as within three of it; “majority” as more than half",
        judgement: Judgement::Plain { agrees: share > 0.5 },
        note: Text::default(),
    })
}
