//! The circuit of one gap, whose equations can be solved in closed form.

use super::PeriodicKick;
use crate::Scenario;

/// The amplitude R of the forced part of a gap from which on a motion with this gap's impact once in
/// a period P can be; none where cot(ωP/2) > 0, so that the rebound is against the impact's side.
///
/// At the impact the forced part is R cos φ and closes at ΩR sin φ; restitution gives the impulse and
/// d = R (h sin φ − cos φ) with h = |cot(ωP/2)| (Ω/ω) (1 + r)/(1 − r), which has a solution if and only if
/// R √(1 + h²) ≥ d. It is the same at a wall and between masses.
pub fn least_amplitude(scenario: &Scenario, period: f64) -> Option<f64> {
    let (w, r) = (scenario.natural_frequency, scenario.restitution);
    let [place, _] = PeriodicKick::new(w, period).after(0.0);
    // place = cot(ωP/2)/(2ω).
    let h = 2.0 * place.abs() * scenario.forcing_frequency * (1.0 + r) / (1.0 - r);
    (place < 0.0).then(|| scenario.spacing / (1.0 + h * h).sqrt())
}

#[cfg(test)]
mod tests {
    use super::super::Solver;
    use super::*;
    use crate::Chain;
    use impact_numerics::random::NormalPairs;

    #[test]
    fn newton_finds_a_motion_above_it_and_none_below() {
        let chain = Chain { masses: 3, ..Chain::default() };
        let mut scenario = Scenario::draw(&chain, 1.0, &mut NormalPairs::new("test", 1, 0));
        let period = Solver::new(&scenario, &[0], 1).unwrap().period();
        let least = least_amplitude(&scenario, period).unwrap();
        assert!((0.1..0.11).contains(&least), "{least}");
        for (gap, factor, found) in
            [(0, 0.999, false), (0, 1.001, true), (2, 0.999, false), (2, 1.001, true)]
        {
            // |ω² − Ω²| = 1, so amplitudes of force and response are alike.
            scenario.forcing = vec![[0.0; 2]; 3];
            scenario.forcing[gap.max(1) - 1] = [0.6 * factor * least, -0.8 * factor * least];
            let solver = Solver::new(&scenario, &[gap], 1).unwrap();
            let any = (0..200).any(|i| solver.from(&[f64::from(i) / 200.0 * period]).is_some());
            assert_eq!(any, found, "gap {gap}, {factor}");
        }
        assert_eq!(least_amplitude(&scenario, 2.0 * period), None);
    }
}
