//! The certified first root of a sum of two sinusoids and a constant, in its local frame.

use super::lane::Lane;
use super::local_frame::{Frame, Frequencies, Point};

/// The first root h > 0 of the parabola f + g h − ½ K h², f ≥ 0; `far` if there is none before.
#[inline(always)]
fn parabola<L: Lane>(f: L, g: L, k: L, far: L) -> L {
    let zero = L::splat(0.0);
    let two = L::splat(2.0);
    let discriminant = g * g + two * k * f;
    let root = discriminant.max(zero).sqrt();
    let falling = two * f / (root - g);
    // A convex parabola that rises has no root; a division by zero ends as "none" in `min`.
    let rising = L::select(k.lt(zero), far, (g + root) / k);
    let h = L::select(g.lt(zero), falling, rising);
    L::select(discriminant.lt(zero), far, h).min(far)
}

/// A certified stretch: f > 0 on (s, s + h) for the returned h ≤ `limit`.
///
/// On [0, L] the second derivative is at least f'' + min(0, f''' L) − ½ M₄ L² = −K, so f stays
/// above the parabola f + g h − ½ K h² there, and has no root before the smaller of L and the
/// parabola's first root. Any L gives a certified stretch; two are tried and the longer is taken.
#[inline(always)]
pub fn stretch<L: Lane>(f: L, p: &Point<L>, bound: L, limit: L) -> L {
    let zero = L::splat(0.0);
    let half = L::splat(0.5);
    let certified = |trial: L| {
        let k = (-(p.j * trial)).max(zero) + half * bound * trial * trial - p.h;
        parabola(f, p.g, k, trial)
    };
    // Closing: most gaps shut near the tangent's root; beyond twice that there is no gain.
    // Opening: where f'' > 0, K stays negative up to f''/(|f'''| + √(M₄ f'')) at least.
    let tangent = L::splat(2.0) * f / -p.g;
    let curved = p.h / (p.j.abs() + (bound * p.h.max(zero)).sqrt());
    let opening = L::select(zero.lt(p.h), curved, limit);
    let first = L::select(p.g.lt(zero), tangent, opening).min(limit);
    let h = certified(first);
    let again = (L::splat(1.5) * h).min(limit);
    certified(again).max(h)
}

/// Whether f > 0 is certain on (a, a + h), from value, slope and curvature at both ends.
///
/// The quintic through these six numbers differs from f by at most M₆ t³ (h − t)³/720 (Hermite's
/// remainder), with M₆ ≤ max(ω, Ω)² M₄. Quintic minus remainder is a polynomial of degree six, and
/// its Bernstein coefficients on the interval bound it from below; they need no square root and
/// no division. The first is f(a) ≥ 0 and the last f(b); `slack` covers the rounding of the values.
#[inline]
fn stays_open(a: &Point<f64>, b: &Point<f64>, h: f64, bound6: f64, slack: f64) -> bool {
    let (ga, gb) = (h * a.g, h * b.g);
    let h2 = h * h;
    let (ha, hb) = (h2 * a.h, h2 * b.h);
    let remainder = bound6 * (h2 * h2 * h2) * (1.0 / 14400.0);
    let coefficients = [
        a.f + ga * (1.0 / 6.0),
        a.f + ga * (1.0 / 3.0) + ha * (1.0 / 30.0),
        0.5 * (a.f + b.f) + 0.2 * (ga - gb) + (ha + hb) * (1.0 / 40.0) - remainder,
        b.f - gb * (1.0 / 3.0) + hb * (1.0 / 30.0),
        b.f - gb * (1.0 / 6.0),
    ];
    coefficients.iter().all(|&c| c > slack)
}

/// What a search found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Next {
    /// The first root, at `s`, where f falls with `speed` = −f'(s) ≥ 0.
    Root {
        /// Time since the frame's instant.
        s: f64,
        /// −f' at the root.
        speed: f64,
    },
    /// No root in (0, s].
    Clear {
        /// Certified up to here.
        s: f64,
    },
}

/// Counted work of searches.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Searches started.
    pub searches: u64,
    /// Evaluations of f with its sines (the start costs none).
    pub evaluations: u64,
    /// Decisions taken inside the undecidable band.
    pub undecided: u64,
}

