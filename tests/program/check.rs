//! Runs `impact-paper check`, and damages the templates: each fault has its file and line.

use crate::*;
use impact_paper::claims::Basis;

fn check(folder: &Path, more: &str, code: i32, words: &[&str]) -> String {
    let line = format!("check --profile quick --results r --templates t {more}");
    let [out, _] = ends(folder, line.trim(), code, words);
    out
}

/// One of the statements would have another number.
#[test]
fn every_statement_is_listed_and_one_that_differs_fails() {
    let folder = tempfile::tempdir().unwrap();
    crate::put(&folder.path().join("r"), &QUICK.results);
    templates(&folder.path().join("t"), "published.toml", |text| {
        let (before, entry) = text.split_at(text.find("id = \"sec3_edges\"").unwrap());
        before.to_string()
            + &entry.replacen("\"16\"", "\"17\"", 1).replacen("value = 16", "value = 17", 1)
    });
    let differs = "differ without an explanation that holds: sec3_edges";
    let listing = check(folder.path(), "-v", 1, &[differs]);
    // The sign, the number, the id, the verdict, the place and the basis.
    let verdicts: BTreeMap<String, String> = listing
        .lines()
        .filter(|line| !line.starts_with(' ') && line.contains(" sec") && line.ends_with(')'))
        .map(|line| {
            let words: Vec<&str> = line.split_whitespace().collect();
            let verdict = line.split_once(": ").unwrap().1.split(" (").next().unwrap();
            let is_basis = |basis: &Basis| line.ends_with(&format!("{})", basis.words()));
            assert!(Basis::ALL.iter().any(is_basis) && words[1].parse::<usize>().is_ok(), "{line}");
            assert_eq!(line.starts_with('?'), verdict == "cannot be judged", "{line}");
            (words[2].trim_end_matches(':').to_string(), verdict.to_string())
        })
        .collect();
    assert_eq!(verdicts.len(), 87, "{listing}");
    assert!(listing.starts_with("FAILS") && verdicts["sec3_edges"] == "differs", "{listing}");
    // Else a line for each that is not simply reproduced, with both sides.
    let short = check(folder.path(), "", 1, &[]);
    let explained = verdicts.values().filter(|verdict| *verdict == "differs and explained").count();
    let lines = short.lines().filter(|line| line.starts_with('≠'));
    assert_eq!(lines.clone().count(), explained, "{short}");
    assert!(lines.clone().all(|line| line.contains("; paper: ") && line.contains("; here: ")));
    assert!(!short.contains(": reproduced;") && short.contains("check -v"), "{short}");
    // One by its number in the ledger.
    let one = check(folder.path(), "1", 0, &[]);
    assert!(one.contains("1 statement of the paper"), "{one}");
    let one = check(folder.path(), "two_seeds", 0, &[]);
    assert!(one.contains("1 of 1 relations between numbers hold"), "{one}");
    // The statements of the paper and our relations are scored apart.
    let scores: Vec<&str> =
        listing.lines().skip_while(|line| !line.contains(" statements of the paper: ")).collect();
    assert!(scores[0].starts_with("79 statements of the paper: "), "{listing}");
    assert!(scores[0].contains(&format!(", differs and explained {explained}, ")), "{listing}");
    assert!(scores[1].starts_with("reproduced, by what the verdict rests on: "), "{listing}");
    assert!(scores[2].starts_with("our own checks: "), "{listing}");
    // The report is written all the same.
    let paper = "paper --profile quick --out p --results r --templates t";
    ends(folder.path(), paper, 1, &["sec3_edges; `check` says more"]);
    let ledger = std::fs::read_to_string(folder.path().join("p/ledger.json")).unwrap();
    assert!(ledger.contains("\"verdict\": \"differs\""));
}

/// The table has the exit code, a file of the templates, its fault (or more lines), and the message
/// ($ is the last line).
#[test]
fn faults_of_the_prose_are_reported_with_their_place() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    crate::put(&here.join("r"), &QUICK.results);
    for line in include_str!("faults.txt").lines() {
        let (given, message) = line.split_once(" => ").unwrap();
        let [expected, file, fault] = given.splitn(3, ' ').collect::<Vec<_>>().try_into().unwrap();
        let _ = std::fs::remove_dir_all(here.join("t"));
        templates(&here.join("t"), file, |text| match fault.split_once(" -> ") {
            Some((from, to)) => text.replacen(from, to, 1),
            None => format!("{}\n\n{}\n", text.trim_end(), &fault[1..]),
        });
        let prose = std::fs::read_to_string(here.join("t").join(file)).unwrap();
        let message = format!("{file}{}", message.replace('$', &prose.lines().count().to_string()));
        let paper = "paper --profile quick --out p --results r --templates t";
        let [_, note] = ends(here, paper, expected.parse().unwrap(), &[]);
        assert!(note.lines().last().unwrap().contains(&message), "{message}: {note}");
    }
}
