//! Data in a panel: curves, markers, areas and bars.
//!
//! Each series is recorded as it was given, in its own units, before anything is cut: curves, markers, ticks, bars,
//! estimates and columns. Guides and areas are no data.
//!
//! All return [`Error::Outside`] for a number that is not finite, and for a point outside the frame where that is refused.

use super::drawing::{Drawing, Element};
use super::error::Error;
use super::panel::Panel;
use super::path::Point;
use super::record::DataPoint;
use super::style::{Colour, Dash, Stroke, Symbol};
use impact_numerics::statistics::Estimate;

/// Points in units of the data.
type Points<'a> = &'a [(f64, f64)];

type Drawn = Result<(), Error>;

/// What to do with data outside the frame. On a logarithmic axis all that is not positive lies outside, below.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outside {
    /// It is a mistake.
    Refuse,
    /// The panel shows a part of the data on purpose: cut at the frame. What is not positive is left out on a
    /// logarithmic axis, of the record too.
    Cut,
    /// It is shown at the edge.
    Edge,
}

/// Shape, half width, and line or colour of markers.
pub type Marker = (Symbol, i32, Stroke);

impl Panel {
    /// Where points lie on the axes. Numbers that are not finite are always an error.
    fn placed(
        &self,
        name: &str,
        points: Points,
        outside: Outside,
    ) -> Result<Vec<(f64, f64)>, Error> {
        let finite = |p: &(f64, f64)| p.0.is_finite() && p.1.is_finite();
        let holds = |p: &(f64, f64)| self.x.contains(p.0) && self.y.contains(p.1);
        let fault = |p: &&(f64, f64)| !finite(p) || outside == Outside::Refuse && !holds(p);
        if let Some(&(x, y)) = points.iter().find(fault) {
            return Err(Error::Outside { series: name.into(), x, y });
        }
        let (x, y) = (self.x.ends(), self.y.ends());
        let places = points.iter().map(|p| (self.x.position(p.0), self.y.position(p.1)));
        // Of what is refused elsewhere, at most a rounding error is cut off here.
        let edge = |p: (f64, f64)| (p.0.clamp(x.0, x.1), p.1.clamp(y.0, y.1));
        Ok(match outside {
            Outside::Cut => places.filter(finite).collect(),
            Outside::Refuse | Outside::Edge => places.map(edge).collect(),
        })
    }

    /// Keeps rows of a series for the data file, as a picture may show them in another way.
    pub fn record<R: Into<DataPoint>>(&self, name: &str, rows: impl IntoIterator<Item = R>) {
        if self.recorded {
            self.record.borrow_mut().add(name, rows.into_iter().map(R::into));
        }
    }

    /// Whether the axes have a place for a point.
    fn has(&self, (x, y): (f64, f64)) -> bool {
        self.x.position(x).is_finite() && self.y.position(y).is_finite()
    }

    fn record_points(&self, name: &str, points: Points, outside: Outside) {
        let shown = |p: &&(f64, f64)| outside == Outside::Edge || self.has(**p);
        self.record(name, points.iter().filter(shown).copied());
    }

    fn draw(&self, name: &str, shapes: impl FnOnce(&mut Drawing)) -> Drawn {
        let mut drawing = self.drawing.borrow_mut();
        drawing.elements.push(Element::Open(name.into(), self.frame));
        shapes(&mut drawing);
        drawing.elements.push(Element::Close);
        Ok(())
    }

    /// Where places on the axes stand on the sheet.
    fn seen(&self, places: Vec<(f64, f64)>) -> Vec<Point> {
        places.into_iter().map(|place| self.place(place)).collect()
    }

    /// A curve.
    pub fn curve(&self, name: &str, points: Points, stroke: Stroke, outside: Outside) -> Drawn {
        let parts = clip(&self.placed(name, points, outside)?, self.x.ends(), self.y.ends());
        self.record_points(name, points, outside);
        self.draw(name, |drawing| {
            parts.into_iter().for_each(|part| drawing.line(self.seen(part), stroke));
        })
    }

    /// A line that is no data: zero, a level, an outline, a printed value; cut at the frame.
    pub fn guide(&self, name: &str, points: Points, stroke: Stroke) -> Drawn {
        self.unrecorded().curve(name, points, stroke, Outside::Cut)
    }

    /// A guide across the panel at one height.
    pub fn level(&self, name: &str, y: f64, stroke: Stroke) -> Drawn {
        self.guide(name, &[(self.x.lo, y), (self.x.hi, y)], stroke)
    }

    /// Markers; points outside the frame are left out if `outside` cuts.
    pub fn markers(&self, name: &str, points: Points, marker: Marker, outside: Outside) -> Drawn {
        let mut placed = self.placed(name, points, outside)?;
        placed.retain(|p| self.x.contains_position(p.0) && self.y.contains_position(p.1));
        self.record_points(name, points, outside);
        self.draw(name, |drawing| drawing.markers(self.seen(placed), marker))
    }

