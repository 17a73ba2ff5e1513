//! Defines a scenario: one chain, its forcing and its start.

use crate::error::{Error, check_pairs};
use crate::flight::response;
use crate::{Boundary, Chain, Start};
#[cfg(feature = "random")]
use impact_numerics::random::NormalPairs;

/// The start of a scenario at t = 0.
#[derive(Clone, Debug, PartialEq)]
pub enum Initial {
    /// At rest at the places of equilibrium.
    Rest,
    /// Given free parts (a_j, b_j): x_j = j d + a_j cos ωt + b_j sin ωt + forced response.
    Free(Vec<[f64; 2]>),
}

/// The largest number of components of the forcing.
pub const COMPONENTS: usize = 8;

/// Draws one pair of normals with standard deviation `sigma` for each mass.
#[cfg(feature = "random")]
pub(crate) fn draw_pairs(masses: usize, sigma: f64, normals: &mut NormalPairs) -> Vec<[f64; 2]> {
    (0..masses).map(|_| normals.pair().map(|x| sigma * x)).collect()
}

/// One chain with the amplitudes of its forcing.
///
/// **Eq. (3)**: the forcing is a sum over components; the paper goes on with one, Eq. (5).
#[derive(Clone, Debug, PartialEq)]
#[must_use]
pub struct Scenario {
    /// Distance d between equilibria, the unit of lengths, from 1e-6 to 1e6.
    pub spacing: f64,
    /// Natural frequency ω in radians per unit of time, from 1e-3 to 1e3.
    pub natural_frequency: f64,
    /// Forcing frequency Ω, likewise; not ω.
    pub forcing_frequency: f64,
    /// Coefficient of restitution r, from 0 (no rebound) to 1 (elastic).
    pub restitution: f64,
    /// What stands at the ends.
    pub boundary: Boundary,
    /// The start.
    pub initial: Initial,
    /// Amplitudes (α_j, β_j) of Eq. (5), one pair for each mass; accelerations, as masses are 1.
    pub forcing: Vec<[f64; 2]>,
    /// Further components of the forcing, Eq. (3); the paper has none.
    pub overtones: Vec<Overtone>,
    /// Equilibria of left wall, masses 1..n and right wall, or `None` if they are j d, as in the
    /// paper. A constant force F on a mass shifts its place by F/ω². On a ring the walls' have no
    /// meaning.
    pub places: Option<Vec<f64>>,
}

/// A further component of the forcing.
#[derive(Clone, Debug, PartialEq)]
pub struct Overtone {
    /// Its frequency Ω, from 1e-3 to 1e3, not ω.
    pub frequency: f64,
    /// Amplitudes (α_j, β_j), one pair for each mass.
    pub amplitudes: Vec<[f64; 2]>,
}

impl Scenario {
    /// **Eq. (5)**
    ///
    /// Draws the amplitudes α_j, β_j of the forcing α_j cos Ωt + β_j sin Ωt with standard
    /// deviation `sigma` from `normals`: first the n pairs of the forcing, then, for a random
    /// start, the n pairs of the free part.
    #[cfg(feature = "random")]
    pub fn draw(chain: &Chain, sigma: f64, normals: &mut NormalPairs) -> Scenario {
        let mut scenario = Scenario::with_forcing(chain, draw_pairs(chain.masses, sigma, normals));
        if chain.start == Start::Random {
            scenario.initial = Initial::Free(draw_pairs(chain.masses, sigma, normals));
        }
        scenario
    }

    /// Creates the scenario of a chain with given amplitudes, one pair for each mass;
    /// [`Start::Random`] is taken as [`Start::Zero`], as there are no random numbers.
    ///
    /// # Errors
    /// Those of [`Scenario::validate`].
    pub fn given(chain: &Chain, forcing: Vec<[f64; 2]>) -> Result<Scenario, Error> {
        check_pairs("forcing", &forcing, chain.masses)?;
        let scenario = Scenario::with_forcing(chain, forcing);
        scenario.validate()?;
        Ok(scenario)
    }

