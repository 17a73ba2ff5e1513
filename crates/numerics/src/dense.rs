//! Small dense matrices: products, linear equations, determinants.

use std::ops::{Index, IndexMut};

/// A square matrix.
#[derive(Clone, Debug, PartialEq)]
pub struct Square {
    size: usize,
    /// Row by row.
    entries: Vec<f64>,
}

impl Square {
    /// All entries zero.
    pub fn zero(size: usize) -> Self {
        Square { size, entries: vec![0.0; size * size] }
    }

    /// Ones on the diagonal.
    pub fn identity(size: usize) -> Self {
        let mut matrix = Square::zero(size);
        for i in 0..size {
            matrix[(i, i)] = 1.0;
        }
        matrix
    }

    /// Number of rows.
    pub fn size(&self) -> usize {
        self.size
    }

    /// The product `self` · `other` of matrices of one size.
    pub fn times(&self, other: &Square) -> Square {
        let n = self.size;
        let mut product = Square::zero(n);
        for i in 0..n {
            for j in 0..n {
                product[(i, j)] = (0..n).fold(0.0, |sum, k| sum + self[(i, k)] * other[(k, j)]);
            }
        }
        product
    }

    /// Eliminates in place with row pivoting and does the same to the columns of `right`, each of
    /// them as long as the matrix; solves for them. The determinant, 0 if the matrix is singular: then
    /// `right` is of no use.
    pub fn solve(mut self, right: &mut [Vec<f64>]) -> f64 {
        let n = self.size;
        let mut determinant = 1.0;
        for k in 0..n {
            let larger =
                |p: usize, i: usize| if self[(i, k)].abs() > self[(p, k)].abs() { i } else { p };
            let pivot = (k + 1..n).fold(k, larger);
            if self[(pivot, k)] == 0.0 || !self[(pivot, k)].is_finite() {
                return 0.0;
            }
            if pivot != k {
                for j in 0..n {
                    self.entries.swap(k * n + j, pivot * n + j);
                }
                right.iter_mut().for_each(|column| column.swap(k, pivot));
                determinant = -determinant;
            }
            determinant *= self[(k, k)];
            for i in k + 1..n {
                let factor = self[(i, k)] / self[(k, k)];
                for j in k + 1..n {
                    self[(i, j)] -= factor * self[(k, j)];
                }
                right.iter_mut().for_each(|column| column[i] -= factor * column[k]);
            }
        }
        for column in right {
            for i in (0..n).rev() {
                let known = (i + 1..n).fold(column[i], |sum, j| sum - self[(i, j)] * column[j]);
                column[i] = known / self[(i, i)];
            }
        }
        determinant
    }

    /// The determinant.
    pub fn determinant(&self) -> f64 {
        self.clone().solve(&mut [])
    }
}

impl Index<(usize, usize)> for Square {
    type Output = f64;
    fn index(&self, (i, j): (usize, usize)) -> &f64 {
        &self.entries[i * self.size + j]
    }
}

impl IndexMut<(usize, usize)> for Square {
    fn index_mut(&mut self, (i, j): (usize, usize)) -> &mut f64 {
        &mut self.entries[i * self.size + j]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equations_hold_and_pivots_are_found() {
        let mut a = Square::zero(3);
        for (place, x) in [0.0, 2.0, 1.0, 3.0, 6.0, -4.0, 1.0, -1.0, 5.0].into_iter().enumerate() {
            a[(place / 3, place % 3)] = x;
        }
        // 0·(6·5 − 4) − 2·(15 + 4) + 1·(−3 − 6) by the first row.
        assert!((a.determinant() + 47.0).abs() < 1e-13);
        let mut right = vec![vec![1.0, 2.0, 3.0], vec![0.0, 1.0, 0.0]];
        let given = right.clone();
        a.clone().solve(&mut right);
        for (x, b) in right.iter().zip(&given) {
            for i in 0..3 {
                let sum: f64 = (0..3).map(|j| a[(i, j)] * x[j]).sum();
                assert!((sum - b[i]).abs() < 1e-14);
            }
        }
        assert_eq!(a.times(&Square::identity(3)), a);
        assert_eq!(Square::zero(2).determinant(), 0.0);
    }
}
