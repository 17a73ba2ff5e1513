//! How hot each mass of a chain is, at its own force.
//!
//! The argument is that of [`heat`](super::heat), with the forces F_j = α_j − iβ_j of one chain in place of their mean. The motion
//! that they keep up, Re X_j e^{iΩt}, obeys
//!
//! (D + K_{j−1} + K_j) X_j − K_{j−1} X_{j−1} − K_j X_{j+1} = F_j,
//!
//! where K_j belongs to the gap to the right of mass j and is taken at the mean of its masses' u². At an impact a mass
//! loses (1 + r)(u_j² − c) − (1 + r)²/4 (u_j² + u_k² − 2c) in the mean, where c is the mean product of both velocities, as far as the kept
//! motion goes: Re(Ω² X_j X̄_k)/2. Each force gives Re(F_j · conj(iΩX_j))/2 in a unit of time, and for every mass
//!
//! Σ ν [(1 + r)(u_j² − c) − (1 + r)²/4 (u_j² + u_k² − 2c)] = Re(F_j · conj(iΩX_j))/2
//!
//! over its gaps; one at a wall takes (1 − r²) u² from its mass. Both are rows of three, solved by elimination, and the u² are
//! iterated from a hot chain down. What a mass's neighbours lose to it keeps it warm if its own force does not.
//!
//! *At an edge.* If nothing to the right of mass j was hit yet, its right gap is not there. Elimination from the left stops at j, and
//! gives the row of the mass behind; with it the two rows of mass j are solved anew, for its left gap is then colder and has fewer
//! impacts. That is iterated from hot to cold too. One pass gives the edges at every mass, with the whole chain to the left taken as running.

use super::complex::Complex;
use super::heat::Coupling;
use super::ordered::OrderedGas;
use crate::Error;
use crate::balance;
use impact_chain::Chain;

/// A mass at the edge of the part of the chain that has impacts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Edge {
    /// Mean square of the velocity that is random.
    pub square: f64,
    /// [Re X, Im X] of the motion that the force keeps up, Re X e^{iΩt}.
    pub kept: [f64; 2],
    /// Mean square distance from equilibrium among ordered masses of that velocity.
    pub position: f64,
    /// Mean square of all its velocity.
    pub all: f64,
    /// Impacts from behind in a unit of time.
    pub rate: f64,
}

/// All masses of a chain that impact at every gap.
#[derive(Clone, Debug, PartialEq)]
pub struct Masses {
    /// u² of each mass.
    pub square: Vec<f64>,
    /// Impacts in a unit of time at each gap, walls first and last.
    pub rate: Vec<f64>,
    /// With an edge at each mass, nothing being hit to its right ...
    pub rightward: Vec<Edge>,
    /// ... and to its left.
    pub leftward: Vec<Edge>,
}

/// Most rounds of the iteration, its share of the new value, and the change, in u² of the largest, at which it ends.
const ROUNDS: usize = 60;
const SHARE: f64 = 0.6;
const ENOUGH: f64 = 1e-5;
const EDGE_ROUNDS: usize = 40;

/// The least u² in units of (ωd)²: a mass that loses more than it gets still has its own forced motion.
const LEAST: f64 = 0.02;

/// The part of a mass's u² that is random, at least.
const RANDOM: f64 = 0.3;

/// What the rows of both systems are made of; gaps are counted from the left wall's.
struct System<'a> {
    chain: &'a Chain,
    forces: &'a [Complex],
    gaps: Vec<Coupling>,
    /// Kept motions, the energy that forces give, and c of each gap.
    kept: Vec<Complex>,
    given: Vec<f64>,
    shared: Vec<f64>,
}

/// Rows −b_{j−1} x_{j−1} + a_j x_j − b_j x_{j+1} = f_j after elimination from the left: pivots and right sides.
struct Eliminated<T> {
    pivots: Vec<T>,
    sides: Vec<T>,
}

trait Field:
    Copy
    + std::ops::Add<Output = Self>
    + std::ops::Mul<Output = Self>
    + std::ops::Div<Output = Self>
    + std::ops::Sub<Output = Self>
{
}
impl Field for f64 {}
impl Field for Complex {}

fn eliminate<T: Field>(diagonal: &[T], beside: &[T], sides: &[T]) -> Eliminated<T> {
    let (mut pivots, mut own) = (vec![diagonal[0]], vec![sides[0]]);
    for j in 1..diagonal.len() {
        let factor = beside[j - 1] / pivots[j - 1];
        pivots.push(diagonal[j] - factor * beside[j - 1]);
        own.push(sides[j] + factor * own[j - 1]);
    }
    Eliminated { pivots, sides: own }
}

