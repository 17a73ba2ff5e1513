//! The response of a free oscillator to periodic kicks.

/// The motion with period P of u″ + ω² u = Σ δ(s − j P): the only one, unless ωP is a multiple of 2π.
#[derive(Clone, Copy, Debug)]
pub struct PeriodicKick {
    omega: f64,
    period: f64,
    /// 2 sin(ωP/2).
    divisor: f64,
}

impl PeriodicKick {
    /// For the frequency ω and the period P.
    pub fn new(omega: f64, period: f64) -> Self {
        PeriodicKick { omega, period, divisor: 2.0 * pxfm::f_sin(0.5 * omega * period) }
    }

    /// Displacement and velocity at the time `since` the last kick, 0 ≤ s < P: right after it at 0.
    pub fn after(&self, since: f64) -> [f64; 2] {
        let (sin, cos) = pxfm::f_sincos(self.omega * (since - 0.5 * self.period));
        [cos / (self.omega * self.divisor), -sin / self.divisor]
    }

    /// The time since the last kick of the series that kicks at `at`, for times less than P apart.
    pub fn since(&self, at: f64, now: f64) -> f64 {
        if now >= at { now - at } else { now - at + self.period }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_kick_is_a_unit_of_velocity_and_the_motion_repeats() {
        let (omega, period) = (1.3, 7.1);
        let kick = PeriodicKick::new(omega, period);
        let [start, end] = [kick.after(0.0), kick.after(period)];
        assert!((start[0] - end[0]).abs() < 1e-15);
        assert!((start[1] - end[1] - 1.0).abs() < 1e-15);
        // In between it is free: u(s) = u(0) cos ωs + u'(0)/ω sin ωs.
        for s in [0.3, 2.0, 6.9] {
            let (sin, cos) = pxfm::f_sincos(omega * s);
            let [u, v] = kick.after(s);
            assert!((u - start[0] * cos - start[1] / omega * sin).abs() < 1e-14);
            assert!((v - start[1] * cos + start[0] * omega * sin).abs() < 1e-14);
        }
        assert_eq!(kick.since(2.0, 1.0), period - 1.0);
    }
}