    fn with_forcing(chain: &Chain, forcing: Vec<[f64; 2]>) -> Scenario {
        let initial = match chain.start {
            Start::Rest => Initial::Rest,
            Start::Zero | Start::Random => Initial::Free(vec![[0.0; 2]; forcing.len()]),
        };
        Scenario {
            spacing: chain.spacing,
            natural_frequency: chain.natural_frequency,
            forcing_frequency: chain.forcing_frequency,
            restitution: chain.restitution,
            boundary: chain.boundary,
            initial,
            forcing,
            overtones: Vec::new(),
            places: None,
        }
    }

    /// Returns its chain, with the start left out: places and overtones have no part in it.
    pub fn chain(&self) -> Chain {
        Chain {
            masses: self.forcing.len(),
            spacing: self.spacing,
            natural_frequency: self.natural_frequency,
            forcing_frequency: self.forcing_frequency,
            restitution: self.restitution,
            boundary: self.boundary,
            ..Chain::default()
        }
    }

    /// Returns the place of equilibrium of body m: a mass, or a wall (0 or n + 1).
    /// Panics if `places` has no place of this body.
    #[must_use]
    pub fn place(&self, m: usize) -> f64 {
        self.places.as_ref().map_or(m as f64 * self.spacing, |places| places[m])
    }

    /// Returns the distance of the place of body m from m d.
    pub(crate) fn shift(&self, m: usize) -> f64 {
        self.place(m) - m as f64 * self.spacing
    }

    /// Returns the free part (a, b) of mass j, counted from 0.
    pub(crate) fn free_part(&self, j: usize) -> [f64; 2] {
        if let Initial::Free(parts) = &self.initial {
            return parts[j];
        }
        let w = self.natural_frequency;
        self.components().fold([0.0; 2], |[a, b], (big_w, amplitudes)| {
            let [c, s] = response(w, big_w, amplitudes[j]);
            [a - c, b - big_w / w * s]
        })
    }

    /// Lists the components of the forcing: frequency, and amplitudes of each mass.
    pub fn components(&self) -> impl Iterator<Item = (f64, &[[f64; 2]])> {
        let further = self.overtones.iter().map(|o| (o.frequency, o.amplitudes.as_slice()));
        std::iter::once((self.forcing_frequency, self.forcing.as_slice())).chain(further)
    }

    #[cfg(feature = "methods")]
    pub(crate) fn fastest(&self) -> f64 {
        self.components().fold(self.natural_frequency, |fastest, (big_w, _)| fastest.max(big_w))
    }

    /// Returns the frequencies of the forcing, filled up to `M` with the first.
    pub(super) fn frequencies<const M: usize>(&self) -> [f64; M] {
        let mut components = self.components().map(|(frequency, _)| frequency);
        std::array::from_fn(|_| components.next().unwrap_or(self.forcing_frequency))
    }

    /// Returns the amplitudes (α_j, β_j) of mass j, counted from 0, filled up to `M` with zeros.
    pub(super) fn amplitudes<const M: usize>(&self, j: usize) -> [[f64; 2]; M] {
        let mut components = self.components().map(|(_, amplitudes)| amplitudes[j]);
        std::array::from_fn(|_| components.next().unwrap_or_default())
    }

    /// Returns the number of gaps, N.
    #[must_use]
    pub fn gaps(&self) -> usize {
        self.boundary.gaps(self.forcing.len())
    }

    /// Returns the amplitudes of cos ωt, sin ωt, cos Ωt and sin Ωt of each gap, in units of d.
    #[cfg(any(feature = "ensembles", feature = "methods"))]
    pub(crate) fn gap_amplitudes(&self) -> Vec<[f64; 4]> {
        let topology = crate::topology::Topology::new(self.forcing.len(), self.boundary);
        let mut bodies = vec![[0.0; 4]; self.forcing.len() + 2];
        for (j, forces) in self.forcing.iter().enumerate() {
            let [a, b] = self.free_part(j);
            let [c, d] = response(self.natural_frequency, self.forcing_frequency, *forces);
            bodies[j + 1] = [a, b, c, d];
        }
        let gap = |gap| {
            let [left, right] = topology.sides(gap).map(|body| bodies[body]);
            std::array::from_fn(|i| (right[i] - left[i]) / self.spacing)
        };
        (0..topology.gaps()).map(gap).collect()
    }
}
