use super::*;
use crate::dynamics::Scenario;
use crate::numerics::random::NormalPairs;
use crate::params::{Profile, Protocol};

fn small() -> RestitutionParams {
    let mut parameters = RestitutionParams::new(Profile::Quick);
    parameters.chain.masses = 12;
    parameters.protocol = Protocol { transient: 60.0, window: 60.0 };
    parameters.restitutions = vec![0.0, 0.8];
    parameters.sigmas = vec![0.03, 0.3, 0.6];
    parameters.realisations = 6;
    parameters.heated = vec![0.9, 1.0];
    parameters.ends = vec![25.0, 50.0, 100.0];
    parameters
}

#[test]
fn only_a_force_that_presses_makes_contact_without_neighbours() {
    let found = CUTTING.run(&small(), "test", &Progress::silent()).unwrap();
    let [soft, hard] = &found.curves[..] else { panic!() };
    let [quiet, _, strong] = &soft.rows[..] else { panic!() };
    assert_eq!((quiet.able, quiet.able_touched, quiet.others_touched), (0, 0, 0));
    assert!(strong.able > 0 && strong.able_touched > 0, "{strong:?}");
    let held = strong.held.unwrap().value;
    assert!(held > 0.0 && held < strong.touched.unwrap().value, "{held}");
    // Forces are common to all r, and at r = 0.8 no chatter ends before the pressure does.
    assert_eq!(strong.able, hard.rows[2].able);
    assert!(hard.rows[2].able_touched <= strong.able_touched);
    // 78 gaps at σ = 0.6, of which half can be pressed.
    let share = strong.able as f64 / 78.0;
    assert!((share - found.able_expected[2]).abs() < 0.3, "{share} {:?}", found.able_expected);
}

#[test]
fn a_gap_is_pressed_by_the_difference_of_its_forces() {
    let chain = crate::params::Chain { masses: 2, ..Default::default() };
    let mut normals = NormalPairs::new("test of restitution", 1, 0);
    let mut scenario = Scenario::draw(&chain, 0.1, &mut normals);
    scenario.forcing = vec![[0.6, 0.0], [-0.45, 0.0]];
    let pressed: Vec<bool> = (0..3).map(|gap| run::presses(&scenario, gap)).collect();
    assert_eq!(pressed, [false, true, false]);
    scenario.forcing = vec![[0.6, 0.0], [0.0, 1.1]];
    let pressed: Vec<bool> = (0..3).map(|gap| run::presses(&scenario, gap)).collect();
    assert_eq!(pressed, [false, true, true]);
}

#[test]
fn energy_is_balanced_below_one_and_grows_at_one() {
    let found = CUTTING.run(&small(), "test", &Progress::silent()).unwrap();
    let tame = &found.curves[1].rows[1];
    let balance = tame.balance.unwrap();
    assert!((balance.value - 1.0).abs() < 0.25, "{balance:?}");
    let [near, one] = &found.heated[..] else { panic!() };
    assert!(near.balance.is_some() && one.balance.is_none());
    let last = |row: &Ensemble| row.ratios[2].unwrap().value;
    assert!(last(one) > 1.5 * last(near), "{} {}", last(one), last(near));
    assert!(found.curves[0].balanced == 2.0 && (found.curves[1].balanced - 18.0).abs() < 1e-12);
}

#[test]
fn hot_masses_diffuse_as_the_law_says() {
    // The second route: masses that are kicked by one force after another as they pass them.
    let chain = crate::params::Chain::default();
    let (sigma, until, count) = (0.3, 400.0, 400);
    let mut normals = NormalPairs::new("test of hot chains", 1, 0);
    let mut square = 0.0;
    for _ in 0..count {
        let [mut v, phase] = normals.pair();
        let [mut t, mut x] = [0.0_f64, phase];
        let mut place = x.floor();
        let mut force = normals.pair();
        let h = 0.02;
        while t < until {
            let (sin, cos) = pxfm::f_sincos(chain.forcing_frequency * t);
            v += h * sigma * (force[0] * cos + force[1] * sin);
            x += h * v;
            t += h;
            // A place once left is not found again: the next mass there has another force.
            if x.floor() != place {
                place = x.floor();
                force = normals.pair();
            }
        }
        square += 0.5 * v * v / (sigma * sigma) / f64::from(count);
    }
    let expected = hot(&chain, sigma, 0.0, until).ratio;
    assert!((square / expected - 1.0).abs() < 0.3, "{square} {expected}");
}

#[test]
fn work_is_guessed_within_a_factor_of_a_few() {
    let parameters =
        RestitutionParams { realisations: 2, ..RestitutionParams::new(Profile::Quick) };
    let found = CUTTING.run(&parameters, "test", &Progress::silent()).unwrap();
    let rows = found.curves.iter().flat_map(|curve| &curve.rows).chain(&found.heated);
    for (row, case) in rows.zip(cases(&parameters)) {
        let impacts: u64 = row.runs.iter().flat_map(|run| &run.impacts).sum();
        let (own, guess) = (impacts / row.runs.len() as u64, weight(&parameters, &case));
        let room = 4;
        assert!(own < 5000 || own < room * guess && guess < room * own, "{case:?}: {own} {guess}");
    }
}
