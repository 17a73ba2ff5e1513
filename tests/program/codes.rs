//! The exit codes of `impact-paper`, each reached by some of its ways.

use crate::{QUICK, answer, outcome, templates};
use std::process::Command;

/// The exit codes of `--help` and DESIGN.md. Code 2 is that of what is refused, code 130 that of a signal: both have tests
/// of their own.
#[test]
fn exit_codes_are_those_of_the_table() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    crate::put(&here.join("r"), &QUICK.results);
    templates(&here.join("good"), "front.md", |text| text.into());
    templates(&here.join("differs"), "published.toml", |text| {
        text.replacen("printed = \"16\"\nvalue = 16", "printed = \"17\"", 1)
    });
    let paper = "\"$0\" paper --profile quick --out p --results r --templates";
    for (expected, line, says) in [
        (0, format!("{paper} good"), " statements of the paper: "),
        (0, "\"$0\" verify p".into(), "all as SHA256SUMS lists them"),
        (0, "\"$0\" diff p p --exit-code".into(), "nothing differs"),
        (1, format!("{paper} differs"), "sec3_edges; `check` says more"),
        (1, "\"$0\" paper --profile quick --results q --dry-run".into(), "16 experiments to be run"),
        (
            0,
            "ulimit -v 1000000; exec \"$0\" sweep --sigma 0.3 --masses 1000000 --realisations 1 --transient 0 \
             --window 1 --threads 1"
                .into(),
            "0.3,",
        ),
        (2, "\"$0\" paper --figure 4 --out h --templates good >/dev/full".into(), "standard output"),
    ] {
        let mut command = Command::new("bash");
        command.current_dir(here).args(["-c", &line, crate::PROGRAM]);
        let (code, told, note) = outcome(&mut command);
        assert_eq!(code, expected, "{line}: {told}{note}");
        assert!(told.contains(says) || note.contains(says), "{line}: {note}");
        assert!(!note.contains("panicked") && !note.contains(".staging"), "{note}");
    }
    // A report whose statements fail is written all the same.
    let ledger = std::fs::read_to_string(here.join("p/ledger.json")).unwrap();
    assert!(ledger.contains("\"verdict\": \"differs\""));
    let help = answer(here, "--help");
    let design = std::fs::read_to_string("DESIGN.md").unwrap();
    for (code, words) in [(0, "fine"), (1, "check"), (2, "usage"), (130, "SIGTERM")] {
        let says = |line: &str| line.contains(words);
        let row = |line: &&str| line.trim_start().starts_with(&format!("{code} ")) && says(line);
        assert!(help.lines().any(|line| row(&line)), "{help}");
        let row = format!("| {code} | ");
        assert!(design.lines().any(|line| line.starts_with(&row) && says(line)), "{code}");
    }
}
