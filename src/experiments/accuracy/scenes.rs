//! Scenes in which methods fail, as data: what each is, and what must come out.
//!
//! The tests of the engine and of its rivals and the table of the report use the same scenes. An
//! expectation comes from a closed form where there is one, else from the motion to 106 bits.

use super::case::{Case, Expected};
use crate::params::{Boundary, Chain, SEED};
use impact_chain::methods::truth::TrueMotion;
use impact_chain::methods::{Certified, Method, State};
use impact_chain::{Error, Initial, Overtone, Scenario};
use impact_numerics::random::NormalPairs;
use std::f64::consts::{PI, SQRT_2};

/// One kind of trouble.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Short name, as in saved results: `grazing-hits`.
    pub id: &'static str,
    /// What happens in it.
    pub what: &'static str,
    /// Its cases.
    pub cases: Vec<Case>,
}

/// How far off a time may be in most scenes, in units of 1/ω: coarse enough for every method at
/// its usual step.
const NEAR: f64 = 1e-2;

/// All scenes. `short` cuts those that take long; `clusters` are the numbers of masses that are
/// pressed together, and without any that scene is left out.
pub fn all(short: bool, clusters: &[u32]) -> Result<Vec<Scene>, Error> {
    let mut scenes = vec![
        grazing("grazing-hits", "a dip reaches just below zero", -1.0),
        grazing("grazing-misses", "a dip ends just above zero", 1.0),
        recontact(if short { 6 } else { 15 }),
        zero_start()?,
        chattering()?,
        ball(),
        valve()?,
        held()?,
        squeezed(clusters)?,
        three_way()?,
        mirror(if short { 10.0 } else { 20.0 }),
        long_wait(if short { &[2, 3] } else { &[2, 3, 4] })?,
        late_start()?,
        elastic(if short { 100 } else { 1000 }),
        quiet(if short { 20.0 } else { 200.0 }),
        bad_input(),
    ];
    scenes.retain(|scene| !scene.cases.is_empty());
    Ok(scenes)
}

/// One mass between walls, with free part (a, b) and forcing (α, β).
fn one(free: [f64; 2], forcing: [f64; 2], big_omega: f64, restitution: f64) -> Scenario {
    Scenario {
        spacing: 1.0,
        natural_frequency: 1.0,
        forcing_frequency: big_omega,
        restitution,
        boundary: Boundary::Walls,
        initial: Initial::Free(vec![free]),
        forcing: vec![forcing],
        overtones: Vec::new(),
    }
}

fn case(name: String, scenario: Scenario, until: f64, expected: Expected) -> Case {
    let start = State::of(&scenario);
    Case { name, scenario, start, until, expected }
}

/// 10^−k.
fn tenth(k: i32) -> f64 {
    (0..k).fold(1.0, |x, _| x / 10.0)
}

/// The gap 1 + a cos t − cos(2t)/4, whose lowest place 3/4 − a is at t = π. It falls to zero where
/// cos t = a − √(a² + 5/2).
fn grazing(id: &'static str, what: &'static str, sign: f64) -> Scene {
    let cases = (2..=14).map(|k| {
        let a = 0.75 - sign * tenth(k);
        let scenario = one([a, 0.0], [0.75, 0.0], 2.0, 0.8);
        let expected = if sign > 0.0 {
            Expected::Nothing
        } else {
            // 1 + cos t = (2a − 3/2)/(1 + a + √(a² + 5/2)), without cancellation.
            let half_angle = ((a - 0.75) / (1.0 + a + (a * a + 2.5).sqrt())).sqrt();
            Expected::First { gap: 0, time: PI - 2.0 * pxfm::f_asin(half_angle), within: NEAR }
        };
        case(format!("depth 1e-{k}"), scenario, 4.5, expected)
    });
    Scene { id, what, cases: cases.collect() }
}

