//! Tests that the prose has each equation, figure and claim, and that verdicts follow numbers.

use super::*;
use impact_chain::rise::Mean;
use impact_numerics::estimates::with_error;
use impact_numerics::statistics::Estimate;
use impact_paper::claims::{self, Judge, Verdict};
use impact_paper::experiments::accuracy::case::Outcome::Missed;
use impact_paper::experiments::*;
use impact_paper::figures;
use impact_paper::params::MethodName;

#[test]
fn the_report_has_every_equation_and_figure() {
    let documents = QUICK.paper.edition.documents.iter().filter(|document| !document.repeats);
    let markdown: String = documents.map(|document| QUICK.file_text(document.markdown)).collect();
    for number in 1..=38 {
        assert_eq!(markdown.matches(&format!("\\tag{{{number}}}")).count(), 1, "Eq. ({number})");
    }
    for name in figures::ALL.iter().map(|figure| figure.name) {
        let number =
            name.trim_start_matches(['f', 'i', 'g', '0']).to_uppercase().replace("S0", "S");
        assert_eq!(markdown.matches(&format!("**Figure {number}.**")).count(), 1, "Fig. {number}");
    }
}

/// A reader meets the supplementary figures in the order of their numbers.
#[test]
fn supplementary_figures_are_numbered_by_first_mention() {
    let template = QUICK.all_prose();
    let numbers = figures::ALL.iter().filter_map(|figure| figure.name.strip_prefix('s'));
    let first = numbers.map(|n| {
        let s = n.trim_start_matches('0');
        let named = [format!("ig:S{s}]"), format!("ig:S{s};"), format!("figures/s{n}.svg")];
        let first = named.iter().filter_map(|name| template.find(name)).min();
        first.unwrap_or_else(|| panic!("Fig. S{s} is not mentioned"))
    });
    let first: Vec<usize> = first.collect();
    assert!(first.is_sorted(), "{first:?}");
}

#[test]
fn every_claim_is_spoken_of_once_in_the_text() {
    let template = QUICK.all_prose();
    for rule in claims::rules().iter().filter(|rule| rule.is_of_statement()) {
        let tag = format!("@row:{}", rule.id);
        let ends = [format!("{tag}]"), format!("{tag};")];
        let times: usize = ends.iter().map(|tag| template.matches(tag).count()).sum();
        assert_eq!(times, 1, "{tag}");
    }
}

/// The one exception is a definition: the normalisation of Eq. (9) is used as it stands.
#[test]
fn no_verdict_survives_another_first_digit_in_the_printed_number() {
    let rules = claims::rules();
    let blind = Judge::new(&QUICK.published, &rules, &QUICK.results).ids_blind_to_number();
    assert_eq!(blind, ["sec6_normalised"]);
}

/// Those that nothing moves are listed with the reason.
#[test]
fn every_verdict_moves_with_the_evidence() {
    let rules = claims::rules();
    let judge = Judge::new(&QUICK.published, &rules, &QUICK.results);
    let ids = judge.ids_never_moved(true).unwrap();
    let listed = include_str!("never_moved.txt").lines();
    let in_all = listed.filter(|line| !line.contains("in full samples"));
    let listed: Vec<&str> = in_all.map(|line| line.split_once(": ").unwrap().0).collect();
    assert_eq!(ids, listed);
}

/// Judges results, and compares the verdicts of some statements or relations.
fn judged(results: &Results, expected: &[(&str, Verdict)]) {
    let mut rules = claims::rules();
    rules.retain(|rule| expected.iter().any(|(id, _)| *id == rule.id));
    let checks = Judge::new(&QUICK.published, &rules, results).checks().unwrap();
    for (id, verdict) in expected {
        assert_eq!(checks.iter().find(|check| check.id == *id).unwrap().verdict, *verdict, "{id}");
    }
}

#[test]
fn each_number_that_the_paper_chose_is_used_by_a_check() {
    let rules = claims::rules();
    let is_used = |id: &str| rules.iter().flat_map(|rule| &rule.uses).any(|(used, _)| *used == id);
    let unused = QUICK.published.parameters.iter().find(|one| !is_used(&one.id));
    assert!(unused.is_none(), "{unused:?}");
}

