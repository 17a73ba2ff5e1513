use super::run::{Journey, draw, open};
use super::*;
use crate::dynamics::{Engine, Initial, Scenario};
use crate::numerics::random::NormalPairs;
use crate::params::{Boundary, Profile, Start};

fn curve(masses: usize) -> ChainCurve {
    ChainCurve {
        kind: ChainKind::Length,
        name: "test".into(),
        masses,
        start: Start::Rest,
        boundary: Boundary::Walls,
        damping: 0.0,
        forcing_frequency: 2.0_f64.sqrt(),
        components: 1,
        sigmas: vec![0.1, 0.2],
        transients: vec![20.0, 100.0],
        realisations: 4,
    }
}

fn parameters(curves: Vec<ChainCurve>) -> ChainsParams {
    ChainsParams { window: 50.0, piece: 10, curves, ..ChainsParams::new(Profile::Quick) }
}

#[test]
fn windows_of_each_profile_do_not_overlap_and_names_differ() {
    let profiles = [Profile::Quick, Profile::Ci, Profile::Full].map(ChainsParams::new);
    for parameters in profiles.into_iter().chain([ChainsParams::sizes(Profile::Quick)]) {
        let mut names = std::collections::BTreeSet::new();
        for own in &parameters.curves {
            assert!(names.insert(&own.name), "{}", own.name);
            assert!(own.sigmas.is_sorted() && !own.sigmas.is_empty(), "{own:?}");
            let apart = |pair: &[f64]| pair[0] + parameters.window <= pair[1];
            assert!(own.transients.windows(2).all(apart), "{own:?}");
            assert!(own.components <= 1 + FREQUENCIES.len(), "{own:?}");
        }
    }
}

#[test]
fn pieces_make_up_the_chain() {
    assert_eq!(pieces(11, 1000), [11]);
    assert_eq!(pieces(101, 10), [10, 10, 10, 10, 10, 10, 10, 10, 10, 11]);
    assert_eq!(pieces(100_001, 1000).iter().sum::<usize>(), 100_001);
}

/// Without friction strokes change nothing, for as long as chaos lets two roundings agree.
#[test]
fn strokes_without_damping_change_nothing() {
    let own = ChainCurve { components: 3, ..curve(12) };
    let mut normals = NormalPairs::new("test of chains", 1, 0);
    let scenario = draw(&parameters(vec![own.clone()]), &own, 0.25, &mut normals);
    let mut whole = Vec::new();
    let mut engine = Engine::new(&scenario).unwrap();
    let see = |impact: crate::dynamics::Impact| (impact.gap, impact.closing_speed);
    engine
        .run(55.0, |impact| {
            whole.push(see(impact));
            true
        })
        .unwrap();
    let mut struck = Vec::new();
    let mut motion = Journey::new(scenario, 1e-30, 7.0).unwrap();
    for until in [20.0, 55.0] {
        motion
            .run(until, |impact| {
                struck.push(see(impact));
                true
            })
            .unwrap();
    }
    assert!(whole.len() > 20 && whole.len() == struck.len(), "{whole:?} {struck:?}");
    for ((gap, speed), (other, again)) in whole.iter().zip(&struck) {
        assert!(gap == other && (speed - again).abs() < 1e-7, "{speed} {again}");
    }
}

/// One mass that never meets a wall, against ẍ + 2cẋ + x = F by the classical Runge–Kutta method.
#[test]
fn small_strokes_are_a_viscous_friction() {
    let (damping, until) = (0.05, 30.0);
    let forced = [0.02, 0.03];
    let chain = Chain { masses: 1, ..Chain::default() };
    let mut normals = NormalPairs::new("test of chains", 1, 1);
    let scenario = Scenario { forcing: vec![forced], ..Scenario::draw(&chain, 0.01, &mut normals) };
    let big_omega = scenario.forcing_frequency;
    let slope = |t: f64, [x, v]: [f64; 2]| {
        let (sin, cos) = pxfm::f_sincos(big_omega * t);
        [v, forced[0] * cos + forced[1] * sin - x - 2.0 * damping * v]
    };
    let (steps, mut y) = (30_000, [0.0, 0.0]);
    let h = until / f64::from(steps);
    for i in 0..steps {
        let t = f64::from(i) * h;
        let on = |k: [f64; 2], h: f64| [y[0] + h * k[0], y[1] + h * k[1]];
        let a = slope(t, y);
        let b = slope(t + 0.5 * h, on(a, 0.5 * h));
        let c = slope(t + 0.5 * h, on(b, 0.5 * h));
        let d = slope(t + h, on(c, h));
        y = [0, 1].map(|i| y[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]));
    }
    let error = |stroke: f64| {
        let mut motion = Journey::new(scenario.clone(), damping, stroke).unwrap();
        motion.run(until, |_| panic!("no impact")).unwrap();
        (motion.place(until)[0] - 1.0 - y[0]).abs()
    };
    let [rough, fine] = [0.1, 0.01].map(error);
    assert!(rough < 3e-3 && fine < 0.2 * rough && fine < 3e-4, "{rough} {fine}");
}

