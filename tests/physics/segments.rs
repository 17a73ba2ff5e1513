//! The saved scenarios of Figs. 5 and 6 show their circuits, in the engine and in the reference; and how
//! they were found.
//!
//! Random search finds no stretch with the impacts of Fig. 6 in order (none in 10^7 impacts). Once
//! the *times* of the impacts are chosen, though, all else is linear: each impact asks for
//! Δ = 0 and for a kick of −(1 + r) Δ', in the unknown amplitudes (four a mass) and kicks. So
//! the search is over times and over the amplitudes nearest to which the linear problem is
//! solved; what it lowers is how far gaps close where they should not, kicks of the wrong sign,
//! and large amplitudes.

use crate::reference::{Dd, Real, Reference};
use crate::trace;
use impact_paper::dynamics::{Initial, Scenario, Simultaneous};
use impact_paper::numerics::random::NormalPairs;
use impact_paper::params::Boundary;

const MASSES: usize = 3;
const RESTITUTION: f64 = 0.8;
/// The circuits of Sec. 5, with the first vertex again at the end.
const FIG05: &[usize] = &[0, 1, 3, 0];
const FIG06: &[usize] = &[0, 0, 1, 0, 2, 1, 3, 3, 0];

/// What is saved for a figure, and the scenario in it.
fn saved(figure: &str) -> (serde_json::Value, Scenario) {
    let path = format!("{}/templates/scenarios/{figure}.json", env!("CARGO_MANIFEST_DIR"));
    let saved: serde_json::Value =
        serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let scenario = Scenario::from_json(&saved["scenario"].to_string()).unwrap();
    (saved, scenario)
}

/// The impacts of a figure as gaps: L-1, 1-2, 2-3 and 3-R are 0, 1, 2 and 3.
fn replay(figure: &str, order: &[usize]) {
    let (saved, scenario) = saved(figure);
    assert_eq!(saved["order"], serde_json::json!(order));
    let (from, until) = (saved["from"].as_f64().unwrap(), saved["until"].as_f64().unwrap());
    let hits = trace(&scenario, until);
    for hit in &hits {
        assert!(hit.closing_speed > 0.1, "a grazing impact is no clear picture: {hit:?}");
    }
    let hits: Vec<(f64, usize)> = hits.iter().map(|hit| (hit.time, hit.gap)).collect();
    assert!(hits.iter().all(|(t, _)| *t >= from), "{hits:?}");
    assert_eq!(hits.iter().map(|h| h.1).collect::<Vec<_>>(), order);
    for pair in hits.windows(2) {
        assert!(pair[1].0 - pair[0].0 > 0.15, "{hits:?}");
    }
    let exact = Reference::<Dd>::new(&scenario).run(until).unwrap();
    assert_eq!(exact.len(), hits.len());
    for (a, b) in hits.iter().zip(&exact) {
        assert!(a.1 == b.gap && (a.0 - b.time.near()).abs() < 1e-12, "{a:?}");
    }
}

#[test]
fn fig_5_is_a_simple_circuit_that_closes() {
    replay("fig05", FIG05);
}

#[test]
fn fig_6_is_the_circuit_of_section_5_that_is_not_simple_and_closes() {
    replay("fig06", FIG06);
}

/// Least time between two impacts, before the first, and after the last.
fn apart(order: &[usize]) -> f64 {
    if order.len() < 6 { 0.6 } else { 0.3 }
}

/// How wide a gap should open between two of its impacts, so that the picture shows it.
const SEEN: f64 = 0.25;
/// How far a gap should stay open away from its impacts, so that none seems to be there.
const CLEAR: f64 = 0.06;
/// Time step at which the search looks at the gaps.
const STEP: f64 = 0.02;

/// The motion that has its impacts at given times: amplitudes of the four waves of each mass,
/// then the kick of each impact.
struct Motion<'a> {
    order: &'a [usize],
    times: Vec<f64>,
    unknowns: Vec<f64>,
}

/// Share of mass j in gap g: its sign in Δ, and how much of a kick it takes.
fn role(gap: usize, mass: usize) -> f64 {
    f64::from(u8::from(gap == mass)) - f64::from(u8::from(gap == mass + 1))
}

fn share(gap: usize) -> f64 {
    if gap == 0 || gap == MASSES { 1.0 } else { 0.5 }
}

