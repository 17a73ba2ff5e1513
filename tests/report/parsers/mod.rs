//! Every parser of text that people or files give, with text that is nearly right: committed good
//! files with bytes flipped, cut, doubled, spliced, numbers exchanged, deeply nested. No parser
//! panics or hangs, whatever it is given, and each refusal is one line that names its file.

mod entries;
mod mutants;
mod program;
mod saved;
mod templates;

use mutants::{committed, survives};

/// Scenarios with all that they can have.
const SCENARIOS: [&str; 3] = [
    r#"{"forcing":[[0.9,-0.4],[-0.7,0.8],[0.3,0.9]]}"#,
    r#"{"spacing": 1, "natural_frequency": 1, "forcing_frequency": 1.4142135623730951,
        "restitution": 0.8, "boundary": "ring", "simultaneous": "joint",
        "initial": {"random": {"sigma": 0.1, "seed": 7}}, "forcing": [[0.1, 0.2], [0.3, 0.4]]}"#,
    r#"{"forcing_frequencies": [1.5, 2.5], "forcing": [[[1, 2], [3, 4]], [[5, 6], [7, 8]]],
        "initial": {"free": [[0.1, 0], [0, 0.1]]}}"#,
];

/// A parser, a committed file that it takes, how many texts are made of it, and how each refusal begins.
const DAMAGED: [(&str, &str, usize, &str); 9] = [
    ("scenario", "", 4000, ""),
    ("segments", "templates/scenarios/fig05.json", 3000, "scenarios/fig05.json:"),
    ("published", "templates/published.toml", 2000, "published.toml:"),
    ("literals", "templates/literals.toml", 4000, "literals.toml:"),
    ("references", "templates/references.bib", 150, "references.bib"),
    ("values", "paper/values.json", 500, "values.json:"),
    ("ledger", "paper/ledger.json", 250, "ledger.json:"),
    ("measured", "benches/measured.json", 1000, "measured.json:"),
    ("sums", "paper/SHA256SUMS", 2000, "line "),
];

#[test]
fn files_of_any_text() {
    std::thread::scope(|scope| {
        for (name, file, count, start) in DAMAGED {
            let (_, parser) = *entries::ALL.iter().find(|(own, _)| *own == name).unwrap();
            let good = match file {
                "" => SCENARIOS.map(String::from).into(),
                file => vec![committed(file)],
            };
            scope.spawn(move || survives(name, &good, count, start, parser));
        }
    });
}

/// What the fuzzer found, and what it begins with (tests/fuzz/corpus): no parser panics over any.
#[test]
fn texts_that_the_fuzzer_keeps() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fuzz/corpus");
    for (name, parser) in entries::ALL {
        let mut count = 0;
        for entry in std::fs::read_dir(folder.join(name)).unwrap() {
            let path = entry.unwrap().path();
            let text = String::from_utf8_lossy(&std::fs::read(&path).unwrap()).into_owned();
            let told = std::panic::catch_unwind(|| parser(&text));
            let told = told.unwrap_or_else(|_| panic!("{} panics", path.display()));
            let line = told.err().unwrap_or_default();
            assert!(mutants::is_one_line(&line), "{}: {line:?}", path.display());
            count += 1;
        }
        assert!(count > 0, "{name} has no text");
    }
}
