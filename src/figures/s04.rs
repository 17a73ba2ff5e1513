//! Draws Fig. S4: how impacts spread from one gap, and the mean count that follows.

use super::prelude::*;

/// The σ of (a).
const SIGMAS: (f64, f64) = (0.075, 0.165);

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let table = |name| results.table(name);
    let sheet = Sheet::new(8600);
    counts(&sheet, results)?;
    let advance = table("seeds.advance")?;
    advances(&sheet, advance)?;
    halves(&sheet, table("seeds.rise")?, table("seeds.scores")?)?;
    let sigmas = advance.distinct("sigma")?;
    let [low, high] = [sigmas.first(), sigmas.last()].map(|end| end.copied().unwrap_or_default());
    let description = describe!(
        "(a) Mean count of all against σ: simulated points along the prediction from seeds; circuits steeper. (b) Advance \
         against time at σ from {low} to {high}: slower than ∝ t, the more so the smaller σ. (c) Half height falls with T.",
    );
    Ok(sheet.finish("From one gap to many: nucleation and growth", description))
}

fn counts(sheet: &Sheet, results: &Results) -> Drawn {
    let (theory, sweep) = (results.table("theory.curve")?, results.table("sweep.rows")?);
    let run = |column: &str| results.number(&format!("sweep.run.{column}"));
    let x = Axis::linear(SIGMAS.0, SIGMAS.1, 0.01, 2, SIGMA_LABEL);
    let y = gaps_axis(run("gaps")? as usize, 20.0);
    let panel = sheet.lettered("(a)", Frame::new(1150, 430, 8150, 3730), x, y)?;
    let transient = [("transient", run("transient")?)];
    for (look, column, height) in [(Look::THEORY, "simple", 50.0), (Look::REST, "rest", 62.0)] {
        let mut curve = theory.curve(&[], "sigma", column)?;
        curve.retain(|(sigma, _)| *sigma >= SIGMAS.0 && *sigma <= SIGMAS.1);
        panel.curve(look.name, &curve, look.line)?;
        let rising: Vec<_> = curve.into_iter().map(|(sigma, mean)| (mean, sigma)).collect();
        let place = (interpolate(&rising, height).unwrap_or(SIGMAS.0), height);
        panel.label(look.name, place, (-2, 0), GREEN)?;
    }
    let grown = results.table("seeds.means")?.series(&transient, "sigma", "grown")?;
    panel.joined_estimates(Look::SEEDS.name, &grown, Look::SEEDS.mark)?;
    if let Some((sigma, mean)) = grown.iter().find(|(_, mean)| mean.value > 85.0) {
        panel.label(Look::SEEDS.name, (*sigma, mean.value), (-1, -1), INK)?;
    }
    let mut means = sweep.series(&[], "sigma", "mean_all")?;
    means.retain(|(sigma, _)| *sigma > SIGMAS.0 && *sigma < SIGMAS.1);
    panel.joined_estimates(Look::ALL.name, &means, Look::ALL.mark)?;
    let low = means.iter().rfind(|(_, mean)| mean.value < 40.0);
    let Some((sigma, mean)) = low else { return Ok(()) };
    let leader = [(sigma + 0.001, mean.value - 3.0), (sigma + 0.004, mean.value - 10.0)];
    panel.guide("leader", &leader, Stroke::solid(RED, HAIR))?;
    panel.label(Look::ALL.name, leader[1], (1, 1), RED)
}

fn advances(sheet: &Sheet, advance: &Table) -> Drawn {
    let x = Axis::decades(1, 4, 1, "time since first impact (1/*ω*)").between(20.0, 1500.0);
    let y = Axis::decades(-1, 2, 1, "advance (gaps)").between(0.3, 80.0);
    let panel = sheet.lettered("(b)", Frame::new(1150, 5250, 3650, 7650), x, y)?.outside(Cut);
    let sigmas = advance.distinct("sigma")?;
    let three = [sigmas.first().copied(), Some(printed_threshold()), sigmas.last().copied()];
    let mut drawn = Vec::new();
    for (place, sigma) in three.into_iter().flatten().enumerate() {
        let points = advance.curve(&[("sigma", sigma)], "time", "advance")?;
        let (name, colour) = (format!("*σ* = {sigma}"), ordered(place, 3));
        panel.curve(&name, &points, Stroke::solid(colour, LINE))?;
        drawn.push((name, points, colour));
    }
    panel.label_ends(&drawn)?;
    let straight = Stroke::dashed(INK, THIN, SHORT);
    panel.guide("constant speed", &[(10.0, 1.0), (1e3, 100.0)], straight)?;
    panel.label("∝ *t*", (200.0, 20.0), (-1, -1), INK)
}

fn halves(sheet: &Sheet, rise: &Table, scores: &Table) -> Drawn {
    let x = Axis::decades(1, 4, 1, "transient *T* (1/*ω*)").between(20.0, 2000.0);
    let y = Axis::linear(0.1, 0.14, 0.01, 2, HALF_HEIGHT_LABEL).column("half_height (d omega^2)");
    let panel = sheet.lettered("(c)", Frame::new(5950, 5250, 8150, 7650), x, y)?.outside(Edge);
    let grown = rise.curve(&[], "transient", "half_height")?;
    panel.marked_curve(Look::SEEDS.name, &grown, Look::SEEDS.mark.2, Look::SEEDS.mark)?;
    let half_heights = scores.series(&[], "transient", "half_height")?;
    panel.joined_estimates(Look::ALL.name, &half_heights, Look::ALL.mark)?;
    panel.label("all chains", (150.0, 0.1355), (1, 0), RED)?;
    panel.label(Look::SEEDS.name, (300.0, 0.109), (-1, 0), INK)
}
