//! Describes the chain of Sec. 2: its masses, its ends and its start, without the forcing.

#[cfg(feature = "serde")]
use serde::{Deserialize, Serialize};

/// What stands at the ends of the chain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(Deserialize, Serialize), serde(rename_all = "lowercase"))]
pub enum Boundary {
    /// Rigid walls at 0 and (n + 1) d: n + 1 gaps (Fig. 1).
    Walls,
    /// Mass n is the left neighbour of mass 1: n gaps, all alike.
    Ring,
}

impl Boundary {
    /// Returns the number of gaps of n masses, the N of Sec. 3: n + 1 between walls, n on a ring.
    #[must_use]
    pub fn gaps(self, masses: usize) -> usize {
        match self {
            Boundary::Walls => masses + 1,
            Boundary::Ring => masses,
        }
    }
}

/// The start of a realisation (Sec. 2 leaves it open; Sec. 8 assumes [`Start::Random`]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(Deserialize, Serialize), serde(rename_all = "lowercase"))]
pub enum Start {
    /// At rest at equilibrium, when the forcing sets in.
    Rest,
    /// On the forced response, without a free part.
    Zero,
    /// With a free part whose two amplitudes are normal with standard deviation σ.
    Random,
}

/// The chain of Sec. 2, without the amplitudes of its forcing.
///
/// **Eq. (4)** (step towards (2)): the scaling d = m = ω = 1 is this type's default.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(Deserialize, Serialize))]
pub struct Chain {
    /// Number of masses n, at least 1 (Sec. 2: 100).
    pub masses: usize,
    /// Distance d between equilibria, from 1e-6 to 1e6 (Sec. 2: 1).
    pub spacing: f64,
    /// Natural frequency ω in radians per unit of time, from 1e-3 to 1e3 (Sec. 2: 1).
    pub natural_frequency: f64,
    /// Forcing frequency Ω, likewise, and not ω (Sec. 2: √2).
    pub forcing_frequency: f64,
    /// Coefficient of restitution r, from 0 to 1 (Sec. 2: 0.8).
    pub restitution: f64,
    /// Walls or ring (Fig. 1: walls).
    pub boundary: Boundary,
    /// The start (ours: rest).
    pub start: Start,
}

impl Default for Chain {
    fn default() -> Self {
        Chain {
            masses: 100,
            spacing: 1.0,
            natural_frequency: 1.0,
            forcing_frequency: std::f64::consts::SQRT_2,
            restitution: 0.8,
            boundary: Boundary::Walls,
            start: Start::Rest,
        }
    }
}

impl Chain {
    /// Returns its number of gaps, N.
    #[must_use]
    pub fn gaps(&self) -> usize {
        self.boundary.gaps(self.masses)
    }
}
