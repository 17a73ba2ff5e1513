//! How hot a running chain is, with nothing measured.
//!
//! *Rate.* Let velocities be normal with variance u², independent of positions and of each other, and positions be those of
//! [`ordered`](super::ordered) masses. A gap closes at the speed V, normal with variance 2u², so it is hit
//! ν = ρ u/√π times in a unit of time, and each mass twice as often.
//!
//! *Response.* At an impact (1 + r)V/2 goes from one mass to the other. In a unit of time a gap passes (1 + r)/2 ∫ V² of its
//! density at width zero, (1 + r) u² ρ/2. If the masses come to close faster by w in the mean, this grows by γw with γ = (1 + r) ν. If
//! they come nearer by δ in the mean, and all their motion with them, the density at zero of a gap, normal about d with variance
//! 2⟨x²⟩, grows by a share δ d/2⟨x²⟩, and the push by κδ with κ = (1 + r) u² ρ d/4⟨x²⟩. (Its variance among masses that keep their
//! order is less, and κ with it larger: then counts come out too high and strongly forced chains too hot.) So a gap acts
//! on what its masses do at the frequency Ω as a spring with a damper, K = κ + iΩγ, and a row of masses with the
//! detuning D = ω² − Ω² answers to a unit force on one of them by
//!
//! χ = ⟨1/(D + 2K(1 − cos q))⟩ over all q = ±1/√(D (D + 4K)),
//!
//! with the sign of D. Springs between neighbours matter: for Ω > ω they bring the answer nearer to resonance.
//!
//! *Balance.* Forces give −σ²Ω Im χ to each mass in a unit of time. An impact takes (1 − r²)/4 ⟨V²⟩ from two masses, (1 − r²) u²
//! since hits weigh V with itself; so
//!
//! −σ²Ω Im χ = (1 − r²) ν u².
//!
//! Both sides are functions of u², and the balance that is stable at the largest u² is the running chain. Its free parts are
//! what is left when the forced motion σ/D is taken away,
//!
//! s² = (u²/ω² + ⟨x²⟩)/2 + σ² (1 + Ω²/ω²)/2 · (1/D² − 2 Re χ/D).

use super::complex::Complex;
use super::ordered::OrderedGas;
use crate::Error;
use impact_chain::Chain;
use impact_numerics::regula_falsi::crossing;
use std::f64::consts::PI;

/// What a gap does to the motion of its two masses.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Coupling {
    /// ν, impacts in a unit of time.
    pub rate: f64,
    /// K = κ + iΩγ.
    pub stiffness: Complex,
}

impl Coupling {
    /// Between masses whose mean square velocities have the mean u².
    pub fn between(gas: &OrderedGas, chain: &Chain, square: f64) -> Self {
        let (d, omega) = (chain.spacing, chain.natural_frequency);
        let own = gas.at(square / (omega * omega * d * d));
        let density = own.contact / d;
        let rate = density * (square / PI).sqrt();
        let pushed = 0.5 * (1.0 + chain.restitution) * square * density;
        let spring = pushed / (2.0 * own.variance * d);
        let damper = (1.0 + chain.restitution) * rate;
        Coupling { rate, stiffness: Complex::new(spring, chain.forcing_frequency * damper) }
    }

    /// Between a wall and a mass of mean square velocity u²: the gap moves as one between masses of half of it each, and
    /// all momentum stays with the mass.
    pub fn at_wall(gas: &OrderedGas, chain: &Chain, square: f64) -> Self {
        let own = Self::between(gas, chain, 0.5 * square);
        Coupling { rate: own.rate, stiffness: own.stiffness.scaled(2.0) }
    }
}

