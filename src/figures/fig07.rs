//! Fig. 7: how many simple circuits there are of each length.

use super::prelude::*;
use crate::experiments::theory::counts::shares;
use crate::params::VERTICES as N;

pub fn draw() -> Result<Figure, Error> {
    let [share, logs] = shares();
    let sheet = Sheet::new(5150);
    let top = largest(&share);
    let x = Axis::linear(0.0, N as f64 + 1.0, 20.0, 2, "length *k*");
    let y = upwards_from_zero(top, "*ϕ*_{*N*}(*k*) / *ϕ*_{*N*}^{tot}");
    let panel = sheet.panel(Frame::new(1350, 300, 8100, 4200), x, y)?;
    panel.columns("share of circuits", &share, Stroke::solid(GREEN, THIN))?;

    let lowest = (logs.iter().copied().fold(0.0, f64::min) / 40.0).floor() as i32 * 40;
    let inset = sheet.inset(
        Frame::new(2850, 650, 6150, 2750),
        Axis::linear(0.0, N as f64 + 1.0, 25.0, 1, "*k*"),
        Axis::decades(lowest, 0, 40, "share"),
    )?;
    let line = Stroke::solid(GREEN, LINE);
    inset.curve("logarithm of the share", &over_k(&share), line, Outside::Refuse)?;

    let peak = share.iter().position(|&s| s == top).unwrap_or(0) + 1;
    let description = seen!(
        "Columns over k = 1 … {N}: the share of all simple circuits of a fully connected graph of N = {N} vertices that have \
         length k. Only the last few are visible; the highest, {}, stands at k = {peak}. An inset shows the logarithm, which \
         falls to about {} at k = 1.",
        short(top, 3),
        format!("10^{}", logs.first().copied().unwrap_or(0.0).round() as i64),
    );
    Ok(sheet.finish("fig07", "Number of simple circuits of each length", description))
}
