//! Integrates chains side by side by Verlet, in single precision.

use super::method::{Cost, Method, Sealed, Task};
use super::steps::{Steps, check_end};
use crate::flight::length;
use crate::impact::share_change;
use crate::search::clock::Rate;
use crate::topology::Topology;
use crate::vectors::vector_level;
use crate::{Error, HitGaps, Impact, Scenario, Sink, State};
use fearless_simd::{dispatch, f32x16, prelude::*};

const LANES: usize = 16;

/// Longest row of impacts, each caused by the one before, followed within one step.
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

/// The steps in which gaps with an impact are counted: from a time on, until a chain ends.
#[derive(Clone, Copy, Debug)]
pub struct CountedSteps {
    /// The time at or after which these steps begin.
    pub from: f64,
    /// What ends a chain before the end of the run.
    pub until: HitGaps,
}

/// Receives the number of a chain and an impact; returns false to end the chain.
pub type ChainSink<'a> = &'a mut dyn FnMut(usize, Impact) -> bool;

/// The number of a chain, and the amplitudes of its gaps.
type ActiveChain = (usize, Vec<[f64; 4]>);

impl VerletAbreast {
    /// Runs chains that differ in forces and starts only; hands on impacts, sorted within a step.
    ///
    /// # Errors
    /// As [`Method::run`], and [`Error::Input`] for different chains.
    pub fn run_all(&self, chains: &[Scenario], until: f64, sink: ChainSink) -> Result<Cost, Error> {
        Ok(self.simulate(chains, until, None, sink)?.0)
    }

    /// Runs chains likewise, and returns for each how many gaps have an impact in some steps.
    ///
    /// # Errors
    /// As [`Self::run_all`].
    pub fn count_gaps(
        &self,
        chains: &[Scenario],
        until: f64,
        steps: CountedSteps,
    ) -> Result<(Cost, Vec<u32>), Error> {
        self.simulate(chains, until, Some(steps), &mut |_, _| true)
    }

    /// Hands on impacts, or counts gaps if there are steps in which to count.
    fn simulate(
        &self,
        chains: &[Scenario],
        until: f64,
        counted: Option<CountedSteps>,
        sink: ChainSink,
    ) -> Result<(Cost, Vec<u32>), Error> {
        let (h, mut may_close, mut cost) = (self.step, Vec::new(), Cost::default());
        let mut counts = vec![0; chains.len()];
        let Some(first_scenario) = chains.first() else { return Ok((cost, counts)) };
        for (number, scenario) in chains.iter().enumerate() {
            scenario.validate()?;
            scenario.check_uniform()?;
            if scenario.chain() != first_scenario.chain() || !scenario.overtones.is_empty() {
                let problem = "verlet-abreast supports equal chains with one frequency";
                return Err(Error::input("forcing_frequencies", problem, "use another method"));
            }
            let gaps = scenario.gap_amplitudes();
            let reach = |[a, b, c, d]: [f64; 4]| length([a, b]) + length([c, d]);
            if gaps.iter().any(|gap| reach(*gap) >= 1.0) {
                may_close.push((number, gaps));
            }
        }
        let start = State { time: 0.0, positions: Vec::new(), velocities: Vec::new() };
        // The end lies half a step late, so that the shortened last step is dropped and all others
        // are whole.
        let end = ((until / h).ceil() + 0.5) * h;
        let task = Task { scenario: first_scenario, start: &start, until: end };
        let steps = Steps::new(task, h, vec![Rate::new(first_scenario.forcing_frequency)])?;
        for group in may_close.chunks(LANES) {
            let mut lanes = Lanes { until, counted, ..Lanes::new(first_scenario, h, group) };
            dispatch!(vector_level(), simd => lanes.run(simd, &steps, sink));
            cost.impacts += lanes.cost.impacts;
            cost.steps += lanes.cost.steps;
            for (lane, (number, _)) in group.iter().enumerate() {
                let hit = lanes.gaps.iter().map(|gap| u32::from(gap.has_impact_bits >> lane & 1));
                counts[*number] = hit.sum();
            }
        }
        cost.evaluations = 2 * first_scenario.gaps() as u64 * cost.steps;
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
        self.run_all(&[start.as_scenario(scenario)?], until - begin, &mut later)
    }
}

/// A gap in all lanes, in units of d and of the step.
#[derive(Clone, Copy, Default)]
#[repr(align(64))]
struct Gap {
    /// How far it is wider than d.
    u: [f32; LANES],
    /// The growth of u in the last step.
    v: [f32; LANES],
    /// The amplitudes of cos Ωt and sin Ωt of what the force adds to v in a step.
    cos: [f32; LANES],
    sin: [f32; LANES],
    /// A bit for each lane in which it had an impact in the counted steps.
    has_impact_bits: u16,
}

