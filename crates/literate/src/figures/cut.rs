//! Cuts curves at the frame of a panel.

use super::axis::Axis;

/// A point in units of the data.
pub type DataPair = (f64, f64);

/// Cuts a polyline at the ends of two axes (Liang and Barsky 1984): returns the parts inside. What
/// is between two points is straight on the sheet, on logarithmic axes too.
pub fn cut(points: &[DataPair], x: &Axis, y: &Axis) -> Vec<Vec<DataPair>> {
    let (x_ends, y_ends) = (x.ends(), y.ends());
    let mut parts: Vec<Vec<DataPair>> = Vec::new();
    for pair in points.windows(2) {
        let [a, b] = [pair[0], pair[1]].map(|p| (x.position(p.0), y.position(p.1)));
        let Some((start, end)) = inside(a, b, x_ends, y_ends) else { continue };
        let at = |t: f64| {
            let right = (a.0 + t * (b.0 - a.0)).clamp(x_ends.0, x_ends.1);
            let up = (a.1 + t * (b.1 - a.1)).clamp(y_ends.0, y_ends.1);
            (x.value(right), y.value(up))
        };
        let from = if start > 0.0 { at(start) } else { pair[0] };
        let to = if end < 1.0 { at(end) } else { pair[1] };
        match parts.last_mut() {
            Some(part) if start == 0.0 && part.last() == Some(&from) => part.push(to),
            _ => parts.push(vec![from, to]),
        }
    }
    parts
}

/// Returns the parameters between which the stretch from `a` to `b` lies in the rectangle; none if
/// it does not.
pub fn inside(a: DataPair, b: DataPair, x: DataPair, y: DataPair) -> Option<(f64, f64)> {
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let (mut start, mut end) = (0.0_f64, 1.0_f64);
    for (p, q) in [(-dx, a.0 - x.0), (dx, x.1 - a.0), (-dy, a.1 - y.0), (dy, y.1 - a.1)] {
        if p == 0.0 {
            if q < 0.0 {
                return None;
            }
        } else if p < 0.0 {
            start = start.max(q / p);
        } else {
            end = end.min(q / p);
        }
    }
    (start <= end).then_some((start, end))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_that_leaves_and_returns_becomes_two_parts() {
        let axis = Axis::linear(0.0, 1.0, 0.5, 1, "");
        let parts_of = |points: &[DataPair]| cut(points, &axis, &axis);
        let parts = parts_of(&[(0.1, 0.5), (0.3, 1.5), (0.5, 0.5), (0.6, 0.4)]);
        assert_eq!((parts.len(), parts[0][1], parts[1].len()), (2, (0.2, 1.0), 3));
        assert_eq!(parts_of(&[(-1.0, 0.5), (2.0, 0.5)]), [vec![(0.0, 0.5), (1.0, 0.5)]]);
        assert!(parts_of(&[(0.1, 2.0), (0.9, 3.0)]).is_empty());
    }
}
