//! Compares counts in windows with a list of impacts.

use crate::{drawn, trace, unforced};
use impact_chain::{Boundary, Chain, Counts, Engine, LATEST, Protocol, Watch};

#[test]
fn windows_by_a_list_of_impacts() {
    let chain = Chain { masses: 20, ..Chain::default() };
    let times = [(20.0, 20.0), (20.0, 50.0), (50.0, 20.0), (100.0, 50.0)];
    let windows = times.map(|(transient, window)| Protocol { transient, window });
    let scenario = drawn(&chain, 0.16, "windows", 2);
    let impacts = trace(&scenario, 150.0);
    let mut watch = Watch::new(&chain, &windows);
    let counts = watch.run(Engine::new(&scenario), 2, 150.0, &|| false).unwrap();
    for (place, (transient, window)) in times.into_iter().enumerate() {
        let within = |time| time > transient && time <= transient + window;
        let gaps: Vec<usize> =
            impacts.iter().filter(|hit| within(hit.time)).map(|hit| hit.gap).collect();
        let distinct = (0..21).filter(|gap| gaps.contains(gap)).count() as u32;
        assert!(distinct > 2, "{distinct}");
        assert_eq!(counts.distinct[place], [Some(distinct)]);
        assert_eq!(counts.impacts[place], [gaps.len() as u64]);
    }
}

/// A speed of 1e7 between walls exceeds the bound on work, and a mass may start beyond a wall.
#[test]
fn runs_that_fail_or_overlap_are_counted() {
    let chain = Chain { masses: 1, ..Chain::default() };
    let start = |part| Engine::new(&unforced(&[part], 1.0));
    let work = start([0.0, 1e7]).and_then(|mut hot| hot.impacts(9.0)).unwrap_err();
    let starts = [start([0.0, 0.5]), start([0.0, 1e7]), Err(work), start([-1.5, 0.0])];
    let mut watch = Watch::new(&chain, &[Protocol { transient: 1.0, window: 2.0 }]);
    let counts = starts.map(|engine| watch.run(engine, 0, 9.0, &|| false).unwrap());
    let known = |one: Counts| [one.failed, one.rejected, one.distinct[0].iter().flatten().count()];
    assert_eq!(counts.map(known), [[0, 0, 1], [1, 0, 0], [1, 0, 0], [0, 1, 0]]);
}

/// A second run counts as a new watch does; another chain, or no time as an end, is refused.
#[test]
fn a_run_is_counted_alone_and_for_its_own_chain() {
    let chain = Chain { masses: 3, ..Chain::default() };
    let engine = |chain: &Chain, index| Engine::new(&drawn(chain, 0.4, "watch", index));
    let [window, other] = [5.0, 6.0].map(|transient| Protocol { transient, window: 20.0 });
    let windows = [window, Protocol { transient: 9.0, window: 1.0 }];
    let mut watch = Watch::new(&chain, &windows);
    let mut counted = |index| watch.run(engine(&chain, index), index, 50.0, &|| false).unwrap();
    let (first, second) = (counted(0), counted(1));
    let alone = Watch::new(&chain, &windows).run(engine(&chain, 1), 1, 50.0, &|| false).unwrap();
    assert!(second == alone && first.impacts != second.impacts, "{second:?}, {alone:?}");
    assert!(watch.gaps_hit(&window).is_some() && watch.gaps_hit(&other).is_none());
    let ring = Chain { boundary: Boundary::Ring, masses: 4, ..chain.clone() };
    for another in [Chain { masses: 2, ..chain.clone() }, ring] {
        let refused = watch.run(engine(&another, 0), 0, 50.0, &|| false).unwrap_err();
        assert!(refused.to_string().starts_with("engine: "), "{refused}");
    }
    assert!(watch.run(engine(&chain, 0), 0, f64::NAN, &|| false).is_err());
    for length in [f64::NAN, f64::INFINITY, LATEST] {
        let late = [Protocol { transient: 1.0, window: length }];
        let ran = Watch::new(&chain, &late).run(engine(&chain, 0), 0, 50.0, &|| false);
        assert!(ran.unwrap_err().to_string().starts_with("windows: "), "{length}");
    }
}
