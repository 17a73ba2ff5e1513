//! Cutting curves at a frame.

/// Cuts a polyline at a rectangle (Liang and Barsky 1984): the parts that lie inside.
pub fn clip(points: &[(f64, f64)], x: (f64, f64), y: (f64, f64)) -> Vec<Vec<(f64, f64)>> {
    let mut parts: Vec<Vec<(f64, f64)>> = Vec::new();
    for pair in points.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        let Some((t0, t1)) = inside(a, b, x, y) else { continue };
        let at = |t: f64| {
            let point = (a.0 + t * (b.0 - a.0), a.1 + t * (b.1 - a.1));
            (point.0.clamp(x.0, x.1), point.1.clamp(y.0, y.1))
        };
        let (from, to) = (if t0 > 0.0 { at(t0) } else { a }, if t1 < 1.0 { at(t1) } else { b });
        match parts.last_mut() {
            Some(part) if t0 == 0.0 && part.last() == Some(&from) => part.push(to),
            _ => parts.push(vec![from, to]),
        }
    }
    parts
}

/// The parameters between which the stretch from `a` to `b` lies in the rectangle.
fn inside(a: (f64, f64), b: (f64, f64), x: (f64, f64), y: (f64, f64)) -> Option<(f64, f64)> {
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let (mut t0, mut t1) = (0.0_f64, 1.0_f64);
    for (p, q) in [(-dx, a.0 - x.0), (dx, x.1 - a.0), (-dy, a.1 - y.0), (dy, y.1 - a.1)] {
        if p == 0.0 {
            if q < 0.0 {
                return None;
            }
        } else if p < 0.0 {
            t0 = t0.max(q / p);
        } else {
            t1 = t1.min(q / p);
        }
    }
    (t0 <= t1).then_some((t0, t1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_that_leaves_and_returns_becomes_two_parts() {
        let clipped = |points: &[(f64, f64)]| clip(points, (0.0, 1.0), (0.0, 1.0));
        let parts = clipped(&[(0.1, 0.5), (0.3, 1.5), (0.5, 0.5), (0.6, 0.4)]);
        assert_eq!((parts.len(), parts[0][1], parts[1].len()), (2, (0.2, 1.0), 3));
        assert_eq!(clipped(&[(-1.0, 0.5), (2.0, 0.5)]), [vec![(0.0, 0.5), (1.0, 0.5)]]);
        assert!(clipped(&[(0.1, 2.0), (0.9, 3.0)]).is_empty());
    }
}
