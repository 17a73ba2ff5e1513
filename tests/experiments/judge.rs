//! Runs `scenes/judge.py`, which shares its rules with [`Case::judge`] and no code: both judge the
//! same impacts, and the program that its README shows is run.

use impact_chain::Impact;
use impact_paper::experiments::accuracy::case::{Case, Expected, Outcome, scenes};
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::io::Write;
use std::process::{Command, Stdio};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes");

/// Judges what comes, a line for each case with its impacts.
const JUDGE: &str = "
import json, sys
sys.path.insert(0, sys.argv[1])
import judge
cases = {case['id']: case for scene in judge.load() for case in scene['cases']}
for line in sys.stdin:
    case, impacts = json.loads(line)
    print(judge.judge(cases[case], impacts))
";

/// Standard output of Python.
fn python(arguments: &[&str], input: &str) -> String {
    let mut command = Command::new("python3");
    command.arg("-B").args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = command.spawn().expect("python3 (3.9 or later) is needed for this test");
    let mut stdin = child.stdin.take().unwrap();
    let input = input.to_string();
    let writer = std::thread::spawn(move || stdin.write_all(input.as_bytes()));
    let output = child.wait_with_output().unwrap();
    writer.join().unwrap().unwrap();
    assert!(output.status.success(), "{arguments:?}: {}", output.status);
    String::from_utf8(output.stdout).unwrap()
}

/// Impacts that are as expected, or nearly.
fn expected(case: &Case) -> Vec<Impact> {
    let hit = |time, gap, closing_speed| Impact { time, gap, closing_speed };
    match &case.expected {
        Expected::Impacts { impacts, faster, .. } => {
            impacts.iter().map(|&(time, gap)| hit(time, gap, faster + 0.5)).collect()
        }
        Expected::Speed { impacts, speed, .. } => {
            (0..*impacts).map(|i| hit(1e-3 * i as f64, i % 2, *speed)).collect()
        }
        Expected::Rest { since, slower } => vec![hit(*since, 0, slower * 0.5)],
        Expected::Law => [(0, 0.3), (3, 0.2)].map(|(gap, speed)| hit(1.0, gap, speed)).into(),
    }
}

/// The same with a mistake of each kind, and with what is none.
fn variants(case: &Case) -> Vec<Vec<Impact>> {
    let right = expected(case);
    let changed = |change: &dyn Fn(&mut Impact)| {
        let mut impacts = right.clone();
        impacts.iter_mut().for_each(change);
        impacts
    };
    let more = |at: usize, time| {
        let mut impacts = right.clone();
        impacts.insert(at, Impact { time, gap: 0, closing_speed: 1.0 });
        impacts
    };
    let masses = case.start.positions.len();
    let mut all = vec![
        Vec::new(),
        right.iter().skip(1).copied().collect(),
        right.iter().rev().copied().collect(),
        more(0, case.start.time),
        more(right.len(), case.until),
        more(right.len(), case.until + 1.0),
        changed(&|hit| hit.gap = masses - hit.gap),
        changed(&|hit| hit.gap = (hit.gap + 1) % (masses + 1)),
    ];
    for by in [-1e-1, -1e-3, -1e-5, -1e-10, 1e-10, 1e-5, 1e-3, 1e-1] {
        all.push(changed(&|hit| hit.time += by));
    }
    for factor in [0.0, 0.5, 0.97, 1.03, 2.0, 10.0] {
        all.push(changed(&|hit| hit.closing_speed *= factor));
    }
    all.push(right);
    all
}

#[test]
fn both_judges_agree() {
    let (mut lines, mut found) = (String::new(), Vec::new());
    for case in scenes().into_iter().flat_map(|scene| scene.cases) {
        for impacts in variants(&case) {
            let rows = impacts.iter().map(|hit| json!([hit.time, hit.gap, hit.closing_speed]));
            lines += &format!("{}\n", json!([case.id, rows.collect::<Vec<_>>()]));
            found.push((case.id.clone(), case.judge(&impacts)));
        }
    }
    let judged = python(&["-c", JUDGE, FOLDER], &lines);
    assert_eq!(judged.lines().count(), found.len());
    for (theirs, ((id, ours), line)) in judged.lines().zip(found.iter().zip(lines.lines())) {
        assert_eq!(json!(theirs), serde_json::to_value(ours).unwrap(), "{id}: {line:.500}");
    }
    let kinds: BTreeSet<Outcome> = found.iter().map(|(_, outcome)| *outcome).collect();
    use Outcome::*;
    assert_eq!(Vec::from_iter(kinds), [Right, Missed, Ghost, Late, WrongSpeed, WrongRest]);
}

#[test]
fn programs_are_run_and_judged() {
    let folder = tempfile::tempdir().unwrap();
    let (program, result) = (folder.path().join("program.py"), folder.path().join("result.json"));
    let readme = include_str!("../../scenes/README.md");
    let begin = "```python\n";
    let code = readme.split_once(begin).unwrap().1.split_once("```").unwrap().0;
    let judge = format!("{FOLDER}/judge.py");
    let outcomes = |code: &str| {
        std::fs::write(&program, code).unwrap();
        let [result, program] = [&result, &program].map(|path| path.to_str().unwrap());
        let cases = ["grazing-hits/1e-2", "grazing-hits/1e-8", "mirror/six"];
        let cases = cases.iter().flat_map(|case| ["--case", case]);
        let rest = ["--out", result, "--", "python3", "-B", program];
        let report =
            python(&[&*judge].into_iter().chain(cases).chain(rest).collect::<Vec<_>>(), "");
        assert!(report.contains(" of 3 right"), "{report}");
        let read: Value = serde_json::from_slice(&std::fs::read(result).unwrap()).unwrap();
        let cases = read["cases"].as_array().unwrap().clone();
        cases.iter().map(|case| case["outcome"].as_str().unwrap().to_string()).collect::<Vec<_>>()
    };
    assert_eq!(outcomes(code), ["right", "missed", "right"]);
    assert_eq!(outcomes("print('refused all')\nwhile True: pass"), ["refused"; 3]);
    assert_eq!(outcomes("print('gave_up at once')"), ["gave_up"; 3]);
    assert_eq!(outcomes("print('warned')\nprint(0, 0, 1)"), ["warned"; 3]);
    assert_eq!(outcomes("print(0, 0, 1)\nraise SystemExit('no')"), ["late", "late", "warned"]);
    assert_eq!(outcomes("while True: print(0, 0, 1, flush=True)"), ["late", "late", "ghost"]);
}
