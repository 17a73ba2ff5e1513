//! Simulates by sampling gaps on a grid of times; Newton's method finds zeros between.

use super::flights::{Flights, is_open};
use super::forcing::Component;
use super::method::Task;
use super::rival::{Rival, Run, Stepper, Stop, Tally, run_steps};
use super::steps::Step;
use crate::Error;
use crate::flight::length;
use crate::impact::share_change;
use crate::search::clock::{Instant, Rate};
use crate::topology::Topology;
use fearless_simd::{Simd, prelude::*};
use impact_numerics::roots::crossing;

/// Flight in closed form; every gap is sampled with a fixed step. One that is below M₂ h²/8 at an
/// end of the step, with M₂ a bound of its second derivative, is looked at: whether it is negative
/// at the end, or is lowest within the step and negative there. Newton's method goes to the zero
/// from a parabola, within a bracket.
///
/// - Source: the bracketing of every textbook (Press et al., Numerical Recipes, sec. 9.4);
///   simulations of impacting oscillators are mostly written so.
/// - Order: none; an impact that is found is accurate to rounding, and the step decides whether it
///   is found.
/// - Fails: three zeros within a step are taken for one, often the wrong one; after an impact, two
///   zeros within a step are taken for one. A chatter has infinitely many impacts in a finite time:
///   the bound on work ends the run there, unless a least rebound speed is given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampled {
    /// Time h between two samples.
    pub step: f64,
    /// The least speed with which an impact opens its gap.
    pub least_rebound: f64,
}

impl Rival for Sampled {
    const NAME: &'static str = "sampled";

    fn begin(&self, task: Task) -> Result<Run, Error> {
        let gaps = Gaps::new(task, self.least_rebound)?;
        let (least_rebound, number) = (self.least_rebound, gaps.topology.gaps() as u64);
        let rates = gaps.parts.iter().map(|part| part.rate).collect();
        let run = run_steps(task, self.step, rates, gaps)?;
        Ok(Box::new(move |tally| {
            tally.limit_chatter(least_rebound);
            tally.cost.evaluations += number;
            run(tally)
        }))
    }
}

/// Terms of the Taylor polynomial about the middle of a step, within which no phase advances by
/// more than 1: the next is below 1e-17 of an amplitude.
const TERMS: usize = 18;

/// Terms for the first correction.
const ROUGH: usize = 8;

/// Gaps in a word of bits; a multiple of the numbers in a register.
const WORD: usize = 64;

/// A correction by Newton's method below this, in units of time, leaves less than rounding.
const CONVERGED: f64 = 1e-11;

/// The most corrections; after them the bracket counts.
const CORRECTIONS: usize = 60;

/// The part of all gaps at one frequency: their amplitudes of cosine and sine.
struct Part {
    frequency: f64,
    rate: Rate,
    cos: Vec<f64>,
    sin: Vec<f64>,
    /// Powers of the frequency over factorials.
    factors: [f64; TERMS],
}

/// A zero of a gap within the step.
#[derive(Clone, Copy)]
struct Root {
    /// Time after the beginning of the step.
    time: f64,
    gap: usize,
    closing_speed: f64,
}

/// The gaps of a chain, from step to step.
struct Gaps {
    topology: Topology,
    spacing: f64,
    restitution: f64,
    least_rebound: f64,
    /// The free part first. Gaps that fill the last register never close.
    parts: Vec<Part>,
    /// M₂ h²/8 of each gap: how far it may be below the chord of a step.
    sag: Vec<f64>,
    h: f64,
    /// Terms of the polynomial that a step of this length needs.
    terms: usize,
    /// The gaps below M₂ h²/8 at the end of the step, a bit each.
    low: Vec<u64>,
    /// (sin, cos) at the beginning of the step, or at the last impact.
    phases_now: Vec<(f64, f64)>,
    phases_at_middle: Vec<(f64, f64)>,
    /// Half the advance of each phase in a step, as (sin, cos).
    half_step_angles: Vec<(f64, f64)>,
    /// The first zero of each gap that closes in the rest of the step.
    roots: Vec<Root>,
}

