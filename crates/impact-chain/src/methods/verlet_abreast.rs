//! Integrates chains side by side by Verlet, in single precision.

use super::method::{Cost, Method, Sealed, Task};
use super::steps::{Steps, check_end};
use crate::forcing::gap_amplitudes;
use crate::impact::jumps;
use crate::search::clock::Rate;
use crate::topology::Topology;
use crate::vectors::vector_level;
use crate::{Error, Impact, Scenario, Sink, State};
use fearless_simd::{dispatch, f32x16, prelude::*};

/// Chains side by side.
const LANES: usize = 16;

/// After so many impacts of adjacent gaps, each by the last, a step is left as it is.
const DEEPEST: u32 = 8;

/// A gap may dip in a step if it is narrower than this times (ωh)² d at its end: M₂ h²/8 where
/// |f''| ≤ M₂ = 1.2 ω² d in it. With 0.5 means of chains are the same within their errors, and cost
/// up to 1.2 times as much.
const DIP: f64 = 0.15;

/// Verlet's steps for the gaps of many chains, a chain in each lane of a register, in single
/// precision; impacts are placed within the step.
///
/// - Source: Verlet (1967), Phys. Rev. 159, 98; coefficients that make sines of both frequencies
///   exact after Gautschi (1961), Numerische Mathematik 3, 381.
/// - Order: none in flight, which is exact up to rounding; 3 for the time of an impact and 2 for
///   its speed, by the parabola through both ends of the step with the mean acceleration.
/// - Fails: single precision loses the orbit early; grazes, and dips within a step, are those of
///   the parabola; impacts of a step are taken gap by gap, not in the order of their times; a gap
///   pressed shut is hit again and again. Several frequencies are refused.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VerletAbreast {
    /// Length h of a step.
    pub step: f64,
}

/// The steps in which gaps with an impact are counted.
#[derive(Clone, Copy, Debug)]
pub struct Window {
    /// The time at or after which these steps begin.
    pub after: f64,
    /// Whether a chain ends when one gap is hit there, not all.
    pub ends_with_one: bool,
}

/// Receives the number of a chain and an impact; returns false to end the chain.
pub type Receiver<'a> = dyn FnMut(usize, Impact) -> bool + 'a;

impl VerletAbreast {
    /// Runs chains that differ in forces and starts only, and hands each impact to `sink`,
    /// sorted within a step.
    ///
    /// With a window, no impact is handed on; instead, the gaps of each chain with an impact in it
    /// are counted, and a chain ends when all are hit, or one.
    ///
    /// # Errors
    /// As [`Method::run`], and [`Error::Input`] for different chains.
    pub fn run_all(
        &self,
        scenarios: &[Scenario],
        until: f64,
        window: Option<Window>,
        sink: &mut Receiver,
    ) -> Result<(Cost, Vec<u32>), Error> {
        let (h, mut ready, mut cost) = (self.step, Vec::new(), Cost::default());
        let mut counts = vec![0; scenarios.len()];
        let Some(like) = scenarios.first() else { return Ok((cost, counts)) };
        for (chain, scenario) in scenarios.iter().enumerate() {
            scenario.validate()?;
            scenario.check_uniform()?;
            let Scenario { forcing, initial, .. } = like.clone();
            let alike = forcing.len() == scenario.forcing.len()
                && *like == Scenario { forcing, initial, ..scenario.clone() };
            if !alike || !like.overtones.is_empty() {
                let problem = "verlet-abreast supports equal chains with one frequency";
                return Err(Error::input("forcing_frequencies", problem, "use another method"));
            }
            let gaps = gap_amplitudes(scenario);
            let reach = |[a, b, c, d]: [f64; 4]| (a * a + b * b).sqrt() + (c * c + d * d).sqrt();
            if gaps.iter().any(|gap| reach(*gap) >= 1.0) {
                ready.push((chain, gaps));
            }
        }
        let start = State { time: 0.0, positions: Vec::new(), velocities: Vec::new() };
        // Half a step more, which is not made: all that are made are whole.
        let end = ((until / h).ceil() + 0.5) * h;
        let task = Task { scenario: like, start: &start, until: end };
        let steps = Steps::new(task, h, vec![Rate::new(like.forcing_frequency)])?;
        for group in ready.chunks(LANES) {
            let mut lanes = Lanes { until, window, ..Lanes::new(like, h, group) };
            dispatch!(vector_level(), simd => lanes.run(simd, &steps, sink));
            cost.impacts += lanes.impacts;
            cost.steps += lanes.steps;
            for (lane, (chain, _)) in group.iter().enumerate() {
                let hit = lanes.gaps.iter().map(|gap| u32::from(gap.hit >> lane & 1));
                counts[*chain] = hit.sum();
            }
        }
        cost.evaluations = 2 * like.boundary.gaps(like.forcing.len()) as u64 * cost.steps;
        Ok((cost, counts))
    }
}