#[test]
fn components_move_a_chain_as_much_as_one() {
    let variance = |number: usize| {
        let own = ChainCurve { components: number, ..curve(4000) };
        let mut normals = NormalPairs::new("test of chains", 2, 0);
        let scenario = draw(&parameters(vec![own.clone()]), &own, 0.1, &mut normals);
        assert_eq!(scenario.components().count(), number);
        let each = scenario.components().map(|(frequency, amplitudes)| {
            let response = 1.0 / (1.0 - frequency * frequency);
            let squares = amplitudes.iter().flatten().map(|x| response * x * response * x);
            squares.sum::<f64>() / (2 * amplitudes.len()) as f64
        });
        each.collect::<Vec<f64>>()
    };
    for number in [1, 2, 8] {
        let each = variance(number);
        for own in &each {
            assert!((own * number as f64 / 0.01 - 1.0).abs() < 0.1, "{each:?}");
        }
    }
}

#[test]
fn open_gaps_by_hand() {
    let own = ChainCurve { components: 2, ..curve(2) };
    let mut normals = NormalPairs::new("test of chains", 3, 0);
    let mut scenario = draw(&parameters(vec![own.clone()]), &own, 0.1, &mut normals);
    // Responses are 1 for Ω² = 2 and 1/2 for Ω² = 3.
    scenario.forcing = vec![[0.6, 0.0], [0.0, 0.0]];
    scenario.overtones[0].amplitudes = vec![[0.0, 0.9], [0.0, 0.9]];
    // Reaches: 0.6 + 0.45, 0.6, 0.45.
    assert_eq!(open(&scenario), 1);
    scenario.initial = Initial::Zero;
    scenario.forcing[0] = [0.5, 0.0];
    assert_eq!(open(&scenario), 0);
    // On a ring both masses meet on either side of them.
    scenario.forcing[0] = [0.6, 0.0];
    scenario.overtones[0].amplitudes = vec![[0.0, 0.9], [0.0, 0.0]];
    scenario.boundary = Boundary::Ring;
    assert_eq!(open(&scenario), 2);
}

#[test]
fn counts_are_those_of_the_sweep_and_of_all_pieces() {
    let parameters = parameters(vec![curve(40)]);
    let found = CUTTING.run(&parameters, "test", &Progress::silent()).unwrap();
    let [row, hot] = &found.curves[0].rows[..] else { panic!() };
    assert_eq!((row.runs.len(), row.failed, row.runs[0].counts.len()), (4, 0, 2));
    assert!(hot.runs.iter().all(|run| run.counts[1].len() == 4));
    let mut normals = NormalPairs::new(&parameters.stream, parameters.seed, 2);
    let chain = Chain { masses: 40, ..Chain::default() };
    let scenario = Scenario::draw(&chain, 0.2, &mut normals);
    let mut hit = [false; 41];
    let mut engine = Engine::new(&scenario).unwrap();
    engine
        .run(150.0, |impact| {
            hit[impact.gap] |= impact.time > 100.0;
            true
        })
        .unwrap();
    let all: u32 = hot.runs[2].counts[1].iter().sum();
    assert_eq!(all, hit.iter().map(|&hit| u32::from(hit)).sum::<u32>());
    let [some, none] = hot.chains;
    assert_eq!(some + none, 4);
}
