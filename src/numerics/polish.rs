//! A root to full accuracy from one nearby point, by its Taylor polynomial of degree seven.

use super::local_frame::{Frequencies, Point};

/// How far from a point the Taylor polynomial serves, over the fastest frequency: what it leaves
/// out is (0.016)⁸/8! < 1e-19 of f's size and (0.016)⁷/7! < 6e-17 of its slope's.
const RADIUS: f64 = 0.016;

/// Newton steps that are enough: the first leaves at most the square of [`RADIUS`].
const STEPS: u32 = 5;

/// Value and slope of the Taylor polynomial about a point.
struct Taylor {
    value: [f64; 8],
}

impl Taylor {
    #[inline(always)]
    fn about<const M: usize>(p: &Point<M>, frequencies: &Frequencies<M>) -> Taylor {
        let [fourth, fifth, sixth, seventh] = p.higher(frequencies);
        Taylor {
            value: [
                p.f,
                p.g,
                p.h * (1.0 / 2.0),
                p.j * (1.0 / 6.0),
                fourth * (1.0 / 24.0),
                fifth * (1.0 / 120.0),
                sixth * (1.0 / 720.0),
                seventh * (1.0 / 5040.0),
            ],
        }
    }

    #[inline(always)]
    fn at(&self, h: f64) -> [f64; 2] {
        let c = &self.value;
        let h2 = h * h;
        let value = (c[0] + h * c[1])
            + h2 * ((c[2] + h * c[3]) + h2 * ((c[4] + h * c[5]) + h2 * (c[6] + h * c[7])));
        let slope = (c[1] + h * (2.0 * c[2]))
            + h2 * ((3.0 * c[3] + h * (4.0 * c[4]))
                + h2 * ((5.0 * c[5] + h * (6.0 * c[6])) + h2 * (7.0 * c[7])));
        [value, slope]
    }
}

/// The root s + h near the point at s where f falls, and its speed; nothing if it is not near.
#[inline(always)]
pub fn refine<const M: usize>(
    s: f64,
    p: &Point<M>,
    frequencies: &Frequencies<M>,
) -> Result<(f64, f64), f64> {
    let radius = RADIUS / frequencies.fastest;
    // Halley's step.
    let mut h = 2.0 * p.f * p.g / (p.f * p.h - 2.0 * p.g * p.g);
    if h.abs().partial_cmp(&radius).is_none_or(|order| order.is_gt()) {
        return Err(h);
    }
    let taylor = Taylor::about(p, frequencies);
    for _ in 0..STEPS {
        let [value, slope] = taylor.at(h);
        let step = -value / slope;
        h += step;
        // What the next step would change is below step² |f''/f'|.
        if step.abs() <= 1e-9 * radius {
            let curvature = p.h + h * p.j;
            return Ok((s + h, -(slope + step * curvature)));
        }
    }
    Err(h)
}

/// The root s + h of the quadratic about a point, which falls there at `slope`, put right by the
/// terms of higher order.
///
/// What the quadratic leaves out is below the margin in f, yet not in f': at h = 1e-5 the slope
/// f''' h²/2 is 1e-10, and f'''' h³/6, which has one sign, would take energy from a chain.
/// A grazing root, where the slope left out is not small beside the slope, is left as it is.
pub fn polish<const M: usize>(
    s: f64,
    h: f64,
    slope: f64,
    p: &Point<M>,
    frequencies: &Frequencies<M>,
) -> (f64, f64) {
    let taylor = Taylor::about(p, frequencies);
    let [.., c3, c4, c5, _, _] = taylor.value;
    let h2 = h * h;
    let bend = h2 * (3.0 * c3 + h * (4.0 * c4 + h * 5.0 * c5));
    if slope <= 2.0 * bend.abs() {
        return ((s + h).max(0.0), slope);
    }
    let speed = slope - bend;
    let shift = h2 * h * (c3 + h * c4) / speed;
    ((s + (h + shift)).max(0.0), speed - p.h * shift)
}
