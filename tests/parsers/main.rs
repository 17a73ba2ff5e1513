//! Every parser of text that people or files give, with text that is nearly right: committed good
//! files with bytes flipped, cut, doubled, spliced, numbers exchanged, deeply nested. No parser
//! panics or hangs, whatever it is given, and each refusal is one line that names its file.

mod mutants;
mod program;
mod saved;
mod templates;

use impact_paper::claims::Published;
use impact_paper::dynamics::Scenario;
use impact_paper::dynamics::methods::State;
use impact_paper::experiments::{Measured, segments};
use impact_paper::report::bibliography::Library;
use impact_paper::report::card::Cards;
use impact_paper::report::lint::{Declared, numerals};
use impact_paper::report::print::{Asked, Style, print};
use impact_paper::report::{Registry, Value, compare, ledger};
use mutants::{committed, survives};

fn line(error: impl std::fmt::Display) -> String {
    error.to_string()
}

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
    survives("scenario", &scenarios(), 4000, &[""], |text| {
        let scenario = Scenario::from_json(text).map_err(line)?;
        State::of(&scenario);
        scenario.validate().map_err(line)
    });
}

/// The saved scenarios of two figures, which hold one each and say what it does.
#[test]
fn saved_scenarios_of_any_text() {
    let other = committed("templates/scenarios/fig06.json");
    let good = [committed("templates/scenarios/fig05.json")];
    survives("segments", &good, 3000, &["scenarios/fig05.json:"], move |text| {
        segments::run([text, &other]).map(drop).map_err(line)
    });
}

#[test]
fn published_numbers_of_any_text() {
    let good = [committed("templates/published.toml")];
    survives("published", &good, 2000, &["published.toml:"], |text| {
        let published = Published::parse(text).map_err(line)?;
        for statement in &published.statements {
            published.line(text, &statement.id);
            if let Ok([low, high]) = statement.rounding() {
                assert!(low <= high, "{statement:?}");
            }
            let value = Value::printed("x", &statement.printed, &statement.place);
            let mut values = Registry::new();
            if values.add(value.clone()).is_ok() {
                assert!(value.plain().len() < 2000 + statement.printed.len());
            }
        }
        Ok(())
    });
}

#[test]
fn declared_phrases_of_any_text() {
    let good = [committed("templates/literals.toml")];
    survives("literals", &good, 4000, &["literals.toml:"], |text| {
        let declared = Declared::read(text).map_err(line)?;
        numerals("x.md", "The two masses, three walls and twenty-five more", &declared);
        declared.unmet();
        Ok(())
    });
}

#[test]
fn references_of_any_text() {
    let good = [committed("templates/references.bib")];
    survives("references", &good, 150, &["references.bib"], |text| {
        let library = Library::read(text).map_err(line)?;
        let keys: Vec<String> = library.keys().map(String::from).collect();
        library.entries(&keys).map(drop).map_err(line)
    });
}

/// The values of the committed report.
fn values() -> Registry {
    compare::read(&committed("paper/values.json")).unwrap()
}

#[test]
fn values_of_any_text() {
    let good = [committed("paper/values.json")];
    let before = values();
    survives("values", &good, 500, &["values.json:"], move |text| {
        let values = compare::read(text).map_err(line)?;
        for change in compare::changes(&before, &values) {
            assert!(change.to_string().len() < 10_000 + text.len());
        }
        for value in values.iter() {
            let asked =
                [None, Some(Asked::Full), Some(Asked::Fixed(3)), Some(Asked::Significant(3))];
            for (digits, percent) in asked.into_iter().flat_map(|d| [(d, false), (d, true)]) {
                let printed = print(&value.number, Style { percent, digits, ..Style::default() });
                let long = printed.markdown().len() + printed.maths().len() + printed.plain().len();
                assert!(long < 10_000 + text.len(), "{value:?}");
            }
        }
        Ok(())
    });
}

#[test]
fn ledgers_of_any_text() {
    let good = [committed("paper/ledger.json")];
    let values = values();
    survives("ledger", &good, 250, &["ledger.json:"], move |text| {
        let ledger = ledger::read(text).map_err(line)?;
        let cards = Cards { values: &values, ledger: &ledger };
        for id in cards.ids() {
            cards.get(&id);
        }
        Ok(())
    });
}

#[test]
fn measurements_of_any_text() {
    let good = [committed("benches/measured.json")];
    survives("measured", &good, 1000, &["measured.json:"], |text| {
        Measured::parse(text).map(drop).map_err(line)
    });
}
