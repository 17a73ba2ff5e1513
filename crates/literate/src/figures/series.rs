//! Draws data in a panel: curves, symbols, areas and bars, as series of plotters elements.
//!
//! What these methods draw is recorded as it was given, in its units, before it is cut; guides are
//! no data. They refuse numbers that are not finite, and points outside the frame where the panel
//! says so. What `draw_series` draws is not looked at.

use super::axis::Axis;
use super::drawing::{Drawing, Element};
use super::elements::{CustomElement, Marker, line, markers};
use super::error::{Drawn, Error, Fault};
use super::markup::spelled;
use super::panel::{Outside, Panel};
use super::path::inside;
use super::record::DataPoint;
use super::style::{Stroke, Symbol};
use impact_numerics::statistics::Estimate;
use plotters::element::{Drawable, PointCollection, Polygon};
use plotters::style::{Color, ShapeStyle};
use plotters_backend::DrawingBackend;

/// Points in units of the data.
type Points<'a> = &'a [(f64, f64)];

impl Panel {
    /// Draws a series of plotters, or any elements, as a group of this name. What lies outside the
    /// frame is not cut, and nothing is recorded; see [`Panel::cut`] and [`Panel::record`].
    pub fn draw_series<S>(&self, name: &str, series: S) -> Drawn
    where
        S: IntoIterator,
        S::Item: Drawable<Drawing>,
        for<'a> &'a S::Item: PointCollection<'a, (f64, f64)>,
    {
        let ends = |axis: &Axis| format!("{} {} {}", axis.lo, axis.hi, axis.is_log);
        let axes = [&self.x, &self.y].map(ends).join(" ");
        self.push(Element::Open(name.into(), self.frame, axes))?;
        for element in series {
            self.area.draw(&element)?;
        }
        self.push(Element::Close)
    }

    fn push(&self, element: Element) -> Drawn {
        let mark = CustomElement::new(Vec::new(), move |drawing, _| {
            drawing.elements.push(element.clone());
            Ok(())
        });
        Ok(self.area.draw(&mark)?)
    }

    /// Keeps rows of a series for the data file, as a picture may show them in another way.
    pub fn record<R: Into<DataPoint>>(&self, name: &str, rows: impl IntoIterator<Item = R>) {
        if self.recorded {
            self.record.borrow_mut().add(name, rows.into_iter().map(R::into));
        }
    }

    fn has_place(&self, (x, y): (f64, f64)) -> bool {
        self.x.position(x).is_finite() && self.y.position(y).is_finite()
    }

    /// Records points that the axes have a place for, and returns where they are drawn.
    fn places(&self, name: &str, points: Points) -> Result<Vec<(f64, f64)>, Error> {
        let (mut shown, mut places) = (Vec::new(), Vec::new());
        for (i, &(x, y)) in points.iter().enumerate() {
            let is_refused = self.outside == Outside::Refuse && !self.contains((x, y));
            if is_refused || !x.is_finite() || !y.is_finite() {
                return Err(Error(Fault::Outside { series: spelled(name), row: 1 + i, x, y }));
            }
            // Where points outside are refused, the edge takes away at most a rounding error.
            let place = match self.outside {
                Outside::Cut if !self.has_place((x, y)) => continue,
                Outside::Cut => (x, y),
                _ => (x.clamp(self.x.lo, self.x.hi), y.clamp(self.y.lo, self.y.hi)),
            };
            shown.push((x, y));
            places.push(place);
        }
        self.record(name, shown);
        Ok(places)
    }

