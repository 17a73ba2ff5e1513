//! Starts runs from a state, and from places and velocities in a file, and ends them.

use crate::{drawn, unforced};
use impact_chain::{Chain, Engine, LATEST, Scenario, Start, State};

#[test]
fn the_state_at_the_start_is_that_of_the_engine() {
    for start in [Start::Rest, Start::Zero, Start::Random] {
        let scenario = drawn(&Chain { masses: 7, start, ..Chain::default() }, 0.1, "state", 0);
        let state = State::from_scenario(&scenario);
        let of_engine = Engine::new(&scenario).unwrap().state(0.0).unwrap();
        let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-14);
        assert!(near(&state.positions, &of_engine.positions), "{start:?}");
        assert!(near(&state.velocities, &of_engine.velocities), "{start:?}");
    }
}

/// From each state, also read as JSON, the next impact and contacts are those of the whole run.
#[test]
fn a_run_goes_on_from_any_state() {
    for (sigma, restitution) in [(0.3, 0.8), (1.0, 0.5)] {
        let chain = Chain { masses: 20, restitution, ..Chain::default() };
        let scenario = drawn(&chain, sigma, "restart", 0);
        let mut engine = Engine::new(&scenario).unwrap();
        let mut contacts = 0;
        for number in 0..1000 {
            let now = engine.next_impact(1e4).unwrap().unwrap().time;
            let state = engine.state(now).unwrap();
            let moved = state.as_scenario(&scenario).unwrap();
            assert_eq!(Scenario::from_json(&moved.to_json()).unwrap(), moved);
            let mut again = Engine::from_state(&scenario, &state).unwrap();
            let [held, kept] = [&engine, &again].map(|engine| engine.contacts(now).unwrap());
            contacts += held.len();
            assert!(held.iter().map(|c| c.0).eq(kept.iter().map(|c| c.0)), "{number}");
            let next = [&mut engine.clone(), &mut again].map(|engine| engine.next_impact(1e4));
            let [expected, impact] = next.map(|next| next.unwrap().unwrap());
            let off = (impact.time - expected.time).abs() * expected.closing_speed.min(1.0);
            assert!(impact.gap == expected.gap && off < 1e-11, "{number}: {impact:?} {expected:?}");
        }
        assert_eq!(contacts > 0, sigma == 1.0);
    }
}

/// What is outside the present flight is refused, not made up.
#[test]
fn a_state_outside_the_present_flight_is_refused() {
    let mut engine = Engine::new(&drawn(&Chain::default(), 0.3, "flight", 0)).unwrap();
    engine.advance(30.0).unwrap();
    assert!(engine.state(30.0).is_ok() && engine.state(engine.time()).is_ok());
    for time in [10.0, 31.0, f64::NAN] {
        let refused = engine.state(time).unwrap_err().to_string();
        assert!(refused.starts_with("time: ") && refused.contains("run the engine"), "{refused}");
        assert!(engine.contacts(time).is_err());
    }
}