/// The coefficients of Δ_gap − d and of its derivative at t in the unknowns, counting the first
/// `done` impacts.
fn rows(order: &[usize], times: &[f64], done: usize, gap: usize, t: f64) -> [Vec<f64>; 2] {
    let w = std::f64::consts::SQRT_2;
    let mut value = vec![0.0; 4 * MASSES + order.len()];
    let mut slope = value.clone();
    for mass in 0..MASSES {
        let sign = role(gap, mass);
        if sign == 0.0 {
            continue;
        }
        let waves = [t.cos(), t.sin(), (w * t).cos(), (w * t).sin()];
        let slopes = [-t.sin(), t.cos(), -w * (w * t).sin(), w * (w * t).cos()];
        for i in 0..4 {
            value[4 * mass + i] += sign * waves[i];
            slope[4 * mass + i] += sign * slopes[i];
        }
        for i in 0..done {
            let kick = sign * role(order[i], mass) * share(order[i]);
            value[4 * MASSES + i] += kick * (t - times[i]).sin();
            slope[4 * MASSES + i] += kick * (t - times[i]).cos();
        }
    }
    [value, slope]
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Solves a symmetric system by elimination with pivots; none if it is singular.
fn solve(mut m: Vec<Vec<f64>>) -> Option<Vec<f64>> {
    let n = m.len();
    for i in 0..n {
        let pivot = (i..n).max_by(|&a, &b| m[a][i].abs().total_cmp(&m[b][i].abs()))?;
        if m[pivot][i].abs() < 1e-10 {
            return None;
        }
        m.swap(i, pivot);
        for row in i + 1..n {
            let (above, below) = m.split_at_mut(row);
            let factor = below[0][i] / above[i][i];
            let pivot = above[i][i..].iter();
            below[0][i..].iter_mut().zip(pivot).for_each(|(x, p)| *x -= factor * p);
        }
    }
    let mut x = vec![0.0; n];
    for i in (0..n).rev() {
        x[i] = (m[i][n] - dot(&m[i][i + 1..n], &x[i + 1..])) / m[i][i];
    }
    Some(x)
}

impl<'a> Motion<'a> {
    /// From a point of the search: a number for each waiting time, then the wished amplitudes.
    fn new(order: &'a [usize], point: &[f64]) -> Option<Self> {
        let mut t = 0.0;
        let times: Vec<f64> = point[..order.len()]
            .iter()
            .map(|q| {
                t += apart(order) + q.abs();
                t
            })
            .collect();
        let mut wish = point[order.len()..].to_vec();
        wish.resize(4 * MASSES + order.len(), 1.0);
        let mut equations: Vec<(Vec<f64>, f64)> = Vec::new();
        for (i, (&gap, &t)) in order.iter().zip(&times).enumerate() {
            let [value, mut slope] = rows(order, &times, i, gap, t);
            slope.iter_mut().for_each(|x| *x *= 1.0 + RESTITUTION);
            slope[4 * MASSES + i] += 1.0;
            equations.push((value, -1.0));
            equations.push((slope, 0.0));
        }
        let matrix = equations
            .iter()
            .map(|(row, right)| {
                let mut line: Vec<f64> =
                    equations.iter().map(|(other, _)| dot(row, other)).collect();
                line.push(right - dot(row, &wish));
                line
            })
            .collect();
        let weights = solve(matrix)?;
        for ((row, _), weight) in equations.iter().zip(&weights) {
            wish.iter_mut().zip(row).for_each(|(x, a)| *x += weight * a);
        }
        Some(Motion { order, times, unknowns: wish })
    }

    fn end(&self) -> f64 {
        self.times[self.times.len() - 1] + apart(self.order)
    }

    /// What the search lowers.
    fn cost(&self, grid: &[[f64; 4]]) -> f64 {
        let (amplitudes, kicks) = self.unknowns.split_at(4 * MASSES);
        let mut waves: Vec<[f64; 4]> =
            amplitudes.chunks(4).map(|m| [m[0], m[1], m[2], m[3]]).collect();
        let mut cost = 0.0;
        let mut done = 0;
        let mut last = [f64::NEG_INFINITY; MASSES + 1];
        let mut widest: [f64; MASSES + 1] = [0.0; MASSES + 1];
        for (step, at) in grid.iter().enumerate() {
            let t = STEP * step as f64;
            if t > self.end() {
                break;
            }
            while done < self.times.len() && self.times[done] < t {
                let (gap, time) = (self.order[done], self.times[done]);
                for (mass, wave) in waves.iter_mut().enumerate() {
                    let kick = role(gap, mass) * share(gap) * kicks[done];
                    wave[0] -= kick * time.sin();
                    wave[1] += kick * time.cos();
                }
                if last[gap] > 0.0 {
                    cost += (SEEN - widest[gap]).max(0.0).powi(2);
                }
                (last[gap], widest[gap]) = (time, 0.0);
                done += 1;
            }
            let mut left = 0.0;
            for gap in 0..=MASSES {
                let right = if gap < MASSES { dot(&waves[gap], at) } else { 0.0 };
                let delta = 1.0 + right - left;
                left = right;
                widest[gap] = widest[gap].max(delta);
                if delta > CLEAR {
                    continue;
                }
                let ahead = (done..self.times.len()).find(|&i| self.order[i] == gap);
                let ahead = ahead.map_or(f64::INFINITY, |i| self.times[i] - t);
                let near = ahead.min(t - last[gap]);
                let wanted = CLEAR * ((near - 0.03) / 0.2).clamp(0.0, 1.0);
                let lack = (wanted - delta).max(0.0);
                cost += lack * lack;
            }
        }
        for kick in kicks {
            cost += (0.4 - kick).max(0.0).powi(2);
        }
        let large: f64 = amplitudes.iter().map(|a| (a.abs() - 1.0).max(0.0).powi(2)).sum();
        cost + 1e-2 * large + 1e-4 * dot(amplitudes, amplitudes) + 1e-4 * self.end()
    }

    /// The same motion as a scenario, its numbers cut to five decimals.
    fn scenario(&self) -> Scenario {
        let cut = |x: f64| (x * 1e5).round() / 1e5;
        let masses = self.unknowns[..4 * MASSES].chunks(4);
        Scenario {
            spacing: 1.0,
            natural_frequency: 1.0,
            forcing_frequency: std::f64::consts::SQRT_2,
            restitution: RESTITUTION,
            boundary: Boundary::Walls,
            initial: Initial::Free(masses.clone().map(|m| [cut(m[0]), cut(m[1])]).collect()),
            forcing: masses.map(|m| [cut(-m[2]), cut(-m[3])]).collect(),
            overtones: Vec::new(),
            simultaneous: Simultaneous::default(),
        }
    }
}

/// One descent by an evolution strategy of one parent that learns the shape of its steps, the
/// (1+1)-CMA-ES of Igel, Suttorp and Hansen (2006) with a factor kept in place of the matrix.
fn descend(order: &[usize], normals: &mut NormalPairs, tries: usize) -> Option<Vec<f64>> {
    let n = order.len() + 4 * MASSES;
    let w = std::f64::consts::SQRT_2;
    let grid: Vec<[f64; 4]> = (0..1200)
        .map(|i| STEP * f64::from(i))
        .map(|t| [t.cos(), t.sin(), (w * t).cos(), (w * t).sin()])
        .collect();
    let mut normal =
        || -> Vec<f64> { (0..n.div_ceil(2)).flat_map(|_| normals.pair()).take(n).collect() };
    let mut point: Vec<f64> = normal().iter().map(|x| 0.7 * x).collect();
    let mut cost = Motion::new(order, &point)?.cost(&grid);
    let mut factor: Vec<Vec<f64>> =
        (0..n).map(|i| (0..n).map(|j| f64::from(u8::from(i == j))).collect()).collect();
    let (target, learn, damp) = (2.0 / 11.0, 2.0 / ((n * n) as f64 + 6.0), 1.0 + n as f64 / 2.0);
    let (mut success, mut width): (f64, f64) = (target, 0.3);
    for _ in 0..tries {
        let z = normal();
        let step: Vec<f64> = factor.iter().map(|row| dot(row, &z)).collect();
        let next: Vec<f64> = point.iter().zip(&step).map(|(x, s)| x + width * s).collect();
        let lower = Motion::new(order, &next).map(|m| m.cost(&grid)).filter(|c| *c < cost);
        success = success * 11.0 / 12.0 + f64::from(u8::from(lower.is_some())) / 12.0;
        width *= ((success - target) / ((1.0 - target) * damp)).exp();
        if let Some(lower) = lower {
            (cost, point) = (lower, next);
            let square = dot(&z, &z);
            let keep = (1.0 - learn).sqrt();
            let add = keep / square * ((1.0 + learn * square / (1.0 - learn)).sqrt() - 1.0);
            for (row, s) in factor.iter_mut().zip(&step) {
                row.iter_mut().zip(&z).for_each(|(a, z)| *a = keep * *a + add * s * z);
            }
        }
        if width < 1e-9 {
            break;
        }
    }
    Some(point)
}

/// One restart of the search: the scenario, and whether it shows the circuit.
fn restart(order: &[usize], number: u64) -> Option<(Scenario, bool)> {
    let mut normals = NormalPairs::new("segments", 2007, number);
    let point = descend(order, &mut normals, 30_000)?;
    let motion = Motion::new(order, &point)?;
    let scenario = motion.scenario();
    let hits = Reference::<Dd>::new(&scenario).run(motion.end());
    let good = hits.is_ok_and(|hits| hits.iter().map(|hit| hit.gap).eq(order.iter().copied()));
    Some((scenario, good))
}

#[test]
#[ignore = "follows the platform's sine from step to step"]
fn the_saved_scenarios_come_from_these_restarts() {
    // Restart 1 of 40 and restart 185 of 700: the best, or as good as any, and clear as pictures.
    for (figure, order, number) in [("fig05", FIG05, 1), ("fig06", FIG06, 185)] {
        let saved = saved(figure).1;
        let (found, good) = restart(order, number).expect("a scenario");
        assert!(good && found == saved, "{figure}: {found:?}");
    }
}