impl<T: Field> Eliminated<T> {
    fn solved(&self, beside: &[T]) -> Vec<T> {
        let last = self.pivots.len() - 1;
        let mut x = vec![self.sides[last] / self.pivots[last]; last + 1];
        for j in (0..last).rev() {
            x[j] = (self.sides[j] + beside[j] * x[j + 1]) / self.pivots[j];
        }
        x
    }
}

/// Re(F · conj(iΩX))/2, what a force gives.
fn power(chain: &Chain, force: Complex, kept: Complex) -> f64 {
    // conj(iΩX) = −iΩ conj(X).
    0.5 * chain.forcing_frequency * (force * kept.conjugate()).im
}

impl System<'_> {
    fn detuned(&self) -> Complex {
        let (omega, big_omega) = (self.chain.natural_frequency, self.chain.forcing_frequency);
        Complex::new(omega * omega - big_omega * big_omega, 0.0)
    }

    /// The kept motions, eliminated from the left.
    fn motions(&self) -> (Eliminated<Complex>, Vec<Complex>) {
        let stiffness: Vec<Complex> = self.gaps.iter().map(|own| own.stiffness).collect();
        let diagonal: Vec<Complex> =
            stiffness.windows(2).map(|pair| self.detuned() + pair[0] + pair[1]).collect();
        let beside = stiffness[1..self.forces.len()].to_vec();
        (eliminate(&diagonal, &beside, self.forces), beside)
    }

    /// What a mass loses at a gap in a unit of time, per its own u².
    fn loss(&self, gap: usize) -> f64 {
        let r = self.chain.restitution;
        let wall = gap == 0 || gap == self.forces.len();
        let share = if wall { 1.0 - r * r } else { (1.0 + r) - 0.25 * (1.0 + r) * (1.0 + r) };
        self.gaps[gap].rate * share
    }

    /// What the kept motion of both masses of a gap spares each of them; nothing at walls.
    fn spared(&self, gap: usize) -> f64 {
        let r = self.chain.restitution;
        let wall = gap == 0 || gap == self.forces.len();
        let share = (1.0 + r) - 0.5 * (1.0 + r) * (1.0 + r);
        if wall { 0.0 } else { self.gaps[gap].rate * share * self.shared[gap] }
    }

    /// The energies, eliminated from the left.
    fn energies(&self) -> (Eliminated<f64>, Vec<f64>) {
        let n = self.forces.len();
        let r = self.chain.restitution;
        let diagonal: Vec<f64> = (0..n).map(|j| self.loss(j) + self.loss(j + 1)).collect();
        let beside: Vec<f64> =
            (1..n).map(|gap| 0.25 * (1.0 + r) * (1.0 + r) * self.gaps[gap].rate).collect();
        let sides: Vec<f64> =
            (0..n).map(|j| self.given[j] + self.spared(j) + self.spared(j + 1)).collect();
        (eliminate(&diagonal, &beside, &sides), beside)
    }

    /// Gaps at these u².
    fn set(&mut self, gas: &OrderedGas, square: &[f64]) {
        let last = square.len() - 1;
        self.gaps.clear();
        self.gaps.push(Coupling::at_wall(gas, self.chain, square[0]));
        let inner = square.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
        self.gaps.extend(inner.map(|mean| Coupling::between(gas, self.chain, mean)));
        self.gaps.push(Coupling::at_wall(gas, self.chain, square[last]));
        let (own, beside) = self.motions();
        self.kept = own.solved(&beside);
        let big2 = self.chain.forcing_frequency * self.chain.forcing_frequency;
        let product = |pair: &[Complex]| 0.5 * big2 * (pair[0] * pair[1].conjugate()).re;
        self.shared = std::iter::once(0.0)
            .chain(self.kept.windows(2).map(product))
            .chain(std::iter::once(0.0))
            .collect();
        self.given =
            self.forces.iter().zip(&self.kept).map(|(f, x)| power(self.chain, *f, *x)).collect();
    }

    /// An edge at each mass, nothing being hit to its right.
    fn edges(&self, gas: &OrderedGas, square: &[f64], least: f64) -> Vec<Edge> {
        let (motions, energies) = (self.motions().0, self.energies().0);
        (0..square.len()).map(|j| self.edge(gas, square, (&motions, &energies), j, least)).collect()
    }

    /// That at mass j. Its left gap is as cold as it and its neighbour are, and sets how cold they are: iterated from hot.
    fn edge(
        &self,
        gas: &OrderedGas,
        square: &[f64],
        (motions, energies): (&Eliminated<Complex>, &Eliminated<f64>),
        j: usize,
        least: f64,
    ) -> Edge {
        let (chain, r) = (self.chain, self.chain.restitution);
        let big2 = chain.forcing_frequency * chain.forcing_frequency;
        let handed = 0.25 * (1.0 + r) * (1.0 + r);
        let force = self.forces[j];
        let mut all = square[j];
        let mut behind = if j > 0 { square[j - 1] } else { 0.0 };
        let mut kept = Complex::default();
        let mut rate = 0.0;
        for _ in 0..EDGE_ROUNDS {
            let next = if j == 0 {
                let own = Coupling::at_wall(gas, chain, all);
                (rate, kept) = (own.rate, force / (self.detuned() + own.stiffness));
                power(chain, force, kept) / ((1.0 - r * r) * rate)
            } else {
                let own = Coupling::between(gas, chain, 0.5 * (all + behind));
                rate = own.rate;
                // The row of the mass behind, with this gap in place of that of the whole chain.
                let k = own.stiffness;
                let pivot = motions.pivots[j - 1] - self.gaps[j].stiffness + k;
                let side = motions.sides[j - 1];
                kept = (force + k * side / pivot) / (self.detuned() + k - k * k / pivot);
                let other = (side + k * kept) / pivot;
                let c = 0.5 * big2 * (kept * other.conjugate()).re;
                let (loss, passed) = (rate * (1.0 + r - handed), rate * handed);
                let spared = rate * (1.0 + r - 2.0 * handed) * c;
                let pivot = energies.pivots[j - 1] - self.loss(j) + loss;
                let side = energies.sides[j - 1] - self.given[j - 1] - self.spared(j)
                    + power(chain, self.forces[j - 1], other)
                    + spared;
                let given = power(chain, force, kept);
                let own =
                    (given + spared + passed * side / pivot) / (loss - passed * passed / pivot);
                behind += SHARE * (((side + passed * own) / pivot).max(least) - behind);
                own
            };
            let step = SHARE * (next.max(least) - all);
            all += step;
            if step.abs() <= 1e-3 * all {
                break;
            }
        }
        let square = (all - 0.5 * big2 * kept.square()).max(RANDOM * all);
        let d = chain.spacing;
        let scale = chain.natural_frequency * d;
        let position = gas.at(square / (scale * scale)).variance * d * d;
        Edge { square, kept: [kept.re, kept.im], position, all, rate }
    }

    /// The same chain seen from the other end.
    fn mirrored<'b>(&self, forces: &'b [Complex]) -> System<'b>
    where
        Self: 'b,
    {
        let back = |own: &[f64]| own.iter().rev().copied().collect();
        System {
            chain: self.chain,
            forces,
            gaps: self.gaps.iter().rev().copied().collect(),
            kept: self.kept.iter().rev().copied().collect(),
            given: back(&self.given),
            shared: back(&self.shared),
        }
    }
}