/// A gap that is left with speed v under an acceleration of −5: v sin t + 6 sin²(t/2) − 4 sin² t,
/// which is sin(t/2) times 2v cos h + 6 sin h − 16 sin h cos² h with h = t/2.
fn recontact(decades: i32) -> Scene {
    let cases = (1..=decades).map(|k| {
        let v = tenth(k);
        let scenario = one([-3.0, v], [-6.0, 0.0], 2.0, 0.5);
        let mut h = v / 5.0;
        for _ in 0..8 {
            let (sin, cos) = (pxfm::f_sin(h), pxfm::f_cos(h));
            let value = 2.0 * v * cos + 6.0 * sin - 16.0 * sin * cos * cos;
            let slope = -2.0 * v * sin + 6.0 * cos - 16.0 * cos * (cos * cos - 2.0 * sin * sin);
            h -= value / slope;
        }
        let expected = Expected::First { gap: 0, time: 2.0 * h, within: 0.02 * h };
        case(format!("speed 1e-{k}"), scenario, 2.0 * h + 0.05, expected)
    });
    Scene {
        id: "recontact",
        what: "a gap opens ever more slowly and shuts again",
        cases: cases.collect(),
    }
}

/// The first impact of the true motion.
fn first(scenario: &Scenario, start: &State, until: f64, within: f64) -> Result<Expected, Error> {
    Ok(match TrueMotion::of(scenario, start).next(until)? {
        Some(hit) => Expected::First { gap: hit.gap, time: hit.time.to_f64(), within },
        None => Expected::Nothing,
    })
}

/// A gap that is shut at the start, at speed v, and pulled open.
fn zero_start() -> Result<Scene, Error> {
    let mut cases = Vec::new();
    for v in [0.5, 0.0, -0.5] {
        let scenario = one([-1.0, 0.25 + v], [0.0, 0.375], 2.0, 0.8);
        let expected = if v < 0.0 {
            Expected::First { gap: 0, time: 0.0, within: NEAR }
        } else {
            first(&scenario, &State::of(&scenario), 20.0, NEAR)?
        };
        cases.push(case(format!("rate {v}"), scenario, 20.0, expected));
    }
    Ok(Scene { id: "zero-start", what: "a gap is shut at the start", cases })
}

/// The impacts of some gaps, faster than `faster`, of a run of the engine.
fn sequence(
    scenario: &Scenario,
    start: &State,
    until: f64,
    faster: f64,
    among: Vec<usize>,
) -> Result<Expected, Error> {
    let mut impacts = Vec::new();
    Certified.run(scenario, start, until, &mut |impact| {
        if impact.closing_speed > faster && among.contains(&impact.gap) {
            impacts.push((impact.time, impact.gap));
        }
        true
    })?;
    Ok(Expected::Sequence { impacts, faster, among, within: NEAR })
}

/// Closing speed between impacts of a flight and the last bounces of a chatter.
const BOUNCE: f64 = 0.3;

/// One mass that comes to rest at a wall, is held there, and is released.
fn chattering() -> Result<Scene, Error> {
    let scenario = Scenario { initial: Initial::Rest, ..one([0.0; 2], [5.88, -4.94], SQRT_2, 0.2) };
    let start = State::of(&scenario);
    let expected = sequence(&scenario, &start, 20.0, BOUNCE, vec![0, 1])?;
    let cases = vec![case("one mass".into(), scenario, 20.0, expected)];
    let what = "a mass bounces to rest at a wall, sticks, and is released";
    Ok(Scene { id: "chattering", what, cases })
}

/// The bouncing ball of the FMI reference models: dropped from a metre at 9.81 m/s², with restitution 0.7. A force
/// of so long a period stands for the weight that it changes by less than two thousandths in three seconds.
fn ball() -> Scene {
    let (weight, restitution) = (9.81, 0.7);
    let base = one([0.0; 2], [-weight, 0.0], 0.02, restitution);
    let scenario = Scenario { natural_frequency: 0.01, initial: Initial::Rest, ..base };
    let mut speed = (2.0 * weight).sqrt();
    let mut time = speed / weight;
    let mut impacts = Vec::new();
    while speed > BOUNCE {
        impacts.push((time, 0));
        speed *= restitution;
        time += 2.0 * speed / weight;
    }
    // The bounces accumulate at 2.56 s.
    let expected = Expected::Rest { impacts, faster: BOUNCE, within: NEAR };
    let cases = vec![case("one ball".into(), scenario, 3.0, expected)];
    Scene { id: "ball", what: "the bouncing ball of the FMI reference models", cases }
}