/// Up to 16 chains side by side.
#[derive(Default)]
struct Lanes {
    h: f64,
    spacing: f64,
    /// ωh, by which the free motion turns in a step.
    turn: f32,
    /// 2 (1 − cos ωh): what u takes from v in a step. Verlet has (ωh)², which is not exact.
    pull: f32,
    /// (1 + r)/ωh: the amplitude of the free motion that an impact of speed 1 adds.
    rebound: f32,
    /// A gap whose u is below this at the end of a step may have closed within it.
    low: f32,
    /// Number of the first gap in results.
    first: usize,
    /// The gaps beside each, with the shares of its jump that they get; the last stands for none.
    adjacent: Vec<[(usize, f32); 2]>,
    /// The gaps, and one more that never has an impact.
    gaps: Vec<Gap>,
    chains: Vec<usize>,
    /// A bit for each lane whose chain has not ended.
    live: u16,
    /// The time after which impacts are not handed on.
    until: f64,
    /// The steps in which gaps are counted; without them impacts are handed on.
    counted: Option<CountedSteps>,
    /// Whether this step is one of those.
    is_counting: bool,
    /// Gaps that may have closed in this step, and a bit for each lane in which they may.
    may_have_closed: Vec<(usize, u16)>,
    /// Gaps to look at in one lane, and how many impacts led to each.
    stack: Vec<(usize, u32)>,
    step_impacts: Vec<(usize, Impact)>,
    cost: Cost,
}