/// The root s + h of the quadratic, which falls there at `slope`, and its speed, with the terms of
/// third to fifth order put in.
///
/// What the quadratic leaves out is below the margin in f, yet not in f': at h = 1e-5 the slope
/// f''' h²/2 is 1e-10, and f'''' h³/6, which has one sign, would take energy from a chain. The two
/// derivatives come from f'''' = −(ω² + Ω²) f'' − ω² Ω² (f − mean), true of any such sum.
/// A grazing root, where the slope left out is not small beside the slope, is left as it is.
fn polish(
    s: f64,
    h: f64,
    slope: f64,
    p: &Point<f64>,
    frame: &Frame<f64>,
    frequencies: &Frequencies,
) -> (f64, f64) {
    let (w2, big_w2) =
        (frequencies.omega * frequencies.omega, frequencies.big_omega * frequencies.big_omega);
    let mean = frame.f0 - frame.alpha - frame.gamma;
    let fourth = -(w2 + big_w2) * p.h - w2 * big_w2 * (p.f - mean);
    let fifth = -(w2 + big_w2) * p.j - w2 * big_w2 * p.g;
    let h2 = h * h;
    let bend = h2 * (0.5 * p.j + h * (fourth * (1.0 / 6.0) + h * fifth * (1.0 / 24.0)));
    if slope <= 2.0 * bend.abs() {
        return ((s + h).max(0.0), slope);
    }
    let speed = slope - bend;
    let left = h2 * h * (p.j * (1.0 / 6.0) + h * (fourth * (1.0 / 24.0)));
    let shift = left / speed;
    ((s + (h + shift)).max(0.0), speed - p.h * shift)
}

/// Evaluations after which a search stops with what is certified so far; its owner resumes it.
const PATIENCE: u32 = 64;

/// The first root of the frame's function after s = 0, or the proof that there is none up to
/// `limit` ≤ reach.
///
/// f₀ > 0: the first root. f₀ = 0: the first root after s = 0 if f leaves zero upwards, and s = 0
/// itself if it moves down. f₀ < 0 is a root at s = 0.
///
/// # Why no root is skipped
/// s only moves over ground that is proven to hold no root, in one of two ways; both bound the
/// exact function from below, and count the rounding of its values against it. A *leap* goes to a
/// point chosen by any guess (the end of the search, or just before a guessed root) and is taken
/// if `stays_open` certifies the interval. Where it does not, `stretch` gives a step that is
/// certain from this side alone. The search ends when the quadratic f + f' h + ½ f'' h² has its root
/// so close that the rest, |f'''| h³/6 + M₄ h⁴/24, is below the margin.
///
/// # The undecidable band
/// Where the minimum of that quadratic lies within two margins of zero, a double cannot tell a
/// grazing impact from a near miss. The quadratic then decides, hit if its minimum is ≤ 0, and the
/// decision is counted in [`Work::undecided`]. A margin is 8 ε times the sum of the absolute
/// values of the terms of f, ε = 2^-52, which is never more than d + 2 (R₁ + R₂) + 3 R₂ Ω/ω.
pub fn first_root(
    frame: &Frame<f64>,
    limit: f64,
    frequencies: &Frequencies,
    work: &mut Work,
) -> Next {
    work.searches += 1;
    let mut p = frame.start(frequencies);
    if p.f < 0.0 || (p.f == 0.0 && p.g < 0.0) {
        return Next::Root { s: 0.0, speed: -p.g };
    }
    let fast = frequencies.omega.max(frequencies.big_omega);
    let bound6 = fast * fast * frame.bound;
    let mut s = 0.0;
    for _ in 0..PATIENCE {
        let in_band = s > 0.0 && p.f <= 2.0 * p.margin;
        // The quadratic through this point; its minimum is −discriminant / 2 f''.
        let discriminant = p.g * p.g - 2.0 * p.h * p.f;
        let root = discriminant.max(0.0).sqrt();
        if p.g < 0.0 && discriminant >= 0.0 {
            let h = 2.0 * p.f / (root - p.g);
            let rest = (p.j.abs() * (1.0 / 6.0) + frame.bound * h * (1.0 / 24.0)) * (h * h * h);
            if in_band || rest <= p.margin {
                work.undecided += u64::from(discriminant <= 4.0 * p.h * p.margin);
                let (s, speed) = polish(s, h, root, &p, frame, frequencies);
                return if s <= limit { Next::Root { s, speed } } else { Next::Clear { s: limit } };
            }
        }
        if !in_band {
            // A leap: to just beyond the guessed root and back, or to the end.
            let mut h = beyond_root(&p, root, discriminant, limit - s);
            let mut b = frame.at(s + h, frequencies);
            work.evaluations += 1;
            if b.f < 0.0
                && let Some(before) = before_root(&p, &b, h, bound6)
            {
                h = before;
                b = frame.at(s + h, frequencies);
                work.evaluations += 1;
            }
            if b.f > b.margin && stays_open(&p, &b, h, bound6, p.margin + b.margin) {
                s += h;
                if s >= limit {
                    return Next::Clear { s: limit };
                }
                p = b;
                continue;
            }
        }
        let h = if in_band && p.h > 0.0 {
            // A dip that the quadratic does not reach zero in: on to where it leaves the band.
            work.undecided += 1;
            let up = (p.g * p.g + 2.0 * p.h * (4.0 * p.margin)).sqrt();
            (up - p.g) / p.h
        } else {
            stretch((p.f - p.margin).max(0.0), &p, frame.bound, limit - s)
        };
        // Where f, f' and f'' vanish to rounding, f''' lifts f: above zero while h < 4 f'''/M₄.
        let h = if h > 0.0 { h } else { 2.0 * p.j.abs() / frame.bound };
        let next = s + h * (1.0 - 4.0 * f64::EPSILON);
        s = if next > s { next } else { s + s * f64::EPSILON };
        if s >= limit {
            return Next::Clear { s: limit };
        }
        p = frame.at(s, frequencies);
        work.evaluations += 1;
    }
    Next::Clear { s }
}