/// A valve between its seat and a stop, both with restitution: a preload that hardly changes holds it on the seat
/// against its spring, and a pulsating pressure lifts it.
fn valve() -> Result<Scene, Error> {
    let preload = Overtone { frequency: 1e-3, amplitudes: vec![[-1.6, 0.0]] };
    let base = one([0.0; 2], [2.6, 0.0], SQRT_2, 0.3);
    let scenario = Scenario { overtones: vec![preload], ..base };
    let start = State { time: 0.0, positions: vec![0.0], velocities: vec![0.0] };
    let mut of = Case {
        name: "one valve".into(),
        scenario,
        start,
        until: 40.0,
        expected: Expected::Nothing,
    };
    of.expected = sequence(&of.scenario, &of.start, of.until, BOUNCE, vec![0, 1])?;
    Ok(Scene {
        id: "valve",
        what: "a valve lifts off its seat, hits its stop, and chatters on its seat",
        cases: vec![of],
    })
}

/// A mass at rest on the left wall, which a force −3 cos √2 t presses against it until √2 t = arccos(1/3), when the
/// spring wins.
fn held() -> Result<Scene, Error> {
    let scenario = one([0.0; 2], [-3.0, 0.0], SQRT_2, 0.8);
    let start = State { time: 0.0, positions: vec![0.0], velocities: vec![0.0] };
    let free = pxfm::f_acos(1.0 / 3.0) / SQRT_2;
    let released = State { time: free, ..start.clone() };
    let then = match first(&scenario, &released, free + 20.0, NEAR)? {
        // What opens the gap at no speed leaves it for good: the next impact is another.
        Expected::First { gap, time, within } if time > free + 0.1 => {
            let (impacts, among) = (vec![(time, gap)], vec![0, 1]);
            Expected::Sequence { impacts, faster: BOUNCE, among, within }
        }
        _ => Expected::Nothing,
    };
    let case = |name: &str, until: f64, expected: Expected| Case {
        name: name.into(),
        scenario: scenario.clone(),
        start: start.clone(),
        until,
        expected,
    };
    let cases =
        vec![case("held", 0.95 * free, Expected::Nothing), case("let go", free + 20.0, then)];
    Ok(Scene { id: "held", what: "a mass rests against a wall and is let go", cases })
}

/// Masses that are pressed together towards the middle, and let go.
fn squeezed(sizes: &[u32]) -> Result<Scene, Error> {
    let mut cases = Vec::new();
    for &n in sizes {
        let push = |j: u32| 3.0 * (f64::from(n - 1) - 2.0 * f64::from(j));
        // Not in mirror symmetry: ties are another scene.
        let forcing = (0..n).map(|j| [push(j) + 0.1 * f64::from(j), 0.3 * f64::from(j)]).collect();
        let base = one([0.0; 2], [0.0; 2], SQRT_2, 0.2);
        let scenario = Scenario { initial: Initial::Rest, forcing, ..base };
        // They meet, stick, and are let go; then the outer two come to the walls.
        let start = State::of(&scenario);
        let expected = sequence(&scenario, &start, 2.4, BOUNCE, vec![0, n as usize])?;
        cases.push(case(format!("{n} masses"), scenario, 2.4, expected));
    }
    Ok(Scene { id: "squeezed", what: "masses are pressed together and stick", cases })
}

