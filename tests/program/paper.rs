//! `impact-paper paper` and `check` as a user meets them: what runs, what is written, what is not.

use crate::{
    EXPERIMENTS, QUICK, TEMPLATES, answer, digest, ended, files, outcome, program, templates, tree,
};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

/// The program in a folder of its own, with the templates of the project.
fn run(folder: &Path, arguments: &str) -> (i32, String, String) {
    crate::run(folder, &format!("{arguments} --templates {TEMPLATES}"))
}

/// Refuses the same.
fn refused(folder: &Path, arguments: &str, words: &[&str]) {
    crate::refused(folder, &format!("{arguments} --templates {TEMPLATES}"), words);
}

#[test]
fn a_figure_and_a_claim_run_no_more_than_they_need() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    for number in [4, 11] {
        let (code, told, note) = run(here, &format!("paper --figure {number} --out f"));
        assert_eq!((code, note.as_str()), (0, ""), "{told}");
        assert!(told.starts_with("f: ") && told.contains(" in "), "{told}");
        assert!(!told.contains("1 files") && !told.contains(" 0.0 s"), "{told}");
        assert!(here.join(format!("f/figures/fig{number:02}.svg")).is_file());
    }
    let (code, told, _) = run(here, "check --claim sec3_edges");
    assert!(code == 0 && told.contains("sec3_edges"), "{told}");
    assert!(told.contains("1 statement of the paper: "), "{told}");
    assert!(!here.join("target").exists(), "nothing was run and saved");
}

#[test]
fn only_the_figure_that_was_asked_for_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let (code, ..) = run(folder.path(), "paper --profile quick --figure 3 --out f --results r");
    assert_eq!(code, 0);
    let written = tree(&folder.path().join("f"));
    assert!(written.contains_key("figures/fig03.svg"), "{:?}", written.keys());
    let expected = |name: &String| name.contains("fig03") || name == "SHA256SUMS.local";
    assert!(written.keys().all(expected), "{:?}", written.keys());
    let saved: Vec<String> = tree(&folder.path().join("r")).into_keys().collect();
    assert!(saved.len() == 1 && saved[0].starts_with("sweep-"), "{saved:?}");
}

#[test]
fn threads_and_saved_results_change_no_byte_and_lesser_profiles_replace_no_full_report() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let paper = "paper --profile quick --out one --results r1";
    let (code, _, note) = run(folder.path(), &format!("{paper} --threads 1"));
    assert_eq!(code, 0, "{note}");
    let (report, saved) = (tree(&at("one")), files(&at("r1")));
    assert!(report.contains_key("report.md") && report.len() > 40, "{:?}", report.keys());
    assert_eq!(saved.len(), EXPERIMENTS);
    assert!(report == QUICK.report && saved == QUICK.results, "1 and 4 threads differ");

    // Again: nothing is run, nothing changes, not even the saved files' times.
    let times = |name: &str| -> Vec<_> {
        let files = std::fs::read_dir(at(name)).unwrap().map(|file| file.unwrap().path());
        let mut times: Vec<_> =
            files.map(|f| (f.clone(), f.metadata().unwrap().modified().unwrap())).collect();
        times.sort();
        times
    };
    let before = times("r1");
    let (code, told, _) = run(folder.path(), paper);
    assert_eq!((code, times("r1")), (0, before));
    assert!(told.contains("no number and no verdict differs"), "{told}");
    assert!(told.contains("report.html") && told.contains(" statements of the paper: "), "{told}");
    assert!(report == tree(&at("one")));

    // What was edited is refused at once by its name; forced, it is told what changed, in one screen.
    let ledger = String::from_utf8(report["ledger.json"].clone()).unwrap();
    let edited = ledger.replace("\"verdict\": \"reproduced\"", "\"verdict\": \"differs\"");
    std::fs::write(at("one/ledger.json"), &edited).unwrap();
    refused(folder.path(), paper, &["ledger.json", "--force"]);
    assert_eq!(std::fs::read_to_string(at("one/ledger.json")).unwrap(), edited);
    let (code, told, note) = run(folder.path(), &format!("{paper} --force"));
    assert_eq!(code, 0, "{note}");
    assert!(note.contains("--force: wrote over ledger.json"), "{note}");
    assert!(
        told.contains(" verdicts differ") && told.contains(": differs -> reproduced"),
        "{told}"
    );
    assert!(told.contains("and ") && told.lines().count() <= 15, "{told}");
    assert!(report == tree(&at("one")));

    // check takes the same saved results.
    let (code, told, note) = run(folder.path(), "check --profile quick --results r1");
    assert_eq!(code, i32::from(told.contains("FAILS")), "{note}");
    assert!(told.contains(" statements of the paper: "), "{told}");
    assert!(saved == files(&at("r1")));

    // What would spoil a report is refused before anything is run: over one of the full profile a lesser one, a figure
    // of it too, and results among its files.
    for within in ["one", "one/data", "one/two/three", "two/../one"] {
        for (out, what) in [("one", "holds a report, or lies in one"), ("new", "or lies in it")] {
            let within = within.replace("one", out);
            let both = format!("paper --profile quick --out {out} --results {within}");
            refused(folder.path(), &both, &["--results", what]);
        }
    }
    let values = String::from_utf8(report["values.json"].clone()).unwrap();
    let full = values.replace("\"text\": \"quick\"", "\"text\": \"full\"");
    assert_ne!(full, values);
    std::fs::write(at("one/values.json"), full).unwrap();
    let before = tree(&at("one"));
    for arguments in ["--profile quick", "--profile ci", "--profile quick --figure 4"] {
        refused(folder.path(), &format!("paper {arguments} --out one"), &["full profile"]);
    }
    assert!(before == tree(&at("one")));
}

