use super::super::{Progress, Results, Store};
use super::*;
use crate::input::sha256;

const SCRIPT: &str = r#"read given
case $given in *quick*) n=100 ;; *) n=1000 ;; esac
echo '{"throws": {"keys": ["needles"], "columns": ["pi", "pi_error", "by", "seed", "ratio"],'
echo '"digits": {"ratio": 3}, "units": {"pi": "m"}, "meanings": {"ratio": "of areas"}, "rows": '
echo "[[$n, 3.125, 0.04, \"sh\", 7, 0.12345], [2, null, 0.1, null, null, null]]}}"
"#;

fn run(top: &Path, script: &str, command: Command) -> Result<Output, String> {
    std::fs::write(top.join("toy.sh"), script).unwrap();
    command.run(top, &Session::toy(Store::nowhere(), Progress::silent()))
}

fn out(top: &Path, script: &str, command: Command) -> String {
    let output = run(top, script, Command { writes: &["out"], ..command }).unwrap();
    String::from_utf8(output.files["out"].clone()).unwrap()
}

#[test]
fn its_tables_are_those_of_any_experiment() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("toy.sh");
    let session = Session::toy(Store::open(&folder.path().join("saved")), Progress::silent());
    let line = format!("sh {}", path.display()).leak();
    let command: &'static Command = Box::leak(Box::new(Command::new("toy", line)));
    let said = "echo a warning >&2; echo progress 1/2 >&2; echo another >&2\n";
    std::fs::write(&path, [said, SCRIPT].concat()).unwrap();
    let results = Results::run(&[command], &[], &session).unwrap();
    assert_eq!(results.number("toy.throws[needles=100].pi").unwrap(), 3.125);
    let throws = results.table("toy.throws").unwrap();
    for (column, digits, unit, meaning) in [
        ("pi", "3.12(4)", "$m$", ""),
        ("by", "sh", "", ""),
        ("seed", "7", "", ""),
        ("ratio", "0.123", "", "of areas"),
    ] {
        let cell = throws.cell(&format!("toy.throws[needles=100].{column}")).unwrap();
        let described = (cell.to_plain_text(), cell.unit.as_str(), cell.note.as_str());
        assert_eq!(described, (digits.into(), unit, meaning));
        let cell = throws.cell(&format!("toy.throws[needles=2].{column}")).unwrap();
        assert_eq!(cell.to_plain_text(), "–");
    }
    assert!(throws.cell("toy.throws[needles=100].pi_error").is_none());
    // The result depends on the bytes of the script, which need not be text.
    assert_eq!(command.why_stale(&session).unwrap(), None);
    std::fs::write(&path, [SCRIPT.as_bytes(), b"# \xff"].concat()).unwrap();
    assert!(command.why_stale(&session).unwrap().unwrap().contains("toy.sh changed"));
    // What it wrote to standard error is kept, and a script that changes while it runs is named.
    let said = || Command::said("toy", session.profile, &session.store).unwrap();
    assert_eq!(said(), "a warning\nanother\n");
    std::fs::write(&path, ["echo '# and more' >> $0\n", SCRIPT].concat()).unwrap();
    let error = Results::run(&[command], &[], &session).err().unwrap().to_string();
    assert!(error.contains("/toy.sh changed since this run began; run it again"), "{error}");
    assert_eq!(said(), "a warning\nanother\n");
}

#[test]
fn its_numbers_have_all_the_digits_that_were_printed() {
    let numbers = [
        ("0.50", "0.50"),
        ("5.0", "5.0"),
        ("0.000", "0.000"),
        ("-7", "-7"),
        ("1.50E-7", "1.50e-7"),
        ("3.14159265358979323846", "3.14159265358979323846"),
        ("123456789012345678901", "123456789012345678901"),
        (
            "-98765432109876543210987654321098765432109876543210.125",
            "-9.8765432109876543210987654321098765432109876543210125e49",
        ),
    ];
    let folder = tempfile::tempdir().unwrap();
    let rows = numbers.map(|(printed, _)| format!("[{printed}, {printed}]")).join(", ");
    let keys = r#""keys": ["n"], "columns": ["v"]"#;
    let script = format!("echo '{{\"t\": {{{keys}, \"rows\": [{rows}]}}}}'");
    let output = run(folder.path(), &script, Command::new("toy", "sh toy.sh")).unwrap();
    // Also once they were saved.
    let saved: Output = serde_json::from_str(&serde_json::to_string(&output).unwrap()).unwrap();
    assert_eq!(output.tables, saved.tables);
    let table = saved.tables["t"].table("toy", "t", "");
    let digits = table.cells().skip(1).step_by(2).map(|cell| cell.to_plain_text());
    assert!(digits.eq(numbers.map(|(_, digits)| digits)), "{table:?}");
    for row in ["n=0.5", "n=5", "n=123456789012345678901"] {
        assert!(table.cell(&format!("toy.t[{row}].v")).is_some(), "{row}");
    }
}

#[test]
fn it_sees_the_files_that_it_names_and_no_others() {
    let folder = tempfile::tempdir().unwrap();
    let top = folder.path();
    std::fs::create_dir_all(top.join("data/deep")).unwrap();
    for file in ["data/deep/a.bin", "b.csv", "c.csv", "hidden.csv"] {
        std::fs::write(top.join(file), [0xff, 0]).unwrap();
    }
    let command = Command::new("toy", "sh toy.sh data/ --table=./b.csv 0.5 -x n=3");
    let command = Command { reads: &["c.csv"], ..command };
    let script = "touch out; find . -type f | sort | tr -d '\\n' > out; rm data/deep/a.bin";
    let files = out(top, script, command);
    assert_eq!(files, "./b.csv./c.csv./data/deep/a.bin./out./toy.sh");
    let before = command.hashes(top).unwrap();
    assert_eq!(before.len(), 5, "{before:?}");
    std::fs::write(top.join("data/deep/a.bin"), [0xfe, 0]).unwrap();
    assert_ne!(command.hashes(top).unwrap(), before);
    // A link to nothing, and one to itself.
    for to in ["nowhere", "link"] {
        std::os::unix::fs::symlink(to, top.join("data/link")).unwrap();
        let error = command.hashes(top).unwrap_err();
        assert!(error.starts_with("data/link: "), "{error}");
        std::fs::remove_file(top.join("data/link")).unwrap();
    }
}

