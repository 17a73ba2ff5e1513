//! Each parser of text from outside, as a function that says what it refuses: for the tests beside it,
//! and for the fuzzer (tests/fuzz).

use impact_paper::claims::Published;
use impact_paper::dynamics::Scenario;
use impact_paper::dynamics::methods::State;
use impact_paper::experiments::{Measured, segments};
use impact_paper::report::bibliography::Library;
use impact_paper::report::card::Cards;
use impact_paper::report::html::Site;
use impact_paper::report::labels::Labels;
use impact_paper::report::ledger::{self, Ledger};
use impact_paper::report::lint::{Declared, findings};
use impact_paper::report::origin::Filled;
use impact_paper::report::print::{Asked, Style, print};
use impact_paper::report::{
    Document, Error, PROGRAM, Registry, Value, compare, html, latex, markdown, parse, sums,
};
use std::sync::LazyLock;

/// One that is given a text: nothing, or the line that is told.
pub type Parser = fn(&str) -> Result<(), String>;

/// All by name; the fuzzer keeps texts for each in a folder of that name.
pub const ALL: [(&str, Parser); 11] = [
    ("scenario", scenario),
    ("segments", saved_scenario),
    ("published", published),
    ("literals", literals),
    ("references", references),
    ("values", values),
    ("ledger", ledger),
    ("measured", measured),
    ("sums", list_of_sums),
    ("prose", prose),
    ("document", document),
];

fn line(error: impl std::fmt::Display) -> String {
    error.to_string()
}

pub fn scenario(text: &str) -> Result<(), String> {
    let scenario = Scenario::from_json(text).map_err(line)?;
    State::of(&scenario);
    scenario.validate().map_err(line)
}

/// The saved scenario of a figure, which holds one and says what it does.
pub fn saved_scenario(text: &str) -> Result<(), String> {
    let other = include_str!("../../../templates/scenarios/fig06.json");
    let given = |file: &str| Ok(if file == segments::FILES[0] { text } else { other }.to_string());
    segments::read(&given).map(drop).map_err(line)
}

pub fn published(text: &str) -> Result<(), String> {
    let published = Published::parse(text).map_err(line)?;
    for statement in &published.statements {
        published.line(&statement.id);
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
}

pub fn literals(text: &str) -> Result<(), String> {
    let declared = Declared::read(text).map_err(line)?;
    findings("x.md", "The two masses, three walls and twenty-five more", &declared);
    declared.unmet();
    Ok(())
}

pub fn references(text: &str) -> Result<(), String> {
    let library = Library::read(text).map_err(line)?;
    let keys: Vec<String> = library.keys().map(String::from).collect();
    library.entries(&keys).map(drop).map_err(line)
}

/// The values of the committed report.
static VALUES: LazyLock<Registry> =
    LazyLock::new(|| compare::read(include_str!("../../../paper/values.json")).unwrap());

pub fn values(text: &str) -> Result<(), String> {
    let values = compare::read(text).map_err(line)?;
    for change in compare::changes(&VALUES, &values) {
        assert!(change.to_string().len() < 10_000 + text.len());
    }
    for value in values.iter() {
        let asked = [None, Some(Asked::Full), Some(Asked::Significant(3))];
        for (digits, percent) in asked.into_iter().flat_map(|d| [(d, false), (d, true)]) {
            let printed = print(&value.number, Style { percent, digits, ..Style::default() });
            let long = printed.markdown().len() + printed.maths().len() + printed.plain().len();
            assert!(long < 10_000 + text.len(), "{value:?}");
        }
    }
    Ok(())
}

pub fn ledger(text: &str) -> Result<(), String> {
    let ledger = ledger::read(text).map_err(line)?;
    let cards = Cards { values: &VALUES, ledger: &ledger, program: PROGRAM };
    for id in cards.ids() {
        cards.get(&id);
    }
    Ok(())
}

/// A document of a report that is compared.
pub fn document(text: &str) -> Result<(), String> {
    let own = include_str!("../../../paper/README.md");
    let change = compare::ProseChange::between("", own, text)?;
    assert!(change.sentences.len() + change.numbers_alone < 500 + text.len());
    Ok(())
}

pub fn measured(text: &str) -> Result<(), String> {
    Measured::parse(text).map(drop).map_err(line)
}

/// The list of digests beside a report.
pub fn list_of_sums(text: &str) -> Result<(), String> {
    for entry in sums::read(text).map_err(line)? {
        assert!(sums::is_inside(&entry.path), "{entry:?}");
    }
    Ok(())
}

/// Prose whose places are filled.
pub fn prose(text: &str) -> Result<(), String> {
    let long = written(text, &VALUES).map_err(line)?;
    assert!(long < 1 << 26, "{long} bytes");
    Ok(())
}

static LIBRARY: LazyLock<Library> =
    LazyLock::new(|| Library::read(include_str!("../../../templates/references.bib")).unwrap());

/// What is written of it in every form, but for pictures: how many bytes.
pub fn written(text: &str, values: &Registry) -> Result<usize, Error> {
    let filled = Filled::plain("report.md", text);
    let (mut blocks, _) = parse::parse(&filled, values, PROGRAM)?;
    let (here, mut labels) = (Document::REPORT, Labels::default());
    labels.number_all(&mut blocks, here)?;
    labels.resolve(&mut blocks, here, &LIBRARY)?;
    let ledger = Ledger::default();
    let cards = Cards { values, ledger: &ledger, program: PROGRAM };
    let page =
        html::write(&blocks, &[], Site { here, labels: &labels, moving: None, lab: true }, cards);
    let latex = latex::write(&blocks)?.len() + latex::listings(&blocks)?.len();
    latex::title(&blocks)?;
    let page = match page {
        Ok(page) => page.body.len(),
        // No figure was given.
        Err(Error::Reference(_)) => 0,
        Err(error) => return Err(error),
    };
    Ok(markdown::write(&blocks).len() + latex + page)
}