#[test]
fn ctrl_c_leaves_nothing_half_written() {
    let folder = tempfile::tempdir().unwrap();
    let paper = "paper --figure 3 --out paper --results r --threads 2 --templates";
    let mut command = program(folder.path(), &format!("{paper} {TEMPLATES}"));
    ended(command.stderr(Stdio::null()), "-TERM", Duration::from_secs(10));
    assert!(!folder.path().join("paper").exists());
    assert_eq!(tree(&folder.path().join("r")).len(), 0);
}

/// Whatever writes, writes over nothing that it did not make itself.
#[test]
fn what_others_made_is_left_as_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    std::fs::create_dir_all(here.join("t/figures")).unwrap();
    std::fs::create_dir(here.join("r")).unwrap();
    let listed = format!("{}  report.md\n", "0".repeat(64));
    for (name, text) in [
        ("README.md", "by hand"),
        ("t/report.md", "by hand"),
        ("t/figures/fig04.svg", "by hand"),
        ("t/SHA256SUMS", listed.as_str()),
        ("r/sweep-quick.json", "{\"by\": \"hand\"}"),
    ] {
        std::fs::write(here.join(name), text).unwrap();
    }
    let before = tree(here);
    for (arguments, says) in [
        ("paper --profile quick --out .", "--out: ."),
        ("paper --figure 4 --out t", "--out: t"),
        ("paper --figure 4 --out t/figures", "fig04.svg"),
        ("paper --profile quick --out t", "did not make"),
    ] {
        refused(here, arguments, &[says]);
    }
    let foreign = "r/sweep-quick.json: it stands where a saved result belongs";
    let (code, _, note) = crate::run(here, "paper --profile quick --figure 3 --out f --results r");
    assert!(code == 2 && note.contains(foreign) && note.lines().count() == 1, "{note}");
    assert!(tree(here) == before, "{:?}", tree(here).keys());
    // Forced, it says what it wrote over, and a folder of its own is written again without.
    let (code, _, note) = run(here, "paper --figure 4 --out t --force");
    assert!(code == 0 && note.contains("wrote over figures/fig04.svg"), "{note}");
    assert_eq!(run(here, "paper --figure 4 --figure 5 --out t").0, 0);
    assert_eq!(std::fs::read_to_string(here.join("t/report.md")).unwrap(), "by hand");
}

