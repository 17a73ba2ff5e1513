//! Judges Section 5, the counts of orbits.

use super::shared::*;
use std::collections::BTreeSet;

pub fn rules() -> Vec<Rule> {
    vec![
        Rule::new("sec5_fig5", |e| orbit(e, 0)).on(FiniteCases),
        Rule::new("sec5_fig6", |e| orbit(e, 1)).on(FiniteCases),
        Rule::new("sec5_masses_of_circuit", masses_of_circuit).on(FiniteCases).reads("k + 1"),
        cases("sec5_eq6").reads("(N − 1)!/(N − k)!"),
        cases("sec5_eq7").reads("N!/(k (N − k)!)"),
        Rule::new("sec5_eq8", eq8).on(OurMeasure).reads("≪ 1 for all k ≲ N"),
        Rule::new("sec5_eq8_next", eq8_next).on(OurMeasure).reads("≪ 1 for all k ≲ N"),
        Rule::new("sec5_majority", majority)
            .on(OurMeasure)
            .reads("length ≈ N")
            .uses(&[("vertices", VERTICES as f64)]),
    ]
}

/// A periodic orbit, replayed over two periods, and the segment of a motion that Fig. 5 or 6 draws.
fn orbit(e: &Evidence<'_>, place: usize) -> Judged {
    let segments = e.results.of(&SEGMENTS)?;
    let drawn = [&segments.fig05, &segments.fig06][place];
    let (periodic, figure) = (&segments.periodic[place], 5 + place);
    let impacts = periodic.first_period().names();
    let printed: Vec<&str> = e.statement.printed.split(", ").collect();
    let row = format!("segments.orbits[figure={figure}]");
    let [period, apart] = e.numbers(&row, ["period", "apart"])?;
    let allowed = 1e-9;
    let agrees = apart <= allowed
        && impacts == printed
        && drawn.names() == printed
        && impacts.len() as f64 == e.statement.number()?;
    e.check(agrees, numbers![orbit = impacts.join(", "), period, apart, allowed])
}

/// Returns how many bodies the impacts in some gaps of a chain involve, both walls being one body.
fn bodies(gaps: &BTreeSet<usize>, masses: usize) -> usize {
    gaps.iter().flat_map(|gap| [*gap, (gap + 1) % (masses + 1)]).collect::<BTreeSet<_>>().len()
}

/// The walls are one body, and their gaps neighbours, as on a ring.
fn masses_of_circuit(e: &Evidence<'_>) -> Judged {
    let segment = &e.results.of(&SEGMENTS)?.fig05;
    let gaps: BTreeSet<usize> = segment.impacts.iter().map(|impact| impact.gap).collect();
    let all_gaps = segment.masses + 1;
    let sets = (1 << all_gaps) - 1;
    let (mut right, mut as_predicted) = (0, true);
    for set in 1_u32..=sets {
        let set: BTreeSet<usize> = (0..all_gaps).filter(|gap| set >> gap & 1 == 1).collect();
        let holds = bodies(&set, segment.masses) == set.len() + 1;
        // A gap begins a run of neighbours if the one before it is not in the set.
        let before = |gap: &&usize| !set.contains(&((**gap + all_gaps - 1) % all_gaps));
        as_predicted &= holds == (set.iter().filter(before).count() == 1);
        right += u32::from(holds);
    }
    let involved = bodies(&gaps, segment.masses);
    let is_as_printed = involved as f64 == e.statement.number()?;
    let check = e.check(is_as_printed && right == sets, numbers![found = involved, right, sets])?;
    Ok(check.explained_if(is_as_printed && as_predicted))
}

/// “Far below one” is at most this (ours).
const FAR_BELOW: f64 = 0.1;

/// Lengths that are about N, here and in the statement after the next: within a twentieth of it.
fn eq8(e: &Evidence<'_>) -> Judged {
    let [far, from] = e.numbers("theory.lengths", ["largest_far", "from"])?;
    e.check(far <= FAR_BELOW, numbers![far, from, limit = FAR_BELOW])
}

fn eq8_next(e: &Evidence<'_>) -> Judged {
    let [ratio, exceptions] = e.numbers("theory.lengths", ["before_last", "exceptions"])?;
    let n = VERTICES as f64;
    let check = e.check(exceptions == 0.0, numbers![ratio, exceptions, limit = FAR_BELOW])?;
    Ok(check.explained_if((ratio * (n - 1.0) / n - 1.0).abs() < 1e-13 && exceptions == 3.0))
}

fn majority(e: &Evidence<'_>) -> Judged {
    let [share, peak] = e.numbers("theory.lengths", ["share", "peak"])?;
    e.check(share > 0.5, numbers![share, peak])
}
