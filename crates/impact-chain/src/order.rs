//! Whether rounding decides which of two neighbouring gaps closes first.
//!
//! The order of such impacts changes all that follows, and twins that differ in the last bit may keep it, or fall into
//! the same tie, by chance. Only a symmetry makes a tie that is certain: then both gaps close at the same speed and at the
//! same instant, also in a twin whose amplitudes differ far more, and the same numbers alike.

use super::rounding::width;
use super::topology::Topology;
use super::{Impact, Scenario, Simultaneous};
use std::collections::BTreeMap;

/// Speed in units of d ω below which the order of an impact among its neighbours does little: twins tell what it does.
/// At the end of every chatter the times lie closer than rounding.
const SLOW: f64 = 1e-3;

/// What is longer ago, in units of 1/ω, is no tie: SLOW impacts are off by less.
const RECENT: f64 = 1e-6;

/// Part of a speed by which those of a symmetry may differ.
const ALIKE: f64 = 1e-9;

/// What was last seen of the gaps.
#[derive(Debug)]
pub(super) struct Order {
    topology: Topology,
    restitution: f64,
    joint: bool,
    /// Width of a gap that rounding may add or take.
    width: f64,
    /// d ω.
    speed: f64,
    recent: BTreeMap<usize, Seen>,
    /// 1/ω times [`RECENT`].
    window: f64,
    /// How many were left when what is long ago was last forgotten.
    kept: usize,
}

/// What happened to a gap a moment ago.
#[derive(Debug, Default)]
struct Seen {
    at: f64,
    hit: Option<Hit>,
    /// What impacts beside it have added to the speed at which it closes, since its own.
    pushed: f64,
}

impl Seen {
    fn pushed_at(&self, time: f64, window: f64) -> f64 {
        if time - self.at <= window { self.pushed } else { 0.0 }
    }
}

/// Its last impact.
#[derive(Clone, Copy, Debug)]
struct Hit {
    number: u64,
    time: f64,
    /// Closing speed, but for what impacts beside it added a moment ago.
    own: f64,
    /// Its time in the twin that differs more; no number if that has gone its own way.
    twin: f64,
}

impl Order {
    /// Nothing seen yet.
    pub fn new(scenario: &Scenario) -> Self {
        let omega = scenario.natural_frequency;
        Order {
            topology: Topology::new(scenario.forcing.len(), scenario.boundary),
            restitution: scenario.restitution,
            joint: scenario.simultaneous == Simultaneous::Joint,
            width: width(scenario),
            speed: scenario.spacing * omega,
            recent: BTreeMap::new(),
            window: RECENT / omega,
            kept: 0,
        }
    }

    /// Takes note of an impact, with its number and its time in the twin. Returns number and time of an earlier one that
    /// it might as well have come before.
    pub fn doubt(&mut self, number: u64, impact: &Impact, twin: f64) -> Option<(u64, f64)> {
        let k = impact.gap - self.topology.label(0);
        let (time, speed) = (impact.time, impact.closing_speed);
        self.forget(time);
        let own = speed - self.recent.get(&k).map_or(0.0, |seen| seen.pushed_at(time, self.window));
        let [before, after] = self.topology.adjacent(k);
        let beside = [before, after.filter(|_| after != before)];
        let hits = beside.into_iter().flatten().filter_map(|near| self.recent.get(&near));
        let hits = hits.filter_map(|seen| seen.hit.as_ref());
        let doubtful = hits.filter(|hit| {
            let same = hit.time == time;
            // The joint law takes all speeds before all jumps.
            let own = if self.joint && same { speed } else { own };
            if own.min(hit.own) < SLOW * self.speed {
                return false;
            }
            let apart = (time - hit.time) * speed;
            let near = apart <= self.width * (1.0 + own / hit.own);
            let alike = (own - hit.own).abs() <= ALIKE * speed;
            // At t = 0 the gaps are shut as they are given.
            near && time > 0.0 && !(same && alike && hit.twin == twin)
        });
        let found = doubtful.map(|hit| (hit.number, hit.time)).min_by_key(|(number, _)| *number);
        let inverse: f64 =
            self.topology.sides(k).into_iter().map(|m| self.topology.inverse_mass(m)).sum();
        let push = (1.0 + self.restitution) * speed / inverse;
        for near in beside.into_iter().flatten() {
            let seen = self.recent.entry(near).or_default();
            (seen.pushed, seen.at) = (seen.pushed_at(time, self.window) + push, time);
        }
        let hit = Hit { number, time, own, twin };
        self.recent.insert(k, Seen { at: time, hit: Some(hit), pushed: 0.0 });
        found
    }