/// Who edits the list of a report makes no file of somebody else the program's; what goes with a report is named.
#[test]
fn lists_by_hand_take_no_file_away() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    crate::put(&here.join("p"), &QUICK.report);
    crate::put(&here.join("r"), &QUICK.results);
    crate::put(here, &[("outside".into(), Vec::new())].into());
    crate::put(&here.join("p"), &[(".git/config".into(), Vec::new())].into());
    let list = String::from_utf8(QUICK.report["SHA256SUMS"].clone()).unwrap();
    let paper = "paper --profile quick --out p --results r";
    for path in [".git/config", "../outside", "/outside", "data/../.git/config"] {
        let more = format!("{list}{}  {path}\n", digest(""));
        std::fs::write(here.join("p/SHA256SUMS"), more).unwrap();
        let before = tree(here);
        refused(here, paper, &["--out: p/SHA256SUMS: ", &format!("{path:?}"), "--force"]);
        assert!(tree(here) == before, "{path}");
    }
    let more = format!("{list}{}  old.md\n", digest(""));
    crate::put(
        &here.join("p"),
        &[("SHA256SUMS".into(), more.into()), ("old.md".into(), Vec::new())].into(),
    );
    let (code, _, note) = run(here, paper);
    assert!(code == 0 && note.contains("removed 1 file of the report before: old.md"), "{note}");
    assert!(here.join("p/.git/config").exists() && !here.join("p/old.md").exists());
}

/// A report without readable values is written anew by whom asks for it, as `verify` advises.
#[test]
fn a_report_without_values_is_written_anew_when_forced() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    crate::put(&here.join("r"), &QUICK.results);
    crate::put(&here.join("v"), &QUICK.report);
    let paper = "paper --profile quick --out v --results r";
    let values = here.join("v/values.json");
    std::fs::write(&values, "{}").unwrap();
    refused(here, paper, &["values.json cannot be read; --force writes the report anew"]);
    let (code, _, note) = run(here, &format!("{paper} --force"));
    assert!(code == 0 && note.contains("--force: wrote over values.json"), "{note}");
    assert!(tree(&here.join("v")) == QUICK.report);
    std::fs::remove_file(&values).unwrap();
    refused(here, paper, &["values.json cannot be read; --force writes the report anew"]);
    assert_eq!(run(here, &format!("{paper} --force")).0, 0);
    assert!(tree(&here.join("v")) == QUICK.report);
}

/// Names that a report's files have are no report.
#[test]
fn lists_and_ledgers_of_other_people_make_no_report() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let list = format!("{}  my.iso\n", digest("")).into_bytes();
    let theirs = |name: &str, bytes: &[u8]| [(name.to_string(), bytes.to_vec())].into();
    crate::put(&here.join("sums"), &theirs("SHA256SUMS", &list));
    crate::put(&here.join("made"), &theirs("SHA256SUMS/file", b""));
    crate::put(&here.join("acc"), &theirs("ledger.json", b"{\"accounts\":[]}"));
    // By hand, of files that are no report's.
    let names = ["ledger.json", "notes.md", "values.json"];
    let line = |name: &&str| format!("{}  {name}\n", digest(""));
    let list: String = names.iter().map(line).collect();
    crate::put(&here.join("hand"), &theirs("SHA256SUMS", list.as_bytes()));
    names.iter().for_each(|name| std::fs::write(here.join("hand").join(name), "").unwrap());
    let hand = "paper --profile quick --out hand";
    refused(here, hand, &["values.json cannot be read; --force"]);
    let (code, _, note) = run(here, &format!("{hand} --force"));
    assert!(code == 0 && note.contains("--force: wrote over SHA256SUMS, ledger.json"), "{note}");
    assert!(here.join("hand/notes.md").exists());
    for among in ["sums", "made", "acc"] {
        let (code, _, note) = run(here, &format!("paper --figure 4 --out {among}/sub/figs"));
        assert_eq!(code, 0, "{among}: {note}");
        let what = "has files that this program did not make";
        refused(here, &format!("paper --profile quick --out {among}"), &[what]);
        for verb in [
            "manual --out",
            "run --profile quick --experiment two_masses --shard 1/1 --out",
            "check --profile quick --claim sec3_edges --results",
        ] {
            let (code, _, note) = crate::run(here, &format!("{verb} {among}/of/{}", verb.len()));
            assert_eq!(code, 0, "{verb}: {note}");
        }
    }
}

