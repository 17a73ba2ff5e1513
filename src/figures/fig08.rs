//! Fig. 8 (a) to (d): the distribution of the number of different impacts at four p.

use plotters::style::text_anchor::HPos;

use super::axis::Axis;
use super::chart::{FOUR, LETTERS, columns, corner, heading, largest, short, upwards_from_zero};
use super::series::Outside;
use super::sheet::Sheet;
use super::style::{GREEN, Stroke, THIN};
use super::{DataFile, Error, Figure};
use crate::experiments::theory::Theory;

/// Draws the figure.
pub fn draw(theory: &Theory) -> Result<Figure, Error> {
    let sheet = Sheet::new(6750, None)?;
    let n = theory.vertices;
    let mut data = Vec::new();
    let mut seen = Vec::new();
    for (i, distribution) in theory.distributions.iter().take(4).enumerate() {
        let top = largest(&distribution.probability);
        let panel = sheet.panel(
            FOUR[i],
            Axis::linear(0.0, n as f64 + 1.0, 20.0, 2, "*k*"),
            upwards_from_zero(1.04 * top, "*P*(*X* = *k*)"),
        )?;
        let shape = columns(&distribution.probability);
        panel.area("probability", &shape, GREEN, 45)?;
        panel.curve("probability", &shape, Stroke::solid(GREEN, THIN), Outside::Refuse)?;
        let p = short(distribution.p, 3);
        heading(&panel, LETTERS[i], &format!("*p* = {p}"))?;
        let (k_star, mean) = (distribution.k_star, short(distribution.mean, 3));
        let lines = [format!("*k*^{{∗}} = {k_star}"), format!("*μ* = {mean}")];
        // The words go where the columns are low.
        let side = if k_star > n / 2 { HPos::Left } else { HPos::Right };
        corner(&panel, side, &lines)?;
        let file = format!("fig08{}.csv", LETTERS[i].trim_matches(['(', ')']));
        let columns: [(&str, &[f64]); 1] = [("probability (1)", &distribution.probability)];
        data.push(DataFile::over_k(&file, Some(distribution.p), &columns));
        seen.push(format!("{} p = {p}: mean {mean}", LETTERS[i]));
    }
    let description = format!(
        "Columns over k = 1 … {n}: the probability of k different impacts for simple circuits, N = {n}. From panel to panel \
         the weight moves from single impacts to nearly the whole system. {}.",
        seen.join("; ")
    );
    Ok(sheet.finish("fig08", "Distribution of the number of impacts", description, data))
}
