//! The numbered equations of the paper, and where each lives in the source.

use super::ledger::EquationEntry;

/// One numbered equation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Equation {
    /// Its number in the paper.
    pub number: u32,
    /// The section where it stands.
    pub section: u32,
    /// What it says, in a few words.
    pub what: &'static str,
}

const fn equation(number: u32, section: u32, what: &'static str) -> Equation {
    Equation { number, section, what }
}

/// All of them, in order.
pub const EQUATIONS: [Equation; 38] = [
    equation(1, 1, "a piecewise smooth system in general"),
    equation(2, 1, "motion of mass j between impacts"),
    equation(3, 1, "the forcing as a sum of harmonics"),
    equation(4, 2, "the motion in scaled units"),
    equation(5, 2, "the forcing with one harmonic"),
    equation(6, 5, "paths of length k back to their first vertex"),
    equation(7, 5, "simple circuits of length k, $\\phi_N(k)$"),
    equation(8, 5, "$\\phi_N(k)$ against $\\phi_N(N)$"),
    equation(9, 6, "distribution of the number of impacts, $P(X = k)$"),
    equation(10, 6, "its weights $\\Phi_{N,p}(k)$ and their sum $\\Gamma_{N,p}$"),
    equation(11, 7, "difference of neighbouring weights"),
    equation(12, 7, "$f_{N,p}(k)$, which has the sign of that difference"),
    equation(13, 7, "the zeros $k_\\pm$ of $f_{N,p}$"),
    equation(14, 7, "$f_{N,p}$ at k = 0"),
    equation(15, 7, "$f_{N,p}$ at k = N"),
    equation(16, 7, "$f_{N,p}$ at p = 0"),
    equation(17, 7, "the slope of $f_{N,p}$ in p"),
    equation(18, 7, "$p_{\\mathrm{crit}}$, where $f_{N,p}$ has a double zero"),
    equation(19, 8, "the separation $\\Delta_j(t)$ of two neighbours"),
    equation(20, 8, "the probability that a gap never closes"),
    equation(21, 8, "the amplitudes $Y_i$"),
    equation(22, 8, "density of $Y_0$"),
    equation(23, 8, "density of the scaled $Y_1$"),
    equation(24, 8, "the probability of no impact as a convolution"),
    equation(25, 8, "p(σ)"),
    equation(26, 9, "lengths of the two loops of a circuit with one doubled vertex"),
    equation(27, 9, "circuits through one doubled vertex, vertex by vertex"),
    equation(28, 9, "the same, by the length k"),
    equation(29, 9, "the same, as factorials"),
    equation(30, 9, "circuits with one doubled vertex, as a sum over loops"),
    equation(31, 9, "an integer as an ordered sum"),
    equation(32, 9, "the number $\\gamma(n, j)$ of such sums"),
    equation(33, 9, "circuits with one doubled vertex, $\\phi_N^1(k)$"),
    equation(34, 9, "circuits of a general class, by the visits $\\delta_j$"),
    equation(35, 9, "circuits with one tripled vertex"),
    equation(36, 9, "circuits with one vertex visited four times"),
    equation(37, 9, "circuits with two doubled vertices"),
    equation(38, 9, "circuits of five classes with k different vertices"),
];

/// All equations with their homes, as the ledger has them.
pub fn entries() -> Vec<EquationEntry> {
    let entry = |equation: Equation, home: Home| EquationEntry {
        number: equation.number,
        section: equation.section,
        what: equation.what.into(),
        home: home.item.into(),
        step_towards: home.step_towards().map(String::from),
    };
    let of = |equation: Equation| homes(equation.number).map(move |home| entry(equation, home));
    EQUATIONS.into_iter().flat_map(of).collect()
}

/// Every home in the source: (number, path of the item, what its comment says behind the number,
/// file).
/// The build script collects them from the doc comments that have `**Eq. (n)**`.
const HOMES: &[(u32, &str, &str, &str)] = include!(concat!(env!("OUT_DIR"), "/homes.rs"));

/// The homes of an equation; a test demands that there is exactly one.
pub fn homes(number: u32) -> impl Iterator<Item = Home> {
    let own = HOMES.iter().filter(move |home| home.0 == number);
    own.map(|&(_, item, note, file)| Home { item, file, note })
}

/// Where an equation lives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Home {
    /// Path of the item, as `impact_circuits::jump::p_crit`.
    pub item: &'static str,
    /// The file, as `crates/circuits/src/jump.rs`.
    pub file: &'static str,
    /// What the comment says behind the number; "(step towards (18))" where coding the equation
    /// itself would be pointless.
    note: &'static str,
}

impl Home {
    /// "(18)" if this is a step towards it.
    pub fn step_towards(&self) -> Option<&'static str> {
        let rest = self.note.strip_prefix("(step towards ")?;
        rest.find("))").map(|end| &rest[..=end])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_equation_has_one_home() {
        for equation in EQUATIONS {
            let items: Vec<&str> = homes(equation.number).map(|home| home.item).collect();
            assert_eq!(items.len(), 1, "Eq. ({}) lives in {items:?}", equation.number);
        }
        for (number, item, ..) in HOMES {
            assert!((1..=38).contains(number), "{item} is the home of no equation ({number})");
        }
    }

    #[test]
    fn homes_are_read_from_the_comments() {
        let home = |number| homes(number).next().unwrap();
        assert_eq!(home(18).item, "impact_circuits::jump::p_crit");
        assert_eq!(home(18).step_towards(), None);
        assert_eq!(home(14).step_towards(), Some("(18)"));
    }
}
