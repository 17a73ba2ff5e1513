//! Holds what chains have in common that are simulated side by side.

use crate::topology::Topology;
use crate::{Boundary, Chain, HitGaps};

/// What chains side by side have in common. Lengths in units of d, times of 1/ω.
#[derive(Clone, Debug)]
pub struct Plan {
    pub omega: f64,
    /// ρ = Ω/ω.
    pub ratio: f64,
    pub restitution: f64,
    /// Length h of a step, half of it, and h²/8.
    pub step: f64,
    pub half: f64,
    pub eighth: f64,
    /// Unit of speeds, d ω.
    pub speed: f64,
    /// Number of the first gap in results.
    pub first: usize,
    /// For each gap those that share a mass with it; `usize::MAX` if there is none.
    pub neighbours: Vec<[usize; 2]>,
    /// For each gap the parts of its jump by which the rates of the gap before it, itself and the
    /// gap after it go back.
    pub weights: Vec<[f64; 4]>,
    pub ring: bool,
    /// A chain ends once so many gaps were hit after this time.
    pub end: (HitGaps, f64),
}

impl Plan {
    pub fn new(chain: &Chain, length: f64) -> Plan {
        let topology = Topology::new(chain.masses, chain.boundary);
        let step = chain.natural_frequency * length;
        let gaps = 0..topology.gaps();
        // The masses beside the gap jump by half of its jump each, or one by all at a wall.
        let weights = |gap| {
            let [left, right] = topology.inverse_masses(gap);
            [left / (left + right), -1.0, right / (left + right), 0.0]
        };
        let neighbours =
            |gap| topology.adjacent(gap).map(|near: Option<usize>| near.unwrap_or(usize::MAX));
        Plan {
            omega: chain.natural_frequency,
            ratio: chain.forcing_frequency / chain.natural_frequency,
            restitution: chain.restitution,
            step,
            half: 0.5 * step,
            eighth: step * step / 8.0,
            speed: chain.spacing * chain.natural_frequency,
            first: topology.label(0),
            neighbours: gaps.clone().map(neighbours).collect(),
            weights: gaps.map(weights).collect(),
            ring: chain.boundary == Boundary::Ring,
            end: (HitGaps::All, f64::INFINITY),
        }
    }
}
