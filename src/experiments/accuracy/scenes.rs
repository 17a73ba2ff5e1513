//! Scenes in each of which some method fails. The expected outcome is a closed form where there is
//! one, else it comes from the motion to 106 bits.

use super::case::{Case, Expected, NEAR, STEADY};
use crate::experiments::prelude::*;
use impact_chain::methods::truth::TrueMotion;
use impact_chain::methods::{Certified, Method};
use impact_chain::{Error, Initial, Overtone};
use std::f64::consts::{PI, SQRT_2};

/// Cases of one kind of difficulty.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Short name: `grazing-hits`.
    pub id: &'static str,
    /// What happens in it.
    pub what: &'static str,
    pub cases: Vec<Case>,
}

/// All scenes. `short` cuts those that take long.
pub fn all(short: bool) -> Result<Vec<Scene>, Error> {
    let scene = |id, what, cases| Scene { id, what, cases };
    Ok(vec![
        scene("grazing-hits", "a dip reaches just below zero", grazing(-1.0)),
        scene("grazing-misses", "a dip ends just above zero", grazing(1.0)),
        scene("square-root", "a graze as fast as the root of its depth says", square_root()),
        scene(
            "recontact",
            "a gap opens ever more slowly and shuts again",
            recontact(if short { 6 } else { 15 }),
        ),
        scene("ball", "the bouncing ball of the FMI reference models", ball()),
        scene("table", "a ball on a vibrating table, which leaves it and lands", table()?),
        scene("held", "a mass rests against a wall and is let go", held()?),
        scene(
            "squeezed",
            "masses are pressed together and stick",
            squeezed(if short { &[3] } else { &[3, 5] })?,
        ),
        scene("cradle", "Newton's cradle: the last ball takes the speed of the first", cradle()),
        scene(
            "elastic",
            "nothing takes energy out or puts it in",
            elastic(if short { 100 } else { 300 }),
        ),
    ])
}

/// Masses between walls under a forcing at frequency Ω, from rest.
fn row(forcing: Vec<[f64; 2]>, forcing_frequency: f64, restitution: f64) -> Scenario {
    let chain = Chain { masses: forcing.len(), forcing_frequency, restitution, ..Chain::default() };
    Scenario::given(&chain, forcing).expect("a pair for each mass")
}

/// The same on springs so weak that they hardly matter, where a force of so long a period that it
/// hardly changes stands for gravity.
fn loose(forcing: Vec<[f64; 2]>, restitution: f64) -> Scenario {
    Scenario { natural_frequency: 0.01, ..row(forcing, 0.02, restitution) }
}

/// One mass between walls, with free part (a, b) and forcing (α, β).
fn one(free: [f64; 2], forcing: [f64; 2], big_omega: f64, restitution: f64) -> Scenario {
    Scenario { initial: Initial::Free(vec![free]), ..row(vec![forcing], big_omega, restitution) }
}

fn case(scenario: Scenario, until: f64, expected: Expected) -> Case {
    Case { start: State::of(&scenario), scenario, until, expected }
}

/// 10^−k.
fn tenth(k: i32) -> f64 {
    (0..k).fold(1.0, |x, _| x / 10.0)
}

/// The gap 1 + a cos t − cos(2t)/4, whose lowest place 3/4 − a = ±10^−k is at t = π. It
/// falls to zero where cos t = a − √(a² + 5/2). Returns the chain, the time of that zero and
/// the closing speed there, which have a meaning where the place is below zero.
fn dip(k: i32, sign: f64) -> (Scenario, f64, f64) {
    let a = 0.75 - sign * tenth(k);
    let scenario = one([a, 0.0], [0.75, 0.0], 2.0, 0.8);
    // 1 + cos t = (2a − 3/2)/(1 + a + √(a² + 5/2)), without cancellation.
    let root = (a * a + 2.5).sqrt();
    let sine = ((a - 0.75) / (1.0 + a + root)).sqrt();
    (scenario, PI - 2.0 * pxfm::f_asin(sine), 2.0 * sine * (1.0 - sine * sine).sqrt() * root)
}