impl Gaps {
    fn new(task: Task, least_rebound: f64) -> Result<Gaps, Error> {
        let Flights { topology, spacing, restitution, omega, free, forced, .. } =
            Flights::new(task)?;
        let gaps = topology.gaps();
        let length = gaps.next_multiple_of(8);
        let begin = Instant::at(task.start.time);
        let part = |frequency: f64, amplitudes: &dyn Fn(usize) -> [f64; 2]| {
            let [mut cos, mut sin] = [0, 1].map(|_| vec![0.0; length]);
            for k in 0..gaps {
                let [left, right] = topology.sides(k).map(amplitudes);
                (cos[k], sin[k]) = (right[0] - left[0], right[1] - left[1]);
            }
            let mut factor = 1.0;
            let factors = std::array::from_fn(|i| {
                let now = factor;
                factor *= frequency / (i + 1) as f64;
                now
            });
            Part { frequency, rate: Rate::new(frequency), cos, sin, factors }
        };
        let mut parts = vec![part(omega, &|m| free[m])];
        for Component { frequency, cos, sin, .. } in &forced {
            parts.push(part(*frequency, &|m| [cos[m], sin[m]]));
        }
        Ok(Gaps {
            topology,
            spacing,
            restitution,
            least_rebound,
            sag: vec![-1.0; length],
            h: 0.0,
            terms: TERMS,
            low: vec![u64::MAX; length.div_ceil(WORD)],
            phases_now: parts.iter().map(|part| part.rate.sin_cos(begin)).collect(),
            phases_at_middle: vec![(0.0, 1.0); parts.len()],
            half_step_angles: vec![(0.0, 1.0); parts.len()],
            roots: Vec::new(),
            parts,
        })
    }

    /// Returns M₂ h²/8 of gap k, with M₂ the bound of its curvature.
    fn sag(&self, k: usize) -> f64 {
        let bound_of_curvature =
            |part: &Part| part.frequency * part.frequency * length([part.cos[k], part.sin[k]]);
        let forced = self.parts[1..].iter().map(bound_of_curvature).sum::<f64>();
        (forced + bound_of_curvature(&self.parts[0])) * self.h * self.h / 8.0
    }

    fn set_step(&mut self, h: f64) {
        self.h = h;
        for (half, part) in self.half_step_angles.iter_mut().zip(&self.parts) {
            *half = part.rate.sin_cos(Instant::at(0.5 * h));
        }
        let needed = |part: &Part| {
            let powers = std::iter::successors(Some(1.0), |power| Some(0.5 * h * power));
            let terms = part.factors.iter().zip(powers).map(|(factor, power)| power * factor);
            terms.take_while(|&term| term > 1e-18).count()
        };
        self.terms = self.parts.iter().map(needed).fold(ROUGH, usize::max);
        for k in 0..self.topology.gaps() {
            self.sag[k] = self.sag(k);
        }
    }

    /// Samples all gaps at the end of a step and looks at those that are or were low.
    #[inline(always)]
    fn sample<S: Simd>(&mut self, simd: S, step: &Step, tally: &mut Tally) {
        let width = S::f64s::LEN;
        for word in 0..self.low.len() {
            let (first, mut low) = (WORD * word, 0);
            for begin in (first..self.sag.len().min(first + WORD)).step_by(width) {
                let row = |row: &[f64]| S::f64s::from_slice(simd, &row[begin..begin + width]);
                let mut f = S::f64s::splat(simd, self.spacing);
                for (part, &(sin, cos)) in self.parts.iter().zip(step.phases) {
                    f += row(&part.cos) * cos + row(&part.sin) * sin;
                }
                low |= f.simd_lt(row(&self.sag)).to_bitmask() << (begin - first);
            }
            let mut look = low | std::mem::replace(&mut self.low[word], low);
            while look != 0 {
                let k = first + look.trailing_zeros() as usize;
                look &= look - 1;
                if k < self.topology.gaps() {
                    let start = self.width_and_rate(k, &self.phases_now);
                    self.locate(k, 0.0, start, step, tally);
                }
            }
        }
    }

