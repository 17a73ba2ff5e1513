//! Integrates by Gauss–Legendre rules of any order, and by sums of panels.

/// Nodes and weights of a Gauss–Legendre rule on [−1, 1].
#[derive(Clone, Debug)]
pub struct GaussLegendre {
    nodes: Vec<f64>,
    weights: Vec<f64>,
}

impl GaussLegendre {
    /// Creates the rule of n = `points` ≥ 1, exact to degree 2n − 1: Legendre's zeros by Newton.
    pub fn new(points: usize) -> Self {
        let n = points as f64;
        let (mut nodes, mut weights) = (Vec::new(), Vec::new());
        for i in 0..points {
            let angle = std::f64::consts::PI * (i as f64 + 0.75) / (n + 0.5);
            let mut x = -pxfm::f_cos(angle);
            // Newton's method doubles the digits; eight steps are more than any order needs.
            for _ in 0..8 {
                let (value, slope) = legendre(points, x);
                x -= value / slope;
            }
            let slope = legendre(points, x).1;
            nodes.push(x);
            weights.push(2.0 / ((1.0 - x * x) * slope * slope));
        }
        GaussLegendre { nodes, weights }
    }

    /// Returns the integral of `f` over [a, b].
    pub fn integrate(&self, a: f64, b: f64, f: impl Fn(f64) -> f64) -> f64 {
        let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
        let terms = self.nodes.iter().zip(&self.weights).map(|(x, w)| w * f(middle + half * x));
        half * terms.fold(0.0, |sum, term| sum + term)
    }

    /// Returns the integral of `f` over [a, b], cut into `panels` equal parts.
    pub fn integrate_panels(&self, a: f64, b: f64, panels: usize, f: impl Fn(f64) -> f64) -> f64 {
        let edge = |i: usize| a + (b - a) * (i as f64 / panels as f64);
        (0..panels).fold(0.0, |sum, i| sum + self.integrate(edge(i), edge(i + 1), &f))
    }
}

/// Returns the Legendre polynomial of degree n and its derivative at x, |x| < 1.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut previous, mut value) = (1.0, x);
    for j in 2..=n {
        let j = j as f64;
        (previous, value) = (value, ((2.0 * j - 1.0) * x * value - (j - 1.0) * previous) / j);
    }
    let slope = n as f64 * (x * value - previous) / (x * x - 1.0);
    (value, slope)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rules_of_the_tables() {
        // P_3(1/2) = −7/16 and its slope 3/8.
        assert_eq!(legendre(3, 0.5), (-0.4375, 0.375));
        let rule = GaussLegendre::new(3);
        for (i, [node, weight]) in
            [[-0.6_f64.sqrt(), 5.0 / 9.0], [0.0, 8.0 / 9.0], [0.6_f64.sqrt(), 5.0 / 9.0]]
                .iter()
                .enumerate()
        {
            assert!((rule.nodes[i] - node).abs().max((rule.weights[i] - weight).abs()) < 1e-15);
        }
        // x⁵ over [1, 3] is exact, and x⁴ in four panels of the rule of one point by hand.
        assert!((rule.integrate(1.0, 3.0, |x| x.powi(5)) - 728.0 / 6.0).abs() < 1e-12);
        let middles = [1.25, 1.75, 2.25, 2.75_f64].map(|x| 0.5 * x.powi(4)).iter().sum::<f64>();
        let integral = GaussLegendre::new(1).integrate_panels(1.0, 3.0, 4, |x| x.powi(4));
        assert!((integral - middles).abs() < 1e-13, "{integral} {middles}");
    }
}