/// A list of what others wrote is none of ours: it is written over only when forced, and then named.
#[cfg(unix)]
#[test]
fn local_lists_of_other_people_are_theirs() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let list = here.join("w/SHA256SUMS.local");
    std::fs::create_dir(here.join("w")).unwrap();
    let [ours, iso, page] =
        ["report.md", "my.iso", "my.html"].map(|path| format!("{}  {path}\n", digest("")));
    for (text, says) in [
        ("precious\n".into(), "line 1: "),
        (ours + &iso, "line 2: \"my.iso\""),
        (page, "line 1: \"my.html\""),
    ] {
        for verb in ["paper --figure 4 --out w", "manual --out w"] {
            std::fs::write(&list, &text).unwrap();
            std::fs::write(here.join("w/my.iso"), "").unwrap();
            let (code, _, note) = crate::run(here, verb);
            let line = format!("--out: w/SHA256SUMS.local: {says}");
            assert!(code == 2 && note.contains(&line) && note.lines().count() == 1, "{note}");
            assert_eq!(std::fs::read_to_string(&list).unwrap(), text);
            let (code, _, note) = crate::run(here, &format!("{verb} --force"));
            assert!(code == 0 && note.contains("--force: wrote over "), "{note}");
            assert!(note.contains("SHA256SUMS.local"), "{note}");
            // From now on it is ours.
            let (code, _, note) = crate::run(here, verb);
            assert!(code == 0 && note.is_empty(), "{note}");
        }
    }
    std::fs::rename(&list, here.join("kept")).unwrap();
    std::os::unix::fs::symlink("../kept", &list).unwrap();
    let (code, _, note) = crate::run(here, "paper --figure 4 --out w --force");
    assert!(code == 0 && note.contains("SHA256SUMS.local"), "{note}");
    assert!(here.join("kept").exists() && !list.is_symlink());
    // A folder is in the way, whoever asks, and before anything is run.
    std::fs::remove_file(&list).unwrap();
    std::fs::create_dir(&list).unwrap();
    let what = "w/SHA256SUMS.local is a folder where a file belongs; move it away";
    for more in ["--figure 4", "--figure 4 --force", "--profile quick --results r --force"] {
        refused(here, &format!("paper {more} --out w"), &[what]);
    }
    crate::refused(here, "manual --out w --force", &[what]);
    assert!(!here.join("r").exists());
}

/// As `mkdir -p` does.
#[test]
fn a_folder_with_a_dot_behind_is_made() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let unit = "--profile quick --experiment two_masses --shard 1/1";
    for (verb, out, file) in [
        ("paper --figure 4 --out", "a/.", "a/figures/fig04.svg"),
        ("manual --out", "b/c/./", "b/c/impact-paper.1"),
        (&format!("run {unit} --out"), "d/.", "d/two_masses-quick-0000.json"),
        (
            "merge --profile quick --experiment two_masses d --results",
            "e/.",
            "e/two_masses-quick.json",
        ),
    ] {
        let (code, _, note) = crate::run(here, &format!("{verb} {out}"));
        assert!(code == 0 && here.join(file).exists(), "{verb}: {note}");
    }
}

/// What is no module of WebAssembly is none of the pages'.
#[test]
fn a_module_is_looked_at() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    crate::put(&here.join("r"), &QUICK.results);
    std::fs::create_dir(here.join("target")).unwrap();
    let large = [b"\0asm".to_vec(), vec![0; 5 << 20]].concat();
    for (bytes, taken) in [(b"garbage".to_vec(), false), (large, false), (b"\0asm".to_vec(), true)]
    {
        std::fs::write(here.join("target/page.wasm"), bytes).unwrap();
        let (code, _, note) = run(here, "paper --profile quick --out p --results r");
        let said = note.contains("target/page.wasm is not there or no module");
        assert_eq!((code, said, here.join("p/lab.js").exists()), (0, !taken, taken), "{note}");
    }
}

