//! Functions that touch the bounds of certified steps from the wrong side.

use super::*;
use crate::search::truth::derivative;

fn frequencies() -> Frequencies<1> {
    Frequencies::new(1.0, [2.0])
}

/// Returns a point with this value and these three derivatives.
fn point([f0, g0, d2, d3]: [f64; 4]) -> Point<1> {
    let forced = [[0.0, -(g0 + d3) / 6.0]];
    Frame { f0, g0, alpha: -d2, forced, ..Frame::ZERO }.start(&frequencies())
}

/// Of all functions with the same start and |f''''| ≤ M₄ the lowest has f'''' = −M₄.
#[test]
fn the_lowest_function_is_above_zero_on_a_stretch() {
    for i in 0..256 {
        let pick = |place: u32| [-1.0, 0.0, 1e-3, 1.0][i >> (2 * place) & 3];
        let (f, d1, d2, d3) = ([1e-6, 1.0][i >> 6 & 1], pick(0), pick(1), pick(2));
        let bound = [0.1, 10.0][i >> 7];
        let h = stretch(f, &point([f, d1, d2, d3]), bound, 10.0);
        for t in (1..64).map(|i| h * f64::from(i) / 64.0) {
            let lowest = f + t * (d1 + t * (d2 / 2.0 + t * (d3 / 6.0 - t * bound / 24.0)));
            assert!(lowest > 0.0, "{f}, {d1}, {d2}, {d3}, {bound}: {lowest:e} at {t} of {h}");
        }
    }
    // f ≥ 1 − ½ K h²: K = ½ M₄ L² is 2 for L = 2, and 9/8 for L = 3/2, which allows more.
    assert!((stretch(1.0, &point([1.0, 0.0, 0.0, 0.0]), 1.0, 2.0) - 4.0 / 3.0).abs() < 1e-15);
}

/// Among the stretches that other trials L allow none is far longer than the one that is taken.
#[test]
fn a_stretch_is_nearly_the_longest_of_its_kind() {
    let pick = |i: usize, place: u32| [-1.0, 1e-9, 1.0][i / 3_usize.pow(place) % 3];
    for i in 0..81 {
        let (f, d1) = ([1e-24, 1e-8, 1.0][i / 27], pick(i, 0));
        let (d2, d3, bound) = (-pick(i, 1), pick(i, 2), 10.0);
        let certified = |trial: f64| {
            let k = (-d3 * trial).max(0.0) + 0.5 * bound * trial * trial - d2;
            let root = (d1 * d1 + 2.0 * k * f).sqrt();
            let zero = if d1 < 0.0 { 2.0 * f / (root - d1) } else { (d1 + root) / k };
            if root.is_nan() || zero < 0.0 { trial } else { trial.min(zero) }
        };
        let best = (-320..=10).map(|i| certified(1.25_f64.powi(i))).fold(0.0, f64::max);
        let h = stretch(f, &point([f, d1, d2, d3]), bound, 10.0);
        assert!(best < FAR_LARGER * h, "{f}, {d1}, {d2}, {d3}: {h:e} of {best:e}");
    }
}

/// An interval is open if each inner Bernstein coefficient is, of which one is at the limit.
#[test]
fn a_leap_is_open_as_far_as_its_remainder_allows() {
    const H: f64 = 0.5;
    for (i, sign) in (1..6).flat_map(|i| [(i, 1.0), (i, -1.0)]) {
        let slack = 0.01;
        let mut b = [1.0, 1.0, 1.0, 0.2, 1.0, 1.0, 1.0];
        b[i] = slack + sign * 1e-9;
        let end = |[b, c, d]: [f64; 3], h: f64| {
            point([b, 6.0 * (c - b) / h, 30.0 * (d - 2.0 * c + b) / (h * h), 0.0])
        };
        let sixth = b[0] - 6.0 * b[1] + 15.0 * b[2] - 20.0 * b[3] + 15.0 * b[4] - 6.0 * b[5] + b[6];
        let (left, right) = (end([b[0], b[1], b[2]], H), end([b[6], b[5], b[4]], -H));
        let open = stays_open(&left, &right, H, 720.0 * sixth / H.powi(6), slack);
        assert_eq!(open, sign > 0.0, "coefficient {i}, {sign}");
    }
}

/// The lowest functions again: those that f''' or f'''' alone lifts are as high as promised.
#[test]
fn a_lift_ends_above_zero() {
    let frame = Frame { bound: 2.0, size: 1.0, ..Frame::ZERO };
    let h = lift(&point([0.0, 0.0, 0.0, 6.0]), &frame, &frequencies());
    let lowest = 6.0 * h.powi(3) / 6.0 - 2.0 * h.powi(4) / 24.0;
    assert!(h == 6.0 && lowest >= 6.0 * h.powi(3) / 12.0, "{h}, {lowest}");
    let fourth = Frame { alpha: -4.0, forced: [[1.0, 0.0]], ..frame };
    let h = lift(&fourth.start(&frequencies()), &fourth, &frequencies());
    let lowest = 12.0 * h.powi(4) / 24.0 - 4.0 * h.powi(5) / 120.0;
    assert!(h == 6.0 && lowest >= 12.0 * h.powi(4) / 40.0, "{h}, {lowest}");
    for start in [[0.0, 0.0, 0.0, -6.0], [0.0, -1e-9, 0.0, 6.0]] {
        assert_eq!(lift(&point(start), &frame, &frequencies()), 0.0);
    }
}

/// From the lowest dip that counts as a miss, two margins below zero, to two above.
#[test]
fn a_climb_ends_above_the_band() {
    for [d1, d2] in [[0.0, 1.0], [-1e-3, 0.5], [1e-3, 2.0]] {
        let (margin, f) = (1e-8, 0.5 * d1 * d1 / d2 - 2e-8);
        let h = climb(&point([f, d1, d2, 0.0]), margin);
        let above = f + h * (d1 + 0.5 * d2 * h);
        assert!(h > 0.0 && above > 2.0 * margin * (1.0 - 1e-6), "{d1}, {d2}: {above:e}");
    }
}

