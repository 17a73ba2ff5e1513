//! Eigenvalues of a small real matrix, by the shifted QR iteration in complex arithmetic.
//!
//! The coefficients of the characteristic polynomial would lose the small eigenvalues beside a large
//! one; this keeps the error near rounding times the norm. No dependency of this package has
//! eigenvalues, and with complex numbers a page is enough.

use super::dense::Square;
use std::ops::{Add, Mul, Sub};

/// A complex number.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Complex {
    re: f64,
    im: f64,
}

impl Complex {
    const ZERO: Complex = Complex { re: 0.0, im: 0.0 };

    fn modulus(self) -> f64 {
        (self.re * self.re + self.im * self.im).sqrt()
    }

    fn conjugate(self) -> Self {
        Complex { re: self.re, im: -self.im }
    }

    fn scaled(self, by: f64) -> Self {
        Complex { re: by * self.re, im: by * self.im }
    }

    /// The root with a real part ≥ 0.
    fn root(self) -> Self {
        let modulus = self.modulus();
        let large = (0.5 * (modulus + self.re.abs())).sqrt();
        if large == 0.0 {
            return Complex::ZERO;
        }
        let small = 0.5 * self.im.abs() / large;
        let [re, im] = if self.re >= 0.0 { [large, small] } else { [small, large] };
        Complex { re, im: if self.im < 0.0 { -im } else { im } }
    }
}

impl Add for Complex {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Complex { re: self.re + other.re, im: self.im + other.im }
    }
}

impl Sub for Complex {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Complex { re: self.re - other.re, im: self.im - other.im }
    }
}

impl Mul for Complex {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Complex {
            re: self.re * other.re - self.im * other.im,
            im: self.re * other.im + self.im * other.re,
        }
    }
}

/// Steps for one eigenvalue before the search is given up; a handful is usual.
const STEPS: usize = 60;

/// The eigenvalues (re, im) of a matrix, by falling modulus; none if an entry is not finite or the
/// iteration does not settle.
pub fn eigenvalues(matrix: &Square) -> Option<Vec<[f64; 2]>> {
    let n = matrix.size();
    let mut h = hessenberg(matrix);
    if h.iter().flatten().any(|x| !(x.re.is_finite() && x.im.is_finite())) {
        return None;
    }
    let mut high = n;
    let mut steps = 0;
    while high > 1 {
        let last = high - 1;
        let negligible = |i: usize, h: &[Vec<Complex>]| {
            h[i][i - 1].modulus() <= f64::EPSILON * (h[i][i].modulus() + h[i - 1][i - 1].modulus())
        };
        let low = (1..high).rev().find(|&i| negligible(i, &h)).unwrap_or(0);
        if low == last {
            high = last;
            steps = 0;
            continue;
        }
        steps += 1;
        if steps > STEPS {
            return None;
        }
        // Every tenth step another shift, lest the iteration go in circles.
        let shift = match steps % 10 {
            0 => Complex { re: h[last][last - 1].modulus() + h[last][last].re, im: 0.0 },
            _ => wilkinson(&h, last),
        };
        step(&mut h, low, high, shift);
    }
    let mut found: Vec<[f64; 2]> = (0..n).map(|i| [h[i][i].re, h[i][i].im]).collect();
    let square = |[re, im]: &[f64; 2]| re * re + im * im;
    found.sort_by(|a, b| square(b).total_cmp(&square(a)).then(b[1].total_cmp(&a[1])));
    Some(found)
}