/// What is written among the templates would be read as prose.
#[test]
fn nothing_is_written_among_the_templates() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    templates(&here.join("t"), "front.md", |text| text.into());
    for (verb, among) in [
        ("paper --figure 4 --templates t --out", "t"),
        ("paper --figure 4 --templates t --out", "new/../t/new"),
        ("paper --profile quick --templates t --out new --results", "t"),
        ("check --profile quick --templates t --results", "t/new"),
        ("-q verify --rerun --templates t --results", "t"),
        ("manual --out", TEMPLATES),
        ("run --profile quick --shard 1/1 --out", TEMPLATES),
        ("merge t --results", TEMPLATES),
    ] {
        if verb.contains("verify") {
            crate::put(&here.join("paper"), &QUICK.report);
        }
        let (code, _, note) = crate::run(here, &format!("{verb} {among}"));
        let what = format!("{among} is the folder of the templates, or lies in it");
        assert!(code == 2 && note.contains(&what) && note.lines().count() == 1, "{verb}: {note}");
    }
    std::fs::create_dir(here.join("o")).unwrap();
    templates(&here.join("o/data"), "front.md", |text| text.into());
    let among = "paper --figure 4 --templates o/data --out o --force";
    crate::refused(here, among, &["o has the templates where figures and data go"]);
}

/// What if a parameter were another: nothing is judged, everything says so, and the paper's folder stays as it is.
#[test]
fn another_parameter_makes_another_report_that_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let (code, list, _) = run(here, "paper --set list");
    assert!(code == 0 && list.contains("masses             100"), "{list}");
    // The paper's own value is set to be compared, so with the same samples.
    let (code, told, note) = run(here, "paper --set masses=100 --figure 1");
    assert!(code == 0 && told.starts_with("target/paper-ci: "), "{told}{note}");

    let set = "-q paper --set restitution=0.7 --set masses=50 --profile quick --results r";
    let (code, told, note) = run(here, &format!("{set} --out o"));
    assert_eq!((code, note.as_str()), (0, ""));
    let words = "not the paper's parameters: masses = 50, restitution = 0.7";
    assert!(told.contains(words) && told.contains("nothing is judged"), "{told}");
    let text = |name: &str| std::fs::read_to_string(here.join("o").join(name)).unwrap();
    for name in ["report.md", "beyond.md", "methods.md", "README.md", "ledger.md"] {
        assert!(text(name).contains(words), "{name}");
        assert!(text(name).contains("the words were written for the paper's"), "{name}");
    }
    for name in ["fig03", "fig08", "s06"] {
        assert!(text(&format!("figures/{name}.svg")).contains(words), "{name}");
    }
    let ledger: serde_json::Value = serde_json::from_str(&text("ledger.json")).unwrap();
    let claims = ledger["claims"].as_array().unwrap();
    assert!(claims.iter().all(|claim| claim["verdict"] == "cannot be judged"), "{claims:?}");
    assert!(text("values.json").contains(&format!("quick ({words})")));
    // The rise is another one, and the theory has other vertices.
    let row = |text: &str| text.lines().last().unwrap().to_string();
    let own = std::str::from_utf8(&QUICK.report["data/fig03a.csv"]).unwrap();
    assert_ne!(row(&text("data/fig03a.csv")), row(own));
    // Another choice does not go into this folder, and its results are not taken for those of the paper.
    let (code, _, note) =
        run(here, "paper --set masses=40 --profile quick --figure 3 --results r --out o");
    assert!(code == 2 && note.contains("holds a report of the quick (not the paper"), "{note}");
    let figure = "paper --profile quick --figure 3 --results r --out";
    let (_, _, note) = run(here, &format!("{figure} p"));
    assert!(note.contains("sweep: run"), "{note}");
    // Nor do they take the place of these.
    run(here, &format!("{figure} q --set masses=40"));
    let (_, _, note) = run(here, &format!("{figure} p"));
    assert!(!note.contains("sweep: run"), "{note}");
    // What these parameters cannot have is their fault.
    std::fs::remove_file(here.join("o/values.json")).unwrap();
    let quiet = "-q paper --results r --profile";
    for (more, remedy) in [
        ("quick --set masses=50", "--force writes the report anew"),
        ("quick --figure 3", "restore"),
        ("full --figure 4 --force", "restore"),
    ] {
        refused(here, &format!("{quiet} {more} --out o"), &["values.json", remedy]);
    }
    for more in ["", " --figure s8"] {
        let low = format!("{quiet} quick --out n --set masses=40 --set restitution=0.9{more}");
        refused(here, &low, &["its frame; with these", "nearer to the paper's", "--figure"]);
    }
}

