//! Fig. S14: what a method does to the mean number of gaps that impact, against counted work.

use super::prelude::*;
use super::rivals::{entries, look, name};
use crate::experiments::accuracy::bias::{BiasRow, Biases};

/// Within this share of the mean a method is good enough for the mean.
const GOOD: f64 = 1.0;

/// Bias and its error in per cent of the mean.
fn percent(row: &BiasRow) -> Option<[f64; 2]> {
    let own = row.own_mean.filter(|own| *own > 0.0)?;
    Some([100.0 * row.bias? / own, 100.0 * row.error.unwrap_or(0.0) / own])
}

/// The axis of all panels, in per cent.
fn symmetric() -> Axis {
    let ticks = [-100_i32, -10, -1, 0, 1, 10, 100].map(|at| Tick {
        at: f64::from(at), // There is no room for one beside zero.
        label: (at.abs() != 1).then(|| number(f64::from(at), 0)),
    });
    Axis::new(Scale::Symmetric, [-150.0, 150.0], "bias (%)", ticks.into())
}

/// Draws the figure.
pub fn draw(biases: &Biases, note: Option<&str>) -> Result<Figure, Error> {
    let sigmas: Vec<f64> = biases.certified.iter().map(|own| own.sigma).collect();
    let panels = sigmas.len() as i32;
    let bottom = 430 + 2500 * panels;
    let sheet = Sheet::new((bottom + 1850) as u32, note)?;
    let costs = || biases.rows.iter().filter_map(|row| row.evaluations_per_impact);
    for (i, sigma) in sigmas.iter().enumerate() {
        let last = i + 1 == sigmas.len();
        let rows: Vec<&BiasRow> = biases.rows.iter().filter(|row| row.sigma == *sigma).collect();
        let x = Axis::around(costs(), 1, "evaluations per impact");
        let top = 430 + 2500 * i as i32;
        let panel = sheet.lettered(
            LETTERS[i.min(LETTERS.len() - 1)],
            Frame::new(1300, top, 8150, top + 1900),
            if last { x } else { x.bare() },
            symmetric(),
        )?;
        let words = (SMALL, INK, HPos::Right, VPos::Bottom);
        panel.note(&format!("*σ* = {sigma}"), (panel.x.hi, panel.y.hi), (0, -80), words)?;
        let (a, b) = (panel.x.lo, panel.x.hi);
        panel.area(
            "within one per cent",
            &[(a, -GOOD), (b, -GOOD), (b, GOOD), (a, GOOD)],
            PALE,
            100,
        )?;
        panel.level("zero", 0.0, Stroke::solid(GREY, HAIR))?;
        for row in rows {
            let (Some([bias, error]), Some(cost)) = (percent(row), row.evaluations_per_impact)
            else {
                continue;
            };
            let look = look(row.setting.method);
            let label = name(row.setting.method);
            let bar = [(cost, bias - error, bias + error)];
            panel.bars(label, &bar, 40, look.2, Outside::Refuse)?;
            panel.marks(label, &[(cost, bias)], look, Outside::Refuse)?;
        }
    }
    let present = |method| biases.rows.iter().any(|row| row.setting.method == method);
    sheet.legend_in_columns((1300, bottom + 700), (SMALL, 370), (3, 3200), &entries(present))?;
    Ok(sheet.finish("s14", "Bias of the mean count", description(biases)))
}

fn description(biases: &Biases) -> String {
    let largest = biases.rows.iter().filter_map(percent).map(|[bias, _]| bias.abs());
    format!(
        "One chart for each σ: a method’s mean number of impacting gaps less that of the certified engine on the same chains, in per cent, \
         with paired standard errors, against evaluations per impact. Coarse settings are off by up to {}; fine ones lie in \
         a grey band, one per cent to both sides, as far as their errors tell.",
        short(largest.fold(0.0, f64::max), 2)
    )
}