/// A guess of where f, seen from `p`, has just crossed zero; `left` if no root is in sight.
#[inline]
fn beyond_root(p: &Point<f64>, root: f64, discriminant: f64, left: f64) -> f64 {
    let crosses = discriminant > 0.0 && (p.g < 0.0 || p.h < 0.0);
    if !crosses {
        return left;
    }
    let guess = if p.g < 0.0 { 2.0 * p.f / (root - p.g) } else { (root + p.g) / -p.h };
    if guess >= left {
        return left;
    }
    // One Newton step with the cubic term.
    let value = p.f + guess * (p.g + guess * (0.5 * p.h + guess * p.j * (1.0 / 6.0)));
    let slope = p.g + guess * (p.h + guess * 0.5 * p.j);
    let better = guess - value / slope;
    if better > 0.0 { (1.0625 * better).min(left) } else { guess }
}

/// A guess of a point shortly before the first root between `a`, where f > 0, and `b` = a + h,
/// where f < 0, from the quintic through both ends.
#[inline]
fn before_root(a: &Point<f64>, b: &Point<f64>, h: f64, bound6: f64) -> Option<f64> {
    let (ga, gb) = (h * a.g, h * b.g);
    let h2 = h * h;
    let (ha, hb) = (h2 * a.h, h2 * b.h);
    let d = b.f - a.f - ga - 0.5 * ha;
    let e = gb - ga - ha;
    let c = hb - ha;
    let c3 = 10.0 * d - 4.0 * e + 0.5 * c;
    let c4 = -15.0 * d + 7.0 * e - c;
    let c5 = 6.0 * d - 3.0 * e + 0.5 * c;
    // Newton from the right, where the overshoot of the leap is known.
    let mut t = 1.0 - (b.f / gb).clamp(0.0, 0.5);
    let mut slope = gb;
    for _ in 0..2 {
        let value = a.f + t * (ga + t * (0.5 * ha + t * (c3 + t * (c4 + t * c5))));
        slope = ga + t * (ha + t * (3.0 * c3 + t * (4.0 * c4 + t * 5.0 * c5)));
        t -= value / slope;
    }
    // Back by more than the quintic can be wrong, so that f is positive there.
    let wrong = bound6 * (h2 * h2 * h2) * (1.0 / 46080.0) + 4.0 * (a.margin + b.margin);
    t += 2.0 * wrong / slope;
    (slope < 0.0 && t > 0.0 && t < 1.0).then_some(t * h)
}