/// Pages and completions go where nothing else is; --quiet hides progress and no error.
#[test]
fn the_manual_is_written_and_quiet_work_says_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    assert_eq!(crate::run(here, "manual --out m").0, 0);
    let page = std::fs::read_to_string(here.join("m/impact-paper-trace.1")).unwrap();
    assert!(page.contains(".TH") && page.contains("certified"), "{page}");
    let bash = std::fs::read_to_string(here.join("m/completions/impact-paper.bash")).unwrap();
    assert!(bash.contains("--max-impacts") && bash.contains("sweep"), "{bash}");
    // Each verb that it finds is one whose options it lists.
    let found =
        bash.lines().filter_map(|line| line.trim().strip_prefix("cmd=\"")?.strip_suffix('"'));
    let found: Vec<&str> = found.filter(|name| !name.is_empty()).collect();
    let listed = |name: &&str| bash.contains(&format!("\n        {name})\n"));
    assert!(found.len() > 15 && found.iter().all(listed), "{bash}");
    for (folder, name) in [("report", "SHA256SUMS"), ("left", "ledger.json")] {
        let file = (name.to_string(), QUICK.report[name].clone());
        crate::put(&here.join(folder), &[file].into());
    }
    std::fs::create_dir(here.join("left/data")).unwrap();
    for folder in ["report", "left", "left/data", "left/new"] {
        for verb in ["manual --out", "run --profile quick --shard 1/1 --out"] {
            crate::refused(here, &format!("{verb} {folder}"), &["holds a report"]);
        }
        refused(here, &format!("-q check --profile quick --results {folder}"), &["holds a report"]);
        refused(here, &format!("-q paper --out o --results {folder}"), &["holds a report"]);
    }
    refused(here, "-q paper --figure 4 --out left/new", &["it lies in a report"]);
    refused(
        here,
        "-q paper --profile quick --out m",
        &["completions/impact-paper.bash", "other files"],
    );
    std::fs::write(here.join("m/impact-paper.1"), "mine").unwrap();
    crate::refused(here, "manual --out m", &["impact-paper.1", "--force"]);

    let sweep = "sweep --sigma 0.1 --masses 4 --realisations 2";
    let (code, quiet, note) = crate::run(here, &format!("-q {sweep}"));
    assert_eq!((code, note.as_str()), (0, ""));
    assert_eq!(quiet, answer(here, sweep));
    let (code, _, note) = run(here, "paper --profile quick --figure 3 --out f --results r --quiet");
    assert_eq!((code, note.as_str()), (0, ""));
    crate::refused(here, "sweep --sigma nan --quiet", &["sigma"]);
}

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
    templates("phrases", "front.md", "# ", "# ");
    std::fs::remove_file(here.join("phrases/literals.toml")).unwrap();
    std::fs::create_dir(here.join("empty")).unwrap();
    let paper = |templates: &str| {
        format!("paper --profile quick --out p --results r --templates {templates}")
    };
    let full = |limited: &str| format!("ulimit -f 1; exec \"$0\" {limited}");
    let few = "ulimit -v 400000; exec \"$0\"";
    let pairs = "(echo '{\"forcing\":[[0,0]'; yes ,[0,0] | head -n 6000000; echo ']}')";
    let many = "\"$0\" bench scenario --masses 200000 >m";
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
        (2, "export RAYON_NUM_THREADS=999; exec \"$0\" check".into(), "RAYON_NUM_THREADS: 999"),
        (2, "export RAYON_RS_NUM_CPUS=999; exec \"$0\" check".into(), "RAYON_RS_NUM_CPUS: 999"),
        (2, paper("none"), "front.md: it is missing or empty"),
        (2, paper("phrases"), "literals.toml: no such file"),
        (2, format!("ulimit -v 250000; exec \"$0\" {}", paper("good")), "MiB of memory are needed"),
        (2, "ulimit -v 75000; exec \"$0\" --version".into(), "the program: about "),
        (
            2,
            format!("ulimit -v 700000; exec \"$0\" {} --threads 4", paper("good")),
            "MiB of memory are needed",
        ),
        (2, format!("{few} diff p p"), "diff: about 408 MiB"),
        (2, format!("{few} explain --paper p"), "explain: about 4"),
        (2, format!("{few} plan --profile full"), "plan: about 408 MiB"),
        (2, format!("{few} run --profile quick --shard 1/1 --out x"), "run: about 536 MiB"),
        (2, format!("{few} merge --profile quick empty"), "merge: about 536 MiB"),
        (
            2,
            "mkdir u; truncate -s 8M u/{1..30}.json; ulimit -v 700000; exec \"$0\" merge --profile quick u".into(),
            "merge: about 1016 MiB",
        ),
        (2, format!("{pairs} >n; ulimit -v 400000; exec \"$0\" trace n --until 0"), "n: "),
        (
            2,
            format!("{many}; ulimit -v 400000; exec \"$0\" trace m --until 0 --sensitivity sigma"),
            "m: about ",
        ),
        (0, "ulimit -s 64; exec \"$0\" sweep --sigma 0.2 --realisations 3".into(), "0.2,"),
        (2, "trace --until 1 $'no\nsuch'".into(), "no such: "),
        (2, "paper --pdf --figure 3".into(), "--figure"),
        (2, "verify nowhere".into(), "nowhere"),
        (3, "status --profile quick --results empty".into(), "stale"),
        (3, "audit --profile quick --results empty".into(), "paper --profile quick"),
        (3, "audit --profile deep --results empty".into(), "merge --profile deep --results empty"),
        // As memory ends that no estimate tells.
        (
            4,
            "\"$0\" bench scenario --masses 9 >s; (exec \"$0\" -q trace s --until 1e9 >e) & \
             until [ -s e ] || ! kill -0 $!; do sleep 0.1; done; kill -ABRT $!; wait $!; c=$?; echo aborted; exit $c"
                .into(),
            "aborted",
        ),
        (4, full("paper --figure 4 --out f --templates good"), "f: "),
        (4, full("run --profile quick --shard 1/1 --experiment two_masses --out g"), "g"),
        (4, "explain --paper p >/dev/full".into(), "standard output"),
        (4, "paper --figure 4 --out h --templates good >/dev/full".into(), "standard output"),
        (4, "--help >/dev/full".into(), "standard output"),
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
    for (code, words) in
        [(0, "fine"), (1, "check"), (2, "usage"), (3, "damaged"), (4, "disk"), (130, "SIGTERM")]
    {
        let says = |line: &str| line.contains(words);
        let row = |line: &&str| line.trim_start().starts_with(&format!("{code} ")) && says(line);
        assert!(help.lines().any(|line| row(&line)), "{help}");
        let row = format!("| {code} | ");
        assert!(design.lines().any(|line| line.starts_with(&row) && says(line)), "{code}");
    }
}

