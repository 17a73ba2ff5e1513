//! Follows a mass that is pressed to a wall: it chatters, with flight times that tend to a
//! geometric series, sticks, and is released where the contact force vanishes.

use impact_chain::{Engine, Error, Event, Scenario};
use std::ops::ControlFlow::Continue;

/// Returns the events from rest at 0.02; the acceleration at the wall is -1 - `force` cos(t/2).
fn chatter(force: f64) -> Result<Vec<Event>, Error> {
    let scenario = Scenario::from_json(&format!(
        r#"{{"forcing": [[-{force}, 0]], "forcing_frequency": 0.5, "restitution": 0.5, "places": [-1],
             "walls": [0, 100], "initial": {{"at": {{"positions": [0.02], "velocities": [0]}}}}}}"#
    ))?;
    let mut events = Vec::new();
    Engine::new(&scenario)?.run(5.0, |event, _| {
        events.push(event.clone());
        Continue(())
    })?;
    Ok(events)
}

fn main() -> Result<(), Error> {
    for event in chatter(2.0)? {
        println!("{event:?}");
    }
    Ok(())
}

/// Without force, impact k has the speed v rᵏ, and the flight after it takes 2 atan(v rᵏ⁺¹).
#[test]
fn flights_are_a_series_and_the_release_is_where_the_force_vanishes() {
    let (mut time, mut speed) = ((1.0_f64 / 1.02).acos(), (1.02_f64 * 1.02 - 1.0).sqrt());
    for event in chatter(0.0).unwrap() {
        let Event::Impact(impact) = event else {
            // The flights that are left take twice as long as the next.
            assert!(matches!(event, Event::Stick { .. }) && speed < 1e-9);
            assert!((event.time() - time).abs() < 4.0 * speed);
            continue;
        };
        assert!((impact.time - time).abs() < 1e-14, "{impact:?}: {time}");
        assert!((impact.closing_speed - speed).abs() < 1e-15, "{impact:?}: {speed}");
        speed *= 0.5;
        time += 2.0 * speed.atan();
    }
    let events = chatter(2.0).unwrap();
    let release = events.iter().find(|event| matches!(event, Event::Release { .. })).unwrap();
    assert!((release.time() - 4.0 * std::f64::consts::FRAC_PI_3).abs() < 1e-14, "{release:?}");
}
