//! How hot a running chain is: the balance of energy at impacts (ours).
//!
//! Take an impact of two neighbours that close at speed V > 0, and split V into the closing speeds
//! of their forced and of their free parts, V = F + W. Forced parts do not notice an impact; the
//! free velocities jump by what the velocities jump, (1 + r) V shared by the inverse masses. So the
//! energy of the free parts changes by
//!
//! ΔE = M ((1 + r) V F − (1 − r²) V²/2),
//!
//! with the reduced mass M: 1/2 for two masses, 1 for a mass at a wall. Nothing else changes it.
//! In a chain that neither heats nor cools the changes add up to zero, whatever the distribution
//! of V and F,
//!
//! ⟨V F⟩ = (1 − r)/2 ⟨V²⟩.
//!
//! What F is worth at a given V needs an assumption. If the two parts of a gap are independent and
//! normal when it closes, with variances 2 s² and 2 σ²/(ω² − Ω²)² of each amplitude, then F at
//! given V has the mean V · var F/(var F + var W), and the balance gives
//!
//! s²/σ² = (Ω/ω)² (1 + r)/(1 − r) / (ω² − Ω²)²,
//!
//! whatever σ and d are. It needs impacts of one gap that are so far apart that the phases have
//! forgotten the last, and it has no finite value at r = 1: there nothing is lost.
//!
//! Where impacts are frequent, what the force does to a mass is lost to its neighbours before it has
//! added up. Let neighbours move independently of each other, with velocities of variance u². Gaps close
//! at a rate in proportion to V. So the mean push that a mass feels when it moves by w faster than it
//! would is, from both its gaps together, −(1 + r) ν w with ν the rate of its impacts: a friction
//! γ = (1 + r) ν. The motion that the force keeps up is σ/(D + iγΩ) and not σ/D, with D = ω² − Ω²; it takes
//! up the power σ²γΩ²/(D² + γ²Ω²). Impacts take (1 − r²)/4 ⟨V²⟩ = (1 − r²) u² from two masses, since
//! the weight V doubles the mean of V². So u² = 2σ²Ω²/((1 − r)(D² + γ²Ω²)). Free parts are what is left
//! when the motion without friction is taken away: of the kept motion the difference σ/(D + iγΩ) − σ/D,
//! and all that is random. A free part at x with velocity v has a² + b² = x² + v²/ω². At random x² and
//! v²/ω² are alike in the mean; at the frequency Ω they are as ω² to Ω², which gives the difference a factor
//! (1 + Ω²/ω²)/2. Together
//!
//! s²/σ² = ((Ω/ω)² (1 + r)/(1 − r) + (1 + Ω²/ω²)/2 (γΩ/D)²)/(D² + γ²Ω²),
//!
//! the formula above for γ = 0, and (1 + Ω²/ω²)/2D² where friction takes all: there the chain as a whole
//! stands still, and its free parts are those of a start from rest.

use super::Error;
use super::impact_probability::ImpactProbability;
use impact_chain::Chain;

/// ΔE, the change of the energy of the free parts at an impact, from the reduced mass M, the
/// closing speed V and its forced part F; masses are 1.
pub fn energy_change(reduced_mass: f64, restitution: f64, speed: f64, forced: f64) -> f64 {
    let r = restitution;
    reduced_mass * ((1.0 + r) * speed * forced - 0.5 * (1.0 - r * r) * speed * speed)
}

/// s²/σ², the variance of the free amplitudes over that of the force, at which a chain whose
/// impacts are rare neither heats nor cools.
///
/// # Errors
/// [`Error::Input`] for r = 1, where no such state exists.
pub fn variance_ratio(chain: &Chain) -> Result<f64, Error> {
    variance_ratio_at(chain, 0.0)
}

/// s²/σ², the same if each mass has so many impacts in a unit of time.
///
/// # Errors
/// [`Error::Input`] for r = 1, where no such state exists.
pub fn variance_ratio_at(chain: &Chain, rate: f64) -> Result<f64, Error> {
    let r = chain.restitution;
    if !(0.0..1.0).contains(&r) {
        let problem = format!("at {r} impacts lose nothing, and no state is steady");
        return Err(Error::input("restitution", problem, "give 0 ≤ r < 1"));
    }
    let law = ImpactProbability::new(
        1.0,
        chain.spacing,
        chain.natural_frequency,
        chain.forcing_frequency,
    )?;
    let detuning = law.detuning.square().to_f64();
    let friction = (1.0 + r) * rate * chain.forcing_frequency;
    let lost = friction * friction;
    let ratio = law.frequency_ratio.to_f64();
    let (random, kept) = (ratio * (1.0 + r) / (1.0 - r), 0.5 * (1.0 + ratio) * lost / detuning);
    Ok((random + kept) / (detuning + lost))
}

