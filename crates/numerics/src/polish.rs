//! A root to full accuracy from one nearby point, by its Taylor polynomial of degree nine.

use super::local_frame::{Frequencies, Point};

/// How far from a point the Taylor polynomial serves, over the fastest frequency: what it leaves
/// out is 0.06¹⁰/10! < 2e-19 of f's size and 0.06⁹/9! < 3e-17 of its slope's.
const RADIUS: f64 = 0.06;

/// Steps of third order that are enough: the first leaves at most the cube of [`RADIUS`].
const STEPS: u32 = 4;

/// The Taylor polynomial about a point.
struct Taylor([f64; 10]);

impl Taylor {
    #[inline(always)]
    fn about<const M: usize>(p: &Point<M>, frequencies: &Frequencies<M>) -> Taylor {
        let [fourth, fifth, sixth, seventh, eighth, ninth] = p.higher(frequencies);
        Taylor([
            p.f,
            p.g,
            p.h * (1.0 / 2.0),
            p.j * (1.0 / 6.0),
            fourth * (1.0 / 24.0),
            fifth * (1.0 / 120.0),
            sixth * (1.0 / 720.0),
            seventh * (1.0 / 5040.0),
            eighth * (1.0 / 40_320.0),
            ninth * (1.0 / 362_880.0),
        ])
    }

    /// Value and slope at h, in short chains of dependent operations.
    #[inline(always)]
    fn at(&self, h: f64) -> [f64; 2] {
        let c = &self.0;
        let (h2, h4) = (h * h, (h * h) * (h * h));
        let pair = |i: usize| c[i] + h * c[i + 1];
        let value = (pair(0) + h2 * pair(2)) + h4 * ((pair(4) + h2 * pair(6)) + h4 * pair(8));
        let pair = |i: usize| i as f64 * c[i] + h * ((i + 1) as f64 * c[i + 1]);
        let slope = (pair(1) + h2 * pair(3)) + h4 * ((pair(5) + h2 * pair(7)) + h4 * (9.0 * c[9]));
        [value, slope]
    }
}

/// The root s + h near the point at s where f falls, and its speed. If it is not near, the step
/// that leads towards it.
#[inline(always)]
pub fn refine<const M: usize>(
    s: f64,
    p: &Point<M>,
    frequencies: &Frequencies<M>,
) -> Result<(f64, f64), f64> {
    let radius = RADIUS / frequencies.fastest;
    // Halley's step, of third order.
    let mut h = 2.0 * p.f * p.g / (p.f * p.h - 2.0 * p.g * p.g);
    if h.abs().partial_cmp(&radius).is_none_or(|order| order.is_gt()) {
        return Err(h);
    }
    let taylor = Taylor::about(p, frequencies);
    for _ in 0..STEPS {
        let [value, slope] = taylor.at(h);
        // To sixth order: a part left out would bias every speed the same way, and take energy.
        let [_, _, _, _, c4, c5, c6, ..] = taylor.0;
        let curvature = p.h + h * (p.j + h * (12.0 * c4 + h * (20.0 * c5 + h * (30.0 * c6))));
        let inverse = 1.0 / slope;
        let newton = -value * inverse;
        // Newton's step with the curvature, again of third order.
        let step = newton * (1.0 - 0.5 * newton * curvature * inverse);
        h += step;
        // What another step would change is below the cube of this one.
        if step.abs() <= 1e-6 * radius {
            let speed = -(slope + step * (curvature + 0.5 * step * p.j));
            return Ok((s + h, speed));
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
    let [_, _, _, c3, c4, c5, ..] = taylor.0;
    let h2 = h * h;
    let bend = h2 * (3.0 * c3 + h * (4.0 * c4 + h * 5.0 * c5));
    if slope <= 2.0 * bend.abs() {
        return ((s + h).max(0.0), slope);
    }
    let speed = slope - bend;
    let shift = h2 * h * (c3 + h * c4) / speed;
    ((s + (h + shift)).max(0.0), speed - p.h * shift)
}