    #[inline(always)]
    fn width_and_rate(&self, k: usize, phases: &[(f64, f64)]) -> [f64; 2] {
        let parts = self.parts.iter().zip(phases);
        parts.fold([self.spacing, 0.0], |[f, rate], (part, (sin, cos))| {
            let [a, b] = [part.cos[k], part.sin[k]];
            [f + (a * cos + b * sin), rate + part.frequency * (b * cos - a * sin)]
        })
    }

    /// Searches the rest of the step for the zero of gap k; `start` is its width and rate at the
    /// time `from`.
    fn locate(&mut self, k: usize, from: f64, start: [f64; 2], step: &Step, tally: &mut Tally) {
        tally.cost.evaluations += 2;
        let mut end = self.width_and_rate(k, step.phases);
        if start[0] <= 0.0 && start[1] < 0.0 {
            self.roots.push(Root { time: from, gap: k, closing_speed: -start[1] });
            return;
        }
        let ends_open = is_open(end[0], end[1], self.spacing);
        let may_dip = end[1] > 0.0 && start[1] < 0.0;
        if ends_open && !may_dip {
            return;
        }
        let half = 0.5 * self.h;
        let (mut low, mut high) = (from - half, half);
        let polynomial = polynomial(self, k);
        let value = |x: f64| evaluate(&polynomial, x, self.terms);
        if ends_open {
            // A convex gap stays open if the tangents at both ends meet above zero. Their height
            // there is this over start[1] − end[1] < 0.
            let scaled_height =
                (end[0] * start[1] - start[0] * end[1]) - (high - low) * end[1] * start[1];
            if scaled_height < 0.0 {
                return;
            }
            high = crossing([low, high], 1e-12 * self.h, |x| {
                tally.cost.evaluations += 1;
                value(x)[1]
            });
            end = value(high);
            if end[0] >= 0.0 {
                return;
            }
        }
        let [p0, p1, p2, p3, p4, p5, ..] = polynomial;
        let inside = (p1 * p1 - 4.0 * p0 * p2).max(0.0);
        let mut x = -2.0 * p0 / (p1 - inside.sqrt());
        let (mut moved, mut rate) = (f64::INFINITY, end[1]);
        for turn in 0..CORRECTIONS {
            // A step to an end, outside or to NaN is replaced by a bisection.
            if !(x > low && x < high) {
                x = 0.5 * (low + high);
            }
            let [f, slope] = if turn == 0 { evaluate(&polynomial, x, ROUGH) } else { value(x) };
            tally.cost.evaluations += 1;
            if turn > 0 {
                *if f > 0.0 { &mut low } else { &mut high } = x;
            }
            let next = if slope < 0.0 { x - f / slope } else { f64::NAN };
            let curvature = 2.0 * p2 + x * (6.0 * p3 + x * (12.0 * p4 + x * 20.0 * p5));
            rate = slope + curvature * (next - x);
            (moved, x) = ((next - x).abs(), next);
            if moved <= CONVERGED && turn > 0 || high - low <= f64::EPSILON * self.h {
                break;
            }
        }
        if moved.is_nan() || moved > CONVERGED {
            (x, rate) = (low, value(low)[1]);
        }
        self.roots.push(Root { time: x + half, gap: k, closing_speed: (-rate).max(0.0) });
    }

    fn hit(&mut self, root: Root, step: &Step, tally: &mut Tally) {
        let Root { time, gap: k, closing_speed } = root;
        let rebound = (self.restitution * closing_speed).max(self.least_rebound);
        let instant = step.from.after(time);
        for (now, part) in self.phases_now.iter_mut().zip(&self.parts) {
            *now = part.rate.sin_cos(instant);
        }
        let (sin, cos) = self.phases_now[0];
        let jumps = share_change(closing_speed + rebound, self.topology.inverse_masses(k));
        let [before, after] = self.topology.adjacent(k);
        let changes = [(Some(k), jumps[1] - jumps[0]), (before, jumps[0]), (after, -jumps[1])];
        for (j, change) in changes {
            let Some(j) = j else { continue };
            let kick = change / self.parts[0].frequency;
            self.parts[0].cos[j] -= kick * sin;
            self.parts[0].sin[j] += kick * cos;
        }
        self.roots.retain(|root| changes.iter().all(|(j, _)| *j != Some(root.gap)));
        for j in std::iter::once(k).chain(self.topology.near(k)) {
            self.sag[j] = self.sag(j);
            let low = u64::from(self.width_and_rate(j, step.phases)[0] < self.sag[j]) << (j % WORD);
            self.low[j / WORD] = self.low[j / WORD] & !(1 << (j % WORD)) | low;
            let start =
                if j == k { [0.0, rebound] } else { self.width_and_rate(j, &self.phases_now) };
            self.locate(j, time, start, step, tally);
        }
    }
}

