//! Finds the first root by certified steps: slower than the screen, but always decisive.

use super::local_frame::{Frame, Frequencies, NEARLY_SHUT, Point, ROUNDING};
use super::outcome::{Counters, Next};

#[cfg(test)]
mod tests;

/// Returns the first root h > 0 of f + g h − ½ K h², f ≥ 0; `far` if there is none before it.
#[inline]
fn parabola(f: f64, g: f64, k: f64, far: f64) -> f64 {
    let discriminant = g * g + 2.0 * k * f;
    if discriminant < 0.0 {
        return far;
    }
    let root = discriminant.sqrt();
    // A convex parabola that rises has no root; a division by zero ends as "none" in `min`.
    let h = match (g < 0.0, k < 0.0) {
        (true, _) => 2.0 * f / (root - g),
        (false, true) => far,
        (false, false) => (g + root) / k,
    };
    h.min(far)
}

/// Ratio of stretches above which the trial by the rate is taken: of a gap that barely opens.
const BARELY: f64 = 1e6;

/// Ratio of stretches above which the trial by the width is taken: of a very narrow gap.
const FAR_LARGER: f64 = 1e3;

/// A gap's parts cancel where f'' and f''' are this many times below the bound of the fourth.
const CANCELS: f64 = 1e4;

// listing: stretch
/// Returns the length h ≤ `limit` of a certified stretch: f > 0 on (s, s + h).
///
/// On [0, L] the second derivative is at least f'' + min(0, f''' L) − ½ M₄ L² = −K, so f
/// stays above the parabola f + f' h − ½ K h² there, and has no root before the smaller of L
/// and the parabola's first root. Any L gives a certified stretch; two are tried and the longer is
/// taken. At L that is six times what M₄ can do to f, so half of its term would be right too.
fn stretch<const M: usize>(f: f64, p: &Point<M>, bound: f64, limit: f64) -> f64 {
    let certified = |trial: f64| {
        let k = (-(p.d3 * trial)).max(0.0) + 0.5 * bound * trial * trial - p.d2;
        parabola(f, p.d1, k, trial)
    };
    // Closing: most gaps shut near the tangent's root; beyond twice that there is no gain.
    // Opening: where f'' > 0, K stays negative up to f''/(|f'''| + √(M₄ f'')) at least.
    let first = if p.d1 < 0.0 {
        2.0 * f / -p.d1
    } else if p.d2 > 0.0 {
        p.d2 / (p.d3.abs() + (bound * p.d2).sqrt())
    } else {
        limit
    };
    let h = certified(first.min(limit));
    // A trial was bad if f or f' with the term of M₄ alone allow far more; only then try others.
    let cube = bound * (h * h * h);
    let far_larger = (FAR_LARGER * FAR_LARGER) * (FAR_LARGER * FAR_LARGER);
    let barely = BARELY * BARELY * BARELY;
    if cube * h * far_larger < 4.0 * f || cube * barely < 4.0 * p.d1 {
        let [by_rate, by_width] = by_one_term(f, p, bound);
        if p.d2 <= 0.0 && by_rate > BARELY * h || by_width > FAR_LARGER * h {
            return certified(by_rate.max(by_width).min(limit)).max(h);
        }
    }
    certified((1.5 * h).min(limit)).max(h)
}
// end

/// Returns the stretches that the worst term of K allows, by the rate and by the width: trials
/// alone, each of which is certified.
#[cold]
fn by_one_term<const M: usize>(f: f64, p: &Point<M>, bound: f64) -> [f64; 2] {
    let (down, third) = ((-p.d2).max(0.0), p.d3.abs());
    let by_rate = (2.0 * p.d1 / down).min((2.0 * p.d1 / third).sqrt());
    let by_width = (f / (-p.d1).max(0.0)).min((2.0 * f / down).sqrt());
    let by_width = by_width.min(pxfm::f_cbrt(2.0 * f / third));
    [by_rate.min(pxfm::f_cbrt(4.0 * p.d1 / bound)), by_width.min((4.0 * f / bound).sqrt().sqrt())]
}