/// A chain that neither heats nor cools, all masses alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heat {
    /// u², the mean square velocity.
    pub square: f64,
    /// ⟨x²⟩, the mean square distance from equilibrium.
    pub position: f64,
    /// s², the variance of the free amplitudes.
    pub free: f64,
    /// Impacts of one mass in a unit of time.
    pub rate: f64,
    /// [Re χ, Im χ], a mass's own answer to its force.
    pub response: [f64; 2],
    /// Variance of a gap among ordered masses over the 2⟨x²⟩ that κ takes for it.
    pub narrower: f64,
}

/// Refuses what has no such state.
pub(super) fn check(chain: &Chain, sigma: f64) -> Result<(), Error> {
    if !(sigma > 0.0 && sigma.is_finite()) {
        return Err(Error::input("sigma", format!("{sigma:?} is no size"), "give a number > 0"));
    }
    let r = chain.restitution;
    if !(0.0..1.0).contains(&r) {
        let problem = format!("at {r:?} impacts lose nothing, and no state is steady");
        return Err(Error::input("restitution", problem, "give 0 ≤ r < 1"));
    }
    if chain.natural_frequency == chain.forcing_frequency {
        let problem = "it is the natural frequency, where forced motions grow without bound";
        return Err(Error::input("forcing-frequency", problem, "give another one"));
    }
    Ok(())
}

/// The state at one u², and by how much more forces give than impacts take, over what they take.
fn state(gas: &OrderedGas, chain: &Chain, sigma: f64, square: f64) -> (Heat, f64) {
    let [omega2, big2] = [chain.natural_frequency, chain.forcing_frequency].map(|x| x * x);
    let (detuning, force2) = (omega2 - big2, sigma * sigma);
    let own = Coupling::between(gas, chain, square);
    let under = Complex::new(detuning, 0.0) + own.stiffness.scaled(4.0);
    let root = under.scaled(detuning).sqrt().scaled(detuning.signum());
    let chi = Complex::new(1.0, 0.0) / root;
    let given = -force2 * chain.forcing_frequency * chi.im;
    let taken = (1.0 - chain.restitution * chain.restitution) * own.rate * square;
    let d = chain.spacing;
    let ordered = gas.at(square / (omega2 * d * d));
    let (position, narrower) = (ordered.variance * d * d, 0.5 * ordered.gap / ordered.variance);
    let kept = 1.0 / (detuning * detuning) - 2.0 * chi.re / detuning;
    let free = 0.5 * (square / omega2 + position) + 0.5 * force2 * (1.0 + big2 / omega2) * kept;
    let (rate, response) = (2.0 * own.rate, [chi.re, chi.im]);
    let heat = Heat { square, position, free, rate, response, narrower };
    (heat, given / taken - 1.0)
}

