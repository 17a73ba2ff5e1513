//! Fig. 11: the impact probability p against the standard deviation σ of the forcing.

use super::prelude::*;
use super::simulated::sigma_axis;
use crate::experiments::Results;

/// Lowest decade of the logarithmic panel.
const LOWEST: i32 = -20;

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let sheet = Sheet::new(8950);
    let curve =
        |column| Ok::<_, Error>(results.table("theory.curve")?.points(&[], "sigma", column));
    let (p_rest, p) = (curve("p_rest")?, curve("p")?);
    let end = p.last().map_or(0.4, |point| point.0);
    let top = p.iter().chain(&p_rest).map(|point| point.1).fold(0.0, f64::max);
    let top = (top * 10.0).ceil() / 10.0;
    let sigma = || sigma_axis(end);
    let (x, y) = (sigma().bare(), Axis::linear(0.0, top, 0.2, 2, "*p*"));
    let linear = sheet.lettered(LETTERS[0], Frame::new(1300, 430, 8150, 3450), x, y)?;
    let (x, y) = (sigma(), Axis::decades(LOWEST, 0, 4, "*p*"));
    let decades = sheet.lettered(LETTERS[1], Frame::new(1300, 4350, 8150, 8050), x, y)?;

    let (main, rest) = (Stroke::solid(BLUE, LINE), Stroke::dashed(GREY, LINE, Dash::Short));
    // Both vanish with σ.
    let from_zero = |points: &[(f64, f64)]| [&[(0.0, 0.0)], points].concat();
    linear.curve("p for a start from rest", &from_zero(&p_rest), rest, Outside::Refuse)?;
    linear.curve("p of Eq. (25)", &from_zero(&p), main, Outside::Refuse)?;
    decades.curve("p for a start from rest", &p_rest, rest, Outside::Cut)?;
    decades.curve("p of Eq. (25)", &p, main, Outside::Cut)?;
    sheet.legend(
        (1850, 900),
        (TEXT, 420),
        (9, 0),
        &[Entry::line(main, "Eq. (25): random free parts"), Entry::line(rest, "start from rest")],
    )?;

    let (level, bottom) = (results.number("theory.jump.p_jump")?, decades.y.lo);
    let jump = results.number("theory.relation.sigma_jump")?;
    let jump_rest = results.number("theory.relation.sigma_jump_rest")?;
    let guide = Stroke::dashed(INK, HAIR, Dash::Dotted);
    decades.guide("jump of k*", &[(0.0, level), (jump, level), (jump, bottom)], guide)?;
    let rest = [(jump_rest, level), (jump_rest, bottom)];
    decades.guide("jump of k* from rest", &rest, guide)?;
    let told = format!("*k*^{{∗}} jumps at *p* = {}", short(level, 4));
    let look = |side, v| (SMALL, INK, side, v);
    decades.note(&told, (jump, level), (110, 260), look(HPos::Left, VPos::Top))?;
    for (sigma, side, dx) in [(jump, HPos::Left, 70), (jump_rest, HPos::Right, -70)] {
        decades.note(&number(sigma, 4), (sigma, bottom), (dx, -110), look(side, VPos::Bottom))?;
    }

    let above = p_rest.iter().zip(&p).rfind(|(rest, p)| rest.1 > p.1);
    let description = seen!(
        "Probability p that two neighbours meet against σ, on (a) a linear and (b) a logarithmic axis: it stays at zero and then \
         rises steeply, and passes {}, where k* jumps, at σ = {}. A broken curve for a start from rest lies above it \
         up to σ = {}.",
        short(level, 4),
        short(jump, 4),
        above.map_or("0".into(), |(rest, _)| short(rest.0, 2)),
    );
    Ok(sheet.finish("fig11", "Impact probability against forcing", description))
}
