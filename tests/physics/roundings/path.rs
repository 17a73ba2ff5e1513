//! The way from the doubles of a scenario to the root of a gap, operation by operation as the engine
//! takes it, on numbers that remember their roundings. Nothing here is taken from `src/`: a change of
//! the engine's order of operations asks for the same change here.

use super::tape::{Num, clear, stage};

/// One gap at one root: all that its rounding depends on but the amplitudes.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// ω and Ω.
    pub frequencies: [f64; 2],
    /// The phases of both at the instant of the frame, within an eighth of a turn.
    pub phases: [f64; 2],
    /// Whether the frame is advanced once by its reach.
    pub advanced: bool,
    /// Where the root is, as a part of the reach.
    pub root: f64,
    /// How far from its node, as a part of the radius of the Taylor polynomial.
    pub step: f64,
}

/// What f is made of: f and every rounding are linear in these.
#[derive(Clone, Copy, Debug, Default)]
pub struct Parts {
    /// d.
    pub spacing: f64,
    /// Free amplitudes of the left and of the right mass.
    pub free: [[f64; 2]; 2],
    /// Forced responses of both.
    pub forced: [[f64; 2]; 2],
}

/// Stages that are counted; what follows in [`STAGES`] is no rounding on this way.
pub const COUNTED: usize = 6;

/// The reach of a frame times the fastest frequency, as in `numerics::trig`.
pub const RANGE: f64 = 2.83;
/// The radius of the Taylor polynomial, as in `numerics::nodes`.
const RADIUS: f64 = 0.06;

/// 1/m!, −1/(m+2)!, …
fn inverse_factorials<const N: usize>(m: i32) -> [f64; N] {
    let factorial = |n: i32| (1..=n).fold(1.0, |product, i| product * f64::from(i));
    std::array::from_fn(|k| (1 - 2 * (k as i32 % 2)) as f64 / factorial(m + 2 * k as i32))
}

/// The rounding of a coefficient is taken up by its neighbours: they count as exact.
fn polynomial<const N: usize>(z: Num, coefficients: [f64; N]) -> Num {
    let c = coefficients.map(Num::exact);
    let square = z * z;
    if N == 8 {
        let pair = |k: usize| c[k] + z * c[k + 1];
        return (pair(0) + square * pair(2)) + square * square * (pair(4) + square * pair(6));
    }
    let (mut even, mut odd) = (c[N - 2], c[N - 1]);
    for k in (0..N / 2 - 1).rev() {
        even = even * square + c[2 * k];
        odd = odd * square + c[2 * k + 1];
    }
    even + z * odd
}

/// sin x − x and 1 − cos x.
fn small_sin_cos<const N: usize>(x: Num) -> [Num; 2] {
    let z = x * x;
    let sin = polynomial(z, inverse_factorials::<N>(3));
    [-(sin * (z * x)), polynomial(z, inverse_factorials::<N>(2)) * z]
}

fn sin_cos<const N: usize>(x: Num) -> [Num; 2] {
    let [rest, versine] = small_sin_cos::<N>(x);
    [x + rest, Num::exact(1.0) - versine]
}

/// sin and cos of a phase: its fraction of a turn rounded, 2π rounded, and their product.
fn sin_cos_turn(phase: f64) -> [Num; 2] {
    if phase == 0.0 {
        return [0.0, 1.0].map(Num::exact);
    }
    let turn = Num::exact(phase / std::f64::consts::TAU).rounded();
    sin_cos::<8>(turn * Num::exact(std::f64::consts::TAU).rounded())
}

/// [c cos + s sin, s cos − c sin]
fn rotated([c, s]: [Num; 2], [sin, cos]: [Num; 2]) -> [Num; 2] {
    [c * cos + s * sin, s * cos - c * sin]
}

struct Frame {
    f0: Num,
    g0: Num,
    free: Num,
    forced: [Num; 2],
}

struct Chain {
    w: Num,
    big_w: Num,
    inverse: Num,
    fastest: f64,
}

impl Chain {
    fn sine(&self, frame: &Frame) -> Num {
        (frame.g0 - self.big_w * frame.forced[1]) * self.inverse
    }

    fn advanced(&self, frame: Frame) -> Frame {
        let reach = Num::exact(RANGE / self.fastest);
        let mean = frame.f0 - frame.free - frame.forced[0];
        let turns = [self.w, self.big_w].map(|w| sin_cos::<14>(w * reach));
        let [free, sine] = rotated([frame.free, self.sine(&frame)], turns[0]);
        let forced = rotated(frame.forced, turns[1]);
        let g0 = self.w * sine + self.big_w * forced[1];
        Frame { f0: mean + (free + forced[0]), g0, free, forced }
    }

