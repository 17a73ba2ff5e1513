//! Runs `impact-paper explain` on the report of the quick profile.

use crate::*;

fn report() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    put(&folder.path().join("r"), &QUICK.report);
    folder
}

/// The table has what is asked for, and parts of the answer.
#[test]
fn values_figures_equations_and_claims_are_explained() {
    let folder = report();
    for line in include_str!("cards.txt").lines() {
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
