//! Comparisons of small reports.

use super::super::values::{Digits, Kind, Number, Value};
use super::*;

fn registry(values: Vec<Value>) -> Registry {
    let mut registry = Registry::new();
    registry.extend(values).unwrap();
    registry
}

fn report(values: Vec<Value>, claims: &str, data: &str) -> Files {
    let values = serde_json::to_string(&registry(values)).unwrap();
    let files = [("values.json", values.as_str()), ("ledger.json", claims), ("data/a.csv", data)];
    files.map(|(path, text)| (path.to_string(), text.as_bytes().to_vec())).into()
}

fn of(before: &Files, after: &Files) -> Result<Diff, String> {
    Ok(diff(&Parts::of("old", before.clone())?, &Parts::of("new", after.clone())?))
}

#[test]
fn changes_are_found_and_shown() {
    let before = registry(vec![
        Value::real("a", 0.1, 2),
        Value::integer("b", 3),
        Value::integer("gone", 1),
        Value::integer("same", 1),
        Value::real("unit", 2.0, 2),
    ]);
    let after = registry(vec![
        Value::real("a", 0.1 + 1e-9, 2),
        Value::integer("b", 4),
        Value::integer("new", 1),
        Value::integer("same", 1).note("other words"),
        Value::real("unit", 2.0, 2).unit(r"$\omega$").kind(Kind::Measured),
    ]);
    let text = serde_json::to_string(&before).unwrap();
    assert_eq!(read(&text).unwrap(), before);
    let shown: Vec<String> = changes(&before, &after).iter().map(Change::to_string).collect();
    let unit = "unit: 2.0 -> 2.0 (deterministic -> measured, in ω)";
    assert_eq!(
        shown,
        ["a: 0.1 -> 0.100000001", "b: 3 -> 4", "gone: gone, was 1", "new: new, 1", unit]
    );
    assert_eq!(changes(&after, &after), []);
}

#[test]
fn differences_are_measured_by_both_errors() {
    let change = |before: Value, after: Value| {
        changes(&registry(vec![before]), &registry(vec![after])).remove(0)
    };
    let both = change(Value::ensemble("x", 1.0, 0.3, 9), Value::ensemble("x", 2.0, 0.4, 9));
    assert_eq!((both.difference, both.sigmas), (Some(1.0), Some(2.0)));
    let one = change(Value::real("x", 1.0, 2), Value::ensemble("x", 0.0, 0.5, 9));
    assert_eq!((one.difference, one.sigmas), (Some(-1.0), Some(-2.0)));
    assert_eq!(one.kind, Some(["deterministic".into(), "ensemble of 9".into()]));
    let none = change(Value::integer("x", 1), Value::integer("x", 3));
    assert_eq!((none.difference, none.sigmas), (Some(2.0), None));
    let words = change(Value::integer("x", 1), Value::text("x", "many"));
    assert_eq!((words.difference, words.sigmas), (None, None));
}

#[test]
fn claims_change_by_verdict_and_by_measure() {
    let claim = |id: &str, verdict: &str, tolerance: &str| {
        format!(
            r#"{{"id":"{id}","verdict":"{verdict}","ours":"{verdict}","tolerance":"{tolerance}"}}"#
        )
    };
    let ledger = |claims: &[String]| format!(r#"{{"claims":[{}]}}"#, claims.join(","));
    let before =
        ledger(&[claim("a", "good", "1"), claim("b", "good", "1"), claim("c", "good", "1")]);
    let after = ledger(&[claim("a", "bad", "1"), claim("b", "good", "2"), claim("d", "good", "1")]);
    let (before, after) = (report(vec![], &before, ""), report(vec![], &after, ""));
    let diff = of(&before, &after).unwrap();
    let ids: Vec<&str> = diff.verdicts.iter().map(|change| change.id.as_str()).collect();
    assert_eq!(ids, ["a", "b", "c", "d"]);
    let [a, b, c, d] = diff.verdicts.as_slice() else { panic!() };
    let verdicts = |change: &ClaimChange| (change.before.clone(), change.after.clone());
    assert_eq!(verdicts(a), (Some("good".into()), Some("bad".into())));
    assert_eq!((a.ours.as_ref().unwrap()[1].as_str(), &a.tolerance), ("bad", &None));
    assert_eq!(b.tolerance, Some(["1".into(), "2".into()]));
    assert_eq!((verdicts(c).1, verdicts(d).0), (None, None));
    assert_eq!(diff.differing, ["ledger.json"]);
    assert!(of(&after, &after).unwrap().is_empty());
}

#[test]
fn digits_that_nobody_prints_are_refused() {
    let decimals = |n| Number::Real { value: 1.0, digits: Digits::Decimals(n) };
    let printed = |n| Value::integer("x", 1).with_number(decimals(n));
    for (value, says) in [
        (Value::real("x", 1.0, usize::MAX), "x: 18446744073709551615 significant digits"),
        (Value::real("x", 1.0, 18), "x: 18 significant digits"),
        (Value::real("x", 1.0, 0), "x: 0 significant digits"),
        (Value::ensemble("x", 1.0, -1.0, 9), "x: its error is -1.0"),
        (printed(400), "x: 400 decimals"),
    ] {
        let digits = report(vec![value], r#"{"claims":[]}"#, "");
        let told = of(&digits, &digits).unwrap_err();
        assert!(told.contains(says), "{told}");
    }
    for value in [Value::real("x", 1.0, 17), Value::ensemble("x", 1.0, 0.0, 9), printed(323)] {
        let digits = report(vec![value], r#"{"claims":[]}"#, "");
        assert!(of(&digits, &digits).unwrap().is_empty());
    }
}
