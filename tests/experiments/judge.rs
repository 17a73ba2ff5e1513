//! Runs `scenes/judge.py`, which judges as [`Case::judge`] does and shares no code with it.

use impact_chain::Impact;
use impact_paper::experiments::accuracy::case::{Case, Expected, Outcome, scenes};
use serde_json::json;
use std::{collections::BTreeSet, fs, process::Command};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes");

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
        Expected::Law => vec![hit(1.0, 0, 0.3), hit(1.0, 3, 0.2)],
    }
}

/// The same with a mistake of each kind, and with what is none.
fn variants(case: &Case) -> Vec<Vec<Impact>> {
    let (right, last) = (expected(case), case.start.positions.len());
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
    let mut variants = vec![right.clone(), right.iter().skip(1).copied().collect(), Vec::new()];
    variants.push(right.iter().rev().copied().collect());
    variants.push(more(0, case.start.time));
    variants.extend([0.0, 1.0].map(|after| more(right.len(), case.until + after)));
    variants.extend([1, last].map(|by| changed(&|hit| hit.gap = (hit.gap + by) % (last + 1))));
    let times = [-1e-1, -1e-3, -1e-5, -1e-10, 1e-10, 1e-5, 1e-3, 1e-1];
    variants.extend(times.map(|by| changed(&|hit| hit.time += by)));
    let speeds = [0.0, 0.5, 0.97, 1.03, 2.0, 10.0];
    variants.extend(speeds.map(|by| changed(&|hit| hit.closing_speed *= by)));
    variants
}

#[test]
fn both_judges_agree() {
    let (mut lines, mut ours) = (String::new(), Vec::new());
    for case in scenes().into_iter().flat_map(|scene| scene.cases) {
        for impacts in variants(&case) {
            let rows = impacts.iter().map(|hit| json!([hit.time, hit.gap, hit.closing_speed]));
            lines += &format!("{}\n", json!([case.id, rows.collect::<Vec<_>>()]));
            ours.push(case.judge(&impacts));
        }
    }
    let file = tempfile::NamedTempFile::new().unwrap();
    fs::write(&file, &lines).unwrap();
    let run = Command::new("python3")
        .args(["-B", "-c", include_str!("judge_lines.py"), FOLDER])
        .arg(file.path())
        .output();
    let run = run.expect("this test needs python3, 3.9 or later: install it");
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let theirs = String::from_utf8(run.stdout).unwrap();
    assert_eq!(theirs.lines().count(), ours.len());
    for ((line, theirs), ours) in lines.lines().zip(theirs.lines()).zip(&ours) {
        assert_eq!(json!(theirs), json!(ours), "{line:.500}");
    }
    use Outcome::*;
    let kinds = BTreeSet::from_iter(ours);
    assert_eq!(Vec::from_iter(kinds), [Right, Missed, Ghost, Late, WrongSpeed, WrongRest]);
}