/// The masses of a chain between walls with these forces, [α, β] each.
///
/// # Errors
/// [`Error::Input`] for r = 1, where impacts lose nothing.
pub fn masses(
    gas: &OrderedGas,
    chain: &Chain,
    sigma: f64,
    forcing: &[[f64; 2]],
) -> Result<Masses, Error> {
    super::heat::check(chain, sigma)?;
    if forcing.is_empty() {
        return Err(Error::input("masses", "none", "give one at least"));
    }
    let scale = chain.natural_frequency * chain.spacing;
    let least = LEAST * scale * scale;
    let forces: Vec<Complex> = forcing.iter().map(|[a, b]| Complex::new(*a, -*b)).collect();
    // As hot as rare impacts would make it, and no hotter than a chain that is packed.
    let speed = sigma * chain.natural_frequency;
    let hot = balance::variance_ratio(chain)? * speed * speed;
    let mut square = vec![hot.clamp(least, scale * scale); forces.len()];
    let mut system = System {
        chain,
        forces: &forces,
        gaps: Vec::new(),
        kept: Vec::new(),
        given: Vec::new(),
        shared: Vec::new(),
    };
    for _ in 0..ROUNDS {
        system.set(gas, &square);
        let (own, beside) = system.energies();
        let mut change = 0.0_f64;
        let mut largest = 0.0_f64;
        for (old, new) in square.iter_mut().zip(own.solved(&beside)) {
            let step = SHARE * (new.max(least) - *old);
            *old += step;
            change = change.max(step.abs());
            largest = largest.max(*old);
        }
        if change <= ENOUGH * largest {
            break;
        }
    }
    system.set(gas, &square);
    let rightward = system.edges(gas, &square, least);
    let back: Vec<Complex> = forces.iter().rev().copied().collect();
    square.reverse();
    let mut leftward = system.mirrored(&back).edges(gas, &square, least);
    square.reverse();
    leftward.reverse();
    let rate = system.gaps.iter().map(|own| own.rate).collect();
    Ok(Masses { square, rate, rightward, leftward })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::closed::heat;
    use impact_numerics::random::NormalPairs;

    fn forces(masses: usize, sigma: f64) -> Vec<[f64; 2]> {
        let mut normals = NormalPairs::new("test of masses", 1, 0);
        (0..masses).map(|_| normals.pair().map(|x| sigma * x)).collect()
    }

    /// The rows themselves, and all energy at once.
    #[test]
    fn every_mass_gets_what_it_loses() {
        let (gas, chain, sigma) = (OrderedGas::new(), Chain::default(), 0.14);
        let forcing = forces(12, sigma);
        let found = masses(&gas, &chain, sigma, &forcing).unwrap();
        let own: Vec<Complex> = forcing.iter().map(|[a, b]| Complex::new(*a, -*b)).collect();
        let mut system = System {
            chain: &chain,
            forces: &own,
            gaps: Vec::new(),
            kept: Vec::new(),
            given: Vec::new(),
            shared: Vec::new(),
        };
        system.set(&gas, &found.square);
        let (n, r, u) = (own.len(), chain.restitution, &found.square);
        let mut given = 0.0;
        let mut taken = (1.0 - r * r) * (u[0] * found.rate[0] + u[n - 1] * found.rate[n]);
        for j in 0..n {
            let k = |gap: usize| system.gaps[gap].stiffness;
            let mut left = (Complex::new(-1.0, 0.0) + k(j) + k(j + 1)) * system.kept[j];
            if j > 0 {
                left = left - k(j) * system.kept[j - 1];
                // An impact of masses takes (1 − r²)/4 of ⟨V²⟩ = 2 (u² + u² − 2c).
                let c = system.shared[j];
                taken += found.rate[j] * 0.5 * (1.0 - r * r) * (u[j - 1] + u[j] - 2.0 * c);
            }
            if j + 1 < n {
                left = left - k(j + 1) * system.kept[j + 1];
            }
            // Ω² = 2 and D = −1 in floating point.
            assert!((left - own[j]).square() < 1e-24, "{j}");
            given += system.given[j];
        }
        assert!((given / taken - 1.0).abs() < 1e-4, "{given} {taken}");
    }

    /// The edge at a mass is the last mass of a chain that ends there, with gaps as hot as in the long one.
    #[test]
    fn an_edge_is_the_end_of_a_shorter_chain() {
        let (gas, chain, sigma) = (OrderedGas::new(), Chain::default(), 0.14);
        let forcing = forces(9, sigma);
        let found = masses(&gas, &chain, sigma, &forcing).unwrap();
        let own: Vec<Complex> = forcing.iter().map(|[a, b]| Complex::new(*a, -*b)).collect();
        let gaps: Vec<Coupling> = {
            let mut gaps = vec![Coupling::at_wall(&gas, &chain, found.square[0])];
            let inner = found.square.windows(2).map(|u| 0.5 * (u[0] + u[1]));
            gaps.extend(inner.map(|u| Coupling::between(&gas, &chain, u)));
            gaps
        };
        let mut gaps = gaps;
        let at = 4;
        // Rows from the edge back to the wall give one mass after the other; that at the wall must then hold by itself.
        let kept = found.rightward[at].kept;
        // The gap behind the edge is as cold as its rate tells, which rises with u².
        let rate = found.rightward[at].rate;
        let [square, _] = impact_numerics::bisection::bracket(1e-3, 10.0, |square| {
            Coupling::between(&gas, &chain, square).rate > rate
        });
        gaps[at] = Coupling::between(&gas, &chain, square);
        let detuned = Complex::new(-1.0, 0.0);
        let (mut right, mut here) = (Complex::default(), Complex::new(kept[0], kept[1]));
        for j in (0..=at).rev() {
            let beside = if j < at { gaps[j + 1].stiffness } else { Complex::default() };
            let diagonal = detuned + gaps[j].stiffness + beside;
            let rest = diagonal * here - beside * right - own[j];
            if j == 0 {
                assert!(rest.square() < 1e-20, "{rest:?}");
            } else {
                (right, here) = (here, rest / gaps[j].stiffness);
            }
        }
        // A mirror image has the same edges.
        let back: Vec<[f64; 2]> = forcing.iter().rev().copied().collect();
        let mirrored = masses(&gas, &chain, sigma, &back).unwrap();
        for (a, b) in found.rightward.iter().zip(mirrored.leftward.iter().rev()) {
            assert!((a.square / b.square - 1.0).abs() < 1e-3, "{a:?} {b:?}");
        }
    }

    #[test]
    fn many_masses_are_as_hot_as_all_alike() {
        let gas = OrderedGas::new();
        let chain = Chain { restitution: 0.95, ..Chain::default() };
        let found = masses(&gas, &chain, 0.2, &forces(2000, 0.2)).unwrap();
        let mean = found.square.iter().sum::<f64>() / 2000.0;
        let alike = heat::heat(&gas, &chain, 0.2).unwrap().unwrap().square;
        assert!((mean / alike - 1.0).abs() < 0.05, "{mean} {alike}");
    }
}