/// What is wrong with a file of the templates, and what is said behind its name: lines at its end (`+`, with ¦ for line ends and ◀▶ for
/// characters of nobody), told with the last line; or words and others in their place.
const FAULTS: &str = r##"front.md +<% include "front.md" %> => :$:12: a file includes itself (front.md -> front.md)
front.md +«v.p | nofilter» => :$:8: Unknown filter
front.md +«nofun(a=1)» => :$:2: Unknown function
front.md +<% include "nix.md" %> => :$:12: Unknown template
front.md +<% set s = "a" %><%- set_global s = s ~ s %> => :$:1: no template may set a variable
front.md +<% endfor %> => :$:4: Unknown tag endfor
front.md +«score.total | significant(digits=-1)» => :$:16: it takes how many digits
front.md +«1 | percent» => :$:2: Invalid type for the value, expected text but got a number
front.md +a ◀score.total▶ => :$:3: the character U+E000 is none of a text
front.md +a &#xE000;score.total&#xE001; => :$:3: the character U+E000 is none of a text
report.tex +%◀ => :$:2: the character U+E000 is none of a text
literals.toml +[[literal]]¦why = "x"¦phrases = ["two nothings"] => :$: "two nothings": no prose has it
references.bib +@article{aa, title={b}} => :$: aa lacks author or year
references.bib +@article{aa, author={X}, title={b}, year={abc}} => :$:43: wrong number of digits
report.html «page.body» ->  => : it has «page.body» 0 times
report.html «page.body» -> «page.body»<div> => : the page is not whole
report.tex \end{document} ->  => : it has \end{document} 0 times
report.css } ->  => : 
report.css } -> } @import "more.css"; => : @import
references.bib volume  = {17} -> volume  = {17}, crossref = {homer2007} => :6: crossref
front.md +It is «sweep.rise.half_height now. => :$:7: « is not closed
front.md # -> ## => :1:1: a report begins with its title
published.toml value = 100 -> value = nan => :11: the id "masses": its value is not finite
published.toml value = 100 -> value = 1000000000000000000000000 => :14: invalid type
published.toml place = "Sec. 2" -> place = "" => :11: the id "masses": its place has no words
published.toml printed = "n =  -> printed = "" # " => :116: the id "sec2_parameters": its printed has
published.toml statement = "For small σ -> statement = "" # " => :122: the id "sec2_few_below": its statement
published.toml = "For small σ -> = "For small $σ => :122: the id "sec2_few_below": its statement has a formula
published.toml "sec2_half_height" -> "sec2_few_below" => :134: the id "sec2_few_below": it stands twice
published.toml "sec2_half_height" -> "sec2_new" => :134: the id "sec2_new": no claim judges it"##;

