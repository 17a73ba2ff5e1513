//! Runs the chain of Sec. 2 in absolute time: two plain free amplitudes a mass, changed by impacts.

use super::gap::Gap;
use super::{Dd, sin_cos};
use impact_chain::{Boundary, Initial, Scenario, State};

#[derive(Clone, Debug)]
pub struct Hit {
    pub time: Dd,
    /// The gap, in the numbering of the engine.
    pub gap: usize,
    /// −Δ' just before.
    pub closing_speed: Dd,
}

#[derive(Clone, Debug)]
pub struct Reference {
    spacing: Dd,
    /// ω and each Ω.
    frequencies: Vec<Dd>,
    restitution: Dd,
    ring: bool,
    /// Free amplitudes (a, b) of each mass, then its forced ones, as the frequencies.
    masses: Vec<Vec<[Dd; 2]>>,
    /// Time until which each gap has no root, and whether it has one then; on a ring gap 0 is none.
    next: Vec<(Dd, bool)>,
    /// The time of the last impact.
    pub time: Dd,
}

/// How far a search looks ahead: most gaps are disturbed by a neighbour before.
const AHEAD: f64 = 2.0;

impl Reference {
    /// Sets a scenario at t = 0, every double taken as the exact number that it is.
    pub fn new(scenario: &Scenario) -> Self {
        let w = Dd::from(scenario.natural_frequency);
        let components: Vec<_> =
            scenario.components().map(|(big_w, pairs)| (Dd::from(big_w), pairs)).collect();
        let masses: Vec<Vec<[Dd; 2]>> = (0..scenario.forcing.len())
            .map(|j| {
                let mut mass = vec![[Dd::ZERO; 2]];
                for &(big_w, amplitudes) in &components {
                    let factor = w * w - big_w * big_w;
                    let [alpha, beta] = amplitudes[j].map(|x| Dd::from(x) / factor);
                    // At rest the free part cancels place and velocity of the response.
                    if scenario.initial == Initial::Rest {
                        let [a, b] = mass[0];
                        mass[0] = [a - alpha, b - beta * big_w / w];
                    }
                    mass.push([alpha, beta]);
                }
                if let Initial::Free(free) = &scenario.initial {
                    mass[0] = free[j].map(Dd::from);
                }
                mass
            })
            .collect();
        let ring = scenario.boundary == Boundary::Ring;
        let next = vec![(Dd::ZERO, false); masses.len() + 1];
        Reference {
            spacing: Dd::from(scenario.spacing),
            restitution: Dd::from(scenario.restitution),
            frequencies: std::iter::once(w).chain(components.into_iter().map(|c| c.0)).collect(),
            ring,
            masses,
            next,
            time: Dd::ZERO,
        }
    }

    /// Sets a chain at the time of a state, every double taken as the exact number that it is.
    pub fn at(scenario: &Scenario, start: &State) -> Self {
        let mut chain = Reference::new(scenario);
        let t = Dd::from(start.time);
        let w = chain.frequencies[0];
        let [s, c] = sin_cos(w * t);
        chain.masses.iter_mut().for_each(|mass| mass[0] = [Dd::ZERO; 2]);
        for (j, [x, v]) in chain.state(t).into_iter().enumerate() {
            let place = Dd::from((j + 1) as f64) * chain.spacing;
            let u = Dd::from(start.positions[j]) - place - x;
            let rate = (Dd::from(start.velocities[j]) - v) / w;
            chain.masses[j][0] = [u * c - rate * s, u * s + rate * c];
        }
        chain.next.fill((t, false));
        chain.time = t;
        chain
    }

    /// The masses on both sides of a gap; a wall is none.
    pub fn sides(&self, gap: usize) -> [Option<usize>; 2] {
        let n = self.masses.len();
        let right = if self.ring { Some(gap % n) } else { (gap < n).then_some(gap) };
        [gap.checked_sub(1), right]
    }

    pub fn gap(&self, gap: usize) -> Gap {
        let [left, right] = self.sides(gap);
        let part = |which: usize, i: usize| {
            let of = |mass: Option<usize>| mass.map_or(Dd::ZERO, |j| self.masses[j][which][i]);
            of(right) - of(left)
        };
        Gap {
            spacing: self.spacing,
            frequencies: self.frequencies.clone(),
            amplitudes: (0..self.frequencies.len()).map(|m| [part(m, 0), part(m, 1)]).collect(),
        }
    }

    /// d + Q1 + Q2: the amplitudes of both neighbours of a gap, which all its roundings follow.
    pub fn scale(&self, gap: usize) -> f64 {
        let sides = self.sides(gap).into_iter().flatten();
        let lengths = sides.flat_map(|j| &self.masses[j]).map(|[a, b]| a.hi.hypot(b.hi));
        self.spacing.hi + lengths.sum::<f64>()
    }

    /// Displacement from equilibrium, and velocity, of each mass at a time of the present flight.
    pub fn state(&self, t: Dd) -> Vec<[Dd; 2]> {
        let motion = |mass: &Vec<[Dd; 2]>| {
            let (frequencies, amplitudes) = (self.frequencies.clone(), mass.clone());
            let [x, v, _] = Gap { spacing: Dd::ZERO, frequencies, amplitudes }.jet(t);
            [x, v]
        };
        self.masses.iter().map(motion).collect()
    }

    /// The next impact up to a time, which is then carried out; none if there is none.
    pub fn step(&mut self, until: Dd) -> Result<Option<Hit>, String> {
        loop {
            let gaps = usize::from(self.ring)..self.next.len();
            let earlier = |a: usize, b: usize| if self.next[b].0 < self.next[a].0 { b } else { a };
            let gap = gaps.clone().fold(gaps.start, earlier);
            let (time, is_root) = self.next[gap];
            if time > until || !is_root && time == until {
                return Ok(None);
            }
            if is_root {
                return Ok(Some(self.impact(gap, time)));
            }
            let ahead = time + Dd::from(AHEAD);
            let ahead = if ahead < until { ahead } else { until };
            let root = self.gap(gap).first_root(time, ahead);
            let root = root.map_err(|error| format!("gap {gap}: {error}"))?;
            self.next[gap] = (root.unwrap_or(ahead), root.is_some());
        }
    }

    pub fn run(&mut self, until: f64) -> Result<Vec<Hit>, String> {
        let until = Dd::from(until);
        let mut hits = Vec::new();
        while let Some(hit) = self.step(until)? {
            hits.push(hit);
        }
        Ok(hits)
    }

    fn impact(&mut self, gap: usize, time: Dd) -> Hit {
        let [_, closing, _] = self.gap(gap).jet(time);
        let sides = self.sides(gap);
        let between = sides.iter().all(Option::is_some);
        let share = Dd::from(if between { 0.5 } else { 1.0 });
        let kick = -(Dd::from(1.0) + self.restitution) * closing * share;
        for (mass, sign) in sides.into_iter().zip([-1.0, 1.0]) {
            let Some(mass) = mass else { continue };
            let w = self.frequencies[0];
            let [s, c] = sin_cos(w * time);
            let rate = Dd::from(sign) * kick / w;
            let [a, b] = self.masses[mass][0];
            self.masses[mass][0] = [a - rate * s, b + rate * c];
        }
        self.time = time;
        for other in 0..self.next.len() {
            if self.sides(other).iter().flatten().any(|mass| sides.contains(&Some(*mass))) {
                self.next[other] = (time, false);
            }
        }
        Hit { time, gap, closing_speed: -closing }
    }
}
