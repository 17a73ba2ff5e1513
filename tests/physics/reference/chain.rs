//! The chain of Sec. 2 in absolute time: two plain free amplitudes a mass, changed by impacts.

use super::gap::Gap;
use super::real::Real;
use impact_chain::{Initial, Scenario, State};
use impact_paper::params::Boundary;

/// One impact.
#[derive(Clone, Debug)]
pub struct Hit<R> {
    /// Time t.
    pub time: R,
    /// The gap, in the numbering of the engine.
    pub gap: usize,
    /// −Δ' just before.
    pub closing_speed: R,
}

/// The result of the search of a gap: no root before the time, or a root at it.
#[derive(Clone, Debug)]
enum Next<R> {
    None,
    NoRootUntil(R),
    Root(R),
}

/// A chain at a time.
#[derive(Clone, Debug)]
pub struct Reference<R> {
    spacing: R,
    /// ω and each Ω.
    frequencies: Vec<R>,
    restitution: R,
    ring: bool,
    /// Free amplitudes (a, b) of each mass, then its forced ones, as the frequencies.
    masses: Vec<Vec<[R; 2]>>,
    /// One entry a gap of the engine's numbering; on a ring entry 0 stays idle.
    next: Vec<Next<R>>,
    time: R,
}

/// How far a search looks ahead: most gaps are disturbed by a neighbour before.
const AHEAD: f64 = 2.0;

impl<R: Real> Reference<R> {
    /// Sets a scenario at t = 0, every double taken as the exact number that it is.
    pub fn new(scenario: &Scenario) -> Self {
        let w = R::of(scenario.natural_frequency);
        let overtones = scenario.overtones.iter().map(|o| (o.frequency, &o.amplitudes));
        let components: Vec<(R, &Vec<[f64; 2]>)> =
            std::iter::once((scenario.forcing_frequency, &scenario.forcing))
                .chain(overtones)
                .map(|(big_w, amplitudes)| (R::of(big_w), amplitudes))
                .collect();
        let masses = (0..scenario.forcing.len()).map(|j| {
            let mut mass = vec![[R::of(0.0), R::of(0.0)]];
            for (big_w, amplitudes) in &components {
                let factor = w.clone() * w.clone() - big_w.clone() * big_w.clone();
                let [alpha, beta] = amplitudes[j].map(|x| R::of(x) / factor.clone());
                // At rest the free part cancels place and velocity of the response.
                if scenario.initial == Initial::Rest {
                    let [a, b] = mass[0].clone();
                    mass[0] = [a - alpha.clone(), b - beta.clone() * big_w.clone() / w.clone()];
                }
                mass.push([alpha, beta]);
            }
            if let Initial::Free(free) = &scenario.initial {
                mass[0] = free[j].map(R::of);
            }
            mass
        });
        let masses: Vec<_> = masses.collect();
        let ring = scenario.boundary == Boundary::Ring;
        let mut chain = Reference {
            spacing: R::of(scenario.spacing),
            restitution: R::of(scenario.restitution),
            frequencies: std::iter::once(w).chain(components.into_iter().map(|c| c.0)).collect(),
            ring,
            next: Vec::new(),
            masses,
            time: R::of(0.0),
        };
        chain.next = (0..=chain.masses.len())
            .map(|gap| {
                let idle = ring && gap == 0;
                if idle { Next::None } else { Next::NoRootUntil(R::of(0.0)) }
            })
            .collect();
        chain
    }

    /// Sets a chain at the time of a state, every double taken as the exact number that it is.
    pub fn at(scenario: &Scenario, start: &State) -> Self {
        let mut chain: Reference<R> = Reference::new(scenario);
        let t = R::of(start.time);
        let w = chain.frequencies[0].clone();
        let (s, c) = (w.clone() * t.clone()).sin_cos();
        for mass in &mut chain.masses {
            mass[0] = [R::of(0.0), R::of(0.0)];
        }
        for (j, [x, v]) in chain.state(&t).into_iter().enumerate() {
            let place = R::of((j + 1) as f64) * chain.spacing.clone();
            let u = R::of(start.positions[j]) - place - x;
            let rate = (R::of(start.velocities[j]) - v) / w.clone();
            chain.masses[j][0] = [
                u.clone() * c.clone() - rate.clone() * s.clone(),
                u * s.clone() + rate * c.clone(),
            ];
        }
        chain.next.fill(Next::NoRootUntil(t.clone()));
        chain.time = t;
        chain
    }

    /// The masses on both sides of a gap; a wall is none.
    pub fn sides(&self, gap: usize) -> [Option<usize>; 2] {
        let n = self.masses.len();
        let right = if self.ring { Some(gap % n) } else { (gap < n).then_some(gap) };
        [gap.checked_sub(1), right]
    }

