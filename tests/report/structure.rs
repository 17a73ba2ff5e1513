//! Tests rules about the source that no compiler checks.

use super::*;
use literate::report::EquationEntry;
use literate::value::Value;

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
        serde_json::from_str(QUICK.file_text("values.json")).unwrap();
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