    /// A curve with markers at its points.
    pub fn curve_with_markers(
        &self,
        name: &str,
        points: Points,
        (stroke, marker): (Stroke, Marker),
        outside: Outside,
    ) -> Drawn {
        self.curve(name, points, stroke, outside)?;
        self.markers(name, points, marker, outside)
    }

    /// Upright ticks of the given width at many points, all inside the frame; the thickness of the
    /// stroke is their height.
    pub fn ticks(&self, name: &str, points: Points, width: i32, stroke: Stroke) -> Drawn {
        let placed = self.placed(name, points, Outside::Refuse)?;
        self.record_points(name, points, Outside::Refuse);
        self.draw(name, |drawing| drawing.ticks(self.seen(placed), width, stroke))
    }

    /// A filled polygon, all of it inside the frame; it is a ground, and no data.
    pub fn filled_area(&self, name: &str, points: Points, fill: Colour, opacity: u8) -> Drawn {
        let placed = self.placed(name, points, Outside::Refuse)?;
        self.draw(name, |drawing| drawing.area(self.seen(placed), fill, opacity))
    }

    /// Columns of width 1 around 1, 2, …, which stand on zero: filled and with an outline; those outside the axis are left
    /// out.
    pub fn columns(&self, name: &str, values: &[f64], stroke: Stroke) -> Drawn {
        let heights = || (1..).map(f64::from).zip(values.iter().copied());
        self.record(name, heights());
        let inside = |k: f64| k.clamp(self.x.lo, self.x.hi);
        let tops: Vec<_> = heights()
            .filter(|(k, _)| self.x.contains(*k))
            .flat_map(|(k, own)| [(inside(k - 0.5), own), (inside(k + 0.5), own)])
            .collect();
        let foot = |top: Option<&(f64, f64)>| top.map(|(k, _)| (*k, 0.0));
        let outline: Vec<_> = foot(tops.first())
            .into_iter()
            .chain(tops.iter().copied())
            .chain(foot(tops.last()))
            .collect();
        self.filled_area(name, &outline, stroke.colour, 45)?;
        self.unrecorded().curve(name, &outline, stroke, Outside::Refuse)
    }

    /// Bars from `low` to `high` at each x, with caps of the given half width; cut at the frame, and left out outside it,
    /// where that is no mistake.
    pub fn bars(
        &self,
        name: &str,
        bars: &[(f64, f64, f64)],
        half: i32,
        stroke: Stroke,
        outside: Outside,
    ) -> Drawn {
        let cuts = outside == Outside::Cut;
        let outside = if cuts { Outside::Edge } else { outside };
        let shown = bars.iter().filter(|bar| !cuts || self.x.contains(bar.0));
        let ends: Vec<_> = shown.flat_map(|&(x, a, b)| [(x, a), (x, b)]).collect();
        let ends = self.placed(name, &ends, outside)?;
        self.record(name, bars.iter().copied());
        let (lo, hi) = self.x.ends();
        let cap = f64::from(half) * (hi - lo) / f64::from(self.frame.right - self.frame.left);
        self.draw(name, |drawing| {
            let mut line = |a, b| drawing.line(self.seen(vec![a, b]), stroke);
            for ends in ends.chunks_exact(2) {
                line(ends[0], ends[1]);
                let (a, b) = ((ends[0].0 - cap).max(lo), (ends[0].0 + cap).min(hi));
                for y in ends.iter().map(|end| end.1).filter(|_| half > 0) {
                    line((a, y), (b, y));
                }
            }
        })
    }

    /// Estimates with bars of one standard error. What lies outside the frame is left out, and bars are cut: a few
    /// realisations leave some that are longer than the axis.
    pub fn estimates(&self, name: &str, estimates: &[(f64, Estimate)], look: Marker) -> Drawn {
        let shown = |(x, own): &&(f64, Estimate)| self.has((*x, own.value));
        self.record(name, estimates.iter().filter(shown).copied());
        let holds = |(x, own): &&(f64, Estimate)| self.x.contains(*x) && self.y.contains(own.value);
        let inside = || estimates.iter().filter(holds);
        let bars = inside().map(|(x, own)| (*x, own.value - own.error, own.value + own.error));
        let points: Vec<_> = inside().map(|(x, own)| (*x, own.value)).collect();
        self.unrecorded().bars(name, &bars.collect::<Vec<_>>(), 35, look.2, Outside::Edge)?;
        self.unrecorded().markers(name, &points, look, Outside::Refuse)
    }

