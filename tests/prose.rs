//! The prose with the results of the quick profile: it fills, it names no unknown value and leaves
//! none unused (the assembly refuses both, and naked numerals), it has every equation and figure of
//! the paper, and every claim has its place in it.

mod quick;

use impact_paper::claims::{self, Published, Verdict};
use impact_paper::experiments::{Need, Progress, Results, Store, run::run};
use impact_paper::figures;
use impact_paper::params::Profile;
use quick::QUICK;

#[test]
fn the_report_has_every_equation_and_figure() {
    let report = &QUICK.report;
    let text = String::from_utf8(report.committed["report.md"].clone()).unwrap();
    for number in 1..=38 {
        assert_eq!(text.matches(&format!("\\tag{{{number}}}")).count(), 1, "Eq. ({number})");
    }
    for number in figures::all().map(|number| number.to_string().to_uppercase()) {
        assert_eq!(text.matches(&format!("**Figure {number}.**")).count(), 1, "Fig. {number}");
    }
}

#[test]
fn every_claim_is_spoken_of_once_in_the_text() {
    let template = QUICK.templates.text("report.md").unwrap();
    for row in claims::rows() {
        let tag = format!("«row.{}»", row.id);
        assert_eq!(template.matches(&tag).count(), 1, "{tag}");
    }
}

/// Verdicts follow the simulated numbers: shift, flatten or crowd them, and the claims fail.
#[test]
fn claims_fail_when_the_results_say_so() {
    let none = |_: &str| Err("not needed".to_string());
    let needs = [Need::Sweep, Need::Laws];
    let mut results =
        run(&needs, Profile::Quick, none, &Store::nowhere(), &Progress::silent()).unwrap();
    let published = Published::committed().unwrap();
    let verdict =
        |id: &str, results: &Results| claims::one(id, results, &published).unwrap().verdict;

    assert_eq!(verdict("sec2_half_height", &results), Verdict::Reproduced);
    assert_eq!(verdict("sec2_onset", &results), Verdict::DiffersAndExplained);
    assert_eq!(verdict("sec2_sticking", &results), Verdict::Reproduced);
    assert_eq!(verdict("sec2_parameters", &results), Verdict::Reproduced);
    let sweep = results.sweep.as_mut().unwrap();
    for place in [&mut sweep.rise.half_height, &mut sweep.rise.kept_half] {
        place.as_mut().unwrap().value += 0.05;
    }
    sweep.parameters.chain.restitution = 0.7;
    for row in &mut sweep.rows {
        row.contact_phases = row.impacts / 100;
    }
    assert_eq!(verdict("sec2_half_height", &results), Verdict::Differs);
    // The onset still differs, but what explained it no longer holds.
    assert_eq!(verdict("sec2_onset", &results), Verdict::Differs);
    assert_eq!(verdict("sec2_sticking", &results), Verdict::Differs);
    assert_eq!(verdict("sec2_parameters", &results), Verdict::Differs);

    results.sweep.as_mut().unwrap().rise.half_height = None;
    assert_eq!(verdict("sec2_half_height", &results), Verdict::CannotBeJudged);
    results.laws.as_mut().unwrap().totals.near_decades.iter_mut().for_each(|n| *n += 1000);
    assert_eq!(verdict("sec2_three_way", &results), Verdict::Differs);
}
