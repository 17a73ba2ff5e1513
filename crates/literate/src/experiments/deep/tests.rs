//! Tests with an experiment of twelve rows.

use super::super::cutting::{Cutting, Row};
use super::super::identity::TOY;
use super::super::store::written;
use super::audit::{drawn, work};
use super::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// What a unit gives: its row and its realisations.
type Given = Vec<usize>;
type Small = Deep<u64, usize, Given>;

const CUTTING: Cutting<u64, Given, usize> = Cutting {
    rows: |&rows| {
        let row = |i| Row { covers: format!("row {i}"), realisations: 2, weight: 50_000 * (i + 1) };
        (0..rows).map(row).collect()
    },
    part: |_, unit, _, _| Ok(unit.realisations.clone().map(|i| 10 * unit.row + i).collect()),
    fits: |_, _, _| true,
    join: |_, rows, _| Ok(rows.into_iter().flatten().flatten().sum()),
};

fn deep(cutting: Cutting<u64, Given, usize>, committed: &str) -> Small {
    let parameters = |profile| if profile == Profile::Deep { 12 } else { 2 };
    let committed = String::from(committed).leak();
    let cut = ("test", cutting);
    Deep {
        text: Some(committed),
        ..Deep::new(("two_masses", ""), TOY, parameters, cut, |_| Vec::new())
    }
}

fn small(committed: &str) -> Small {
    deep(CUTTING, committed)
}

/// The file that a run of the deep profile leaves.
fn committed() -> String {
    let folder = tempfile::tempdir().unwrap();
    let store = Store::open(folder.path()).unwrap();
    let (deep, quiet) = (small(""), Progress::silent());
    let units = deep.at(Profile::Deep).units();
    assert_eq!(units.len(), 14, "two rows are too heavy for one unit");
    let all: Vec<&Unit> = units.iter().collect();
    let given = CUTTING.given(&12, &all, "test", &quiet).unwrap();
    let texts: Vec<String> = given.iter().map(|own| written("test", own).unwrap()).collect();
    deep.at(Profile::Deep).merge(&texts, &store, &quiet).unwrap();
    assert_eq!(deep.at(Profile::Deep).stale(&store), []);
    assert!(deep.at(Profile::Deep).audit(&store, &quiet).unwrap());
    std::fs::read_to_string(folder.path().join("two_masses-deep.json")).unwrap()
}

fn found(deep: &Small, profile: Profile) -> Result<(usize, Option<Audit>), Error> {
    deep.get(profile, &Store::nowhere(), &Progress::silent())
}

#[test]
fn what_is_committed_is_carried_over_and_small_profiles_run_their_own() {
    let deep = small(&committed());
    let (result, audit) = found(&deep, Profile::Full).unwrap();
    assert_eq!(result, 1332, "the sum of 20 i + 1 for i = 0 to 11");
    let Audit { verdict, units, again, identical, distance } = audit.unwrap();
    assert_eq!((verdict, units, distance), (Carriage::Identical, 14, None));
    assert!(again == identical && (2..10).contains(&again), "{again}");
    assert_eq!(found(&deep, Profile::Quick).unwrap(), (22, None));
}

#[test]
fn a_program_that_gives_something_else_is_noticed() {
    /// The row that another program gives otherwise.
    static ROW: AtomicUsize = AtomicUsize::new(0);
    let other = Cutting {
        part: |_, unit, _, _| {
            let off = usize::from(unit.row == ROW.load(Ordering::Relaxed));
            Ok(unit.realisations.clone().map(|i| 10 * unit.row + i + off).collect())
        },
        ..CUTTING
    };
    let mut deep = deep(other, &committed());
    let units = deep.at(Profile::Deep).units();
    let first = drawn(&units, work(Profile::Full))[0];
    ROW.store(units[first].row, Ordering::Relaxed);
    let audit = found(&deep, Profile::Full).unwrap().1.unwrap();
    assert_eq!(audit.verdict, Carriage::Failed);
    assert!(0 < audit.identical && audit.identical < audit.again, "{audit:?}");

    deep.distance = Some(|&sum, parts| {
        assert_eq!(sum, 1332);
        assert!(parts.iter().all(|(unit, given)| given[0] / 10 == unit.row));
        Distance { largest: 1.0, allowed: 2.0 }
    });
    let audit = found(&deep, Profile::Full).unwrap().1.unwrap();
    assert_eq!(audit.verdict, Carriage::WithinError);
    deep.distance = Some(|_, _| Distance { largest: 2.5, allowed: 2.0 });
    let audit = found(&deep, Profile::Full).unwrap().1.unwrap();
    assert_eq!(audit.verdict, Carriage::Failed);
}

#[test]
fn a_failed_audit_is_stale_and_what_cannot_be_read_is_refused() {
    let text = committed();
    let folder = tempfile::tempdir().unwrap();
    let store = Store::open(folder.path()).unwrap();
    let (deep, quiet) = (small(&text), Progress::silent());
    assert_eq!(deep.at(Profile::Full).stale(&store), [Reason::Missing]);
    let audit = deep.get(Profile::Full, &store, &quiet).unwrap().1.unwrap();
    assert_eq!(deep.at(Profile::Full).stale(&store), []);
    assert!(deep.at(Profile::Full).audit(&store, &quiet).unwrap());
    let failed = Audit { verdict: Carriage::Failed, ..audit };
    store.put(deep.at(Profile::Full).identity(), Profile::Full, &failed).unwrap();
    assert_eq!(deep.at(Profile::Full).stale(&store), [Reason::Failed]);
    assert!(!deep.at(Profile::Full).audit(&store, &quiet).unwrap());

    // Another file is another audit.
    let edited = text.replacen("[[", "[[5,", 1);
    assert_eq!(small(&edited).at(Profile::Full).stale(&store), [Reason::Parameters]);
    let lines: Vec<&str> = text.lines().collect();
    let fewer = lines[2].replacen("[0,1],", "", 1);
    assert_ne!(fewer, lines[2]);
    let signed = |body: &str| {
        let digest = sha256(format!("{}\n{body}\n", lines[1]));
        format!("{digest}\n{}\n{body}\n", lines[1])
    };
    assert_eq!(signed(lines[2]), text);
    for broken in [edited, signed(&fewer), text[..text.len() / 2].into(), String::new()] {
        let error = found(&small(&broken), Profile::Full).unwrap_err().to_string();
        assert!(error.starts_with("benches/deep/two_masses-deep.json: "), "{error}");
        assert!(error.ends_with(REMEDY), "{error}");
    }
    let mut other = small(&text);
    other.parameters = |_| 11;
    let error = found(&other, Profile::Full).unwrap_err().to_string();
    assert!(error.contains("other parameters"), "{error}");
}

#[test]
fn units_are_drawn_within_their_bound() {
    let units = small("").at(Profile::Deep).units();
    let weight = |places: &[usize]| places.iter().map(|&place| units[place].weight).sum::<u64>();
    for bound in [150_000, 1_000_000, 3_000_000] {
        let places = drawn(&units, bound);
        assert!(weight(&places) <= bound && places.is_sorted(), "{places:?}");
        let smallest = units.iter().enumerate().filter(|(i, _)| !places.contains(i));
        let smallest = smallest.map(|(_, unit)| unit.weight).min().unwrap();
        assert!(weight(&places) + smallest > bound, "{places:?} leave room");
    }
    assert_eq!(drawn(&units, 10), [0], "the lightest");
    assert_eq!(drawn(&units, u64::MAX).len(), units.len());
}