    /// A gap with the amplitudes that it has now.
    pub fn gap(&self, gap: usize) -> Gap<R> {
        let [left, right] = self.sides(gap);
        let part = |which: usize, i: usize| {
            let of =
                |mass: Option<usize>| mass.map_or(R::of(0.0), |j| self.masses[j][which][i].clone());
            of(right) - of(left)
        };
        Gap {
            spacing: self.spacing.clone(),
            frequencies: self.frequencies.clone(),
            amplitudes: (0..self.frequencies.len()).map(|m| [part(m, 0), part(m, 1)]).collect(),
        }
    }

    /// Free and forced amplitudes of a mass, counted from 0.
    pub fn mass(&self, j: usize) -> &[[R; 2]] {
        &self.masses[j]
    }

    /// d + Q1 + Q2: the amplitudes of both neighbours of a gap, which all its roundings follow.
    pub fn scale(&self, gap: usize) -> f64 {
        let sides = self.sides(gap).into_iter().flatten();
        let lengths = sides.flat_map(|j| &self.masses[j]).map(|[a, b]| a.near().hypot(b.near()));
        self.spacing.near() + lengths.sum::<f64>()
    }

    /// Displacement from equilibrium, and velocity, of each mass at a time of the present flight.
    pub fn state(&self, t: &R) -> Vec<[R; 2]> {
        let one = |mass: &Vec<[R; 2]>| {
            let gap = Gap {
                spacing: R::of(0.0),
                frequencies: self.frequencies.clone(),
                amplitudes: mass.clone(),
            };
            let [x, v, _] = gap.jet(t);
            [x, v]
        };
        self.masses.iter().map(one).collect()
    }

    /// Time of the last impact.
    pub fn time(&self) -> &R {
        &self.time
    }

    /// The next impact up to a time, which is then carried out; none if there is none.
    pub fn step(&mut self, until: &R) -> Result<Option<Hit<R>>, String> {
        loop {
            let mut first: Option<(usize, R, bool)> = None;
            for (gap, next) in self.next.iter().enumerate() {
                let (time, root) = match next {
                    Next::None => continue,
                    Next::NoRootUntil(time) => (time, false),
                    Next::Root(time) => (time, true),
                };
                if first.as_ref().is_none_or(|(_, earliest, _)| time < earliest) {
                    first = Some((gap, time.clone(), root));
                }
            }
            let Some((gap, time, root)) = first else { return Ok(None) };
            if time > *until || (!root && time == *until) {
                return Ok(None);
            }
            if root {
                return Ok(Some(self.impact(gap, time)));
            }
            let shape = self.gap(gap);
            let ahead = time.clone() + R::of(AHEAD);
            let ahead = if ahead < *until { ahead } else { until.clone() };
            self.next[gap] = if shape.never_closes() {
                Next::None
            } else {
                let found =
                    shape.first_root(&time, &ahead).map_err(|e| format!("gap {gap}: {e}"))?;
                found.map_or(Next::NoRootUntil(ahead), Next::Root)
            };
        }
    }

    /// All impacts up to a time.
    pub fn run(&mut self, until: f64) -> Result<Vec<Hit<R>>, String> {
        let until = R::of(until);
        let mut hits = Vec::new();
        while let Some(hit) = self.step(&until)? {
            hits.push(hit);
        }
        Ok(hits)
    }

    fn impact(&mut self, gap: usize, time: R) -> Hit<R> {
        let [_, closing, _] = self.gap(gap).jet(&time);
        let sides = self.sides(gap);
        let between = sides.iter().all(Option::is_some);
        let share = R::of(if between { 0.5 } else { 1.0 });
        let kick = -(R::of(1.0) + self.restitution.clone()) * closing.clone() * share;
        for (mass, sign) in sides.into_iter().zip([-1.0, 1.0]) {
            let Some(mass) = mass else { continue };
            let w = &self.frequencies[0];
            let (s, c) = (w.clone() * time.clone()).sin_cos();
            let rate = R::of(sign) * kick.clone() / w.clone();
            let [a, b] = self.masses[mass][0].clone();
            self.masses[mass][0] = [a - rate.clone() * s, b + rate * c];
        }
        self.time = time.clone();
        for other in self.touched(gap) {
            self.next[other] = Next::NoRootUntil(time.clone());
        }
        Hit { time, gap, closing_speed: -closing }
    }

    /// The gaps whose amplitudes an impact of `gap` changes.
    fn touched(&self, gap: usize) -> Vec<usize> {
        let n = self.masses.len();
        if self.ring {
            let before = if gap == 1 { n } else { gap - 1 };
            return vec![before, gap, gap % n + 1];
        }
        (gap.saturating_sub(1)..=(gap + 1).min(n)).collect()
    }
}