/// A ball whose place is below the wall by 50 is pulled by 50 − x; places j d change no bit.
#[test]
fn places_are_constant_loads_and_gaps_of_any_width() {
    let json = r#"{"forcing":[[0,0]],"places":[-50],"walls":[0,1e6],"restitution":0.5,
        "initial":{"at":{"positions":[1],"velocities":[0]}}}"#;
    let mut engine = Engine::new(&Scenario::from_json(json).unwrap()).unwrap();
    // x = −50 + 51 cos t reaches zero at arccos(50/51) with speed √(51² − 50²).
    let hit = engine.next_impact(10.0).unwrap().unwrap();
    assert!(hit.gap == 0 && (hit.time - (50.0f64 / 51.0).acos()).abs() < 1e-14, "{hit:?}");
    assert!((hit.closing_speed - 101.0f64.sqrt()).abs() < 1e-12, "{hit:?}");
    engine.advance(10.0).unwrap();
    let contacts = engine.contacts(10.0).unwrap();
    assert!(contacts.len() == 1 && (contacts[0].1 - 50.0).abs() < 1e-11, "{contacts:?}");
    // Two masses whose places are the same press each other with nothing; a load pulls one away.
    let plain = drawn(&Chain { masses: 9, ..Chain::default() }, 0.4, "places", 0);
    let places = Some((0..11).map(f64::from).collect());
    let placed = Scenario { places, ..plain.clone() };
    assert_eq!(crate::trace(&placed, 50.0), crate::trace(&plain, 50.0));
    assert_eq!(Scenario::from_json(&placed.to_json()).unwrap(), placed);
    assert_eq!(placed.gaps(), 10);
    // All places moved along, walls too: the same impacts to rounding.
    let places = Some((0..11).map(|j| 3.25 + f64::from(j)).collect());
    let moved = Scenario { places, ..plain.clone() };
    for (a, b) in crate::trace(&moved, 20.0).iter().zip(crate::trace(&plain, 20.0)) {
        assert!(a.gap == b.gap && (a.time - b.time).abs() < 1e-9, "{a:?} {b:?}");
    }
    // What a file leaves out is regular: places j d, and walls at 0 and (n + 1) d.
    for (fields, places) in [
        (r#""walls":[-1,10]"#, &[-1.0, 3.0, 6.0, 10.0][..]),
        (r#""places":[2,5]"#, &[0.0, 2.0, 5.0, 9.0]),
        (r#""places":[2,5],"walls":[-1e9,1e9]"#, &[-1e9, 2.0, 5.0, 1e9]),
        (r#""places":[2]"#, &[]),
        (r#""walls":[-1.1e9,9]"#, &[]),
    ] {
        let json = format!(r#"{{"forcing":[[0,0],[0,0]],"spacing":3,{fields}}}"#);
        let read = Scenario::from_json(&json).map(|scenario| scenario.places.unwrap());
        assert_eq!(read.unwrap_or_default(), places, "{fields}");
    }
}

/// The end of a run is a time of the clock, also where no gap can ever close.
#[test]
fn an_end_that_is_no_time_is_refused() {
    let mut engine = Engine::new(&unforced(&[[0.1, 0.0]], 1.0)).unwrap();
    for until in [f64::INFINITY, f64::NAN, 1e15, LATEST.next_up(), f64::NEG_INFINITY] {
        let refused = engine.next_impact(until).unwrap_err().to_string();
        assert!(refused.starts_with("until: "), "{refused}");
    }
    assert!(engine.state(LATEST).is_ok() && engine.state(LATEST.next_up()).is_err());
    assert_eq!(engine.impacts(LATEST), Ok(vec![]));
    let mut engine = Engine::new(&unforced(&[[1.0, 1.5]], 1.0)).unwrap();
    let time = engine.next_impact(9.0).unwrap().unwrap().time;
    assert!(engine.advance(time.next_down()).is_err() && engine.advance(time).is_ok());
}

#[test]
fn an_impact_is_within_a_run_until_its_time() {
    let mut engine = Engine::new(&drawn(&Chain::default(), 0.3, "end", 0)).unwrap();
    for number in 0..200 {
        let before = engine.clone();
        let hit = engine.next_impact(50.0).unwrap().unwrap();
        assert_eq!(before.clone().next_impact(hit.time), Ok(Some(hit)), "{number}");
        assert_eq!(before.clone().next_impact(hit.time.next_down()), Ok(None), "{number}");
    }
}

/// Two gaps that close at the start are simultaneous, and both are counted; one is alone.
#[test]
fn impacts_at_the_start_are_simultaneous_with_impacts_alone() {
    let starts: [(&[[f64; 2]], u64, u64); 4] = [
        (&[[1.0, 1.5]], 1, 0),
        (&[[-1.0, 0.0], [-2.0, -0.5]], 3, 2),
        (&[[-1.0, -0.5], [-2.0, -1.5]], 4, 4),
        (&[[-1.0, -0.5], [1.0, 0.5]], 2, 0),
    ];
    for (parts, impacts, ties) in starts {
        let mut engine = Engine::new(&unforced(parts, 1.0)).unwrap();
        engine.advance(0.0).unwrap();
        let counters = engine.counters();
        assert_eq!((counters.impacts, counters.simultaneous), (impacts, ties), "{parts:?}");
    }
}

/// Mass 2 hits mass 1, whose gap waits without a search 1e-10 before the wall: no past frame.
#[test]
fn a_gap_that_waits_long_is_where_its_masses_are() {
    let (amplitude, phase) = (1.0 - 1e-10, 1.0_f64);
    let parts = [amplitude, 2.0].map(|r| [-r * phase.cos(), -r * phase.sin()]);
    let hits = Engine::new(&unforced(&parts, 1.0)).unwrap().impacts(1.1).unwrap();
    let [first, second] = [hits[0], hits[1]];
    assert_eq!([first.gap, second.gap], [1, 0], "{hits:?}");
    // At 2e-10 it takes the speed of mass 2, v² = 8e-10, and loses 2 · 2e-10 to the spring.
    assert!((second.closing_speed - 2e-5).abs() < 1e-9, "{hits:?}");
    assert!((second.time - first.time - (8.0f64.sqrt() - 2.0) * 1e-5).abs() < 1e-9);
}