impl Lanes {
    fn new(scenario: &Scenario, h: f64, group: &[ActiveChain]) -> Lanes {
        let topology = Topology::new(scenario.forcing.len(), scenario.boundary);
        let angles = [scenario.natural_frequency * h, scenario.forcing_frequency * h];
        let [pull, forced_pull] = angles.map(|angle| {
            let sin = pxfm::f_sin(0.5 * angle);
            4.0 * sin * sin
        });
        let [(sin, cos), (big_sin, big_cos)] = angles.map(pxfm::f_sincos);
        let none = topology.gaps();
        let mut gaps = vec![Gap::default(); none + 1];
        for (lane, (_, amplitudes)) in group.iter().enumerate() {
            for (gap, &[a, b, forced_a, forced_b]) in gaps.iter_mut().zip(amplitudes) {
                let before = a * cos - b * sin + forced_a * big_cos - forced_b * big_sin;
                gap.u[lane] = (a + forced_a) as f32;
                gap.v[lane] = (a + forced_a - before) as f32;
                gap.cos[lane] = ((pull - forced_pull) * forced_a) as f32;
                gap.sin[lane] = ((pull - forced_pull) * forced_b) as f32;
            }
        }
        let adjacent = |k| {
            let [left, right] = share_change(1.0, topology.inverse_masses(k)).map(|x| x as f32);
            let [before, after] = topology.adjacent(k).map(|gap| gap.unwrap_or(none));
            [(before, left), (after, -right)]
        };
        Lanes {
            h,
            spacing: scenario.spacing,
            turn: angles[0] as f32,
            pull: pull as f32,
            rebound: ((1.0 + scenario.restitution) / angles[0]) as f32,
            low: (DIP * angles[0] * angles[0] - 1.0) as f32,
            first: topology.label(0),
            adjacent: (0..none).map(adjacent).collect(),
            gaps,
            chains: group.iter().map(|(number, _)| *number).collect(),
            live: ((1u32 << group.len()) - 1) as u16,
            may_have_closed: vec![(0, 0); none + 1],
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

    #[inline(always)]
    fn run<S: Simd>(&mut self, simd: S, steps: &Steps, sink: ChainSink) {
        let (mut i, mut time, mut from) = (0, 0.0, (0.0, 1.0));
        let _ = steps.each(
            #[inline(always)]
            |step| {
                // The last step, half as long, is the one to be dropped.
                if self.live == 0 || step.h < 0.75 * self.h {
                    return Err(());
                }
                self.is_counting = self.counted.is_some_and(|counted| time >= counted.from);
                self.cost.steps += u64::from(self.live.count_ones());
                let number = self.leap(simd, from);
                let to = (step.phases[0].0 as f32, step.phases[0].1 as f32);
                let mean = (0.5 * (from.0 + to.0), 0.5 * (from.1 + to.1));
                (i, time, from) = (i + 1, step.to.time(), to);
                for index in 0..number {
                    let (k, mut lanes) = self.may_have_closed[index];
                    while lanes != 0 {
                        self.take_impacts(k, lanes.trailing_zeros() as usize, mean, time);
                        lanes &= lanes - 1;
                    }
                }
                match self.counted {
                    None => self.report(sink),
                    // Ends are looked for in every fourth step only.
                    Some(counted) if self.is_counting && i % 4 == 0 => {
                        let gaps = &self.gaps[..self.adjacent.len()];
                        let bits = gaps.iter().map(|gap| gap.has_impact_bits);
                        self.end(
                            self.live
                                & match counted.until {
                                    HitGaps::One => bits.fold(0, |any, bits| any | bits),
                                    HitGaps::All => bits.fold(!0, |all, bits| all & bits),
                                },
                        );
                    }
                    Some(_) => (),
                }
                Ok(())
            },
        );
    }

    /// Moves all gaps by a step that begins at (sin Ωt, cos Ωt); lists those that may have closed
    /// in it, and returns their number.
    #[inline(always)]
    fn leap<S: Simd>(&mut self, simd: S, (sin, cos): (f32, f32)) -> usize {
        let mut number = 0;
        for (k, gap) in self.gaps[..self.adjacent.len()].iter_mut().enumerate() {
            let row = |row| f32x16::from_slice(simd, row);
            let u = row(&gap.u);
            let force = row(&gap.cos) * cos + row(&gap.sin) * sin;
            let v = (row(&gap.v) - u * self.pull) + force;
            let u = u + v;
            u.store_slice(&mut gap.u);
            v.store_slice(&mut gap.v);
            let lanes = u.simd_lt(self.low).to_bitmask() as u16;
            self.may_have_closed[number] = (k, lanes);
            number += usize::from(lanes != 0);
        }
        number
    }

    /// Takes the impact of a gap in a lane, and those to which it leads beside it, in a step that
    /// ends at `time`; sin Ωt and cos Ωt are the means of both its ends.
    #[inline(always)]
    fn take_impacts(&mut self, k: usize, lane: usize, (sin, cos): (f32, f32), time: f64) {
        self.stack.push((k, 0));
        while let Some((k, depth)) = self.stack.pop() {
            let gap = &mut self.gaps[k];
            let (u, v) = (gap.u[lane], gap.v[lane]);
            // With x steps left the width is width − rate x + acceleration x²/2.
            let force = gap.cos[lane] * cos + gap.sin[lane] * sin;
            let (width, acceleration) = (u + 1.0, force - (u - 0.5 * v) * self.pull);
            let rate = v + 0.5 * acceleration;
            let discriminant = rate * rate - 2.0 * width * acceleration;
            let root = discriminant.max(0.0).sqrt();
            let earlier_zero = (rate + root) / acceleration;
            let dips = (0.0..acceleration).contains(&rate) && discriminant > 0.0;
            let steps_left = if width < 0.0 {
                let zero = if rate < 0.0 { 2.0 * width / (rate - root) } else { earlier_zero };
                if rate < 0.0 || acceleration > 0.0 { zero.min(1.5) } else { 1.0 }
            } else if dips && rate + root <= acceleration {
                earlier_zero
            } else {
                continue;
            };
            let speed = acceleration * steps_left - rate;
            if speed <= 0.0 || speed.is_nan() {
                continue;
            }
            // The free motion that the impact adds, as if it had been there a step before the end.
            let jump = speed * self.rebound;
            let change = jump * sine(steps_left * self.turn);
            let growth = change + jump * sine(self.turn - steps_left * self.turn);
            gap.has_impact_bits |= u16::from(self.is_counting) << lane;
            (gap.u[lane], gap.v[lane]) = (u + change, v + growth);
            self.cost.impacts += 1;
            if self.counted.is_none() {
                let time = time - f64::from(steps_left.min(1.0)) * self.h;
                let closing_speed = f64::from(speed) * self.spacing / self.h;
                let gap = self.first + k;
                self.step_impacts.push((lane, Impact { time, gap, closing_speed }));
            }
            for (adjacent, share) in self.adjacent[k] {
                let gap = &mut self.gaps[adjacent];
                gap.u[lane] += share * change;
                gap.v[lane] += share * growth;
                if gap.u[lane] < -1.0 && depth < DEEPEST {
                    self.stack.push((adjacent, depth + 1));
                }
            }
        }
    }

    fn report(&mut self, sink: ChainSink) {
        self.step_impacts.sort_by(|a, b| a.1.time.total_cmp(&b.1.time));
        for (lane, impact) in std::mem::take(&mut self.step_impacts) {
            if self.live >> lane & 1 == 0 || impact.time > self.until {
                self.cost.impacts -= 1;
            } else if !sink(self.chains[lane], impact) {
                self.end(1 << lane);
            }
        }
    }
}

#[inline(always)]
fn sine(x: f32) -> f32 {
    let y = x * x;
    x - x * y * (1.0 / 6.0 - y * (1.0 / 120.0))
}