/// Three masses: the outer two hit the middle one from both sides at once.
fn three_way() -> Result<Scene, Error> {
    let forcing = vec![[2.0, 1.0], [0.0, 0.0], [-2.0, -1.0]];
    let scenario =
        Scenario { initial: Initial::Rest, forcing, ..one([0.0; 2], [0.0; 2], SQRT_2, 0.8) };
    let expected = match first(&scenario, &State::of(&scenario), 100.0, NEAR)? {
        Expected::First { time, within, .. } => Expected::Together { gaps: [1, 2], time, within },
        other => other,
    };
    let cases = vec![case("three masses".into(), scenario, 100.0, expected)];
    Ok(Scene { id: "three-way", what: "a mass is hit from both sides at once", cases })
}

/// A chain that is its own mirror image: pairs of impacts tie.
fn mirror(until: f64) -> Scene {
    let chain = Chain { masses: 20, ..Chain::default() };
    let mut scenario = Scenario::draw(&chain, 0.3, &mut NormalPairs::new("mirror", SEED, 0));
    for j in 0..10 {
        scenario.forcing[19 - j] = scenario.forcing[j].map(|x| -x);
    }
    let cases = vec![case("20 masses".into(), scenario, until, Expected::Mirror { within: NEAR })];
    Scene { id: "mirror", what: "a chain is its own mirror image", cases }
}

/// A gap whose two amplitudes add up to little more than d.
fn long_wait(decades: &[i32]) -> Result<Scene, Error> {
    let mut cases = Vec::new();
    for &k in decades {
        // R1 = 0.4 and R2 = 0.6 + 10^−k, in random directions.
        let mut normals = NormalPairs::new("wait", 1, (k - 2) as u64);
        let [free, forcing] = [(0.4, 1.0), (0.6 + tenth(k), -1.0)].map(|(length, sign)| {
            let [x, y] = normals.pair();
            let scale = sign * length / (x * x + y * y).sqrt();
            [scale * x, scale * y]
        });
        let scenario = one(free, forcing, SQRT_2, 0.8);
        let expected = first(&scenario, &State::of(&scenario), 1e6, NEAR)?;
        let until = match &expected {
            Expected::First { time, .. } => time + 1.0,
            _ => 1e4,
        };
        cases.push(case(format!("excess 1e-{k}"), scenario, until, expected));
    }
    Ok(Scene { id: "long-wait", what: "a gap closes after a long quasi-periodic wait", cases })
}

/// The same flight from ever later times.
fn late_start() -> Result<Scene, Error> {
    let mut cases = Vec::new();
    for time in [0.0, 1e4, 1e6, 1e8, 1e10, 1e12 - 128.0] {
        let scenario = one([0.0; 2], [0.6, -0.5], SQRT_2, 0.8);
        let start = State { time, positions: vec![1.0], velocities: vec![0.5] };
        let expected = first(&scenario, &start, time + 100.0, 2e-3)?;
        let name = format!("from {time:.3e}");
        cases.push(Case { name, scenario, start, until: time + 20.0, expected });
    }
    Ok(Scene { id: "late-start", what: "the clock starts at up to a million million", cases })
}

/// One unforced mass between walls with r = 1: u = b sin t hits |u| = 1 at the speed √(b² − 1).
fn elastic(impacts: u64) -> Scene {
    let scenario = one([0.0, 1.25], [0.0, 0.0], SQRT_2, 1.0);
    // From wall to wall takes 2 arcsin(1/b).
    let flight = 2.0 * pxfm::f_asin(1.0 / 1.25);
    let expected = Expected::Steady { impacts, speed: 0.75, within: 1e-6 };
    let cases = vec![case("one mass".into(), scenario, flight * (impacts as f64 + 0.6), expected)];
    Scene { id: "elastic", what: "nothing takes energy out or puts it in", cases }
}

/// A chain none of whose gaps can close.
fn quiet(until: f64) -> Scene {
    let chain = Chain { masses: 20, ..Chain::default() };
    let scenario = Scenario::draw(&chain, 0.04, &mut NormalPairs::new("quiet", SEED, 0));
    let cases = vec![case("20 masses".into(), scenario, until, Expected::Nothing)];
    Scene { id: "quiet", what: "no gap can ever close", cases }
}