    /// Estimates with a line through them, cut at the frame.
    pub fn joined_estimates(
        &self,
        name: &str,
        estimates: &[(f64, Estimate)],
        look: Marker,
    ) -> Drawn {
        let points: Vec<_> = estimates.iter().map(|(x, own)| (*x, own.value)).collect();
        self.unrecorded().curve(name, &points, look.2, Outside::Cut)?;
        let (mark, size, line) = look;
        self.estimates(name, estimates, (mark, size, Stroke { dash: Dash::Solid, ..line }))
    }
}

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
    use crate::figures::axis::Axis;
    use crate::figures::drawing::Frame;
    use crate::figures::panel::Sheet;
    use crate::figures::style::GREEN;

    const FRAME: Frame = Frame::new(1000, 100, 2000, 1100);
    const LINE: Stroke = Stroke::solid(GREEN, 30);

    fn axis() -> Axis {
        Axis::linear(0.0, 1.0, 0.5, 1, "x")
    }

    #[test]
    fn data_outside_the_frame_is_an_error_and_not_moved_onto_it() {
        let panel = Sheet::new(3000).panel(FRAME, axis(), axis()).unwrap();
        assert_eq!((panel.at(0.0, 0.0), panel.at(1.0, 1.0)), ((1000, 1100), (2000, 100)));
        let beyond = [(0.5, 0.5), (0.6, 1.1)];
        let drawn = panel.curve("curve", &beyond, LINE, Outside::Refuse);
        assert!(matches!(drawn, Err(Error::Outside { y: 1.1, .. })));
        panel.curve("curve", &beyond, LINE, Outside::Cut).unwrap();
        let marks = panel.markers("marks", &beyond, (Symbol::Disc, 30, LINE), Outside::Refuse);
        assert!(matches!(marks, Err(Error::Outside { .. })));
        assert!(panel.filled_area("area", &beyond, GREEN, 50).is_err());
        assert!(panel.columns("columns", &[1.1], LINE).is_err());
        assert!(panel.curve("nan", &[(0.1, f64::NAN)], LINE, Outside::Cut).is_err());
        // A wall that is touched within rounding is inside.
        panel.curve("wall", &[(0.0, -1e-17), (1.0, 1.0 + 1e-15)], LINE, Outside::Refuse).unwrap();
    }

    #[test]
    fn on_a_logarithmic_axis_what_is_not_positive_is_outside_below() {
        let sheet = Sheet::new(3000);
        let panel =
            sheet.lettered_panel("(b)", FRAME, axis(), Axis::decades(-2, 0, 1, "y")).unwrap();
        assert_eq!(panel.at(0.5, 0.1), (1500, 600));
        let points = [(0.1, 0.5), (0.2, 0.0), (0.3, 1e-3), (0.4, -1.0)];
        let refused = panel.curve("refused", &points, LINE, Outside::Refuse);
        assert!(matches!(refused, Err(Error::Outside { x: 0.2, y: 0.0, .. })));
        panel.curve("cut", &points, LINE, Outside::Cut).unwrap();
        panel.markers("edge", &points[1..2], (Symbol::Disc, 30, LINE), Outside::Edge).unwrap();
        let of = |value, error| Estimate { value, error, interval: [value; 2] };
        let estimates = [(0.5, of(0.1, 0.2)), (0.6, of(0.0, 0.1)), (0.7, of(2.0, 0.1))];
        panel.estimates("estimates", &estimates, (Symbol::Disc, 30, LINE)).unwrap();
        // Guides, grounds and what is quiet are no data.
        panel.level("level", 0.5, LINE).unwrap();
        panel.filled_area("area", &points[..1], GREEN, 50).unwrap();
        panel.unrecorded().curve("rims", &points, LINE, Outside::Cut).unwrap();
        // In units of the data, and as they were given: the cut is the picture's.
        let file = &sheet.finish("", Default::default()).data[0];
        let rows = [
            "cut,0.1,0.5,",
            "cut,0.3,0.001,",
            "edge,0.2,0,",
            "estimates,0.5,0.1,0.2",
            "estimates,0.7,2,0.1",
        ];
        assert_eq!(file.name, "b.csv");
        assert_eq!(file.csv().lines().skip(1).collect::<Vec<_>>(), rows);
    }

    #[test]
    fn a_curve_that_leaves_and_returns_becomes_two_parts() {
        let clipped = |points: &[(f64, f64)]| clip(points, (0.0, 1.0), (0.0, 1.0));
        let parts = clipped(&[(0.1, 0.5), (0.3, 1.5), (0.5, 0.5), (0.6, 0.4)]);
        assert_eq!((parts.len(), parts[0][1], parts[1].len()), (2, (0.2, 1.0), 3));
        assert_eq!(clipped(&[(-1.0, 0.5), (2.0, 0.5)]), [vec![(0.0, 0.5), (1.0, 0.5)]]);
        assert!(clipped(&[(0.1, 2.0), (0.9, 3.0)]).is_empty());
    }
}
