//! Path data of SVG → path operators of PDF.

use super::super::Error;
use super::fail;
use std::fmt::Write as _;

/// Path data → path operators.
pub fn operators(data: &str) -> Result<String, Error> {
    let mut out = String::new();
    let (mut x, mut y) = (0.0, 0.0);
    let (mut x0, mut y0) = (0.0, 0.0);
    let mut rest = data.trim_start();
    while let Some(command) = rest.chars().next() {
        let end = rest[1..]
            .find(|c: char| c.is_ascii_alphabetic() && c != 'e')
            .map_or(rest.len(), |i| i + 1);
        let values = numbers(&rest[1..end])?;
        rest = rest[end..].trim_start();
        let (dx, dy) = if command.is_ascii_lowercase() { (1.0, 1.0) } else { (0.0, 0.0) };
        let upper = command.to_ascii_uppercase();
        let arity = match upper {
            'M' | 'L' => 2,
            'H' | 'V' => 1,
            'Q' => 4,
            'C' => 6,
            'A' => 7,
            'Z' => {
                (x, y) = (x0, y0);
                out.push_str("h\n");
                continue;
            }
            other => return Err(fail(format!("no translation for the path command {other}"))),
        };
        if values.is_empty() || values.len() % arity != 0 {
            return Err(fail(format!("the path command {command} has {} numbers", values.len())));
        }
        for (i, v) in values.chunks_exact(arity).enumerate() {
            let at = |j: usize| (v[j] + dx * x, v[j + 1] + dy * y);
            match upper {
                'M' | 'L' => {
                    let start = upper == 'M' && i == 0;
                    (x, y) = at(0);
                    if start {
                        (x0, y0) = (x, y);
                    }
                    let _ = writeln!(out, "{} {} {}", n(x), n(y), if start { "m" } else { "l" });
                }
                'H' | 'V' => {
                    (x, y) = if upper == 'H' { (v[0] + dx * x, y) } else { (x, v[0] + dy * y) };
                    let _ = writeln!(out, "{} {} l", n(x), n(y));
                }
                'Q' => {
                    // A quadratic curve as a cubic one: its controls lie two thirds of the way.
                    let ((qx, qy), (ex, ey)) = (at(0), at(2));
                    let third = |from: f64, to: f64| from + 2.0 / 3.0 * (to - from);
                    let [a, b, c, d] = [third(x, qx), third(y, qy), third(ex, qx), third(ey, qy)];
                    let _ =
                        writeln!(out, "{} {} {} {} {} {} c", n(a), n(b), n(c), n(d), n(ex), n(ey));
                    (x, y) = (ex, ey);
                }
                'A' => {
                    let end = at(5);
                    out.push_str(&half_circle((x, y), end, &v[..5])?);
                    (x, y) = end;
                }
                _ => {
                    let ((a, b), (c, d), (ex, ey)) = (at(0), at(2), at(4));
                    let _ =
                        writeln!(out, "{} {} {} {} {} {} c", n(a), n(b), n(c), n(d), n(ex), n(ey));
                    (x, y) = (ex, ey);
                }
            }
        }
    }
    Ok(out)
}

/// Distance of a control point from its end, for a quarter of a circle with radius 1.
const QUARTER: f64 = 0.552_284_749_831;

/// An arc that is half a circle, as marks have them, as two cubic curves; `v` holds the radii, the
/// rotation and the two flags.
fn half_circle(from: (f64, f64), to: (f64, f64), v: &[f64]) -> Result<String, Error> {
    let (cx, cy) = ((from.0 + to.0) / 2.0, (from.1 + to.1) / 2.0);
    let (ux, uy) = (from.0 - cx, from.1 - cy);
    let radius = (ux * ux + uy * uy).sqrt();
    if v[0] != v[1] || (radius - v[0]).abs() > 1e-6 * radius {
        return Err(fail("an arc that is not half a circle".into()));
    }
    let (vx, vy) = if v[4] == 0.0 { (uy, -ux) } else { (-uy, ux) };
    let k = QUARTER;
    let mut out = String::new();
    for [(ax, ay), (bx, by)] in [[(ux, uy), (vx, vy)], [(vx, vy), (-ux, -uy)]] {
        let points = [(ax + k * bx, ay + k * by), (bx + k * ax, by + k * ay), (bx, by)];
        for (x, y) in points {
            let _ = write!(out, "{} {} ", n(cx + x), n(cy + y));
        }
        out.push_str("c\n");
    }
    Ok(out)
}

/// A circle as four cubic curves (off by 0.03 % of its radius at most).
pub fn circle(cx: f64, cy: f64, r: f64) -> String {
    let k = QUARTER * r;
    let mut out = format!("{} {} m\n", n(cx + r), n(cy));
    for [a, b, c, d, e, f] in [
        [r, k, k, r, 0.0, r],
        [-k, r, -r, k, -r, 0.0],
        [-r, -k, -k, -r, 0.0, -r],
        [k, -r, r, -k, r, 0.0],
    ] {
        let [a, c, e] = [a, c, e].map(|v| n(cx + v));
        let [b, d, f] = [b, d, f].map(|v| n(cy + v));
        let _ = writeln!(out, "{a} {b} {c} {d} {e} {f} c");
    }
    out + "h\n"
}

/// A finite number.
pub fn number(text: &str) -> Result<f64, Error> {
    let value: Option<f64> = text.trim().parse().ok();
    value.filter(|v| v.is_finite()).ok_or_else(|| fail(format!("{text:?} is not a number")))
}

/// Numbers between spaces and commas.
pub fn numbers(text: &str) -> Result<Vec<f64>, Error> {
    text.split([' ', ',', '\n', '\t']).filter(|part| !part.is_empty()).map(number).collect()
}

/// A number for PDF: no exponent, four decimals at most.
pub fn n(x: f64) -> String {
    // In whole numbers, since a report has some hundred thousand of these.
    let scaled = (x * 1e4).round();
    if scaled.is_nan() || scaled.abs() > 1e15 {
        return format!("{x:.0}");
    }
    let (sign, scaled) = (if scaled < 0.0 { "-" } else { "" }, scaled.abs() as u64);
    match (scaled / 10_000, scaled % 10_000) {
        (whole, 0) => format!("{sign}{whole}"),
        (whole, part) => format!("{sign}{whole}.{part:04}").trim_end_matches('0').into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_four_decimals_at_most() {
        let written = [0.0, -0.00004, 1.5, -12.0625, 2.99996, 0.05, -0.3, 1e17, f64::NAN].map(n);
        let expected =
            ["0", "0", "1.5", "-12.0625", "3", "0.05", "-0.3", "100000000000000000", "NaN"];
        assert_eq!(written, expected);
    }
}