#[cfg(test)]
mod tests {
    use super::super::lane::Lanes;
    use super::*;
    use crate::numerics::random::NormalPairs;

    const OMEGAS: [[f64; 2]; 4] =
        [[1.0, std::f64::consts::SQRT_2], [1.3, 0.7], [0.2, 3.0], [1.0, 1.0001]];

    /// A frame with normal amplitudes; every third starts shut, every fifth barely.
    fn frame(i: u64, frequencies: &Frequencies) -> Frame<f64> {
        let mut normals = NormalPairs::new("frames", 1, i);
        let [alpha, q] = normals.pair();
        let [gamma, delta] = normals.pair();
        let [width, slope] = normals.pair();
        let (w, big_w) = (frequencies.omega, frequencies.big_omega);
        let f0 = match i {
            i if i % 3 == 0 => 0.0,
            i if i % 5 == 0 => 1e-12 * width.abs(),
            _ => width.abs(),
        };
        let g0 = if f0 == 0.0 { slope.abs() } else { q };
        let r1 = alpha.hypot(g0 / w - big_w / w * delta);
        let r2 = gamma.hypot(delta);
        Frame { f0, g0, alpha, gamma, delta, bound: w.powi(4) * r1 + big_w.powi(4) * r2 }
    }

    /// The second route: f on a fine grid, with the platform's functions, in absolute form.
    #[test]
    fn no_sign_change_is_skipped() {
        let (mut roots, mut evaluations) = (0, 0);
        for [w, big_w] in OMEGAS {
            let frequencies = Frequencies::new(w, big_w);
            for i in 0..3000 {
                let frame = frame(i, &frequencies);
                let q = frame.g0 / w - big_w / w * frame.delta;
                let f = |s: f64| {
                    frame.f0 - frame.alpha - frame.gamma
                        + frame.alpha * (w * s).cos()
                        + q * (w * s).sin()
                        + frame.gamma * (big_w * s).cos()
                        + frame.delta * (big_w * s).sin()
                };
                let mut work = Work::default();
                let limit = frequencies.reach;
                let next = first_root(&frame, limit, &frequencies, &mut work);
                let end = match next {
                    Next::Root { s, speed } => {
                        roots += 1;
                        assert!(f(s).abs() < 1e-14, "frame {i}: f = {:e}", f(s));
                        let numeric = -(f(s + 1e-5) - f(s - 1e-5)) / 2e-5;
                        assert!((speed - numeric).abs() < 1e-8, "{speed} {numeric}");
                        s
                    }
                    Next::Clear { s } => {
                        assert_eq!(s, limit);
                        limit
                    }
                };
                for k in 1..1000 {
                    let s = end * f64::from(k) / 1000.0;
                    assert!(f(s) > -1e-15, "frame {i} of {w}, {big_w}: root before {s}");
                }
                evaluations += work.evaluations;
            }
        }
        assert!((2000..10_000).contains(&roots), "{roots}");
        // Counted work: a change of the algorithm shows here.
        assert!(evaluations < 3 * 12_000, "{evaluations}");
    }

    #[test]
    fn lanes_give_the_bits_of_one() {
        let frequencies = Frequencies::new(1.0, std::f64::consts::SQRT_2);
        let frames = [1, 2, 3, 4].map(|i| frame(i, &frequencies));
        let pack = |of: fn(&Frame<f64>) -> f64| Lanes(frames.map(|f| of(&f)));
        let side = Frame {
            f0: pack(|f| f.f0),
            g0: pack(|f| f.g0),
            alpha: pack(|f| f.alpha),
            gamma: pack(|f| f.gamma),
            delta: pack(|f| f.delta),
            bound: pack(|f| f.bound),
        };
        let s = [0.1, 0.9, 1e-7, 1.3];
        let p = side.at(Lanes(s), &frequencies);
        let h = stretch(p.f, &p, side.bound, Lanes([1.0; 4]));
        for i in 0..4 {
            let one = frames[i].at(s[i], &frequencies);
            assert_eq!([p.f.0[i], p.g.0[i], p.h.0[i], p.j.0[i]], [one.f, one.g, one.h, one.j]);
            assert_eq!(p.margin.0[i], one.margin);
            let alone = stretch(one.f, &one, frames[i].bound, 1.0);
            assert!(h.0[i] == alone || one.f < 0.0);
        }
    }
}
