//! Where methods fail: grazing, contact, long waits, late starts, too much work. The scenes of the experiment
//! `trials` have more of them, with outcomes in closed form; here is what goes beyond those.

use crate::reference::{Dd, Real, Reference};
use crate::{first, given, run};
use impact_chain::{Engine, Initial, Overtone, Scenario};
use impact_numerics::random::NormalPairs;
use impact_paper::params::Chain;

/// One mass between walls, with free part (a, b) and forcing (α, β).
fn one(free: [f64; 2], forcing: [f64; 2], restitution: f64) -> Scenario {
    Scenario { restitution, ..given(vec![free], vec![forcing]) }
}

/// The lowest place of a motion is moved to ±10^-k beyond the wall by the choice of d.
#[test]
fn dips_of_any_depth_are_hit_or_missed_rightly() {
    let mut normals = NormalPairs::new("dips", 1, 0);
    let (mut dips, mut worst) = (0, 0.0f64);
    while dips < 40 {
        let ([x, y], forcing) = (normals.pair(), normals.pair());
        // At time t the displacement is low and its rate zero, by the choice of the free part.
        let (t, depth) = (0.5 + 3.0 * x.abs(), 1.0 + y.abs());
        let forced = |t: f64| {
            let forced = Reference::<Dd>::new(&one([0.0; 2], forcing, 0.8)).gap(0).jet(&Dd::of(t));
            forced.map(|x| x.near())
        };
        let [u, v, w] = forced(t);
        let (low, bend) = (-depth - (u - 1.0), w + depth + (u - 1.0));
        let free = [low * t.cos() + v * t.sin(), low * t.sin() - v * t.cos()];
        let scene = |d: f64| Scenario { spacing: d, ..one(free, forcing, 0.8) };
        let near = |d: f64| Reference::<Dd>::new(&scene(d)).step(&Dd::of(t + 0.3));
        // Nothing comes before it, and what is less deep is not reached at all.
        let reached = [depth * (1.0 - 1e-2), depth * (1.0 + 1e-2)].map(near);
        let [Ok(Some(hit)), Ok(None)] = reached else { continue };
        if bend < 0.3 || hit.gap != 0 || (hit.time.near() - t).abs() > 0.5 {
            continue;
        }
        dips += 1;
        for k in 2..=14 {
            for sign in [1.0, -1.0] {
                let d = depth + sign * 10f64.powi(-k);
                let theirs = near(d).unwrap();
                let ours = first(&mut Engine::new(&scene(d)).unwrap(), t + 0.3);
                let hits = [theirs.is_some(), ours.is_some()];
                assert_eq!(hits, [sign < 0.0; 2], "dip {dips}, depth {sign}e-{k}");
                if let (Some(ours), Some(theirs)) = (ours, theirs) {
                    let speed = (2.0 * 10f64.powi(-k) * bend).sqrt();
                    let error = (Dd::of(ours.time) - theirs.time).near().abs();
                    let units = error * speed / (f64::EPSILON * (2.0 * depth + 1.0));
                    worst = worst.max(units);
                    assert!(units < 8.0, "dip {dips}, depth 1e-{k}: {units}");
                }
            }
        }
    }
    println!("grazing times: |δt| ≤ {worst:.2} ε (d + R1 + R2) / |Δ'|");
}

#[test]
fn chattering_ends_in_contact_and_contact_in_release() {
    let [alpha, beta] = [5.88, -4.94];
    let scenario = Scenario { initial: Initial::Rest, ..one([0.0; 2], [alpha, beta], 0.2) };
    let w = scenario.forcing_frequency;
    let force = |t: f64| alpha * (w * t).cos() + beta * (w * t).sin();
    // What presses the mass on the wall of a gap: −Δ'' at Δ = 0.
    let pressure = |gap: usize, t: f64| if gap == 0 { -1.0 - force(t) } else { force(t) - 1.0 };
    let mut engine = Engine::new(&scenario).unwrap();
    let (mut held, mut releases): (Option<usize>, usize) = (None, 0);
    let step = 1.0 / 512.0;
    for i in 1..(40.0 / step) as usize {
        let t = step * i as f64;
        run(&mut engine, t);
        let x = engine.positions(t)[0];
        assert!((-1e-14..=2.0 + 1e-14).contains(&x), "x = {x} at {t}");
        let contacts = engine.contacts(t);
        if let [(gap, f)] = contacts[..] {
            assert!(f >= 0.0 && (f - pressure(gap, t)).abs() < 1e-12, "force {f} at {t}");
            assert_eq!(x, if gap == 0 { 0.0 } else { 2.0 });
            held = Some(gap);
        } else if let Some(gap) = held.take() {
            // Released since the last look, in which the force changed its sign.
            releases += 1;
            let kept = pressure(gap, t - step) >= 0.0 && pressure(gap, t) <= 0.0;
            assert!(kept, "released at {t}");
        }
    }
    let counters = engine.counters();
    println!("{counters:?}, {releases} releases");
    assert!(releases >= 3 && counters.contact_phases as usize >= releases);
    assert!(counters.impacts < 2000, "a chatter is cut short: {counters:?}");
}

/// Next to resonance amplitudes are ten million times a gap, and hide that it hardly moves: the certified steps
/// are to go by the gap.
#[test]
fn next_to_resonance_a_gap_that_hardly_moves_is_soon_passed() {
    for (k, scale) in [(1.0, 1.65e-7), (2.0, 1.6e-7), (16.0, 1.1e-7), (64.0, 1.6e-7)] {
        let forcing =
            [[0.3, 0.2], [-0.25, 0.1], [0.1, -0.3]].map(|x| x.map(|x| x * scale * k / 8.0));
        let forcing_frequency = 1.0 + k * f64::EPSILON;
        let chain = Chain { masses: 3, forcing_frequency, ..Chain::default() };
        let mut engine = Engine::new(&Scenario::given(&chain, forcing.to_vec()).unwrap()).unwrap();
        engine.run(30.0, |_| true).unwrap();
        let counters = engine.counters();
        println!("k = {k}: {counters:?}");
        assert!(counters.impacts == 0 && counters.evaluations < 2_000_000, "k = {k}: {counters:?}");
    }
}

/// Two components of one frequency next to resonance nearly cancel for a hundred thousand periods: a leap that fails is
/// made shorter. Their sum as one component is hit at the same time.
#[test]
fn components_that_nearly_cancel_are_soon_passed() {
    let frequency = 1.0 - 2.0_f64.powi(-40);
    let from_rest = |forcing| {
        let mut own = Scenario { initial: Initial::Rest, ..one([0.0; 2], forcing, 0.5) };
        own.forcing_frequency = frequency;
        own
    };
    let whole = from_rest([0.5e-6, 2.1e-6]);
    let mut parts = from_rest([-2.7e-6, 7.5e-6]);
    parts.overtones.push(Overtone { frequency, amplitudes: vec![[3.2e-6, -5.4e-6]] });
    let [(sum, _), (hit, rate)] = [whole, parts].map(|scenario| {
        let mut engine = Engine::new(&scenario).unwrap();
        let hit = first(&mut engine, 1e6).expect("it closes in the end");
        (hit, engine.counters().evaluations as f64 / hit.time)
    });
    let error = (hit.time - sum.time).abs() * sum.closing_speed;
    println!("t = {}: {error:e}, {rate:.1} evaluations a unit of time", hit.time);
    assert!(hit.gap == sum.gap && error < 1e-6 && rate < 20.0, "{error:e}, {rate}");
}