    /// Taylor coefficients of −cos νs, with versine for the first, and of sin νs, with sin νs − νs for it.
    fn waves(nu: Num, s: Num) -> [[Num; 10]; 2] {
        let x = nu * s;
        let [rest, versine] = small_sin_cos::<14>(x);
        let (sin, cos) = (x + rest, Num::exact(1.0) - versine);
        let mut factor = Num::exact(1.0);
        let (mut even, mut odd) = ([versine; 10], [rest; 10]);
        for k in 1..10 {
            factor = factor * (nu / Num::exact(k as f64));
            let turned = [[-cos, sin], [sin, cos], [cos, -sin], [-sin, -cos]][k % 4];
            [even[k], odd[k]] = turned.map(|x| factor * x);
        }
        [even, odd]
    }

    /// Taylor coefficients of f about the node at s, up to the ninth.
    fn about(&self, frame: &Frame, s: Num) -> [Num; 10] {
        let (w, big_w) = (self.w, self.big_w);
        let [gamma, delta] = frame.forced;
        let [[even, odd], [big_even, big_odd]] = [w, big_w].map(|nu| Self::waves(nu, s));
        let mut sine = odd;
        sine[0] = sine[0] + w * s;
        let ratio = big_w / w;
        let mut c: [Num; 10] = std::array::from_fn(|k| {
            let difference = match k {
                1 => big_w * (even[0] - big_even[0]),
                _ => big_odd[k] - ratio * odd[k],
            };
            let free = frame.g0 * (sine[k] / w) - frame.free * even[k];
            free + (delta * difference - gamma * big_even[k])
        });
        c[0] = c[0] + frame.f0;
        c
    }
}

impl Case {
    /// Goes the whole way with the given parts; f and f' at the root.
    pub fn follow(&self, parts: &Parts) -> [Num; 2] {
        clear();
        let [w, big_w] = self.frequencies.map(Num::exact);
        stage(4);
        let inverse = Num::exact(1.0) / w;
        let fastest = self.frequencies[0].max(self.frequencies[1]);
        let chain = Chain { w, big_w, inverse, fastest };
        let reach = RANGE / fastest;
        stage(0);
        let factor = (w - big_w) * (w + big_w);
        let response = |c: f64| Num::exact(c * factor.value()) / factor;
        let forced = parts.forced.map(|mass| mass.map(response));
        let free = parts.free.map(|mass| mass.map(Num::exact));
        let minus = |[left, right]: [[Num; 2]; 2]| [right[0] - left[0], right[1] - left[1]];
        let (free, forced) = (minus(free), minus(forced));
        stage(1);
        let turns = self.phases.map(sin_cos_turn);
        stage(2);
        let [u, quadrature] = rotated(free, turns[0]);
        let forced = rotated(forced, turns[1]);
        let f0 = Num::exact(parts.spacing) + (u + forced[0]);
        let g0 = w * quadrature + big_w * forced[1];
        let mut frame = Frame { f0, g0, free: u, forced };
        stage(3);
        if self.advanced {
            frame = chain.advanced(frame);
        }
        stage(4);
        let s = self.root * reach;
        let h = self.step * RADIUS / fastest;
        let start = (s - h).clamp(0.0, reach);
        let c = chain.about(&frame, Num::exact(start));
        stage(5);
        taylor(&c, s, s - start)
    }
}

/// Value and slope at the root s, which is h away from the node.
fn taylor(c: &[Num; 10], s: f64, h: f64) -> [Num; 2] {
    let h = Num::exact(h);
    let (h2, h4) = (h * h, (h * h) * (h * h));
    let sum = |c: [Num; 5]| (c[0] + h2 * c[1]) + h4 * ((c[2] + h2 * c[3]) + h4 * c[4]);
    let every_other =
        |from: usize, c: &dyn Fn(usize) -> Num| std::array::from_fn(|i| c(from + 2 * i));
    let times = |k: usize| if k < 10 { Num::exact(k as f64) * c[k] } else { Num::exact(0.0) };
    let value = sum(every_other(0, &|k| c[k])) + h * sum(every_other(1, &|k| c[k]));
    let slope = sum(every_other(1, &times)) + h * sum(every_other(2, &times));
    // The sum s + h is rounded, which moves the root.
    let late = Num::exact(s).rounded() + Num::exact(-s);
    [value + Num::exact(slope.value()) * late, slope]
}
