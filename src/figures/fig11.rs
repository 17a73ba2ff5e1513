//! Draws Fig. 11: the impact probability p against the standard deviation σ of the forcing; on a
//! logarithmic axis as well, which the paper does not have.

use super::prelude::*;

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let sheet = Sheet::new(8350);
    let theory = results.table("theory.curve")?;
    let column = |name| theory.curve(&[], "sigma", name);
    let (from_rest, p) = (column("p_rest")?, column("p")?);
    let end = p.last().map_or(0.4, |point| point.0);
    let sigma = || Axis::linear(0.0, end, 0.1, 5, SIGMA_LABEL);
    let y = Axis::up_to(p.iter().chain(&from_rest).map(|p| p.1).fold(0.0, f64::max), "*p*");
    let linear = Frame::new(1300, 430, 8150, 3430);
    let linear = sheet.lettered("(a)", linear, sigma().without_numbers(), y)?;
    let y = Axis::decades(-8, 0, 2, "*p*");
    let decades =
        sheet.lettered("(b)", Frame::new(1300, 4130, 8150, 7530), sigma(), y)?.outside(Cut);

    // Both vanish with σ.
    let from_zero = |points: &[(f64, f64)]| [&[(0.0, 0.0)], points].concat();
    linear.curve("p for a start from rest", &from_zero(&from_rest), Look::REST.line)?;
    linear.curve("p of Eq. (25)", &from_zero(&p), Look::THEORY.line)?;
    decades.curve("p for a start from rest", &from_rest, Look::REST.line)?;
    decades.curve("p of Eq. (25)", &p, Look::THEORY.line)?;
    linear.label(Look::REST.name, first_point_above(&from_rest, 0.35), (-3, 0), GREEN)?;
    linear.label(Look::THEORY.name, first_point_above(&p, 0.2), (2, 0), GREEN)?;

    let (level, bottom) = (results.number("theory.jump.p_jump")?, decades.y.lo);
    let jump = results.number("theory.relation.sigma_jump")?;
    let jump_rest = results.number("theory.relation.sigma_jump_rest")?;
    let guide = Stroke::dashed(INK, HAIR, DOTTED);
    decades.guide("jump of k*", &[(0.0, level), (jump, level), (jump, bottom)], guide)?;
    decades.guide("jump from rest", &[(jump_rest, level), (jump_rest, bottom)], guide)?;
    let jump_label = format!("*k*^{{∗}} jumps at *p* = {}", short(level, 4));
    decades.label(&jump_label, (jump, level), (2, 2), INK)?;
    let places = format!("*σ* = {}, from rest {}", number(jump, 4), number(jump_rest, 4));
    decades.label(&places, (jump, level), (2, 5), GREEN)?;

    let above = from_rest.iter().zip(&p).rfind(|(rest, p)| rest.1 > p.1);
    let description = describe!(
        "Probability p that two neighbours meet against σ, on (a) a linear and (b) a logarithmic axis: it stays at zero and then \
         rises steeply, and passes {}, where k* jumps, at σ = {}. A broken curve for a start from rest lies above it \
         up to σ = {}.",
        short(level, 4),
        short(jump, 4),
        above.map_or("0".into(), |(rest, _)| short(rest.0, 2)),
    );
    Ok(sheet.finish("Impact probability against forcing", description))
}
