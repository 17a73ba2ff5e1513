//! Up to which impact a run can be trusted: twins that differ from it in the last bits.
//!
//! Every operation of a run rounds, and where a chain is chaotic the roundings grow until another
//! gap is hit. Twins whose amplitudes differ in the last bits round differently everywhere, so they
//! leave the run, and one another, as fast as the run leaves the truth, but for errors that they
//! share with it. They are therefore held to a [`MARGIN`] of the [`TOLERANCE`] that is promised of
//! the run. Where rounding decides which of two neighbouring gaps closes first, nothing is trusted any more, whatever the
//! twins do. A run without chaos keeps its twins to its end.
//!
//! It is an estimate all the same, and no proof: a touch that neither the run nor a twin finds is not seen. Impacts of gaps that
//! share no mass may have come the other way round within the tolerance, and of a chatter only the end is sure.

use super::growth::Growth;
use super::order::Order;
use super::{Engine, Error, Impact, Initial, Scenario};

/// Twins beside a run.
pub const TWINS: u64 = 8;

/// Difference of the times of one impact, in units of 1/[`Scenario::fastest`], beyond which it is another impact.
pub const TOLERANCE: f64 = 1e-3;

/// Part of the tolerance within which the twins must stay. What they share with the run, such as
/// the error of a sine of almost the same argument, does not set them apart: when impact speeds
/// had a common error of 0.06 ε, twins without a margin trusted a run 15 impacts too long.
const MARGIN: f64 = 0.1;

/// What the twins say of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Certificate {
    /// Impacts that can be trusted, from the first on.
    pub impacts: u64,
    /// Time of the first that cannot, in the run or in a twin; nothing if all can be trusted.
    pub horizon: Option<f64>,
    /// Rate λ at which differences grow as e^λt, per unit of time; nothing if they hardly do.
    pub growth: Option<f64>,
    /// Runs of neighbouring gaps that closed at exactly the same instant.
    pub simultaneous: u64,
}

/// Runs a scenario with its twins beside it, and hands each impact to `sink` as
/// [`Engine::run`] does, trusted or not. Costs ten runs up to the horizon, one beyond it.
///
/// # Errors
/// As [`Engine::new`] and [`Engine::run`].
pub fn certify(
    scenario: &Scenario,
    until: f64,
    mut sink: impl FnMut(Impact) -> bool,
) -> Result<Certificate, Error> {
    let mut engine = Engine::new(scenario)?;
    let mut watch = Watch::new(scenario, until);
    let mut stopped = false;
    engine.run(until, |impact| {
        watch.see(&impact);
        stopped = !sink(impact);
        !stopped
    })?;
    if !stopped {
        watch.end();
    }
    let simultaneous = engine.counters().simultaneous;
    // What comes right behind may tie with the last: a run that needs too much work for it has none.
    let end = if stopped { watch.latest } else { until };
    let _ = engine.run(end + TOLERANCE * watch.unit, |impact| {
        watch.seen += 1;
        watch.doubt(watch.seen - 1, &impact, f64::NAN);
        true
    });
    Ok(watch.certificate(simultaneous))
}

/// The twins of a run, and what was seen of them.
struct Watch {
    twins: Vec<Engine>,
    /// The twin that shows which ties are those of a symmetry, until it goes its own way.
    loose: Option<Engine>,
    /// 1/[`Scenario::fastest`].
    unit: f64,
    until: f64,
    impacts: u64,
    horizon: Option<f64>,
    growth: Growth,
    order: Order,
    /// All impacts of the run so far.
    seen: u64,
    /// The time of the last.
    latest: f64,
    /// What the time of the last that all twins have may be off by.
    off: f64,
}

impl Watch {
    fn new(scenario: &Scenario, until: f64) -> Self {
        let start = |pattern| Engine::new(&twin(scenario, pattern)).map(Engine::in_order);
        let twins: Result<Vec<Engine>, Error> = (1..=TWINS).map(start).collect();
        Watch {
            // A start that the last bits make impossible is nothing to trust.
            horizon: twins.is_err().then_some(0.0),
            twins: twins.unwrap_or_default(),
            loose: Engine::new(&loosened(scenario)).ok().map(Engine::in_order),
            unit: 1.0 / scenario.fastest(),
            until,
            impacts: 0,
            growth: Growth::default(),
            order: Order::new(scenario),
            seen: 0,
            latest: 0.0,
            off: 0.0,
        }
    }