    /// Forgets what is long ago.
    fn forget(&mut self, time: f64) {
        if self.recent.len() > 2 * self.kept + 16 {
            self.recent.retain(|_, seen| time - seen.at <= self.window);
            self.kept = self.recent.len();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certify;

    fn certified(text: &str) -> (u64, u64) {
        let scenario: Scenario = Scenario::from_json(text).unwrap();
        let mut all = 0;
        let found = certify(&scenario, 20.0, |_| {
            all += 1;
            true
        });
        (found.unwrap().impacts, all)
    }

    /// Two gaps that close within 2e-16 of one another, by numbers that have no symmetry.
    #[test]
    fn what_only_rounding_sets_apart_is_not_trusted() {
        for (text, right) in [
            (r#"{"restitution":0.5,"forcing":[[2.8,0.8],[1.7,0],[0.5999999999999999,-0.8]]}"#, 0),
            (r#"{"forcing":[[1.1,0.2],[0.2,0.1],[-0.7,0.0]],"boundary":"ring"}"#, 1),
            (
                r#"{"restitution":1,"boundary":"ring","forcing":[[4.0,0.9],[3.3,0.1],[2.5999999999999996,-0.7000000000000001]]}"#,
                0,
            ),
        ] {
            assert_eq!(certified(text).0, right, "{text}");
        }
    }

    /// A mirror image closes two gaps at once, and a row of masses at rest hands an impact on.
    #[test]
    fn what_a_symmetry_sets_at_one_instant_is_trusted() {
        for text in [
            r#"{"forcing":[[2.3,0.9],[0,0],[-2.3,-0.9]]}"#,
            r#"{"forcing":[[2.3,0.9],[0,0],[-2.3,-0.9]],"simultaneous":"joint"}"#,
        ] {
            let (trusted, all) = certified(text);
            assert!(all > 10 && trusted > 2, "{trusted} of {all}: {text}");
        }
    }

    /// A hit that drives a shut gap comes before what it drives, however soon.
    #[test]
    fn what_follows_from_an_impact_comes_after_it() {
        let text = r#"{"restitution":0.8,"forcing":[[1,0],[0,0],[0,0]]}"#;
        let mut order = Order::new(&Scenario::from_json(text).unwrap());
        let impact = |gap, closing_speed| Impact { time: 3.0, gap, closing_speed };
        assert_eq!(order.doubt(0, &impact(1, 1.0), 3.0), None);
        assert_eq!(order.doubt(1, &impact(2, 0.9), 3.0), None);
        // This one closed by itself.
        assert_eq!(order.doubt(2, &impact(3, 1.5), 3.0), None);
        assert_eq!(order.doubt(3, &impact(2, 2.0), 3.0), None);
        let mut order = Order::new(&Scenario::from_json(text).unwrap());
        assert_eq!(order.doubt(0, &impact(1, 1.0), 3.0), None);
        assert_eq!(order.doubt(1, &impact(2, 1.5), 3.0), Some((0, 3.0)));
        // What an impact added long ago is its own by now.
        let mut order = Order::new(&Scenario::from_json(text).unwrap());
        let early = Impact { time: 1.0, gap: 3, closing_speed: 2.0 };
        assert_eq!(order.doubt(0, &early, 1.0), None);
        assert_eq!(order.doubt(1, &impact(1, 1.0), 3.0), None);
        assert_eq!(order.doubt(2, &impact(2, 1.5), 3.0), Some((1, 3.0)));
    }
}
