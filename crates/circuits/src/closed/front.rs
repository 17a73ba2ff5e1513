//! How soon the mass at an edge reaches a neighbour that was never hit.
//!
//! Ahead of a front masses move as they have from rest, which is known: with X = F/D the amplitude of the forced motion, Re X e^{iΩt}, the
//! free part that cancels it at t = 0 has the amplitude |z|, z = (Re X, (Ω/ω) Im X). The mass at the edge has the motion that its force keeps
//! up, and a random one of variance s² = u²/ω², normal, which each of its impacts draws afresh. So the gap between them is d − h(t) less
//! the random part, with
//!
//! h = R cos Ωt′ + |z| cos ωt″,   R = |X_edge − X|,
//!
//! and closes, by Rice's argument, at the rate
//!
//! λ = ⟨ exp(−(d − h)²/2s²)/(√(2π) s) · E(W + h′)₊ ⟩,
//!
//! averaged over both phases, with W normal of variance u². The forces, and with them R, |z| and u², do not change. So each gap has its own
//! λ, and a front waits for it; of many gaps a share ⟨e^{−λt}⟩ takes longer than t, which falls the more slowly the longer it lasts.
//!
//! Rice counts all closings, not first ones. They are too many by those that follow each other on one draw, and too few by
//! the sure first swing after a mass was hit for the first time. Both have been tried: see [`spread`](super::spread).

use super::masses::Edge;
use impact_chain::Chain;
use std::f64::consts::{FRAC_1_SQRT_2, PI, TAU};

/// Phases of each frequency, an even number.
const PHASES: usize = 12;

/// Cosines and sines at which the rate is averaged.
#[derive(Clone, Debug)]
pub struct Phases {
    points: Vec<[f64; 2]>,
}

impl Phases {
    /// In the middles of equal parts.
    pub fn new() -> Self {
        Self::of(PHASES)
    }

    fn of(number: usize) -> Self {
        let point = |i: usize| {
            let (sin, cos) = pxfm::f_sincos(TAU * (i as f64 + 0.5) / number as f64);
            [cos, sin]
        };
        Phases { points: (0..number).map(point).collect() }
    }
}

impl Default for Phases {
    fn default() -> Self {
        Self::new()
    }
}

/// λ, the rate at which the mass at an edge reaches a neighbour that was never hit and has this force; a wall has none.
pub fn rate(phases: &Phases, chain: &Chain, edge: &Edge, [alpha, beta]: [f64; 2]) -> f64 {
    let (omega, big_omega) = (chain.natural_frequency, chain.forcing_frequency);
    let detuning = omega * omega - big_omega * big_omega;
    let (cos, sin) = (alpha / detuning, -beta / detuning);
    let apart = [edge.kept[0] - cos, edge.kept[1] - sin];
    let forced = (apart[0] * apart[0] + apart[1] * apart[1]).sqrt();
    let turned = big_omega / omega * sin;
    let free = (cos * cos + turned * turned).sqrt();
    let speed = edge.square.sqrt();
    let width = speed / omega;
    let mut sum = 0.0;
    // Opposite phases of both turn h′ and nothing else: E(W + h′)₊ + E(W − h′)₊ = 2φ + k erf(k/√2) in units of u, k = h′/u.
    for [cos, sin] in &phases.points[..phases.points.len() / 2] {
        for [free_cos, free_sin] in &phases.points {
            let left = (chain.spacing - forced * cos - free * free_cos) / width;
            let k = (big_omega * forced * sin + omega * free * free_sin) / speed;
            let flux = 2.0 * pxfm::f_exp(-0.5 * k * k) / TAU.sqrt()
                + k * pxfm::f_erf(k * FRAC_1_SQRT_2);
            sum += pxfm::f_exp(-0.5 * left * left) * flux;
        }
    }
    sum / (phases.points.len() as f64).powi(2) * omega / (2.0 * PI).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use impact_numerics::random::NormalPairs;

    #[test]
    fn without_motion_ahead_it_is_rice_s_formula() {
        let phases = Phases::new();
        let chain = Chain { natural_frequency: 1.4, spacing: 0.8, ..Chain::default() };
        let edge = Edge { square: 0.3, kept: [0.0; 2] };
        let level = 0.8 * 1.4 / 0.3_f64.sqrt();
        let expected = 1.4 / TAU * (-0.5 * level * level).exp();
        assert!((rate(&phases, &chain, &edge, [0.0; 2]) / expected - 1.0).abs() < 1e-12);
    }

    #[test]
    fn more_phases_change_little() {
        let (few, many, chain) = (Phases::new(), Phases::of(80), Chain::default());
        for (square, kept, force) in [
            (0.3, [0.1, 0.1], [0.1, -0.2]),
            (0.08, [0.2, -0.1], [0.15, 0.15]),
            (0.5, [-0.3, 0.0], [0.3, 0.1]),
        ] {
            let edge = Edge { square, kept };
            let [a, b] = [&few, &many].map(|own| rate(own, &chain, &edge, force));
            assert!((a / b - 1.0).abs() < 1e-2, "{square}: {a} {b}");
        }
    }

    /// The second route: random motions of one frequency and their closings, counted.
    #[test]
    fn motions_that_are_drawn_close_as_often() {
        let chain = Chain::default();
        let (edge, [alpha, beta]) = (Edge { square: 0.25, kept: [-0.1, 0.2] }, [0.12, -0.1]);
        let mut normals = NormalPairs::new("test of fronts", 1, 0);
        let (mut closings, mut time) = (0_u32, 0.0);
        let step = 0.01;
        for draw in 0..1500 {
            let [a, b] = normals.pair().map(|x| 0.5 * x);
            let start = 10.0 * f64::from(draw) * 1.618;
            let gap = |t: f64| {
                let (sin, cos) = pxfm::f_sincos(t);
                let (forced_sin, forced_cos) = pxfm::f_sincos(chain.forcing_frequency * t);
                let own = edge.kept[0] * forced_cos - edge.kept[1] * forced_sin + a * cos + b * sin;
                // From rest: −α (cos Ωt − cos t) − β (sin Ωt − Ω sin t).
                let ahead = -alpha * (forced_cos - cos)
                    - beta * (forced_sin - chain.forcing_frequency * sin);
                1.0 + ahead - own
            };
            let mut before = gap(start);
            for i in 1..=3000 {
                let now = gap(start + step * f64::from(i));
                closings += u32::from(before > 0.0 && now <= 0.0);
                before = now;
            }
            time += 30.0;
        }
        let found = f64::from(closings) / time;
        let expected = rate(&Phases::new(), &chain, &edge, [alpha, beta]);
        assert!((found / expected - 1.0).abs() < 0.06, "{found} {expected}");
    }
}
