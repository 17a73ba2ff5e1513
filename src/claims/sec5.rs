//! Judges Section 5, the counts of orbits.

use super::shared::*;
use crate::experiments::SEGMENTS;
use crate::experiments::segments::Segment;
use crate::params::VERTICES;
use std::collections::BTreeSet;

pub fn rules() -> Vec<Rule> {
    vec![
        Rule::new("sec5_fig5", |e| motion(e, &e.results.of(&SEGMENTS)?.fig05)).on(OurMeasure),
        Rule::new("sec5_fig6", |e| motion(e, &e.results.of(&SEGMENTS)?.fig06)).on(OurMeasure),
        Rule::new("sec5_masses_of_circuit", masses_of_circuit).reads("k + 1"),
        cases("sec5_eq6", ENUMERATION).reads("(N − 1)!/(N − k)!"),
        cases("sec5_eq7", ENUMERATION).reads("N!/(k (N − k)!)"),
        Rule::new("sec5_eq8", eq8).on(OurMeasure).reads("≪ 1"),
        Rule::new("sec5_majority", majority).on(OurMeasure).reads("length ≈ N"),
    ]
}

const ENUMERATION: &str = "Formula against enumeration on graphs of one to six vertices.";

fn motion(e: &Evidence<'_>, segment: &Segment) -> Judged {
    let found = segment.names();
    // The statement names the sequence at its end, after "as".
    let asked = e.statement.statement.rsplit_once(" as ").map_or("", |(_, names)| names);
    let asked: Vec<&str> = asked.trim_end_matches('.').split(", ").collect();
    let different = found.iter().collect::<BTreeSet<_>>().len();
    let reads =
        [found.join(", "), format!("{} impacts, {different} of them different", found.len())];
    let agrees = segment.impacts.windows(2).all(|w| w[0].time < w[1].time)
        && found == asked
        && reads.contains(&e.statement.printed)
        && found.len() as f64 == e.statement.number()?;
    Ok(e.found(found.join(", "), agrees)
        .within("none", "ours: the circuit as a segment of a motion; the same impacts in the same order")
        .note(Text::of(
            "A segment of a solution of the equations of motion, from time {} to {}, with the first impact again at its \
             end. The paper speaks of periodic orbits. We did not search for one, and do not know that one with these \
             impacts exists.",
            [significant(segment.from, 4), significant(segment.until, 4)],
        )))
}

fn masses_of_circuit(e: &Evidence<'_>) -> Judged {
    let segment = &e.results.of(&SEGMENTS)?.fig05;
    let gaps: BTreeSet<usize> = segment.impacts.iter().map(|i| i.gap).collect();
    let found = segment.masses_hit();
    // Each run of neighbouring gaps has one body more than gaps; walls are bodies but no masses.
    let runs = gaps.iter().filter(|&&gap| gap == 0 || !gaps.contains(&(gap - 1))).count();
    let walls = gaps.iter().filter(|&&gap| gap == 0 || gap == segment.masses).count();
    let printed = e.statement.number()?;
    Ok(e.found(integer(found), found as f64 == printed)
        .within("none", "an integer is exact")
        .explained(Text::of(
            "k different gaps in {} runs of neighbours touch k + {} bodies, of which {} are walls; k + 1 masses need one \
             run without walls.",
            [integer(runs), integer(runs), integer(walls)],
        ), found == gaps.len() + runs - walls && printed == (gaps.len() + 1) as f64))
}

fn eq8(e: &Evidence<'_>) -> Judged {
    let n = VERTICES as f64;
    let [ratio, exceptions, first] =
        e.numbers("theory.lengths", ["before_last", "exceptions", "first_exception"])?;
    Ok(e.found(Text::of("at k = N − 1: {}", [significant(ratio, 4)]), exceptions == 0.0)
        .within(
            Text::of("at most {}", [significant(0.1, 1)]),
            "ours: “far below one” as at most a tenth",
        )
        .explained(Text::of(
            "The ratio at k = N − 1 is N/(N − 1), above one. Above a tenth are the {} lengths next to N, where most \
             circuits are; below them Eq. (8) holds.",
            [integer(exceptions as usize)],
        ), (ratio * (n - 1.0) / n - 1.0).abs() < 1e-13 && first + 4.0 > n))
}

fn majority(e: &Evidence<'_>) -> Judged {
    let [share, peak] = e.numbers("theory.lengths", ["share", "peak"])?;
    let found = Text::of(
        "{} of all within three of N; the peak at k = {}",
        [significant(share, 4), integer(peak as usize)],
    );
    let reason = "ours: “about N” as within three of it; “majority” as more than half";
    Ok(e.found(found, share > 0.5).within("more than half", reason))
}
