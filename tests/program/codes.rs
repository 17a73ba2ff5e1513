//! The exit codes of `impact-paper`, each reached by each of its ways.

use crate::{TEMPLATES, answer, outcome, templates};
use std::path::Path;
use std::process::Command;

/// The exit codes of `--help` and DESIGN.md, one row for each way to get there.
#[test]
fn exit_codes_are_those_of_the_table() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let templates = |name: &str, file: &str, from: &str, to: &str| {
        templates(&here.join(name), file, |text| {
            assert!(text.contains(from), "{from}");
            text.replacen(from, to, 1)
        });
    };
    templates("good", "front.md", "# ", "# ");
    templates("numeral", "front.md", "\n## ", "\nThere are 17 of them.\n\n## ");
    templates("broken", "published.toml", "[[statement]]", "[[statement");
    templates("renamed", "published.toml", "id = \"sec3_edges\"", "id = \"sec3_bends\"");
    let text = std::fs::read_to_string(Path::new(TEMPLATES).join("published.toml")).unwrap();
    let edges = &text[text.find("id = \"sec3_edges\"").unwrap()..];
    let edges = &edges[..edges.find("value = ").unwrap() + "value = ".len()];
    templates("differs", "published.toml", edges, &format!("{edges}9"));
    templates("none", "front.md", "# ", "# ");
    std::fs::remove_file(here.join("none/front.md")).unwrap();
    std::fs::create_dir(here.join("empty")).unwrap();
    let paper = |templates: &str| {
        format!("paper --profile quick --out p --results r --templates {templates}")
    };
    let rows = [
        (0, paper("good"), " statements of the paper: "),
        (0, "verify p".into(), "all as SHA256SUMS lists them"),
        (0, "diff p p --exit-code".into(), "nothing differs"),
        (1, paper("differs"), "sec3_edges"),
        (1, "check --profile quick --results r --templates differs".into(), "sec3_edges"),
        (1, "verify p --rerun --results r --templates good".into(), "ledger.json"),
        (1, paper("numeral"), "17"),
        (2, paper("broken"), "published.toml"),
        (2, "check --profile quick --results r --templates broken".into(), "published.toml"),
        (2, paper("renamed"), "published.toml"),
        (2, "check --profile quick --results r --templates renamed".into(), "published.toml"),
        (2, paper("none"), "front.md: no such file"),
        (
            0,
            "ulimit -v 1000000; exec \"$0\" sweep --sigma 0.3 --masses 1000000 --realisations 1 --transient 0 \
             --window 1 --threads 1"
                .into(),
            "0.3,",
        ),
        (2, "trace --until 1 $'no\nsuch'".into(), "no such: "),
        (2, "verify nowhere".into(), "nowhere"),
        (1, "paper --profile quick --results q --dry-run".into(), "to be run"),
        (2, "explain --paper p >/dev/full".into(), "standard output"),
        (2, "paper --figure 4 --out h --templates good >/dev/full".into(), "standard output"),
    ];
    for (expected, arguments, says) in rows {
        let line =
            if arguments.contains("exec") { arguments } else { format!("\"$0\" {arguments}") };
        let mut command = Command::new("bash");
        command.current_dir(here).args(["-c", &line, crate::PROGRAM]);
        let (code, told, note) = outcome(&mut command);
        assert_eq!(code, expected, "{line}: {told}{note}");
        assert!(
            told.contains(says) || note.lines().last().unwrap().contains(says),
            "{line}: {note}"
        );
        assert!(!note.contains("panicked") && !note.contains(".staging"), "{note}");
        if line.ends_with("--templates differs") && line.contains("paper") {
            // Written all the same.
            let ledger = std::fs::read_to_string(here.join("p/ledger.json")).unwrap();
            assert!(ledger.contains("\"verdict\": \"differs\""));
        }
    }
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
