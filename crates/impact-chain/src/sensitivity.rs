//! How the times of impacts change with the strength of the forcing: derivatives through impacts.
//!
//! Let all amplitudes of the forcing be multiplied by λ. If they were drawn with standard deviation σ, from numbers that stay the same, then
//! d/dλ at λ = 1 is σ d/dσ, marked by ′ here. A start from rest has free parts that cancel the forced motion, and they are multiplied too.
//!
//! In flight motions are linear in their amplitudes, so each derivative is a motion itself. An impact changes it, for its time depends on λ
//! as well. At τ a gap Δ closes at the speed V = −Δ̇, and Δ(τ(λ), λ) = 0 for all λ, so that
//!
//! τ′ = Δ′/V, V′ = −(Δ̇′ + Δ̈ τ′), where Δ′ and Δ̇′ are at a fixed time.
//!
//! Each mass gets a jump J of its velocity in proportion to V, so J′ is to V′ as J to V. It adds (−sin ωτ, cos ωτ) J/ω to the free part (a, b), and by the
//! chain rule (−sin ωτ, cos ωτ) J′/ω − (cos ωτ, sin ωτ) J τ′ to (a′, b′): the derivative of the place jumps by −Jτ′, that of the velocity by J′.
//! This is the saltation matrix (M. A. Aizerman and F. R. Gantmakher, 1958; for impacts P. C. Müller, Chaos, Solitons & Fractals 5, 1671, 1995). Who
//! differentiates through the impact law alone leaves out the terms with τ′.
//!
//! The list of impacts is enough for it. There is no derivative where order or kind of the next impacts hangs on the sign of the change: when a gap
//! grazes (τ′ grows as 1/V), when a mass has its gaps closed on both sides at once, and in contact.

use super::contact::CONTACT_SPEED;
use super::flight::{Motion, Phases};
use super::impact::jumps;
use super::scenario::COMPONENTS;
use super::simulation::Simulation;
use super::{Engine, Error, Impact, Initial, Scenario, rounding};
use impact_numerics::clock::Instant;

/// The part of a derivative that rounding of one impact may take: where it could take more, the gap grazes. Rounding moves τ by E/V at
/// most, with E of [`rounding`]. From dV/dτ = −Δ̈ and dτ′/dτ = −V′/V follows that V loses the part |Δ̈| E/V², and that τ′ and V′ do where
/// V′ ≈ −Δ̈ τ′, as near a graze. Since Δ̈ may vanish by accident it counts as d ω² at least. What is differentiated is the run as
/// it is printed; how far that is the true one, [`certify`](super::certify()) estimates.
const LOST: f64 = 1e-4;

/// A mass with its derivative.
#[derive(Clone, Copy, Debug)]
struct Mass {
    motion: Motion<COMPONENTS>,
    derivative: Motion<COMPONENTS>,
    /// Time of its last impact.
    hit: f64,
}

/// The derivatives of a run: to be handed every impact, in order.
#[derive(Clone, Debug)]
pub struct Sensitivity {
    start: Simulation<COMPONENTS>,
    /// Masses 1..n; 0 and n + 1 are the walls.
    masses: Vec<Mass>,
    impacts: u64,
}

impl Sensitivity {
    /// At the start of a scenario.
    ///
    /// # Errors
    /// As [`Engine::new`](super::Engine::new), and [`Error::Input`] for a start in contact.
    pub fn new(scenario: &Scenario) -> Result<Self, Error> {
        let start = Simulation::new(scenario)?;
        if start.contact_phases > 0 {
            let problem = "the chain starts in contact, where impact times have no derivative";
            return Err(Error::input("initial", problem, "give a start with open gaps"));
        }
        let scaled = f64::from(u8::from(scenario.initial == Initial::Rest));
        let mass = |own: &Motion<COMPONENTS>| Mass {
            motion: *own,
            derivative: Motion { a: scaled * own.a, b: scaled * own.b, ..*own },
            hit: -1.0,
        };
        let masses = start.motions.iter().map(mass).collect();
        Ok(Sensitivity { start, masses, impacts: 0 })
    }

    /// Bytes that it takes for so many masses, besides the engine of the run.
    pub fn memory(masses: usize) -> u128 {
        Engine::memory(masses, COMPONENTS) + (masses * size_of::<Mass>()) as u128
    }

    /// τ′ of the next impact.
    ///
    /// # Errors
    /// [`Error::Input`] names an impact that has none.
    pub fn shift(&mut self, impact: &Impact) -> Result<f64, Error> {
        let Impact { time, closing_speed: speed, .. } = *impact;
        let start = &self.start;
        let topology = start.topology;
        let sides = topology.sides(impact.gap - topology.label(0));
        self.impacts += 1;
        let frequencies = &start.search.frequencies;
        let omega = frequencies.omega;
        let phases = Phases::at(&start.rates, Instant::at(time));
        let [left, right] = sides.map(|m| self.masses[m]);
        let gap = right.motion.minus(&left.motion).seen(&phases);
        let change = right.derivative.minus(&left.derivative).seen(&phases);
        let forced = gap.forced.iter().zip(frequencies.big_omegas);
        let acceleration = forced.fold(-omega * omega * gap.u, |sum, ([v, _], w)| sum - w * w * v);
        self.refused(impact, sides, acceleration)?;
        let shift = change.place() / speed;
        let faster = -(change.velocity(frequencies) + acceleration * shift);
        let inverse = sides.map(|m| topology.inverse_mass(m));
        let jumps = jumps(speed, start.restitution, inverse);
        for (m, jump) in sides.into_iter().zip(jumps) {
            let Mass { motion, derivative, hit } = &mut self.masses[m];
            motion.kick(jump / omega, &phases);
            derivative.kick(jump / omega * faster / speed, &phases);
            derivative.a -= jump * shift * phases.cos;
            derivative.b -= jump * shift * phases.sin;
            *hit = time;
        }
        Ok(shift)
    }

    /// Refuses an impact that has no derivative, or none that rounding leaves.
    fn refused(&self, impact: &Impact, sides: [usize; 2], acceleration: f64) -> Result<(), Error> {
        let Impact { time, gap, closing_speed } = *impact;
        let start = &self.start;
        let unit = start.spacing * start.search.frequencies.omega;
        let tied = sides.iter().any(|m| !start.topology.is_wall(*m) && self.masses[*m].hit == time);
        // Amplitudes may have grown since the start.
        let parts = sides.into_iter().flat_map(|m| {
            let Motion { a, b, forced, .. } = self.masses[m].motion;
            forced.into_iter().chain([[a, b]])
        });
        let size = start.spacing + parts.map(|[a, b]| (a * a + b * b).sqrt()).sum::<f64>();
        let width = rounding::TIME * f64::EPSILON * size;
        let curvature = acceleration.abs().max(unit * start.search.frequencies.omega);
        let problem = if LOST * closing_speed * closing_speed <= curvature * width {
            format!("gap {gap} grazes, at the closing speed {closing_speed:.1e}")
        } else if start.restitution * closing_speed <= CONTACT_SPEED * unit {
            format!("gap {gap} comes to rest, and may stay in contact")
        } else if tied {
            format!("gap {gap} closes together with a neighbour")
        } else {
            return Ok(());
        };
        let remedy = match self.impacts - 1 {
            0 => "leave out --sensitivity, since it is the first".into(),
            before => format!("--max-impacts {before} ends before it"),
        };
        let field = format!("impact {} at t = {time:?}", self.impacts);
        Err(Error::input(
            field,
            format!("{problem}, where impact times have no derivative that can be trusted"),
            remedy,
        ))
    }
}
