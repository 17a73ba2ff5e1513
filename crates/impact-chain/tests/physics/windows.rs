//! Compares counts in windows with a list of impacts.

use crate::{drawn, trace};
use impact_chain::{Chain, Engine, Protocol, Watch};

#[test]
fn windows_by_a_list_of_impacts() {
    let chain = Chain { masses: 20, ..Chain::default() };
    let times = [(20.0, 20.0), (20.0, 50.0), (50.0, 20.0), (100.0, 50.0)];
    let windows = times.map(|(transient, window)| Protocol { transient, window });
    let scenario = drawn(&chain, 0.16, "windows", 2);
    let impacts = trace(&scenario, 150.0);
    let mut watch = Watch::new(&chain, &windows);
    let found = watch.run(Engine::new(&scenario), 2, 150.0, &|| false).unwrap();
    for (at, (transient, window)) in times.into_iter().enumerate() {
        let within = |time| time > transient && time <= transient + window;
        let gaps: Vec<usize> =
            impacts.iter().filter(|hit| within(hit.time)).map(|hit| hit.gap).collect();
        let distinct = (0..21).filter(|gap| gaps.contains(gap)).count() as u32;
        assert!(distinct > 2, "{distinct}");
        assert_eq!(found.distinct[at], [Some(distinct)]);
        assert_eq!(found.impacts[at], [gaps.len() as u64]);
    }
}