/// δ − (cos σx − c)³, where cos σx = c at both ends: value δ, and no slope or curvature, so the
/// quintic is δ, and the remainder alone tells that the function goes below zero between.
#[test]
fn a_dip_that_neither_end_shows_is_not_leapt_over() {
    const SIGMA: f64 = 16.0;
    let frequencies = Frequencies::new(SIGMA, [2.0 * SIGMA, 3.0 * SIGMA]);
    let edge = 0.5 * SIGMA * frequencies.reach;
    let c = edge.cos();
    let parts = [(1.0, -0.75 - 3.0 * c * c), (2.0, 1.5 * c), (3.0, -0.25_f64)];
    let bound = parts.iter().map(|(n, r)| (n * SIGMA).powi(4) * r.abs()).sum();
    let [free, forced @ ..] = parts.map(|(n, r)| [r * (n * edge).cos(), r * (n * edge).sin()]);
    let f0 = 0.98 * (1.0 - c).powi(3);
    let frame = Frame { f0, g0: 0.0, alpha: free[0], forced, bound, size: 20.0 };
    let (reach, mut work) = (frequencies.reach, Counters::default());
    let next = first_root_by_steps(&frame, 0.0, reach, &frequencies, &mut work);
    let exact = (edge - (c + f0.cbrt()).acos()) / SIGMA;
    assert!(matches!(next, Next::Root { s, .. } if (s - exact).abs() < 1e-12), "{next:?}");
    assert_eq!(work.evaluations, 5);
}

/// Quadratics with the roots 1/2 and 1, and the corrections of their cubics by hand.
#[test]
fn a_guess_goes_beyond_the_root_of_the_cubic() {
    let guess = |[f, d1, d2, d3]: [f64; 4], left| {
        let discriminant = d1 * d1 - 2.0 * d2 * f;
        let root = discriminant.max(0.0).sqrt();
        beyond_root(&point([f, d1, d2, d3]), root, discriminant, left)
    };
    for (p, left, expected) in [
        ([1.0, -3.0, 4.0, 0.0], 9.0, 1.0625 * 0.5),
        ([1.0, -3.0, 4.0, 2.4], 9.0, 1.0625 * (0.5 + 0.05 / 0.7)),
        ([1.0, 1.0, -4.0, 3.0], 9.0, 1.0625 * (1.0 + 0.5 / 1.5)),
        ([1.0, -3.0, 4.0, 2.4], 0.6, 0.6),
        ([1.0, -3.0, 4.0, 2.4], 0.4, 0.4),
        ([1.0, 1.0, 4.0, 0.0], 9.0, 9.0),
        ([1.0, -1.0, 4.0, 0.0], 9.0, 9.0),
        ([1.0, 1.0, -4.0, 24.0], 9.0, 1.0625 * (1.0 - 4.0 / 9.0)),
        ([1.0, 1.0, -4.0, 7.0], 9.0, 1.0),
    ] {
        assert!((guess(p, left) - expected).abs() < 1e-15, "{p:?}, {left}: {}", guess(p, left));
    }
}

/// A quintic that falls through zero at 0.4, less twice what M₆ h⁶/46080 moves it.
#[test]
fn a_guess_goes_before_the_root_of_the_quintic() {
    const H: f64 = 0.5;
    // (0.4 − s)(1 + s + 2 s² − 3 s³ + s⁴), by falling powers.
    let p = [-1.0, 3.4, -3.2, -0.2, -0.6, 0.4];
    let point_at = |s: f64| {
        let mut p = p.to_vec();
        let derivatives: Vec<f64> = (0..4)
            .map(|_| {
                let value = p.iter().fold(0.0, |sum, c| sum * s + c);
                let degree = p.len() - 1;
                p = (0..degree).map(|i| p[i] * (degree - i) as f64).collect();
                value
            })
            .collect();
        point(derivatives.try_into().unwrap())
    };
    let guess = |bound6| before_root(&point_at(0.0), &point_at(H), H, bound6).unwrap();
    let slope = H * point_at(0.4).d1;
    assert!((guess(0.0) - 0.4).abs() < 1e-6, "{}", guess(0.0));
    let back = H * 2.0 * (100.0 * H.powi(6) / 46080.0) / slope;
    assert!(((guess(100.0) - guess(0.0)) / back - 1.0).abs() < 1e-3, "{}", guess(100.0));
    assert_eq!(before_root(&point_at(0.0), &point_at(H), H, 1e6), None);
}

/// Roots of gaps that close steeply, near h = 1e-3 and 1e-2: the speed is right to order h⁴.
#[test]
fn a_root_is_corrected_by_the_terms_of_higher_order() {
    for (alpha, h, close, exact) in [(3.0, 1e-3, 1e-16, 3e-12), (-2.0, 1e-2, 3e-12, 2e-8)] {
        let frame = Frame { f0: 10.0 * h, g0: -10.0, alpha, bound: 9.0, ..Frame::ZERO };
        let frame = Frame { forced: [[0.5, 0.25]], ..frame };
        let p = frame.start(&frequencies());
        let root = (p.d1 * p.d1 - 2.0 * p.d2 * p.f).sqrt();
        let (s, speed) = polish(0.0, 2.0 * p.f / (root - p.d1), root, &p, &frequencies());
        let f = |order| derivative(&frame, &frequencies(), order, s);
        assert!(f(0).abs() < close && (f(1) + speed).abs() < exact, "{alpha}, {h}: {s} {speed}");
    }
}