    /// Holds an impact of the run against the next one of each twin.
    fn see(&mut self, own: &Impact) {
        let tolerance = MARGIN * TOLERANCE * self.unit;
        let number = self.seen;
        (self.seen, self.latest) = (number + 1, own.time);
        if let Some(horizon) = self.horizon {
            // What comes right behind may tie with what was trusted.
            if own.time <= horizon + TOLERANCE * self.unit {
                self.doubt(number, own, f64::NAN);
            }
            return;
        }
        // The twins may be a little late.
        let until = self.until + tolerance;
        let mut largest = 0.0f64;
        for twin in &mut self.twins {
            let other = next(twin, until);
            let difference = other.map_or(f64::INFINITY, |other| (own.time - other.time).abs());
            if other.is_none_or(|other| other.gap != own.gap) || difference > tolerance {
                self.part(own.time.min(other.map_or(f64::INFINITY, |other| other.time)));
                self.doubt(number, own, f64::NAN);
                return;
            }
            largest = largest.max(difference);
        }
        let other = self.loose.as_mut().and_then(|twin| next(twin, self.until + self.unit));
        let other = other.filter(|other| other.gap == own.gap);
        if other.is_none() {
            self.loose = None;
        }
        let time = other.map_or(f64::NAN, |other| other.time);
        self.impacts += 1;
        self.off = largest / MARGIN;
        self.doubt(number, own, time);
        if self.horizon.is_none() {
            self.growth.see(own.time / self.unit, largest / self.unit);
        }
    }

    /// Ends trust where rounding decides on the order of an impact.
    fn doubt(&mut self, number: u64, own: &Impact, twin: f64) {
        if let Some((first, time)) = self.order.doubt(number, own, twin, self.off)
            && first < self.impacts
        {
            self.impacts = first;
            self.part(time);
        }
    }

    /// The run has come to its end: so must the twins have.
    fn end(&mut self) {
        let until = self.until - MARGIN * TOLERANCE * self.unit;
        let early = self.twins.iter_mut().filter_map(|twin| next(twin, until));
        let first = early.map(|impact| impact.time).fold(f64::INFINITY, f64::min);
        if first < f64::INFINITY {
            self.part(first);
        }
    }

    /// From this time on, nothing is to be trusted.
    fn part(&mut self, time: f64) {
        self.horizon = Some(time);
        self.twins.clear();
    }

    fn certificate(&self, simultaneous: u64) -> Certificate {
        let growth = self.growth.rate().map(|rate| rate / self.unit);
        Certificate { impacts: self.impacts, horizon: self.horizon, growth, simultaneous }
    }
}

/// The next impact of a twin up to a time. One that needs too much work has none.
fn next(twin: &mut Engine, until: f64) -> Option<Impact> {
    let mut found = None;
    let run = twin.run(until, |impact| {
        found = Some(impact);
        false
    });
    run.ok().and(found)
}

/// The scenario with each amplitude changed in its last bits, by one to three units up or down as `pattern` and the numbers of its mass have it.
///
/// Zeros stay zero, and masses with the same numbers, or those of a mirror image, stay so: an exact symmetry of the scenario
/// is one of its twins. One large number that all masses share, such as a common motion round a ring, is rounded otherwise
/// for each.
fn twin(scenario: &Scenario, pattern: u64) -> Scenario {
    let mut keys = vec![pattern; scenario.forcing.len()];
    for (amplitudes, _) in lists(&mut scenario.clone()) {
        for (key, pair) in keys.iter_mut().zip(amplitudes) {
            *key = pair.iter().fold(*key, |key, x| mixed(*x, key));
        }
    }
    let mut twin = scenario.clone();
    for (i, (amplitudes, _)) in lists(&mut twin).into_iter().enumerate() {
        for (key, pair) in keys.iter().zip(amplitudes) {
            *pair = pair.map(|x| disturbed(x, key.wrapping_add(i as u64)));
        }
    }
    twin
}