impl ImpactProbability {
    /// The same gap with free parts whose variance is `ratio` times that of the force: s² = ratio σ².
    ///
    /// # Errors
    /// [`Error::Input`] unless the ratio is finite and positive.
    pub fn heated(mut self, ratio: f64) -> Result<Self, Error> {
        if !(ratio > 0.0 && ratio.is_finite()) {
            let problem = format!("{ratio:?} is no ratio of variances");
            return Err(Error::input("ratio", problem, "give a finite number > 0"));
        }
        // The wider Rayleigh scale of the free part is s, and the forced one is s over this.
        let scale = ratio.sqrt();
        self.half_ratio = self.half_ratio / scale.into();
        self.detuning = self.detuning * scale;
        Ok(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use impact_numerics::random::NormalPairs;

    fn paper(restitution: f64) -> Chain {
        Chain { restitution, ..Chain::default() }
    }

    #[test]
    fn the_paper_s_chain() {
        // Ω² = 2, (ω² − Ω²)² = 1.
        assert!((variance_ratio(&paper(0.8)).unwrap() - 18.0).abs() < 1e-12);
        assert!((variance_ratio(&paper(0.0)).unwrap() - 2.0).abs() < 1e-12);
        assert!(variance_ratio(&paper(1.0)).is_err() && variance_ratio(&paper(f64::NAN)).is_err());
    }

    #[test]
    fn what_the_force_gives_through_friction_impacts_take() {
        let chain = Chain { natural_frequency: 1.3, forcing_frequency: 0.9, ..paper(0.6) };
        let (r, omega2, big2) = (0.6, 1.69, 0.81);
        let detuning2: f64 = (omega2 - big2) * (omega2 - big2);
        for rate in [0.01, 0.3, 4.0] {
            let friction = (1.0 + r) * rate;
            let lost = friction * friction * big2;
            // Of the free parts one is what friction leaves out of the forced motion, of amplitude 1/(D + iγΩ) − 1/D
            // at the frequency Ω; its (x² + v²/ω²)/2 is averaged over a period. The rest is random.
            let phase = |i: u32| (2.0 * std::f64::consts::PI * f64::from(i) / 64.0).sin_cos();
            let kept = lost / (detuning2 * (detuning2 + lost));
            let half = |(sin, cos): (f64, f64)| 0.5 * (cos * cos + sin * sin * big2 / omega2);
            // Both amplitudes of a force are random, so the mean over a period counts twice.
            let kept = 2.0 * kept * (0..64).map(|i| half(phase(i))).sum::<f64>() / 64.0;
            let random = omega2 * (variance_ratio_at(&chain, rate).unwrap() - kept);
            let speed2 = random + big2 / (detuning2 + lost);
            let power = friction * big2 / (detuning2 + lost);
            let loss = rate * (1.0 - r * r) / 2.0 * speed2;
            assert!((power - loss).abs() < 1e-12 * power, "{power} {loss}");
        }
        // A chain that stands still is a chain at rest: its free amplitudes are −α and −Ω/ω β over D.
        let still = variance_ratio_at(&chain, 1e9).unwrap();
        let rest = 0.5 * (1.0 + big2 / omega2) / detuning2;
        assert!((still / rest - 1.0).abs() < 1e-9, "{still} {rest}");
        assert_eq!(variance_ratio_at(&paper(0.8), 0.0), variance_ratio(&paper(0.8)));
    }

    #[test]
    fn normal_parts_at_crossings_balance() {
        // The second route: draw W and F for gaps that close, with weight V, and average.
        let chain = paper(0.6);
        let r = chain.restitution;
        let free = (2.0 * variance_ratio(&chain).unwrap()).sqrt();
        let forced = 2.0_f64.sqrt() * chain.forcing_frequency;
        let mut normals = NormalPairs::new("test of the balance", 1, 0);
        let (mut gain, mut size) = (0.0, 0.0);
        for _ in 0..400_000 {
            let [w, f] = normals.pair();
            let (v, f) = (free * w + forced * f, forced * f);
            if v > 0.0 {
                gain += v * energy_change(0.5, r, v, f);
                size += v * energy_change(0.5, r, v, f).abs();
            }
        }
        assert!(gain.abs() < 5e-3 * size, "{gain} of {size}");
    }

    #[test]
    fn a_warm_gap_closes_as_often_as_a_wider_force_with_a_nearer_frequency() {
        let law = ImpactProbability::of_paper(0.1).unwrap();
        assert_eq!(law.heated(1.0).unwrap().p(), law.p());
        // Free parts of 0.2 and forced parts of 0.1: σ = 0.2, |ω² − Ω²| = 2.
        let other = ImpactProbability::new(0.2, 1.0, 1.0, 3.0_f64.sqrt()).unwrap();
        let (p, q) = (law.heated(4.0).unwrap().p().unwrap(), other.p().unwrap());
        assert!((p / q - 1.0).abs() < 1e-13, "{p} {q}");
        assert!(law.heated(0.0).is_err() && law.heated(f64::INFINITY).is_err());
    }
}