fn grazing(sign: f64) -> Vec<Case> {
    let cases = (2..=14).map(|k| {
        let (scenario, time, _) = dip(k, sign);
        let hit = || Expected::first(0, time, NEAR);
        case(scenario, 4.5, if sign > 0.0 { Expected::nothing() } else { hit() })
    });
    cases.collect()
}

/// The same dips: their closing speed is proportional to the square root of the depth.
fn square_root() -> Vec<Case> {
    let cases = (2..=14).map(|k| {
        let (scenario, _, speed) = dip(k, -1.0);
        case(scenario, 4.5, Expected::Speed { impacts: 1, speed, within: 0.04 })
    });
    cases.collect()
}

/// A gap that is left with speed v under an acceleration of −5: v sin t + 6 sin²(t/2) − 4
/// sin² t, which is sin(t/2) times 2v cos h + 6 sin h − 16 sin h cos² h with h = t/2.
fn recontact(decades: i32) -> Vec<Case> {
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
        case(scenario, 2.0 * h + 0.05, Expected::first(0, 2.0 * h, 0.02 * h))
    });
    cases.collect()
}

/// Closing speed between impacts of a flight and the last bounces of a chatter.
const BOUNCE: f64 = 0.3;

/// The impacts of some gaps, without the last bounces, that the engine has.
fn flights(scenario: Scenario, start: State, until: f64, among: Vec<usize>) -> Result<Case, Error> {
    let mut impacts = Certified.impacts((&scenario, &start, until))?;
    impacts.retain(|impact| impact.closing_speed > BOUNCE && among.contains(&impact.gap));
    let impacts = impacts.iter().map(|impact| (impact.time, impact.gap)).collect();
    let expected = Expected::Impacts { impacts, faster: BOUNCE, among, all: false, within: NEAR };
    Ok(Case { scenario, start, until, expected })
}

/// The bouncing ball of the FMI reference models: dropped from a metre at 9.81 m/s², with
/// restitution 0.7. A force of so long a period stands for the weight that it changes by less than
/// two thousandths in three seconds.
fn ball() -> Vec<Case> {
    let (weight, restitution) = (9.81, 0.7);
    let scenario = loose(vec![[-weight, 0.0]], restitution);
    let mut speed = (2.0 * weight).sqrt();
    let mut time = speed / weight;
    let mut impacts = Vec::new();
    while speed > BOUNCE {
        impacts.push((time, 0));
        speed *= restitution;
        time += 2.0 * speed / weight;
    }
    // The bounces accumulate at 2.56 s.
    let (faster, among, within) = (BOUNCE, Vec::new(), NEAR);
    vec![case(scenario, 3.0, Expected::Impacts { impacts, faster, among, all: true, within })]
}

/// A ball on a table that vibrates with twice the acceleration of gravity, in the frame of the
/// table: in each period it is thrown up, lands, and bounces to rest. Gravity becomes weaker by a
/// tenth meanwhile.
fn table() -> Result<Vec<Case>, Error> {
    let vibration = Overtone { frequency: 1.0, amplitudes: vec![[0.0, 2.0]] };
    let base = loose(vec![[-1.0, 0.0]], 0.3);
    let scenario = Scenario { overtones: vec![vibration], spacing: 10.0, ..base };
    Ok(vec![flights(scenario, on_the_wall(), 20.0, vec![0])?])
}

/// Four balls in a row between walls, of which the first runs into the others, which touch.
fn cradle() -> Vec<Case> {
    let scenario = loose(vec![[0.0; 2]; 4], 1.0);
    let start = State {
        time: 0.0,
        positions: vec![0.2, 1.0, 1.0, 1.0],
        velocities: vec![1.0, 0.0, 0.0, 0.0],
    };
    let impacts = vec![(0.8, 1), (0.8, 2), (0.8, 3), (4.8, 4)];
    let (faster, among, within) = (-1.0, Vec::new(), NEAR);
    let expected = Expected::Impacts { impacts, faster, among, all: true, within };
    vec![Case { scenario, start, until: 6.0, expected }]
}

