//! Simulates by Moreau–Jean time stepping.

use super::bodies::{Bodies, push};
use super::method::Task;
use super::rival::{Rival, Run, Stepper, Stop, Tally, run_steps};
use super::steps::Step;
use crate::Error;
use fearless_simd::Simd;

/// Time stepping with contacts on the level of velocities and impulses: flight by the implicit
/// midpoint rule (Jean's θ = 1/2); gaps that the forecast Δ + h Δ'/2 finds shut enter one
/// complementarity problem 0 ≤ U⁺ + r U ⊥ P ≥ 0 for the step's impulses P, with U and U⁺
/// their rates before and after.
///
/// The matrix of that problem is tridiagonal for a row of masses; projected Gauss–Seidel solves
/// it, lowest gap first. An impact is an episode of steps with P > 0, counted in the middle of its
/// first.
///
/// - Source: Moreau (1988), CISM Courses 302, 1; Jean (1999), Comput. Methods Appl. Mech. Eng. 177,
///   235; Acary and Brogliato (2008), Lect. Notes Appl. Comput. Mech. 35, sec. 10.
/// - Order: 2 in flight, 1 as soon as there is an impact, whose time is known to a step.
/// - Fails: impacts of one gap within neighbouring steps are one; impacts of different gaps within
///   a step are simultaneous, so their order is lost; the forecast hits gaps that only come near,
///   to |Δ''| h²/8; overlaps of up to a step times the speed stay; a gap that is hit right after
///   it was pressed is no new impact. It is made for rest in contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MoreauJean {
    /// Length h of a step.
    pub step: f64,
}

/// The most sweeps of Gauss–Seidel in one step. A cluster of m contacts needs some m².
const SWEEPS: usize = 1000;

/// The sweeps end when no impulse changes by more than this part of the largest.
const CONVERGED: f64 = 1e-15;

impl Rival for MoreauJean {
    const NAME: &'static str = "moreau-jean";

    fn begin(&self, task: Task) -> Result<Run, Error> {
        let row = Bodies::new(task)?;
        let (forecast, shut, active, touching) =
            (row.u.clone(), Vec::new(), Vec::new(), Vec::new());
        let rates = row.rates();
        run_steps(task, self.step, rates, Impulses { row, forecast, shut, active, touching })
    }
}

/// A gap that may be shut within the step.
struct Active {
    k: usize,
    /// Rate U before the step.
    rate: f64,
    impulse: f64,
}

struct Impulses {
    row: Bodies,
    /// Displacements that the velocities at the beginning of a step give for its middle.
    forecast: Vec<f64>,
    shut: Vec<usize>,
    active: Vec<Active>,
    /// The gaps that had an impulse in the last step.
    touching: Vec<usize>,
}

impl Stepper for Impulses {
    #[inline(always)]
    fn step<S: Simd>(&mut self, simd: S, step: &Step, tally: &mut Tally) -> Result<(), Stop> {
        let row = &mut self.row;
        let half = 0.5 * step.h;
        for (forecast, (u, v)) in self.forecast.iter_mut().zip(row.u.iter().zip(&row.v)) {
            *forecast = u + half * v;
        }
        self.active.clear();
        row.shut(simd, &self.forecast, &mut self.shut);
        let active = |&k: &usize| Active { k, rate: row.rate(k), impulse: 0.0 };
        self.active.extend(self.shut.iter().map(active));
        tally.cost.evaluations += row.masses() + row.topology.gaps() as u64;
        let bend = half * half * row.stiffness;
        let lightness = 1.0 / (1.0 + bend);
        let (phases, later) = (row.phases, Bodies::phases_of(step));
        let scale = half * lightness;
        let waves = |i: usize| {
            let ((sin, cos), (later_sin, later_cos)) = (phases[i], later[i]);
            [scale * (cos + later_cos), scale * (sin + later_sin)]
        };
        let pull = -step.h * row.stiffness * lightness;
        row.fly([(1.0 - bend) * lightness, pull], waves, [half, half]);
        row.phases = later;
        if self.active.is_empty() && self.touching.is_empty() {
            return Ok(());
        }
        self.solve(lightness);
        let row = &mut self.row;
        for gap in &self.active {
            push(&row.topology, gap.k, half * gap.impulse * lightness, &mut row.u);
        }
        // A gap with an impulse that had none in the last step has an impact.
        let pressed = || self.active.iter().filter(|gap| gap.impulse > 0.0);
        let before = std::mem::take(&mut self.touching);
        self.touching = pressed().map(|gap| gap.k).collect();
        for gap in pressed().filter(|gap| !before.contains(&gap.k)) {
            tally.impact(gap.k, step.from.after(half).time(), (-gap.rate).max(0.0))?;
        }
        Ok(())
    }
}

impl Impulses {
    /// Solves for the impulses of the active gaps by projected Gauss–Seidel.
    fn solve(&mut self, lightness: f64) {
        let row = &mut self.row;
        for _ in 0..SWEEPS {
            let (mut change, mut largest) = (0.0f64, 0.0f64);
            for gap in &mut self.active {
                let [left, right] = row.topology.inverse_masses(gap.k);
                let lack = row.rate(gap.k) + row.restitution * gap.rate;
                let impulse = (gap.impulse - lack / ((left + right) * lightness)).max(0.0);
                let change_of_rate = (impulse - gap.impulse) * lightness;
                push(&row.topology, gap.k, change_of_rate, &mut row.v);
                change = change.max((impulse - gap.impulse).abs());
                largest = largest.max(impulse);
                gap.impulse = impulse;
            }
            if change <= CONVERGED * largest {
                break;
            }
        }
    }
}
