//! Whether rounding decides which of two neighbouring gaps closes first, or whether a gap closes at all.
//!
//! The order of such impacts changes all that follows, and twins that differ in the last bit may keep it, or fall into
//! the same tie, by chance. Only a symmetry makes a tie that is certain: then both gaps close at the same speed and at the
//! same instant, also in a twin whose amplitudes differ far more, and the same numbers alike. An open gap that closes more slowly than
//! the premise of `rounding` allows may graze, and its impact be none.

use super::certify::TOLERANCE;
use super::rounding::{TRANSVERSAL, width};
use super::topology::Topology;
use super::{Impact, Scenario, Simultaneous};
use std::collections::BTreeMap;

/// Speed in units of d ω below which a gap is taken to be driven, and not to close by itself: contact begins below it.
const SLOW: f64 = 1e-9;

/// What is longer ago, in units of 1/[`Scenario::fastest`], is no tie: more than a time that can be trusted may be off by.
const RECENT: f64 = 2.0 * TOLERANCE;

/// Through masses in contact impacts go within this, in the same units.
const THROUGH: f64 = 1e-6;

/// Part of a speed by which those of a symmetry may differ.
const ALIKE: f64 = 1e-9;

/// A gap whose last impact is longer ago than this, in the same units, does not chatter.
const BOUNCE: f64 = 1e-2;

/// What was last seen of the gaps.
#[derive(Debug)]
pub(super) struct Order {
    topology: Topology,
    restitution: f64,
    joint: bool,
    /// Width of a gap that rounding may add or take.
    width: f64,
    /// Speed below which the impact of an open gap may be none: it grazes.
    graze: f64,
    /// d ω.
    speed: f64,
    unit: f64,
    /// Impacts a moment ago, by gap.
    recent: BTreeMap<usize, Vec<Hit>>,
    /// How many gaps were left when what is long ago was last forgotten.
    kept: usize,
    /// When each gap was last hit.
    last: Vec<f64>,
}

/// An impact.
#[derive(Clone, Copy, Debug)]
struct Hit {
    number: u64,
    time: f64,
    /// What its time may be off by.
    off: f64,
    /// What it adds to the speed at which the gaps beside it close.
    push: f64,
    root: Root,
}

/// The impact of a gap that closed by itself: of a gap that was driven, the one that drove it.
#[derive(Clone, Copy, Debug)]
struct Root {
    number: u64,
    time: f64,
    /// Closing speed, but for what impacts beside it added at the same moment.
    own: f64,
    /// Its time in the twin that differs more; no number if that has gone its own way.
    twin: f64,
}

impl Order {
    /// Nothing seen yet.
    pub fn new(scenario: &Scenario) -> Self {
        let omega = scenario.natural_frequency;
        let topology = Topology::new(scenario.forcing.len(), scenario.boundary);
        let force = |j: usize| -> f64 {
            let of = |[a, b]: [f64; 2]| (a * a + b * b).sqrt();
            scenario.components().map(|(_, parts)| of(parts[j])).sum()
        };
        let largest = (0..scenario.forcing.len()).map(force).fold(0.0, f64::max);
        let (width, bend) = (width(scenario), omega * omega * scenario.spacing + 2.0 * largest);
        Order {
            topology,
            restitution: scenario.restitution,
            joint: scenario.simultaneous == Simultaneous::Joint,
            width,
            graze: (TRANSVERSAL * bend * width).sqrt(),
            speed: scenario.spacing * omega,
            unit: 1.0 / scenario.fastest(),
            recent: BTreeMap::new(),
            kept: 0,
            last: vec![f64::NEG_INFINITY; topology.gaps()],
        }
    }