/// The running chain, if it can run: none where forces give less than impacts take at every u² of any use.
///
/// # Errors
/// [`Error::Input`] for a σ that is not positive, for r = 1 and at resonance.
pub fn heat(gas: &OrderedGas, chain: &Chain, sigma: f64) -> Result<Option<Heat>, Error> {
    check(chain, sigma)?;
    let scale = chain.natural_frequency * chain.spacing;
    // From as hot as anyone asks for down to where hardly any gap closes.
    let [low, high] = [0.02, 50.0].map(|tau: f64| pxfm::f_log(tau * scale * scale));
    let excess = |log: f64| state(gas, chain, sigma, pxfm::f_exp(log)).1;
    let steps = 60;
    let place = |i: usize| high - (high - low) * i as f64 / steps as f64;
    let Some(first) = (1..=steps).find(|&i| excess(place(i)) > 0.0) else { return Ok(None) };
    if first == 1 {
        let problem = format!("at {sigma} the chain is hotter than this law was made for");
        return Err(Error::input("sigma", problem, "give a smaller one"));
    }
    let log = -crossing([place(first - 1), place(first)].map(|x| -x), 1e-10, |x| excess(-x));
    Ok(Some(state(gas, chain, sigma, pxfm::f_exp(log)).0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn paper(restitution: f64) -> Chain {
        Chain { restitution, ..Chain::default() }
    }

    /// The mean over all q by a sum, and the balance of what forces give and impacts take.
    #[test]
    fn the_answer_is_the_mean_over_waves_and_energy_balances() {
        let gas = OrderedGas::new();
        for (omega, big_omega) in [(1.0, 2.0_f64.sqrt()), (1.3, 0.9)] {
            let chain =
                Chain { natural_frequency: omega, forcing_frequency: big_omega, ..paper(0.7) };
            for sigma in [0.2, 0.3] {
                let Some(found) = heat(&gas, &chain, sigma).unwrap() else { panic!("{sigma}") };
                let own = Coupling::between(&gas, &chain, found.square);
                let waves = 400;
                let mut chi = Complex::default();
                for i in 0..waves {
                    let q = PI * (i as f64 + 0.5) / f64::from(waves);
                    let part = own.stiffness.scaled(2.0 * (1.0 - pxfm::f_cos(q)));
                    let detuning = Complex::new(omega * omega - big_omega * big_omega, 0.0);
                    chi = chi + (Complex::new(1.0, 0.0) / (detuning + part)).scaled(1.0 / 400.0);
                }
                assert!(
                    (chi - Complex::new(found.response[0], found.response[1])).square() < 1e-18
                );
                let given = -sigma * sigma * big_omega * chi.im;
                let taken = (1.0 - 0.49) * 0.5 * found.rate * found.square;
                assert!((given / taken - 1.0).abs() < 1e-8, "{given} {taken}");
                assert!(found.position < found.square / (omega * omega));
            }
        }
    }

    /// Means over all masses of rings of 100 between t = 3000 and 5000, 24 of them at each pair; the engine's.
    #[test]
    fn rings_that_were_run_are_as_hot() {
        let gas = OrderedGas::new();
        for (r, sigma, free, rate) in [
            (0.95, 0.1, 39.4, 0.352),
            (0.95, 0.2, 16.5, 0.579),
            (0.95, 0.4, 7.93, 0.935),
            (0.9, 0.15, 18.8, 0.373),
            (0.9, 0.3, 8.11, 0.600),
            (0.8, 0.12, 18.9, 0.240),
            (0.8, 0.15, 14.8, 0.300),
            (0.8, 0.2, 10.5, 0.372),
            (0.8, 0.4, 4.83, 0.573),
            (0.6, 0.2, 7.56, 0.285),
            (0.6, 0.4, 3.83, 0.471),
            (0.4, 0.3, 4.43, 0.376),
        ] {
            let found = heat(&gas, &paper(r), sigma).unwrap().unwrap();
            let ratio = found.free / (sigma * sigma);
            assert!((ratio / free - 1.0).abs() < 0.05, "{r} {sigma}: {ratio} {free}");
            assert!((found.rate / rate - 1.0).abs() < 0.1, "{r} {sigma}: {} {rate}", found.rate);
        }
    }

    #[test]
    fn a_scale_changes_nothing_and_a_quiet_chain_has_no_heat() {
        let gas = OrderedGas::new();
        // Lengths in units of 2, times in units of 3.
        let chain = Chain {
            spacing: 2.0,
            natural_frequency: 1.0 / 3.0,
            forcing_frequency: 2.0_f64.sqrt() / 3.0,
            ..paper(0.8)
        };
        let own = heat(&gas, &paper(0.8), 0.15).unwrap().unwrap();
        let scaled = heat(&gas, &chain, 0.15 * 2.0 / 9.0).unwrap().unwrap();
        for (a, b) in [
            (own.square * 4.0 / 9.0, scaled.square),
            (own.free * 4.0, scaled.free),
            (own.rate / 3.0, scaled.rate),
        ] {
            assert!((a / b - 1.0).abs() < 1e-8, "{a} {b}");
        }
        assert_eq!(heat(&gas, &paper(0.4), 0.03), Ok(None));
        assert!(heat(&gas, &paper(1.0), 0.1).is_err() && heat(&gas, &paper(0.8), 0.0).is_err());
    }
}
