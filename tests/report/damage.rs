//! Damages a text for each reader: none panics or hangs, and each fault is one line.

use super::QUICK;
use impact_chain::Scenario;
use impact_numerics::random::{Seed, generator};
use impact_paper::claims::Published;
use literate::input::one_line;
use literate::prose::Templates;
use literate::report::bibliography::Library;
use literate::report::filler::Filler;
use literate::report::labels::Labels;
use literate::report::{Document, Error};
use literate::report::{folder, latex, ledger, markdown, parse, values};
use rand::RngExt;
use std::{fs, sync::LazyLock, sync::mpsc::channel, time::Duration};

const SCENARIO: &str = r#"{"restitution": 0.8, "boundary": "ring", "initial": {"free": [[0.1, 0], [0, 0.1]]},
    "forcing_frequencies": [1.5, 2.5], "forcing": [[[0.1, 0.2], [0.3, 0.4]], [[0.5, 0.6], [0.7, 0.8]]]}"#;

const PROSE: &str = r#"# A title

## Sec {#sec:a}

Masses ([@rice1945]; see [@eq:18] and [@sec:a]) at «sweep.rise.half_height» move *fast*, [here](x.md):

$$
p_{\mathrm{crit}} = \left(\frac{1 + \sqrt{N+1}}{«theory.jump.p_jump | significant(digits=3)»}\right)^2 \tag{18}
$$

| Check | Ours |
|:--|--:|
<% for c in ["a", "b"] %>| «c» | «theory.jump.p_jump | percent» |
<% endfor %>
[@bibliography]
"#;

/// What is put in anywhere: signs that mean something, numbers, and what can be nested.
const SIGNS: &str = "{~}~[~]~(~)~\"~\\~,~=~\n\n~\r~\0~#~$~$$~```~*~|~> ~- ~«~»~«(~<% if true %>~<!--~[@~![~\
                     {\"a\":~\\sqrt{~\u{e000}~\u{2028}~NaN~-1e309~99999999999999999999~5e-324";

type Reader = fn(&str) -> Result<(), String>;

fn damaged(name: &str, index: u64, good: &str) -> String {
    let mut random = generator(name, Seed(1), index);
    let signs: Vec<&str> = SIGNS.split('~').collect();
    let mut bytes = good.as_bytes().to_vec();
    for _ in 0..random.random_range(1..4) {
        let offset = random.random_range(0..=bytes.len());
        let end = (offset + random.random_range(0..40)).min(bytes.len());
        match random.random_range(0..5) {
            0 if offset < bytes.len() => bytes[offset] ^= 1 << random.random_range(0..8),
            1 => drop(bytes.drain(offset..end)),
            2 if random.random_bool(0.2) => bytes.truncate(offset),
            3 => drop(bytes.splice(offset..offset, bytes[offset..end].to_vec())),
            _ => {
                let times = if random.random_bool(0.1) { 1000 } else { 1 };
                let sign = signs[random.random_range(0..signs.len())];
                drop(bytes.splice(offset..offset, sign.repeat(times).bytes()));
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Gives a reader the valid text and so many damaged ones.
fn survives(name: &str, good: String, count: u64, read: Reader) {
    assert_eq!(read(&good), Ok(()), "{name}");
    let texts: Vec<String> = (0..count).map(|index| damaged(name, index, &good)).collect();
    let (sender, outcomes) = channel();
    let given = texts.clone();
    std::thread::spawn(move || given.iter().all(|text| sender.send(read(text)).is_ok()));
    for text in texts {
        let outcome = outcomes.recv_timeout(Duration::from_secs(60));
        let line = outcome.unwrap_or_else(|_| panic!("{name} panics or hangs: {text}"));
        let line = line.err().unwrap_or_default();
        let plain = |line: &str| !line.contains(char::is_control) && line.len() <= 2000;
        assert!(line.lines().all(plain), "{name}: {line}: {text}");
    }
}

static LIBRARY: LazyLock<Library> =
    LazyLock::new(|| Library::read(include_str!("../../templates/references.bib")).unwrap());

/// What documents make of a text.
fn prose(text: &str) -> Result<(), Error> {
    let (values, templates) = (&QUICK.values, Templates::from_files([("report.md", text)]));
    let filler = Filler::new(&templates, values)?;
    let filled = filler.prose(&Document::REPORT)?;
    let sources = &QUICK.paper.project.sources;
    let parsed = parse::parse(&filled, values, &filler.declared, sources);
    if let Some(error) = parsed.errors.into_iter().next() {
        return Err(error);
    }
    let mut blocks = parsed.blocks;
    let (here, mut labels) = (Document::REPORT, Labels::default());
    labels.number_all(&mut blocks, here)?;
    labels.resolve(&mut blocks, here, &LIBRARY)?;
    markdown::write(&blocks);
    latex::write(&blocks, here, &QUICK.paper.edition).map(drop)
}

fn line<T>(read: Result<T, impl std::fmt::Display>) -> Result<(), String> {
    read.map(drop).map_err(|error| one_line(&error.to_string(), 1000))
}

#[test]
fn no_reader_panics_or_hangs() {
    survives("prose", PROSE.into(), 200, |text| line(prose(text)));
    let file = |path: &str| fs::read_to_string(path).unwrap();
    let of = |path: &str, count, read: Reader| survives(path, file(path), count, read);
    of("templates/published.toml", 100, |text| line(Published::parse(text)));
    of("templates/references.bib", 30, |text| line(Library::read(text)));
    of("paper/values.json", 25, |text| line(values::read(text)));
    of("paper/ledger.json", 25, |text| line(ledger::read(text)));
    of("paper/SHA256SUMS", 1000, |text| folder::read_sums(text).map(drop).ok_or_else(String::new));
    let scenario = |text: &str| line(Scenario::from_json(text).and_then(|read| read.validate()));
    survives("scenario", SCENARIO.into(), 2000, scenario);
}
