//! Describes outlines on the grid as steps of a pen.

/// A place on the grid, y downwards.
pub type Point = (i32, i32);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    Move(Point),
    Line(Point),
    /// A cubic curve: two control points and its end.
    Curve([Point; 3]),
    Close,
}

pub fn polyline(points: impl IntoIterator<Item = Point>) -> Vec<Step> {
    let mut points = points.into_iter();
    let first = points.next().map(Step::Move);
    first.into_iter().chain(points.map(Step::Line)).collect()
}

pub fn polygon(points: impl IntoIterator<Item = Point>) -> Vec<Step> {
    let mut path = polyline(points);
    path.push(Step::Close);
    path
}

/// Returns a circle as four cubic curves, off by 0.03 % of its radius at most.
pub fn circle((x, y): Point, r: i32) -> Vec<Step> {
    let k = (0.552_284_749_831 * f64::from(r)).round() as i32;
    let quarters = [
        [(-r, k), (-k, r), (0, r)],
        [(k, r), (r, k), (r, 0)],
        [(r, -k), (k, -r), (0, -r)],
        [(-k, -r), (-r, -k), (-r, 0)],
    ];
    let mut path = vec![Step::Move((x - r, y))];
    for quarter in quarters {
        path.push(Step::Curve(quarter.map(|(dx, dy)| (x + dx, y + dy))));
    }
    path.push(Step::Close);
    path
}

/// Returns between which parameters the stretch from `a` to `b` lies in a rectangle, or `None` if
/// it does not (Liang and Barsky 1984).
pub fn inside(a: (f64, f64), b: (f64, f64), x: (f64, f64), y: (f64, f64)) -> Option<(f64, f64)> {
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let (mut start, mut end) = (0.0_f64, 1.0_f64);
    for (p, q) in [(-dx, a.0 - x.0), (dx, x.1 - a.0), (-dy, a.1 - y.0), (dy, y.1 - a.1)] {
        if p == 0.0 && q < 0.0 {
            return None;
        } else if p < 0.0 {
            start = start.max(q / p);
        } else if p > 0.0 {
            end = end.min(q / p);
        }
    }
    (start <= end).then_some((start, end))
}