/// Scenarios outside the model.
fn bad_input() -> Scene {
    let good = one([0.0, 0.5], [0.1, 0.1], SQRT_2, 0.8);
    let start = State::of(&good);
    let of = |name: &str, change: &dyn Fn(&mut Scenario, &mut State)| {
        let (mut scenario, mut start) = (good.clone(), start.clone());
        change(&mut scenario, &mut start);
        Case { name: name.into(), scenario, start, until: 10.0, expected: Expected::Refused }
    };
    let cases = vec![
        of("a forcing that is no number", &|s, _| s.forcing[0][1] = f64::NAN),
        of("an infinite forcing", &|s, _| s.forcing[0][0] = f64::INFINITY),
        of("r below zero", &|s, _| s.restitution = -0.1),
        of("r above one", &|s, _| s.restitution = 1.5),
        of("no mass", &|s, start| {
            s.forcing.clear();
            s.initial = Initial::Rest;
            start.positions.clear();
            start.velocities.clear();
        }),
        of("an overlapping start", &|_, start| start.positions[0] = -0.25),
        of("a position that is no number", &|_, start| start.positions[0] = f64::NAN),
    ];
    Scene { id: "bad-input", what: "the input is outside the model", cases }
}

#[cfg(test)]
mod tests {
    use super::super::case::Verdict;
    use super::*;

    /// The engine is right in every case, and where a closed form gives the time, right to
    /// rounding.
    #[test]
    fn the_engine_is_right_in_every_scene() {
        for scene in all(false, &[3, 5]).unwrap() {
            assert!(!scene.cases.is_empty());
            for case in &scene.cases {
                let outcome = case.judge(&Certified);
                assert_eq!(outcome.verdict, Verdict::Right, "{}, {}", scene.id, case.name);
                let Some(error) = outcome.error else { continue };
                let Expected::First { time, .. } = case.expected else { continue };
                // A grazing time is known to the rounding of the gap over its speed.
                let bound = match scene.id {
                    "grazing-hits" => 2e-8,
                    "recontact" => 1e-13 * time + 1e-24,
                    _ => 1e-12 + 1e-15 * time,
                };
                assert!(error <= bound, "{}, {}: {error:e}", scene.id, case.name);
            }
        }
    }

    /// Scenes are what they say: long waits are long, nothing is asked of nothing.
    #[test]
    fn scenes_hold_what_they_promise() {
        let scenes = all(false, &[3, 5]).unwrap();
        let of = |id: &str| scenes.iter().find(|scene| scene.id == id).unwrap();
        let mut before = 2.0;
        for case in &of("long-wait").cases {
            let Expected::First { time, .. } = case.expected else { panic!("{case:?}") };
            assert!(time > before, "{}: {time}", case.name);
            before = time;
        }
        for id in ["chattering", "squeezed", "valve"] {
            for case in &of(id).cases {
                let Expected::Sequence { impacts, .. } = &case.expected else { panic!("{case:?}") };
                assert!(impacts.len() >= 2, "{id}: {}", impacts.len());
                let scenario = case.start.as_scenario(&case.scenario).unwrap();
                let mut engine = impact_chain::Engine::new(&scenario).unwrap();
                engine.run(case.until, |_| true).unwrap();
                assert!(engine.counters().contact_phases > 0, "{id} never sticks");
            }
        }
        let Expected::Sequence { impacts, .. } = &of("valve").cases[0].expected else { panic!() };
        assert!([0, 1].iter().all(|gap| impacts.iter().any(|(_, own)| own == gap)), "{impacts:?}");
        // The bounces of the ball come near their accumulation point, and stop there.
        let Expected::Rest { impacts, .. } = &of("ball").cases[0].expected else { panic!() };
        assert!(impacts.len() == 8 && impacts[7].0 < 2.56, "{impacts:?}");
        let held: Vec<_> = of("held").cases.iter().map(|case| &case.expected).collect();
        assert!(matches!(held[..], [Expected::Nothing, Expected::Sequence { .. }]), "{held:?}");
        assert!(matches!(of("three-way").cases[0].expected, Expected::Together { .. }));
    }
}