/// Verdicts follow the simulated numbers: shift, flatten or crowd them, and the claims fail.
#[test]
fn claims_fail_when_the_results_say_so() {
    use Verdict::{CannotBeJudged, Differs, Reproduced};
    // The unprinted protocol decides where the rise is; with ours σ½ is the printed 0.12.
    let as_found = [
        ("sec2_half_height", CannotBeJudged),
        ("sec2_onset", CannotBeJudged),
        ("printed_threshold", Reproduced),
        ("sec2_sticking", Reproduced),
        ("sec2_parameters", Reproduced),
        ("engine_as_promised", Reproduced),
    ];
    judged(&QUICK.results, &as_found);
    let mut results = QUICK.results_again(ALL);
    let sweep = &mut results.get_mut(&SWEEP).unwrap()[0];
    let rise = &mut sweep.curves[0].rise;
    rise.half_height.as_mut().unwrap().value += 0.05;
    sweep.ensemble.chain.restitution = 0.7;
    for run in &mut sweep.runs {
        run.total.contact_phases = run.total.impacts / 100;
    }
    let changed = ["printed_threshold", "sec2_sticking", "sec2_parameters"];
    judged(&results, &changed.map(|id| (id, Differs)));

    // What is few or many in every window is judged; what the window decides is not.
    let mean = |value| Some(Mean { value, error: Some(0.01), interval: None });
    // A mode that surely jumps in each window, and for the printed digits.
    for window in &mut results.get_mut(&MODE_JUMP).unwrap().windows {
        let sure = |value| Some(Estimate { value, error: 0.001, interval: [value; 2] });
        let passing = &mut window.jump.all_gaps;
        (passing.sigma, passing.peak, passing.clearance) = (sure(0.12), sure(50.0), sure(0.5));
    }
    let sweep = &mut results.get_mut(&SWEEP).unwrap()[0];
    let rows = &mut sweep.curves[0].rows;
    let row = rows.iter_mut().rfind(|row| row.sigma < 0.0804).unwrap();
    (row.mean, row.mean_all) = (mean(14.0), mean(0.6));
    for row in rows {
        row.mean = if row.sigma < 0.2 { row.mean } else { mean(50.0) };
    }
    sweep.curves[0].rise.half_height = None;
    for run in &mut sweep.runs {
        *run.total.near.last_mut().unwrap() += 1000;
    }
    for ([first, others], expected) in
        [([40.0, 40.0], Differs), ([0.7, 40.0], CannotBeJudged), ([0.7, 0.7], Reproduced)]
    {
        let windows = &mut results.get_mut(&PROTOCOL).unwrap()[1].curves;
        for curve in windows.iter_mut() {
            curve.rows[0].mean = mean(others);
            (curve.rows[0].active, curve.rows[0].ran) = (others as usize, 300);
        }
        let row = &mut windows.last_mut().unwrap().rows[0];
        (row.mean, row.active) = (mean(first), first as usize);
        let small = ["sec2_few_below", "sec2_none_below"].map(|id| (id, expected));
        let others = [("printed_threshold", CannotBeJudged), ("sec2_three_way", Differs)];
        let large = [("sec2_mode_jump", Reproduced), ("sec8_large_sigma", Differs)];
        let place = [("sec2_mode_rise", Reproduced)];
        judged(&results, &[&small[..], &others, &large, &place].concat());
    }
}

/// Sets the places of the rise, of realisations with an impact and of all, in every window.
fn place_rise(results: &mut Results, places: [f64; 2]) {
    let [half_height, of_all] = places.map(|place| Some(with_error(place, 0.001)));
    for experiment in [&PROTOCOL, &LENGTHS] {
        let sweeps = results.get_mut(experiment).unwrap();
        for curve in sweeps.iter_mut().flat_map(|sweep| &mut sweep.curves) {
            curve.rise.half_height = half_height;
            curve.rise.half_height_all = of_all;
        }
    }
}

/// The printed threshold is that of realisations with an impact, a jump of the mean is no slope,
/// and each part of the promise of the engine can fail.
#[test]
fn one_changed_result_changes_a_verdict() {
    use Verdict::{Differs, Reproduced};
    const ENGINE: [&dyn AnyExperiment; 3] = [&RACE, &TRIALS, &SCALE];
    type Change = fn(&mut Results);
    let changes: [(&str, Verdict, Change); 7] = [
        ("sec2_half_height", Reproduced, |results| place_rise(results, [0.12, 0.3])),
        ("sec2_half_height", Differs, |results| place_rise(results, [0.3, 0.12])),
        ("sec2_jump", Differs, |results| {
            for row in &mut results.get_mut(&SWEEP).unwrap()[0].curves[0].rows {
                let value = if row.sigma < 0.12 { 1.0 } else { 100.0 };
                row.mean = Some(Mean { value, error: Some(0.01), interval: None });
            }
        }),
        ("engine_as_promised", Differs, |results| {
            results.get_mut(&RACE).unwrap().entries[0].misses += 1;
        }),
        ("engine_as_promised", Differs, |results| {
            results.get_mut(&RACE).unwrap().entries[0].units = Some(9.0);
        }),
        ("engine_as_promised", Differs, |results| {
            results.get_mut(&TRIALS).unwrap().trials[0][0][0] = Missed;
        }),
        ("engine_as_promised", Differs, |results| {
            let mut rows = results.get_mut(&SCALE).unwrap().iter_mut();
            let row = rows.rfind(|row| row.setting.method == MethodName::Certified).unwrap();
            row.evaluations_per_impact = row.evaluations_per_impact.map(|work| 3.0 * work);
        }),
    ];
    for (id, verdict, change) in changes {
        let is_of_engine = id == "engine_as_promised";
        let mut results = QUICK.results_again(if is_of_engine { &ENGINE } else { ALL });
        change(&mut results);
        judged(&results, &[(id, verdict)]);
    }
}

#[test]
fn the_page_has_each_run_with_its_digest_and_the_module() {
    let script = impact_paper::lab::script(b"foobar", &QUICK.results, "end();").unwrap();
    let data =
        script.split("const LAB = ").nth(1).unwrap().strip_suffix(";\n{\nend();}\n").unwrap();
    let data: serde_json::Value = serde_json::from_str(data).unwrap();
    assert_eq!(data["module"], "Zm9vYmFy");
    let protocols = data["protocols"].as_array().unwrap();
    assert_eq!(protocols.len(), QUICK.results.of(&PROTOCOL).unwrap()[0].curves.len());
    let replays = QUICK.results.of(&REPLAY).unwrap();
    assert_eq!(data["runs"].as_array().unwrap().len(), replays.results.len());
    for (i, found) in replays.results.iter().enumerate() {
        assert_eq!(data["runs"][i]["found"]["digest"], found.digest.as_str());
        let asked = serde_json::from_value(data["runs"][i]["asked"].clone());
        let asked: impact_paper::experiments::replay::Request = asked.unwrap();
        assert_eq!(asked, replays.parameters[i].1);
    }
}
