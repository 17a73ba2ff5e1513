//! Compares Eqs. (11) to (18) and the actual jump with exact and 67-digit arithmetic.

use crate::distribution::weights;
use crate::{Big, big, exp, int, near, relative_error};
use SampleSpace::{FiveClasses, FiveClassesPrinted, Simple};
use dashu_int::UBig;
use impact_circuits::distribution::{Law, SampleSpace};
use impact_circuits::jump;

#[test]
fn p_crit_to_the_last_digits() {
    for big_n in [1, 2, 3, 4, 99, 100, 101, 1000, 10_000_000] {
        let root = (int(1) + int(big_n + 1).sqrt()) / int(big_n);
        let ours = jump::p_crit(big_n).unwrap();
        assert!(relative_error(ours, &(root.clone() * root)) < 1e-15, "N = {big_n}");
    }
}

/// p_jump from its definition for simple circuits: Φ(k) = Φ(1) at p^(k−1) = k (N − k)!/(N −
/// 1)!, so the infimum is the least (k − 1)-th root over k, taken through logarithms.
fn p_jump_by_roots(big_n: usize) -> (Big, usize) {
    let mut falling = UBig::ONE;
    let mut best: Option<(Big, usize)> = None;
    for k in 2..=big_n {
        falling *= UBig::from(big_n + 1 - k);
        let quotient = int(k) / Big::from(dashu_int::IBig::from(falling.clone()));
        let log = quotient.with_precision(crate::BITS).value().ln() / int(k - 1);
        // Of equal roots the larger k wins just after the jump.
        if best.as_ref().is_none_or(|(least, _)| near(&(log.clone() - least)) < 1e-50) {
            best = Some((log, k));
        }
    }
    let (log, k) = best.unwrap();
    (exp(log), k)
}

/// The jump, whose bracket are neighbours between which k* leaves 1.
fn bracketed(space: SampleSpace, big_n: usize) -> jump::Jump {
    let leap = jump::p_jump(space, big_n).unwrap();
    let [below, above] = leap.bracket;
    assert_eq!(below.next_up(), above);
    assert!(leap.p == below || leap.p == above);
    let k_star = |p| Law::new(space, big_n, p).unwrap().k_star();
    assert_eq!((k_star(below), k_star(above)), (1, leap.k_after), "{space:?} N = {big_n}");
    leap
}

#[test]
fn jump_agrees_with_roots_of_exact_integers() {
    for big_n in [4, 5, 6, 10, 50, 100, 101, 171, 400] {
        let (exact, k) = p_jump_by_roots(big_n);
        let ours = bracketed(Simple, big_n);
        assert!(relative_error(ours.p, &exact) < 1.2e-16, "N = {big_n}: {:e}", ours.p);
        assert_eq!(ours.k_after, k, "N = {big_n}");
        let [below, above] = ours.bracket;
        // To 60 digits the root of N = 5 is 1/2 itself.
        let slack = big(1e-50);
        assert!(big(below) <= exact.clone() + &slack && exact <= big(above) + slack);
    }
}

#[test]
fn jump_of_a_million_vertices() {
    // Φ(k)/Φ(1) in 67-digit arithmetic at both ends of the bracket, and the root at its k.
    let big_n = 1_000_000;
    let leap = jump::p_jump(Simple, big_n).unwrap();
    let exceeds = |p: f64| {
        let mut ratio = int(1);
        (2..=3 * leap.k_after).any(|k| {
            ratio *= big(p) * int(big_n + 1 - k);
            ratio > int(k)
        })
    };
    assert!(!exceeds(leap.bracket[0]) && exceeds(leap.bracket[1]));
    let falling = (2..=leap.k_after).fold(int(1), |product, k| product * int(big_n + 1 - k));
    let log = (int(leap.k_after) / falling).ln();
    assert!(relative_error(leap.p, &exp(log / int(leap.k_after - 1))) < 1e-14);
}

#[test]
fn jump_of_five_classes_is_bracketed_to_the_last_bit() {
    for space in [FiveClasses, FiveClassesPrinted] {
        // In 67-digit arithmetic, whether the weight of some k > 1 exceeds that of k = 1.
        let exceeded = |big_n: usize, p: f64| {
            let weights = weights(space, big_n, p);
            weights.iter().any(|weight| *weight > weights[0])
        };
        for big_n in [2, 3, 4, 10, 100, 101, 300] {
            let [below, above] = bracketed(space, big_n).bracket;
            assert!(!exceeded(big_n, below) && exceeded(big_n, above), "{space:?} N = {big_n}");
        }
    }
}

#[test]
fn first_local_maximum_over_integers() {
    for big_n in 3..=60 {
        let (k, [top, below]) = jump::first_local_maximum(big_n).unwrap();
        let p = top as f64 / below as f64;
        // Just before, nothing rises from k > 1 on; just after, Φ rises from k to k + 1.
        assert!((2..big_n).all(|j| !jump::rises(big_n, p * (1.0 - 1e-14), j)), "N = {big_n}");
        assert!(jump::rises(big_n, p * (1.0 + 1e-14), k));
        assert!(p >= jump::p_crit(big_n).unwrap() * (1.0 - 1e-15));
    }
    assert_eq!(jump::first_local_maximum(2), None);
}