    /// Takes note of an impact, with its number, its time in the twin, and what its own may be off by. Returns number and time of the first from which on
    /// nothing is certain: an earlier one that it might as well have come before, or itself if it may be no impact.
    pub fn doubt(
        &mut self,
        number: u64,
        impact: &Impact,
        twin: f64,
        off: f64,
    ) -> Option<(u64, f64)> {
        let k = impact.gap - self.topology.label(0);
        let (time, speed) = (impact.time, impact.closing_speed);
        let adjacent = self.topology.adjacent(k);
        let beside = [adjacent[0], adjacent[1].filter(|_| adjacent[1] != adjacent[0])];
        self.forget(time);
        for gap in beside.into_iter().flatten().chain([k]) {
            let hits = self.recent.get_mut(&gap);
            hits.into_iter()
                .for_each(|hits| hits.retain(|hit| time - hit.time <= RECENT * self.unit));
        }
        let own_last = self.recent.get(&k).and_then(|hits| hits.last());
        let since = own_last.map_or(0, |hit| hit.number + 1);
        let slow = SLOW * self.speed;
        // Hits beside it since its own, as near as rounding could make them, now or before.
        let near = |hit: &&Hit, own: f64| {
            let apart = (time - hit.time) * speed;
            let width =
                self.width * (1.0 + own / hit.root.own.max(slow)) + own.max(0.0) * (off + hit.off);
            hit.number >= since && apart <= width
        };
        let of = |gap: usize| self.recent.get(&gap).into_iter().flatten();
        let hits: Vec<Hit> = beside.into_iter().flatten().flat_map(of).copied().collect();
        // The joint law takes all speeds of an instant before all jumps: at r = 1 those of a tie look as if handed on.
        let jointly = self.joint && self.restitution >= 1.0 - ALIKE;
        let before = |hit: &&Hit| !jointly || hit.time < time;
        let pushes = hits.iter().filter(|hit| before(hit) && near(hit, speed));
        let pushed: f64 = pushes.clone().map(|hit| hit.push).sum();
        let driven = pushed > 0.0 && speed - pushed <= slow;
        let own = speed - pushed;
        // What only hands on what it was given, or was hit just before, is in no tie.
        let handed = since > 0 || own.abs() <= ALIKE * speed;
        // The joint law hits through masses in contact, and takes all speeds before all jumps.
        let through: Vec<Hit> = match self.joint {
            true => self.nearest(k, time).copied().collect(),
            false => Vec::new(),
        };
        let doubtful = hits.iter().chain(&through).filter(|hit| {
            let same = hit.time == time;
            let own = if self.joint && same && !handed { speed } else { own };
            let root = hit.root;
            let alike = (own - root.own).abs() <= ALIKE * speed;
            let symmetric = same && root.time == time && alike && root.twin == twin;
            own > slow && near(hit, own) && !symmetric
        });
        let found = doubtful.map(|hit| (hit.root.number, hit.root.time));
        let mut found = found.min_by_key(|(number, _)| *number);
        let bounces = time - self.last[k] <= BOUNCE * self.unit;
        if found.is_none() && speed < self.graze && !driven && !bounces {
            found = Some((number, time));
        }
        let inverse: f64 =
            self.topology.sides(k).into_iter().map(|m| self.topology.inverse_mass(m)).sum();
        let push = (1.0 + self.restitution) * speed / inverse;
        let driver = pushes.max_by(|a, b| a.root.own.total_cmp(&b.root.own));
        let root = match driver {
            Some(hit) if driven => hit.root,
            _ => Root { number, time, own, twin },
        };
        self.recent.entry(k).or_default().push(Hit { number, time, off, push, root });
        self.last[k] = time;
        found
    }

    /// The last hits of the nearest gaps on both sides that were hit a moment ago.
    fn nearest(&self, k: usize, time: f64) -> impl Iterator<Item = &Hit> {
        let recent = move |hit: &&Hit| time - hit.time <= THROUGH * self.unit;
        let before = self.recent.range(..k).next_back();
        let after = self.recent.range(k + 1..).next();
        [before, after].into_iter().flatten().filter_map(|(_, hits)| hits.last()).filter(recent)
    }

