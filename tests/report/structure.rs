//! Tests rules about the source that no compiler checks, and that the README is current.

use super::QUICK;
use literate::report::EquationEntry;
use literate::value::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// All files below a folder with one of these endings, as (path from the top, text).
pub fn files(folder: &str, endings: &[&str]) -> Vec<(String, String)> {
    let mut files = crate::tree(&root().join(folder));
    files.retain(|path, _| endings.iter().any(|end| path.ends_with(end)));
    let with_text = |(path, bytes)| (format!("{folder}/{path}"), String::from_utf8(bytes).unwrap());
    files.into_iter().map(with_text).collect()
}

#[test]
fn no_path_of_a_machine() {
    // In two parts, so that this file does not find itself.
    let paths = ["/wo:rk/", "/ro:ot/", "/ho:me/", "/tm:p/", "/Us:ers/"].map(|p| p.replace(':', ""));
    let endings = [".rs", ".toml", ".md", ".tex", ".bib", ".json", ".csv", ".svg", "run"];
    let folders = ["src", "crates", "tests", "templates", "paper", ".ci"];
    let mut texts: Vec<_> = folders.iter().flat_map(|folder| files(folder, &endings)).collect();
    for name in ["README.md", "DESIGN.md", "CHANGELOG.md", "Makefile", "Cargo.toml", "CITATION.cff"]
    {
        texts.push((name.into(), fs::read_to_string(root().join(name)).unwrap()));
    }
    for (name, content) in texts {
        for path in &paths {
            assert!(!content.contains(path.as_str()), "{name} has {path}");
        }
    }
}

/// The score on the README's first screen is that of the committed ledger.
#[test]
fn the_readme_has_the_score() {
    let ledger = fs::read_to_string(root().join("paper/ledger.json")).unwrap();
    let ledger: serde_json::Value = serde_json::from_str(&ledger).unwrap();
    let rows = ledger["claims"].as_array().unwrap().iter();
    let rows: Vec<_> = rows.filter(|row| row["kind"] == "statement").collect();
    let count = |verdict: &str| rows.iter().filter(|row| row["verdict"] == verdict).count();
    let score = format!(
        "of {} statements {} are reproduced, {} differ and are explained, {} differ, and {} cannot be judged",
        rows.len(),
        count("reproduced"),
        count("differs and explained"),
        count("differs"),
        count("cannot be judged"),
    );
    let readme = fs::read_to_string(root().join("README.md")).unwrap();
    let line = readme.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(line.contains(&score), "the README does not say: {score}");
    let by = |bases: &[&str]| {
        let on = rows.iter().filter(|row| bases.iter().any(|basis| row["basis"] == *basis));
        [on.clone().count(), on.filter(|row| row["verdict"] == "reproduced").count()]
    };
    let [theory, measures] = [by(&["exact", "rounding", "finite cases"]), by(&["our measure"])];
    let split = format!(
        "rest {} of them, of which {} are reproduced; on our measure of a word rest {}, of which {} are; the one number printed for the simulation, in {} readings, cannot",
        theory[0],
        theory[1],
        measures[0],
        measures[1],
        by(&["printed digit"])[0]
    );
    assert!(line.contains(&split), "the README does not say: {split}");
    assert_eq!(by(&["printed digit"])[1], 0);
}

#[test]
fn links_of_the_readme_land() {
    let readme = fs::read_to_string(root().join("README.md")).unwrap();
    for part in readme.split("](").skip(1) {
        let target = part.split(')').next().unwrap();
        // paper/ is written by the program, and may not be there yet.
        if !target.contains("://") && !target.starts_with("paper/") {
            assert!(root().join(target).exists(), "the README links to {target}");
        }
    }
}

/// The comment of an equation's home says its number, and belongs to the item.
#[test]
fn each_equation_has_one_home() {
    let paper = &QUICK.paper;
    for EquationEntry { number, home, step_towards, .. } in &paper.edition.equations {
        let step = step_towards.as_ref().map(|next| format!(" (step towards {next}):"));
        let mark = format!("**Eq. ({number})**{}", step.unwrap_or_default());
        let homes = paper.project.sources.files.iter().filter(|(_, text)| text.contains(&mark));
        let homes: Vec<_> = homes.collect();
        let [(path, text)] = homes.as_slice() else { panic!("{mark}: {} homes", homes.len()) };
        assert_eq!(Some(*path), paper.project.sources.file(home), "{mark}");
        let (_, rest) = text.split_once(&mark).unwrap();
        assert!(!rest.contains(&mark), "{mark} stands twice in {path}");
        let is_code = |line: &&str| !line.trim_start().starts_with(['/', '#']);
        let item = rest.lines().skip(1).find(is_code).unwrap();
        let name = home.rsplit("::").next().unwrap();
        assert!(home == "impact_chain" || item.contains(&format!(" {name}")), "{mark}: {item}");
    }
}

/// An origin names the function that computed the number: no constant, structure or module.
#[test]
fn every_origin_is_a_function() {
    let values: BTreeMap<String, Value> =
        serde_json::from_slice(&QUICK.report["values.json"]).unwrap();
    let (sources, mut functions) = (&QUICK.paper.project.sources, 0);
    for Value { id, source, .. } in values.values().filter(|value| !value.source.is_empty()) {
        let (file, line) = sources.place(source).unwrap_or_else(|| panic!("{id}: {source}"));
        let (_, text) = sources.files.iter().find(|(path, _)| *path == file).unwrap();
        let line = text.lines().nth(line.expect(source) - 1).unwrap();
        let name = source.rsplit("::").next().unwrap();
        assert!(line.contains(&format!("fn {name}")), "{id}: {source}: {line}");
        let is_mean = id.starts_with("sweep.rows") && id.ends_with(".mean");
        assert!(!is_mean || source == "impact_chain::rise::RisePoint::new", "{id}: {source}");
        functions += 1;
    }
    assert!(functions > 300, "{functions}");
}
