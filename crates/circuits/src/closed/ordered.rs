//! How often neighbours touch that keep their order.
//!
//! Impacts leave the masses of a row in their order, and so they are nearer to their places than free ones with the same
//! velocities. Take the row as in balance at the mean square velocity u²: positions x_j, from their places, have the density
//!
//! ∏_j exp(−ω² x_j²/2u²) · ∏_j [d + x_{j+1} − x_j > 0].
//!
//! Each factor joins two neighbours, so all follows from the operator with the kernel
//! k(x, y) = exp(−ω² x²/4u²) [d + y − x > 0] exp(−ω² y²/4u²). With its largest eigenvalue Λ and eigenfunction ψ, and
//! φ(x) = ψ(−x) for the transposed kernel, both of ⟨φψ⟩ = 1, one mass has the density φψ, and neighbours have the
//! density φ(x) k(x, y) ψ(y)/Λ. Its integral along d + y − x = 0 is the density ρ of a gap at width zero; the
//! rate at which a gap closes is ρ times the mean of the closing speed V where it is positive.
//!
//! Where 2u ≪ ωd the order does not matter, and ρ = exp(−ω²d²/4u²) ω/(√(4π) u).

use std::f64::consts::PI;
use std::sync::LazyLock;

/// Where neighbours are, in units of d, at one mean square velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ordered {
    /// ρ d: density of a gap at width zero.
    pub contact: f64,
    /// ⟨x²⟩/d² of one mass.
    pub variance: f64,
    /// Variance of a gap over d²: 2⟨x²⟩/d² if neighbours were independent, less as they keep their order.
    pub gap: f64,
}

/// The same for every mean square velocity.
#[derive(Clone, Debug)]
pub struct OrderedGas {
    /// ln ρ + 1/4u², which is smooth where ρ vanishes, ln ⟨x²⟩ and that of the variance of a gap, at equal steps of ln u².
    nodes: Vec<[f64; 3]>,
}

/// Cells of the grid for x, over twelve standard deviations of a free mass.
const CELLS: f64 = 500.0;

/// Range of u²/(ωd)² in the table, and steps of its logarithm: below, order does not matter.
const RANGE: [f64; 2] = [0.02, 60.0];
const STEPS: usize = 90;

impl Ordered {
    /// At u² = `tau` (ωd)², from 0.02 to some hundreds, by powers of the operator. Below, contacts are so rare that they lie beyond
    /// the six standard deviations that the grid has.
    pub fn at(tau: f64) -> Ordered {
        let half_width = 6.0 * tau.sqrt();
        // The grid must have a gap of width zero on it.
        let shift = (CELLS / (2.0 * half_width)).ceil().max(8.0) as usize;
        let step = 1.0 / shift as f64;
        let half = (half_width / step) as usize;
        let len = 2 * half + 1;
        let place = |i: usize| (i as f64 - half as f64) * step;
        let weight: Vec<f64> =
            (0..len).map(|i| pxfm::f_exp(-0.25 * place(i) * place(i) / tau)).collect();
        let mut psi = weight.clone();
        let mut eigenvalue = 0.0;
        // Neighbours forget each other by a factor of two or more from mass to mass.
        for _ in 0..200 {
            let mut sum = 0.0;
            // Of ∫ over y > x − d, from the right; half a cell at the edge.
            let mut above = vec![0.0; len];
            for i in (0..len).rev() {
                let term = weight[i] * psi[i] * step;
                sum += term;
                above[i] = sum - 0.5 * term;
            }
            let next: Vec<f64> = (0..len)
                .map(|i| weight[i] * if i >= shift { above[i - shift] } else { sum })
                .collect();
            let norm = next.iter().fold(0.0, |sum: f64, x| sum + x * x).sqrt();
            let change =
                next.iter().zip(&psi).fold(0.0_f64, |m, (x, y)| m.max((x / norm - y).abs()));
            psi = next.into_iter().map(|x| x / norm).collect();
            eigenvalue = norm;
            if change < 1e-13 {
                break;
            }
        }
        let phi = |i: usize| psi[len - 1 - i];
        let mut norm = 0.0;
        let mut second = 0.0;
        for (i, psi) in psi.iter().enumerate() {
            let density = phi(i) * psi;
            norm += density;
            second += density * place(i) * place(i);
        }
        // ∫∫ φ(x) x k(x, y) y ψ(y), from the right as above.
        let (mut sum, mut product) = (0.0, 0.0);
        let mut above = vec![0.0; len];
        for i in (0..len).rev() {
            let term = place(i) * weight[i] * psi[i] * step;
            sum += term;
            above[i] = sum - 0.5 * term;
        }
        for i in 0..len {
            let beyond = if i >= shift { above[i - shift] } else { sum };
            product += phi(i) * place(i) * weight[i] * beyond;
        }
        let gap = 2.0 * (second - product / eigenvalue) / norm;
        let touching =
            (shift..len).map(|i| phi(i) * weight[i] * weight[i - shift] * psi[i - shift]);
        let touching = touching.fold(0.0, |sum, x| sum + x);
        Ordered { contact: touching / (eigenvalue * norm), variance: second / norm, gap }
    }

