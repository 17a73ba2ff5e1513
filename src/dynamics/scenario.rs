//! A scenario: one chain, its forcing and its start, complete and checked.

use super::Error;
use crate::numerics::random::NormalPairs;
use crate::params::{Boundary, Chain, Start};

/// The start of one scenario.
#[derive(Clone, Debug, PartialEq)]
pub enum Initial {
    /// At rest at equilibrium.
    Rest,
    /// No free part.
    Zero,
    /// Given free parts (a_j, b_j): x_j = j d + a_j cos ωt + b_j sin ωt + forced response.
    Free(Vec<[f64; 2]>),
}

/// One chain with the amplitudes of its forcing.
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    /// Distance d between equilibria.
    pub spacing: f64,
    /// Natural frequency ω.
    pub natural_frequency: f64,
    /// Forcing frequency Ω.
    pub forcing_frequency: f64,
    /// Coefficient of restitution r.
    pub restitution: f64,
    /// Walls or ring.
    pub boundary: Boundary,
    /// The start.
    pub initial: Initial,
    /// Amplitudes (α_j, β_j) of Eq. (5), one pair a mass.
    pub forcing: Vec<[f64; 2]>,
}

impl Scenario {
    /// Draws the amplitudes of Eq. (5) with standard deviation `sigma` from `normals`: first the
    /// n pairs of the forcing, then, for a random start, the n pairs of the free part.
    pub fn draw(chain: &Chain, sigma: f64, normals: &mut NormalPairs) -> Scenario {
        let mut pairs = || -> Vec<[f64; 2]> {
            (0..chain.masses)
                .map(|_| {
                    let [x, y] = normals.pair();
                    [sigma * x, sigma * y]
                })
                .collect()
        };
        let forcing = pairs();
        let initial = match chain.start {
            Start::Rest => Initial::Rest,
            Start::Zero => Initial::Zero,
            Start::Random => Initial::Free(pairs()),
        };
        Scenario {
            spacing: chain.spacing,
            natural_frequency: chain.natural_frequency,
            forcing_frequency: chain.forcing_frequency,
            restitution: chain.restitution,
            boundary: chain.boundary,
            initial,
            forcing,
        }
    }

    /// Reads a scenario from JSON (the form is in `impact-paper trace --help`).
    ///
    /// # Errors
    /// [`Error::Input`] names the field and the remedy.
    pub fn from_json(_text: &str) -> Result<Scenario, Error> {
        todo!()
    }

    /// Number of gaps.
    pub fn gaps(&self) -> usize {
        match self.boundary {
            Boundary::Walls => self.forcing.len() + 1,
            Boundary::Ring => self.forcing.len(),
        }
    }
}
