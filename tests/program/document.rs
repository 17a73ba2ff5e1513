//! `--document`: `diff`, `verify`, `explain` and `check` of one document of the report.

use crate::{QUICK, TEMPLATES, answer, put, refused, run};
use std::fs;

#[test]
fn one_document_is_compared_verified_and_explained() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    put(&here.join("paper"), &QUICK.report);
    put(&here.join("old"), &QUICK.report);
    // A figure and a sentence of the second paper, and a number that it names and the edition does not.
    let edit = |path: &str, from: &str, to: &str| {
        let path = here.join("paper").join(path);
        let text = fs::read_to_string(&path).unwrap();
        assert!(text.contains(from), "{from}");
        fs::write(&path, text.replacen(from, to, 1)).unwrap();
    };
    edit("figures/s01.svg", "<svg", "<svg ");
    edit("beyond.md", "Nucleation", "nucleation");
    let values = fs::read_to_string(here.join("paper/values.json")).unwrap();
    let at = values.find("\"restitution.all.shift\": {").unwrap();
    let (before, after) = values.split_at(at);
    let after = after.replacen("\"value\": ", "\"value\": 1", 1);
    fs::write(here.join("paper/values.json"), format!("{before}{after}")).unwrap();

    let fine = answer(here, "verify --document edition");
    assert!(fine.starts_with("paper: ") && fine.contains(" files, all as "), "{fine}");
    let (code, told, _) = run(here, "verify --document beyond");
    assert_eq!((code, told.as_str()), (1, "differs  beyond.md\ndiffers  figures/s01.svg\n"));

    let diff = |document: &str| answer(here, &format!("diff old paper --document {document}"));
    assert_eq!(diff("edition"), "old and paper: nothing differs\n");
    let told = diff("beyond");
    for part in ["1 number changed\n", "restitution.all.shift: ", "differs beyond.md", "s01.svg"] {
        assert!(told.contains(part), "{part}: {told}");
    }
    assert!(!told.contains("SHA256SUMS") && !told.contains("values.json"), "{told}");

    let edition = answer(here, "explain --document edition");
    assert!(edition.contains("\nfig:3 ") && edition.contains("claim:sec7_jump"), "{edition}");
    assert!(
        !edition.contains("restitution.all.shift") && !edition.contains("fig:s1 "),
        "{edition}"
    );
    refused(here, "explain --document edition restitution.all.shift", &["there is no"]);
    refused(here, "verify --document report", &["--document <NAME>", "edition"]);
    edit("ledger.json", "\"beyond\": {", "\"behind\": {");
    for verb in ["verify", "explain", "diff old paper"] {
        refused(here, &format!("{verb} --document beyond"), &["does not say what beyond shows"]);
    }
}

#[test]
fn checks_are_told_by_document() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    put(&here.join("r"), &QUICK.results);
    let check = |document: &str| {
        let check = "check --profile quick --results r --format json";
        let (code, told, note) =
            run(here, &format!("{check} --templates {TEMPLATES} --document {document}"));
        assert_eq!(code, 0, "{note}");
        let told: serde_json::Value = serde_json::from_str(&told).unwrap();
        ["claims", "relations", "targets"].map(|list| told[list].as_array().unwrap().len())
    };
    assert_eq!(check("edition"), [71, 0, 0]);
    let [claims, relations, targets] = check("beyond");
    assert!(claims == 0 && relations > 10 && targets == 0, "{relations}");
    let [claims, relations, targets] = check("methods");
    assert!(claims == 0 && relations == 0 && targets > 10, "{targets}");
}
