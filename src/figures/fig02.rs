//! Draws Fig. 2: the most likely number of impacts against σ, simulated, and the distributions
//! before, at and after its jump.

use super::prelude::*;

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let table = results.table("jump.distributions")?;
    let n = largest(&table.distinct("gaps")?) as usize;
    let Protocol { transient, window } = Protocol::default();
    let row = format!("jump.windows[transient={transient},window={window}]");
    let at = |column: &str| results.number(&format!("{row}.{column}")).ok();
    let (place, below, single) = (at("place"), at("below"), at("single_place"));
    let sheet = Sheet::new(8750);
    let panel = sheet.lettered("(a)", MAIN, sigma_axis(), gaps_axis(n, 20.0))?.outside(Cut);
    let rows = results.table("jump.rows")?;
    let modes = rows.curve(&[], "sigma", "mode")?;
    let peaks = rows.series(&[], "sigma", "peak")?;
    // Where a single gap or all gaps are the most likely number there is no interval.
    let bars = peaks.iter().filter(|(sigma, peak)| modes.contains(&(*sigma, peak.value)));
    let bars: Vec<_> = bars.map(|(s, peak)| (*s, peak.interval[0], peak.interval[1])).collect();
    panel.bars(Look::MODE.name, &bars, 40, Stroke::solid(GREY, 30))?;
    draw_printed_threshold(&panel, 1.02 * n as f64)?;
    panel.markers(Look::MODE.name, &modes, Look::MODE.mark)?;
    let mode_label = format!("{}: all gaps", Look::MODE.name);
    panel.label(&mode_label, (panel.x.hi, n as f64), (-1, 2), PURPLE)?;
    let guide = Stroke::dashed(PURPLE, THIN, SHORT);
    if let Some((place, below)) = place.zip(below) {
        panel.guide("jump", &[(place, below), (place, n as f64)], guide)?;
        let jump_label = format!("from {} to {n} at *σ* = {}", short(below, 2), short(place, 4));
        panel.label(&jump_label, (place, 0.7 * n as f64), (2, 0), PURPLE)?;
    }
    if let (Some(place), Some(bar)) = (single, bars.first()) {
        panel.guide("jump", &[(place, 1.0), (place, bar.1)], guide)?;
        panel.label("one gap", (panel.x.lo, 1.0), (3, -4), PURPLE)?;
    }
    if let Some(bar) = bars.get(bars.len() / 2) {
        panel.label("its 95 % interval", (bar.0, bar.1), (2, 3), GREY)?;
    }

    let top = largest(&table.distinct("share")?);
    let mut heights = Vec::new();
    for (i, sigma) in table.distinct("sigma")?.into_iter().enumerate() {
        let shares = table.curve(&[("sigma", sigma)], "gaps", "share")?;
        let columns: Vec<f64> = shares.iter().map(|(_, share)| *share).collect();
        let left = 1200 + 2400 * i as i32;
        // The name of all three axes stands below the middle one.
        let mut x = gaps_axis(n, 50.0);
        if i != 1 {
            x.label.clear();
        }
        let y = Axis::up_to(1.05 * top, "share of chains");
        let y = if i == 0 { y } else { y.without_numbers() };
        let panel = sheet.panel(Frame::new(left, 5550, left + 2150, 7850), x, y)?.outside(Cut);
        panel.heading(["(b)", "(c)", "(d)"][i], &format!("*σ* = {}", short(sigma, 4)))?;
        panel.columns("share of chains", &columns, Stroke::solid(RED, HAIR / 2))?;
        // How high the hump is, up to the column of all gaps, which has its standard error.
        let keys = [("sigma", sigma)];
        let [all, hump, peak] = ["all", "bulk", "peak"].map(|column| rows.number(&keys, column));
        let (all, hump) = (all?, hump?);
        panel.guide("hump", &[(peak?, hump), (panel.x.hi, hump)], guide)?;
        let end = rows.series(&keys, "sigma", "all")?.into_iter().map(|row| (n as f64, row.1));
        let dot = (Symbol::Disc, 32, Stroke::solid(INK, THIN));
        panel.unrecorded().estimates("all gaps", &end.collect::<Vec<_>>(), dot)?;
        heights.push(format!("{}, {} at σ = {}", short(hump, 2), short(all, 2), short(sigma, 4)));
    }
    let at = |place: Option<f64>, digits| {
        place.map_or(String::new(), |place| format!(" at σ = {}", short(place, digits)))
    };
    let description = describe!(
        "(a) Most likely number of gaps that impact against σ: one, then{} a hump that climbs to about half of {n}, \
         then all{}; dotted: the printed σ = {}. (b) to (d) Heights of the hump and of the column of all gaps: {}.",
        at(single, 2),
        at(place, 4),
        printed_threshold(),
        heights.join(", "),
    );
    Ok(sheet.finish("Most likely number of impacts", description))
}
