//! Every parser of text that people or files give, with text that is nearly right: committed good
//! files with bytes flipped, cut, doubled, spliced, numbers exchanged, deeply nested. No parser
//! panics or hangs, whatever it is given, and each refusal is one line that names its file.

mod entries;
mod mutants;
mod program;
mod saved;
mod templates;

use mutants::{committed, survives};

fn scenarios() -> Vec<String> {
    let small = [
        r#"{"forcing":[[0.9,-0.4],[-0.7,0.8],[0.3,0.9]]}"#,
        r#"{"spacing": 1, "natural_frequency": 1, "forcing_frequency": 1.4142135623730951,
            "restitution": 0.8, "boundary": "ring", "simultaneous": "joint",
            "initial": {"random": {"sigma": 0.1, "seed": 7}}, "forcing": [[0.1, 0.2], [0.3, 0.4]]}"#,
        r#"{"forcing_frequencies": [1.5, 2.5], "forcing": [[[1, 2], [3, 4]], [[5, 6], [7, 8]]],
            "initial": {"free": [[0.1, 0], [0, 0.1]]}}"#,
    ];
    small.map(String::from).into()
}

#[test]
fn scenarios_of_any_text() {
    survives("scenario", &scenarios(), 4000, &[""], entries::scenario);
}

#[test]
fn saved_scenarios_of_any_text() {
    let good = [committed("templates/scenarios/fig05.json")];
    survives("segments", &good, 3000, &["scenarios/fig05.json:"], entries::saved_scenario);
}

#[test]
fn published_numbers_of_any_text() {
    let good = [committed("templates/published.toml")];
    survives("published", &good, 2000, &["published.toml:"], entries::published);
}

#[test]
fn declared_phrases_of_any_text() {
    let good = [committed("templates/literals.toml")];
    survives("literals", &good, 4000, &["literals.toml:"], entries::literals);
}

#[test]
fn references_of_any_text() {
    let good = [committed("templates/references.bib")];
    survives("references", &good, 150, &["references.bib"], entries::references);
}

#[test]
fn values_of_any_text() {
    let good = [committed("paper/values.json")];
    survives("values", &good, 500, &["values.json:"], entries::values);
}

#[test]
fn ledgers_of_any_text() {
    let good = [committed("paper/ledger.json")];
    survives("ledger", &good, 250, &["ledger.json:"], entries::ledger);
}

#[test]
fn measurements_of_any_text() {
    let good = [committed("benches/measured.json")];
    survives("measured", &good, 1000, &["measured.json:"], entries::measured);
}

#[test]
fn lists_of_digests_of_any_text() {
    let good = [committed("paper/SHA256SUMS")];
    survives("sums", &good, 2000, &["line "], entries::list_of_sums);
}

/// What the fuzzer found, and what it begins with (tests/fuzz/corpus): no parser panics over any.
#[test]
fn texts_that_the_fuzzer_keeps() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fuzz/corpus");
    for (name, parser) in entries::ALL {
        let texts = std::fs::read_dir(folder.join(name)).unwrap();
        let mut count = 0;
        for entry in texts {
            let path = entry.unwrap().path();
            let text = String::from_utf8_lossy(&std::fs::read(&path).unwrap()).into_owned();
            let told = std::panic::catch_unwind(|| parser(&text));
            let told = told.unwrap_or_else(|_| panic!("{} panics", path.display()));
            if let Err(line) = told {
                let shape = !line.contains(char::is_control) && line.len() <= mutants::LINE;
                assert!(shape, "{}: {line:?}", path.display());
            }
            count += 1;
        }
        assert!(count > 0, "{name} has no text");
    }
}
