//! Finds the neighbours of masses and gaps.

use crate::Boundary;

/// Neighbours of masses 1..=n and gaps 0..N inside the engine; bodies 0 and n + 1 are the walls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Topology {
    masses: usize,
    boundary: Boundary,
}

impl Topology {
    pub fn new(masses: usize, boundary: Boundary) -> Self {
        Topology { masses, boundary }
    }

    pub fn gaps(&self) -> usize {
        self.boundary.gaps(self.masses)
    }

    /// Returns the number of gap k in results: 0..=n between walls, 1..=n on a ring.
    #[inline]
    pub fn label(&self, k: usize) -> usize {
        match self.boundary {
            Boundary::Walls => k,
            Boundary::Ring => k + 1,
        }
    }

    #[inline]
    pub fn sides(&self, k: usize) -> [usize; 2] {
        match self.boundary {
            Boundary::Walls => [k, k + 1],
            Boundary::Ring => [k + 1, if k + 1 == self.masses { 1 } else { k + 2 }],
        }
    }

    /// Returns the gaps (before, after) that share a mass with gap k.
    #[inline]
    pub fn adjacent(&self, k: usize) -> [Option<usize>; 2] {
        let last = self.gaps() - 1;
        match self.boundary {
            Boundary::Walls => [k.checked_sub(1), (k < last).then_some(k + 1)],
            Boundary::Ring if last == 0 => [None, None],
            Boundary::Ring => {
                [Some(if k == 0 { last } else { k - 1 }), Some(if k == last { 0 } else { k + 1 })]
            }
        }
    }

    /// Lists the gaps that share a mass with gap k, each once.
    #[inline]
    pub fn near(&self, k: usize) -> impl Iterator<Item = usize> + Clone + use<> {
        let [before, after] = self.adjacent(k);
        before.into_iter().chain(after.filter(|_| before != after))
    }

    #[inline]
    pub fn is_wall(&self, m: usize) -> bool {
        m == 0 || m > self.masses
    }

    #[inline]
    pub fn inverse_masses(&self, k: usize) -> [f64; 2] {
        self.sides(k).map(|m| if self.is_wall(m) { 0.0 } else { 1.0 })
    }
}
