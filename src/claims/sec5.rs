//! Judges Section 5, the counts of orbits.

use super::shared::*;
use crate::experiments::SEGMENTS;
use crate::params::VERTICES;
use std::collections::BTreeSet;

pub fn rules() -> Vec<Rule> {
    vec![
        Rule::new("sec5_fig5", |e| orbit(e, 5)).on(FiniteCases),
        Rule::new("sec5_fig6", |e| orbit(e, 6)).on(FiniteCases),
        Rule::new("sec5_masses_of_circuit", masses_of_circuit).on(FiniteCases).reads("k + 1"),
        cases("sec5_eq6", ENUMERATION).reads("(N − 1)!/(N − k)!"),
        cases("sec5_eq7", ENUMERATION).reads("N!/(k (N − k)!)"),
        Rule::new("sec5_eq8", eq8).on(OurMeasure).reads("≪ 1 for all k ≲ N"),
        Rule::new("sec5_eq8_next", eq8_next).on(OurMeasure).reads("≪ 1 for all k ≲ N"),
        Rule::new("sec5_majority", majority).on(OurMeasure).reads("length ≈ N"),
    ]
}

const ENUMERATION: &str = "Formula against enumeration on graphs of one to six vertices.";

/// A periodic orbit, replayed over two periods, and the segment of a motion that the figure draws.
fn orbit(e: &Evidence<'_>, figure: usize) -> Judged {
    let segments = e.results.of(&SEGMENTS)?;
    let (drawn, periodic) = match figure {
        5 => (&segments.fig05, &segments.periodic[0]),
        _ => (&segments.fig06, &segments.periodic[1]),
    };
    let found = periodic.first_period().names();
    let asked: Vec<&str> = e.statement.printed.split(", ").collect();
    let row = format!("segments.orbits[figure={figure}]");
    let [period, apart] = e.numbers(&row, ["period", "apart"])?;
    let allowed = 1e-9;
    let agrees = apart <= allowed
        && found == asked
        && drawn.names() == asked
        && found.len() as f64 == e.statement.number()?;
    let text = text!("{}; after a period of {:4} again, to {:1}", found.join(", "), period, apart);
    let note = "A solution of the equations of motion with the period of the forces, which were chosen for it; the \
         figure draws another, which is not periodic. Nothing is said of how likely such forces are.";
    Ok(e.found(text, agrees)
        .within(text!("{:1}", allowed), "rounding, which the impacts of a period enlarge")
        .note(note))
}

/// Returns how many bodies the impacts in some gaps of a chain involve, both walls being one body.
fn bodies(gaps: &BTreeSet<usize>, masses: usize) -> usize {
    let sides = gaps.iter().flat_map(|gap| [*gap, (gap + 1) % (masses + 1)]);
    sides.collect::<BTreeSet<_>>().len()
}

/// The walls are one body, and their gaps neighbours, as on a ring.
fn masses_of_circuit(e: &Evidence<'_>) -> Judged {
    let segment = &e.results.of(&SEGMENTS)?.fig05;
    let gaps: BTreeSet<usize> = segment.impacts.iter().map(|impact| impact.gap).collect();
    let all = segment.masses + 1;
    let sets = (1 << all) - 1;
    let (mut right, mut as_predicted) = (0, true);
    for set in 1_u32..=sets {
        let set: BTreeSet<usize> = (0..all).filter(|gap| set >> gap & 1 == 1).collect();
        let holds = bodies(&set, segment.masses) == set.len() + 1;
        // A gap begins a run of neighbours if the one before it is not in the set.
        let before = |gap: &&usize| !set.contains(&((**gap + all - 1) % all));
        as_predicted &= holds == (set.iter().filter(before).count() == 1);
        right += u32::from(holds);
    }
    let found = bodies(&gaps, segment.masses);
    let printed = found as f64 == e.statement.number()?;
    let text = text!("{} for Fig. 5; k + 1 for {} of {} sets of gaps", found, right, sets);
    let why = "A circuit whose gaps are neighbours, as on a ring, has k + 1 bodies, and the printed example is one. \
         A gap apart from the others adds two bodies, and the last gap of the whole ring none.";
    Ok(e.found(text, printed && right == sets)
        .within("none", "integers are exact")
        .explained(why, printed && as_predicted))
}

/// Lengths that are about N, here and in the statement after the next: within a twentieth of it.
fn eq8(e: &Evidence<'_>) -> Judged {
    let [far, from] = e.numbers("theory.lengths", ["largest_far", "from"])?;
    let found = text!("at most {:2} for k < {}", far, from);
    let reason = "ours: “far below one” as at most a tenth; “about N” as within a twentieth of it, as “few” elsewhere";
    Ok(e.found(found, far <= 0.1).within(text!("at most {:1}", 0.1), reason))
}

fn eq8_next(e: &Evidence<'_>) -> Judged {
    let [ratio, exceptions] = e.numbers("theory.lengths", ["before_last", "exceptions"])?;
    let n = VERTICES as f64;
    let reason = "ours: “far below one” as at most a tenth";
    let why = "The ratio at k = N − 1 is N/(N − 1), above one. The ratio exceeds a tenth for the {} lengths next to N, where \
         most circuits are.";
    Ok(e.found(text!("at k = N − 1: {:4}", ratio), exceptions == 0.0)
        .within(text!("at most {:1}", 0.1), reason)
        .explained(
            text!(why, exceptions),
            (ratio * (n - 1.0) / n - 1.0).abs() < 1e-13 && exceptions == 3.0,
        ))
}

fn majority(e: &Evidence<'_>) -> Judged {
    let [share, peak] = e.numbers("theory.lengths", ["share", "peak"])?;
    let found = text!("{:4} of all within a twentieth of N; the peak at k = {}", share, peak);
    let reason = "ours: “about N” as within a twentieth of it, as “few” elsewhere; “majority” as more than half";
    Ok(e.found(found, share > 0.5).within("more than half", reason))
}