/// One mass at rest at the left wall.
fn on_the_wall() -> State {
    State { time: 0.0, positions: vec![0.0], velocities: vec![0.0] }
}

/// A mass at rest on the left wall, which a force −3 cos √2 t presses against it until √2 t =
/// arccos(1/3), when the spring wins.
fn held() -> Result<Vec<Case>, Error> {
    let scenario = row(vec![[-3.0, 0.0]], SQRT_2, 0.8);
    let free = pxfm::f_acos(1.0 / 3.0) / SQRT_2;
    let released = State { time: free, ..on_the_wall() };
    let then = match TrueMotion::of(&scenario, &released).next(free + 20.0)? {
        // The gap opens with no speed at `free`, which is not an impact.
        Some(hit) if hit.time.to_f64() > free + 0.1 => {
            let (impacts, among) = (vec![(hit.time.to_f64(), hit.gap)], vec![0, 1]);
            Expected::Impacts { impacts, faster: BOUNCE, among, all: false, within: NEAR }
        }
        _ => Expected::nothing(),
    };
    let cases = [(0.95 * free, Expected::nothing()), (free + 20.0, then)];
    let case = |(until, expected)| {
        let (scenario, start) = (scenario.clone(), on_the_wall());
        Case { scenario, start, until, expected }
    };
    Ok(cases.map(case).into())
}

/// Masses that are pressed together towards the middle, and let go.
fn squeezed(sizes: &[u32]) -> Result<Vec<Case>, Error> {
    let case = |&n: &u32| {
        let push = |j: u32| 3.0 * (f64::from(n - 1) - 2.0 * f64::from(j));
        // Not in mirror symmetry, in which gaps would tie.
        let forcing = (0..n).map(|j| [push(j) + 0.1 * f64::from(j), 0.3 * f64::from(j)]).collect();
        // They meet, stick, and are let go; then the outer two come to the walls.
        let scenario = row(forcing, SQRT_2, 0.2);
        let start = State::of(&scenario);
        flights(scenario, start, 2.4, vec![0, n as usize])
    };
    sizes.iter().map(case).collect()
}

/// One unforced mass between walls with r = 1: u = b sin t hits |u| = 1 at the speed √(b² −
/// 1).
fn elastic(impacts: usize) -> Vec<Case> {
    let scenario = one([0.0, 1.25], [0.0, 0.0], SQRT_2, 1.0);
    // From wall to wall takes 2 arcsin(1/b).
    let flight = 2.0 * pxfm::f_asin(1.0 / 1.25);
    vec![case(
        scenario,
        flight * (impacts as f64 + 0.6),
        Expected::Speed { impacts, speed: 0.75, within: STEADY },
    )]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiments::accuracy::case::Verdict;
    use impact_chain::Sink;
    use impact_chain::methods::{Cost, Task};

    /// The engine with another time and closing speed of each impact, or without any.
    struct False(f64);

    impl Method for False {
        fn name(&self) -> &'static str {
            "false"
        }

        fn run(&self, (scenario, start, until): Task, sink: Sink) -> Result<Cost, Error> {
            if self.0 == 0.0 {
                return Ok(Cost::default());
            }
            Certified.run((scenario, start, until), &mut |impact| {
                let (time, speed) = (impact.time + self.0, impact.closing_speed * (1.0 + self.0));
                sink(Impact { time, closing_speed: speed, ..impact })
            })
        }
    }

    #[test]
    fn a_method_that_errs_is_not_right() {
        for scene in all(true).unwrap() {
            for case in &scene.cases {
                let [late, blind] = [0.05, 0.0].map(|by| case.judge(&False(by)));
                let expected = match scene.id {
                    "elastic" | "square-root" => (Verdict::WrongSpeed, Verdict::Missed),
                    _ if case.expected == Expected::nothing() => (Verdict::Right, Verdict::Right),
                    _ => (Verdict::Displaced, Verdict::Missed),
                };
                assert_eq!((late, blind), expected, "{}", scene.id);
            }
        }
    }
}
