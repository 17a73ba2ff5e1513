//! Lists the numbered equations of the paper with their homes, where a test finds `**Eq. (n)**`.

use literate::report::EquationEntry;

/// Number, section, all digits of its formula in the prose, words, the item that documents it, and
/// the equation that a step leads to.
macro_rules! equations {
    ($($number:literal, $section:literal, $digits:literal, $what:literal, $home:path $(, towards $next:literal)?;)*) => {
        vec![$(EquationEntry {
            number: $number,
            section: $section,
            digits: Some($digits),
            what: $what.into(),
            home: stringify!($home).into(),
            step_towards: [$(concat!("(", $next, ")"))?].first().map(|next: &&str| next.to_string()),
        }),*]
    };
}

/// All numbered equations, in order.
pub fn equations() -> Vec<EquationEntry> {
    equations! {
        1, 1, "", "a piecewise smooth system in general", impact_chain, towards 2;
        2, 1, "2221", "motion of mass j between impacts", impact_chain::flight::Motion;
        3, 1, "1", "the forcing as a sum of harmonics", impact_chain::scenario::Scenario;
        4, 2, "22", "the motion in scaled units", impact_chain::chain::Chain, towards 2;
        5, 2, "11", "the forcing with one harmonic", impact_chain::scenario::Scenario::draw;
        6, 5, "1211", "paths of length k back to their first vertex", impact_circuits::counting::paths;
        7, 5, "", "simple circuits of length k, $\\phi_N(k)$", impact_circuits::counting::phi;
        8, 5, "1", "$\\phi_N(k)$ against $\\phi_N(N)$", impact_circuits::counting::ratio_to_longest;
        9, 6, "1", "distribution of the number of impacts, $P(X = k)$", impact_circuits::distribution::Law::probability;
        10, 6, "1", "its weights $\\Phi_{N,p}(k)$ and their sum $\\Gamma_{N,p}$", impact_circuits::distribution::Law::weight;
        11, 7, "11211", "difference of neighbouring weights", impact_circuits::jump::rises;
        12, 7, "211", "$f_{N,p}(k)$, which has the sign of that difference", impact_circuits::jump::f;
        13, 7, "121124", "the zeros $k_\\pm$ of $f_{N,p}$", impact_circuits::jump::zeros;
        14, 7, "01", "$f_{N,p}$ at k = 0", impact_circuits::jump::f, towards 18;
        15, 7, "1", "$f_{N,p}$ at k = N", impact_circuits::jump::f, towards 18;
        16, 7, "010", "$f_{N,p}$ at p = 0", impact_circuits::jump::f, towards 18;
        17, 7, "00", "the slope of $f_{N,p}$ in p", impact_circuits::jump::f, towards 18;
        18, 7, "112", "$p_{\\mathrm{crit}}$, where $f_{N,p}$ has a double zero", impact_circuits::jump::p_crit;
        19, 8, "0100101112211122", "the separation $\\Delta_j(t)$ of two neighbours", impact_chain::flight::Motion::frame;
        20, 8, "10122", "the probability that a gap never closes", impact_circuits::impact_probability::ImpactProbability::complement;
        21, 8, "121201", "the amplitudes $Y_i$", impact_circuits::impact_probability::density_free, towards 22;
        22, 8, "022242", "density of $Y_0$", impact_circuits::impact_probability::density_free;
        23, 8, "12222222222242", "density of the scaled $Y_1$", impact_circuits::impact_probability::density_forced;
        24, 8, "10122", "the probability of no impact as a convolution", impact_circuits::impact_probability::ImpactProbability::p_by_double_integral;
        25, 8, "12224400242222242", "p(σ)", impact_circuits::impact_probability::ImpactProbability::p;
        26, 9, "1121", "lengths of the two loops of a circuit with one doubled vertex", impact_circuits::higher_order::doubled_paths, towards 30;
        27, 9, "11111121212", "circuits through one doubled vertex, vertex by vertex", impact_circuits::higher_order::doubled_paths, towards 29;
        28, 9, "122", "the same, by the length k", impact_circuits::higher_order::doubled_paths, towards 29;
        29, 9, "11", "the same, as factorials", impact_circuits::higher_order::doubled_paths;
        30, 9, "112122112211", "circuits with one doubled vertex, as a sum over loops", impact_circuits::higher_order::doubled_as_printed;
        31, 9, "12", "an integer as an ordered sum", impact_circuits::higher_order::compositions, towards 32;
        32, 9, "1111", "the number $\\gamma(n, j)$ of such sums", impact_circuits::higher_order::compositions;
        33, 9, "11211", "circuits with one doubled vertex, $\\phi_N^1(k)$", impact_circuits::higher_order::doubled;
        34, 9, "4321", "circuits of a general class, by the visits $\\delta_j$", impact_circuits::higher_order::Class;
        35, 9, "10161323", "circuits with one tripled vertex", impact_circuits::higher_order::three_visits;
        36, 9, "1001241434", "circuits with one vertex visited four times", impact_circuits::higher_order::four_visits;
        37, 9, "2181424", "circuits with two doubled vertices", impact_circuits::higher_order::two_doubled;
        38, 9, "11102100322", "circuits of five classes with k different vertices", impact_circuits::higher_order::multiplicity;
    }
}
