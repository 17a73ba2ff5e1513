//! The contact forces of a run of shut gaps: a linear complementarity problem.

use super::flight::Phases;
use super::force::Force;
use impact_numerics::local_frame::Frequencies;

/// Which gaps of a run stay shut, and with which contact force.
///
/// Gap i accelerates by g_i + K_i λ_i − λ_{i−1} − λ_{i+1}, where K_i is `stiffness` and λ_i ≥ 0 the contact force; a shut gap needs
/// acceleration ≥ 0, and λ_i = 0 where it is > 0. The matrix is an M-matrix, so starting from the
/// gaps with g_i < 0 and adding every gap that would be driven shut ends at the solution after at
/// most as many rounds as there are gaps (Chandrasekaran, 1970, Opsearch 7, 263).
///
/// Gaps that are not `allowed` stay open. Returns for each gap λ_i, or `None`.
pub fn contact_forces<const M: usize>(
    g: &[Force<M>],
    stiffness: &[f64],
    allowed: &[bool],
    p: &Phases<M>,
    frequencies: &Frequencies<M>,
) -> Vec<Option<Force<M>>> {
    // An acceleration shuts a gap when it is negative. Where several gaps are released at once, by a symmetry, those of
    // the others are zero but for rounding, and what it makes of their sign must not press them again.
    let n = g.len();
    let pushes = |i: usize| g[i].falls(g[i].size(), p, frequencies);
    let mut active: Vec<bool> = (0..n).map(|i| allowed[i] && pushes(i)).collect();
    loop {
        let forces = solve(g, stiffness, &active);
        let mut grown = false;
        for i in (0..n).filter(|&i| allowed[i]) {
            if active[i] {
                continue;
            }
            let (mut total, mut size) = (g[i], g[i].size());
            for j in [i.wrapping_sub(1), i + 1] {
                if let Some(&Some(force)) = forces.get(j) {
                    total = total - force;
                    size += force.size();
                }
            }
            if total.falls(size, p, frequencies) {
                active[i] = true;
                grown = true;
            }
        }
        if !grown {
            return forces;
        }
    }
}

/// λ of the active gaps from g + A λ = 0: elimination along each run of adjacent active gaps.
fn solve<const M: usize>(
    g: &[Force<M>],
    stiffness: &[f64],
    active: &[bool],
) -> Vec<Option<Force<M>>> {
    let n = g.len();
    let mut forces = vec![None; n];
    // Forward: λ_i = (r_i + λ_{i+1}) / m_i.
    let mut pivots = vec![(0.0, Force::ZERO); n];
    for i in (0..n).filter(|&i| active[i]) {
        let mut pivot = stiffness[i];
        let mut right = -g[i];
        if i > 0 && active[i - 1] {
            let (m, r) = pivots[i - 1];
            pivot -= 1.0 / m;
            right = right + r / m;
        }
        pivots[i] = (pivot, right);
    }
    for i in (0..n).rev().filter(|&i| active[i]) {
        let next = forces.get(i + 1).copied().flatten().unwrap_or(Force::ZERO);
        let (m, r) = pivots[i];
        forces[i] = Some((r + next) / m);
    }
    forces
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The constant parts of the contact forces for constant accelerations `g`.
    fn forces_of(g: &[f64], stiffness: &[f64]) -> Vec<Option<f64>> {
        let g: Vec<_> = g.iter().map(|&x| Force { constant: x, ..Force::ZERO }).collect();
        let p = Phases { sin: 0.0, cos: 1.0, forced: [[0.0, 1.0]] };
        let frequencies = Frequencies::new(1.0, [1.4]);
        let forces = contact_forces(&g, stiffness, &vec![true; g.len()], &p, &frequencies);
        forces.into_iter().map(|force| Some(force?.constant)).collect()
    }

    /// Three masses: the force in gap 1 is −(2 g1 + g2)/3.
    #[test]
    fn a_neighbour_holds_a_gap_shut() {
        let forces = forces_of(&[1.0, -2.5], &[2.0, 2.0]);
        assert!((forces[0].unwrap() - (-(2.0 - 2.5) / 3.0)).abs() < 1e-15);
        assert!((forces[1].unwrap() - (-(1.0 - 5.0) / 3.0)).abs() < 1e-15);
        let forces = forces_of(&[1.0, -1.5], &[2.0, 2.0]);
        assert!(forces[0].is_none());
        assert!((forces[1].unwrap() - 0.75).abs() < 1e-15);
    }

    /// Complementarity holds for every sign pattern of a run against a wall.
    #[test]
    fn complementarity() {
        let stiffness = [1.0, 2.0, 2.0, 2.0, 1.0];
        for pattern in 0..3u32.pow(5) {
            let g: Vec<f64> = (0..5)
                .map(|i| {
                    [-1.3, 0.4, 2.1][(pattern / 3u32.pow(i)) as usize % 3] + 0.01 * f64::from(i)
                })
                .collect();
            if g.iter().sum::<f64>() <= 0.0 {
                continue; // Two walls pressed together: excluded by (n + 1) d > 0.
            }
            let forces = forces_of(&g, &stiffness);
            let lambda: Vec<f64> = forces.iter().map(|f| f.unwrap_or_default()).collect();
            for i in 0..5 {
                let left = if i > 0 { lambda[i - 1] } else { 0.0 };
                let right = lambda.get(i + 1).copied().unwrap_or(0.0);
                let a = g[i] + stiffness[i] * lambda[i] - left - right;
                assert!(lambda[i] >= -1e-12 && a >= -1e-12, "{g:?}: {lambda:?}");
                assert!((lambda[i] * a).abs() < 1e-9);
            }
        }
    }
}