    /// The same for masses that need not keep their order.
    pub fn free(tau: f64) -> Ordered {
        let contact = pxfm::f_exp(-0.25 / tau) / (4.0 * PI * tau).sqrt();
        Ordered { contact, variance: tau, gap: 2.0 * tau }
    }
}

impl OrderedGas {
    /// The table, which is made once.
    pub fn new() -> Self {
        static TABLE: LazyLock<OrderedGas> = LazyLock::new(OrderedGas::made);
        TABLE.clone()
    }

    /// Some ten milliseconds.
    fn made() -> Self {
        let [low, high] = RANGE.map(pxfm::f_log);
        let node = |i: usize| {
            let tau = pxfm::f_exp(low + (high - low) * i as f64 / STEPS as f64);
            let own = Ordered::at(tau);
            [pxfm::f_log(own.contact) + 0.25 / tau, pxfm::f_log(own.variance), pxfm::f_log(own.gap)]
        };
        OrderedGas { nodes: (0..=STEPS).map(node).collect() }
    }

    /// At u² = `tau` (ωd)²: by a parabola through the nearest three nodes, and that of free masses below the table.
    pub fn at(&self, tau: f64) -> Ordered {
        if tau <= RANGE[0] {
            return Ordered::free(tau.max(1e-3));
        }
        let [low, high] = RANGE.map(pxfm::f_log);
        let place = (pxfm::f_log(tau) - low) / (high - low) * STEPS as f64;
        let middle = (place.round() as usize).clamp(1, STEPS - 1);
        let t = place - middle as f64;
        let around = &self.nodes[middle - 1..=middle + 1];
        let value = |k: usize| {
            let [a, b, c] = [0, 1, 2].map(|i: usize| around[i][k]);
            b + 0.5 * t * (c - a) + 0.5 * t * t * (a - 2.0 * b + c)
        };
        let contact = pxfm::f_exp(value(0) - 0.25 / tau);
        Ordered { contact, variance: pxfm::f_exp(value(1)), gap: pxfm::f_exp(value(2)) }
    }
}

impl Default for OrderedGas {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use impact_numerics::random::NormalPairs;

    #[test]
    fn cold_masses_are_free() {
        let (found, free) = (Ordered::at(0.03), Ordered::free(0.03));
        assert!((found.contact / free.contact - 1.0).abs() < 2e-3, "{found:?} {free:?}");
        assert!((found.variance / free.variance - 1.0).abs() < 1e-2, "{found:?} {free:?}");
        let gas = OrderedGas::new();
        let [below, above] = [0.9999, 1.0001].map(|by| gas.at(by * RANGE[0]));
        assert!((below.contact / above.contact - 1.0).abs() < 5e-3, "{below:?} {above:?}");
    }

    /// The second route: a ring of masses that keep their order, each drawn afresh in turn between its neighbours.
    #[test]
    fn masses_that_are_drawn_in_order_touch_as_often() {
        let (tau, masses) = (0.4_f64, 60);
        let mut normals = NormalPairs::new("test of order", 1, 0);
        let mut x = vec![0.0_f64; masses];
        let (mut squares, mut widths, mut near, mut count) = (0.0, 0.0, 0_u32, 0_u32);
        let width = 0.04;
        for round in 0..6000 {
            for j in 0..masses {
                let left = x[(j + masses - 1) % masses] - 1.0;
                let right = x[(j + 1) % masses] + 1.0;
                // Of a normal pair one may lie between them; else the mass stays, which keeps the density.
                let drawn = normals.pair().map(|z| z * tau.sqrt());
                if left < drawn[0] && drawn[0] < right {
                    x[j] = drawn[0];
                }
            }
            if round >= 200 {
                for j in 0..masses {
                    let gap = 1.0 + x[(j + 1) % masses] - x[j];
                    squares += x[j] * x[j];
                    widths += (gap - 1.0) * (gap - 1.0);
                    near += u32::from(gap < width);
                    count += 1;
                }
            }
        }
        let found = Ordered::at(tau);
        let n = f64::from(count);
        assert!((squares / n / found.variance - 1.0).abs() < 0.02, "{} {found:?}", squares / n);
        assert!((widths / n / found.gap - 1.0).abs() < 0.02, "{} {found:?}", widths / n);
        // The density rises by less than a tenth over the width.
        let contact = f64::from(near) / n / width;
        assert!((contact / found.contact - 1.02).abs() < 0.04, "{contact} {found:?}");
    }

    #[test]
    fn the_table_is_the_operator() {
        let gas = OrderedGas::new();
        for tau in [0.05, 0.21, 0.7, 3.0] {
            let (table, own) = (gas.at(tau), Ordered::at(tau));
            assert!((table.contact / own.contact - 1.0).abs() < 1e-3, "{table:?} {own:?}");
            assert!((table.variance / own.variance - 1.0).abs() < 1e-3, "{table:?} {own:?}");
            assert!((table.gap / own.gap - 1.0).abs() < 1e-3, "{table:?} {own:?}");
        }
    }
}
