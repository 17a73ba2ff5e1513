//! Tests the prose with the results of the quick profile: it fills, it names no unknown value (the
//! assembly refuses it, and hard-coded numbers), it has every equation and
//! figure of the paper, and every claim has its place in it.

use super::QUICK;
use impact_chain::rise::Mean;
use impact_numerics::estimates::with_error;
use impact_numerics::statistics::Estimate;
use impact_paper::claims::{self, Verdict};
use impact_paper::experiments::accuracy::case::Outcome::Missed;
use impact_paper::experiments::{
    ALL, LENGTHS, MODE_JUMP, PROTOCOL, RACE, REPLAY, Results, SCALE, SWEEP, TRIALS,
};
use impact_paper::figures;
use impact_paper::params::MethodName;

#[test]
fn the_report_has_every_equation_and_figure() {
    let documents = QUICK.paper.edition.documents.iter().filter(|document| !document.repeats);
    let markdown: String = documents.map(|document| QUICK.markdown(document)).collect();
    for number in 1..=38 {
        assert_eq!(markdown.matches(&format!("\\tag{{{number}}}")).count(), 1, "Eq. ({number})");
    }
    for name in figures::ALL.iter().map(|figure| figure.name) {
        let number = name.trim_start_matches("fig").trim_start_matches('0').to_uppercase();
        let number = number.replace("S0", "S");
        assert_eq!(markdown.matches(&format!("**Figure {number}.**")).count(), 1, "Fig. {number}");
    }
}

/// A reader meets the supplementary figures in the order of their numbers.
#[test]
fn supplementary_figures_are_numbered_by_first_mention() {
    let template = QUICK.paper.edition.documents.iter().map(|document| QUICK.prose(document));
    let template = template.collect::<Vec<_>>().join("\n");
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
    let template: String =
        QUICK.paper.edition.documents.iter().map(|document| QUICK.prose(document)).collect();
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
    let blind = claims::ids_blind_to_number(&QUICK.published, &claims::rules(), &QUICK.results);
    assert_eq!(blind, ["sec6_normalised"]);
}

/// Those that nothing moves are listed with the reason.
#[test]
fn every_verdict_moves_with_the_evidence() {
    let ids =
        claims::ids_never_moved(&QUICK.published, &claims::rules(), &QUICK.results, true).unwrap();
    let listed = include_str!("never_moved.txt").lines();
    let in_all = listed.filter(|line| !line.contains("in full samples"));
    let listed: Vec<&str> = in_all.map(|line| line.split_once(": ").unwrap().0).collect();
    assert_eq!(ids, listed);
}

/// Judges results, and compares the verdicts of some statements or relations.
fn judged(results: &Results, expected: &[(&str, Verdict)]) {
    let mut rules = claims::rules();
    rules.retain(|rule| expected.iter().any(|(id, _)| *id == rule.id));
    let checks = claims::judge_all(&QUICK.published, &rules, results).unwrap();
    for (id, verdict) in expected {
        let judged_as = checks.iter().find(|check| check.id == *id).unwrap().verdict;
        assert_eq!(judged_as, *verdict, "{id}");
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

/// The printed threshold is that of the mean of realisations with an impact, not of all.
#[test]
fn the_half_height_is_that_of_realisations_with_an_impact() {
    let estimate = |value| Some(with_error(value, 0.001));
    for (half_height, of_all, expected) in
        [(0.12, 0.3, Verdict::Reproduced), (0.3, 0.12, Verdict::Differs)]
    {
        let mut results = QUICK.results_again(ALL);
        for experiment in [&PROTOCOL, &LENGTHS] {
            for curve in
                results.get_mut(experiment).unwrap().iter_mut().flat_map(|it| &mut it.curves)
            {
                (curve.rise.half_height, curve.rise.half_height_all) =
                    (estimate(half_height), estimate(of_all));
            }
        }
        judged(&results, &[("sec2_half_height", expected)]);
    }
}

/// All in one step of the grid is a jump, which our explanation by a slope must not survive.
#[test]
fn a_jump_of_the_mean_is_no_slope() {
    let mut results = QUICK.results_again(ALL);
    for row in &mut results.get_mut(&SWEEP).unwrap()[0].curves[0].rows {
        let value = if row.sigma < 0.12 { 1.0 } else { 100.0 };
        row.mean = Some(Mean { value, error: Some(0.01), interval: None });
    }
    judged(&results, &[("sec2_jump", Verdict::Differs)]);
}

/// Each part of the promise can fail: make one result worse and it does.
#[test]
fn the_promise_of_the_engine_follows_the_numbers() {
    let worse: [fn(&mut Results); 4] = [
        |results| results.get_mut(&RACE).unwrap().entries[0].misses += 1,
        |results| results.get_mut(&RACE).unwrap().entries[0].units = Some(9.0),
        |results| results.get_mut(&TRIALS).unwrap().trials[0][0][0] = Missed,
        |results| {
            let ours = |m: MethodName| m == MethodName::Certified;
            let scale = results.get_mut(&SCALE).unwrap();
            let row = scale.iter_mut().rfind(|row| ours(row.setting.method)).unwrap();
            row.evaluations_per_impact = row.evaluations_per_impact.map(|work| 3.0 * work);
        },
    ];
    for worse in worse {
        let mut results = QUICK.results_again(&[&RACE, &TRIALS, &SCALE]);
        worse(&mut results);
        judged(&results, &[("engine_as_promised", Verdict::Differs)]);
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