    /// Forgets what is long ago.
    fn forget(&mut self, time: f64) {
        let window = RECENT * self.unit;
        // `nearest` may find nothing older.
        if self.joint || self.recent.len() > 2 * self.kept + 16 {
            self.recent.retain(|_, hits| {
                hits.retain(|hit| time - hit.time <= window);
                !hits.is_empty()
            });
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
            // Shut and all but shut at the start; across a gap in contact; beside one that was driven a moment before;
            // beside a slow one; a graze.
            (
                r#"{"initial":{"free":[[0.49999999999999994,1],[-0.5,0],[-1.5,-0.5],[0.3,0]]},"forcing":[[0,0],[0,0],[0,0],[0,0]]}"#,
                0,
            ),
            (
                r#"{"forcing_frequency":0.5,"initial":{"free":[[0.363,2.46],[-1.5,0],[1.5,0],[-0.2863296553672913,-2.6]]},"forcing":[[0,0],[1.5,0],[-1.5,0],[0,0]]}"#,
                0,
            ),
            (
                r#"{"simultaneous":"joint","forcing_frequency":0.5,"initial":{"free":[[-0.19,3.48],[-1.5,0],[1.5,0],[-0.34470501744201076,-2.5]]},"forcing":[[0,0],[1.5,0],[-1.5,0],[0,0]]}"#,
                0,
            ),
            (
                r#"{"initial":{"free":[[0.17330966201107018,0.9872199980862026],[0,0],[-0.2394425737062915,-0.9709103839741005],[0.5747522211572456,-2.201665474149599]]},"forcing":[[0,0],[0,0],[0,0],[0,0]]}"#,
                1,
            ),
            (
                r#"{"initial":{"free":[[0.734211334054275,0.6789213245076147],[0,0],[0.3594578625961457,-1.8632459248858404]]},"forcing":[[0,0],[0,0],[0,0]]}"#,
                0,
            ),
            (r#"{"forcing":[[0,0]],"initial":{"free":[[0.9999999999999999,0]]}}"#, 0),
            // At the one speed that the joint law would hand on; and equal cells, of which twins part before the tie ends.
            (
                r#"{"simultaneous":"joint","restitution":1,"forcing":[[2.3,0],[1.408343819019456e-16,0],[-2.3,0],[0.1,0]]}"#,
                0,
            ),
            (
                r#"{"restitution":0.8,"forcing":[[2,0.5],[7.519e-17,0],[-2,-0.5],[0,0],[2,0.5],[7.519e-17,0],[-2,-0.5],[0,0]]}"#,
                0,
            ),
            // Broken by a quick force that hardly moves a mass, by two that nearly cancel, by a frequency.
            (
                r#"{"restitution":1,"forcing_frequencies":[1.5,1000],"forcing":[[[2.3,0.3],[0,0],[-2.3,-0.3]],[[-1e-12,0],[0,0],[-1e-12,0]]]}"#,
                0,
            ),
            (
                r#"{"restitution":1,"simultaneous":"joint","forcing_frequencies":[1.4142135623730951,0.3,0.3000000001],"forcing":[[[2.6,0.2],[0,0],[-2.6,-0.2]],[[0,0],[1e-06,0],[0,0]],[[0,0],[-1e-06,0],[0,0]]]}"#,
                0,
            ),
            (
                r#"{"restitution":0.8,"forcing_frequencies":[0.9,0.9000000000000015],"forcing":[[[2,0.2],[0,0],[0,0]],[[0,0],[0,0],[-2,-0.2]]]}"#,
                0,
            ),
            // Mirror images but for what a sine leaves of zero.
            (r#"{"simultaneous":"joint","forcing":[[3,0],[0,0],[-3,3.6739403974420594e-16]]}"#, 0),
            (
                r#"{"forcing":[[-1.5,1.8369701987210297e-16],[0,0],[1.5,-3.6739403974420594e-16]]}"#,
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
            // Two gaps that take turns, ever more slowly.
            r#"{"restitution":0,"simultaneous":"joint","forcing":[[2.3,0.9],[0.4,0],[-2.1,-0.5],[1,-2]]}"#,
        ] {
            let (trusted, all) = certified(text);
            assert!(all > 10 && trusted > 2, "{trusted} of {all}: {text}");
        }
    }

    /// Two gaps that close within what their times may be off by.
    #[test]
    fn what_earlier_errors_may_turn_round_is_not_trusted() {
        let text = r#"{"restitution":0.8,"forcing":[[1,0],[0,0],[0,0]]}"#;
        let impact = |time, gap, closing_speed| Impact { time, gap, closing_speed };
        for (off, found) in [(0.0, None), (1e-6, Some((0, 3.0)))] {
            let mut order = Order::new(&Scenario::from_json(text).unwrap());
            assert_eq!(order.doubt(0, &impact(3.0, 1, 1.0), 3.0, off), None);
            let next = 3.0 + 4e-7;
            assert_eq!(order.doubt(1, &impact(next, 2, 1.5), next, off), found);
            // What closes by the push of the first alone follows it.
            let mut order = Order::new(&Scenario::from_json(text).unwrap());
            assert_eq!(order.doubt(0, &impact(3.0, 1, 1.0), 3.0, off), None);
            assert_eq!(order.doubt(1, &impact(next, 2, 0.9), next, off), None);
        }
    }

    /// However long a run is, little of it is kept.
    #[test]
    fn what_is_long_ago_is_forgotten() {
        let text = r#"{"restitution":0.8,"forcing":[[1,0],[0,0],[0,0]]}"#;
        let mut order = Order::new(&Scenario::from_json(text).unwrap());
        for number in 0..1000 {
            let (time, gap) = (number as f64, number as usize % 2);
            assert_eq!(
                order.doubt(number, &Impact { time, gap, closing_speed: 1.0 }, time, 0.0),
                None
            );
        }
        assert!(order.recent.values().all(|hits| hits.len() < 3));
    }

    /// A hit that drives a shut gap comes before what it drives, however soon.
    #[test]
    fn what_follows_from_an_impact_comes_after_it() {
        let text = r#"{"restitution":0.8,"forcing":[[1,0],[0,0],[0,0]]}"#;
        let mut order = Order::new(&Scenario::from_json(text).unwrap());
        let impact = |gap, closing_speed| Impact { time: 3.0, gap, closing_speed };
        assert_eq!(order.doubt(0, &impact(1, 1.0), 3.0, 0.0), None);
        assert_eq!(order.doubt(1, &impact(2, 0.9), 3.0, 0.0), None);
        // What is left of this one closes by itself, and might have been first.
        assert_eq!(order.doubt(2, &impact(3, 1.5), 3.0, 0.0), Some((0, 3.0)));
        let mut order = Order::new(&Scenario::from_json(text).unwrap());
        assert_eq!(order.doubt(0, &impact(1, 1.0), 3.0, 0.0), None);
        assert_eq!(order.doubt(1, &impact(2, 1.5), 3.0, 0.0), Some((0, 3.0)));
        // What an impact added long ago is its own by now.
        let mut order = Order::new(&Scenario::from_json(text).unwrap());
        let early = Impact { time: 1.0, gap: 3, closing_speed: 2.0 };
        assert_eq!(order.doubt(0, &early, 1.0, 0.0), None);
        assert_eq!(order.doubt(1, &impact(1, 1.0), 3.0, 0.0), None);
        assert_eq!(order.doubt(2, &impact(2, 1.5), 3.0, 0.0), Some((1, 3.0)));
    }
}
