//! Draws Fig. 7: how many simple circuits there are of each length, and the logarithm, which the
//! paper does not show.

use super::prelude::*;
use crate::experiments::theory::counts::shares;

/// The lengths in (a); shorter ones are too rare to be visible.
const SHOWN: f64 = 0.9 * N as f64;

pub fn draw() -> Result<Figure, Error> {
    let [share, logs] = shares();
    let sheet = Sheet::new(4350);
    let top = largest(&share);
    let x = Axis::linear(SHOWN - 0.5, N as f64 + 0.5, 2.0, 2, "length *k*");
    let y = Axis::up_to(top, "*ϕ*_{*N*}(*k*) / *ϕ*_{*N*}^{tot}");
    let name = y.label.clone();
    let columns = sheet.lettered("(a)", Frame::new(1150, 480, 3950, 3380), x, y)?;
    columns.set_suffix("");
    columns.columns("share of circuits", &share, Stroke::solid(GREEN, THIN))?;
    let lowest = (logs.iter().copied().fold(0.0, f64::min) / 40.0).floor() as i32 * 40;
    let x = Axis::linear(0.0, N as f64 + 1.0, 20.0, 2, "length *k*");
    let frame = Frame::new(5600, 480, 8200, 3380);
    let curve = sheet.lettered("(b)", frame, x, Axis::decades(lowest, 0, 40, &name))?.unrecorded();
    curve.curve("share of circuits", &over_k(&share), Stroke::solid(GREEN, LINE))?;
    let first = format!("10^{{−{}}}", -logs[0].round());
    let disc = (Symbol::Disc, MEDIUM, Stroke::solid(GREEN, THIN));
    curve.markers("first", &[(1.0, share[0])], disc)?;
    curve.label(&format!("{first} at *k* = 1"), (1.0, share[0]), (3, -1), INK)?;

    let peak = share.iter().position(|&s| s == top).unwrap_or(0) + 1;
    let description = describe!(
        "The share of all simple circuits of a fully connected graph of N = {N} vertices that have length k. (a) Columns over \
         the last few k, which hold nearly all; the highest, {}, stands at k = {peak}. (b) All k on a logarithmic axis: the share \
         falls to about {} at k = 1.",
        short(top, 3),
        format!("10^{}", logs[0].round()),
    );
    Ok(sheet.finish("Number of simple circuits of each length", description))
}
