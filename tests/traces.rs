//! The engine against the reference of higher precision.

mod reference;

use impact_paper::dynamics::Scenario;
use impact_paper::numerics::random::NormalPairs;
use impact_paper::params::Chain;
use reference::{Big, Dd, Real, Reference};

#[test]
fn double_double_sine_and_cosine_agree_with_dashu() {
    let mut worst: f64 = 0.0;
    for i in 0..200 {
        let x = f64::from(i * i) * 0.37 - 900.0 + 1.0 / f64::from(i + 3);
        let (s, c) = Dd::of(x).sin_cos();
        let (big_s, big_c) = Big::of(x).sin_cos();
        for (small, big) in [(s, big_s), (c, big_c)] {
            let [hi, lo] = small.parts();
            let error = (Big::of(hi) + Big::of(lo) - big).near().abs();
            worst = worst.max(error / x.abs().max(1.0));
        }
    }
    assert!(worst < 2e-32, "{worst:e}");
}

#[test]
fn try_out() {
    let chain = Chain { masses: 20, ..Chain::default() };
    let scenario = Scenario::draw(&chain, 0.3, &mut NormalPairs::new("reference", 1, 0));
    let t = std::time::Instant::now();
    let hits = Reference::<Dd>::new(&scenario).run(200.0).unwrap();
    println!("{} {:?}", hits.len(), t.elapsed());
    let t = std::time::Instant::now();
    let big = Reference::<Big>::new(&scenario).run(20.0).unwrap();
    println!("{} {:?}", big.len(), t.elapsed());
    let mut worst: f64 = 0.;
    for (a, b) in hits.iter().zip(&big) {
        assert_eq!(a.gap, b.gap);
        let [hi, lo] = a.time.parts();
        worst = worst.max((Big::of(hi) + Big::of(lo) - b.time.clone()).near().abs());
    }
    println!("{worst:e}");
}