/// Returns whether f > 0 is certain on (a, a + h), from value, slope and curvature at both ends.
///
/// The quintic through these six numbers differs from f by at most M₆ t³ (h − t)³/720
/// (Hermite's remainder), with M₆ ≤ max(ω, Ω)² M₄. Quintic minus remainder is a polynomial
/// of degree six, and its Bernstein coefficients on the interval bound it from below. The first is
/// f(a) ≥ 0 and the last f(b); `slack` covers the rounding of the values.
#[inline]
fn stays_open<const M: usize>(a: &Point<M>, b: &Point<M>, h: f64, bound6: f64, slack: f64) -> bool {
    let (ga, gb) = (h * a.d1, h * b.d1);
    let h2 = h * h;
    let (ha, hb) = (h2 * a.d2, h2 * b.d2);
    let remainder = bound6 * (h2 * h2 * h2) * (1.0 / 14400.0); // t³ (h − t)³ = h⁶ B₃/20
    let coefficients = [
        a.f + ga * (1.0 / 6.0),
        a.f + ga * (1.0 / 3.0) + ha * (1.0 / 30.0),
        0.5 * (a.f + b.f) + 0.2 * (ga - gb) + (ha + hb) * (1.0 / 40.0) - remainder,
        b.f - gb * (1.0 / 3.0) + hb * (1.0 / 30.0),
        b.f - gb * (1.0 / 6.0),
    ];
    coefficients.iter().all(|&c| c > slack)
}

/// Returns order and value of the first of f'', f''', f'''' above `times` its rounding, or
/// `None` if all are below.
fn leading<const M: usize>(
    p: &Point<M>,
    times: f64,
    frame: &Frame<M>,
    frequencies: &Frequencies<M>,
) -> Option<(u32, f64)> {
    let fast = frequencies.fastest;
    let rounding = times * ROUNDING * fast * fast * frame.size;
    if p.d2.abs() > rounding {
        return Some((2, p.d2));
    }
    if p.d3.abs() > rounding * fast {
        return Some((3, p.d3));
    }
    let [fourth, _] = p.higher(frequencies);
    (fourth.abs() > rounding * fast * fast).then_some((4, fourth))
}

/// Returns the length of a stretch over which f''' > 0 alone, or f'''' > 0 where f''' is zero too,
/// lifts f from a point where it does not fall and f'' is zero, all to rounding; 0 if none.
///
/// With f, f' ≥ 0, f ≥ f'' h²/2 + f''' h³/12 while h ≤ 2 f'''/M₄. That is never below
/// −(8/3) |f''|³/f'''², far less than the rounding of positions, and positive from h = 6
/// |f''|/f''' on. Likewise with f'''' and M₅ ≤ max(ω, Ω) M₄.
fn lift<const M: usize>(p: &Point<M>, frame: &Frame<M>, frequencies: &Frequencies<M>) -> f64 {
    match leading(p, 1.0, frame, frequencies).filter(|_| p.d1 >= 0.0) {
        Some((3, third)) if third > 0.0 => 2.0 * third / frame.bound,
        Some((4, fourth)) if fourth > 0.0 => 2.0 * fourth / (frequencies.fastest * frame.bound),
        _ => 0.0,
    }
}

/// Evaluations after which a search stops with the stretch certified so far, until later.
const PATIENCE: u32 = 64;

