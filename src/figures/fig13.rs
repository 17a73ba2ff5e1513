//! Fig. 13 (a) to (d): distributions with higher-order circuits and what each class contributes.

use super::axis::Axis;
use super::chart::{FOUR, LETTERS, heading, largest, over_k, short, upwards_from_zero};
use super::data::cells;
use super::panel::{Outside, Panel};
use super::sheet::{Entry, Sheet};
use super::style::{
    BLUE, Colour, Dash, GREEN, INK, LINE, Mark, ORANGE, PURPLE, RED, SMALL, Stroke, THIN,
};
use super::{DataFile, Error, Figure};
use crate::experiments::theory::{HigherDistribution, Theory};

/// Largest k of the detail in (b).
const DETAIL: usize = 12;

/// The five classes in the order of Eq. (38): symbol, colour and dash.
const CLASSES: [(&str, Colour, Dash); 5] = [
    ("*ϕ*_{*N*}", GREEN, Dash::Long),
    ("*ϕ*_{*N*}^{1}", BLUE, Dash::Short),
    ("*ϕ*_{*N*}^{1,0}", ORANGE, Dash::Dotted),
    ("*ϕ*_{*N*}^{1,0,0}", INK, Dash::Dotted),
    ("*ϕ*_{*N*}^{2}", PURPLE, Dash::Alternate),
];

/// Draws the figure.
pub fn draw(theory: &Theory) -> Result<Figure, Error> {
    let sheet = Sheet::new(7650, None)?;
    let n = theory.vertices;
    let [small, middle, large] = theory.higher.as_slice() else {
        return Err(Error::Shape { figure: 13, expected: "higher-order distributions at three p" });
    };
    let mut data = Vec::new();
    let mut seen = Vec::new();
    for (i, (distribution, shown)) in
        [(small, n), (small, DETAIL), (middle, n), (large, n)].into_iter().enumerate()
    {
        let (step, minor) = if shown == DETAIL { (4.0, 4) } else { (20.0, 2) };
        let end = if shown == DETAIL { shown as f64 } else { n as f64 + 1.0 };
        let panel = sheet.panel(
            FOUR[i],
            Axis::linear(0.0, end, step, minor, "*k*"),
            upwards_from_zero(largest(&distribution.total), "*P*(*X* = *k*)"),
        )?;
        let p = short(distribution.p, 3);
        let detail = if shown == DETAIL { ", small *k*" } else { "" };
        heading(&panel, LETTERS[i], &format!("*p* = {p}{detail}"))?;
        series(&panel, distribution, shown)?;
        data.push(table(LETTERS[i], distribution, shown));
        if shown != DETAIL {
            seen.push(words(LETTERS[i], distribution));
        }
    }
    let mut entries = vec![Entry::line(Stroke::solid(RED, LINE), "all five classes")];
    entries.extend(
        CLASSES
            .iter()
            .map(|&(symbol, colour, dash)| Entry::line(Stroke::dashed(colour, LINE, dash), symbol)),
    );
    for (i, pair) in entries.chunks(2).enumerate() {
        sheet.legend(([600, 3700, 6100][i], 6950), (SMALL, 400), pair)?;
    }
    let description = format!(
        "Four charts of the probability of k different impacts, N = {n}, for a sample space of \
         five classes of circuits: a red line for the sum, broken lines for the classes. {}. (b) \
         shows k up to {DETAIL} of (a).",
        seen.join("; ")
    );
    Ok(sheet.finish(13, "Distributions with higher-order circuits", description, data))
}

fn series(panel: &Panel, distribution: &HigherDistribution, shown: usize) -> Result<(), Error> {
    let detail = shown == DETAIL;
    let total = over_k(&distribution.total[..shown.min(distribution.total.len())]);
    let red = Stroke::solid(RED, LINE);
    panel.curve("all five classes", &total, red, Outside::Refuse)?;
    for (class, &(symbol, colour, dash)) in distribution.classes.iter().zip(&CLASSES) {
        let name = super::markup::plain(symbol);
        let points = over_k(&class.probability[..shown.min(class.probability.len())]);
        panel.curve(&name, &points, Stroke::dashed(colour, LINE, dash), Outside::Refuse)?;
        if detail {
            let dots = (Mark::Disc, 28, Stroke::solid(colour, THIN));
            panel.marks(&name, &points, dots, Outside::Refuse)?;
        }
    }
    Ok(())
}

fn table(letter: &str, distribution: &HigherDistribution, shown: usize) -> DataFile {
    let name = format!("fig13{}.csv", letter.trim_matches(['(', ')']));
    let mut file = DataFile::new(
        &name,
        &[
            "p (1)",
            "k (1)",
            "probability_all (1)",
            "simple_eq7 (1)",
            "one_vertex_twice_eq33 (1)",
            "one_vertex_thrice_eq35 (1)",
            "one_vertex_four_times_eq36 (1)",
            "two_vertices_twice_eq37 (1)",
        ],
    );
    for (i, &total) in distribution.total.iter().take(shown).enumerate() {
        let class =
            |c: usize| distribution.classes.get(c).and_then(|c| c.probability.get(i)).copied();
        file.row(cells![
            distribution.p,
            i + 1,
            total,
            class(0),
            class(1),
            class(2),
            class(3),
            class(4)
        ]);
    }
    file
}

fn words(letter: &str, distribution: &HigherDistribution) -> String {
    let share = distribution.classes.first().map_or(0.0, |c| c.share);
    format!(
        "{letter} p = {}: simple circuits hold {} of the whole, the sum is highest at k = {} and its \
         mean is {}",
        short(distribution.p, 3),
        short(share, 2),
        distribution.k_star,
        short(distribution.mean, 3)
    )
}