/// A similar matrix with zeros below the first lower diagonal, by elimination with pivots.
fn hessenberg(matrix: &Square) -> Vec<Vec<Complex>> {
    let n = matrix.size();
    let mut a = matrix.clone();
    for m in 1..n.saturating_sub(1) {
        let larger = |p: usize, i: usize| {
            if a[(i, m - 1)].abs() > a[(p, m - 1)].abs() { i } else { p }
        };
        let pivot = (m + 1..n).fold(m, larger);
        if a[(pivot, m - 1)] == 0.0 {
            continue;
        }
        if pivot != m {
            for j in 0..n {
                let (x, y) = (a[(m, j)], a[(pivot, j)]);
                (a[(m, j)], a[(pivot, j)]) = (y, x);
            }
            for i in 0..n {
                let (x, y) = (a[(i, m)], a[(i, pivot)]);
                (a[(i, m)], a[(i, pivot)]) = (y, x);
            }
        }
        for i in m + 1..n {
            let factor = a[(i, m - 1)] / a[(m, m - 1)];
            for j in 0..n {
                a[(i, j)] -= factor * a[(m, j)];
            }
            for j in 0..n {
                a[(j, m)] += factor * a[(j, i)];
            }
        }
    }
    let entry =
        |i: usize, j: usize| Complex { re: if i > j + 1 { 0.0 } else { a[(i, j)] }, im: 0.0 };
    (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect()
}

/// The eigenvalue of the last block of two rows that is nearer to its last entry.
fn wilkinson(h: &[Vec<Complex>], last: usize) -> Complex {
    let (a, b) = (h[last - 1][last - 1], h[last - 1][last]);
    let (c, d) = (h[last][last - 1], h[last][last]);
    let half = (a - d).scaled(0.5);
    let root = (half * half + b * c).root();
    let [plus, minus] = [half + root, half - root];
    d + if plus.modulus() < minus.modulus() { plus } else { minus }
}

/// One step of the iteration on the rows from `low` to before `high`: H − s = Q R becomes R Q + s.
fn step(h: &mut [Vec<Complex>], low: usize, high: usize, shift: Complex) {
    for (i, row) in h.iter_mut().enumerate().take(high).skip(low) {
        row[i] = row[i] - shift;
    }
    let mut turns = Vec::with_capacity(high - low);
    for i in low..high - 1 {
        let (x, y) = (h[i][i], h[i + 1][i]);
        let norm = (x.modulus() * x.modulus() + y.modulus() * y.modulus()).sqrt();
        let (c, s) = match norm > 0.0 {
            true => (x.conjugate().scaled(1.0 / norm), y.conjugate().scaled(1.0 / norm)),
            false => (Complex { re: 1.0, im: 0.0 }, Complex::ZERO),
        };
        let (above, below) = h.split_at_mut(i + 1);
        for (upper, lower) in above[i].iter_mut().zip(&mut below[0]).take(high).skip(i) {
            let (x, y) = (*upper, *lower);
            *upper = c * x + s * y;
            *lower = c.conjugate() * y - s.conjugate() * x;
        }
        turns.push((c, s));
    }
    for (i, (c, s)) in (low..).zip(turns) {
        for row in h.iter_mut().take(high.min(i + 2)).skip(low) {
            let (left, right) = (row[i], row[i + 1]);
            row[i] = left * c.conjugate() + right * s.conjugate();
            row[i + 1] = right * c - left * s;
        }
    }
    for (i, row) in h.iter_mut().enumerate().take(high).skip(low) {
        row[i] = row[i] + shift;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The companion matrix of a monic polynomial with these roots, real or in pairs.
    fn companion(coefficients: &[f64]) -> Square {
        let n = coefficients.len();
        let mut matrix = Square::zero(n);
        for i in 0..n {
            matrix[(0, i)] = -coefficients[i];
            if i > 0 {
                matrix[(i, i - 1)] = 1.0;
            }
        }
        matrix
    }

    #[test]
    fn roots_of_a_polynomial() {
        // (x − 3)(x² + 1)(x + 1/2), multiplied out by hand.
        let found = eigenvalues(&companion(&[-2.5, -0.5, -2.5, -1.5])).unwrap();
        let expected = [[3.0, 0.0], [0.0, 1.0], [0.0, -1.0], [-0.5, 0.0]];
        for (x, y) in found.iter().zip(&expected) {
            assert!((x[0] - y[0]).abs() + (x[1] - y[1]).abs() < 1e-13, "{found:?}");
        }
    }

    #[test]
    fn small_ones_survive_beside_a_large_one() {
        // A triangular matrix, hidden by a similarity: its diagonal is known.
        let n = 6;
        let diagonal = [1e4, 1.0, -1.0, 0.5, -0.01, 1e-3];
        let mut a = Square::zero(n);
        let mut s = Square::identity(n);
        let mut back = Square::identity(n);
        for i in 0..n {
            a[(i, i)] = diagonal[i];
            for j in i + 1..n {
                a[(i, j)] = 0.3 * (i as f64 + 1.0) - 0.2 * j as f64;
            }
        }
        for i in 1..n {
            // One elementary similarity after the other: adding a row, taking a column away.
            let mut e = Square::identity(n);
            let mut inverse = Square::identity(n);
            (e[(i, i - 1)], inverse[(i, i - 1)]) = (0.5, -0.5);
            s = e.times(&s);
            back = back.times(&inverse);
        }
        let found = eigenvalues(&s.times(&a).times(&back)).unwrap();
        for (x, y) in found.iter().zip([1e4, 1.0, -1.0, 0.5, -0.01, 1e-3]) {
            let near = found.iter().any(|x| (x[0] - y).abs() + x[1].abs() < 1e-9);
            assert!(near, "{y}: {x:?} of {found:?}");
        }
        let product = found.iter().fold(1.0, |product, x| product * x[0]);
        assert!((product / a.determinant() - 1.0).abs() < 1e-6);
    }

    #[test]
    fn a_rotation_turns_and_nothing_finite_is_refused() {
        let mut turn = Square::zero(2);
        let (sin, cos) = pxfm::f_sincos(0.7);
        (turn[(0, 0)], turn[(0, 1)], turn[(1, 0)], turn[(1, 1)]) = (cos, sin, -sin, cos);
        let found = eigenvalues(&turn).unwrap();
        assert!((found[0][0] - cos).abs() < 1e-15 && (found[0][1] - sin).abs() < 1e-15);
        assert_eq!(eigenvalues(&Square::zero(3)), Some(vec![[0.0, 0.0]; 3]));
        turn[(0, 0)] = f64::NAN;
        assert_eq!(eigenvalues(&turn), None);
    }
}