    /// Returns the parts of a curve inside the frame, for series of plotters, which are not cut.
    /// What is between two points is straight on the sheet, on logarithmic axes too.
    pub fn cut(&self, points: Points) -> Vec<Vec<(f64, f64)>> {
        let (across, up) = (self.x.ends(), self.y.ends());
        let mut parts: Vec<Vec<(f64, f64)>> = Vec::new();
        for pair in points.windows(2) {
            let [a, b] = [pair[0], pair[1]].map(|p| (self.x.position(p.0), self.y.position(p.1)));
            let Some((start, end)) = inside(a, b, across, up) else { continue };
            let at = |t: f64| {
                let x = (a.0 + t * (b.0 - a.0)).clamp(across.0, across.1);
                let y = (a.1 + t * (b.1 - a.1)).clamp(up.0, up.1);
                (self.x.value(x), self.y.value(y))
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

    /// Draws a line through points. It is broken where the axes have no place for a point.
    pub fn curve(&self, name: &str, points: Points, stroke: Stroke) -> Drawn {
        self.places(name, points)?;
        let is_missing = |p: &(f64, f64)| self.outside == Outside::Cut && !self.has_place(*p);
        let quiet = self.unrecorded();
        let mut parts = Vec::new();
        let mut alone = Vec::new();
        for part in points.split(is_missing) {
            let places = quiet.places(name, part)?;
            if let ([place], true) = (places.as_slice(), points.len() > 1) {
                alone.push(*place);
            }
            parts.extend(self.cut(&places));
        }
        // A point with no neighbour is a dot.
        quiet.markers(name, &alone, (Symbol::Disc, 2 * stroke.width as i32, stroke))?;
        self.draw_series(name, parts.into_iter().map(|part| line(part, stroke)))
    }

    /// Draws a line that is no data, cut at the frame: zero, a level, an outline, a printed value.
    pub fn guide(&self, name: &str, points: Points, stroke: Stroke) -> Drawn {
        self.unrecorded().outside(Outside::Cut).curve(name, points, stroke)
    }

    /// Draws a guide across the panel at one height.
    pub fn level(&self, name: &str, y: f64, stroke: Stroke) -> Drawn {
        self.guide(name, &[(self.x.lo, y), (self.x.hi, y)], stroke)
    }

    /// Draws symbols; where the panel cuts, those outside the frame are left out.
    pub fn markers(&self, name: &str, points: Points, marker: Marker) -> Drawn {
        let mut places = self.places(name, points)?;
        places.retain(|p| self.contains(*p));
        self.draw_series(name, [markers(places, marker)])
    }

    /// Draws a curve with symbols at its points.
    pub fn marked_curve(&self, name: &str, points: Points, line: Stroke, marker: Marker) -> Drawn {
        self.curve(name, points, line)?;
        self.markers(name, points, marker)
    }

    /// Draws columns of width 1 around 1, 2, …, which stand on zero: filled and with an outline;
    /// those outside the axis are left out.
    pub fn columns(&self, name: &str, values: &[f64], stroke: Stroke) -> Drawn {
        let heights = || (1..).map(f64::from).zip(values.iter().copied());
        self.record(name, heights());
        let mut outline = Vec::new();
        for (k, height) in heights().filter(|(k, _)| self.x.contains(*k)) {
            let sides = [k - 0.5, k + 0.5].map(|side| side.clamp(self.x.lo, self.x.hi));
            outline.extend(sides.map(|side| (side, height)));
        }
        if let (Some(first), Some(last)) = (outline.first(), outline.last()) {
            let (left, right) = ((first.0, 0.0), (last.0, 0.0));
            outline.insert(0, left);
            outline.push(right);
        }
        self.draw_series(name, [Polygon::new(outline.clone(), stroke.colour.mix(0.45))])?;
        self.unrecorded().outside(Outside::Refuse).curve(name, &outline, stroke)
    }

    /// Draws bars from `low` to `high` at each x, with caps of the given half width. They end at
    /// the frame; where the panel cuts, those outside it are left out.
    pub fn bars(&self, name: &str, bars: &[(f64, f64, f64)], half: i32, stroke: Stroke) -> Drawn {
        let is_cut = self.outside == Outside::Cut;
        let edge = if is_cut { Outside::Edge } else { self.outside };
        let quiet = self.unrecorded().outside(edge);
        let lows: Vec<_> = bars.iter().map(|(x, low, _)| (*x, *low)).collect();
        let highs: Vec<_> = bars.iter().map(|(x, _, high)| (*x, *high)).collect();
        let ends = quiet.places(name, &lows)?.into_iter().zip(quiet.places(name, &highs)?);
        self.record(name, bars.iter().copied());
        let shown = ends.zip(bars).filter(|(_, bar)| !is_cut || self.x.contains(bar.0));
        let style = ShapeStyle::from(stroke);
        let bar = |((low, high), _)| {
            CustomElement::new(vec![low, high], move |drawing, ends| {
                drawing.draw_path(ends.iter().copied(), &style)?;
                for (x, y) in ends.into_iter().filter(|_| half > 0) {
                    drawing.draw_path([(x - half, y), (x + half, y)], &style)?;
                }
                Ok(())
            })
        };
        self.draw_series(name, shown.map(bar))
    }

    /// Draws estimates with bars of one standard error. What lies outside the frame is left out,
    /// and bars are cut: a few realisations leave some that are longer than the axis.
    pub fn estimates(&self, name: &str, estimates: &[(f64, Estimate)], marker: Marker) -> Drawn {
        for ((_, Estimate { error, .. }), row) in estimates.iter().zip(1..) {
            if !(0.0..).contains(error) {
                let (series, error) = (spelled(name), *error);
                return Err(Error(Fault::NegativeError { series, row, error }));
            }
        }
        let shown = |(x, y): &&(f64, Estimate)| self.has_place((*x, y.value));
        self.record(name, estimates.iter().filter(shown).copied());
        let points: Vec<_> = estimates.iter().map(|(x, y)| (*x, y.value)).collect();
        let inside = estimates.iter().filter(|(x, y)| self.contains((*x, y.value)));
        let bar = |&(x, y): &(f64, Estimate)| (x, y.value - y.error, y.value + y.error);
        let bars: Vec<_> = inside.map(bar).collect();
        let quiet = self.unrecorded();
        quiet.outside(Outside::Edge).bars(name, &bars, 35, marker.2)?;
        quiet.outside(Outside::Cut).markers(name, &points, marker)
    }

    /// Draws estimates with a line through them, cut at the frame.
    pub fn joined_estimates(&self, name: &str, found: &[(f64, Estimate)], marker: Marker) -> Drawn {
        let points: Vec<_> = found.iter().map(|(x, y)| (*x, y.value)).collect();
        self.guide(name, &points, marker.2)?;
        self.estimates(name, found, marker)
    }
}

/// Returns the points (k, value) of a series whose first value belongs to k = 1.
pub fn over_k(values: &[f64]) -> Vec<(f64, f64)> {
    values.iter().enumerate().map(|(i, &v)| ((i + 1) as f64, v)).collect()
}

/// Returns the largest of a series, zero if it is empty.
pub fn largest(values: &[f64]) -> f64 {
    values.iter().copied().fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::axis::Axis;
    use crate::figures::drawing::Frame;
    use crate::figures::panel::Sheet;
    use crate::figures::style::GREEN;
    use impact_numerics::estimates::with_error;

    const FRAME: Frame = Frame::new(1000, 100, 2000, 1100);
    const LINE: Stroke = Stroke::solid(GREEN, 30);

    fn axis() -> Axis {
        Axis::linear(0.0, 1.0, 0.5, 1, "x")
    }

    #[test]
    fn data_outside_the_frame_is_refused_or_cut_and_not_moved_onto_it() {
        let panel = Sheet::new(3000).panel(FRAME, axis(), axis()).unwrap();
        let corners = [(0.0, 0.0), (1.0, 1.0)].map(|corner| panel.area.map_coordinate(&corner));
        assert_eq!(corners, [(1000, 1100), (2000, 100)]);
        let beyond = [(0.5, 0.5), (0.6, 1.1)];
        let drawn = panel.curve("curve", &beyond, LINE);
        assert!(matches!(drawn, Err(Error(Fault::Outside { y: 1.1, .. }))));
        let marks = panel.markers("marks", &beyond, (Symbol::Disc, 30, LINE));
        assert!(matches!(marks, Err(Error(Fault::Outside { .. }))));
        assert!(panel.columns("columns", &[1.1], LINE).is_err());
        // A wall that is touched within rounding is inside.
        panel.curve("wall", &[(0.0, -1e-17), (1.0, 1.0 + 1e-15)], LINE).unwrap();
        // A curve that leaves and returns becomes two parts.
        let parts = panel.cut(&[(0.1, 0.5), (0.3, 1.5), (0.5, 0.5), (0.6, 0.4)]);
        assert_eq!((parts.len(), parts[0][1], parts[1].len()), (2, (0.2, 1.0), 3));
        assert_eq!(panel.cut(&[(-1.0, 0.5), (2.0, 0.5)]), [vec![(0.0, 0.5), (1.0, 0.5)]]);
        assert!(panel.cut(&[(0.1, 2.0), (0.9, 3.0)]).is_empty());
        let panel = panel.outside(Outside::Cut);
        panel.curve("curve", &beyond, LINE).unwrap();
        let drawn = panel.bars("bars", &[(0.5, 0.1, 0.2), (0.5, 0.1, f64::NAN)], 0, LINE);
        assert!(matches!(drawn, Err(Error(Fault::Outside { row: 2, .. }))));
        assert!(panel.curve("nan", &[(0.1, f64::NAN)], LINE).is_err());
    }

    #[test]
    fn on_a_logarithmic_axis_what_is_not_positive_is_outside_below() {
        let sheet = Sheet::new(3000);
        let frame = Frame::new(1000, 400, 2000, 1400);
        let panel = sheet.lettered("(b)", frame, axis(), Axis::decades(-2, 0, 1, "y")).unwrap();
        assert_eq!(panel.area.map_coordinate(&(0.5, 0.1)), (1500, 900));
        let points = [(0.1, 0.5), (0.2, 0.0), (0.3, 1e-3), (0.4, -1.0)];
        let refused = panel.curve("refused", &points, LINE);
        assert!(matches!(refused, Err(Error(Fault::Outside { x: 0.2, y: 0.0, .. }))));
        let cut = panel.outside(Outside::Cut);
        cut.curve("cut", &points, LINE).unwrap();
        let disc = (Symbol::Disc, 30, LINE);
        panel.outside(Outside::Edge).markers("edge", &points[1..2], disc).unwrap();
        let estimates = [(0.5, 0.1, 0.2), (0.6, 0.0, 0.1), (0.7, 2.0, 0.1)];
        let estimates = estimates.map(|(x, value, error)| (x, with_error(value, error)));
        panel.estimates("estimates", &estimates, disc).unwrap();
        // Guides, grounds and what is quiet are no data.
        panel.level("level", 0.5, LINE).unwrap();
        cut.unrecorded().curve("rims", &points, LINE).unwrap();
        // In units of the data, and as they were given: the cut is the picture's.
        let file = &sheet.finish("", Default::default()).data[0];
        let rows = "cut,0.1,0.5,\ncut,0.3,0.001,\nedge,0.2,0,\n\
                    estimates,0.5,0.1,0.2\nestimates,0.7,2,0.1\n";
        assert_eq!((&*file.name, file.to_csv().split_once('\n').unwrap().1), ("b.csv", rows));
    }
}
