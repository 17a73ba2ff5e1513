//! Reflects neighbours under equal forces in elastic impacts (r = 1), which conserve the energy of
//! their relative motion. In periodic orbits an equal rounding in every period would add up.
//!
//! The impact reflects the relative free part X = (a, b) in the direction n = (−sin ωt, cos ωt) of
//! the kick: X' = X − 2 n (n·X)/(n·n). In double-doubles this keeps |X| to 1e−31, whatever the
//! rounding of n, which is turned to the instant at which the motions close the gap, some 1e−16
//! from the root that was found: the rounding of the search moves one impact and none after it.

use super::flight::Phases;
use super::simulation::Simulation;
use impact_numerics::double_double::DoubleDouble;

/// Closing speed, in units of d ω, below which a gap's frame is more accurate than the motions.
const LEAST_SPEED: f64 = 1e-3;

impl<const M: usize> Simulation<M> {
    /// Returns whether the impact of gap k conserves the energy of its neighbours' free motion, so
    /// that [`Self::reflect`] carries it out.
    #[inline(always)]
    pub(super) fn is_reflected(&self, k: usize, speed: f64) -> bool {
        self.restitution == 1.0 && {
            let [left, right] = self.topology.sides(k);
            speed > LEAST_SPEED * self.spacing * self.search.frequencies.omega
                && self.forced[left] == self.forced[right]
        }
    }

    /// Carries out the impact of gap k at `speed` where it conserves energy.
    #[cold]
    pub(super) fn reflect(&mut self, k: usize, speed: f64, phases: &Phases<M>) {
        let w = self.search.frequencies.omega;
        let sides = self.topology.sides(k);
        let [left, right] = sides.map(|m| self.free_part(m));
        let [a, b] = [right[0] - left[0], right[1] - left[1]];
        let [sin, cos] = [phases.sin, phases.cos].map(DoubleDouble::from);
        // |n|² − 1.
        let excess = (sin * sin + cos * cos - DoubleDouble::ONE).to_f64();
        let free_width = a * cos + b * sin;
        let [left_shift, right_shift] = sides.map(|m| self.shifts[m]);
        let width_at_rest = self.spacing + (right_shift - left_shift);
        let width = (free_width + DoubleDouble::from(width_at_rest)).to_f64()
            - 0.5 * excess * free_width.hi;
        let delay = width / speed;
        let [sin, cos] = [sin + cos * (w * delay), cos - sin * (w * delay)];
        let rate_over_omega = b * cos - a * sin;
        let inverse = self.topology.inverse_masses(k);
        let kick = (rate_over_omega * excess - rate_over_omega) * (2.0 / (inverse[0] + inverse[1]));
        let weights = [-inverse[0], inverse[1]];
        for (m, weight) in sides.into_iter().zip(weights) {
            let [a, b] = self.free_part(m);
            let [a, b] = [a - sin * kick * weight, b + cos * kick * weight];
            (self.motions[m].a, self.motions[m].b) = (a.hi, b.hi);
            self.remainders[m] = [a.lo, b.lo];
        }
        self.set_and_search(k, phases, 0.0, -w * rate_over_omega.hi);
        self.gaps[k].origin = self.now.after(delay);
        self.queue.set(k, [self.queue.key(k).after(delay)]);
        self.renew_adjacent(k, phases, weights.map(|weight| weight * w * kick.hi));
    }

    /// Returns the amplitudes (a, b) of cos ωt and sin ωt of the free motion of a mass.
    fn free_part(&self, m: usize) -> [DoubleDouble; 2] {
        let (motion, [a, b]) = (&self.motions[m], self.remainders[m]);
        [DoubleDouble { hi: motion.a, lo: a }, DoubleDouble { hi: motion.b, lo: b }]
    }
}