#[test]
fn its_words_may_have_quotes_and_its_environment_is_small() {
    let folder = tempfile::tempdir().unwrap();
    let top = folder.path();
    std::fs::write(top.join("my data"), "").unwrap();
    let env = &["CARGO_PKG_NAME", "NO_SUCH_NAME"];
    let line = r#"sh toy.sh "my data" 'a  b' c\ d"#;
    let command = Command { env, ..Command::new("toy", line) };
    let script = "printf '%s|' \"$@\" > out; ls >> out; env | cut -d = -f 1 >> out";
    let written = out(top, script, command);
    assert!(written.starts_with("my data|a  b|c d|my data\nout\ntoy.sh\n"), "{written}");
    assert!(written.contains("\nPATH\n") && written.contains("\nCARGO_PKG_NAME\n"), "{written}");
    assert!(!written.contains("CARGO_MANIFEST_DIR"), "{written}");
    let hashes = command.hashes(top).unwrap();
    assert_eq!(hashes["CARGO_PKG_NAME in the environment"], sha256(env!("CARGO_PKG_NAME")));
    assert_eq!(hashes["NO_SUCH_NAME in the environment"], "");
    let error = run(top, "", Command::new("toy", "sh 'my toy.sh")).unwrap_err();
    assert_eq!(error, "missing closing quote; close it");
    let error = folder_in(&top.join("absent")).unwrap_err();
    assert!(error.starts_with(&format!("TMPDIR is {}/absent: No such", top.display())), "{error}");
}

#[test]
fn its_program_and_the_versions_of_what_it_uses_count() {
    let folder = tempfile::tempdir().unwrap();
    let (top, log) = (folder.path(), folder.path().join("log"));
    let line = format!("sh -c 'echo run >> {}; echo 1.2'", log.display()).leak();
    let command = Command { versions: vec![&*line].leak(), ..Command::new("toy", "sh -c true") };
    let hashes = command.hashes(top).unwrap();
    assert_eq!(hashes[&format!("the output of `{line}`")], sha256("1.2\n"));
    assert_eq!(hashes["sh in PATH"], sha256(std::fs::read(in_path("sh").unwrap()).unwrap()));
    assert_eq!((hashes.len(), command.hashes(top).unwrap()), (2, hashes));
    assert_eq!(std::fs::read_to_string(log).unwrap(), "run\n", "it runs once");
    let command = Command { versions: &["sh -c 'echo no numpy >&2; exit 3'"], ..command };
    let error = command.hashes(top).unwrap_err();
    assert!(error.contains("`versions` lists: ended with exit status: 3; it said:\nno numpy"));
}

#[test]
fn a_file_that_is_missing_is_refused_before_it_runs() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.py"), "").unwrap();
    for (line, fault) in [
        ("python3 a.py table.npz", "table.npz: No such file"),
        ("python3 a.py --in=data/x", "data/x: No such file"),
        ("./prog a.py", "prog: No such file"),
        ("python3 a.py ../b.csv", "../b.csv lies outside"),
        ("true", "x: No such file"),
    ] {
        let command = Command { reads: &["x"], ..Command::new("toy", line) };
        let error = command.inputs(folder.path()).unwrap_err();
        assert!(error.starts_with(fault), "{line}: {error}");
    }
}

#[test]
fn what_goes_wrong_is_shown() {
    let folder = tempfile::tempdir().unwrap();
    let table = |fields: &str| format!("echo '{{\"a\": {{\"columns\": [\"b\"], {fields}}}}}'");
    let fields = "\"columns\": [], \"rows\": []";
    for (script, message) in [
        ("echo a >&2; echo b >&2; exit 3", "exit status: 3; it said:\na\nb"),
        ("echo Hello; echo '{}]'", "it printed:\nHello\n{}]"),
        (&table("\"rows\": [[1, 2]]"), "a: row 1 has 2 of 1 cells; null is none;"),
        (&table("\"rows\": [[], [1]]"), "a: row 1 has 0 of 1 cells; null is none;"),
        (&table("\"rows\": [[1e400]]"), "read: 1e400 is beyond double precision (print it in"),
        (&table("\"rows\": [[[]]]"), "row 1 has more than a number"),
        (&table("\"rows\": [[1], [2]]"), "printed a: two rows have the keys []; add a key"),
        (&table("\"rows\": [], \"units\": {\"B\": \"m\"}"), "units: there is no column B;"),
        (
            &format!("echo '{{\"a\": {{{fields}}}, \"a\": {{{fields}}}}}'"),
            "read: two tables have the name a (rename",
        ),
        ("", "did not write a.png"),
    ] {
        let command = Command { writes: &["a.png"], ..Command::new("toy", "sh toy.sh") };
        let error = run(folder.path(), script, command).unwrap_err();
        assert!(error.contains(message), "{error}");
    }
    let error = run(folder.path(), "", Command::new("toy", "no-such-program")).unwrap_err();
    assert!(error.contains("PATH has no no-such-program; install it"), "{error}");
}