/// Returns the Taylor polynomial of gap k about the middle of a step.
#[inline(always)]
fn polynomial(gaps: &Gaps, k: usize) -> [f64; TERMS] {
    let mut terms = [0.0; TERMS];
    terms[0] = gaps.spacing;
    for (part, (sin, cos)) in gaps.parts.iter().zip(&gaps.phases_at_middle) {
        let [a, b] = [part.cos[k], part.sin[k]];
        let (u, q) = (a * cos + b * sin, b * cos - a * sin);
        let derivatives = [u, q, -u, -q];
        for (i, (term, factor)) in terms.iter_mut().zip(&part.factors).enumerate() {
            *term += derivatives[i % 4] * factor;
        }
    }
    terms
}

/// Evaluates a gap and its rate by the first `terms` terms, even powers apart from odd.
#[inline(always)]
fn evaluate(polynomial: &[f64; TERMS], x: f64, terms: usize) -> [f64; 2] {
    let square = x * x;
    let [mut even, mut odd, mut even_rate, mut odd_rate] = [0.0; 4];
    for pair in (0..terms.div_ceil(2)).rev() {
        even_rate = even_rate * square + even;
        odd_rate = odd_rate * square + odd;
        even = even * square + polynomial[2 * pair];
        odd = odd * square + polynomial[2 * pair + 1];
    }
    // With E and O in x²: f = E + x O, f' = 2 x E' + O + 2 x² O'.
    [even + x * odd, odd + 2.0 * (x * even_rate + square * odd_rate)]
}

impl Stepper for Gaps {
    #[inline(always)]
    fn step<S: Simd>(&mut self, simd: S, step: &Step, tally: &mut Tally) -> Result<(), Stop> {
        if step.h != self.h {
            self.set_step(step.h);
        }
        let ends = step.phases.iter().zip(&self.half_step_angles);
        let middles = self.phases_at_middle.iter_mut();
        for (middle, ((sin, cos), (half_sin, half_cos))) in middles.zip(ends) {
            *middle = (sin * half_cos - cos * half_sin, cos * half_cos + sin * half_sin);
        }
        tally.cost.evaluations += self.topology.gaps() as u64;
        self.sample(simd, step, tally);
        let earlier = |a: Root, b: Root| if b.time < a.time { b } else { a };
        while let Some(root) = self.roots.iter().copied().reduce(earlier) {
            self.hit(root, step, tally);
            tally.event(root.gap, step.from.after(root.time).time(), root.closing_speed)?;
        }
        self.phases_now.copy_from_slice(step.phases);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Chain, Initial, Scenario, State};

    /// M₂ = 0.5 + 4 · 0.1, and at x = Ωh/2 as many terms xⁿ/n! as are above 1e-18.
    #[test]
    fn a_step_needs_few_terms() {
        let scenario =
            Scenario::given(&Chain { masses: 1, ..Chain::default() }, vec![[0.18, 0.24]]);
        let initial = Initial::Free(vec![[0.3, 0.4]]);
        let scenario = Scenario { forcing_frequency: 2.0, initial, ..scenario.unwrap() };
        let task =
            Task { scenario: &scenario, start: &State::from_scenario(&scenario), until: 1.0 };
        let mut gaps = Gaps::new(task, 0.0).unwrap();
        for (h, terms) in [(0.5, 16), (0.1, 11), (1e-3, ROUGH)] {
            gaps.set_step(h);
            assert_eq!(gaps.terms, terms, "{h}");
            assert!((gaps.sag[0] - 0.9 * h * h / 8.0).abs() < 1e-16, "{h}: {}", gaps.sag[0]);
        }
    }
}