// listing: first_root_by_steps
/// Finds the first root after `from`, where f ≥ 0, or proves that there is none up to `limit`.
///
/// # Why no root is skipped
/// s only advances over intervals that are proven to hold no root, in one of two ways; both bound
/// the exact function from below, and count the rounding of its values against it. A *leap* goes to
/// a point chosen by any guess (the end of the search, or just before a guessed root) and is taken
/// if `stays_open` certifies the interval. Where it does not, `stretch` gives a step that is
/// certain from this side alone; if that is far shorter, because the parts of a gap cancel, halves
/// of the leap are tried first. The search ends when the quadratic f + f' h + ½ f'' h² has its
/// root so close that the rest, |f'''| h³/6 + M₄ h⁴/24, is below the margin.
///
/// # The undecidable band
/// Where the minimum of that quadratic lies within two margins of zero, a double cannot tell a
/// grazing impact from a near miss. It is taken for a miss, so an exact graze is right, and is
/// counted in [`Counters::undecided`]. A margin is 8 ε times the sum of the absolute values of the
/// terms of f, ε = 2^-52; that sum is at most d + 2 (R₁ + R₂) + 3 R₂ Ω/ω. It is at least the
/// rounding of the frame itself, unless the gap was nearly shut at its instant.
pub fn first_root_by_steps<const M: usize>(
    frame: &Frame<M>,
    from: f64,
    limit: f64,
    frequencies: &Frequencies<M>,
    work: &mut Counters,
) -> Next {
    let fast = frequencies.fastest;
    let bound6 = fast * fast * frame.bound;
    // A frame that does not begin at an impact is itself rounded.
    let carried = frame.f0 <= NEARLY_SHUT * frame.size;
    let rounding = if carried { 0.0 } else { 2.0 * f64::EPSILON * frame.size };
    let mut s = from;
    let mut p = if s == 0.0 {
        frame.start(frequencies)
    } else {
        work.evaluations += 1;
        frame.at(s, frequencies)
    };
    // Shut and at rest, and pressed together by more than rounding: they touch, and stay.
    let pressed = |lead| matches!(lead, Some((2, second)) if second < 0.0);
    if s == 0.0 && p.f == 0.0 && p.d1 == 0.0 && pressed(leading(&p, 2.0, frame, frequencies)) {
        return Next::Root { s, speed: 0.0 };
    }
    for _ in 0..PATIENCE {
        let in_band = s > 0.0 && p.f <= 2.0 * p.margin;
        // The quadratic through this point; its minimum is −discriminant / 2 f''.
        let discriminant = p.d1 * p.d1 - 2.0 * p.d2 * p.f;
        let root = discriminant.max(0.0).sqrt();
        if p.d1 < 0.0 && discriminant >= 0.0 {
            let h = 2.0 * p.f / (root - p.d1);
            let rest = (p.d3.abs() * (1.0 / 6.0) + frame.bound * h * (1.0 / 24.0)) * (h * h * h);
            let near = in_band || rest <= p.margin;
            if near && discriminant > 4.0 * p.d2 * p.margin.max(rounding) {
                let (s, speed) = polish(s, h, root, &p, frequencies);
                return if s <= limit { Next::Root { s, speed } } else { Next::Clear { s: limit } };
            }
            if near {
                // To where the quadratic is above the band again.
                work.undecided += 1;
                work.dip = s - p.d1 / p.d2;
                s += climb(&p, rounding);
                if s >= limit {
                    return Next::Clear { s: limit };
                }
                p = frame.at(s, frequencies);
                work.evaluations += 1;
                continue;
            }
        }
        let mut leap = 0.0;
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
            leap = h;
        }
        let h = if in_band && p.d2 > 0.0 {
            // A dip in which the quadratic does not reach zero.
            work.undecided += 1;
            work.dip = s - p.d1 / p.d2;
            climb(&p, rounding)
        } else {
            stretch((p.f - p.margin).max(0.0), &p, frame.bound, limit - s)
        };
        if FAR_LARGER * h < leap
            && fast * (fast * p.d2.abs() + p.d3.abs()) * CANCELS < frame.bound
            && let Some((h, b)) = shorter_leap(&p, s, [h, leap], frame, frequencies, work)
        {
            (s, p) = (s + h, b);
            continue;
        }
        // Where f, f' and f'' vanish, f''' lifts f: above zero while h < 4 f'''/M₄.
        let h = if h > 0.0 { h } else { 2.0 * p.d3.abs() / frame.bound };
        let h = h.max(lift(&p, frame, frequencies));
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
// end

/// Widths above this fraction of the size of a frame are no part of a dip that rounding hides.
pub const SHALLOW: f64 = 1e-6;

/// Returns the dip of a frame from the motions that rounding hides and a time after it, or `None`
/// if there is no such dip.
#[cold]
pub fn hidden_dip<const M: usize>(
    frame: &Frame<M>,
    frequencies: &Frequencies<M>,
) -> Option<[f64; 2]> {
    let (p, rounding) = (frame.start(frequencies), 2.0 * f64::EPSILON * frame.size);
    let dip = -p.d1 / p.d2;
    let rest = (p.d3.abs() * (1.0 / 6.0) + frame.bound * dip * (1.0 / 24.0)) * (dip * dip * dip);
    let lowest = p.f + 0.5 * p.d1 * dip;
    let is_hidden = dip > 0.0 && rest <= rounding && lowest.abs() <= 2.0 * rounding;
    is_hidden.then(|| [dip, climb(&p, rounding)])
}

/// Returns the time from a point of a dip to where its quadratic is above the band again.
fn climb<const M: usize>(p: &Point<M>, rounding: f64) -> f64 {
    let up = (p.d1 * p.d1 + 8.0 * p.d2 * p.margin.max(rounding)).sqrt();
    (up - p.d1) / p.d2
}

/// Returns the longest certain one of the halves, quarters, … of a leap, beyond a step.
#[cold]
fn shorter_leap<const M: usize>(
    p: &Point<M>,
    s: f64,
    [step, leap]: [f64; 2],
    frame: &Frame<M>,
    frequencies: &Frequencies<M>,
    work: &mut Counters,
) -> Option<(f64, Point<M>)> {
    let bound6 = frequencies.fastest * frequencies.fastest * frame.bound;
    let mut h = 0.5 * leap;
    while h > step {
        let b = frame.at(s + h, frequencies);
        work.evaluations += 1;
        if b.f > b.margin && stays_open(p, &b, h, bound6, p.margin + b.margin) {
            return Some((h, b));
        }
        h *= 0.5;
    }
    None
}

/// Guesses from `p` where f has just crossed zero; returns `left` if no root is near.
#[inline]
fn beyond_root<const M: usize>(p: &Point<M>, root: f64, discriminant: f64, left: f64) -> f64 {
    let crosses = discriminant > 0.0 && (p.d1 < 0.0 || p.d2 < 0.0);
    if !crosses {
        return left;
    }
    let guess = if p.d1 < 0.0 { 2.0 * p.f / (root - p.d1) } else { (root + p.d1) / -p.d2 };
    if guess >= left {
        return left;
    }
    // One Newton step with the cubic term.
    let value = p.f + guess * (p.d1 + guess * (0.5 * p.d2 + guess * p.d3 * (1.0 / 6.0)));
    let slope = p.d1 + guess * (p.d2 + guess * 0.5 * p.d3);
    let better = guess - value / slope;
    if better > 0.0 { (1.0625 * better).min(left) } else { guess }
}

/// Guesses a point before the first root in (`a`, a + h) by the quintic of both ends, or returns
/// `None` if the quintic has no root there.
#[inline]
fn before_root<const M: usize>(a: &Point<M>, b: &Point<M>, h: f64, bound6: f64) -> Option<f64> {
    let (ga, gb) = (h * a.d1, h * b.d1);
    let h2 = h * h;
    let (ha, hb) = (h2 * a.d2, h2 * b.d2);
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

/// Corrects the root s + h of the quadratic about a point, which falls there at `slope`, by the
/// terms of higher order; returns the root and the speed at it.
///
/// What the quadratic leaves out is below the margin in f, yet not in f': at h = 1e-5 the slope
/// f''' h²/2 is 1e-10, and f'''' h³/6, which has one sign, would take energy from a chain.
/// A grazing root, where these terms are not small compared with the slope, is not changed.
fn polish<const M: usize>(
    s: f64,
    h: f64,
    slope: f64,
    p: &Point<M>,
    frequencies: &Frequencies<M>,
) -> (f64, f64) {
    let [fourth, fifth] = p.higher(frequencies);
    let (c3, c4, c5) = (p.d3 * (1.0 / 6.0), fourth * (1.0 / 24.0), fifth * (1.0 / 120.0));
    let h2 = h * h;
    let bend = h2 * (3.0 * c3 + h * (4.0 * c4 + h * 5.0 * c5));
    if slope <= 2.0 * bend.abs() {
        return ((s + h).max(0.0), slope);
    }
    let speed = slope - bend;
    let shift = h2 * h * (c3 + h * c4) / speed;
    let fall = speed - p.d2 * shift;
    if fall < 0.0 {
        return ((s + h).max(0.0), slope);
    }
    ((s + (h + shift)).max(0.0), fall)
}
