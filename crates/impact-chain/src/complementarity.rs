//! Solves the linear complementarity problem of the contact forces of a run of shut gaps.

use super::flight::Phases;
use super::force::Force;
use crate::search::local_frame::Frequencies;

/// Returns for each gap of a run its contact force λ_i, or `None` if it opens or is not `allowed`.
///
/// Gap i accelerates by g_i + K_i λ_i − λ_{i−1} − λ_{i+1}, where K_i is `inverse_mass` and λ_i ≥ 0
/// the contact force; a shut gap needs acceleration ≥ 0, and λ_i = 0 where it is > 0. The matrix is
/// an M-matrix, so starting from no gap and adding every gap that would be driven shut ends at the
/// solution after at most as many rounds as there are gaps (Chandrasekaran, 1970, Opsearch 7, 263).
pub fn contact_forces<const M: usize>(
    g: &[Force<M>],
    inverse_mass: &[f64],
    allowed: &[bool],
    p: &Phases<M>,
    frequencies: &Frequencies<M>,
) -> Vec<Option<Force<M>>> {
    let n = g.len();
    let mut shut = Shut { g, inverse_mass, allowed, p, frequencies, active: vec![false; n] };
    while !shut.grow() {}
    shut.forces()
}

/// The gaps that have so far been found to stay shut (`active`).
struct Shut<'a, const M: usize> {
    g: &'a [Force<M>],
    inverse_mass: &'a [f64],
    allowed: &'a [bool],
    p: &'a Phases<M>,
    frequencies: &'a Frequencies<M>,
    active: Vec<bool>,
}

impl<const M: usize> Shut<'_, M> {
    /// Adds gaps driven shut, in a sweep each way; returns true if none is left.
    fn grow(&mut self) -> bool {
        let n = self.g.len();
        self.spread(0..n);
        self.spread((0..n).rev());
        let forces = self.forces();
        let force = |i: usize| forces.get(i).copied().flatten().unwrap_or(Force::ZERO);
        let is_driven = |&i: &usize| self.is_driven(i, [force(i.wrapping_sub(1)), force(i + 1)]);
        let more: Vec<usize> = (0..n).filter(is_driven).collect();
        for &i in &more {
            self.active[i] = true;
        }
        more.is_empty()
    }

    /// Adds in turn each gap that the run before it drives shut, its last force a lower bound.
    fn spread(&mut self, order: impl Iterator<Item = usize>) {
        let mut last = None;
        for i in order {
            let force = last.map_or(Force::ZERO, |(pivot, right): (f64, Force<M>)| {
                right.zip(right, |x, _| x / pivot)
            });
            self.active[i] |= self.is_driven(i, [force, Force::ZERO]);
            last = self.active[i].then(|| self.eliminated(i, last));
        }
    }

    /// Returns whether an open gap is driven shut: by an acceleration that is negative beyond
    /// rounding, as those of gaps released together by a symmetry are zero up to rounding.
    fn is_driven(&self, i: usize, neighbours: [Force<M>; 2]) -> bool {
        let size = neighbours.iter().fold(self.g[i].size(), |size, force| size + force.size());
        // Elimination adds up the rounding of the gaps of a long run.
        let size = size * (self.g.len() as f64 / 8.0).max(1.0);
        let total =
            neighbours.into_iter().fold(self.g[i], |total, force| total.zip(force, |a, b| a - b));
        let open = self.allowed[i] && !self.active[i];
        open && total.falls(size, self.p, self.frequencies)
    }

    /// Returns pivot m and right side r of gap i after those before, λ_i = (r + λ_{i+1})/m.
    fn eliminated(&self, i: usize, last: Option<(f64, Force<M>)>) -> (f64, Force<M>) {
        let (k, g) = (self.inverse_mass[i], self.g[i]);
        let right = g.zip(g, |x, _| -x);
        last.map_or((k, right), |(m, r)| (k - 1.0 / m, right.zip(r, |a, b| a + b / m)))
    }

    /// Solves g + A λ = 0 for the active gaps, by elimination along each run of adjacent ones.
    fn forces(&self) -> Vec<Option<Force<M>>> {
        let n = self.g.len();
        let mut pivots = Vec::with_capacity(n);
        let mut last = None;
        for i in 0..n {
            last = self.active[i].then(|| self.eliminated(i, last));
            pivots.push(last);
        }
        let mut forces = vec![None; n];
        let mut next = Force::ZERO;
        for (force, pivot) in forces.iter_mut().zip(pivots).rev() {
            *force = pivot.map(|(m, r)| r.zip(next, |a, b| (a + b) / m));
            next = force.unwrap_or(Force::ZERO);
        }
        forces
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::search::clock::Instant;

    /// Outer gaps press with 1 each on one that accelerates by 2, but for 5 · 8 ε, or 20 · 8 ε.
    #[test]
    fn an_acceleration_by_rounding_shuts_no_gap() {
        let frequencies = Frequencies::new(1.0, [2.0]);
        let p = Phases::at(&frequencies, Instant::ZERO);
        let outer = Force { constant: -1.0, forced: [[-1.0, 0.0]] };
        for (gaps, part, is_shut) in
            [(3, 36.0, false), (3, 44.0, true), (32, 144.0, false), (32, 176.0, true)]
        {
            let middle = Force { constant: 1.0 - part * f64::EPSILON, forced: [[1.0, 1.0]] };
            let mut g = vec![outer, middle, outer];
            g.resize(gaps, Force::ZERO);
            let allowed: Vec<bool> = (0..gaps).map(|gap| gap < 3).collect();
            let forces = contact_forces(&g, &vec![2.0; gaps], &allowed, &p, &frequencies);
            assert_eq!(forces[1].is_some(), is_shut, "{part}: {forces:?}");
        }
    }
}
