//! The part of the long run that report.html plays: a row of neighbouring masses, with all that is
//! needed to say in closed form where each of them is at any time.
//!
//! Which masses are shown is not a matter of taste: it is the row whose halves differ most in
//! impacts, so that moving freely and hitting are seen beside each other.

use super::SpaceTime;
use crate::params::Boundary;
use pxfm::{f_cos, f_sin};
use serde::Serialize;

/// Masses between the first and the last body, which are there as their neighbours.
const MASSES: usize = 20;

/// A row of bodies for a part of the run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Scene {
    /// ω and Ω.
    pub rates: [f64; 2],
    /// Distance d of the equilibria.
    pub spacing: f64,
    /// The first time.
    pub from: f64,
    /// The last time.
    pub until: f64,
    /// Number of the first body: masses count from 1, and 0 is the left wall.
    pub first: usize,
    /// Neighbours, from left to right.
    pub bodies: Vec<Body>,
    /// Time and gap of each impact between them; gap 0 has the first two bodies as its ends.
    pub impacts: Vec<(f64, usize)>,
}

/// A mass or a wall.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Body {
    /// Its equilibrium.
    pub rest: f64,
    /// Factors of cos Ωt and sin Ωt.
    pub forced: [f64; 2],
    /// (time, a, b): factors of cos ωt and sin ωt from that time on, the first for the beginning.
    pub free: Vec<(f64, f64, f64)>,
}

impl Body {
    /// Where it is.
    fn position(&self, [omega, big_omega]: [f64; 2], time: f64) -> f64 {
        let since = self.free.partition_point(|(since, ..)| *since <= time);
        let (_, a, b) = self.free.get(since.max(1) - 1).copied().unwrap_or_default();
        let (own, driven) = (omega * time, big_omega * time);
        self.rest
            + a * f_cos(own)
            + b * f_sin(own)
            + self.forced[0] * f_cos(driven)
            + self.forced[1] * f_sin(driven)
    }
}

impl Scene {
    /// The scene of a run; None on a ring, which has no first mass, and without saved motions.
    pub fn of(run: &SpaceTime) -> Option<Scene> {
        let (chain, saved) = (&run.parameters.chain, &run.scene);
        if chain.boundary != Boundary::Walls || saved.free.len() != chain.masses {
            return None;
        }
        let (omega, big_omega) = (chain.natural_frequency, chain.forcing_frequency);
        let stiffness = omega * omega - big_omega * big_omega;
        let mut counts = vec![0; run.width()];
        saved.events.iter().for_each(|event| counts[event.gap as usize] += 1);
        let first = busy_beside_quiet(&counts, MASSES.min(chain.masses) + 1);
        let gaps = MASSES.min(chain.masses) + 1;
        let body = |number: usize| {
            let rest = number as f64 * chain.spacing;
            let Some(j) = number.checked_sub(1).filter(|j| *j < chain.masses) else {
                return Body { rest, forced: [0.0; 2], free: vec![(saved.from, 0.0, 0.0)] };
            };
            let [alpha, beta] = saved.forcing[j];
            let after = saved.events.iter().flat_map(|event| {
                let own = event.after.iter().filter(move |(mass, ..)| *mass as usize == j);
                own.map(|&(_, a, b)| (event.time, a, b))
            });
            let begin = (saved.from, saved.free[j][0], saved.free[j][1]);
            let free = std::iter::once(begin).chain(after).collect();
            Body { rest, forced: [alpha / stiffness, beta / stiffness], free }
        };
        let impacts = saved.events.iter().filter_map(|event| {
            let gap = (event.gap as usize).checked_sub(first).filter(|gap| *gap < gaps)?;
            Some((event.time, gap))
        });
        Some(Scene {
            rates: [omega, big_omega],
            spacing: chain.spacing,
            from: saved.from,
            until: saved.until,
            first,
            bodies: (first..=first + gaps).map(body).collect(),
            impacts: impacts.collect(),
        })
    }

    /// Where each body is.
    pub fn positions(&self, time: f64) -> Vec<f64> {
        self.bodies.iter().map(|body| body.position(self.rates, time)).collect()
    }

    /// Number of impacts of each gap.
    pub fn counts(&self) -> Vec<usize> {
        let mut counts = vec![0; self.bodies.len().saturating_sub(1)];
        self.impacts.iter().for_each(|(_, gap)| counts[*gap] += 1);
        counts
    }

    /// Impacts of the left and of the right half; a gap in the middle belongs to neither.
    pub fn halves(&self) -> [usize; 2] {
        halves(&self.counts())
    }

    /// Numbers of the first and the last mass that is not there as a neighbour.
    pub fn masses(&self) -> [usize; 2] {
        [self.first + 1, self.first + self.bodies.len().saturating_sub(2)]
    }
}

fn halves(counts: &[usize]) -> [usize; 2] {
    let half = counts.len() / 2;
    [counts[..half].iter().sum(), counts[counts.len() - half..].iter().sum()]
}

/// Where the row of `length` gaps begins whose halves differ most in impacts; the first of equals.
fn busy_beside_quiet(counts: &[usize], length: usize) -> usize {
    let (mut found, mut most) = (0, 0);
    for (first, row) in counts.windows(length).enumerate() {
        let [left, right] = halves(row);
        if left.abs_diff(right) > most {
            (found, most) = (first, left.abs_diff(right));
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_row_lies_where_quiet_turns_into_busy() {
        assert_eq!(busy_beside_quiet(&[0, 0, 0, 0, 1, 5, 5, 5, 4], 5), 2);
        assert_eq!(halves(&[0, 0, 1, 5, 5]), [0, 10]);
        assert_eq!(busy_beside_quiet(&[2, 2, 2, 2], 3), 0);
    }

    #[test]
    fn a_body_moves_as_its_last_event_says() {
        let free = vec![(1.0, 0.5, 0.0), (2.0, 0.0, 0.25)];
        let body = Body { rest: 3.0, forced: [0.125, 0.0], free };
        let close = |t: f64, x: f64| (body.position([1.0, 2.0], t) - x).abs() < 1e-15;
        assert!(close(1.5, 3.0 + 0.5 * 1.5_f64.cos() + 0.125 * 3.0_f64.cos()));
        assert!(close(2.0, 3.0 + 0.25 * 2.0_f64.sin() + 0.125 * 4.0_f64.cos()));
    }
}
