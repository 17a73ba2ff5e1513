//! Draws Fig. S2: the half height of the rise for each transient and window, as a map.

use super::prelude::*;

/// The numbers of a table's key as an axis of cells of equal width, counted from zero.
fn cells(values: &[f64], label: &str) -> Axis {
    let mut axis = Axis::linear(-0.5, values.len() as f64 - 0.5, 1.0, 1, label);
    for (tick, value) in axis.ticks.iter_mut().zip(values) {
        tick.label = Some(value.to_string());
    }
    axis
}

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let table = results.table("protocol.cells")?;
    let (transients, windows) = (table.distinct("transient")?, table.distinct("window")?);
    let sheet = Sheet::new(1450 + 400 * transients.len() as u32);
    let frame = Frame::new(1300, 550, 8300, 550 + 400 * transients.len() as i32);
    let x = cells(&windows, "window *W* (1/*ω*)");
    let y = cells(&transients, "transient *T* (1/*ω*)").column("half_height (d omega^2)");
    let panel = sheet.panel(frame, x, y)?;
    let printed = number(printed_threshold(), 2);
    let key = format!("{HALF_HEIGHT_LABEL}; outlined: rounds to {printed}; broken frame: ours");
    panel.heading("", &key)?;
    let mut as_printed = Vec::new();
    let end = |column: &str| results.number(&format!("protocol.all.{column}"));
    let (least, most) = (end("least")?, end("largest")?);
    for (row, transient) in transients.iter().enumerate() {
        for (column, window) in windows.iter().enumerate() {
            let keys = [("transient", *transient), ("window", *window)];
            let centre = (column as f64, row as f64);
            let Ok(half) = table.number(&keys, "half_height") else {
                panel.label("none", centre, (0, 0), INK)?;
                continue;
            };
            panel.record(&format!("*T* = {transient}"), [(*window, half)]);
            let corners = [(centre.0 - 0.5, centre.1 - 0.5), (centre.0 + 0.5, centre.1 + 0.5)];
            let share = 0.05 + 0.6 * (half - least) / (most - least);
            let ground = Rectangle::new(corners, BLUE.mix(share).filled());
            panel.draw_series("half height", [ground])?;
            let number_style = words(SMALL, INK, HPos::Center, VPos::Center);
            panel.area.draw(&Text::new(number(half, 3), centre, number_style))?;
            if number(half, 2) == printed {
                as_printed.push(centre);
            }
            if (Protocol { transient: *transient, window: *window }) == Protocol::default() {
                let around = [(-0.4, -0.4), (0.4, -0.4), (0.4, 0.4), (-0.4, 0.4), (-0.4, -0.4)];
                let around = around.map(|(x, y)| (centre.0 + x, centre.1 + y));
                panel.guide("ours", &around, Stroke::dashed(RED, LINE, SHORT))?;
            }
        }
    }
    // The outline of what rounds to the printed value: sides with such a cell on one side only.
    for &(x, y) in &as_printed {
        for (right, up) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)] {
            if !as_printed.contains(&(x + right, y + up)) {
                let side =
                    [-0.5, 0.5].map(|t| (x + 0.5 * right + t * up, y + 0.5 * up + t * right));
                panel.guide("as printed", &side, Stroke::solid(INK, LINE + 12))?;
            }
        }
    }
    let description = describe!(
        "A map of the half height over {} transients, upwards, and {} windows, to the right: from {} at the lower left it falls to {} at the \
         upper right. {} cells, on a band from the upper left to the lower right, round to {printed} and are outlined; ours is one of \
         them.",
        transients.len(),
        windows.len(),
        short(most, 3),
        short(least, 3),
        as_printed.len(),
    );
    Ok(sheet.finish("Half height for each transient and window", description))
}