/// The amplitudes of a scenario, those of all masses in each list, and what they are measured by: d, or the force that moves
/// a mass by d, at rest or at its frequency.
fn lists(scenario: &mut Scenario) -> Vec<(&mut [[f64; 2]], f64)> {
    let d = scenario.spacing;
    let square = scenario.natural_frequency * scenario.natural_frequency;
    let force = move |big_w: f64| d * square.max((square - big_w * big_w).abs());
    let overtones =
        scenario.overtones.iter_mut().map(|one| (&mut one.amplitudes[..], force(one.frequency)));
    let first = (&mut scenario.forcing[..], force(scenario.forcing_frequency));
    let mut all: Vec<_> = std::iter::once(first).chain(overtones).collect();
    if let Initial::Free(parts) = &mut scenario.initial {
        all.push((parts, d));
    }
    all
}

/// One of the next three numbers away from zero or towards it, as the number and the key have it.
fn disturbed(x: f64, key: u64) -> f64 {
    if x == 0.0 {
        return x;
    }
    let bits = mixed(x, key);
    let units = 1 + (bits >> 1) % 3;
    // The smallest numbers of all have no three below them.
    let towards = bits & 1 == 0 && x.abs() > f64::MIN_POSITIVE;
    f64::from_bits(if towards { x.to_bits() - units } else { x.to_bits() + units })
}

/// The scenario with each amplitude moved away from zero by 5e-11 to 1e-10 of the largest, and all frequencies of the forcing but
/// the first by as much of themselves: far more than rounding, so that no tie but that of a symmetry stays. Numbers of the same
/// modulus in one list move alike, and zeros stay.
fn loosened(scenario: &Scenario) -> Scenario {
    let part = |x: f64, list: usize| {
        let share = (mixed(x, list as u64) >> 11) as f64 / (1u64 << 53) as f64;
        5e-11 * (1.0 + share)
    };
    let mut loose = scenario.clone();
    for (i, (amplitudes, unit)) in lists(&mut loose).into_iter().enumerate() {
        let largest = amplitudes.iter().flatten().fold(unit, |most, x| most.max(x.abs()));
        for x in amplitudes.iter_mut().flatten().filter(|x| **x != 0.0) {
            *x += (part(*x, i) * largest).copysign(*x);
        }
    }
    for (i, overtone) in loose.overtones.iter_mut().enumerate() {
        overtone.frequency *= 1.0 + part(overtone.frequency, i);
    }
    loose
}