impl Sealed for VerletAbreast {}

impl Method for VerletAbreast {
    fn name(&self) -> &'static str {
        "verlet-abreast"
    }

    fn run(&self, task: Task, sink: Sink) -> Result<Cost, Error> {
        check_end(task)?;
        let Task { scenario, start, until } = task;
        let begin = start.time;
        let mut later = |_, impact: Impact| sink(Impact { time: begin + impact.time, ..impact });
        let scenarios = [start.as_scenario(scenario)?];
        Ok(self.run_all(&scenarios, until - begin, None, &mut later)?.0)
    }
}

/// A gap in all lanes, in units of d and of the step: how far it is wider than d, its growth in the
/// last step, and the amplitudes of its force; a bit for each lane in which it was hit.
#[derive(Clone, Copy, Default)]
#[repr(align(64))]
struct Gap {
    u: [f32; LANES],
    v: [f32; LANES],
    cos: [f32; LANES],
    sin: [f32; LANES],
    hit: u16,
}

#[derive(Default)]
struct Lanes {
    h: f64,
    spacing: f64,
    /// ωh, 2 (1 − cos ωh), (1 + r)/ωh.
    turn: f32,
    pull: f32,
    rebound: f32,
    /// A gap that may dip is narrower, in units of d, less 1.
    low: f32,
    /// Number of the first gap in results.
    first: usize,
    /// The gaps beside each, with their parts of its jump; the last of `gaps` stands for none.
    near: Vec<[(usize, f32); 2]>,
    gaps: Vec<Gap>,
    /// Numbers of the chains, and a bit for each that has not ended.
    chains: Vec<usize>,
    live: u16,
    until: f64,
    window: Option<Window>,
    /// Whether impacts are counted by gaps.
    counts: bool,
    /// Gaps to look at, each with its lanes; in one lane, with the impacts that led to each.
    looks: Vec<(usize, u16)>,
    stack: Vec<(usize, u32)>,
    /// Impacts of a step, with their lanes.
    step_impacts: Vec<(usize, Impact)>,
    impacts: u64,
    steps: u64,
}

impl Lanes {
    fn new(like: &Scenario, h: f64, group: &[(usize, Vec<[f64; 4]>)]) -> Lanes {
        let topology = Topology::new(like.forcing.len(), like.boundary);
        let angles = [like.natural_frequency * h, like.forcing_frequency * h];
        let [pull, big_pull] = angles.map(|angle| {
            let sin = pxfm::f_sin(0.5 * angle);
            4.0 * sin * sin
        });
        let [(sin, cos), (big_sin, big_cos)] = angles.map(pxfm::f_sincos);
        let number = topology.gaps();
        let mut gaps = vec![Gap::default(); number + 1];
        for (lane, (_, amplitudes)) in group.iter().enumerate() {
            for (gap, &[a, b, c, d]) in gaps.iter_mut().zip(amplitudes) {
                let before = a * cos - b * sin + c * big_cos - d * big_sin;
                gap.u[lane] = (a + c) as f32;
                gap.v[lane] = (a + c - before) as f32;
                gap.cos[lane] = ((pull - big_pull) * c) as f32;
                gap.sin[lane] = ((pull - big_pull) * d) as f32;
            }
        }
        let near = |k| {
            let [left, right] = jumps(1.0, 0.0, topology.inverse_masses(k)).map(|x| x as f32);
            let [before, after] = topology.adjacent(k).map(|near| near.unwrap_or(number));
            [(before, left), (after, -right)]
        };
        Lanes {
            h,
            spacing: like.spacing,
            turn: angles[0] as f32,
            pull: pull as f32,
            rebound: ((1.0 + like.restitution) / angles[0]) as f32,
            low: (DIP * angles[0] * angles[0] - 1.0) as f32,
            first: topology.label(0),
            near: (0..number).map(near).collect(),
            gaps,
            chains: group.iter().map(|(chain, _)| *chain).collect(),
            live: ((1u32 << group.len()) - 1) as u16,
            looks: vec![(0, 0); number + 1],
            ..Lanes::default()
        }
    }

    /// Ends chains, whose gaps stay open then.
    fn end(&mut self, lanes: u16) {
        self.live &= !lanes;
        for lane in (0..LANES).filter(|lane| lanes >> lane & 1 == 1) {
            for Gap { u, v, cos, sin, .. } in &mut self.gaps {
                [u[lane], v[lane], cos[lane], sin[lane]] = [0.0; 4];
            }
        }
    }

