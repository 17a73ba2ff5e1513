//! Straight lines through points with known errors, and power laws through counts.

use serde::{Deserialize, Serialize};

/// y = intercept + slope · x, fitted by weighted least squares.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Line {
    /// The slope.
    pub slope: f64,
    /// Its standard error, from the weights.
    pub slope_error: f64,
    /// The intercept.
    pub intercept: f64,
    /// Its standard error, from the weights.
    pub intercept_error: f64,
    /// χ² of the residuals divided by their degrees of freedom; 1 if there are none.
    pub reduced_chi2: f64,
}

/// Fits a line through (x, y, variance of y). None below two different x.
pub fn line(points: &[(f64, f64, f64)]) -> Option<Line> {
    let total: f64 = points.iter().map(|&(_, _, v)| 1.0 / v).sum();
    let centre = points.iter().map(|&(x, _, v)| x / v).sum::<f64>() / total;
    let level = points.iter().map(|&(_, y, v)| y / v).sum::<f64>() / total;
    let spread: f64 = points.iter().map(|&(x, _, v)| (x - centre) * (x - centre) / v).sum();
    if points.len() < 2 || spread <= 0.0 {
        return None;
    }
    let slope =
        points.iter().map(|&(x, y, v)| (x - centre) * (y - level) / v).sum::<f64>() / spread;
    let intercept = level - slope * centre;
    let chi2: f64 = points
        .iter()
        .map(|&(x, y, v)| {
            let rest = y - intercept - slope * x;
            rest * rest / v
        })
        .sum();
    Some(Line {
        slope,
        slope_error: (1.0 / spread).sqrt(),
        intercept,
        intercept_error: (1.0 / total + centre * centre / spread).sqrt(),
        reduced_chi2: if points.len() > 2 { chi2 / (points.len() - 2) as f64 } else { 1.0 },
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_exact_line_is_found() {
        let points = [(0.0, 1.0, 1.0), (1.0, 3.0, 2.0), (4.0, 9.0, 0.5)];
        let fit = line(&points).unwrap();
        assert!((fit.slope - 2.0).abs() < 1e-14 && (fit.intercept - 1.0).abs() < 1e-14);
        assert!(fit.reduced_chi2 < 1e-25);
    }

    #[test]
    fn errors_by_hand() {
        // x = −1, 0, 1 with unit variances: var slope = 1/2, var intercept = 1/3.
        // y = 0, 3, 0: slope 0, intercept 1, residuals −1, 2, −1, χ² = 6 on one degree.
        let fit = line(&[(-1.0, 0.0, 1.0), (0.0, 3.0, 1.0), (1.0, 0.0, 1.0)]).unwrap();
        assert_eq!((fit.slope, fit.intercept), (0.0, 1.0));
        assert!((fit.slope_error - 0.5_f64.sqrt()).abs() < 1e-15);
        assert!((fit.intercept_error - (1.0_f64 / 3.0).sqrt()).abs() < 1e-15);
        assert!((fit.reduced_chi2 - 6.0).abs() < 1e-14);
    }

    #[test]
    fn one_place_is_no_line() {
        assert_eq!(line(&[(1.0, 2.0, 1.0), (1.0, 3.0, 1.0)]), None);
        assert_eq!(line(&[]), None);
    }
}