/// Bits that the modulus of a number and the pattern decide, by the output function of SplitMix64 (Steele, Lea and Flood, 2014).
fn mixed(x: f64, pattern: u64) -> u64 {
    let mut z = x.abs().to_bits() ^ pattern.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Chain, Start};
    use impact_numerics::random::NormalPairs;

    fn drawn(masses: usize, sigma: f64) -> Scenario {
        let chain = Chain { masses, start: Start::Random, ..Chain::default() };
        Scenario::draw(&chain, sigma, &mut NormalPairs::new("certify", 1, 0))
    }

    /// Eight different patterns, each with every number some units off and the mirror image kept.
    #[test]
    fn twins_differ_in_the_last_bits_of_every_amplitude() {
        let mut scenario = drawn(20, 0.1);
        scenario.forcing[19] = scenario.forcing[0].map(|x| -x);
        if let Initial::Free(parts) = &mut scenario.initial {
            parts[19] = parts[0].map(|x| -x);
        }
        let mut ups = Vec::new();
        for pattern in 1..=TWINS {
            let twin = twin(&scenario, pattern);
            let (Initial::Free(own), Initial::Free(other)) = (&scenario.initial, &twin.initial)
            else {
                panic!("a random start has free parts");
            };
            let pairs = |a: &[[f64; 2]], b: &[[f64; 2]]| -> Vec<(f64, f64)> {
                a.iter().flatten().copied().zip(b.iter().flatten().copied()).collect()
            };
            let mut all = pairs(&scenario.forcing, &twin.forcing);
            all.extend(pairs(own, other));
            assert!(all.iter().all(|(a, b)| (1..=3).contains(&a.to_bits().abs_diff(b.to_bits()))));
            assert_eq!(twin.forcing[19], twin.forcing[0].map(|x| -x));
            let up: Vec<bool> = all.iter().map(|(a, b)| b.abs() > a.abs()).collect();
            let count = up.iter().filter(|up| **up).count();
            assert!((20..60).contains(&count) && !ups.contains(&up), "{count}");
            ups.push(up);
        }
        assert_eq!(disturbed(0.0, 3), 0.0);
    }

    /// What comes to rest in contact hands on a speed that the joint law halves each time.
    #[test]
    fn impacts_that_are_handed_on_are_trusted() {
        let text = r#"{"restitution":0,"simultaneous":"joint","forcing":[[-0.0068920960078792904,-0.4385483034766232],[-0.22483313274426045,0.20882110217118624],[-0.7875142484907521,0.5313035376806886]]}"#;
        let certificate = certify(&Scenario::from_json(text).unwrap(), 40.0, |_| true).unwrap();
        assert_eq!((certificate.impacts, certificate.horizon), (305, None));
    }

    /// The first impact at which each of these leaves the truth, by runs of 100 digits.
    #[test]
    fn no_impact_is_trusted_that_the_truth_does_not_have() {
        let wrong = [
            // A motion that all masses of a ring share: each impact rounds it, in the twins as in the run.
            (
                r#"{"boundary":"ring","restitution":1,"initial":{"free":[[10000,-0.29],[10000,0.05],[10000,-0.06],[10000,-0.1],[10000,0.19]]},"forcing":[[0.03,-0.11],[0.72,-0.2],[-0.51,-0.55],[-0.21,0.26],[0.34,0.46]]}"#,
                283,
            ),
            // Two neighbouring gaps that close in the wrong order once errors have grown.
            (
                r#"{"restitution":1,"forcing":[[-0.8075346398199045,-0.03933325815447501],[0.438065209751723,-0.5433222929268299],[-0.41338148160683996,-0.4241254363945414],[-0.11079641834219639,0.16965212516396988],[0.0976985689637092,-0.03272381409368676]]}"#,
                141,
            ),
            // A forcing three thousand times as fast as a mass.
            (
                r#"{"natural_frequency":0.001,"forcing_frequency":3,"restitution":0.9,"initial":"zero","forcing":[[1.1668933812666773,-19.493323600658666]]}"#,
                51,
            ),
            // One number, of which there are few neighbours.
            (r#"{"restitution":1,"forcing":[[0,0],[0,2.93]],"forcing_frequency":1.3}"#, 261),
            // A slow gap before a quick one, whose order errors turn round.
            (
                r#"{"restitution":0.95,"forcing":[[-0.4269361527327383,-0.007064580511987117],[0.030531056311130615,-0.5876112788490873],[0.21800927756466554,-1.203206634803786],[-0.07203969697989542,-0.5509424913805263],[0.11957846168476531,-1.1729868359677882]]}"#,
                140,
            ),
        ];
        for (text, first) in wrong {
            let scenario = Scenario::from_json(text).unwrap();
            let trusted = certify(&scenario, 130.0, |_| true).unwrap().impacts;
            assert!((20..=first).contains(&trusted), "{trusted}: {text}");
        }
    }

    /// A sink that ends the run early leaves nothing to say of what would have come.
    #[test]
    fn a_run_cut_short_is_certified_as_far_as_it_went() {
        let scenario = Scenario { initial: Initial::Rest, ..drawn(20, 0.3) };
        let mut left = 10;
        let certificate = certify(&scenario, 1e3, |_| {
            left -= 1;
            left > 0
        });
        let certificate = certificate.unwrap();
        assert_eq!((certificate.impacts, certificate.horizon), (10, None));
        // One cut between two that rounding may turn round.
        let tied = r#"{"forcing":[[3,0.3],[1.8000000000000002e-16,0],[-3,-0.3]]}"#;
        let one = certify(&Scenario::from_json(tied).unwrap(), 20.0, |_| false).unwrap();
        assert_eq!(one.impacts, 0);
    }
}
