//! Compares the theory of Secs. 3 to 9 with exact and 57-digit arithmetic and quadrature.

mod distribution;
mod jump;
mod relation;

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;
use dashu_int::IBig;

/// A float of [`BITS`] bits.
pub type Big = FBig<HalfEven, 2>;

pub const BITS: usize = 192;

pub fn big(x: f64) -> Big {
    Big::try_from(x).expect("a finite double").with_precision(BITS).value()
}

pub fn int(n: usize) -> Big {
    Big::from(IBig::from(n)).with_precision(BITS).value()
}

/// e^x; 1 for zero, which dashu's exponential keeps at low precision, and 0 far below any use.
pub fn exp(x: Big) -> Big {
    if x == Big::ZERO {
        int(1)
    } else if x < int(0) - int(1_000_000) {
        int(0)
    } else {
        x.exp()
    }
}

/// |ours/exact − 1|, or |ours| if exact is zero.
pub fn relative_error(ours: f64, exact: &Big) -> f64 {
    if *exact == Big::ZERO {
        return ours.abs();
    }
    let error = (big(ours) / exact.clone() - int(1)).to_f64().value();
    error.abs()
}

pub fn near(x: &Big) -> f64 {
    x.to_f64().value()
}

pub struct Gauss(Vec<(Big, Big)>);

impl Gauss {
    /// `points` nodes and weights on [0, 1], by Newton's method from the cosine estimate.
    pub fn new(points: usize) -> Self {
        let rule = (0..points).map(|i| {
            let angle = std::f64::consts::PI * (i as f64 + 0.75) / (points as f64 + 0.5);
            let mut x = big(-angle.cos());
            for _ in 0..8 {
                let (value, slope) = legendre(points, &x);
                x -= value / slope;
            }
            let slope = legendre(points, &x).1;
            let weight = int(1) / ((int(1) - x.clone() * &x) * slope.clone() * slope);
            ((x + int(1)) / int(2), weight)
        });
        Gauss(rule.collect())
    }

    /// The integral of f over [a, b] in equal panels.
    pub fn integrate(&self, a: &Big, b: &Big, panels: usize, f: impl Fn(Big) -> Big) -> Big {
        let width = (b.clone() - a) / int(panels);
        let mut sum = Big::ZERO.with_precision(BITS).value();
        for panel in 0..panels {
            let start = a.clone() + width.clone() * int(panel);
            for (node, weight) in &self.0 {
                sum += weight.clone() * f(start.clone() + width.clone() * node);
            }
        }
        sum * width
    }
}

fn legendre(n: usize, x: &Big) -> (Big, Big) {
    let (mut previous, mut value) = (int(1), x.clone());
    for j in 2..=n {
        let next = (int(2 * j - 1) * x * &value - int(j - 1) * previous) / int(j);
        previous = std::mem::replace(&mut value, next);
    }
    let slope = int(n) * (x.clone() * &value - previous) / (x.clone() * x - int(1));
    (value, slope)
}
