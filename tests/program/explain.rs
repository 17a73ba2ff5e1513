//! Runs `impact-paper explain` on the report of the quick profile.

use crate::{QUICK, answer, outcome, program, put, refused};

fn report() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    put(&folder.path().join("r"), &QUICK.report);
    folder
}

/// What is asked for, and parts of the answer.
const CARDS: &str = "\
sweep.rise.half_height => standard error; impact_chain::rise::Curve::new (crates/impact-chain/src/rise.rs:; seed: 2007
sweep.rise.half_height => chain masses: 100; sweep-rise.csv
second_seed.rise.half_height => seed: 7002
theory.jump.p_jump => 0.013033; without chance
theory.jump.p_crit => 0.0122099; impact_circuits::jump::p_crit (crates/circuits/src/jump.rs:; (18)
printed.sec2_half_height => that the paper prints; Sec. 2
fig:3 => fig03.svg; figures::fig03 (src/figures/fig03.rs); seed: 2007; sigmas: 18 from 0.02 to 0.4
fig:s4 => transients: 2, 4, 8, 20, 40
fig:s10 => experiments::accuracy::race (src/experiments/accuracy/race.rs
eq:18 => impact_circuits::jump::p_crit (crates/circuits/src/jump.rs:; theory.jump.p_crit, theory.jump.p_crit_walls
claim:sec7_jump => Reproduced.; tolerance
eq:12 => f_N,p(k)";

#[test]
fn values_figures_equations_and_claims_are_explained() {
    let folder = report();
    for line in CARDS.lines() {
        let (id, parts) = line.split_once(" => ").unwrap();
        let card = answer(folder.path(), &format!("explain --paper r {id}"));
        assert!(!card.contains("\\mathrm") && !card.contains("\\Phi"), "{card}");
        for part in parts.split("; ") {
            assert!(card.contains(part), "{id}: {part:?} is not in\n{card}");
        }
    }
    // The addresses that DESIGN.md gives.
    let design = std::fs::read_to_string("DESIGN.md").unwrap();
    let addresses = design.split('`').filter(|code| code.contains("]."));
    let answers = addresses.map(|id| answer(folder.path(), &format!("explain --paper r {id}")));
    assert!(answers.count() > 0);
    let list = answer(folder.path(), "explain --paper r");
    for id in ["sweep.rise.half_height ", "fig:15 ", "fig:S1 ", "eq:38 ", "claim:sec2_onset "] {
        assert!(list.lines().any(|line| line.starts_with(id)), "{id}");
    }
}

#[test]
fn things_are_found_by_part_by_number_and_as_people_write_them() {
    let folder = report();
    let values: serde_json::Value = serde_json::from_slice(&QUICK.report["values.json"]).unwrap();
    let half = values["sweep.rise.half_height"]["number"]["real"]["value"].to_string();
    let number = |value: &serde_json::Value| value["number"]["real"]["value"].as_f64();
    let is_below = |value| number(value).is_some_and(|number| (-0.9..-0.01).contains(&number));
    let below = values.as_object().unwrap().iter().find(|(_, value)| is_below(value)).unwrap().0;
    for (asked, id) in [
        ("Fig. 3", "fig:3: "),
        ("Eq. (18)", "eq:18: "),
        ("SEC7_JUMP", "claim:sec7_jump: "),
        ("sweep.rise.half", "sweep.rise.half_height "),
        (&half[..5], "sweep.rise.half_height"),
        ("−0.", below),
    ] {
        let mut command = program(folder.path(), "explain --paper r");
        let (code, card, note) = outcome(command.arg(asked));
        let is_found = card.lines().any(|line| line.starts_with(id));
        assert!(code == 0 && is_found, "{asked}: {card}{note}");
    }
    let column = answer(folder.path(), "explain --paper r race.finest[method=sampled].units");
    let lines: Vec<&str> = column.lines().collect();
    assert!(lines.len() == 3 && lines[0].ends_with(": in data/race-finest.csv"), "{column}");
    assert!(lines[1].contains(",units (1),") && lines[2].starts_with("  sampled,"), "{column}");
    let says = ["there is no \"nope\"", "give no id to list all"];
    refused(folder.path(), "explain --paper r nope", &says);
}