#[test]
fn faults_of_the_prose_are_told_with_their_place() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    crate::put(&here.join("r"), &QUICK.results);
    let made = |file: &str, fault: &str| {
        let _ = std::fs::remove_dir_all(here.join("t"));
        templates(&here.join("t"), file, |text| match fault.split_once(" -> ") {
            Some((from, to)) => text.replacen(from, to, 1),
            None => {
                let more = fault[1..].replace('¦', "\n");
                let more = more.replace('◀', "\u{e000}").replace('▶', "\u{e001}");
                format!("{}\n\n{more}\n", text.trim_end())
            }
        });
        crate::run(here, "paper --profile quick --out p --results r --templates t")
    };
    for line in FAULTS.lines() {
        let (given, says) = line.split_once(" => ").unwrap();
        let (file, fault) = given.split_once(' ').unwrap();
        let (code, told, note) = made(file, fault);
        let text = std::fs::read_to_string(here.join("t").join(file)).unwrap();
        let says = format!("{file}{}", says.replace('$', &text.lines().count().to_string()));
        let line = note.lines().last().unwrap();
        assert!(code == 2 && line.contains(&says), "{says}: {told}{note}");
        for jargon in ["-->", " | ", "usize", "f64", "[\""] {
            assert!(!line.contains(jargon), "{line}");
        }
    }
    // A bar in a statement ends no cell of a table.
    let (code, told, note) = made("published.toml", "= \"For small σ -> = \"For $|x|$ | small σ");
    assert_eq!(code, 0, "{told}{note}");
}

/// The version names the commit of a checkout, and nothing else depends on it.
#[test]
fn the_version_names_the_commit() {
    let folder = tempfile::tempdir().unwrap();
    let (code, told, _) = crate::run(folder.path(), "--version");
    assert_eq!(code, 0);
    let version = concat!("impact-paper ", env!("CARGO_PKG_VERSION"));
    let rest = told.trim_end().strip_prefix(version).expect("the version");
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    if root.join(".git").exists() {
        let commit = rest.trim().trim_matches(['(', ')']).trim_end_matches('+');
        assert!(commit.len() >= 12, "{told}");
        let mut git = Command::new("git");
        git.current_dir(root).args(["cat-file", "-e", &format!("{commit}^{{commit}}")]);
        assert!(git.status().unwrap().success(), "{told}");
    } else {
        assert_eq!(rest, "");
    }
}