    /// Runs the chains to a time.
    #[inline(always)]
    fn run<S: Simd>(&mut self, simd: S, steps: &Steps, sink: &mut Receiver) {
        let (mut i, mut time, mut from) = (0, 0.0, [1.0, 0.0]);
        let _ = steps.each(
            #[inline(always)]
            |step| {
                if self.live == 0 || step.h < 0.75 * self.h {
                    return Err(());
                }
                self.counts = self.window.is_some_and(|window| time >= window.after);
                self.steps += u64::from(self.live.count_ones());
                let number = self.leap(simd, from);
                let to = [step.phases[0].1 as f32, step.phases[0].0 as f32];
                let mean = [0, 1].map(|i| 0.5 * (from[i] + to[i]));
                (i, time, from) = (i + 1, step.to().time(), to);
                for look in 0..number {
                    let (k, mut lanes) = self.looks[look];
                    while lanes != 0 {
                        self.hit(k, lanes.trailing_zeros() as usize, mean, time);
                        lanes &= lanes - 1;
                    }
                }
                match self.window {
                    None => self.report(sink),
                    Some(window) if self.counts && i % 4 == 0 => {
                        let hit = self.gaps[..self.near.len()].iter().map(|gap| gap.hit);
                        let (any, all) = hit.fold((0, !0), |of, hit| (of.0 | hit, of.1 & hit));
                        self.end(self.live & if window.ends_with_one { any } else { all });
                    }
                    Some(_) => (),
                }
                Ok(())
            },
        );
    }

    /// Moves all gaps by a step; lists those to look at and returns their number.
    #[inline(always)]
    fn leap<S: Simd>(&mut self, simd: S, [cos, sin]: [f32; 2]) -> usize {
        let mut number = 0;
        for (k, gap) in self.gaps[..self.near.len()].iter_mut().enumerate() {
            let row = |row| f32x16::from_slice(simd, row);
            let u = row(&gap.u);
            let force = row(&gap.cos) * cos + row(&gap.sin) * sin;
            let v = (row(&gap.v) - u * self.pull) + force;
            let u = u + v;
            u.store_slice(&mut gap.u);
            v.store_slice(&mut gap.v);
            let lanes = u.simd_lt(self.low).to_bitmask() as u16;
            self.looks[number] = (k, lanes);
            number += usize::from(lanes != 0);
        }
        number
    }

    /// Finds the impact of a gap in a lane and those to which it leads beside it, in a step that
    /// ends at a time and has these phases in the mean.
    #[inline(always)]
    fn hit(&mut self, k: usize, lane: usize, [cos, sin]: [f32; 2], time: f64) {
        self.stack.push((k, 0));
        while let Some((k, depth)) = self.stack.pop() {
            let gap = &mut self.gaps[k];
            let (u, v) = (gap.u[lane], gap.v[lane]);
            // The width is w − p s + q s²/2 when s steps are left.
            let force = gap.cos[lane] * cos + gap.sin[lane] * sin;
            let (w, q) = (u + 1.0, force - (u - 0.5 * v) * self.pull);
            let p = v + 0.5 * q;
            let inside = p * p - 2.0 * w * q;
            let root = inside.max(0.0).sqrt();
            let s = if w < 0.0 {
                let s = if p < 0.0 { 2.0 * w / (p - root) } else { (p + root) / q };
                if p < 0.0 || q > 0.0 { s.min(1.5) } else { 1.0 }
            } else if 0.0 <= p && p < q && inside > 0.0 && p + root <= q {
                (p + root) / q
            } else {
                continue;
            };
            let speed = q * s - p;
            let opens = speed > 0.0;
            if !opens {
                continue;
            }
            let jump = speed * self.rebound;
            let x = jump * sine(s * self.turn);
            let y = x + jump * sine(self.turn - s * self.turn);
            gap.hit |= u16::from(self.counts) << lane;
            (gap.u[lane], gap.v[lane]) = (u + x, v + y);
            self.impacts += 1;
            if self.window.is_none() {
                let time = time - f64::from(s.min(1.0)) * self.h;
                let closing_speed = f64::from(speed) * self.spacing / self.h;
                let gap = self.first + k;
                self.step_impacts.push((lane, Impact { time, gap, closing_speed }));
            }
            for (near, part) in self.near[k] {
                let gap = &mut self.gaps[near];
                gap.u[lane] += part * x;
                gap.v[lane] += part * y;
                if gap.u[lane] < -1.0 && depth < DEEPEST {
                    self.stack.push((near, depth + 1));
                }
            }
        }
    }

    /// Hands on the impacts of a step.
    fn report(&mut self, sink: &mut Receiver) {
        self.step_impacts.sort_by(|a, b| a.1.time.total_cmp(&b.1.time));
        for (lane, impact) in std::mem::take(&mut self.step_impacts) {
            if self.live >> lane & 1 == 0 || impact.time > self.until {
                self.impacts -= 1;
            } else if !sink(self.chains[lane], impact) {
                self.end(1 << lane);
            }
        }
    }
}

/// Evaluates the sine of a small angle.
#[inline(always)]
fn sine(x: f32) -> f32 {
    let y = x * x;
    x - x * y * (1.0 / 6.0 - y * (1.0 / 120.0))
}
